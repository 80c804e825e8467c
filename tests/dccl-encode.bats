#!/usr/bin/env bats
# dccl-encode: messages in, frames out. What it shares with other tools is in house.bats.

# The frame of nav.proto by hand: id 10 is sent as 20; 1714564825 is 43225 s of its day, 0xa8d9, in
# 17 bits of header; 31.4 m are 314 = 0x013a steps of 0.1 m, in 16 bits; leg 12 is code 13 of 6 bits.
message='{"time_s":1714564825,"depth_m":31.4,"leg":12}'
frame=14d9a8003a010d

setup() {
    load test_helper
    schemas=$BATS_TEST_DIRNAME/data/schemas
    cd "$BATS_TEST_TMPDIR" || return
    cp -r "$schemas"/. .
    printf %s 'correct horse' > passphrase
}

# assert_refused WHAT ARGUMENT...: the record on standard input is refused with this message.
assert_refused() {
    local what=$1
    shift
    run -1 --separate-stderr dccl-encode "$@"
    assert_output ''
    assert_equal "$stderr" "dccl-encode: <stdin>:1: $what"
}

@test "dccl-encode: a message by hand, in each form of output" {
    run_quiet dccl-encode -s nav.proto <<< "$message"
    assert_output "$frame"
    run_quiet dccl-encode -s nav.proto -f hex <<< "$message"$'\n'"$message"
    assert_output "$frame"$'\n'"$frame"
    run_quiet dccl-encode -s nav.proto -f base64 <<< "$message"
    assert_output "$(bytes $frame | base64)"
    dccl-encode -s nav.proto -f raw <<< "$message"$'\n'"$message" > raw
    assert_equal "$(digits < raw)" $frame$frame
    dccl-encode -s nav.proto -f delimited <<< "$message"$'\n'"$message" > delimited
    assert_equal "$(digits < delimited)" 07${frame}07$frame
}

@test "dccl-encode: a message in each form of input" {
    run_quiet dccl-encode -s nav.proto -F text <<< 'time_s: 1714564825 depth_m: 31.4 leg: 12'
    assert_output $frame
    run_quiet dccl-encode -s nav.proto -F text <<< 'leg:12,depth_m:31.4;time_s:1.714564825e9 # from the log'
    assert_output $frame
    # 1: double 1714564825, 2: double 31.4, 3: varint 12
    bytes 14 09 000040b68b8cd941 11 6666666666663f40 180c > delimited
    run_quiet dccl-encode -s nav.proto -F delimited delimited
    assert_output $frame
}

@test "dccl-encode: protobuf's own compiler makes the same binary message" {
    command -v protoc > /dev/null || skip "protoc is not installed"
    protoc -I "$SEAUTILS_ROOT/schemas" -I . --encode=Nav nav.proto \
        <<< 'time_s: 1714564825 depth_m: 31.4 leg: 12' > binary
    { bytes 14 && cat binary; } > delimited
    run_quiet dccl-encode -s nav.proto -F delimited delimited
    assert_output $frame
}

@test "dccl-encode: numbers are rounded to the step, and then compared with their bounds" {
    while read -r depth_m code; do
        run_quiet dccl-encode -s nav.proto <<< "{\"time_s\":1714564825,\"depth_m\":$depth_m}"
        assert_output "14d9a800${code}00"
    done << 'END'
0 0000
-0.04 0000
0.05 0100
31.44 3a01
31.46 3b01
6000 60ea
6000.04 60ea
6e3 60ea
"12.5" 7d00
END
    assert_refused 'depth_m 6000.06 is outside 0 to 6000 m (message Nav)' -s nav.proto \
        <<< '{"time_s":1714564825,"depth_m":6000.06}'
    assert_refused 'depth_m -0.06 is outside 0 to 6000 m (message Nav)' -s nav.proto \
        <<< '{"time_s":1714564825,"depth_m":-0.06}'
}

@test "dccl-encode: several types in one stream are told apart by @type" {
    while read -r name; do
        run_quiet dccl-encode -s fleet -s nav.proto << END
{"@type":"$name","seq":200}
{"depth_m":31.4,"@type":"Nav","leg":12,"time_s":1714564825}
END
        # id 11 is sent as 22; the sequence in 8 bits
        assert_output 16c8$'\n'$frame
    done << 'END'
fleet.Ping
Ping
type.googleapis.com/fleet.Ping
type.googleapis.com/Ping
END
    while IFS='|' read -r record said; do
        assert_refused "$said" -s fleet -s nav.proto <<< "$record"
    done << 'END'
{"seq":200}|the record does not say its type ("@type", |TYPE|, or option -m)
{"@type":"Pong","seq":200}|type 'Pong' is not loaded
{"@type":"fleet.Pinf","seq":200}|type 'fleet.Pinf' is not loaded (did you mean 'fleet.Ping'?)
{"@type":7,"seq":200}|@type is not a string
{"text":"\"@type\""}|the record does not say its type ("@type", |TYPE|, or option -m)
END
}

@test "dccl-encode: several types in one stream are told apart by |TYPE|" {
    run_quiet dccl-encode -s fleet -s nav.proto -F text << 'END'
|fleet.Ping| seq: 200
|Ping|seq:200
|Nav| time_s: 1714564825 depth_m: 31.4 leg: 12
END
    assert_output $'16c8\n16c8\n'$frame
    while read -r record said; do
        assert_refused "${said//_/ }" -s fleet -s nav.proto -F text <<< "${record//_/ }"
    done << 'END'
seq:200 the_record_does_not_say_its_type_("@type",_|TYPE|,_or_option_-m)
|Pong|seq:200 type_'Pong'_is_not_loaded
|Ping_seq:200 the_type_has_no_closing_'|'
END
}

@test "dccl-encode: -m chooses the types, and the first is that of records that do not say theirs" {
    run_quiet dccl-encode -s fleet -m fleet.Ping <<< '{"seq":200}'
    assert_output 16c8
    run_quiet dccl-encode -s fleet -s nav.proto -m Ping -m Nav <<< $'{"seq":200}\n{"@type":"Nav",'"${message:1}"
    assert_output $'16c8\n'$frame
    bytes 0308c801 > delimited
    run_quiet dccl-encode -s fleet -m Ping -m Note -F delimited delimited
    assert_output 16c8
    run -64 --separate-stderr dccl-encode -s fleet -F delimited delimited
    assert_equal "$stderr" 'dccl-encode: delimited records do not say their type: choose it with -m'
    assert_refused "type 'Note' is not loaded" -s fleet -m Ping <<< '{"@type":"Note"}'
    mkdir more
    sed 's/fleet/port/; s/id: 11/id: 13/' fleet/ping.proto > more/ping.proto
    run -78 --separate-stderr dccl-encode -s fleet -s more/ping.proto -m Ping
    assert_equal "$stderr" "dccl-encode: message 'Ping' is ambiguous: fleet.Ping or port.Ping"
    assert_refused "type 'Ping' is ambiguous" -s fleet -s more/ping.proto <<< '{"@type":"Ping","seq":1}'
}

@test "dccl-encode: a FILE may follow an option that may repeat" {
    echo "$message" > in
    echo 'format = hex' > some.conf
    for option in '-s nav.proto' '--schema nav.proto' '-s nav.proto -m Nav' '-s nav.proto --message Nav' \
        '-s nav.proto -c some.conf' '-s nav.proto --config some.conf' '-s nav.proto --skip-crypto-id 10' \
        '-s nav.proto --arithmetic-model steps.textpb'; do
        # shellcheck disable=SC2086  # words of a command line
        run_quiet dccl-encode $option in < /dev/null
        assert_output $frame
    done
    run_quiet dccl-encode in -s nav.proto in - <<< "$message"
    assert_output "$frame"$'\n'"$frame"$'\n'"$frame"
    cp in -- -in
    run_quiet dccl-encode -s nav.proto -- -in < /dev/null
    assert_output $frame
}

@test "dccl-encode: a folder of schemas, and schemas that say the same id" {
    mkdir both both/deep
    cp nav.proto both
    sed 's/Nav/Neva/' nav.proto > both/deep/neva.proto
    run -78 --separate-stderr dccl-encode -s both <<< "$message"
    assert_output ''
    assert_equal "$stderr" 'dccl-encode: both/nav.proto:5: id 10 is both message Neva and message Nav'
    run_quiet dccl-encode -s both -m Nav <<< "$message"
    assert_output $frame
    sed -i 's/id: 10/id: 9/' both/deep/neva.proto
    run_quiet dccl-encode -s both <<< "{\"@type\":\"Neva\",${message:1}"
    assert_output "12${frame:2}"
}

@test "dccl-encode: a bad JSON record is refused for what is wrong with it" {
    while IFS='|' read -r record said; do
        assert_refused "$said" -s nav.proto <<< "$record"
    done << 'END'
{}|time_s is required and not given (message Nav)
{"time_s":1,"depth_m":null}|depth_m is required and not given (message Nav)
{"time_s":1,"depth_m":99999}|depth_m 99999 is outside 0 to 6000 m (message Nav)
{"time_s":1,"depth_m":"deep"}|depth_m 'deep' is not a number
{"time_s":1,"depth_m":true}|depth_m 'true' is not a number
{"time_s":1,"depth_m":"NaN"}|depth_m is NaN, which has no code (message Nav)
{"time_s":1,"depth_m":1e999}|depth_m '1e999' is beyond the range of its type
{"time_s":1,"depth_m":5,"leg":63}|leg 63 is outside 0 to 62 (message Nav)
{"time_s":1,"depth_m":5,"leg":-1}|leg '-1' is outside 0 to 4294967295
{"time_s":1,"depth_m":5,"leg":1.5}|leg '1.5' is not a whole number
{"time_s":1,"depth_m":5,"leg":4294967296}|leg '4294967296' is outside 0 to 4294967295
{"time_s":1,"depth_m":5,"lag":1}|field 'lag' is not in message Nav (did you mean 'leg'?)
{"time_s":1,"time_s":1,"depth_m":5}|time_s is given twice
{"time_s":1,"timeS":1,"depth_m":5}|time_s is given twice
{"time_s":1,"depth_m":5|not valid JSON: the last bracket is missing, or something follows it
{"time_s":1,"depth_m":5}x|not valid JSON: the last bracket is missing, or something follows it
{"time_s":1,"depth_m":5}{}|something follows the JSON object
{"time_s":1,"depth_m|not valid JSON: a string does not end
{"time_s":1.,"depth_m":5}|time_s '1.' is not a number
[]|the record is not a JSON object
null|the record is not a JSON object
END
    while IFS='|' read -r record said; do
        assert_refused "$said" -s fleet -m Note <<< "$record"
    done << 'END'
{"text":"123456789"}|text '123456789' has 9 bytes, more than max_length 8 (message fleet.Note)
{"text":5}|text '5' is not a string
{"text":"\ud800"}|not valid JSON at text: a string holds an escape that is none
{"blob":"A"}|blob 'A' is not base64
{"blob":"AAECAwQ="}|blob '\x00\x01\x02\x03\x04' has 5 bytes, more than max_length 4 (message fleet.Note)
{"mood":"CALMER"}|mood 'CALMER' is not in enum fleet.Note.Mood (did you mean 'CALM'?)
{"mood":2}|mood 2 is not in enum fleet.Note.Mood
{"step":[1,2,3,4]}|step has 4 elements, more than max_repeat 3 (message fleet.Note)
{"step":[1,6]}|step[1] 6 is outside -5 to 5 (message fleet.Note)
{"step":[null]}|step[0] is null
{"step":1}|step is not an array
{"fix":{"x_m":-100.006}}|fix.x_m -100.006 is outside -100 to 100 m (message fleet.Note)
{"fix":{"good":true}}|fix.x_m is required and not given (message fleet.Note)
{"fix":{"x_m":1,"good":2}}|fix.good '2' is neither true nor false
{"fix":{"y_m":1}}|field 'y_m' is not in message fleet.Note.Fix (at fix) (did you mean 'x_m'?)
{"fix":[]}|fix is not an object
{"count":"5000000001"}|count 5000000001 is outside 0 to 5000000000 (message fleet.Note)
END
    assert_refused 'not valid JSON: it is not UTF-8' -s fleet -m Note <<< $'{"text":"\xff"}'
    assert_refused 'the record begins with a byte order mark' -s nav.proto <<< $'\xef\xbb\xbf'"$message"
}

@test "dccl-encode: a bad text record is located by its column" {
    while IFS='|' read -r record column; do
        run -1 --separate-stderr dccl-encode -s nav.proto -F text <<< "$record"
        assert_output ''
        assert_equal "${#stderr_lines[@]}" 1
        assert_regex "$stderr" "^dccl-encode: <stdin>:1: column $column: [a-z]"
    done << 'END'
time_s: 1 depth_m: deep|20
time_s: 1 depth: 5|16
time_s 1|8
}|1
END
    assert_refused 'leg 99 is outside 0 to 62 (message Nav)' -s nav.proto -F text \
        <<< 'time_s: 1 depth_m: 5 leg: 99'
}

@test "dccl-encode: delimited records: one that is bad is dropped, one that is cut ends the run" {
    nav=1409000040b68b8cd941116666666666663f40180c
    bytes $nav 00 $nav > in
    run -1 --separate-stderr dccl-encode -s nav.proto -F delimited in
    assert_output "$frame"$'\n'"$frame"
    assert_equal "$stderr" 'dccl-encode: in:record 2 (byte 21): time_s is required and not given (message Nav)'
    run -65 --separate-stderr dccl-encode -s nav.proto -F delimited --strict in
    assert_output $frame
    while IFS='|' read -r tail said; do
        bytes $nav "$tail" > in
        for strict in '' --strict; do
            # shellcheck disable=SC2086  # no word, or one
            run -65 --separate-stderr dccl-encode -s nav.proto -F delimited $strict in
            assert_output $frame
            assert_equal "$stderr" "dccl-encode: in:record 2 (byte 21): $said"
        done
    done << 'END'
140900|the stream ends after 2 of the record's 20 bytes
94|the stream ends within the length of a record
ffffffffffff00|no length of a record stands here
80808001|record of 2097152 bytes is longer than 1048576 bytes (--max-record)
END
}

@test "dccl-encode: what the reference loses silently is refused, and lost with --lenient" {
    while IFS='|' read -r schema record said lost; do
        assert_refused "$said" -s "$schema" <<< "$record"
        run_quiet bash -c "dccl-encode -s $schema --lenient <<< '$record' | dccl-decode -s $schema --time @0"
        assert_output "$lost"
    done << 'END'
nav.proto|{"time_s":0,"depth_m":99999}|depth_m 99999 is outside 0 to 6000 m (message Nav)|{"time_s":0,"depth_m":0}
nav.proto|{"time_s":0,"depth_m":7,"leg":63}|leg 63 is outside 0 to 62 (message Nav)|{"time_s":0,"depth_m":7}
nav.proto|{"time_s":-1,"depth_m":7}|time_s -1 is no time after 1970 (message Nav)|{"time_s":0,"depth_m":7}
loss.proto|{"number":260,"least":[8,9]}|number 260 is outside 5 to 259 (message loss.Loss)|{"least":[8,9],"fixed":"auv"}
loss.proto|{"text":"abcde","least":[8,9]}|text 'abcde' has 5 bytes, more than max_length 4 (message loss.Loss)|{"text":"abcd","least":[8,9],"fixed":"auv"}
loss.proto|{"most":[1,2,3],"least":[8,9]}|most has 3 elements, more than max_repeat 2 (message loss.Loss)|{"most":[1,2],"least":[8,9],"fixed":"auv"}
loss.proto|{"most":[1,256],"least":[8,9]}|most[1] 256 is outside 0 to 255 (message loss.Loss)|{"most":[1,0],"least":[8,9],"fixed":"auv"}
loss.proto|{"least":[8]}|least has 1 element, fewer than min_repeat 2 (message loss.Loss)|{"least":[8,7],"fixed":"auv"}
loss.proto|{"fixed":"uuv","least":[8,9]}|fixed 'uuv' is not its static value 'auv', which the receiver will see (message loss.Loss)|{"least":[8,9],"fixed":"auv"}
loss.proto|{"leg":{"seq":3,"hidden":4},"least":[8,9]}|leg.hidden is marked in_head inside of a message that is not in the header: it is never sent (--lenient drops it) (message loss.Loss)|{"least":[8,9],"fixed":"auv","leg":{"seq":3}}
loss.proto|{"depth":4,"least":[8,9]}|depth is set although its condition omits it (--lenient drops it) (message loss.Loss)|{"least":[8,9],"fixed":"auv"}
open.proto|{"state":7}|state 7 is no number of open.State (message open.Report)|{}
open.proto|{"mode":7}|mode 7 is no number of open.State (message open.Report)|{"mode":"IDLE"}
END
    # By hand: zeros where the required depth cannot be said, and the code 0 of a leg that is not set.
    run_quiet dccl-encode -s nav.proto --lenient << 'END'
{"time_s":1714564825,"depth_m":99999,"leg":12}
{"time_s":1714564825,"depth_m":31.4,"leg":63}
{"time_s":-1,"depth_m":31.4,"leg":12}
END
    assert_output $'14d9a80000000d\n14d9a8003a0100\n140000003a010d'
}

@test "dccl-encode: what is refused in any case" {
    while IFS='|' read -r record said; do
        assert_refused "$said" -s nav.proto --lenient <<< "$record"
    done << 'END'
{"time_s":1}|depth_m is required and not given (message Nav)
{"time_s":1,"depth_m":"NaN"}|depth_m is NaN, which has no code (message Nav)
{"time_s":1,"depth_m":"deep"}|depth_m 'deep' is not a number
{"time_s":1,"depth_m":1,"lag":1}|field 'lag' is not in message Nav (did you mean 'leg'?)
END
}

@test "dccl-encode: a record that is refused leaves nothing in the output" {
    for format in hex base64 delimited raw; do
        dccl-encode -s nav.proto -f $format <<< "$message"$'\n'"$message" > want
        run -1 bash -c "dccl-encode -s nav.proto -f $format > got 2> said" << END
$message
{"time_s":1714564825,"depth_m":31.4,"leg":63}
$message
END
        run_quiet cmp want got
    done
}

@test "dccl-encode: bodies are encrypted as the format says" {
    command -v openssl > /dev/null || skip "openssl is not installed"
    # AES-256-CTR; key: SHA-256 of the passphrase; first counter: SHA-256 of the header's bytes.
    key=$(sha256sum < passphrase | cut -c 1-64)
    counter=$(bytes 14d9a800 | sha256sum | cut -c 1-32)
    body=$(bytes 3a010d | openssl enc -aes-256-ctr -K "$key" -iv "$counter" | digits)
    for option in '--passphrase-file passphrase' '--passphrase-fd 5'; do
        # shellcheck disable=SC2086  # words of a command line
        run_quiet dccl-encode -s nav.proto $option <<< "$message" 5< passphrase
        assert_output "14d9a800$body"
    done
    SEAUTILS_PASSPHRASE_FILE=passphrase run_quiet dccl-encode -s nav.proto <<< "$message"
    assert_output "14d9a800$body"
    # the options win over the environment; the line end of an editor does not count
    printf 'correct horse\n' > with-lf
    printf 'correct horse\r\n' > with-crlf
    for file in with-lf with-crlf; do
        SEAUTILS_PASSPHRASE_FILE=gone run_quiet dccl-encode -s nav.proto --passphrase-file $file <<< "$message"
        assert_output "14d9a800$body"
    done
    SEAUTILS_PASSPHRASE_FILE='' run_quiet dccl-encode -s nav.proto <<< "$message"
    assert_output $frame
}

@test "dccl-encode: identifiers that are skipped stay in clear" {
    for ids in '--skip-crypto-id 10' '--skip-crypto-id 9 --skip-crypto-id 10'; do
        # shellcheck disable=SC2086  # words of a command line
        run_quiet dccl-encode -s nav.proto --passphrase-file passphrase $ids <<< "$message"
        assert_output $frame
    done
    run_quiet dccl-encode -s nav.proto --passphrase-file passphrase --skip-crypto-id 9 <<< "$message"
    refute_output $frame
}

@test "dccl-encode: a passphrase that cannot be read, or is none, is not done without" {
    : > empty
    echo > line
    head -c 65537 /dev/zero | tr '\0' x > long
    while IFS='|' read -r status options said; do
        run "-$status" --separate-stderr bash -c "dccl-encode -s nav.proto $options" <<< "$message"
        assert_output ''
        assert_equal "$stderr" "dccl-encode: $said"
    done << 'END'
66|--passphrase-file gone|gone: No such file or directory
66|--passphrase-file .|.: Is a directory
66|--passphrase-fd 9|passphrase descriptor 9: Bad file descriptor
78|--passphrase-file empty|the passphrase is empty
78|--passphrase-file line|the passphrase is empty
78|--passphrase-file long|the passphrase is longer than 65536 bytes
78|--passphrase-file /dev/zero|/dev/zero: longer than 1 MiB
78|--passphrase-fd 5 5< /dev/zero|passphrase descriptor 5: longer than 1 MiB
64|--passphrase-file ''|option --passphrase-file: the value is empty
64|--passphrase-file= passphrase|option --passphrase-file: the value is empty
64|--passphrase-file passphrase --passphrase-fd 5|options --passphrase-file and --passphrase-fd exclude each other
64|--passphrase-fd -5|option --passphrase-fd: '-5' is below 0
64|--passphrase-fd 0 < passphrase|the passphrase and the records cannot both be standard input
64|--passphrase-fd 0 good - < passphrase|the passphrase and the records cannot both be standard input
64|--passphrase-fd one|option --passphrase-fd: 'one' is no whole number, or one too large
64|--skip-crypto-id ten|option --skip-crypto-id: 'ten' is no whole number, or one too large
END
    SEAUTILS_PASSPHRASE_FILE=gone run -66 --separate-stderr dccl-encode -s nav.proto <<< "$message"
    assert_equal "$stderr" 'dccl-encode: gone: No such file or directory'
    run -64 dccl-encode -s nav.proto --passphrase 'correct horse' <<< "$message"
    echo 'passphrase-fd = -5' > some.conf
    run -78 --separate-stderr dccl-encode -s nav.proto -c some.conf <<< "$message"
    assert_equal "$stderr" "dccl-encode: some.conf:1: option --passphrase-fd: '-5' is below 0"
    echo "$message" > in
    run_quiet dccl-encode -s nav.proto --passphrase-fd 0 in < passphrase
    refute_output $frame
    # the option wins over a file that says it in another way
    echo 'passphrase-file = gone' > some.conf
    run_quiet dccl-encode -s nav.proto -c some.conf --passphrase-fd 5 <<< "$message" 5< passphrase
    refute_output $frame
    # and is never shown
    run -1 --separate-stderr dccl-encode -v -s nav.proto --passphrase-file passphrase <<< '{}'
    refute_regex "$stderr$output" 'correct horse'
}

@test "dccl-encode: --header-only writes the header, and needs no body" {
    run_quiet dccl-encode -s nav.proto --header-only << END
$message
{"time_s":1714564825}
END
    assert_output $'14d9a800\n14d9a800'
    run_quiet dccl-encode -s nav.proto --header-only --passphrase-file passphrase <<< "$message"
    assert_output 14d9a800
    assert_refused 'time_s is required and not given (message Nav)' -s nav.proto --header-only <<< '{"depth_m":5}'
}

@test "dccl-encode: identifiers of the CCL, and none" {
    run_quiet dccl-encode -s nav.proto --id-codec ccl <<< "$message"
    assert_output 20$frame
    run_quiet dccl-encode -s nav.proto --id-codec default <<< "$message"
    assert_output $frame
    run_quiet dccl-encode -s bare.proto <<< '{"seq":200}'
    assert_output c8
}

@test "dccl-encode: models of the arithmetic codec" {
    run -78 --separate-stderr dccl-encode -s series.proto -m Series
    assert_equal "$stderr" "dccl-encode: series.proto:8: message Series: field step: arithmetic model 'steps' is not loaded"
    # What is most likely takes least: eight times the likely step in less than a bit each.
    run_quiet dccl-encode -s series.proto --arithmetic-model steps.textpb <<< '{"step":[0,0,0,0,0,0,0,0]}'
    assert [ ${#output} -le 4 ]
    run_quiet dccl-encode -s series.proto --arithmetic-model steps.textpb <<< '{"step":[1,-1,1,-1,1,-1,1,-1]}'
    assert [ ${#output} -ge 12 ]
    run -78 --separate-stderr dccl-encode -s series.proto --arithmetic-model nav.proto
    assert_regex "$stderr" '^dccl-encode: nav.proto: arithmetic model: '
    run -78 --separate-stderr dccl-encode -s series.proto --arithmetic-model steps.textpb --arithmetic-model steps.textpb
    assert_equal "$stderr" "dccl-encode: steps.textpb: arithmetic model 'steps' is given twice"
    run -78 --separate-stderr dccl-encode -s series.proto --arithmetic-model /dev/zero
    assert_equal "$stderr" 'dccl-encode: /dev/zero: longer than 1 MiB'
    run -66 --separate-stderr dccl-encode -s series.proto --arithmetic-model gone.textpb
    assert_equal "$stderr" 'dccl-encode: gone.textpb: No such file or directory'
}

@test "dccl-encode: messages of DCCL 1, and what they cannot do" {
    dive=$SEAUTILS_ROOT/examples/legacy/dive.xml
    # Depth 5.0 m alone, by hand: header 20 2d with nothing but the id 90; the body has 11 + 12 + 3
    # * 7 + 3 + 7 + 2 = 56 bits, the depth's code 51 = 0x33 first of them; zeros behind are cut.
    run_quiet dccl-encode -s "$dive" --time @0 <<< '{"depth":5.0}'
    assert_output 202d000000000660
    # the clock: 12:00:00 is second 43200 = 0xa8c0 of 17 bits behind the 9 of the id
    run_quiet dccl-encode -s "$dive" --time 2011-07-25T12:00:00Z <<< '{}'
    assert_output 202d2a300000
    run_quiet dccl-encode -s "$dive" --time @0 <<< '{"_time":43200,"_src_id":31,"_dest_id":1}'
    assert_output 202d2a303e10
    assert_refused 'depth 200.1 is outside 0 to 200 (message DIVE)' -s "$dive" <<< '{"depth":200.1}'
    while IFS='|' read -r options said; do
        # shellcheck disable=SC2086  # words of a command line
        run -64 --separate-stderr dccl-encode -s "$dive" $options <<< '{"depth":5}'
        assert_output ''
        assert_equal "$stderr" "dccl-encode: $said"
    done << 'END'
-f raw|frames of DCCL 1 do not say where they end: raw cannot hold them
-F text|messages of DCCL 1 are read from ndjson only
-F delimited|messages of DCCL 1 are read from ndjson only
--header-only|option --header-only is not for messages of DCCL 1
--id-codec ccl|option --id-codec is not for messages of DCCL 1
--arithmetic-model steps.textpb|option --arithmetic-model is not for messages of DCCL 1
END
    run -78 --separate-stderr dccl-encode -s "$dive" -s nav.proto
    assert_equal "$stderr" 'dccl-encode: schemas of DCCL 1 (.xml) and of protobuf cannot be mixed'
}

@test "dccl-encode: a faulty XML is located" {
    while IFS='|' read -r edit line; do
        sed "$edit" "$SEAUTILS_ROOT/examples/legacy/dive.xml" > bad.xml
        run -78 --separate-stderr dccl-encode -s bad.xml
        assert_equal "${#stderr_lines[@]}" 1
        assert_regex "$stderr" "^dccl-encode: bad.xml:$line: [a-z<]"
    done << 'END'
s/<id>90/<id>512/|6
s/<id>90/<id>dive/|6
s/<max>200<.max>//|9
s/<.layout>//|[0-9]+
s/<size>32/<size>8/|[0-9]+
END
    run -66 --separate-stderr dccl-encode -s gone.xml
    assert_equal "$stderr" 'dccl-encode: gone.xml: No such file or directory'
}

@test "dccl-encode: the reference library's frames of 5000 status messages" {
    bulk=$SEAUTILS_SHARED/vectors/dccl/bulk
    [[ -d $bulk ]] || skip "no vectors in $SEAUTILS_SHARED/vectors"
    for form in jsonl:ndjson textpb:text; do
        run_quiet bash -c "dccl-encode -s $bulk/../schemas/p17_auv.proto -m VehicleStatus -F ${form#*:} \
            --lenient $bulk/vehicle_status.${form%:*} | cmp - $bulk/vehicle_status.hex"
    done
}

@test "dccl-encode: the reference library's frames with other options" {
    vectors=$SEAUTILS_SHARED/vectors/dccl
    [[ -d $vectors ]] || skip "no vectors in $SEAUTILS_SHARED/vectors"
    cat > delta.textpb << 'END'
name: "delta" frequency: [1,5,20,60,20,5,1] eof_frequency: 4 out_of_range_frequency: 2
value_bound: [-3,-2,-1,0,1,2,3,4]
END
    # pub-ids-017, pub-header-014, pub-arith-001, pub-ccl-002
    printf 'nonce is empty' > pass
    run_quiet dccl-encode -s "$vectors/schemas/p01_ids.proto" -m NoId --passphrase-file pass <<< '{"v":700}'
    assert_output d452
    run_quiet dccl-encode -s "$vectors/schemas/p02_header.proto" -m HeadV4 --header-only \
        <<< '{"kind": "ACK", "stamp": "123456", "note": "body is left out", "hops": [3, 4, 5]}'
    assert_output 5902018907000c15
    run_quiet dccl-encode -s "$vectors/schemas/p15_arith.proto" -m Series --arithmetic-model delta.textpb \
        <<< '{"v": [0, 0, 0, 1, 0, -1, 0, 0], "end": 200}'
    assert_output 2d01e9800c
    run_quiet dccl-encode -s "$vectors/schemas/p16_ccl.proto" -m WrappedLong --id-codec ccl <<< '{"v":5}'
    assert_output 20d1070500
}
