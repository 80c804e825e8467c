#!/usr/bin/env bats
# queue-sched: messages in, a transmission for each turn out. Time comes from the records where it
# can; vehicle 3 speaks, and the first record is at 2024-05-01T12:00:00Z, 1714564800.

zero=1714564800

setup() {
    load test_helper
    cd "$BATS_TEST_TMPDIR" || return
}

at() { date -u -d "@$((zero + $1))" +%Y-%m-%dT%H:%M:%SZ; }

# message T ID DEST TEXT [MEMBERS]: a record of a message; MEMBERS is more JSON.
message() {
    echo "{\"time\":\"$(at "$1")\",\"message\":{\"id\":$2,\"dest\":$3,\"data\":\"$(printf %s "$4" | base64 -w 0)\"${5:+,$5}}}"
}

# slot T [FRAMES BYTES [MEMBERS]]: a turn of vehicle 3 of ten seconds.
slot() {
    echo "{\"time\":\"$(at "$1")\",\"slot\":{\"index\":1,\"src\":3,\"rate\":1,\"start\":\"$(at "$1")\",\"end\":\"$(at $(($1 + 10)))\",\"frames\":${2:-1},\"frame_bytes\":${3:-64}${4:+,$4}}}"
}

# ack T SRC NUMBER FRAMES [DEST], result T NUMBER OUTCOME: numbers count from 0, the first transmission.
ack() { echo "{\"time\":\"$(at "$1")\",\"ack\":{\"src\":$2,\"dest\":${5:-3},\"transmission\":$((zero + $3)),\"frame\":[$4]}}"; }
result() { echo "{\"time\":\"$(at "$1")\",\"result\":{\"transmission\":$((zero + $2)),\"outcome\":\"$3\"}}"; }

# sched [OPTION]...: replays standard input.
sched() { queue-sched --id 3 --clock input -q "$@"; }

# in_short: each transmission as `number>dest frame|frame`, with ! where it wants acknowledgements, each drop as
# `data REASON`.
in_short() {
    jq -r --argjson zero "$zero" '
        (.transmission | select(.) | "\(.number - $zero)>\(.dest)\(if .ack_requested then "!" else "" end) \(.frame | map(@base64d) | join("|"))"),
        (.drop | select(.) | "\(.data | @base64d) \(.reason)")'
}

short() { sched "$@" | in_short; }

# assert_short EXPECTED [OPTION]...: of the records on standard input.
assert_short() {
    local expected=$1
    shift
    run_quiet short "$@"
    assert_output "$expected"
}

# --- the contest

@test "queue-sched: the winners of Figure 2.6: 1,2,1,2,1,2,3,1,2,1" {
    printf '%s\n' '[queue]' 'ack = false' 'max_queue = 1' '[queue.1]' 'ttl_s = 1000' '[queue.2]' 'value_base = 2' \
        'ttl_s = 2000' '[queue.3]' 'ttl_s = 3000' > c.conf
    {
        slot 0
        for ((k = 1; k <= 10; ++k)); do
            for ((id = 1; id <= 3; ++id)); do message $((k * 100)) $id 2 $id; done
            slot $((k * 100)) 1 1
            result $((k * 100 + 1)) $((k - 1)) SENT
        done
    } > in
    run_quiet sched -c c.conf in
    assert_equal "$(in_short <<< "$output" | grep '>' | cut -d ' ' -f 2 | paste -sd ,)" 1,2,1,2,1,2,3,1,2,1
    # what else may decide
    for policy in value,2222222222 ttl,1111111111 oldest,1231231231; do
        run_quiet sched -c c.conf --policy ${policy%,*} in
        assert_equal "$(in_short <<< "$output" | grep '>' | cut -d ' ' -f 2 | tr -d '\n')" ${policy#*,}
    done
}

@test "queue-sched: pitfall 7: ties go to the lowest id, then the lowest destination" {
    { message 0 9 0 d && message 0 3 4 c && message 0 3 2 b && message 0 2 2 a && for t in 10 20 30 40; do slot $t 1 1; done; } |
        assert_short $'0>2! a\n1>2! b\n2>4! c\n3>0 d'
}

@test "queue-sched: pitfall 6: a blackout begins with the first message, and counts from the hand-over" {
    { message 0 1 2 a && message 0 1 2 b && slot 1 2 && ack 10 2 0 0 && slot 20 && slot 31; } |
        assert_short $'0>2! b\n1>2! a' -c <(printf '%s\n' '[queue.1]' 'blackout_time_s = 30')
}

@test "queue-sched: --explain writes each contest, --stats what became of each queue" {
    printf '%s\n' '[queue.2]' 'value_base = 2' > c.conf
    { message 0 1 2 aa && message 0 2 4 b && message 5 9 2 'too large' && slot 10 1 4 && ack 12 4 0 0; } > in
    run_quiet sched -c c.conf --explain --stats in
    said=$output
    run jq -c '.contest | select(.) | [.winner_id, .free_bytes, [.candidate[] | [.id, .skip]]]' <<< "$said"
    assert_output '[2,4,[[2,"NONE"],[1,"NONE"],[9,"SIZE"]]]
[null,3,[[1,"DEST"],[9,"SIZE"],[2,"EMPTY"]]]'
    run jq -c '.queue | select(.) | [.id, .dest, .queued, .sends, .delivered, .bytes, .oldest_age_s, .mean_age_s]' <<< "$said"
    assert_output '[1,2,1,0,0,2,12,null]
[2,4,0,1,1,0,null,12]
[9,2,1,0,0,9,7,null]'
}

@test "queue-sched: a contest of a thousand queues fits into a record, and says what is left out" {
    { message 0 0 2 x | awk '{ for (id = 0; id < 1000; ++id) { line = $0; sub(/"id":0/, "\"id\":" id, line); print line } }' && slot 1 1 1; } > in
    run_quiet sched --explain in
    assert [ "$(wc -L <<< "$output")" -le 4095 ]
    run jq '.contest | select(.) | .left_out + (.candidate | length)' <<< "$output"
    assert_output $'1000\n1000'
}

# --- packets

@test "queue-sched: pitfall 9: a message that does not fit blocks no smaller one behind it" {
    { message 0 1 2 small && message 1 1 2 'much too large' && message 1 2 2 other && slot 10 1 10 && slot 20 1 14; } |
        assert_short $'0>2! smallother\n1>2! much too large'
}

@test "queue-sched: all frames are filled, messages are never split" {
    { for m in aaa bbb cc dd e; do message 0 1 2 $m; done && slot 1 8 4; } |
        assert_short '0>2! aaae|bbb|ccdd' -c <(printf '%s\n' '[queue]' 'newest_first = false')
}

@test "queue-sched: pitfall 12: what is for everybody rides along, not the other way round" {
    { message 0 1 2 a && message 0 2 0 '*' && slot 1; } | assert_short '0>2! a*'
    { message 0 2 2 a && message 0 1 0 '*' && slot 1; } | assert_short '0>0 *'
    { message 0 1 0 '*' '"ack_requested":true' && slot 1; } | assert_short '0>0 *'
}

@test "queue-sched: a slot may say the destination, and that nothing is acknowledged" {
    { message 0 1 2 a && message 0 1 4 b && message 0 2 4 c '"ack_requested":false' && slot 1 1 64 '"dest":4' &&
        slot 2 1 64 '"ack_requested":false'; } | assert_short '0>4! bc'
    { message 0 1 2 a && message 0 2 4 c '"ack_requested":false' && slot 2 1 64 '"ack_requested":false'; } |
        assert_short '0>4 c'
}

@test "queue-sched: the transmission holds what the modem needs" {
    { message 0 1 2 a && slot 1 1 64 '"polled":true'; } > in
    run_quiet sched in
    assert_output "{\"time\":\"$(at 1)\",\"transmission\":{\"number\":$zero,\"src\":3,\"dest\":2,\"rate\":1,\"ack_requested\":true,\"kind\":\"DATA\",\"frame\":[\"YQ==\"],\"deadline\":\"$(at 11)\",\"polled\":true,\"slot_index\":1}}"
}

@test "queue-sched: the largest packet fits into a record" {
    { for ((k = 0; k < 8; ++k)); do message 0 1 2 "$(printf '%0256d' $k)"; done && slot 1 8 256; } > in
    run_quiet sched in
    assert_equal "$(jq '.transmission.frame | map(length) | add' <<< "$output")" $((8 * 344))
}

# --- under way

@test "queue-sched: pitfall 11: an acknowledgement is of a destination, a transmission and a frame" {
    { message 0 1 2 a && message 1 1 2 b && slot 10 2 1 && ack 12 4 0 0,1 && ack 12 2 7 0,1 && ack 12 2 0 5 &&
        ack 12 2 0 0,1 4 && slot 15 2 1 && ack 16 2 0 1 && ack 17 2 0 1 && slot 40 2 1; } |
        assert_short $'0>2! b|a\n1>2! b'
}

@test "queue-sched: pitfall 13: without acknowledgement it is gone when sent, not when handed over" {
    { message 0 1 2 a '"ack_requested":false' && slot 10 && result 12 0 FAILED && slot 20 && result 22 1 SENT && slot 30; } |
        assert_short $'0>2 a\n1>2 a'
}

@test "queue-sched: what was not sent waits again at once, and its queue's turn is not used up" {
    for outcome in LATE BUSY FAILED REFUSED; do
        { message 0 1 2 a && slot 10 && result 12 0 $outcome && slot 13; } |
            assert_short $'0>2! a\n1>2! a' -c <(printf '%s\n' '[queue]' 'blackout_time_s = 100')
    done
}

@test "queue-sched: without an acknowledgement it is sent again when --ack-wait is over" {
    { message 0 1 2 a && slot 10 && result 12 0 SENT && slot 29 && slot 30; } > in
    assert_short $'0>2! a\n1>2! a' < in
    assert_short $'0>2! a\n1>2! a' --ack-wait 9 < in
    assert_short '0>2! a' --ack-wait 10.5 < in
}

@test "queue-sched: pitfall 10: overflow drops the oldest, even under way, and its late acknowledgement does no harm" {
    printf '%s\n' '[queue]' 'max_queue = 1' > c.conf
    { message 0 1 2 a && slot 1 && message 2 1 2 b && ack 3 2 0 0 && slot 4; } |
        assert_short $'0>2! a\na OVERFLOW\n1>2! b' -c c.conf
    echo 'newest_first = false' >> c.conf
    { message 0 1 2 a && message 2 1 2 b && slot 4; } | assert_short $'b OVERFLOW\n0>2! a' -c c.conf
}

@test "queue-sched: expiry is told once, and what would expire on its way is not sent" {
    printf '%s\n' '[queue]' 'ttl_s = 30' > c.conf
    { message 0 1 2 a && slot 15 && slot 21 && slot 30 && slot 31 && slot 32; } |
        assert_short $'0>2! a\na EXPIRED' -c c.conf --ack-wait 0
    { message 0 1 2 a && slot 21 && slot 31 && slot 32; } | assert_short 'a EXPIRED' -c c.conf
}

@test "queue-sched: a drop says what, why, and how old" {
    { message 0 1 2 a "\"created\":\"$(at -5)\"" && slot 1 && result 2 0 SENT && message 100 1 2 b; } > in
    printf '%s\n' '[queue]' 'ttl_s = 30' > c.conf
    run_quiet sched -c c.conf in
    # as soon as it is older than that: live, in the next nanosecond
    assert_line --index 1 "{\"time\":\"2024-05-01T12:00:25.000000001Z\",\"drop\":{\"id\":1,\"src\":3,\"dest\":2,\"reason\":\"EXPIRED\",\"why\":\"older than 30 s\",\"created\":\"$(at -5)\",\"age_s\":30.000000001,\"sends\":1,\"bytes\":1,\"data\":\"YQ==\"}}"
}

@test "queue-sched: messages that can never go are dropped at once" {
    message 0 1 2 "$(printf '%257d' 0)" > in
    run_quiet sched in
    assert_equal "$(jq -r '.drop | .reason + ": " + .why' <<< "$output")" 'TOO_LARGE: 257 bytes where the largest frame holds 256'
    message 0 1 2 "$(printf '%2048d' 0)" > in
    run_quiet sched in
    assert_equal "$(jq -r '.drop | .reason + ": " + .why + " \(.data | length)"' <<< "$output")" \
        'TOO_LARGE: 2048 bytes where the largest frame holds 256 2732'
    while IFS='|' read -r record said; do
        run_quiet sched <<< "{\"time\":\"$(at 0)\",\"message\":{$record}}"
        assert_equal "$(jq -r '.drop | .reason + ": " + .why' <<< "$output")" "REFUSED: $said"
    done << 'END'
"id":1,"dest":3,"data":"AA=="|dest 3 is this vehicle
"id":1,"dest":31,"data":"AA=="|dest 31 is outside 0 to 30
"id":32768,"dest":2,"data":"AA=="|id 32768 is outside 0 to 32767
"id":1,"dest":2,"src":4,"data":"AA=="|src 4 is not this vehicle, 3
"id":1,"dest":2|a message without data
END
}

# --- turns

@test "queue-sched: other slots, and what is not for the queues, are passed on as they came" {
    cat > in << END
{"time":"$(at 0)","slot":{"src":4,"kind":"DATA","end":"$(at 9)","frames":1,"frame_bytes":32}}
{"time":"$(at 0)","slot":{"src":3,"dest":4,"kind":"PING","end":"$(at 9)"}}
{"time":"$(at 0)","transmission":{"number":7,"src":3,"dest":4,"rate":0,"ack_requested":false,"kind":"PING"}}
{"time":"$(at 0)","reception":{"src":4,"frame":["AA=="]},"weather":{"wind_mps":11}}
{"time":"$(at 0)","weather":{"wind_mps":11}}
END
    run_quiet sched in
    assert_output "$(cat in)"
    run_quiet bash -c "queue-sched --id 3 -q --clock input -f delimited in | queue-sched --id 3 -q --clock input -F delimited"
    assert_output "$(cat in)"
}

@test "queue-sched: pitfall 22: live, only the newest turn is answered, and none that has ended" {
    turn() { # INDEX BEGINS ENDS: seconds from now
        local now
        now=$(date +%s)
        echo "{\"slot\":{\"index\":$1,\"src\":3,\"start\":\"$(date -u -d @$((now + $2)) +%FT%TZ)\",\"end\":\"$(date -u -d @$((now + $3)) +%FT%TZ)\",\"frames\":1,\"frame_bytes\":64}}"
    }
    { echo '{"message":{"id":1,"dest":2,"data":"YQ=="}}' && turn 1 0 60 && turn 2 0 60 && turn 3 0 60; } > in
    run_quiet queue-sched --id 3 -q in
    assert_equal "$(jq -c .transmission.slot_index <<< "$output")" 3
    { echo '{"message":{"id":1,"dest":2,"data":"YQ=="}}' && turn 1 -20 -1; } > in
    run_quiet queue-sched --id 3 -q in
    assert_output ''
}

@test "queue-sched: a slot that cannot be filled is refused, and the next record read" {
    while IFS='|' read -r members said; do
        { echo "{\"time\":\"$(at 0)\",\"slot\":{\"src\":3,$members}}" && message 1 1 2 a && slot 2; } > in
        run -1 --separate-stderr sched in
        assert_equal "$stderr" "queue-sched: in:1: $said"
        assert_equal "$(in_short <<< "$output")" '0>2! a'
    done << END
"frames":1,"frame_bytes":32|slot without its end
"end":"$(at 9)","frame_bytes":32|slot: frames 0 is outside 1 to 8
"end":"$(at 9)","frames":9,"frame_bytes":32|slot: frames 9 is outside 1 to 8
"end":"$(at 9)","frames":8,"frame_bytes":257|slot: frame_bytes 257 is outside 1 to 256
"end":"$(at 9)","frames":1,"frame_bytes":32,"dest":31|slot: dest 31 is outside 0 to 30
END
    run -1 --separate-stderr sched <<< '{"message":{"id":1,"dest":2,"data":"AA=="}}'
    assert_equal "$stderr" 'queue-sched: <stdin>:1: no time, where --clock input takes it'
}

# --- the spool

# serve [OPTION]...: starts a live queue-sched on q.sock, in the background; its turns come from the
# FIFO `in`, its records go into the file `got`.
serve() {
    [[ -p in ]] || mkfifo in
    queue-sched --id 3 --listen q.sock "$@" < in >> got 2>> said 3>&- &
    pid=$!
    exec {hold}> in
    for ((k = 0; k < 200; ++k)); do socat -u OPEN:/dev/null UNIX-CONNECT:q.sock,type=5 2> /dev/null && return || sleep 0.02; done
    fail "no socket: $(cat said)"
}

hand_over() { # RECORD: the answer
    socat -t 5 - UNIX-CONNECT:q.sock,type=5 <<< "$1"
}

turn_now() {
    echo "{\"slot\":{\"src\":3,\"end\":\"$(date -u -d '+60 seconds' +%FT%TZ)\",\"frames\":8,\"frame_bytes\":256}}"
}

@test "queue-sched: a socket answers when a message is safe, or why it is not taken" {
    serve --spool q.db
    run_quiet hand_over '{"message":{"id":1,"dest":2,"data":"YQ=="}}'
    assert_output ok
    run_quiet hand_over '{"message":{"id":1,"dest":3,"data":"YQ=="}}'
    assert_output 'error: dest 3 is this vehicle'
    run_quiet hand_over '{"slot":{"src":3}}'
    assert_output 'error: only messages are taken here, not slot'
    run_quiet hand_over '{"message":'
    assert_output --partial 'error: '
    assert_equal "$(sqlite3 "file:$PWD/q.db?immutable=1" 'select 1' 2>&1 | head -1)" 1
    exec {hold}>&-
    wait "$pid"
    assert_equal "$(cat said)" ''
    assert [ ! -e q.sock ]
    run sqlite3 q.db 'select id, dest, data from message'
    assert_output '1|2|a'
}

@test "queue-sched: dccl-encode hands messages over, and they are sent" {
    cp "$BATS_TEST_DIRNAME/data/schemas/nav.proto" .
    serve
    run_quiet dccl-encode -s nav.proto --dest 2 --send q.sock <<< '{"time_s":1714564825,"depth_m":31.4,"leg":12}'
    turn_now >&"$hold"
    exec {hold}>&-
    wait "$pid"
    assert_equal "$(jq -r '.transmission.frame[0]' got | base64 -d | digits)" 14d9a8003a010d
}

@test "queue-sched: what was accepted survives kill -9, and no number comes twice" {
    : > numbers
    for ((round = 0; round < 5; ++round)); do
        serve --spool q.db
        for m in a b c; do
            run_quiet hand_over "{\"message\":{\"id\":1,\"dest\":2,\"data\":\"$(printf %s "$round$m" | base64)\"}}"
            assert_output ok
        done
        : > got
        turn_now >&"$hold"
        for ((k = 0; k < 200; ++k)); do [[ -s got ]] && break || sleep 0.02; done
        jq .transmission.number got >> numbers
        kill -9 "$pid"
        wait "$pid" || true
        exec {hold}>&-
        rm -f got
    done
    assert_equal "$(sort -u numbers | wc -l)" 5
    # none was acknowledged: all fifteen wait again
    { turn_now && turn_now; } > turns
    run_quiet queue-sched --id 3 --spool q.db --stats turns
    assert_equal "$(jq -r '.transmission.frame // empty | map(@base64d) | join("")' <<< "$output")" 4c4b4a3c3b3a2c2b2a1c1b1a0c0b0a
    assert_equal "$(jq '.queue.queued // empty' <<< "$output")" 15
}

@test "queue-sched: a full disk refuses new messages, sends what is held, and is said once" {
    cat > run << 'END'
trap '' XFSZ
ulimit -f 40
exec queue-sched "$@"
END
    { for ((k = 0; k < 200; ++k)); do
        message $k 1 2 "$(printf %0250d $k)"
        slot $k 1 1
    done && slot 250 8 256; } > in
    run bash run --id 3 --clock input --spool q.db -c <(printf '%s\n' '[queue]' 'ack = false' 'max_queue = 1000') in
    assert_equal "$status" 0
    assert_equal "$(grep -c 'queue-sched: spool' <<< "$output")" 1
    refused=$(grep -c '"REFUSED","why":"not stored: spool' <<< "$output")
    assert [ "$refused" -gt 0 ]
    assert [ "$refused" -lt 200 ]
    run grep -c '"transmission"' <<< "$output"
    assert_output 1
}

@test "queue-sched: a spool that is none, damaged, in use, or nowhere is left alone and named" {
    head -c 5000 /dev/urandom > noise.db
    cp noise.db before
    run -65 --separate-stderr queue-sched --id 3 --spool noise.db < /dev/null
    assert_equal "$stderr" "queue-sched: spool 'noise.db' is not a spool (move it away to start with an empty one)"
    cmp noise.db before
    sqlite3 other.db 'create table bookmarks(url)'
    run -65 --separate-stderr queue-sched --id 3 --spool other.db < /dev/null
    assert_equal "$stderr" "queue-sched: spool 'other.db' is another program's database"
    run -73 --separate-stderr queue-sched --id 3 --spool no/such/q.db < /dev/null
    assert_equal "$stderr" "queue-sched: spool 'no/such/q.db' cannot be opened for writing: No such file or directory"
    serve --spool q.db
    run -75 --separate-stderr queue-sched --id 3 --spool q.db < /dev/null
    assert_equal "$stderr" "queue-sched: spool 'q.db' is in use by another process"
    exec {hold}>&-
    wait "$pid"
}

@test "queue-sched: without a spool, what is left at the end is told" {
    message 0 1 2 a > in
    run -0 --separate-stderr queue-sched --id 3 --clock input in
    assert_equal "$stderr" 'queue-sched: 1 message still queued, and lost without --spool'
    run_quiet queue-sched --id 3 --clock input --spool q.db in
}

# --- feedback, signals

@test "queue-sched: what the modem says comes by a FIFO, from any number of writers" {
    mkfifo in
    queue-sched --id 3 --feedback a.fifo --feedback b.fifo -f ndjson < in > got 2> said 3>&- &
    pid=$!
    exec {hold}> in
    for ((k = 0; k < 200; ++k)); do [[ -p a.fifo && -p b.fifo ]] && break || sleep 0.02; done
    { echo '{"message":{"id":1,"dest":2,"data":"YQ=="}}' && turn_now; } >&"$hold"
    for ((k = 0; k < 200; ++k)); do [[ -s got ]] && break || sleep 0.02; done
    number=$(jq .transmission.number got)
    echo "{\"ack\":{\"src\":2,\"dest\":3,\"transmission\":$number,\"frame\":[0]}}" > a.fifo
    echo '{"reception":{"src":2}}' > b.fifo
    kill -USR1 "$pid"
    for ((k = 0; k < 200; ++k)); do grep -q '"delivered":1' got && break || { kill -USR1 "$pid" && sleep 0.02; }; done
    run jq -c 'select(.queue) | .queue.delivered' got
    assert_line 1
    refute grep reception got
    exec {hold}>&-
    wait "$pid"
    assert_equal "$(cat said)" ''
}

@test "queue-sched: a message expires, and is told, although nothing comes" {
    mkfifo in
    queue-sched --id 3 -c <(printf '%s\n' '[queue]' 'ttl_s = 0.2') < in > got 3>&- &
    pid=$!
    exec {hold}> in
    echo '{"message":{"id":1,"dest":2,"data":"YQ=="}}' >&"$hold"
    for ((k = 0; k < 200; ++k)); do [[ -s got ]] && break || sleep 0.02; done
    assert_equal "$(jq -r .drop.reason got)" EXPIRED
    exec {hold}>&-
    wait "$pid"
}

# --- what all tools do

@test "queue-sched: what is wrong with a command line or a configuration is located" {
    while IFS='|' read -r words said; do
        # shellcheck disable=SC2086  # words of a command line
        run -64 --separate-stderr queue-sched $words < /dev/null
        assert_equal "$stderr" "queue-sched: $said"
    done << 'END'
|option --id is required (try --help)
--id 0|option --id: '0' is outside 1 to 30
--id 31|option --id: '31' is outside 1 to 30
--id 3 --policy luck|option --policy: 'luck' is none of priority, value, ttl, oldest
--id 3 --ack-wait 1e3|option --ack-wait: '1e3' is outside 0 to 1000000 s
--id 3 --max-frame 2049|option --max-frame: '2049' is outside 1 to 2048 bytes
--id 3 --clock sundial|option --clock: clock 'sundial' is none of system, input, warp:N,BOOT,SIM
--zebra|unknown option --zebra (try --help)
END
    while IFS='|' read -r section line said; do
        printf '%s\n' "[$section]" "$line" > c.conf
        run -78 --separate-stderr queue-sched --id 3 -c c.conf < /dev/null
        assert_equal "$stderr" "queue-sched: c.conf:2: $said"
    done << 'END'
queue|ttl_s = 0|ttl_s '0' is not more than 0 and at most 1000000000 s, or infinite
queue.7|max_queue = 0|max_queue '0' is not 1 to 1000000 messages
queue.7.3|value_base = -1|value_base '-1' is not 0 to 1000000, with at most 6 decimals
queue.7.31|ack = true|'7.31' names no queue: a DCCL id of 0 to 32767, or that, a point, and a modem ID of 0 to 30
queue|tll_s = 5|unknown key 'tll_s' (did you mean 'ttl_s'?)
queues|ttl_s = 5|unknown key 'queues.ttl_s'
END
}

@test "queue-sched: --print-config is such a file, and says the defaults" {
    queue-sched --print-config | sed -n '/\[queue\]/,$s/^# *\([[a-z_]*.*\)/\1/p' | grep -E '^\[|^[a-z_]+ = ' > c.conf
    assert_equal "$(wc -l < c.conf)" 7
    run_quiet queue-sched --id 3 -c c.conf --clock input -q < <(message 0 1 2 a)
    run_quiet queue-sched --id 3 -c <(queue-sched --print-config) < /dev/null
}

@test "queue-sched: a full disk, a reader that goes away, a live pipe, a signal" {
    echo "{\"time\":\"$(at 0)\",\"slot\":{\"src\":4,\"kind\":\"DATA\"}}" > one
    run -74 --separate-stderr bash -c 'queue-sched --id 3 one > /dev/full'
    assert_equal "$stderr" 'queue-sched: write failed: No space left on device'
    yes "$(cat one)" | head -20000 > many
    # -q: a reader that is slow to begin is said to be slow
    run_quiet bash -c "queue-sched --id 3 -q many | head -1; exit \${PIPESTATUS[0]/141/0}"
    assert_output "$(cat one)"
    assert_answered_at_once one one queue-sched --id 3
    for signal in TERM INT HUP; do assert_dies_of $signal one queue-sched --id 3 --spool q.db; done
    { cat one && echo nonsense && cat one; } > three
    run -1 --separate-stderr queue-sched --id 3 three
    assert_output "$(cat one one)"
    assert_regex "$stderr" '^queue-sched: three:2: '
    run -65 queue-sched --id 3 --strict three
    # a FILE behind an option that may repeat
    run_quiet queue-sched --id 3 --feedback f.fifo one
    assert_output "$(cat one)"
}

@test "queue-sched: --help names what the manual names" {
    run_quiet queue-sched --help
    assert [ "${#lines[@]}" -le 45 ]
    assert_line 'The manual: man queue-sched'
    for option in $(grep -oE -- '--[a-z-]+' <<< "$output" | sort -u); do
        grep -qF -- "$option" "$SEAUTILS_BUILD/man/queue-sched.1.scd" || fail "the manual lacks $option"
    done
}

@test "queue-sched: a replayed day gives the same bytes, however it comes" {
    awk -v zero=$zero 'BEGIN {
        srand(1)
        for (k = 0; k < 3000; ++k) {
            time = "\"time\":\"@" zero + k "\""
            r = rand()
            if (r < 0.6) printf "{%s,\"message\":{\"id\":%d,\"dest\":%d,\"data\":\"%s\"}}\n", time, 1 + int(rand() * 9), rand() < 0.3 ? 0 : 5, substr("AAAAAAAAAAAAAAAAAAAAAAAA", 1, 4 + 4 * int(rand() * 5))
            else if (r < 0.8) printf "{%s,\"slot\":{\"src\":3,\"end\":\"@%d\",\"frames\":3,\"frame_bytes\":64}}\n", time, zero + k + 10
            else if (r < 0.9) printf "{%s,\"ack\":{\"src\":5,\"dest\":3,\"transmission\":%d,\"frame\":[0,1]}}\n", time, zero + int(k / 5)
            else printf "{%s,\"result\":{\"transmission\":%d,\"outcome\":\"%s\"}}\n", time, zero + int(k / 5), rand() < 0.7 ? "SENT" : "FAILED"
        }
    }' > raw
    # times as text
    perl -MPOSIX -pe 's/("(?:time|end)":)"?@?(\d+)"?/$1 . strftime("\"%Y-%m-%dT%H:%M:%SZ\"", gmtime($2))/ge' raw > day
    run_quiet sched --explain --stats day
    printf '%s\n' "$output" > first
    assert [ "$(grep -c transmission first)" -gt 100 ]
    sched --explain --stats < day > again
    cmp first again
    perl -e '$| = 1; while (read STDIN, $x, 777) { print $x; select undef, undef, undef, 0.002 }' < day | sched --explain --stats > slowly
    cmp first slowly
    sched --explain --stats --spool q.db day > spooled
    cmp first spooled
}

@test "queue-sched: where a master begins, the data wait until the modem asks for them" {
    { message 0 1 2 a && slot 1 1 64 '"initiate":false'; } > in
    run_quiet short in
    assert_output ''
    slot 3 1 64 '"polled":true' >> in
    run_quiet short in
    assert_output '0>2! a'
}

@test "queue-sched: an output that nobody reads stops neither it nor those who hand messages over" {
    mkfifo slots out
    # Opened for reading, and never read.
    exec {unread}<> out
    exec {turns}<> slots
    queue-sched --id 3 --listen q.sock --spool q.db slots > out 2> log 3>&- &
    pid=$!
    for ((k = 0; k < 100; k++)); do [[ -S q.sock ]] && break; sleep 0.05; done
    # Slots of others, far more than a pipe holds; then our own.
    for ((k = 0; k < 1500; k++)); do echo '{"slot":{"src":4,"kind":"DATA","end":"2030-01-01T00:00:00Z","frames":1,"frame_bytes":32}}'; done >&"$turns"
    run -0 timeout 20 bash -c "echo '{\"message\":{\"id\":1,\"dest\":2,\"data\":\"YQ==\"}}' | socat -t 10 - UNIX-CONNECT:q.sock,type=5"
    assert_output ok
    assert_equal "$(cat log)" 'queue-sched: standard output is full: what reads it does not keep up'
    kill "$pid"
    for ((k = 0; k < 200; k++)); do kill -0 "$pid" 2> /dev/null || break; sleep 0.05; done
    run ! kill -0 "$pid"
    exec {unread}>&- {turns}>&-
}
