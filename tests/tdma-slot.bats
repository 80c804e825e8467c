#!/usr/bin/env bats
# tdma-slot says whose turn it is, by the clock and at once, and shows how vehicles find each other.

setup() {
    load test_helper
    cd "$BATS_TEST_TMPDIR" || return
    period=(--from 2024-05-01T12:00:00Z --to 2024-05-01T12:01:00Z)
    three=(--slot src=1,length=15 --slot src=2,length=15 --slot src=3,length=15 --slot length=5)
}

# starts: the times at which slots begin, of records on standard input.
starts() { jq -r 'select(.slot).slot.start'; }

# heard SRC TIME: a record of somebody heard.
heard() { printf '{"time":"%s","reception":{"src":%s,"dest":0}}\n' "$2" "$1"; }

# summary OPTION...: runs, failures and mean of a simulation.
summary() { tdma-slot "$@" -f ndjson | tail -1 | jq -c '.summary | [.runs, .failed, .mean_slots]'; }

# assert_refused WHAT COMMAND...: status 64, one line, nothing on standard output.
assert_refused() {
    local said=$1
    shift
    run -64 --separate-stderr "$@"
    assert_output ''
    assert_equal "$stderr" "tdma-slot: $said"
}

# in_background COMMAND...: with output and messages in the files out and err; its id is $pid.
in_background() {
    "$@" > out 2> err 3>&- &
    pid=$!
}

# wait_for COMMAND...: until it succeeds, 20 s at most.
wait_for() {
    local k
    for ((k = 0; k < 400; k++)); do
        ! "$@" > /dev/null 2>&1 || return 0
        sleep 0.05
    done
    fail "in vain: $*"
}

@test "tdma-slot: slots in the order of their declaration, from the origin on" {
    run_quiet tdma-slot "${three[@]}" --id 3 --guard 1.5 --from @0 --to @50
    assert_line --index 0 '{"time":"1970-01-01T00:00:00Z","slot":{"index":0,"cycle":0,"src":1,"rate":0,"kind":"DATA","start":"1970-01-01T00:00:00Z","end":"1970-01-01T00:00:13.500Z","frames":1,"frame_bytes":32,"initiate":false}}'
    assert_line --index 2 '{"time":"1970-01-01T00:00:30Z","slot":{"index":2,"cycle":0,"src":3,"rate":0,"kind":"DATA","start":"1970-01-01T00:00:30Z","end":"1970-01-01T00:00:43.500Z","frames":1,"frame_bytes":32,"initiate":true}}'
    assert_line --index 3 '{"time":"1970-01-01T00:00:45Z","slot":{"index":3,"cycle":0,"src":0,"rate":0,"kind":"BLANK","start":"1970-01-01T00:00:45Z","end":"1970-01-01T00:00:48.500Z","frames":0,"frame_bytes":0,"initiate":false}}'
    assert_equal "${#lines[@]}" 4
}

@test "tdma-slot: the end of a period does not belong to it, its beginning does" {
    tdma-slot "${three[@]}" --from @15 --to @30 | starts > got
    assert_equal "$(cat got)" 1970-01-01T00:00:15Z
    run_quiet tdma-slot "${three[@]}" --from @16 --to @16
    assert_output ''
}

@test "tdma-slot: two vehicles' schedules are the same without --id" {
    cat > one.conf <<< $'slot = src=1 length=15\nslot = src=2 length=20\nid = 1'
    cat > two.conf <<< $'slot = src=1,length=15\nslot = src=2,length=20\nid = 2'
    for n in one two; do grep -v id $n.conf > common.conf && tdma-slot -c common.conf "${period[@]}" > $n; done
    run_quiet diff one two
    run jq -c 'select(.slot.initiate != null)' one
    assert_output ''
    assert [ -s one ]
}

# Pitfall 3: 35 s do not divide a day.
@test "tdma-slot: one that is started after midnight agrees with one that ran through (pitfall 3)" {
    for origin in epoch midnight 2023-12-31T17:00:00.123456789Z; do
        slots=(--slot src=1,length=15 --slot src=2,length=20 --origin "$origin")
        tdma-slot "${slots[@]}" --from 2024-05-01T23:50:00Z --to 2024-05-02T00:10:00Z > through
        tdma-slot "${slots[@]}" --from 2024-05-01T23:50:00Z --to 2024-05-02T00:00:07Z > before
        tdma-slot "${slots[@]}" --from 2024-05-02T00:00:07Z --to 2024-05-02T00:10:00Z > after
        run_quiet diff through <(cat before after)
        assert [ "$(wc -l < through)" -ge 67 ]
    done
}

@test "tdma-slot: origin midnight restarts the cycle at 00:00 UTC, and leaves out the slot that is cut" {
    tdma-slot --slot src=1,length=15 --slot src=2,length=20 --origin midnight \
        --from 2024-05-01T23:59:00Z --to 2024-05-02T00:00:30Z | jq -c '.slot | [.src, .cycle, .start]' > got
    # 86400 s are 2468 cycles and 20 s
    assert_equal "$(cat got)" '[1,2467,"2024-05-01T23:59:05Z"]
[2,2467,"2024-05-01T23:59:20Z"]
[1,2468,"2024-05-01T23:59:40Z"]
[1,0,"2024-05-02T00:00:00Z"]
[2,0,"2024-05-02T00:00:15Z"]'
}

# Pitfall 4: tenths are exact.
@test "tdma-slot: slots of a tenth of a second do not drift (pitfall 4)" {
    tdma-slot --slot src=1,length=0.1 --slot src=2,length=0.2 --from 2024-05-01T12:00:00Z --to 2024-05-01T12:00:00.6Z |
        jq -c '.slot | [.src, .start]' > got
    assert_equal "$(cat got)" '[1,"2024-05-01T12:00:00Z"]
[2,"2024-05-01T12:00:00.100Z"]
[1,"2024-05-01T12:00:00.300Z"]
[2,"2024-05-01T12:00:00.400Z"]'
}

# Pitfall 5: a cycle without length would never end.
@test "tdma-slot: slots without length are refused (pitfall 5)" {
    assert_refused "option --slot: length '0' is outside 0.001 to 86400 s" tdma-slot --id 1 --slot src=1,length=0
    assert_refused "option --slot: length '0.0009' is outside 0.001 to 86400 s" tdma-slot --id 1 --slot src=1,length=0.0009
    assert_refused "option --length: '0' is outside 0.001 to 86400 s" tdma-slot --id 1 --mode auto --length 0
    assert_refused 'slot 0: a guard time of 10 s leaves nothing of 10 s' tdma-slot --id 1 --slot src=1 --guard 10
}

@test "tdma-slot: pings, LBL and minipackets of our own are transmissions; others' are not" {
    tdma-slot --id 3 --slot src=3,dest=5,kind=ping,rate=1 --slot src=3,kind=lbl --slot src=3,dest=0,kind=mini,mini=77 \
        --slot src=4,dest=3,kind=ping --slot src=3,rate=5 --guard 2 --from @0 --to @50 > got
    run jq -c 'select(.transmission).transmission' got
    assert_output '{"number":2147483648,"src":3,"dest":5,"rate":1,"ack_requested":false,"kind":"PING","deadline":"1970-01-01T00:00:08Z","slot_index":0}
{"number":2147493648,"src":3,"dest":0,"rate":0,"ack_requested":false,"kind":"LBL","deadline":"1970-01-01T00:00:18Z","slot_index":1}
{"number":2147503648,"src":3,"dest":0,"rate":0,"ack_requested":false,"kind":"MINI","mini":77,"deadline":"1970-01-01T00:00:28Z","slot_index":2}'
    run jq -c 'select(.slot).slot | [.kind, .initiate, .frames, .frame_bytes]' got
    assert_output '["PING",true,0,0]
["LBL",true,0,0]
["MINI",true,0,0]
["PING",false,0,0]
["DATA",true,8,256]'
}

@test "tdma-slot: what fits into a packet is as the table of rates says" {
    sed 's/^data  *5 .*/data 5 4 100 1 0 0 0/; /^data  *6/d' "$SEAUTILS_ROOT/schemas/seautils/micromodem.rates" > our.rates
    run -0 bash -c "tdma-slot --slot src=1,rate=5 --from @0 --to @1 --rates our.rates | jq -c '.slot | [.frames, .frame_bytes]'"
    assert_output '[4,100]'
    run -64 --separate-stderr tdma-slot --slot src=1,rate=6 --from @0 --to @1 --rates our.rates
    assert_regex "$stderr" '^tdma-slot: .*6'
    run -64 --separate-stderr tdma-slot --mode auto --id 1 --rate 7
    assert_regex "$stderr" '^tdma-slot: .*7'
    run -66 --separate-stderr tdma-slot --slot src=1 --from @0 --to @1 --rates gone.rates
    assert_equal "$stderr" 'tdma-slot: gone.rates: No such file or directory'
    echo 'data 0 1 32' > short.rates
    run -78 --separate-stderr tdma-slot --slot src=1 --from @0 --to @1 --rates short.rates
    assert_regex "$stderr" '^tdma-slot: short.rates:1: '
}

@test "tdma-slot: a master asks everybody, and each slot is longer by the poll and its way (eq. 2.5)" {
    polled=(--mode polled --master 1 --slot src=1 --slot src=2,dest=1,rate=1 --slot length=5 --max-range 1500 --from @0 --to @29)
    tdma-slot "${polled[@]}" --id 1 > master
    run jq -c 'select(.slot).slot | [.start, .initiate]' master
    assert_output '["1970-01-01T00:00:00Z",true]
["1970-01-01T00:00:12Z",true]
["1970-01-01T00:00:24Z",false]'
    run jq -c 'select(.transmission).transmission | [.src, .dest, .rate, .kind, .deadline]' master
    assert_output '[2,1,1,"DATA","1970-01-01T00:00:24Z"]'
    tdma-slot "${polled[@]}" --id 2 > other
    run jq -c 'select(.transmission or .slot.initiate)' other
    assert_output ''
    assert_equal "$(starts < other)" "$(starts < master)"
    assert_refused 'option --slot: master 1 can ask 2 for nothing but data' \
        tdma-slot --mode polled --master 1 --id 1 --slot src=2,dest=1,kind=ping
}

@test "tdma-slot: the same as text" {
    run_quiet tdma-slot --id 2 --slot src=2,dest=5,length=12.5,kind=ping,rate=1 --slot src=4 --slot length=5 --from @0 --to @25 -f text
    assert_output '1970-01-01T00:00:00Z       12.5 s  ping    2 to  5  rate 1  <
1970-01-01T00:00:12.500Z         10 s  data    4 to  *  rate 0
1970-01-01T00:00:22.500Z          5 s  blank'
}

@test "tdma-slot: binary records hold what those of JSON do" {
    tdma-slot "${three[@]}" --id 2 "${period[@]}" -f delimited > binary
    # a length, and the time first: field 1, 6 bytes
    run_quiet bash -c 'head -c 3 binary | od -An -tx1'
    assert_output --regexp '^ [0-9a-f]{2} 0a 06$'
    assert [ "$(wc -c < binary)" -lt "$(tdma-slot "${three[@]}" --id 2 "${period[@]}" | wc -c)" ]
}

@test "tdma-slot: what does not go together is refused" {
    assert_refused 'option --slot is required (try --help)' tdma-slot --id 1
    assert_refused 'option --id is required (try --help)' tdma-slot --slot src=1
    assert_refused 'option --id is required (try --help)' tdma-slot --mode auto
    assert_refused 'option --id is required (try --help)' tdma-slot --mode auto --from @0 --to @1
    assert_refused 'option --master is required in mode polled (try --help)' tdma-slot --mode polled --id 1 --slot src=1
    assert_refused 'option --slot: mode auto makes its own slots' tdma-slot --mode auto --id 1 --slot src=1
    assert_refused 'options --from and --to go together' tdma-slot --slot src=1 --from @0
    assert_refused '--to is before --from' tdma-slot --slot src=1 --from @1 --to @0
    assert_refused '--lead 10 s is not less than the shortest slot' tdma-slot --id 1 --slot src=1 --lead 10
    assert_refused 'options --simulate and --subsets exclude each other' tdma-slot --simulate 1,2 --subsets 2
    assert_refused 'option --subsets: 11 of 10 addresses is no set' tdma-slot --subsets 11
    assert_refused '254231775 sets are more than 10000000 (--draw takes some)' tdma-slot --subsets 5 --pool 1-127
    assert_refused 'options --simulate and --draw exclude each other' tdma-slot --simulate 1,2 --draw 2
    assert_refused 'simulations are written as ndjson or text' bash -c 'tdma-slot --simulate 1,2 -f delimited | cat; exit ${PIPESTATUS[0]}'
}

@test "tdma-slot: values out of their bounds are refused, each in its words" {
    while IFS='|' read -r words said; do
        # shellcheck disable=SC2086  # words of a command line
        assert_refused "option $said" tdma-slot $words
    done << 'END'
--mode free|--mode: 'free' is none of fixed, polled, auto
--slot src=31|--slot: src '31' is outside 0 to 30
--slot src=1,colour=red|--slot: 'colour' is none of src, dest, rate, length, kind, mini
--id 0|--id: '0' is outside 1 to 30
--id 31|--id: '31' is outside 1 to 30
--origin noon|--origin: time 'noon' is not of the form 2024-05-01T12:00:25Z
--guard -1|--guard: '-1' is not a number of seconds with at most 9 decimals
--lead 1e3|--lead: '1e3' is not a number of seconds with at most 9 decimals
--from 12:00|--from: time '12:00' is not of the form 2024-05-01T12:00:25Z
--max-range 100001|--max-range: '100001' is outside 0 to 100000 m
--cycle-init 61|--cycle-init: '61' is outside 0 to 60 s
--rule best|--rule: rule 'best' is none of hash, goby1, eq, eqn, rot
--coolness 0|--coolness: '0' is outside 1 to 1000000
--rate 15|--rate: '15' is outside 0 to 14
--silence 0|--silence: '0' is outside 0.001 to 2592000 s
--simulate 1,x|--simulate: address 'x' is outside 1 to 127
--simulate 1,1|--simulate: address 1 is given twice
--pool 9-1|--pool: pool '9-1' is empty
--p-collide 1.5|--p-collide: '1.5' is outside 0 to 1
--p-collide nan|--p-collide: 'nan' is outside 0 to 1
--runs 0|--runs: '0' is outside 1 to 1000000000
--start -1|--start: '-1' is outside 0 to 1000000000000
END
}

@test "tdma-slot: a configuration file names its line; slots come in its order" {
    cat > link.conf <<< $'# slots\nslot = src=1 length=15\nslot = src=2 longth=15'
    run -78 --separate-stderr tdma-slot -c link.conf --id 1
    # the first line that sets the option is what can be told of it
    assert_equal "$stderr" "tdma-slot: link.conf:2: option --slot: 'longth' is none of src, dest, rate, length, kind, mini"
    sed -i s/longth/length/ link.conf
    tdma-slot -c link.conf --from @0 --to @30 | jq .slot.src > got
    assert_equal "$(cat got)" $'1\n2'
}

# --- simulation ---

@test "tdma-slot: the time line of table 2.7" {
    run_quiet tdma-slot --simulate 1,3 --rule goby1 --coolness 5 -f text
    assert_equal "${#lines[@]}" 17
    assert_equal "$(sed '1d; $d' <<< "$output" | awk '{ print $3 $4 }' | xargs)" 'SS BB BS WB WS WB SB LW BW SL LS BB SL BB LS'
    assert_line --index 3 --regexp '^ +2 +30 +B +S +1 finds 3$'
    assert_line --index 7 --regexp '^ +6 +90 +S +B +3 finds 1$'
    assert_line 'everybody knows everybody after 7 slots (105 s), and all take turns after 9 (135 s)'
    tdma-slot --simulate 3,1 --rule goby1 --coolness 5 > json
    run jq -c 'select(.step.slot == 2).step | [.time_s, [.vehicles[] | [.id, .cycle, .does, .heard, .knows]]]' json
    assert_output '[30,[[1,1,"blank",[3],[1,3]],[3,1,"send",[],[3]]]]'
    assert_equal "$(tail -1 json)" '{"summary":{"runs":1,"failed":0,"proven":0,"quiet":1,"mean_slots":7,"mean_settled_slots":9,"longest_slots":7}}'
    assert_equal "$(wc -l < json)" 16
}

@test "tdma-slot: all sets of five of ten, as published, in less than two seconds" {
    SECONDS=0
    run summary --subsets 5 --pool 1-10 --rule eqn --coolness 7
    assert_output '[252,2,150.4]'
    assert [ $SECONDS -lt 2 ]
    run summary --subsets 5 --pool 1-10 --rule goby1 --coolness 7
    assert_output --regexp '^\[252,220,82.96875\]$' # 87.30 %, 82.969
    run summary --subsets 2 --pool 1-5 --rule rot --coolness 7 --runs 5040
    assert_output --regexp '^\[50400,0,11\.46[67]' # averages over 5040 start slots
    assert_equal "$(tdma-slot --subsets 5 --pool 1-10 | wc -l)" 253
}

@test "tdma-slot: hash fails nowhere, where others do for ever" {
    run bash -c "tdma-slot --subsets 5 --pool 1-10 --runs 20 | tail -1 | jq .summary.failed"
    assert_output 0
    run bash -c "tdma-slot --simulate 1,5 --rule goby1 --coolness 4 | tail -1 | jq -c '.summary | [.failed, .proven, .mean_slots]'"
    assert_output '[1,1,null]'
    run_quiet tdma-slot --simulate 1,5 --rule goby1 --coolness 4 -f text
    assert_line 'not everybody knows everybody after 16 slots, and never will'
    run summary --simulate 1,5 --coolness 4 --runs 100
    assert_output --regexp '^\[100,0,'
}

@test "tdma-slot: probability of a collision, as in figure 2.11" {
    # N = 4, C = 5, p = 0.75: 0.39074
    run bash -c "tdma-slot --subsets 4 --pool 1-127 --draw 200000 --limit 2 --rule goby1 --coolness 5 --p-collide 0.75 --seed 4 | jq '(.summary.quiet / .summary.runs - 0.39074) | fabs < 0.004'"
    assert_output true
}

@test "tdma-slot: the start, the seed and the runs decide" {
    run summary --simulate 1,2,3 --rule goby1 --coolness 4 --p-collide 0.5 --runs 50 --seed 1
    one=$output
    run summary --simulate 1,2,3 --rule goby1 --coolness 4 --p-collide 0.5 --runs 50 --seed 1
    assert_output "$one"
    run summary --simulate 1,2,3 --rule goby1 --coolness 4 --p-collide 0.5 --runs 50 --seed 2
    refute_output "$one"
    run bash -c "tdma-slot --simulate 1,3 --start 7 | head -1 | jq .step.slot"
    assert_output 7
}

# --- by the clock ---

@test "tdma-slot: a slot is written when it begins, within milliseconds, each once" {
    in_background tdma-slot --id 1 --slot src=1,length=0.25 --slot src=2,length=0.25
    wait_for bash -c '(($(wc -l < out) >= 8))'
    kill $pid
    wait $pid || assert_equal $? 143
    assert_equal "$(cat err)" ''
    assert_equal "$(starts < out | sort | uniq -d)" ''
    # the seconds of the times, and how much later they are: 20 ms at most even where tests run side by side
    run jq -r '[.time, .slot.start | (sub("\\.[0-9]+"; "") | fromdate) + ("0" + (capture("(?<f>\\.[0-9]+)")? // {f: ""}).f | tonumber)] | .[0] - .[1]' out
    for late in "${lines[@]}"; do
        [[ $(awk "BEGIN { print ($late > -0.0001 && $late < 0.1) }") == 1 ]] || fail "$late s late"
    done
}

@test "tdma-slot: a lead is before the beginning" {
    in_background tdma-slot --id 1 --slot src=1,length=0.4 --lead 0.2
    wait_for bash -c '(($(wc -l < out) >= 3))'
    kill $pid
    wait $pid || true
    run jq -r 'select(.time >= .slot.start) | .time' out
    assert_output ''
}

@test "tdma-slot: what comes too late for its slot is left out, and said (pitfall 5)" {
    in_background tdma-slot --id 1 --slot src=1,length=0.5
    wait_for test -s out
    kill -STOP $pid
    sleep 1.3
    kill -CONT $pid
    wait_for test -s err
    wait_for bash -c '(($(wc -l < out) >= 4))'
    kill $pid
    wait $pid || true
    assert_regex "$(head -1 err)" '^tdma-slot: woke [0-9.]+ s late: the slot at [0-9T:.-]+Z is left out$'
    assert_equal "$(starts < out | sort | uniq -d)" ''
}

@test "tdma-slot: a step of the clock is said and survived (pitfall 23)" {
    skip_if_sanitized "the clock is bent by a library that is loaded before theirs"
    command -v cc > /dev/null || skip "no C compiler"
    cc -shared -fPIC -O1 -o bent.so "$BATS_TEST_DIRNAME/data/tdma-slot/bent_clock.c" -ldl -lpthread
    echo 0 > offset
    in_background env LD_PRELOAD=./bent.so BENT_CLOCK=offset tdma-slot --id 1 --slot src=1,length=0.5
    wait_for bash -c '(($(wc -l < out) >= 2))'
    steps=0
    for offset in 86400 -3600; do
        echo $offset > offset.new && mv offset.new offset
        steps=$((steps + 1))
        wait_for bash -c "((\$(grep -c 'the clock was set' err) >= $steps))"
        before=$(wc -l < out)
        wait_for bash -c "((\$(wc -l < out) >= $before + 3))"
    done
    kill $pid
    wait $pid || true
    assert_regex "$(head -1 err)" '^tdma-slot: the clock was set 86[34][0-9]{2}\.[0-9]+ s forward: it is [0-9T:.-]+Z, the next slot is at [0-9T:.-]+Z$'
    assert_regex "$(sed -n 2p err)" '^tdma-slot: the clock was set (90000|89999)\.[0-9]+ s back: it is [0-9T:.-]+Z, the next slot is at [0-9T:.-]+Z$'
    # Hours and days lie between, and in each of them the slots are those of the grid.
    run bash -c "jq -r '.slot.start[:13]' out | uniq | wc -l"
    assert [ "$output" -ge 3 ]
    run bash -c "jq -r '.slot.start' out | grep -vE ':[0-9]{2}(\.500)?Z$'"
    assert_output ''
}

@test "tdma-slot: with --clock input time is that of the records" {
    { heard 3 2024-05-01T12:00:00Z; heard 3 2024-05-01T12:00:40Z; heard 3 2024-05-01T12:01:10Z; } > day.ndjson
    run_quiet tdma-slot --id 1 --slot src=1,length=30 --slot src=3,length=30 --clock input day.ndjson
    assert_equal "$(starts <<< "$output" | xargs)" '2024-05-01T12:00:00Z 2024-05-01T12:00:30Z 2024-05-01T12:01:00Z'
    assert_equal "$(jq -r .time <<< "$output" | xargs)" '2024-05-01T12:00:00Z 2024-05-01T12:00:30Z 2024-05-01T12:01:00Z'
    run -1 --separate-stderr tdma-slot --id 1 --slot src=1 --clock input <<< '{"reception":{"src":3}}'
    assert_equal "$stderr" 'tdma-slot: <stdin>:1: the first record has no time (--clock input)'
}

@test "tdma-slot: a bad record is located, dropped, and makes the status 1" {
    { heard 3 2024-05-01T12:00:00Z; echo '{"time":'; heard 3 2024-05-01T12:00:30Z; } > day.ndjson
    run -1 --separate-stderr tdma-slot --id 1 --slot src=1 --clock input day.ndjson
    assert_regex "$stderr" '^tdma-slot: day.ndjson:2: not valid JSON'
    assert_equal "${#lines[@]}" 4
    run -65 tdma-slot --id 1 --slot src=1 --clock input --strict day.ndjson
}

# --- discovery ---

auto=(--mode auto --id 1 --rule goby1 --coolness 5)

@test "tdma-slot: auto takes its turns among those that it hears (table 2.7)" {
    { heard 3 1970-01-01T00:00:01Z; heard 3 1970-01-01T00:03:00Z; } > day.ndjson
    tdma-slot "${auto[@]}" --clock input day.ndjson | jq -c '.slot | [.src, .start, .initiate]' > got
    # heard in the slot that ends at 15 s: from 45 s on; cycle 4 has its blank slot last but one
    assert_equal "$(cat got)" '[1,"1970-01-01T00:00:45Z",true]
[3,"1970-01-01T00:01:00Z",false]
[0,"1970-01-01T00:01:15Z",false]
[1,"1970-01-01T00:01:30Z",true]
[3,"1970-01-01T00:01:45Z",false]
[0,"1970-01-01T00:02:00Z",false]
[1,"1970-01-01T00:02:15Z",true]
[3,"1970-01-01T00:02:30Z",false]
[0,"1970-01-01T00:02:45Z",false]
[1,"1970-01-01T00:03:00Z",true]'
}

@test "tdma-slot: every record of somebody heard counts, others do not" {
    known() { tdma-slot "${auto[@]}" -v --clock input 2>&1 > /dev/null | sed -n 's/.*known vehicles: //p' | tail -1; }
    at='{"time":"2024-05-01T12:00:00Z",'
    assert_equal "$(known <<< "$at\"reception\":{\"src\":4,\"dest\":9}}")" '1 4'
    assert_equal "$(known <<< "$at\"ack\":{\"src\":5,\"dest\":1}}")" '1 5'
    assert_equal "$(known <<< "$at\"range\":{\"src\":1,\"dest\":6}}")" '1 6'
    assert_equal "$(known <<< "$at\"modem\":{\"event\":\"HEARD\",\"src\":7}}")" '1 7'
    assert_equal "$(known <<< "$at\"modem\":{\"event\":\"READY\",\"src\":7}}")" ''
    assert_equal "$(known <<< "$at\"transmission\":{\"src\":8,\"dest\":9}}")" ''
    assert_equal "$(known <<< "$at\"reception\":{\"src\":1,\"dest\":9}}")" ''
    assert_equal "$(known <<< "$at\"reception\":{\"src\":0,\"dest\":9}}")" ''
    assert_equal "$(known <<< "$at\"reception\":{\"src\":31,\"dest\":9}}")" ''
    assert_equal "$(known <<< "$at\"range\":{\"src\":1,\"dest\":0,\"method\":\"LBL_REMUS\"}}")" ''
}

@test "tdma-slot: who is silent is forgotten" {
    { heard 3 1970-01-01T00:00:01Z; heard 0 1970-01-01T00:10:00Z; } > day.ndjson
    run -0 --separate-stderr tdma-slot "${auto[@]}" --silence 300 -v --clock input day.ndjson
    assert_equal "$stderr" 'tdma-slot: known vehicles: 1 3
tdma-slot: known vehicles: 1'
    # 15 + 300 s, so at 315 s, and then the first cycle of 30 s after 330 s
    assert_equal "$(jq -r '.slot | select(.src == 3).start' <<< "$output" | tail -1)" 1970-01-01T00:04:45Z
    assert_equal "$(jq -r '.slot.start | select(. > "1970-01-01T00:05:14Z")' <<< "$output" | head -1)" 1970-01-01T00:06:00Z
}

@test "tdma-slot: a FIFO brings feedback, and the state is kept over kill -9" {
    in_background tdma-slot "${auto[@]}" --length 0.2 --feedback mac.fifo --state known -v
    wait_for test -p mac.fifo
    heard 3 "$(date -u +%FT%T.%NZ)" > mac.fifo
    echo rubbish > mac.fifo
    echo '{"modem":{"event":"HEARD","src":5}}' > mac.fifo
    wait_for grep -q '^tdma-slot: known vehicles: 1 3 5$' err
    wait_for grep -q '^heard 5 ' known
    wait_for bash -c "jq -e 'select(.slot.src == 5)' out"
    kill -9 $pid
    wait $pid || true
    assert_regex "$(cat err)" 'mac.fifo:2: not valid JSON'
    in_background tdma-slot "${auto[@]}" --length 0.2 --state known
    wait_for bash -c "jq -e 'select(.slot.src == 5)' out"
    kill $pid
    wait $pid || assert_equal $? 143
    assert_equal "$(cat err)" ''
}

@test "tdma-slot: a state is used for a period too; one that is damaged is said and counts as none" {
    { heard 3 1970-01-01T00:00:01Z; heard 7 1970-01-01T00:01:00Z; } > day.ndjson
    tdma-slot "${auto[@]}" --clock input --state known day.ndjson > /dev/null
    cp known kept
    run bash -c "tdma-slot ${auto[*]} --state known --from @300 --to @400 | jq .slot.src | sort -u | xargs"
    assert_output '0 1 3 7'
    cmp known kept
    sed -i 's/heard 7/heard 8/' known
    run -0 --separate-stderr tdma-slot "${auto[@]}" --state known --from @300 --to @331
    assert_equal "$stderr" 'tdma-slot: known: its check does not fit: nobody is known'
    assert_equal "$(jq .slot.src <<< "$output" | xargs)" '1 0 0' # cycle 11 is excited
    head -c 30 kept > known
    run -0 --separate-stderr tdma-slot "${auto[@]}" --state known --from @300 --to @331
    assert_equal "$stderr" 'tdma-slot: known: the text is cut short: nobody is known'
    : > known
    run -0 --separate-stderr tdma-slot "${auto[@]}" --state known --from @300 --to @331
    assert_equal "$stderr" 'tdma-slot: known: the text is cut short: nobody is known'
    run -66 --separate-stderr tdma-slot "${auto[@]}" --state . --from @300 --to @331
    assert_equal "$stderr" 'tdma-slot: .: Is a directory'
}

@test "tdma-slot: a state that cannot be written is said once, and nothing stops" {
    { for k in 3 4 5; do heard $k 1970-01-01T00:00:0${k}Z; done; heard 3 1970-01-01T00:05:00Z; } > day.ndjson
    run -0 --separate-stderr tdma-slot "${auto[@]}" --clock input --state gone/known day.ndjson
    assert_equal "$stderr" 'tdma-slot: gone/known.new: No such file or directory: who is known is not kept'
    assert [ "${#lines[@]}" -gt 5 ]
}

@test "tdma-slot: a feedback that is no FIFO is refused with 73" {
    : > mac.fifo
    run -73 --separate-stderr tdma-slot "${auto[@]}" --feedback mac.fifo
    assert_equal "$stderr" 'tdma-slot: mac.fifo: exists and is no FIFO'
}

# --- what every tool does ---

@test "tdma-slot: a full disk is status 74; a reader that goes ends it" {
    run -74 --separate-stderr bash -c "tdma-slot ${three[*]} ${period[*]} > /dev/full"
    assert_equal "$stderr" 'tdma-slot: write failed: No space left on device'
    run -0 bash -c "tdma-slot ${three[*]} --from @0 --to @100000000 | head -1 | wc -l"
    assert_output 1
    in_background bash -c "tdma-slot --id 1 --slot src=1,length=0.2 | head -1"
    wait_for bash -c "! kill -0 $pid"
}

@test "tdma-slot: signals end it as the system would" {
    for signal in TERM INT; do
        (
            trap - INT
            exec perl -e '$SIG{INT} = "DEFAULT"; exec @ARGV' tdma-slot --id 1 --slot src=1,length=0.2
        ) > out 2> err 3>&- &
        pid=$!
        wait_for test -s out
        kill -$signal $pid
        status=0
        wait $pid || status=$?
        assert_equal $status $((128 + $(kill -l $signal)))
        : > out
    done
}

@test "tdma-slot: a FILE may stand behind a repeatable option" {
    heard 3 2024-05-01T12:00:00Z > day.ndjson
    run_quiet tdma-slot --id 1 --clock input --slot src=1 day.ndjson
    assert_equal "${#lines[@]}" 1
}

@test "tdma-slot: twice the same" {
    for options in "--subsets 4 --pool 1-9 --p-collide 0.7 --limit 2000 --seed 3" "${three[*]} ${period[*]}" \
        "--subsets 3 --draw 500 --p-collide 0.5 --limit 500"; do
        # shellcheck disable=SC2086  # words of a command line
        cmp <(tdma-slot $options) <(env LC_ALL=de_DE.UTF-8 TZ=Pacific/Kiritimati tdma-slot $options)
    done
}
