#!/usr/bin/env bats
# The examples do what their README files say.

setup() {
    load test_helper
    bats_require_minimum_version 1.5.0
    examples=$BATS_TEST_DIRNAME/../examples
    mission=$examples/mission
    shared=${SEAUTILS_SHARED:-$BATS_TEST_DIRNAME/../../shared}
    cd "$BATS_TEST_TMPDIR"
}

convert() { # ROW...: what to-ndjson.awk makes of rows of time, latitude, longitude, temperature
    printf '%s\n' time_s,lat_deg,lon_deg,depth_m,temperature_C "$@" > in.csv
    awk -v interval_s=10 -v report=report.txt -f "$mission/to-ndjson.awk" in.csv
}

@test "examples: the shipped mission comes back within half a resolution" {
    run_quiet "$mission/run" -k kept
    assert_line --regexp '^[0-9]+ values in 760 messages compared: all the same within half a resolution$'
    assert_line --partial '1440 rows'
    # one sample a row of the CSV
    assert_line '42 Ctd with 1440 samples.'
    # a Status has 40 bits of header and 168 of body whatever is set: 718 times 26 bytes
    assert_line --regexp '^seautils.Status +718 +[0-9]+ +[0-9]+ +18668 +26.0 '
    assert [ "$(wc -l < kept/sent.hex)" -eq 760 ]
}

@test "examples: the comparison notices a changed, a lost and an invented value" {
    echo '{"@type":"seautils.Status","time_s":1.0,"src":1,"depth_m":10.0}' > sent
    for got in '{"@type":"seautils.Status","time_s":1.0,"src":1,"depth_m":10.06}' \
        '{"@type":"seautils.Status","time_s":1.0,"src":2,"depth_m":10.0}' \
        '{"@type":"seautils.Status","time_s":1.0,"src":1}' \
        '{"@type":"seautils.Status","time_s":1.0,"src":1,"depth_m":10.0,"leg":0}'; do
        echo "$got" > got
        run -1 awk -v got=got -f "$mission/compare.awk" sent
        assert_line --partial ' compared: 1 differ'
    done
    : > got
    run -1 awk -v got=got -f "$mission/compare.awk" sent
    assert_line --partial ' compared: 1 differ'
    echo '{"src":1, "depth_m":10.05, "time_s":1, "@type":"seautils.Status"}' > got
    run -0 awk -v got=got -f "$mission/compare.awk" sent
}

@test "examples: the local plane has the ellipsoid's lengths" {
    # A degree at 45 north is 111131.8 m along the meridian and 78846.8 m along the parallel (WGS84).
    run -0 convert 0,45,10,0,8 10,45.01,10.01,0,8
    assert_line --index 1 --partial '"x_m":788.47,"y_m":1111.32,'
    # over the 180th meridian it is not far
    run -0 convert 0,0,179.999,0,8 10,0,-179.999,0,8
    assert_line --index 1 --partial '"x_m":222.64,"y_m":0.00,'
}

@test "examples: what is unknown, no number or out of bounds stays unset" {
    run -0 convert 0,,,-3.5,8 10,,,1e400x,nan 20,45,10,,
    assert_line --index 0 '{"@type":"seautils.Status","time_s":0,"src":1,"dest":0}'
    assert_line --index 1 '{"@type":"seautils.Status","time_s":10,"src":1,"dest":0}'
    assert_line --index 2 '{"@type":"seautils.Status","time_s":20,"src":1,"dest":0,"x_m":0.00,"y_m":0.00}'
    assert_equal "${#lines[@]}" 3
    run -0 cat report.txt
    assert_line --partial 'depth_m outside -3 to 6550'
    assert_line --partial 'not a number'
}

@test "examples: a mission of the shared data comes back within half a resolution" {
    [[ -d $shared/data/tracks ]] || skip "no recordings in $shared/data/tracks"
    for track in "$shared"/data/tracks/*.csv.gz; do
        run_quiet "$mission/run" "$track"
        assert_line --regexp '^[0-9]+ values in [0-9]+ messages compared: all the same within half a resolution$'
    done
}

@test "examples: a wrong command line is 64, a missing recording 66" {
    run -64 "$mission/run" --nonsense
    run -64 "$mission/run" -i soon
    run -66 "$mission/run" nowhere.csv
    assert_output 'run: nowhere.csv: cannot be read'
}

@test "examples: the recording is small, and says where it comes from" {
    assert [ "$(wc -c < "$mission/seaexplorer.csv")" -le 200000 ]
    assert grep -q 'Licence' "$mission/README.md"
}

@test "examples: the log of DCCL 1 reads as its README says" {
    run_quiet dccl-decode -s "$examples/legacy/dive.xml" -m DIVE --time 2011-07-25T12:00:00Z \
        -F hex "$examples/legacy/log.hex"
    assert_equal "${#lines[@]}" 3
    assert_line --index 0 --partial '"depth":12.5,"temperature":[21.4,21.38,21.35,21.1],"phase":"DIVE","battery":87,"healthy":true'
    assert_line --index 1 --partial '"depth":96.1,"temperature":[14.02,14.01,13.98,13.97],"phase":"DIVE","battery":86,"healthy":true'
    assert_line --index 2 --partial '"temperature":[20.95,21,21.2,21.4],"phase":"SURFACE","battery":85,"healthy":false'
    refute_line --index 2 --partial '"depth"'
}

@test "examples: a sea trial: what was commanded arrives, and nothing is lost without a reason" {
    skip_if_sanitized "the simulation runs faster than they do"
    run_quiet timeout 120 "$SEAUTILS_ROOT/examples/sea-trial/run" -w 60 -d 900 -k "$BATS_TEST_TMPDIR/trial"
    assert_line --regexp '^Contact +[1-9]'
    assert_line --regexp '^glider > ship '
    refute_output --partial 'No such'
    cd "$BATS_TEST_TMPDIR/trial" || return
    # Whatever a queue says was delivered with an acknowledgement did arrive.
    for node in auv glider; do
        delivered=$(jq -s 'map(.queue | select(. and .id >= 100) | .delivered) | add' $node/queue.ndjson)
        arrived=$(jq -s "map(select(.\"@from\" == {auv: 2, glider: 3}.$node and .\"@type\" != \"seautils.Status\")) | length" ship/received.ndjson)
        ((delivered > 0 && arrived >= delivered))
    done
    # The logs are read by the other tools.
    run_quiet bash -c "jq -r 'select(.raw) | \"\(.time) \(.raw.line)\"' ship/link.ndjson | mm-serial --replay | jq -c 'select(.reception)' | wc -l"
    assert_equal "$output" "$(jq -c 'select(.reception)' ship/link.ndjson | wc -l)"
    # Nothing that it started is left.
    run pgrep -f "$BATS_TEST_TMPDIR/trial"
    assert_output ''
}

@test "examples: what is wrong with the options of the sea trial" {
    while IFS='|' read -r arguments what; do
        # shellcheck disable=SC2086  # words
        run -64 --separate-stderr "$SEAUTILS_ROOT/examples/sea-trial/run" $arguments
        assert_equal "$stderr" "run: $what"
    done << 'CASES'
-w 0|warp '0' is outside 1 to 200
-w fast|warp 'fast' is not a whole number
-d 10|seconds '10' is outside 60 to 3600
more|too many words (usage: run [-w WARP] [-d SECONDS] [-s SEED] [-k FOLDER])
CASES
}

@test "examples: the studies of depths go from the environment to the picture" {
    command -v tl-model > /dev/null || skip "tl-model is not built"
    command -v gnuplot > /dev/null || skip "gnuplot is not installed"
    run_quiet "$examples/depth/glint10" glint10
    assert_equal "$(jq -s 'length, (map(select(.rule == "BEST")) | length)' glint10/decisions.ndjson | xargs)" '9 9'
    # the best depth sinks with range as far as a limit lets it
    assert_equal "$(jq -s '[.[2:8][].depth_m] | . == sort and .[-1] == 95' glint10/decisions.ndjson)" true
    # the threshold of the log is that with which it was drawn
    assert_equal "$(jq 'select(.threshold_db) | .threshold_db > 54.5 and .threshold_db < 57.5' glint10/receipt.ndjson)" true
    run_quiet "$examples/depth/pacific" pacific
    assert_equal "$(jq -s 'length, all(.[]; (.pitch_deg | fabs) <= 20 and .depth_m <= 5000)' pacific/decisions.ndjson | xargs)" '70 true'
    # 20 degrees at 1.5 m/s for two minutes: 61.6 m
    assert_equal "$(jq -s '[.[0].rule, .[1].own_depth_m]' -c pacific/decisions.ndjson)" '["STEEPEST",4938.4]'
    assert [ -s glint10/depths.png ]
    assert [ -s glint10/receipt.png ]
    assert [ -s pacific/track.png ]
}
