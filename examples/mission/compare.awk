# compare.awk - are two streams of messages (NDJSON) the same, within half a resolution?
#
# awk -v got=got.ndjson -f compare.awk sent.ndjson
#
# A field that is in one and not in the other differs. Status 0: the same, 1: not so.

# Every leaf of the JSON text into `leaf`: path (such as sample[3].depth_m) to value.
function flatten(text, leaf) {
    JSON = text
    AT = 1
    value("", leaf)
}

function peek() {
    while (substr(JSON, AT, 1) ~ /^[ \t]$/) AT++
    return substr(JSON, AT, 1)
}

function token(    text) {
    peek()
    text = substr(JSON, AT, 400)
    if (!match(text, /^"([^"\\]|\\.)*"/) && !match(text, /^[^][{},: \t]+/)) {
        AT = length(JSON) + 1
        return ""
    }
    AT += RLENGTH
    return substr(text, 1, RLENGTH)
}

function value(path, leaf,    key, i) {
    if (peek() == "{") {
        for (AT++; AT <= length(JSON) && peek() != "}"; ) {
            key = token()
            peek(); AT++
            value((path == "" ? "" : path ".") substr(key, 2, length(key) - 2), leaf)
            if (peek() == ",") AT++
        }
        AT++
    } else if (peek() == "[") {
        for (AT++; AT <= length(JSON) && peek() != "]"; ) {
            value(path "[" i++ "]", leaf)
            if (peek() == ",") AT++
        }
        AT++
    } else leaf[path] = token()
}

function differ(path, a, b) {
    if (++differences > 10) return
    printf "compare.awk: %s:%d: %s was %s, came back %s\n", \
        FILENAME, NR, path, a, b > "/dev/stderr"
}

function compare(path, a, b,    name, difference) {
    compared++
    name = path
    gsub(/.*\./, "", name)
    if (!(name in step)) {
        if (a != b) differ(path, a, b)
        return
    }
    values[name]++
    difference = a - b
    if (difference < 0) difference = -difference
    if (difference > worst[name]) worst[name] = difference
    # 1e-5 of the tolerance for the last bits of a double
    if (b == "" || difference > step[name] / 2 * 1.00001) differ(path, a, b)
}

BEGIN {
    # resolutions of schemas/seautils
    names = split("time_s 0.1 x_m 0.1 y_m 0.1 depth_m 0.1 altitude_m 0.1 speed_mps 0.01 " \
        "heading_deg 0.2 course_deg 0.2 pitch_deg 0.4 roll_deg 0.4 " \
        "temperature_c 0.004 salinity 0.004", table, " ")
    for (i = 1; i < names; i += 2) step[table[i]] = table[i + 1]
}

{
    split("", a)
    split("", b)
    flatten($0, a)
    if ((getline line < got) <= 0) {
        differ("message", "sent", "not at all")
        next
    }
    flatten(line, b)
    for (path in a) compare(path, a[path], path in b ? b[path] : "")
    for (path in b) if (!(path in a)) differ(path, "unset", b[path])
}

END {
    while ((getline line < got) > 0) differ("message", "not sent", line)
    print "field                values  half a step  largest difference"
    for (i = 1; i < names; i += 2) {
        name = table[i]
        if (!(name in values)) continue
        printf "%-16s %10d %12g %19.6f\n", name, values[name], step[name] / 2, worst[name]
    }
    printf "%d values in %d messages compared: ", compared, NR
    if (differences || NR == 0) {
        print differences + 0 " differ"
        exit 1
    }
    print "all the same within half a resolution"
}
