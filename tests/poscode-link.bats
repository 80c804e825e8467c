#!/usr/bin/env bats
# poscode over a link that loses packets: what is decoded is what was sampled, or it is not there.
# shellcheck disable=SC2030,SC2031,SC2034,SC2154  # each test runs alone; held open only; run sets it

setup() {
    load test_helper
    cd "$BATS_TEST_TMPDIR" || return
    cp "$SEAUTILS_ROOT/man/examples/track.csv" .
    seautils=$SEAUTILS_ROOT/schemas/seautils
}

teardown() {
    local pid
    for pid in "${started[@]}"; do kill -9 "$pid" 2> /dev/null || true; done
    wait
}

# expected TRACK: what is to be decoded of it, in whole metres, halves away from 0.
expected() {
    awk -F, 'function r(v) { return int(v + (v < 0 ? -0.5 : 0.5)) } NR > 1 { print int($1) "," r($2) "," r($3) "," r($4) }' "$1" | sort
}

# wander N SEED: a track of N fixes, one every 10 s.
wander() {
    awk -v n="$1" -v seed="$2" 'BEGIN {
        srand(seed); print "t,x,y,z"
        for (k = 0; k < n; ++k) {
            turn += (rand() - 0.5) / 2; x += 15 * cos(turn); y += 15 * sin(turn); z = -20 - 8 * sin(k / 20)
            printf "%d,%.2f,%.2f,%.2f\n", 1714564800 + 10 * k, x, y, z
        }
    }'
}

# water LOSS SEED IN OUT: passes on what is not lost.
water() {
    awk -v loss="$1" -v seed="$2" 'BEGIN { srand(seed) } rand() >= loss { print; fflush() }' < "$3" > "$4" 3>&- &
    started+=($!)
}

# link LOSS SEED: FIFOs `sent` to `arrived` and `acks_sent` to `acks`, held open.
link() {
    mkfifo sent arrived acks_sent acks
    exec {hold_1}<> sent {hold_2}<> arrived {hold_3}<> acks_sent {hold_4}<> acks
    water "$1" "$2" sent arrived
    water "$1" "$2$2" acks_sent acks
}

# receive OPTION...: into `got`
receive() {
    poscode decode -F ndjson --acks acks_sent --src 1 -f csv "$@" < arrived >> got 2>> decode.log 3>&- &
    receiver=$!
    started+=("$receiver")
}

# decoded: each row once, without headers
decoded() {
    grep -v '^t,' got | sort -u
}

@test "poscode link: with 4 of 10 packets and acknowledgements lost every position arrives" {
    link 0.4 7
    receive
    timeout 60 poscode encode --feedback acks --every 0.02 --src 2 --max-bytes 29 track.csv > sent
    diff <(expected track.csv) <(decoded)
    assert_equal "$(grep -vc '^t,' got)" 60 # none came twice
}

@test "poscode link: either end, or both, killed at any moment: what is decoded is right, and all of it arrives" {
    wander 600 5 > long.csv
    link 0.4 3
    receive --state receiver.state
    RANDOM=11
    # Where tools are slow they live longer, until something has come through.
    for ((k = 0; k < 24 || (k < 100 && $(decoded | wc -l) == 0); ++k)); do
        poscode encode --feedback acks --every 0.02 --src 2 --max-bytes 29 --state sender.state long.csv > sent 2>> encode.log 3>&- &
        sender=$!
        started+=("$sender")
        sleep "$(awk -v ms=$((RANDOM % 90 + 10)) -v k=$k 'BEGIN { print ms / 1000 * (k < 24 ? 1 : k / 4) }')"
        if ((k % 3 != 1)); then
            kill -9 "$sender" 2> /dev/null || true
            wait "$sender" || true
        fi
        if ((k % 3 != 0)); then
            kill -9 "$receiver"
            wait "$receiver" || true
            receive --state receiver.state
        fi
        if ((k % 3 == 1)); then
            kill -9 "$sender" 2> /dev/null || true
            wait "$sender" || true
        fi
        # Nothing that was never sampled.
        assert_equal "$(comm -13 <(expected long.csv) <(decoded))" ''
    done
    assert [ "$(decoded | wc -l)" -gt 0 ]
    timeout 60 poscode encode --feedback acks --every 0.02 --src 2 --state sender.state long.csv > sent
    diff <(expected long.csv) <(decoded)
    refute [ -s encode.log ]
}

@test "poscode link: a receiver that lost its state asks for a new session, and nothing wrong is decoded" {
    link 0.2 5
    wander 200 8 > long.csv
    head -101 long.csv > first.csv
    receive --state receiver.state
    timeout 60 poscode encode --feedback acks --every 0.02 --src 2 --state sender.state first.csv > sent
    diff <(expected first.csv) <(decoded)
    kill -9 "$receiver"
    rm receiver.state
    receive --state receiver.state
    timeout 60 poscode encode --feedback acks --every 0.02 --src 2 --state sender.state long.csv > sent
    diff <(expected long.csv) <(decoded)
}

@test "poscode link: a sender that lost its state begins a new session" {
    link 0.2 6
    wander 100 9 > long.csv
    head -51 long.csv > first.csv
    receive
    timeout 60 poscode encode --feedback acks --every 0.02 --src 2 --state sender.state first.csv > sent
    printf 'nonsense' > sender.state
    timeout 60 poscode encode --feedback acks --every 0.02 --src 2 --state sender.state long.csv > sent 2> encode.log
    grep -q '^poscode: sender.state: .*: the track begins anew$' encode.log
    diff <(expected long.csv) <(decoded)
}

@test "poscode encode --newest: the last position arrives, and nothing that was not sampled" {
    link 0.4 2
    receive
    timeout 60 poscode encode --newest --feedback acks --every 0.02 --src 2 track.csv > sent
    for ((k = 0; k < 100; ++k)); do
        [[ $(decoded | tail -1) != "$(expected track.csv | tail -1)" ]] || break
        sleep 0.02
    done
    assert_equal "$(decoded | tail -1)" "$(expected track.csv | tail -1)"
    assert_equal "$(comm -13 <(expected track.csv) <(decoded))" ''
}

@test "poscode encode --auto: all of it where little is lost, the newest position where most is" {
    slowly() { # a fix at a time, so that acknowledgements come between
        local line
        while read -r line; do
            echo "$line"
            sleep 0.02
        done < track.csv
    }
    link 0 1
    receive
    timeout 60 poscode encode --auto --feedback acks --every 0.5 --src 2 < <(slowly) > sent
    diff <(expected track.csv) <(decoded)
    kill -9 "$receiver"
    rm got sent arrived acks_sent acks
    link 0.7 2 # both ways: one of 11 is acknowledged
    receive
    timeout 60 poscode encode --auto --feedback acks --every 0.02 --src 2 < <(slowly) > sent
    for ((k = 0; k < 100; ++k)); do
        [[ $(decoded | tail -1) != "$(expected track.csv | tail -1)" ]] || break
        sleep 0.02
    done
    assert_equal "$(decoded | tail -1)" "$(expected track.csv | tail -1)"
    assert_equal "$(comm -13 <(expected track.csv) <(decoded))" ''
    assert [ "$(decoded | wc -l)" -lt 60 ] # those between were given up
}

@test "poscode link: packets and acknowledgements are DCCL messages, told apart in a frame by dccl-decode and by poscode" {
    poscode encode -f message --id 110 --src 2 track.csv > packets
    data=$(head -1 packets | jq -r .message.data)
    run_quiet dccl-decode -s "$seautils" -F base64 <<< "$data"
    packet=$(jq -r .packet <<< "$output")
    assert_equal "$(jq -r '."@type"' <<< "$output")" seautils.TrackPacket
    poscode encode track.csv | head -1 > hex
    assert_equal "$(base64 -d <<< "$packet" | digits)" "$(cat hex)"
    poscode decode hex > want
    diff want <(poscode decode -F base64 <<< "$packet")

    # Acknowledgement, packet, filling: a frame as a modem hears it.
    ack=$(dccl-encode -s "$seautils" -m seautils.TrackAck <<< '{"ack":"AQIDBA=="}')
    frame=$(printf '%s%s0000' "$ack" "$(base64 -d <<< "$data" | digits)" | xxd -r -p | base64 -w0)
    printf '{"time":"2024-05-01T12:00:00Z","reception":{"src":2,"dest":1,"frame":["%s"]}}\n' "$frame" > heard
    run_quiet poscode decode -F ndjson heard
    diff want <(echo "$output")
    run_quiet poscode decode -F ndjson --from 2 heard
    diff want <(echo "$output")
    run_quiet poscode decode -F ndjson --from 3 heard
    assert_output ''
}

@test "poscode link: other ids, also of two bytes, are those of DCCL" {
    sed 's/id: 110/id: 300/; s/id: 111/id: 20000/; s/max_bytes: 257/max_bytes: 258/' "$seautils/track.proto" > track.proto
    poscode encode track.csv > hex
    poscode encode -f message --id 300 track.csv > packets
    while read -r data; do
        dccl-decode -s track.proto -m seautils.TrackPacket -F base64 <<< "$data" | jq -r .packet | base64 -d | digits
        echo
    done < <(jq -r .message.data packets) > got
    diff hex got
    diff <(poscode decode hex) <(poscode decode -F ndjson --id 300 --ack-id 20000 packets)
    run_quiet poscode decode -F ndjson packets # not the ids that it looks for
    assert_output ''
}

@test "poscode link: any bytes in a frame are passed over, and none becomes a position" {
    awk 'BEGIN {
        srand(4); digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"
        for (k = 0; k < 3000; ++k) {
            text = k % 2 ? "" : "3A" # the first byte of a packet
            size = 4 * int(rand() * 12 + 1)
            while (length(text) < size) text = text substr(digits, int(rand() * 64) + 1, 1)
            printf "{\"time\":\"2024-05-01T12:00:00Z\",\"reception\":{\"src\":2,\"dest\":1,\"frame\":[\"%s\"]}}\n", text
        }
    }' > noise
    run_quiet poscode decode -F ndjson noise
    assert_output ''
    mkfifo acks
    exec {hold_1}<> acks
    poscode encode --feedback acks --src 2 --every 0.05 --linger 2 track.csv > packets 2> encode.log 3>&- &
    started+=($!)
    cat noise > acks
    wait $!
    assert_equal "$(cat encode.log)" 'poscode: 60 positions not acknowledged'
    poscode decode -F ndjson -f csv packets > got # the oldest that fit, and the newest
    assert_equal "$(comm -13 <(expected track.csv) <(decoded))" ''
    assert_equal "$(decoded | tail -1)" "$(expected track.csv | tail -1)"
}

@test "poscode encode: packets go for each sample, while none is acknowledged, and when a slot begins" {
    mkfifo fixes acks
    exec {hold_1}<> acks
    poscode encode --feedback acks --src 2 --every 3600 -F csv < fixes > sent 2> encode.log 3>&- &
    started+=($!)
    exec {feed}> fixes
    packets() { # N: there are so many
        for ((k = 0; k < 100; ++k)); do
            [[ $(wc -l < sent) -lt $1 ]] || break
            sleep 0.02
        done
        sleep 0.1
        assert_equal "$(wc -l < sent)" "$1"
    }
    head -2 track.csv >&"$feed" # a sample is complete when its fix is there
    packets 1
    sed -n 3p track.csv >&"$feed"
    packets 2
    slot='{"time":"2024-05-01T12:00:00Z","slot":{"src":%d,"kind":"%s","start":"2024-05-01T12:00:00Z","end":"2024-05-01T12:00:10Z","frames":1,"frame_bytes":64}}\n'
    # shellcheck disable=SC2059  # the format is ours
    printf "$slot" 2 DATA > acks
    packets 3
    # shellcheck disable=SC2059
    printf "$slot" 1 DATA > acks
    # shellcheck disable=SC2059
    printf "$slot" 2 PING > acks
    packets 3
    # What is not acknowledged is sent again, so that the same is decoded from each.
    poscode decode -F ndjson -f csv sent > got
    diff <(expected <(head -3 track.csv)) <(decoded)
}

@test "poscode encode: without any acknowledgement it goes on until --linger" {
    run -0 --separate-stderr timeout 30 poscode encode --feedback acks --src 2 --every 0.05 --linger 0.5 track.csv
    assert_equal "$stderr" 'poscode: 60 positions not acknowledged'
    assert [ "${#lines[@]}" -ge 5 ]
    assert [ "${#lines[@]}" -le 12 ]
}

@test "poscode link: where nothing can be kept, nothing leaves" {
    run -73 --separate-stderr timeout 30 poscode encode --feedback acks --src 2 --linger 1 --state none/state track.csv
    assert_output ''
    assert_equal "$stderr" 'poscode: none/state.new: No such file or directory'
    poscode encode -f message --src 2 track.csv > packets
    mkfifo acks_sent
    exec {hold_1}<> acks_sent
    run -73 --separate-stderr poscode decode -F ndjson --acks acks_sent --state none/state packets
    assert_equal "$stderr" 'poscode: none/state.new: No such file or directory'
    run ! timeout 0.2 head -c 1 acks_sent
    assert_output ''
}

@test "poscode link: a queue that is not there is as a link that loses all, and is said once" {
    run -0 --separate-stderr timeout 30 poscode encode --send none.sock --src 2 --every 0.05 --linger 0.3 track.csv
    assert_output ''
    assert_equal "$(grep -c none.sock <<< "$stderr")" 1
    assert_regex "$stderr" '60 positions not acknowledged$'
    poscode encode -f message --src 2 track.csv > packets
    run -0 --separate-stderr poscode decode -F ndjson --send none.sock packets
    assert_equal "${#lines[@]}" 60
    assert_equal "$(grep -c none.sock <<< "$stderr")" 1
}

@test "poscode encode: options of a live link need one" {
    for option in '--state x' --newest --auto --history '--every 3' '--linger 3'; do
        # shellcheck disable=SC2086  # an option and its value
        run -64 --separate-stderr poscode encode $option track.csv
        assert_equal "$stderr" 'poscode: options --state, --history, --newest, --auto, --every and --linger need --feedback or --send'
    done
    run -64 --separate-stderr poscode encode --feedback acks -f hex track.csv
    assert_equal "$stderr" 'poscode: option --format: a live link takes messages only'
    run -64 --separate-stderr poscode encode --feedback acks --clock input track.csv
    assert_equal "$stderr" 'poscode: a live link goes by a clock, not by the times of its input'
    run -64 --separate-stderr poscode encode --feedback acks --deltas-per-packet 3 track.csv
    assert_equal "$stderr" 'poscode: option --deltas-per-packet is for a stream that loses nothing'
    run -64 --separate-stderr poscode decode --id 5 --ack-id 5 packets
    assert_equal "$stderr" 'poscode: options --id and --ack-id are the same'
}

@test "poscode link: a mission through queue-sched, tdma-slot, mm-serial and a sea that loses 4 of 10 packets: every sample arrives" {
    skip_if_sanitized 'simulated time is too fast for slow programs'
    run_quiet timeout 120 "$SEAUTILS_ROOT/examples/track/run" -w 50 -n 60 -k sea
    assert_output --regexp '^All 60 positions arrived, each as it was sampled, in [0-9]+ packets of which [0-9]+ were lost.$'
    # By another way than run's own: the fixes, rounded.
    jq -r '"\(.time_s),\(.x_m),\(.y_m),\(.z_m)"' sea/fixes.ndjson | sed '1i t,x,y,z' > fixes.csv
    diff <(expected fixes.csv) <(tail -n +2 sea/received.csv | sort)
    # The sea did lose as many as it says, within what chance makes of it.
    sent=$(grep -c '"packet":"data"' sea/truth.ndjson)
    lost=$(grep -c '"outcome":"LOST"' sea/truth.ndjson)
    assert [ $((lost * 100)) -gt $((sent * 15)) ]
}

@test "poscode link: the mission of a real vehicle" {
    skip_if_sanitized 'simulated time is too fast for slow programs'
    lauv=$SEAUTILS_SHARED/vectors/poscode/real_lauv_20210527_t10.csv
    [[ -r $lauv ]] || skip 'no shared vectors'
    run_quiet timeout 120 "$SEAUTILS_ROOT/examples/track/run" -w 100 -n 90 -t "$lauv"
    assert_output --regexp '^All 90 positions arrived, each as it was sampled, '
}

@test "examples/track: refuses what it cannot do" {
    for arguments in '-w 0' '-n 1' '-x' 'more' '-t /none'; do
        # shellcheck disable=SC2086  # an option and its value
        run -64 --separate-stderr "$SEAUTILS_ROOT/examples/track/run" $arguments
        assert_equal "${stderr%%:*}" run
    done
}
