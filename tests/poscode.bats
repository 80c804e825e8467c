#!/usr/bin/env bats
# poscode packs a vehicle's track, unpacks it, and says what that costs.

setup() {
    load test_helper
    cd "$BATS_TEST_TMPDIR" || return
    cp "$SEAUTILS_ROOT/man/examples/track.csv" .
    vectors=$SEAUTILS_SHARED/vectors/poscode
}

# assert_refused WHAT COMMAND...: status 64, one line, nothing on standard output.
assert_refused() {
    local said=$1
    shift
    run -64 --separate-stderr "$@"
    assert_output ''
    assert_equal "$stderr" "poscode: $said"
}

# rounded FILE: its rows in whole metres, halves away from 0; the times as they are.
rounded() {
    awk -F, 'function r(v) { return int(v + (v < 0 ? -0.5 : 0.5)) } NR > 1 { print int($1) "," r($2) "," r($3) "," r($4) }' "$1"
}

@test "poscode: what is decoded is what was sampled, to the last cell, by each codec" {
    rounded track.csv > expected
    for codec in mix fixed kalman; do
        for model in uniform gaussian adaptive; do
            for size in '--max-bytes 32' '--max-bytes 200' '--deltas-per-packet 1' '--deltas-per-packet 9'; do
                # shellcheck disable=SC2086  # an option and its value
                poscode encode --codec $codec --model $model $size track.csv > packets
                run_quiet poscode decode --codec $codec --model $model -f csv packets
                assert_equal "$(tail -n +2 <<< "$output")" "$(cat expected)"
            done
        done
    done
}

@test "poscode: the tracks of the shared vectors come through whole" {
    [[ -d $vectors ]] || skip "no shared vectors"
    while read -r file tau; do
        rounded "$vectors/$file" > expected
        poscode encode --tau "$tau" "$vectors/$file" | poscode decode --tau "$tau" -f csv | tail -n +2 > got
        cmp expected got
    done << 'END'
sim_mbat12_s1.csv 5
real_lauv_20210527_t10.csv 10
real_seaglider_304-308_t30.csv 30
END
}

@test "poscode encode: no packet is larger than was said, and they are as full as may be" {
    for most in 29 32 64; do
        poscode encode --max-bytes $most track.csv > packets
        awk -v most=$most '{ if (length($0) > 2 * most) exit 1 }' packets
        assert_equal "$(poscode decode packets | wc -l)" 60
    done
    assert [ "$(poscode encode --max-bytes 64 track.csv | wc -l)" -le 3 ]
    assert_equal "$(poscode encode --deltas-per-packet 6 --max-bytes 500 track.csv | wc -l)" 10
}

@test "poscode encode: the forms of packets say the same" {
    poscode encode track.csv > hex
    poscode encode -f delimited track.csv > binary
    poscode encode -f message --id 5 --src 3 --dest 1 track.csv > records
    # In a record a packet is a message TrackPacket: its id, 5 << 1, and its length come first.
    diff <(while read -r packet; do printf '0a%02x%s\n' $((${#packet} / 2)) "$packet"; done < hex) <(
        jq -r .message.data records | while read -r data; do
            base64 -d <<< "$data" | digits
            echo
        done
    )
    diff <(poscode decode hex) <(poscode decode -F ndjson --id 5 records)
    diff <(poscode decode hex) <(poscode decode -F delimited binary)
    run jq -c '[.message.id, .message.src, .message.dest, .time == .message.created]' records
    assert_line --index 0 '[5,3,1,true]'
}

@test "poscode decode: latitude and longitude with the datum, times in both forms" {
    poscode encode --datum 60,5 > hex <<< $'time,latitude_deg,longitude_deg,depth_m\n2024-05-01T12:00:00Z,60.01,5,7'
    run_quiet poscode decode --datum 60.0,5 hex
    # a degree of latitude there is 111412 m on WGS84: 1114 m are 0.0099989
    assert_output '{"time":"2024-05-01T12:00:00Z","x_m":0,"y_m":1114,"z_m":-7,"latitude_deg":60.0099989,"longitude_deg":5.0000000}'
    run_quiet poscode decode --datum 60,5 -f csv hex
    assert_line --index 1 '1714564800,0,1114,-7,60.0099989,5.0000000'
}

@test "poscode: resolutions of x, y and of z, and a smaller area" {
    local options=(--resolution 0.5 --resolution-z 0.1 --area "x=-900:900,y=-900:900,z=-100:0")
    poscode encode "${options[@]}" track.csv > hex
    run_quiet poscode decode "${options[@]}" -f csv hex
    assert_line --index 2 '1714564810,15,0,-21.8'
    run_quiet poscode stat "${options[@]}" --codec mix track.csv
    assert_line --index 0 '60 samples every 10 s in 1 run; a full fix takes 34 bits' # 12 + 12 + 10
}

@test "poscode decode: ends that do not agree decode nothing" {
    poscode encode track.csv > hex
    for other in '--codec fixed' '--tau 5' '--resolution 2' '--datum 60,5' '--area x=0:9' --small; do
        # shellcheck disable=SC2086  # an option and its value
        run -1 --separate-stderr poscode decode $other hex
        assert_output ''
        assert_regex "${stderr_lines[0]}" '^poscode: hex:1: [a-z]'
    done
}

@test "poscode: a plan that both ends know" {
    printf 'x,y,z\n375,0,-12\n375,-75,-12\n0,-75,-12\n' > plan.csv
    poscode encode --plan plan.csv track.csv > hex
    rounded track.csv | diff - <(poscode decode --plan plan.csv -f csv hex | tail -n +2)
    run -1 --separate-stderr poscode decode hex
    assert_output ''
    echo '1,2' >> plan.csv
    run -78 --separate-stderr poscode decode --plan plan.csv hex
    assert_equal "$stderr" 'poscode: plan.csv:5: 2 cells where there are 3 columns'
    run -66 --separate-stderr poscode stat --plan none.csv track.csv
    assert_equal "$stderr" 'poscode: none.csv: No such file or directory'
}

@test "poscode decode: a packet that is damaged or cut is located, and nothing wrong is decoded" {
    poscode encode --deltas-per-packet 10 track.csv > hex
    poscode decode hex > whole
    sed '2s/^../ff/; 4s/..$//; 5s/.*/xyz/' hex > bad
    run -1 --separate-stderr poscode decode bad
    for line in 2 4 5; do [[ $stderr == *"poscode: bad:$line: "* ]] || fail "$stderr"; done
    head -10 whole | diff - <(head -10 <<< "$output")
    grep -vxFf whole <<< "$output" && fail "decoded what was not sent"
    run -65 --separate-stderr poscode decode --strict bad
    assert_regex "$stderr" '^poscode: bad:2: '
}

@test "poscode stat: one record a codec, with the bits that packets take" {
    run_quiet bash -c "poscode stat --format ndjson track.csv | jq -r '.codec + \" \" + .model' | xargs"
    assert_output 'mix - fixed uniform fixed gaussian fixed adaptive kalman uniform kalman gaussian kalman adaptive'
    run_quiet poscode stat --codec fixed --model uniform -f csv track.csv
    # 3 log2(102) = 20.02 bits, and the ending: 21 or 22 in whole bits
    assert_line --index 0 codec,model,deltas,fulls,bits_per_delta,bits_total,deltas_per_packet
    assert_regex "${lines[1]}" '^fixed,uniform,59,1,21\.[0-9]{4},1[23][0-9]{2},1$'
    run_quiet bash -c "poscode stat --format ndjson --codec kalman track.csv | jq -c '.bits_total == (.bits_per_delta * .deltas + 60 | round)' | uniq"
    assert_output true
}

# expected.json of the study: whole bits a delta of the thesis's codecs, one and three a packet.
@test "poscode stat: the thesis's codecs cost what the study says, within 1 %" {
    [[ -d $vectors ]] || skip "no shared vectors"
    local options=(--tau 5 --speed 1.4 --format ndjson)
    for n in 1 3; do
        for codec in fixed kalman; do
            want=$(jq --arg n $n --arg c $codec '.[] | select(.file == "sim_mbat12_s1.csv").thesis
                | if $c == "fixed" then .["Fixed Adaptive"] else .["Kalman Adaptive"] end
                | if $n == "1" then .one_per_packet else .three_per_packet end' "$vectors/expected.json")
            got=$(poscode stat "${options[@]}" --codec $codec --model adaptive --deltas-per-packet $n \
                "$vectors/sim_mbat12_s1.csv" | jq .bits_per_delta)
            awk -v g="$got" -v w="$want" 'BEGIN { exit !(g < 1.01 * w && g > 0.99 * w) }' || fail "$codec $n: $got, not $want"
        done
    done
}

@test "poscode stat: a picture, and what is wrong with it" {
    assert_refused "option --plot: 'x.gif' ends neither in .png nor .svg" poscode stat --plot x.gif track.csv
    run -73 --separate-stderr poscode stat --plot none/x.png track.csv
    assert_equal "$stderr" 'poscode: none/x.png: No such file or directory'
    run -69 --separate-stderr env "PATH=$SEAUTILS_BIN" "$SEAUTILS_BIN/poscode" stat --plot x.png track.csv
    assert_equal "$stderr" 'poscode: option --plot needs gnuplot (package gnuplot-nox)'
    assert_not_exists x.png
    command -v gnuplot > /dev/null || skip "gnuplot is not installed"
    run_quiet poscode stat --plot x.svg track.csv
    grep -q 'kalman gaussian' x.svg
    run_quiet poscode stat --plot x.png track.csv
    assert_equal "$(head -c 4 x.png | digits)" 89504e47
}

@test "poscode simulate: a picture, and what is wrong with it" {
    assert_refused "option --plot: 'x.gif' ends neither in .png nor .svg" poscode simulate --plot x.gif track.csv
    run -73 --separate-stderr poscode simulate --loss 0.5 --plot none/x.png track.csv
    assert_equal "$stderr" 'poscode: none/x.png: No such file or directory'
    command -v gnuplot > /dev/null || skip "gnuplot is not installed"
    run_quiet poscode simulate --loss 0.8 --loss 0.1 --plot x.svg track.csv
    for way in full arq-55 arq-256 history newest auto; do
        assert_equal "$(grep -c "<text>.*>$way<" x.svg)" 2 # in both panels
    done
    run_quiet poscode simulate --loss 0.5 --plot x.png track.csv
    assert_equal "$(head -c 4 x.png | digits)" 89504e47
}

@test "poscode: a fix that cannot be used is located, dropped, and makes the status 1" {
    cat > bad.csv << 'END'
t,x,y,z
10,0,0,0
20,a,0,0
20,0,0
20,0,0,9000
5,0,0,0
20,7,0,0
END
    run -1 --separate-stderr poscode stat --codec mix -f csv bad.csv
    assert_line --index 1 --regexp '^mix,-,1,1,'
    assert_equal "$stderr" "poscode: bad.csv:3: x 'a' is no number
poscode: bad.csv:4: 3 cells where there are 4 columns
poscode: bad.csv:5: z 9000 m is outside the area, -12000 to 1000 m
poscode: bad.csv:6: time 5 s is not after that of the fix before, 10 s"
    run -65 --separate-stderr poscode encode --strict bad.csv
    assert_equal "$stderr" "poscode: bad.csv:3: x 'a' is no number"
    run -1 --separate-stderr poscode encode <<< '{"t":1,"latitude_deg":60,"longitude_deg":5,"depth_m":1}'
    assert_equal "$stderr" 'poscode: <stdin>:1: latitude and longitude need a datum (--datum)'
}

@test "poscode: the rules of the house for a command line" {
    assert_refused 'a command is missing: encode, decode, stat, simulate (try --help)' poscode
    assert_refused "command 'encod' is none of encode, decode, stat, simulate (did you mean encode?)" poscode encod x
    assert_refused "command 'stat' must be the first word" poscode -q stat
    assert_refused 'unknown option --slots (try --help)' poscode --slots
    for command in encode decode stat; do
        assert_refused 'unknown option --zebra (try --help)' poscode $command --zebra
        assert_refused "option --codec: 'huff' is none of mix, fixed, kalman" poscode $command --codec huff
        assert_refused "option --tau: '0' is outside 0.001 to 86400 s" poscode $command --tau 0
        assert_refused "option --tau: '0.0015' has more than three decimals" poscode $command --tau 0.0015
        assert_refused "option --area: 'x=1' is not of the form x=-5000:5000" poscode $command --area x=1
        assert_refused "option --datum: latitude_deg 91 is outside -90 to 90" poscode $command --datum 91,0
        assert_refused 'option --frame needs --datum' poscode $command --frame utm
        run -66 --separate-stderr poscode $command none
        assert_equal "$stderr" 'poscode: none: No such file or directory'
        run -74 --separate-stderr bash -c "poscode $command --help > /dev/full"
        assert_equal "$stderr" 'poscode: write failed: No space left on device'
        run_quiet poscode $command --help
        assert_line "Usage: poscode $command [OPTION]... [FILE]..."
        assert_line 'The manual: man poscode'
        assert [ "${#lines[@]}" -le 50 ]
        for line in "${lines[@]}"; do [[ ${#line} -le 100 ]] || fail "$line"; done
    done
    assert_refused "option --gap: '0' is outside 0.001 to 86400000 s" poscode encode --gap 0
    assert_refused 'gap 1000 ms is outside 10000 to 10000000 ms, 1 to 1000 intervals' poscode encode --gap 1
    assert_refused 'options --id, --src and --dest are for --format message' poscode encode --id 3
    assert_refused "option --deltas-per-packet: '0' is outside 1 to 1000" poscode stat --deltas-per-packet 0
    run_quiet poscode --version
    assert_regex "$output" '^poscode \(seautils\) [0-9.]+$'
    run_quiet poscode stat --version
    assert_regex "$output" '^poscode \(seautils\) [0-9.]+$'
}

@test "poscode: a full disk is status 74, an empty input gives nothing" {
    poscode encode track.csv > hex
    for words in 'encode track.csv' 'decode hex' 'stat track.csv'; do
        run -74 --separate-stderr bash -c "poscode $words > /dev/full"
        assert_equal "$stderr" 'poscode: write failed: No space left on device'
    done
    for words in encode decode; do
        run_quiet bash -c "poscode $words < /dev/null"
        assert_output ''
    done
}

@test "poscode: a live pipe is answered at once, and | head -1 ends it" {
    poscode encode --deltas-per-packet 1 track.csv > hex
    poscode decode hex > fixes
    assert_answered_at_once track.csv hex poscode encode --deltas-per-packet 1
    assert_answered_at_once hex fixes poscode decode
    for k in {1..200}; do cat track.csv; done > long.csv
    run -141 --separate-stderr bash -c 'set -o pipefail; poscode encode --deltas-per-packet 1 long.csv 2> /dev/null | head -1'
    assert_output "$(head -1 hex)"
    assert_dies_of TERM hex poscode decode
}

@test "poscode: options of a file, a FILE behind options, fixes from other forms" {
    printf 'codec = fixed\ntau = 20\n' > link.conf
    diff <(poscode encode -c link.conf track.csv) <(poscode encode --codec fixed --tau 20 track.csv)
    run -0 poscode stat --print-config
    assert_line --partial 'tau ='
    tail -n +2 track.csv | jq -cR 'split(",") | map(tonumber) | {time: .[0], x_m: .[1], y_m: .[2], depth_m: -.[3]}' > track.ndjson
    diff <(poscode encode track.csv) <(poscode encode -F ndjson track.ndjson)
    diff <(poscode encode track.csv) <(poscode encode - < track.ndjson)
}
