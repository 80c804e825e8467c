#!/usr/bin/env bats
# depth-plan decides on depths, of losses and of what a vehicle knows; link-stats says what a log tells.

setup() {
    load test_helper
    cd "$BATS_TEST_TMPDIR" || return
    # least loss at 30 m near by, at 60 m farther out
    printf '%s\n' 'depth_m,100,200,300,400,500,600,700' \
        '10,80,82,84,86,88,90,92' '30,70,72,74,86,88,90,92' \
        '60,80,82,84,76,78,80,82' '90,85,85,85,85,,,inf' > losses.csv
    state='{"time":"2024-05-01T12:00:00Z","depth_m":20,"speed_mps":1,"heading_deg":90,"x_m":150,"y_m":0,"water_depth_m":100,"contact":{"x_m":0,"y_m":0}}'
    # a model that answers as often as it is asked, and notes what
    cat > model << 'END'
#!/usr/bin/env bash
while read -r line; do
    printf '%s\n' "$line" >> asked
    id=$(jq .id <<< "$line")
    printf '{"id":%s,"depth_m":[10,30,60],"range_m":[50,500],"tl_db":[80,90,70,80,75,"Infinity"]}\n' "$id"
done
END
    chmod +x model
}

# field FILTER: of the decisions on standard input.
field() { jq -c "$1"; }

# assert_refused WHAT COMMAND OPTION...: status 64, one line, nothing on standard output.
assert_refused() {
    local said=$1
    shift
    run -64 --separate-stderr depth-plan "$@" < /dev/null
    assert_output ''
    # shellcheck disable=SC2154  # run sets it
    assert_equal "$stderr" "depth-plan: $said"
}

@test "depth-plan acomms: the depth of least loss in the window ahead" {
    run_quiet depth-plan acomms --loss losses.csv <<< "$state"
    # from 150 m, 1 m/s for 120 s, directly away
    assert_equal "$(field '[.time, .depth_m, .rule, .range_m, .range_rate_mps, .window_from_m, .window_to_m, .loss_limit_db]' <<< "$output")" \
        '["2024-05-01T12:00:00Z",30,"BEST",150,1,150,270,108]'
    assert_equal "$(field '[.curve_depth_m, .reason, .bound_by]' <<< "$output")" '[[10,30,60,90],"highest utility over 150 to 270 m",null]'
    # one range in the window: 1 - 72 / 108
    assert_equal "$(field '[.tl_db, .utility]' <<< "$output")" '[72,0.333333]'
    # two of them: 200 and 300 m, -10 lg((10^-7.2 + 10^-7.4) / 2) = 72.89
    assert_equal "$(depth-plan acomms --horizon 200 --loss losses.csv <<< "$state" | field .tl_db)" 72.89
    assert_equal "$(depth-plan acomms --loss losses.csv --loss-limit window <<< "$state" | field .loss_limit_db)" 85
}

@test "depth-plan acomms: opening and closing, by positions, degrees, range and bearing" {
    at() { depth-plan acomms --loss losses.csv | field "[.range_m, .range_rate_mps, .window_from_m, .window_to_m, .depth_m]"; }
    assert_equal "$(at <<< "${state/90/270}")" '[150,-1,30,150,30]'
    assert_equal "$(at <<< '{"depth_m":20,"range_m":450,"range_rate_mps":-1}')" '[450,-1,330,450,60]'
    assert_equal "$(at <<< '{"depth_m":20,"speed_mps":2,"heading_deg":10,"range_m":450,"bearing_deg":70}')" '[450,-1,330,450,60]'
    # a range that grows from one record to the next
    assert_equal "$(printf '%s\n' '{"time":"2024-05-01T12:00:00Z","depth_m":20,"range_m":400}' '{"time":"2024-05-01T12:00:10Z","range_m":390}' | at | tail -1)" \
        '[390,-1,270,390,30]'
    # a minute of latitude at 45° is 1852.2 m: a tenth of one north of the contact
    run_quiet depth-plan acomms --loss losses.csv <<< '{"depth_m":20,"speed_mps":1,"heading_deg":0,"latitude_deg":45.0016667,"longitude_deg":10,"contact":{"latitude_deg":45,"longitude_deg":10}}'
    assert_equal "$(field '[.range_m, .range_rate_mps]' <<< "$output")" '[185.2,1]'
    # at range zero, moving away
    assert_equal "$(at <<< '{"depth_m":20,"range_m":0,"range_rate_mps":1}')" '[0,1,0,120,30]'
    assert_equal "$(at <<< '{"depth_m":20,"speed_mps":1,"heading_deg":0,"x_m":0,"y_m":0,"contact":{"x_m":0,"y_m":0}}')" '[0,1,0,120,30]'
}

@test "depth-plan acomms: what is said in parts is merged, and moves on" {
    run_quiet depth-plan acomms --loss losses.csv << 'END'
{"time":"2024-05-01T12:00:00Z","x_m":100,"y_m":0,"speed_mps":2,"heading_deg":90}
{"time":"2024-05-01T12:00:10Z","contact":{"x_m":0,"y_m":0}}
{"time":"2024-05-01T12:00:20Z","depth_m":20}
END
    assert_equal "$(field '[.depth_m, .range_m, .reason]' <<< "${lines[0]}")" '[null,null,"the own depth is not known"]'
    assert_equal "$(field '[.depth_m, .reason]' <<< "${lines[1]}")" '[null,"the own depth is not known"]'
    assert_equal "$(field '[.depth_m, .range_m]' <<< "${lines[2]}")" '[30,140]'
}

@test "depth-plan: states from a table are those of the records" {
    cat > states.csv << 'END'
# a dive
time, depth_m, speed_mps, heading_deg, x_m, y_m, water_depth_m, contact.x_m, contact.y_m, contact.depth_m, battery
2024-05-01T12:00:00Z,20,1,90,150,0,100,0,0,30,full
2024-05-01T12:01:00.5Z,25,,,,,,,,,

@1714564920,30,2,+90,200,0.0,,,,,x
END
    cat > states.ndjson << 'END'
{"time":"2024-05-01T12:00:00Z","depth_m":20,"speed_mps":1,"heading_deg":90,"x_m":150,"y_m":0,"water_depth_m":100,"contact":{"x_m":0,"y_m":0,"depth_m":30}}
{"time":"2024-05-01T12:01:00.5Z","depth_m":25}
{"time":"2024-05-01T12:02:00Z","depth_m":30,"speed_mps":2,"heading_deg":90,"x_m":200,"y_m":0}
END
    for command in acomms snr; do
        depth-plan $command --loss losses.csv states.ndjson > wanted
        assert_equal "$(wc -l < wanted)" 3
        run_quiet depth-plan $command --loss losses.csv states.csv
        assert_equal "$output" "$(cat wanted)"
        run_quiet depth-plan $command -F csv --loss losses.csv < states.csv
        assert_equal "$output" "$(cat wanted)"
    done
    # the model is told the contact's depth
    depth-plan acomms --model ./model states.csv > /dev/null
    assert_equal "$(jq -c .source.depth_m asked | head -1)" 30
    # the columns of a log of poscode; each file has its own; CR LF; what is no state is in JSON between
    printf '\xEF\xBB\xBFlat,lon,t,depth,roll\r\n45.0016667,10,1714564800,20,3\r\n' > earth.csv
    printf 'depth_m,contact.longitude_deg,contact.latitude_deg\n20,10,45\n' > contact.csv
    run_quiet depth-plan acomms --clock input --loss losses.csv earth.csv contact.csv
    assert_equal "$(field '[.time, .range_m, .depth_m]' <<< "${lines[1]}")" '["2024-05-01T12:00:00Z",185.2,30]'
    run_quiet depth-plan acomms <<< $'depth_m,range_m\n20,150\n{"depth_m":[10,50],"range_m":[100,300],"tl_db":[90,90,60,60]}\n20,150'
    assert_equal "$(field .depth_m <<< "$output" | xargs)" 'null 50'
}

@test "depth-plan: a bad row of states is located, dropped, and makes the status 1" {
    bad() {
        run -1 --separate-stderr depth-plan acomms --loss losses.csv <<< "time,depth_m,range_m"$'\n'"$1"$'\n'",20,150"
        assert_equal "$stderr" "depth-plan: <stdin>:2: $2"
        assert_equal "$(field .depth_m <<< "$output")" 30
    }
    bad ',20' '2 cells where the header has 3'
    bad ',20,150,' '4 cells where the header has 3'
    bad ',x,150' "depth_m 'x' is no number"
    bad ',nan,150' "depth_m 'nan' is no number"
    bad ',99999,150' 'depth_m 99999 is outside 0 to 12000 m'
    bad 'noon,20,150' "time 'noon' is not of the form 2024-05-01T12:00:25Z"
    run -1 --separate-stderr depth-plan acomms --loss losses.csv <<< $'a,b\n20,150'
    assert_equal "${stderr%%$'\n'*}" "depth-plan: <stdin>:1: 'a,b' stands below no header that names depth_m or another column that is known"
    run -1 --separate-stderr depth-plan acomms --loss losses.csv -F ndjson <<< 'depth_m,range_m'
    assert_regex "$stderr" '^depth-plan: <stdin>:1: '
    run -1 --separate-stderr depth-plan acomms --loss losses.csv -F csv <<< "$state"
    assert_regex "$stderr" "^depth-plan: <stdin>:1: '.*' stands below no header"
    run -65 --separate-stderr depth-plan acomms --strict --loss losses.csv <<< $'depth_m,range_m\n20\n20,150'
    assert_output ''
}

@test "depth-plan: limits win, and say so" {
    run_quiet depth-plan acomms --loss losses.csv --max-depth 25 <<< "$state"
    assert_equal "$(field '[.depth_m, .rule, .free_depth_m, .bound_by]' <<< "$output")" '[25,"BEST",30,["most_depth"]]'
    assert_equal "$(field .reason <<< "$output")" '"highest utility over 150 to 270 m; without limits 30.0 m, forbidden by most_depth"'
    assert_equal "$(depth-plan acomms --loss losses.csv --min-altitude 75 <<< "$state" | field '[.depth_m, .bound_by]')" '[25,["least_altitude"]]'
    assert_equal "$(depth-plan acomms --loss losses.csv --min-altitude 75 <<< "${state/\"water_depth_m\":100/\"altitude_m\":60}" | field '[.depth_m, .bound_by]')" '[5,["least_altitude"]]'
    assert_equal "$(depth-plan acomms --loss losses.csv --exclude 20,40 --exclude 70,80 <<< "$state" | field '[.depth_m, .bound_by]')" '[40,["excluded_band"]]'
    # the water's depth is not known: no deeper than now
    assert_equal "$(depth-plan acomms --loss losses.csv --min-altitude 5 <<< "${state/\"water_depth_m\":100,/}" | field '[.depth_m, .bound_by]')" '[20,["water_depth_unknown"]]'
    # also where nothing is known to plan with
    run_quiet depth-plan acomms --max-depth 15 <<< "$state"
    assert_equal "$(field '[.depth_m, .rule, .bound_by, .reason]' <<< "$output")" '[15,"LIMIT",["most_depth"],"no losses are known"]'
    # nothing is allowed at all
    run_quiet depth-plan acomms --loss losses.csv --min-depth 50 --max-depth 40 <<< "$state"
    assert_equal "$(field '[.depth_m, .rule, .bound_by]' <<< "$output")" '[null,"NONE",["least_depth"]]'
}

@test "depth-plan acomms: profiles are averaged; where they differ nothing sharp is left" {
    sed 's/^30,70,72,74/30,90,92,94/' losses.csv > other.csv
    run_quiet depth-plan acomms --loss losses.csv --loss other.csv <<< "$state"
    # -10 lg((10^-7.2 + 10^-9.2) / 2) = 74.97
    assert_equal "$(field '.tl_db' <<< "$output")" 74.97
    one=$(depth-plan acomms --loss losses.csv <<< "$state" | field '.curve_utility | .[1] - .[0]')
    two=$(field '.curve_utility | .[1] - .[0]' <<< "$output")
    sharp=$(depth-plan acomms --uncertainty 1000 --loss losses.csv --loss other.csv <<< "$state" | field '.curve_utility | .[1] - .[0]')
    [[ $(awk "BEGIN { print ($two < $sharp / 5 && $sharp < $one && $sharp > 0.05) }") == 1 ]] || fail "$one $sharp $two"
    printf 'z,100\n5,80\n' > odd.csv
    run -1 --separate-stderr depth-plan acomms --loss losses.csv --loss odd.csv <<< "$state"
    assert_equal "$stderr" 'depth-plan: <stdin>:1: the fields of the profiles have different depths'
}

@test "depth-plan: other objectives are combined by weight, and what is written is one again" {
    shallow='{"name":"shallow","weight":3,"depth_m":[0,20],"utility":[1,0]}'
    run_quiet depth-plan acomms --loss losses.csv <<< "$shallow"$'\n'"$state"
    assert_equal "$(field .depth_m <<< "$output")" 10
    # a later one of the same name takes its place
    run_quiet depth-plan acomms --loss losses.csv <<< "$shallow"$'\n'"${shallow/3/0}"$'\n'"$state"
    assert_equal "$(field .depth_m <<< "$output")" 30
    run_quiet depth-plan acomms --loss losses.csv --weight 5 --max-depth 50 -f objective <<< "$state"
    objective=$output
    assert_equal "$(field '[.name, .weight, .depth_m]' <<< "$objective")" '["acomms",5,[10,10,30,50,50]]'
    assert_equal "$(field '.utility | [.[0], .[-1], (max * 10000 | round)]' <<< "$objective")" '[0,0,3333]'
    run_quiet depth-plan acomms --loss losses.csv --weight 0 <<< "$objective"$'\n'"$state"
    assert_equal "$(field .depth_m <<< "$output")" 30
    # excluded bands are steps
    run_quiet depth-plan acomms --loss losses.csv --exclude 20,40 -f objective <<< "$state"
    assert_equal "$(field .depth_m <<< "$output")" '[10,10,20,20,40,40,60,90,90]'
    assert_equal "$(field '[.utility[2] > 0.28, .utility[3], .utility[4], .utility[5] > 0.28]' <<< "$output")" '[true,0,0,true]'
}

@test "depth-plan: an answer of tl-model in the input counts from then on" {
    answer='{"depth_m":[10,50],"range_m":[100,300],"tl_db":[90,"NaN",60,60],"basis":{"engine":"rays"}}'
    run_quiet depth-plan acomms <<< "$state"$'\n'"$answer"$'\n'"$state"
    assert_equal "$(field '[.depth_m, .reason]' <<< "${lines[0]}")" '[null,"no losses are known"]'
    assert_equal "$(field .depth_m <<< "${lines[1]}")" 50
    printf '%s\n' "$answer" > answer.ndjson
    assert_equal "$(depth-plan acomms --loss answer.ndjson <<< "$state" | field .depth_m)" 50
}

@test "depth-plan: no losses, all without a value, beyond the losses" {
    run_quiet depth-plan acomms <<< "$state"
    assert_equal "$(field '[.depth_m, .rule, .reason]' <<< "$output")" '[null,"NONE","no losses are known"]'
    printf 'z,100,700\n10,,nan\n20,,nan\n' > empty.csv
    for command in acomms snr; do
        run_quiet depth-plan $command --loss empty.csv <<< "$state"
        assert_equal "$(field '[.depth_m, .rule]' <<< "$output")" '[null,"NONE"]'
        assert_regex "$output" 'no allowed depth has a loss'
    done
    run_quiet depth-plan acomms --loss losses.csv <<< '{"depth_m":20,"range_m":5000}'
    assert_equal "$(field '[.depth_m, .reason]' <<< "$output")" '[null,"the losses do not reach as far as the window"]'
    run_quiet depth-plan acomms --loss losses.csv <<< '{"depth_m":20,"range_m":700,"range_rate_mps":5}'
    assert_regex "$output" 'part of which has no losses'
    run_quiet depth-plan acomms --loss losses.csv <<< '{"depth_m":20}'
    assert_equal "$(field .reason <<< "$output")" '"the range to the contact is not known"'
}

@test "depth-plan: a contact of long ago is not known; a clock that steps back makes nothing old" {
    contact='{"time":"2024-05-01T12:00:00Z","range_m":200}'
    run_quiet depth-plan acomms --loss losses.csv --max-age 60 <<< "$contact"$'\n{"time":"2024-05-01T12:01:01Z","depth_m":20}'
    assert_equal "$(field .reason <<< "${lines[1]}")" '"where the contact is was said 61 s ago, at most 60 s count"'
    run_quiet depth-plan acomms --loss losses.csv --max-age 60 <<< "$contact"$'\n{"time":"2024-05-01T11:00:00Z","depth_m":20}'
    assert_equal "$(field '[.time, .depth_m, .range_m]' <<< "${lines[1]}")" '["2024-05-01T11:00:00Z",30,200]'
}

@test "depth-plan: --every, --clock input, and steps back" {
    for time in 12:00:00 12:00:30 12:01:00 11:00:00 11:00:30; do
        echo "${state/12:00:00/$time}"
    done > log
    run_quiet depth-plan acomms --loss losses.csv --every 60 log
    assert_equal "$(field .time <<< "$output" | xargs)" '2024-05-01T12:00:00Z 2024-05-01T12:01:00Z 2024-05-01T11:00:00Z'
    # a record without a time is of the latest before it
    run_quiet depth-plan acomms --loss losses.csv --clock input <<< "$state"$'\n{"depth_m":21}'
    assert_equal "$(field .time <<< "${lines[1]}")" '"2024-05-01T12:00:00Z"'
    run_quiet depth-plan acomms --loss losses.csv --clock input <<< '{"depth_m":21,"range_m":200}'
    assert_equal "$(field '[.time, .depth_m]' <<< "$output")" '[null,30]'
}

# --- snr ---

@test "depth-plan snr: where it is good it follows, else it meets the best depth at the least pitch" {
    # the best depth sinks from 1000 m at 0 by 100 m a km
    awk 'BEGIN { printf "z"; for (r = 1000; r <= 40000; r += 500) printf ",%d", r
        for (z = 0; z <= 5000; z += 50) { printf "\n%d", z
            for (r = 1000; r <= 40000; r += 500) { d = z - 1000 - r / 10; printf ",%.2f", 80 + (d < 0 ? -d : d) / 100 } } print "" }' > ridge.csv
    at() { echo "{\"depth_m\":$1,\"speed_mps\":1.5,\"range_m\":10000,\"range_rate_mps\":5}"; }
    plan=(depth-plan snr --loss ridge.csv --smoothing 0)
    run_quiet "${plan[@]}" <<< "$(at 2000)"
    # 360 s on, 1800 m farther out, 180 m deeper
    assert_equal "$(field '[.rule, .ahead_s, .depth_m]' <<< "$output")" '["FOLLOW",360,2200]'
    # 1.5 m/s for 360 s, 200 m down: asin(200 / 540) = 21.7°, of which 20 are allowed
    assert_equal "$(field .pitch_deg <<< "$output")" 20
    assert_equal "$("${plan[@]}" --max-pitch 30 <<< "$(at 2000)" | field .pitch_deg)" 21.74
    # after 4000 s the ridge is at 4000 m
    run_quiet "${plan[@]}" <<< "$(at 4000)"
    assert_equal "$(field '[.rule, .depth_m, .pitch_deg]' <<< "$output")" '["APPROACH",4000,0]'
    run_quiet "${plan[@]}" --horizon 600 <<< "$(at 4000)"
    assert_equal "$(field '[.rule, .pitch_deg, .ahead_s]' <<< "$output")" '["STEEPEST",-20,600]'
    assert_regex "$output" 'too steep; least so for the best depth in 600 s at 13000 m range'
    run_quiet "${plan[@]}" <<< '{"depth_m":4990,"range_m":10000}'
    assert_equal "$(field '[.depth_m, .reason]' <<< "$output")" '[null,"no depth ahead can be reached without speed"]'
    run_quiet "${plan[@]}" --max-depth 1500 <<< "$(at 1500)"
    assert_equal "$(field '[.depth_m, .bound_by]' <<< "$output")" '[1500,["most_depth"]]'
}

@test "depth-plan snr: noise and gain over depth count by their weights" {
    printf 'z,100,5000\n0,80,80\n1000,80,80\n2000,80,80\n' > flat.csv
    here='{"depth_m":10,"speed_mps":2,"range_m":1000}'
    plan=(depth-plan snr --loss flat.csv --smoothing 0 --near 0)
    assert_equal "$("${plan[@]}" --critical-depth 500 <<< "$here" | field .depth_m)" 2000
    assert_equal "$("${plan[@]}" --critical-depth 500 --noise-slope 3 <<< "${here/10/2000}" | field .depth_m)" 0
    printf 'depth_m,noise_db\n0,60\n1000,50\n2000,60\n' > noise.csv
    assert_equal "$("${plan[@]}" --noise noise.csv <<< "$here" | field .depth_m)" 1000
    printf '0,0\n1000,-10\n2000,1\n' > gain.csv
    assert_equal "$("${plan[@]}" --array-gain gain.csv <<< "$here" | field .depth_m)" 2000
    assert_equal "$("${plan[@]}" --noise noise.csv --array-gain gain.csv --gain-weight 0.5 <<< "$here" | field .depth_m)" 1000
    printf '0,0\n0,1\n' > wrong.csv
    run -65 --separate-stderr "${plan[@]}" --noise wrong.csv <<< "$here"
    assert_equal "$stderr" "depth-plan: wrong.csv:2: depth_m '0' does not grow"
}

@test "depth-plan snr: profiles are averaged; where they differ nothing sharp is left" {
    # least loss at 1000 m by one profile, at 1500 m by the other, which knows a little less of it
    awk 'BEGIN { print "z,100,5000"; for (z = 0; z <= 3000; z += 100) { l = 90 - 20 * exp(-((z - 1000) / 200) ^ 2); print z "," l "," l } }' > first.csv
    awk 'BEGIN { print "z,100,5000"; for (z = 0; z <= 3000; z += 100) { l = 90 - 18 * exp(-((z - 1500) / 200) ^ 2); print z "," l "," l } }' > second.csv
    here='{"depth_m":1000,"speed_mps":2,"range_m":1000,"range_rate_mps":0}'
    plan=(depth-plan snr --smoothing 0 --loss first.csv)
    assert_equal "$("${plan[@]}" <<< "$here" | field '[.depth_m, .tl_db, .utility]')" '[1000,70,1]'
    run_quiet "${plan[@]}" --uncertainty 1000 --loss second.csv <<< "$here"
    # -10 lg((10^-7 + 10^-8.997) / 2), whichever file is the last
    assert_equal "$(field '[.depth_m, .tl_db]' <<< "$output")" '[1000,72.97]'
    sharp=$(field '.curve_utility | max - min' <<< "$output")
    flat=$("${plan[@]}" --loss second.csv <<< "$here" | field '.curve_utility | max - min')
    [[ $(awk "BEGIN { print ($flat < $sharp / 3 && $sharp > 0.99 && $flat > 0.01) }") == 1 ]] || fail "$sharp $flat"
    # the model is asked for each of the last profiles
    profile='{"depth_m":[0,100],"sound_speed_mps":[1500,1490]}'
    run_quiet depth-plan snr --model ./model --instances 2 <<< "$profile"$'\n'"${profile/1490/1510}"$'\n'"$state"
    assert_equal "$(jq -c '.profile.sound_speed_mps[1]' asked | xargs)" '1490 1510'
    # an answer in the input takes the place of as many as there are
    answer='{"depth_m":[10,50],"range_m":[100,300],"tl_db":[90,90,60,60]}'
    run_quiet depth-plan snr --loss first.csv --loss second.csv <<< "$answer"$'\n'"$state"
    assert_equal "$(field '[.curve_depth_m, .depth_m]' <<< "$output")" '[[10,50],50]'
    run -1 --separate-stderr depth-plan snr --loss first.csv --loss losses.csv <<< "$state"
    assert_equal "$stderr" 'depth-plan: <stdin>:1: the fields of the profiles have different depths'
}

# --- a model as a partner ---

@test "depth-plan: a model is asked for what is needed, when it is" {
    run_quiet depth-plan acomms --model ./model --range-step 20 --depth-step 2 <<< "${state/\"y_m\":0\}/\"y_m\":0,\"depth_m\":30\}}"
    assert_equal "$(field '[.depth_m, .stale]' <<< "$output")" '[30,null]'
    # the window from 150 to 270 m, and as far beyond as ten steps, in whole steps; half of the water's depth in steps, but its ends
    assert_equal "$(jq -c '[.source.depth_m, .receivers.ranges.start_m, .receivers.ranges.stop_m, .bottom_depth_m, .receivers.depths.count, .loss]' asked)" \
        '[30,20,480,100,50,true]'
    # the same window again, then one a little on, then one beyond, then another depth of the source
    rm asked
    run_quiet depth-plan acomms --model ./model <<< "$state"$'\n'"$state"$'\n'"${state/150/160}"$'\n'"${state/150/420}"$'\n'"${state/150/420}"
    assert_equal "$(wc -l < asked)" 2
    assert_equal "$(jq -c .id asked | xargs)" '1 2'
    # each profile is passed on, and the last of them are averaged
    rm asked
    profile='{"depth_m":[0,100],"sound_speed_mps":[1500,1490]}'
    run_quiet depth-plan acomms --model ./model --instances 2 <<< "$state"$'\n'"$profile"$'\n'"$state"$'\n'"${profile/1490/1510}"$'\n'"$state"$'\n'"${profile/1490/1520}"$'\n'"$state"
    assert_equal "$(jq -c '.profile.sound_speed_mps[1]' asked | xargs)" 'null 1490 1490 1510 1510 1520'
    assert_equal "${#lines[@]}" 4
}

@test "depth-plan: a model that dies leaves what was known, marked as stale" {
    cat > dying << 'END'
#!/usr/bin/env bash
read -r line && ./model <<< "$line"
read -r line && exit 3
END
    chmod +x dying
    far=${state/150/420}
    run -1 --separate-stderr depth-plan acomms --model ./dying <<< "$state"$'\n'"$far"$'\n'"$far"$'\n'"${far/12:00:00/12:00:05}"
    assert_equal "$stderr" "depth-plan: <stdin>:2: model './dying': it ended without an answer (status 3)"
    # left alone for a second, then asked again
    assert_equal "$(field '[.depth_m, .stale]' <<< "$output" | xargs)" '[30,null] [30,true] [30,true] [30,null]'
    run -65 --separate-stderr depth-plan acomms --strict --model ./dying <<< "$state"$'\n'"$far"$'\n'"$far"
    assert_equal "${#lines[@]}" 2
}

@test "depth-plan: a model that says nothing, nonsense, an error, or is not there" {
    refused() {
        local said=$1
        shift
        run -1 --separate-stderr depth-plan acomms --model-timeout 0.3 --model "$@" <<< "$state"
        assert_equal "$stderr" "depth-plan: <stdin>:1: model '$*': $said"
        assert_equal "$(field '[.depth_m, .reason]' <<< "$output")" '[null,"no losses are known"]'
    }
    refused 'no answer within 0.3 s' 'sleep 100'
    refused 'No such file or directory' ./gone
    printf '#!/bin/sh\nread -r l; echo hello; cat > /dev/null\n' > nonsense
    printf '#!/bin/sh\nread -r l; echo "{\\"id\\":1,\\"error\\":\\"frequency_hz is not given\\"}"; cat > /dev/null\n' > error
    printf '#!/bin/sh\nread -r l; echo "{\\"id\\":7,\\"depth_m\\":[1],\\"range_m\\":[1],\\"tl_db\\":[1]}"\n' > other
    printf '#!/bin/sh\nread -r l; echo "{\\"id\\":1,\\"depth_m\\":[1],\\"range_m\\":[1],\\"tl_db\\":[1,2]}"\n' > short
    chmod +x nonsense error other short
    refused 'frequency_hz is not given' ./error
    refused 'it answered something that was not asked' ./other
    refused 'tl_db has 2 values where 1 depths and 1 ranges need 1' ./short
    run -1 --separate-stderr depth-plan acomms --model ./nonsense <<< "$state"
    assert_regex "$stderr" "^depth-plan: <stdin>:1: model './nonsense': "
    [[ ! $stderr =~ $'\n' ]] || fail "$stderr"
    # one that never reads
    refused 'no answer within 0.3 s' 'tail -f /dev/null'
    ! pgrep -f 'sleep 100' -P $$ > /dev/null || fail 'it was left behind'
}

# --- link-stats ---

@test "depth-plan link-stats: the published probabilities, with their bands" {
    paste -d, <(printf '%s\n' depth_m 10 12 18 20 25 26 31 33 40 41 47 52) \
        <(printf '%s\n' received 0 0 1 0 1 0 1 1 1 0 1 1) > log.csv
    run_quiet depth-plan link-stats --bandwidth 10 --min-depth 15 --max-depth 45 --depth-step 10 log.csv
    assert_equal "$(field '[.samples, .received, .depth_m, .probability]' <<< "$output")" \
        '[12,7,[15,25,35,45],[0.274096,0.590588,0.754438,0.72549]]'
    assert_equal "$(field '[.low[0] < 0.1, .high[0] > 0.6, .bandwidth_m]' <<< "$output")" '[true,true,10]'
    # by itself: 2.345 σ n^(-1/5), σ = 13.5208
    assert_equal "$(depth-plan link-stats log.csv | field .bandwidth_m)" 19.289
    run_quiet depth-plan link-stats --bandwidth 10 --min-depth 15 --max-depth 25 --depth-step 10 -f csv log.csv
    assert_line --index 0 range_from_m,range_to_m,depth_m,probability,low,high,share
    assert_line --index 1 --partial ,,15,0.274096,
    # where less than a share was sent nothing is said
    run_quiet depth-plan link-stats --bandwidth 2 --depth-step 1 --min-depth 0 --max-depth 60 log.csv
    assert_equal "$(field '[.depth_m[0], .depth_m[-1]]' <<< "$output")" '[9,53]'
    # and as records
    awk -F, 'NR > 1 { printf "{\"depth_m\":%d,\"received\":%s}\n", $1, $2 ? "true" : "false" }' log.csv |
        depth-plan link-stats --bandwidth 10 > got
    assert_equal "$(cat got)" "$(depth-plan link-stats --bandwidth 10 log.csv)"
}

@test "depth-plan link-stats: bins of range, losses and rates" {
    awk 'BEGIN { print "time,range_m,depth_m,received,rate"
        for (k = 0; k < 200; ++k) print k, k * 5, 10 + k % 3, k < 100, k % 2 }' | tr ' ' , > log.csv
    run_quiet depth-plan link-stats --ranges 0,500 --ranges 500,1000 log.csv
    assert_equal "$(field 'select(.bandwidth_m) | [.range_from_m, .range_to_m, .samples, .received]' <<< "$output" | xargs)" '[0,500,100,100] [500,1000,100,0]'
    run_quiet depth-plan link-stats -f csv --ranges 500,1000 log.csv
    assert_line --index 1 --partial 500,1000,10,0,
    # losses of a field: 60 dB at 0 m, 160 dB at 1000 m
    printf 'z,0,500,1000\n0,60,110,160\n20,60,110,160\n' > losses.csv
    run_quiet depth-plan link-stats --loss losses.csv log.csv
    assert_equal "$(field 'select(.threshold_db) | [.rate, .samples, .received, .threshold_errors]' <<< "$output" | xargs)" '[null,200,100,0] [0,100,50,0] [1,100,50,0]'
    # the last that was received, at 495 m, had 0.01 of the intensity at 0 m: 80.0 dB; the first that was lost 110 dB
    assert_equal "$(field 'select(.threshold_db and .rate == null) | [.threshold_db, .loss_limit_db] | map(. * 10 | round)' <<< "$output")" '[950,770]'
}

@test "depth-plan link-stats: a picture" {
    command -v gnuplot > /dev/null || skip "gnuplot is not installed"
    printf 'depth_m,received\n10,1\n20,0\n30,1\n' > log.csv
    for file in curve.svg curve.png; do
        run_quiet depth-plan link-stats --plot $file log.csv
        assert [ "$(wc -c < $file)" -gt 1000 ]
    done
    assert_refused "option --plot: 'curve.pdf' ends neither in .png nor .svg" link-stats --plot curve.pdf log.csv
}

# --- what every tool does ---

@test "depth-plan: binary output is the message that the schema declares" {
    decode() { protoc -I "$SEAUTILS_ROOT/schemas" --decode "seautils.$1" seautils/plan.proto; }
    depth-plan acomms --loss losses.csv --max-depth 25 -f delimited <<< "$state" > one.bin
    # the length in front is a varint of two bytes here
    tail -c +3 one.bin | decode DepthDecision > decoded
    run cat decoded
    assert_line 'depth_m: 25'
    assert_line 'rule: BEST'
    assert_line 'bound_by: "most_depth"'
    assert_line 'range_rate_mps: 1'
    assert_line 'curve_depth_m: 90'
    refute_line --regexp '^[0-9]+:' # nothing that the schema does not know
    depth-plan snr --loss losses.csv -f delimited <<< "$state" | tail -c +3 | decode DepthDecision > decoded
    run cat decoded
    assert_line --regexp '^(rule: (FOLLOW|APPROACH|STEEPEST))$'
    assert_line --regexp '^ahead_s: '
    refute_line --regexp '^[0-9]+:'
    printf 'depth_m,received,tl_db,rate\n10,1,80,2\n' > log.csv
    depth-plan link-stats -f delimited log.csv | tail -c +2 | head -c "$(($(depth-plan link-stats -f delimited log.csv | od -An -tu1 -N1)))" | decode ReceiptCurve > decoded
    run cat decoded
    assert_line 'samples: 1'
    assert_line 'probability: 1'
}

@test "depth-plan: csv, too" {
    run_quiet depth-plan acomms --loss losses.csv -f csv --max-depth 25 <<< "$state"$'\n'"$state"
    assert_line --index 0 time,depth_m,rule,utility,range_m,window_from_m,window_to_m,tl_db,pitch_deg,bound_by,stale
    assert_line --index 1 --regexp '^2024-05-01T12:00:00Z,25,BEST,0\.[0-9]*,150,150,270,72,,most_depth,0$'
    assert_equal "${#lines[@]}" 3
}

@test "depth-plan: a bad record is located, dropped, and makes the status 1" {
    bad() {
        run -1 --separate-stderr depth-plan acomms --loss losses.csv <<< "$1"$'\n'"$state"
        assert_equal "$stderr" "depth-plan: <stdin>:1: $2"
        assert_equal "$(field .depth_m <<< "$output")" 30
    }
    bad '{"depth_m":99999}' 'depth_m 99999 is outside 0 to 12000 m'
    bad '{"depth_m":20,"x_m":5}' 'x_m and y_m come together'
    bad '{"contact":{"latitude_deg":91,"longitude_deg":0}}' 'latitude_deg 91 is outside -90 to 90 degrees'
    bad '{"water_depth_m":"NaN"}' 'water_depth_m nan is outside 0.1 to 12000 m'
    bad '{"name":"o","depth_m":[1,2],"utility":[0,2]}' "objective 'o': utility 2 is outside 0 to 1"
    bad '{"depth_m":[1],"range_m":[5,4],"tl_db":[1,2]}' 'range_m 4 does not grow after 5'
    bad '{"id":1,"error":"no","tl_db":[]}' no
    run -1 --separate-stderr depth-plan acomms --loss losses.csv <<< '{"dept_m":3}'$'\n'"$state"
    assert_regex "$stderr" "^depth-plan: <stdin>:1: .*dept_m"
    run -65 --separate-stderr depth-plan acomms --strict --loss losses.csv <<< '{"depth_m":-1}'$'\n'"$state"
    assert_output ''
    run -1 --separate-stderr depth-plan link-stats <<< $'depth_m,received\n5,1\n5,2\n'
    assert_equal "$stderr" "depth-plan: <stdin>:3: received '2' is none of 1, 0, true, false, yes, no"
    run -66 --separate-stderr depth-plan acomms --loss gone.csv
    assert_equal "$stderr" 'depth-plan: gone.csv: No such file or directory'
    printf 'z,100\n5,x\n' > wrong.csv
    run -65 --separate-stderr depth-plan acomms --loss wrong.csv
    assert_equal "$stderr" "depth-plan: wrong.csv:2: loss 'x' is no number"
}

@test "depth-plan: bytes that are no text are refused in printable lines" {
    head -c 50000 "$SEAUTILS_BIN/depth-plan" > noise
    for command in acomms snr link-stats; do
        run bash -c "depth-plan $command noise > got 2> said"
        assert [ "$status" -eq 1 ]
        assert_equal "$(tr -d '[:print:]\n\200-\377' < said | wc -c)" 0
        iconv -f UTF-8 -t UTF-8 < said > said_again
        assert cmp said said_again
        assert_equal "$(wc -c < got)" 0
    done
}

@test "depth-plan: a live pipe is answered at once" {
    echo "$state" > in
    depth-plan acomms --loss losses.csv in > wanted
    assert_answered_at_once in wanted depth-plan acomms --loss losses.csv
}

@test "depth-plan: a full disk is status 74; a reader that goes ends it; an empty input is none" {
    run -74 --separate-stderr bash -c "depth-plan acomms --loss losses.csv > /dev/full <<< '$state'"
    assert_equal "$stderr" 'depth-plan: write failed: No space left on device'
    run -0 bash -c "yes '$state' | depth-plan acomms --loss losses.csv | head -1 | wc -l"
    assert_output 1
    for command in acomms snr link-stats; do
        run_quiet depth-plan $command < /dev/null
        assert_output ''
    done
}

@test "depth-plan: options are checked, with their bounds" {
    assert_refused "option --max-depth: '-1' is outside 0 to 12000 m" acomms --max-depth=-1
    assert_refused "option --exclude: '5' is not of the form FROM,TO with 0 <= FROM < TO" acomms --exclude 5
    assert_refused "option --loss-limit: 'x' is neither window nor from 1 to 1000 dB" acomms --loss-limit x
    assert_refused 'options --loss and --model exclude each other' snr --loss losses.csv --model x
    assert_refused "option --max-pitch: '91' is outside 0.1 to 90 degrees" snr --max-pitch 91
    assert_refused "option --ranges: '5,4' is not of the form FROM,TO with 0 <= FROM < TO" link-stats --ranges 5,4
    assert_refused "option --format: 'xml' is none of ndjson, csv, delimited, objective" acomms -f xml
    assert_refused 'unknown option --depth (try --help)' acomms --depth
    echo 'max-depth = x' > wrong.conf
    run -78 --separate-stderr depth-plan acomms -c wrong.conf <<< "$state"
    assert_equal "$stderr" "depth-plan: wrong.conf:1: option --max-depth: 'x' is outside 0 to 12000 m"
}

@test "depth-plan: --help fits a terminal, and names what the manual names" {
    man=$SEAUTILS_BUILD/man/depth-plan.1.scd
    for command in acomms snr link-stats; do
        run_quiet depth-plan $command --help
        assert [ "${#lines[@]}" -le 55 ]
        for line in "${lines[@]}"; do [[ ${#line} -le 100 ]] || fail "$line"; done
        sed -n 's/^ *\(-., \)\{0,1\}\(--[a-z-]*\).*/\2/p' <<< "$output"
    done | sort -u > helped
    [[ -f $man ]] || skip "the manual is not built"
    sed -n '/^# OPTIONS/,/^# INPUT/p' "$man" | grep '^\*-' | grep -o -- '--[a-z][a-z-]*' | sort -u > told
    run comm -23 helped told
    assert_output ''
}

@test "depth-plan: a FILE may stand behind a repeatable option" {
    echo "$state" > in
    run_quiet depth-plan acomms --loss losses.csv in
    assert_equal "${#lines[@]}" 1
    run_quiet depth-plan acomms --loss losses.csv --exclude 70,80 in
    assert_equal "${#lines[@]}" 1
}

@test "depth-plan: a day of states takes a second or so" {
    skip_if_sanitized "time is not that of a release"
    for ((k = 0; k < 20000; k++)); do echo "$state"; done > day
    run -0 bash -c "/usr/bin/env time -f '%U %M' depth-plan acomms --loss losses.csv -f csv day 2>&1 > got"
    read -r seconds kib <<< "$output"
    assert_equal "$(wc -l < got)" 20001
    [[ $(awk "BEGIN { print ($seconds < 5 && $kib < 65536) }") == 1 ]] || fail "$seconds s, $kib KiB"
}

# --- with tl-model ---

# need_model: tl-model, and the shared cases.
need_model() {
    command -v tl-model > /dev/null || skip "tl-model is not built"
    cases=$SEAUTILS_SHARED/cases
    [[ -d $cases ]] || skip "the cases of $cases are not there"
}

# curves GRID RATE HORIZON: a decision for each of a hundred ranges of the grid
curves() {
    awk -F, -v rate="$2" 'NR == 1 { for (k = 2; k < NF - 20; k += (NF - 22) / 100) printf "{\"depth_m\":50,\"range_m\":%s,\"range_rate_mps\":%s}\n", $int(k), rate; exit }' "$1" |
        depth-plan acomms --loss "$1" --horizon "$3"
}

@test "depth-plan acomms: the depth by the losses of tl-model is as good as that by the reference's" {
    need_model
    # specs/acoustics-accuracy.md, row F: one cell of the grid, or 0.005 of utility
    while read -r case rate horizon; do
        zcat "$cases/$case/csv/bellhop_gauss_inc.csv.gz" > reference.csv
        tl-model --format csv "$cases/$case/case.json" > ours.csv
        curves reference.csv "$rate" "$horizon" > reference
        curves ours.csv "$rate" "$horizon" > ours
        run jq -n --slurpfile a reference --slurpfile b ours '[range($a | length) as $k | $a[$k] as $r | $b[$k] as $o
            | ($r.curve_depth_m | index($r.depth_m)) as $i | ($r.curve_depth_m | index($o.depth_m)) as $j
            | ($i - $j | fabs) <= 1 or $r.curve_utility[$j] >= $r.utility - 0.005] | length, (map(select(.)) | length)'
        assert [ "${lines[0]}" -ge 90 ]
        assert_equal "$case ${lines[1]}" "$case ${lines[0]}"
    done << 'END'
p1-glint10-25k 1.47 120
p7-pacific-300 5 600
END
}

@test "depth-plan acomms: tl-model as its partner" {
    need_model
    tl-model --help | grep -q -e '--base' || skip "this tl-model takes no --base"
    plan=(depth-plan acomms --model "tl-model --base $cases/p1-glint10-25k/case.json")
    here='{"depth_m":20,"range_m":500,"range_rate_mps":1.47,"contact":{"depth_m":30}}'
    run_quiet "${plan[@]}" <<< "$here"$'\n'"${here/500/520}"$'\n'"${here/:30/:60}"
    assert_equal "${#lines[@]}" 3
    # by the grid of the case itself
    tl-model --format csv "$cases/p1-glint10-25k/case.json" > p1.csv
    by_grid=$(depth-plan acomms --loss p1.csv <<< "$here" | field .tl_db)
    run awk "BEGIN { d = $(field .tl_db <<< "${lines[0]}") - $by_grid; exit !(d < 0.5 && d > -0.5) }"
    [[ $status -eq 0 ]] || fail "$(field .tl_db <<< "${lines[0]}") where the grid has $by_grid"
    run -1 --separate-stderr "${plan[@]}" <<< '{"depth_m":20,"range_m":500,"contact":{"depth_m":5000}}'
    assert_regex "$stderr" "depth-plan: <stdin>:1: model 'tl-model --base .*: source.depth_m 5000 is outside 0 to 110 m$"
    assert_equal "$(field '[.depth_m, .reason]' <<< "$output")" '[null,"no losses are known"]'
}
