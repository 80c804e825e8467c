# Makes an hour of a sea trial: the tracks of a ship and three vehicles, and what each has to say, when.
#   gawk -v seed=1 -v out=FOLDER -f trial.awk
# Writes out/NAME.csv (time_s,x_m,y_m,depth_m, from 0 to 3600 s) and out/NAME.ndjson (messages, in order of time_s).
# The same seed makes the same files: no random numbers but these.

function random() { # Park and Miller's generator: 16807 modulo 2^31 - 1
    state = state * 16807 % 2147483647
    return state / 2147483647
}

function tenth(x) { return sprintf("%.1f", x) + 0 }

# Where a vehicle is at second t: sets x, y, depth, heading (degrees) and speed.
function ship(t) { # drifts before a light wind
    x = 0.12 * t - 200 + 8 * sin(t / 300)
    y = 0.05 * t - 100 + 8 * cos(t / 400)
    depth = 8 # the transducer's
    heading = 67
    speed = 0.1
}
function auv(t,    lane, along) { # a lawnmower of 800 m lanes, 50 m apart, 15 m deep, at 1.5 m/s
    lane = int(t * 1.5 / 850)
    along = t * 1.5 - lane * 850
    x = 400 + (lane % 2 == 0 ? min(along, 800) : 800 - min(along, 800))
    y = 600 + 50 * lane + max(along - 800, 0)
    depth = 15 + 0.4 * sin(t / 40)
    heading = along > 800 ? 0 : lane % 2 == 0 ? 90 : 270
    speed = 1.5
}
function glider(t,    phase) { # dives to 90 m and comes back every 20 minutes, going north-east
    phase = (t % 1200) / 1200
    x = 1500 + 0.25 * t
    y = 900 + 0.2 * t
    depth = phase < 0.5 ? 180 * phase : 180 * (1 - phase)
    heading = 51
    speed = 0.32
}
function asv(t,    angle) { # circles the trial at the surface, 1400 m from its middle, at 2 m/s
    angle = t * 2 / 1400
    x = 700 + 1400 * cos(angle)
    y = 700 + 1400 * sin(angle)
    depth = 1.5 # the towed transducer's
    heading = (360 - angle * 180 / 3.14159265358979) % 360
    speed = 2
}
function min(a, b) { return a < b ? a : b }
function max(a, b) { return a > b ? a : b }

function move(name, t) {
    if (name == "ship") ship(t)
    else if (name == "auv") auv(t)
    else if (name == "glider") glider(t)
    else asv(t)
}

function say(name, t, message) { printf "%s\n", message > (out "/" name ".ndjson") }

function head(type, t, name, dest) {
    return sprintf("{\"@type\":\"seautils.%s\",\"time_s\":%d,\"src\":%d,\"dest\":%d", type, epoch + t, id[name], dest)
}

function status(name, t) {
    move(name, t)
    say(name, t, head("Status", t, name, 1) sprintf(",\"x_m\":%s,\"y_m\":%s,\"depth_m\":%s,\"speed_mps\":%s,\"heading_deg\":%d,\"state\":\"%s\",\"battery_percent\":%d}",
        tenth(x), tenth(y), tenth(depth), speed, heading, name == "asv" ? "TRANSIT" : "SURVEY", 96 - t / 200))
}

function contact(t) {
    move("auv", t)
    say("auv", t, head("Contact", t, "auv", 1) sprintf(",\"contact_id\":%d,\"sensor_x_m\":%s,\"sensor_y_m\":%s,\"sensor_depth_m\":%s,\"bearing_deg\":%s,\"range_m\":%d,\"target_class\":\"TARGET_MINE_LIKE\",\"confidence_percent\":%d}",
        ++contacts, tenth(x), tenth(y), tenth(depth), tenth(359 * random()), 2 * int(20 + 60 * random()), 40 + 50 * random()))
}

function track(t) {
    say("auv", t, head("Track", t, "auv", 1) sprintf(",\"track_id\":%d,\"state\":\"CONFIRMED\",\"x_m\":%s,\"y_m\":%s,\"depth_m\":%s,\"contact_count\":%d}",
        ++tracks, tenth(400 + 800 * random()), tenth(600 + 400 * random()), tenth(28 + 4 * random()), min(contacts, 62)))
}

# Ten samples of the last five minutes, down or up a profile with a thermocline at 35 m.
function ctd(t,    k, samples, warmth) {
    for (k = 0; k < 10; ++k) {
        move("glider", t - 270 + 30 * k)
        warmth = 8 + 7 / (1 + exp((depth - 35) / 6)) + 0.02 * random()
        samples = samples sprintf("%s{\"offset_s\":%d,\"depth_m\":%s,\"temperature_c\":%.3f,\"salinity\":%.3f}",
            k == 0 ? "" : ",", 30 * k, tenth(depth), warmth, 34.2 + depth / 120)
    }
    move("glider", t - 270)
    say("glider", t, head("Ctd", t, "glider", 1) sprintf(",\"x_m\":%s,\"y_m\":%s,\"sample\":[%s]}", tenth(x), tenth(y), samples))
}

function deploy(t, name, behaviour) {
    say("ship", t, head("DeployCommand", t, "ship", id[name]) sprintf(",\"command_id\":%d,\"behaviour\":\"%s\",\"x_m\":%s,\"y_m\":%s,\"depth_m\":%d,\"speed_mps\":%s}",
        ++commands, behaviour, tenth(1000 * random()), tenth(1000 * random()), name == "asv" ? 0 : 20, name == "glider" ? 0.3 : 1.5))
}

BEGIN {
    state = seed * 7919 % 2147483646 + 1
    epoch = 1714564800 # 2024-05-01T12:00:00Z
    id["ship"] = 1
    id["auv"] = 2
    id["glider"] = 3
    id["asv"] = 4
    split("ship auv glider asv", names, " ")
    for (k = 1; k <= 4; ++k) {
        name = names[k]
        print "time_s,x_m,y_m,depth_m" > (out "/" name ".csv")
        for (t = 0; t <= 3600; t += 10) {
            move(name, t)
            printf "%d,%.1f,%.1f,%.1f\n", t, x, y, depth > (out "/" name ".csv")
        }
    }
    next_contact = 200
    for (t = 0; t < 3600; ++t) {
        if (t % 120 == 30) status("auv", t)
        if (t % 180 == 50) status("glider", t)
        if (t % 90 == 70) status("asv", t)
        if (t == next_contact) {
            contact(t)
            next_contact += 40 + int(240 * random())
        }
        if (t % 420 == 400) track(t)
        if (t % 300 == 299) ctd(t)
        if (t == 240) deploy(t, "auv", "LAWNMOWER")
        if (t == 960) deploy(t, "asv", "STATION_KEEP")
        if (t == 1500) deploy(t, "glider", "YOYO")
        if (t == 2400) deploy(t, "auv", "LOITER")
        if (t == 3000) deploy(t, "asv", "RETURN")
    }
}
