#!/usr/bin/env bats
# Records at both ends of the link: dccl-encode --records and --send, dccl-decode --records.

# nav.proto's frames: 14 is id 10; then the time of day, the depth in steps of 0.1 m, and the leg.
message='{"time_s":1714564825,"depth_m":31.4,"leg":12}'
frame=14d9a8003a010d

setup() {
    load test_helper
    cd "$BATS_TEST_TMPDIR" || return
    cp -r "$BATS_TEST_DIRNAME"/data/schemas/. .
    cat > order.proto <<< 'syntax = "proto2"; import "dccl/option_extensions.proto";
        message Order {
          option (dccl.msg) = { id: 11 max_bytes: 32 codec_version: 4 };
          message Header {
            optional uint32 from = 1 [(dccl.field) = { min: 0 max: 40 }];
            optional uint32 to = 2 [(dccl.field) = { min: 0 max: 40 }];
            optional int64 when_us = 3 [(dccl.field) = { min: 0 max: 4e12 }];
          }
          optional Header header = 1;
          optional string note = 2 [(dccl.field).max_length = 8];
        }'
}

base64_of() { bytes "$1" | base64 -w0; }

# reception FRAME...: a record with these frames, in base64.
reception() {
    printf '{"time":"2024-05-01T12:00:30Z","reception":{"src":3,"dest":1,"rate":1,"kind":"DATA","frame":['
    local IFS=,
    printf %s "$(printf '"%s",' "$@" | sed 's/,$//')"
    printf ']}}\n'
}

@test "dccl-encode: --records writes a record for queue-sched" {
    run_quiet dccl-encode -s nav.proto --records --src 3 --dest 0 --no-ack --time-field time_s \
        --time 2024-05-01T12:00:26Z <<< "$message"
    assert_output '{"time":"2024-05-01T12:00:26Z","message":{"id":10,"src":3,"dest":0,"ack_requested":false,"created":"2024-05-01T12:00:25Z","data":"'"$(base64_of $frame)"'","type":"Nav"}}'
    run_quiet dccl-encode -s nav.proto --records --time @0 <<< "$message"
    assert_output '{"time":"1970-01-01T00:00:00Z","message":{"id":10,"src":0,"dest":0,"data":"'"$(base64_of $frame)"'","type":"Nav"}}'
    dccl-encode -s nav.proto --records -f delimited --time @0 <<< "$message" > binary
    # 0a 00: no time has passed; 12 14: message { id 10, src 0, dest 0, 7 bytes of data, type "Nav" }
    assert_equal "$(digits < binary)" 180a001214080a100018003207${frame}3a034e6176
}

@test "dccl-encode: sender, receiver and time of a record come from the message" {
    order() { dccl-encode -s order.proto --records --time @0 --src-field header.from --dest-field header.to --time-field header.when_us; }
    run_quiet order <<< '{"header":{"from":3,"to":7,"when_us":"1500000"}}'
    run jq -c '.message | {src, dest, created}' <<< "$output"
    assert_output '{"src":3,"dest":7,"created":"1970-01-01T00:00:01.500Z"}'
    run -1 --separate-stderr order <<< '{"header":{"from":3,"to":31,"when_us":"0"}}
{"header":{"from":0,"to":7,"when_us":"0"}}
{"header":{"from":3,"when_us":"0"}}
{"note":"x"}'
    assert_output ''
    assert_equal "$stderr" 'dccl-encode: <stdin>:1: header.to is outside 0 to 30: no modem ID
dccl-encode: <stdin>:2: header.from is outside 1 to 30: no modem ID
dccl-encode: <stdin>:3: header.to is not set, and the record needs it
dccl-encode: <stdin>:4: header.from is not set, and the record needs it'
}

@test "dccl-encode: what is wrong with the options of records" {
    while IFS='|' read -r status arguments what; do
        # shellcheck disable=SC2086  # words
        run "-$status" --separate-stderr dccl-encode -s order.proto $arguments <<< '{"header":{"from":1}}'
        assert_output ''
        assert_equal "$stderr" "dccl-encode: $what"
    done << 'CASES'
64|--src 3|options of records need --records or --send
64|-f ndjson|option --format: ndjson is for --records
64|--records -f hex|option --format: records are ndjson or delimited
64|--records --src 0|option --src: outside 1 to 30
64|--records --dest 31|option --dest: outside 0 to 30
64|--records --dest 3 --dest-field x|options --dest and --dest-field exclude each other
78|--records --src-field heder.from|field 'heder' is not in message Order (did you mean 'header'?)
78|--records --src-field header|field 'header' is a message
78|--records --src-field note.x|field 'note.x': note is no message
69|--send no.sock|no.sock: No such file or directory
CASES
}

@test "dccl-encode: --send hands each record over, and waits for the answer" {
    # Takes one packet, and answers.
    socat UNIX-LISTEN:other.sock,type=5 SYSTEM:'dd bs=4096 count=1 of=packet 2> dd.log; printf %s full' &
    for ((k = 0; k < 100; k++)); do [[ -S other.sock ]] && break; sleep 0.02; done
    run -1 --separate-stderr dccl-encode -s nav.proto --send other.sock --time @0 <<< "$message"
    assert_output ''
    assert_equal "$stderr" 'dccl-encode: <stdin>:1: the queue refuses it: full'
    run jq -c .message.id packet
    assert_output 10
    wait
}

@test "dccl-decode: --records takes the messages out of each frame" {
    f=$(base64_of $frame) two=$(base64_of $frame${frame/0d/0e}0000000000)
    { reception "$f" '' "$two" && echo '{"time":"2024-05-01T12:00:31Z","ack":{"src":1}}' && echo '{"brand_new":1}'; } > in
    run_quiet dccl-decode -s nav.proto --records in
    assert_output "$message
$message
${message/12/13}"
}

@test "dccl-decode: times of a record are near to the record's" {
    run_quiet dccl-decode -s nav.proto --records --time 1999-01-01T00:00:00Z <<< "$(reception "$(base64_of $frame)")"
    assert_output "$message"
}

@test "dccl-decode: says frame by frame what could not be decoded, and loses nothing else" {
    good=$(base64_of $frame) bad=$(base64_of 7fff) short=$(base64_of 14d9)
    run -1 --separate-stderr dccl-decode -s nav.proto --records <<< "$(reception "$bad" "$good" "$short")"
    assert_output "$message"
    [[ $stderr == 'dccl-decode: <stdin>:1: frame 0: '*'; frame 2: '* ]]
    run -1 --separate-stderr dccl-decode -s nav.proto --records <<< '{"reception":{"frame":["!"]}}'
    assert_equal "$stderr" "dccl-decode: <stdin>:1: reception.frame[0] '\"!\"' is not base64" ||
        assert_equal "$stderr" "dccl-decode: <stdin>:1: reception.frame[0] '!' is not base64"
}

@test "dccl-decode: --duplicates drops what came before from the same sender" {
    f=$(base64_of $frame)
    { reception "$f" && reception "$f" "$(base64_of ${frame/0d/0e})" && reception "$f" | sed 's/"src":3/"src":4/' &&
        reception "$f" | sed 's/12:00:30/12:02:30/'; } > in
    run_quiet dccl-decode -s nav.proto --records --duplicates 100 in
    assert_output "$message
${message/12/13}
$message
$message"
    run_quiet dccl-decode -s nav.proto --records in
    assert_equal "${#lines[@]}" 5
    run -64 --separate-stderr dccl-decode -s nav.proto --duplicates 10 in
    assert_equal "$stderr" 'dccl-decode: option --duplicates needs --records'
}

@test "dccl-decode: --received says when and from whom, and dccl-encode reads that again" {
    run_quiet dccl-decode -s nav.proto --records --received <<< "$(reception "$(base64_of $frame)")"
    assert_output '{"@received":"2024-05-01T12:00:30Z","@from":3,'"${message#?}"
    run_quiet dccl-encode -s nav.proto <<< "$output"
    assert_output $frame
    run -64 --separate-stderr dccl-decode -s nav.proto --received <<< $frame
    assert_equal "$stderr" 'dccl-decode: option --received needs --records'
}
