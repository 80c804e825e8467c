# to-ndjson.awk - a recording (CSV) to seautils.Status and seautils.Ctd messages (NDJSON)
#
# awk -v interval_s=60 -v report=FILE -f to-ndjson.awk recording.csv > sent.ndjson
#
# Works in any POSIX awk. README.md in this folder says which columns it knows and what it computes.

function fail(what) {
    print "to-ndjson.awk: " FILENAME ":" NR ": " what > "/dev/stderr"
    failed = 1
    exit 65
}

# The text of the first column of these names, if it is a number as JSON writes them; else "".
function cell(name, other,    text) {
    text = name in column ? $column[name] : other in column ? $column[other] : ""
    if (text == "") return ""
    if (text !~ /^-?(0|[1-9][0-9]*)(\.[0-9]+)?([eE][-+]?[0-9]+)?$/) {
        dropped["not a number"]++
        return ""
    }
    return text
}

# `,"name":value`, or nothing where the value is unknown or the schema cannot carry it.
function member(name, value, low, high) {
    if (value == "") return ""
    if (value + 0 < low || value + 0 > high) {
        dropped[name " outside " low " to " high]++
        return ""
    }
    return ",\"" name "\":" value
}

function head(type, time_s) {
    return "{\"@type\":\"seautils." type "\",\"time_s\":" time_s ",\"src\":1,\"dest\":0"
}

# East and north of the datum (the first position) on the plane that touches WGS84 there.
function locate(latitude_deg, longitude_deg,    sin2, w) {
    x_m = y_m = ""
    if (latitude_deg == "" || longitude_deg == "") return
    if (datum_latitude_deg == "") {
        datum_latitude_deg = latitude_deg
        datum_longitude_deg = longitude_deg
        sin2 = sin(latitude_deg * RADIAN) ^ 2
        w = sqrt(1 - E2 * sin2)
        east_m = A_M / w * cos(latitude_deg * RADIAN) * RADIAN
        north_m = A_M * (1 - E2) / (w * w * w) * RADIAN
    }
    longitude_deg -= datum_longitude_deg
    if (longitude_deg > 180) longitude_deg -= 360
    if (longitude_deg < -180) longitude_deg += 360
    x_m = longitude_deg * east_m
    y_m = (latitude_deg - datum_latitude_deg) * north_m
}

# Mean speed and course over ground since the last Status, where the recording has no speed.
function velocity(time_s,    dx_m, dy_m, dt_s, distance_m) {
    ground_speed_mps = course_deg = ""
    if (x_m == "") return
    dt_s = time_s - last_time_s
    if (last_x_m != "" && dt_s > 0 && dt_s <= 5 * interval_s + 60) {
        dx_m = x_m - last_x_m
        dy_m = y_m - last_y_m
        distance_m = sqrt(dx_m * dx_m + dy_m * dy_m)
        ground_speed_mps = sprintf("%.3f", distance_m / dt_s)
        if (distance_m >= 1) {
            course_deg = atan2(dx_m, dy_m) / RADIAN
            course_deg = sprintf("%.2f", course_deg < 0 ? course_deg + 360 : course_deg)
        }
    }
    last_time_s = time_s
    last_x_m = x_m
    last_y_m = y_m
}

function rounded(value, format) { return value == "" ? "" : sprintf(format, value) }

function status(time_s,    speed_mps, heading_deg) {
    velocity(time_s)
    speed_mps = cell("speed_mps")
    if (speed_mps == "" && ground_speed_mps != "") {
        speed_mps = ground_speed_mps
        computed++
    }
    heading_deg = cell("heading_deg")
    if (heading_deg != "" && heading_deg < 0) heading_deg += 360
    print head("Status", time_s) \
        member("x_m", rounded(x_m, "%.2f"), -104800, 104800) \
        member("y_m", rounded(y_m, "%.2f"), -104800, 104800) \
        member("depth_m", cell("depth_m"), -3, 6550) \
        member("altitude_m", cell("altitude_m"), 0, 204) \
        member("speed_mps", speed_mps, 0, 10.2) \
        member("heading_deg", heading_deg, 0, 360) \
        member("course_deg", course_deg, 0, 360) \
        member("pitch_deg", cell("pitch_deg"), -90, 90) \
        member("roll_deg", cell("roll_deg"), -180, 180) "}"
    statuses++
}

function new_profile(time_s) {
    first_s = time_s
    profile = head("Ctd", time_s) \
        member("x_m", rounded(x_m, "%.2f"), -104800, 104800) \
        member("y_m", rounded(y_m, "%.2f"), -104800, 104800) ",\"sample\":["
}

function sample(time_s,    water, depth, late) {
    water = member("temperature_c", cell("temperature_c", "temperature_C"), -5, 60) \
        member("salinity", cell("salinity", "salinity_psu"), 0, 65)
    if (water == "") return
    depth = member("depth_m", cell("depth_m"), -3, 6550)
    if (depth == "") return
    late = time_s < first_s || time_s - first_s > 4095
    if (samples == 35 || samples > 0 && late) send_samples()
    if (samples == 0) new_profile(time_s)
    profile = profile (samples++ ? "," : "") \
        sprintf("{\"offset_s\":%.0f", time_s - first_s) depth water "}"
    all_samples++
}

function send_samples() {
    if (samples == 0) return
    print profile "]}"
    samples = 0
    profiles++
}

BEGIN {
    FS = ","
    RADIAN = atan2(0, -1) / 180
    A_M = 6378137               # WGS84: half axis, eccentricity squared
    E2 = 0.00669437999014
    if (interval_s == "") interval_s = 60
}

{ sub(/\r$/, "") }

NR == 1 {
    for (i = 1; i <= NF; i++) column[$i] = i
    if (!("time_s" in column)) fail("no column time_s")
    next
}

/^[ \t]*$/ { next }

{
    time_s = cell("time_s")
    if (time_s == "" || time_s < 0) {
        dropped["row without time"]++
        next
    }
    if (start_s == "") start_s = time_s
    if (time_s - start_s > 172000 || start_s - time_s > 172000)
        fail("more than two days from the start: the wire's time goes round; cut the recording")
    locate(cell("latitude_deg", "lat_deg"), cell("longitude_deg", "lon_deg"))
    if (last_status_s == "" || time_s < last_status_s || time_s - last_status_s >= interval_s) {
        status(time_s)
        last_status_s = time_s
    }
    sample(time_s)
}

END {
    if (failed) exit 65
    send_samples()
    if (report == "") exit
    printf "%d Status, at most one in %d s; speed computed from positions in %d.\n", \
        statuses, interval_s, computed > report
    printf "%d Ctd with %d samples.\n", profiles, all_samples > report
    if (datum_latitude_deg != "")
        print "Datum: " datum_latitude_deg ", " datum_longitude_deg " (latitude, longitude)" > report
    for (why in dropped) print "Left unset: " why ", " dropped[why] " times" > report
    printf "start_time_s %.0f\n", start_s > report
}
