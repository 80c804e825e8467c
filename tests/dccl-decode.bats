#!/usr/bin/env bats
# dccl-decode: frames in, messages out. What it shares with other tools is in house.bats.

# The frame of nav.proto by hand, see dccl-encode.bats.
message='{"time_s":1714564825,"depth_m":31.4,"leg":12}'
frame=14d9a8003a010d
when=2024-05-01T12:00:00Z

setup() {
    load test_helper
    cd "$BATS_TEST_TMPDIR" || return
    cp -r "$BATS_TEST_DIRNAME/data/schemas"/. .
    printf %s 'correct horse' > passphrase
    nav=(dccl-decode -s nav.proto --time $when)
}

# assert_refused WHAT ARGUMENT...: the record on standard input is refused with this message.
assert_refused() {
    local what=$1
    shift
    run -1 --separate-stderr dccl-decode --time $when "$@"
    assert_output ''
    assert_equal "$stderr" "dccl-decode: <stdin>:1: $what"
}

@test "dccl-decode: a frame by hand, in each form of input" {
    for line in $frame 14D9A8003A010D " $frame" "$frame"$'\t'; do
        run_quiet "${nav[@]}" <<< "$line"
        assert_output "$message"
    done
    line=$(bytes $frame | base64)
    for line in "$line" "${line%%=*}"; do
        run_quiet "${nav[@]}" -F base64 <<< "$line"
        assert_output "$message"
    done
    run_quiet "${nav[@]}" -F delimited < <(bytes 07$frame 07$frame)
    assert_output "$message"$'\n'"$message"
    run_quiet "${nav[@]}" -F raw < <(bytes $frame $frame)
    assert_output "$message"$'\n'"$message"
    # the alphabet of URLs: 0xfb 0xff are "+/8=" in the standard one
    run_quiet dccl-decode -s bare.proto -F base64 <<< $'-_8\n+/8='
    assert_output $'{"seq":251}\n{"seq":255}\n{"seq":251}\n{"seq":255}'
}

@test "dccl-decode: a message in each form of output" {
    run_quiet "${nav[@]}" <<< $frame
    assert_output "$message"
    run_quiet "${nav[@]}" -f text <<< $frame
    assert_output 'time_s: 1714564825 depth_m: 31.4 leg: 12'
    run_quiet "${nav[@]}" -f csv <<< "$frame"$'\n'14d9a8003a0100
    assert_output $'time_s,depth_m,leg\n1714564825,31.4,12\n1714564825,31.4,'
    # 1: double 1714564825, 2: double 31.4, 3: varint 12
    "${nav[@]}" -f delimited <<< $frame > delimited
    assert_equal "$(digits < delimited)" 1409000040b68b8cd941116666666666663f40180c
    command -v protoc > /dev/null || skip "protoc is not installed"
    run_quiet bash -c "tail -c +2 delimited | protoc -I '$SEAUTILS_ROOT/schemas' -I . --decode=Nav nav.proto"
    assert_output $'time_s: 1714564825\ndepth_m: 31.4\nleg: 12'
}

@test "dccl-decode: in proto3 a default is not set, unless the field has presence" {
    cat > three.proto <<- 'EOF'
	syntax = "proto3";
	import "dccl/option_extensions.proto";
	message Three {
	  option (dccl.msg) = { id: 5 max_bytes: 16 codec_version: 4 };
	  double plain = 1 [(dccl.field) = { min: -2 max: 9 }];
	  bool flag = 2;
	  optional double maybe = 3 [(dccl.field) = { min: -2 max: 9 }];
	  repeated double list = 4 [(dccl.field) = { min: -2 max: 9 max_repeat: 3 }];
	}
	EOF
    # 1 bit: maybe is there; plain: code 3 of 4 bits is 0; flag: code 1 of 2 bits is false; maybe:
    # code 2 of 4 bits is 0; 2 bits: one element; code 2 of 4 bits is 0
    run_quiet dccl-decode -s three.proto <<< 0a274900
    assert_output '{"maybe":0,"list":[0]}'
    run_quiet dccl-decode -s three.proto -f text <<< 0a274900
    assert_output 'maybe: 0 list: 0'
    dccl-decode -s three.proto -f delimited <<< 0a274900 > delimited
    assert_equal "$(digits < delimited)" 1319000000000000000022080000000000000000
    # what rounds to the default was set, and travels as the value that it is
    run_quiet dccl-encode -s three.proto <<< '{"plain":0.4,"maybe":0.4,"list":[0.4]}'
    assert_output 0a074900
}

@test "dccl-decode: all forms, to and from, hold the same messages" {
    cat > ndjson << 'END'
{"text":"a, \"b\"","blob":"AAEC/w==","mood":"BRISK","fix":{"x_m":-1.25,"good":true},"step":[1,-2,0],"count":"4999999999"}
{}
{"mood":"CALM","fix":{"x_m":100},"count":"0"}
{"text":"é\n\u0001","step":[-5]}
END
    cat > text << 'END'
text: "a, \"b\"" blob: "\000\001\002\377" mood: BRISK fix { x_m: -1.25 good: true } step: 1 step: -2 step: 0 count: 4999999999
|fleet.Note|
mood: CALM fix { x_m: 100 } count: 0
text: "\303\251\n\001" step: -5
END
    codec() { "dccl-$1" -s fleet -m Note -F "$2" -f "$3" "$4" > "$5" 2> said || fail "$* $(cat said)"; }
    codec encode ndjson hex ndjson hex
    assert_equal "$(wc -l < hex)" 4
    # base64 and raw from coreutils; delimited by hand: all are shorter than 128 bytes
    while read -r line; do
        bytes "$line" | base64 -w 0
        echo
    done < hex > base64
    bytes "$(tr -d '\n' < hex)" > raw
    while read -r line; do bytes "$(printf %02x $((${#line} / 2)))" "$line"; done < hex > frames
    codec decode hex delimited hex messages
    for output in hex:hex base64:base64 delimited:frames raw:raw; do
        for input in ndjson:ndjson text:text delimited:messages; do
            codec encode "${input%:*}" "${output%:*}" "${input#*:}" got
            cmp "${output#*:}" got || fail "dccl-encode $input $output"
        done
    done
    codec decode hex csv hex csv
    for input in hex:hex base64:base64 delimited:frames raw:raw; do
        for output in ndjson:ndjson text delimited:messages csv:csv; do
            codec decode "${input%:*}" "${output%:*}" "${input#*:}" got
            [[ $output != text ]] || continue # other escapes say the same
            cmp "${output#*:}" got || fail "dccl-decode $input $output"
        done
        codec decode "${input%:*}" text "${input#*:}" got
        codec encode text hex got again
        cmp hex again || fail "dccl-decode $input text"
    done
}

@test "dccl-decode: a table has a column for each value, in the order of the schema" {
    run_quiet bash -c "dccl-encode -s fleet -m Note | dccl-decode -s fleet -m Note -f csv" << 'END'
{"text":"a, \"b\"","blob":"AAEC/w==","mood":"BRISK","fix":{"x_m":-1.25,"good":true},"step":[1,-2],"count":"4999999999"}
{"text":"a\nb"}
{}
END
    assert_output 'text,blob,mood,fix.x_m,fix.good,step[0],step[1],step[2],count
"a, ""b""",AAEC/w==,BRISK,-1.25,true,1,-2,,4999999999
"a
b",,,,,,,,
,,,,,,,,'
    run_quiet "${nav[@]}" -f csv < /dev/null
    assert_output time_s,depth_m,leg
    run -64 --separate-stderr dccl-decode -s fleet -f csv < /dev/null
    assert_output ''
    assert_equal "$stderr" 'dccl-decode: csv holds messages of one type: choose it with -m'
}

@test "dccl-decode: the type is found by the identifier, and said where there are several" {
    run_quiet dccl-decode -s fleet -s nav.proto --time $when <<< $'16c8\n'$frame
    assert_output '{"@type":"fleet.Ping","seq":200}
{"@type":"Nav",'"${message:1}"
    run_quiet dccl-decode -s fleet -s nav.proto --time $when -f text <<< $'16c8\n'$frame
    assert_output '|fleet.Ping| seq: 200
|Nav| time_s: 1714564825 depth_m: 31.4 leg: 12'
    # ndjson and text of several types are what dccl-encode reads
    for format in ndjson text; do
        run_quiet bash -c "dccl-decode -s fleet -s nav.proto --time $when -f $format |
            dccl-encode -s fleet -s nav.proto -F $format" <<< $'16c8\n'$frame
        assert_output $'16c8\n'$frame
    done
    run_quiet dccl-decode -s fleet -m Ping <<< 16c8
    assert_output '{"seq":200}'
    assert_refused 'identifier 10 is of no message that is loaded' -s fleet -m Ping <<< $frame
    run -64 --separate-stderr dccl-decode -s fleet -f delimited < /dev/null
    assert_equal "$stderr" 'dccl-decode: delimited holds messages of one type: choose it with -m'
    sed 's/Nav/Neva/' nav.proto > neva.proto
    run -78 --separate-stderr dccl-decode -s nav.proto -s neva.proto <<< $frame
    assert_equal "$stderr" 'dccl-decode: neva.proto:5: id 10 is both message Nav and message Neva'
}

@test "dccl-decode: a FILE may follow an option that may repeat" {
    echo $frame > in
    echo 'format = ndjson' > some.conf
    for option in '-s nav.proto' '--schema nav.proto' '-s nav.proto -m Nav' '-s nav.proto --message Nav' \
        '-s nav.proto -c some.conf' '-s nav.proto --config some.conf' '-s nav.proto --skip-crypto-id 10' \
        '-s nav.proto --arithmetic-model steps.textpb'; do
        # shellcheck disable=SC2086  # words of a command line
        run_quiet dccl-decode --time $when $option in < /dev/null
        assert_output "$message"
    done
}

@test "dccl-decode: a record of several messages, and what is left over behind them" {
    run_quiet dccl-decode -s fleet -s nav.proto --time $when << END
${frame}16c816c9
${frame}000000
END
    assert_output '{"@type":"Nav",'"${message:1}"'
{"@type":"fleet.Ping","seq":200}
{"@type":"fleet.Ping","seq":201}
{"@type":"Nav",'"${message:1}"
    while IFS='|' read -r tail said; do
        run -1 --separate-stderr "${nav[@]}" <<< "$frame$tail"
        assert_output "$message"
        assert_equal "$stderr" "dccl-decode: <stdin>:1: $said"
        run_quiet "${nav[@]}" --lenient <<< "$frame$tail"
        assert_output "$message"
    done << 'END'
ff|1 byte is left over: the identifier takes 2 bytes where 1 is left
16c8|2 bytes are left over: identifier 11 is of no message that is loaded
14d9|2 bytes are left over: time_s takes 17 bits where 8 are left (message Nav)
0001|2 bytes are left over: identifier 0 is of no message that is loaded
END
    run -65 --separate-stderr "${nav[@]}" --strict <<< "${frame}ff"
    # zeros are messages where one has the identifier 0
    sed 's/id: 11/id: 0/' fleet/ping.proto > zero.proto
    run_quiet dccl-decode -s zero.proto <<< 00070000
    assert_output $'{"seq":7}\n{"seq":0}'
}

@test "dccl-decode: a message that takes no bytes is read once, and does not go on for ever" {
    printf '%s\n' 'syntax = "proto2"; import "dccl/option_extensions.proto"; message Mute {' \
        'option (dccl.msg) = { omit_id: true max_bytes: 8 codec_version: 4 };' \
        'required uint32 a = 1 [(dccl.field) = { min: 3 max: 3 }]; }' > mute.proto
    run_quiet bash -c "dccl-encode -s mute.proto -f delimited | dccl-decode -s mute.proto -F delimited" <<< $'{"a":3}\n{"a":3}'
    assert_output $'{"a":3}\n{"a":3}'
    run -1 --separate-stderr timeout 10 dccl-decode -s mute.proto <<< ff
    assert_output '{"a":3}'
    assert_equal "$stderr" 'dccl-decode: <stdin>:1: 1 byte is left over: the message takes no bytes'
    for resync in '' --resync; do
        # shellcheck disable=SC2086  # no word, or one
        run --separate-stderr timeout 10 dccl-decode -s mute.proto -F raw $resync <<< x
        assert_output '{"a":3}'
        assert_equal "$status" $((${#resync} ? 1 : 65))
        assert_regex "$stderr" '^dccl-decode: <stdin>:byte 0: the message takes no bytes'
    done
    # An empty line would be no record, and raw nothing at all.
    for format in hex base64 raw; do
        run -1 --separate-stderr dccl-encode -s mute.proto -f $format <<< '{"a":3}'
        assert_output ''
        assert_equal "$stderr" 'dccl-encode: <stdin>:1: the message takes no bytes, which only delimited can hold'
    done
}

@test "dccl-decode: a bad record is refused for what is wrong with it" {
    while IFS='|' read -r record said; do
        assert_refused "$said" -s nav.proto <<< "$record"
        assert_refused "$said" -s nav.proto --lenient <<< "$record"
    done << 'END'
14d9a8003a01|leg takes 6 bits where 0 are left (message Nav)
14d9a8003a|depth_m takes 16 bits where 8 are left (message Nav)
14d9a8|time_s takes 17 bits where 16 are left (message Nav)
14|time_s takes 17 bits where 0 are left (message Nav)
16c8|identifier 11 is of no message that is loaded
15|the identifier takes 2 bytes where 1 is left
ffff00|identifier 32767 is of no message that is loaded
1500d9a8003a010d|identifier 10 stands in two bytes where one is enough
14d9a8003a010|an odd number of hexadecimal digits, 13
14d9a8003a010g|'g' in column 14 is no hexadecimal digit
14 d9|' ' in column 3 is no hexadecimal digit
x|'x' in column 1 is no hexadecimal digit
END
    while IFS='|' read -r record said; do
        assert_refused "$said" -s nav.proto -F base64 <<< "$record"
    done << 'END'
FNmoA|base64 of 5 characters is cut short
F|base64 of 1 character is cut short
FNmoADoBDQ=|base64 of 11 characters is cut short
FNmo*DoBDQ==|'*' in column 5 is no base64 digit
END
}

@test "dccl-decode: delimited records: one that is bad is dropped, one that is cut ends the run" {
    bytes 07$frame 0216c8 00 07$frame > in
    run -1 --separate-stderr "${nav[@]}" -F delimited in
    assert_output "$message"$'\n'"$message"
    assert_equal "$stderr" 'dccl-decode: in:record 2 (byte 8): identifier 11 is of no message that is loaded
dccl-decode: in:record 3 (byte 11): the identifier takes 1 byte where 0 are left'
    while IFS='|' read -r tail said; do
        bytes 07$frame "$tail" > in
        for strict in '' --strict; do
            # shellcheck disable=SC2086  # no word, or one
            run -65 --separate-stderr "${nav[@]}" -F delimited $strict in
            assert_output "$message"
            assert_equal "$stderr" "dccl-decode: in:record 2 (byte 8): $said"
        done
    done << 'END'
0714d9|the stream ends after 2 of the record's 7 bytes
01|the stream ends after 0 of the record's 1 byte
87|the stream ends within the length of a record
ffffffffff|no length of a record stands here
81808001|record of 2097153 bytes is longer than 1048576 bytes (--max-record)
END
    run -65 --separate-stderr "${nav[@]}" -F delimited --max-record 6 < <(bytes 07$frame)
    assert_equal "$stderr" 'dccl-decode: <stdin>:record 1 (byte 0): record of 7 bytes is longer than 6 bytes (--max-record)'
}

@test "dccl-decode: 10,000 messages one behind the other, unframed and in one line" {
    awk 'BEGIN { for (k = 0; k < 10000; ++k)
        printf "14%02x%02x003a01%02x", k % 256, int(k / 256), k % 63 + 1 }' > line
    awk 'BEGIN { for (k = 0; k < 10000; ++k)
        printf "{\"time_s\":%d,\"depth_m\":31.4,\"leg\":%d}\n", 1714521600 + k, k % 63 }' > want
    bytes "$(cat line)" > raw
    "${nav[@]}" -F raw raw > got
    cmp want got
    "${nav[@]}" line > got
    cmp want got
    "${nav[@]}" -f delimited -F raw raw | dccl-encode -s nav.proto -F delimited -f raw > got
    cmp raw got
}

@test "dccl-decode: in a raw stream a lost byte is located, and ends the run" {
    bytes $frame $frame 99aabb $frame > in
    run -65 --separate-stderr "${nav[@]}" -F raw in
    assert_output "$message"$'\n'"$message"
    # 0xaa99 is the long form of 0x554c
    assert_equal "$stderr" "dccl-decode: in:byte 14: identifier 21836 is of no message that is loaded (--resync looks on for the next message)"
    bytes $frame 14d9 > in
    run -65 --separate-stderr "${nav[@]}" -F raw in
    assert_output "$message"
    assert_equal "$stderr" 'dccl-decode: in:byte 7: time_s takes 17 bits where 8 are left (message Nav) (--resync looks on for the next message)'
    # also where the place is beyond the first block of input
    yes $frame | head -30000 | tr -d '\n' > line
    { bytes "$(cat line)" && bytes ffff && bytes $frame; } > in
    run -65 --separate-stderr "${nav[@]}" -F raw in
    assert_equal "${#lines[@]}" 30000
    assert_equal "$stderr" 'dccl-decode: in:byte 210000: identifier 32767 is of no message that is loaded (--resync looks on for the next message)'
}

@test "dccl-decode: --resync looks on for the next message" {
    bytes 99aabb $frame 14d9 $frame $frame ff > in
    run -1 --separate-stderr "${nav[@]}" -F raw --resync in
    # The two bytes of a cut frame are taken for the beginning of one that holds the next; the last
    # frame is found again.
    assert_line --index 0 "$message"
    assert_equal "$(tail -1 <<< "$output")" "$message"
    assert_equal "${stderr_lines[0]}" 'dccl-decode: in:byte 0: identifier 21836 is of no message that is loaded'
    assert_equal "${stderr_lines[1]}" 'dccl-decode: in:byte 0: 3 bytes skipped: no message begins there'
    # noise of another vehicle between frames: nothing of ours is lost
    bytes 4243 $frame 454647 $frame 48 > in
    run -1 --separate-stderr "${nav[@]}" -F raw --resync in
    assert_output "$message"$'\n'"$message"
    assert_equal "$stderr" 'dccl-decode: in:byte 0: identifier 33 is of no message that is loaded
dccl-decode: in:byte 0: 2 bytes skipped: no message begins there
dccl-decode: in:byte 9: identifier 8994 is of no message that is loaded
dccl-decode: in:byte 9: 3 bytes skipped: no message begins there
dccl-decode: in:byte 19: identifier 36 is of no message that is loaded
dccl-decode: in:byte 19: 1 byte skipped: no message begins there'
    run -65 --separate-stderr "${nav[@]}" -F raw --resync --strict in
    assert_output ''
    assert_equal "$stderr" 'dccl-decode: in:byte 0: identifier 33 is of no message that is loaded'
    run_quiet "${nav[@]}" -F raw --resync < <(bytes $frame $frame)
    assert_output "$message"$'\n'"$message"
}

@test "dccl-decode: --resync finds a message behind more noise than a block of input, in a live pipe too" {
    { head -c 20000000 /dev/zero | tr '\0' B && bytes $frame; } > in
    run -1 --separate-stderr timeout 30 "${nav[@]}" -F raw --resync in
    assert_output "$message"
    assert_equal "${stderr_lines[1]}" 'dccl-decode: in:byte 0: 20000000 bytes skipped: no message begins there'
    # also behind identifiers of the CCL, of two bytes, and where there are none
    sed 's/id: 10/id: 1000/' nav.proto > long.proto
    while read -r schema options digits; do
        run -1 --separate-stderr dccl-decode -s "$schema" --time $when -F raw --resync $options < <(bytes $frame 424242 "$digits")
        assert_equal "$(tail -1 <<< "$output")" "$message"
    done << END
nav.proto --id-codec=ccl 20$frame
long.proto --color=never d107${frame:2}
END
    bytes 42 $frame > noise
    echo "$message" > want
    live() { "${nav[@]}" -F raw --resync 2> said || [[ $? -eq 1 ]]; }
    assert_answered_at_once noise want live
}

@test "dccl-decode: any bytes end in a status, not in a signal" {
    head -c 100000 /dev/urandom > noise
    for format in hex base64 delimited raw 'raw --resync'; do
        for passphrase in '' '--passphrase-file passphrase'; do
            for option in '' --lenient --header-only '--id-codec ccl'; do
                # shellcheck disable=SC2086  # words of a command line
                run timeout 20 dccl-decode -s nav.proto -s fleet -s loss.proto -s open.proto --time $when \
                    -F $format $passphrase $option noise
                [[ $status =~ ^(0|1|65)$ ]] || fail "status $status of -F $format $passphrase $option"
            done
        done
    done
    od -An -v -tx1 -w40 noise | tr -d ' ' | sed 's/^../02/' > lines
    run timeout 20 dccl-decode -s loss.proto lines
    [[ $status =~ ^(0|1)$ ]] || fail "status $status"
}

@test "dccl-decode: a time is the one nearest to the receiver's clock" {
    # 43225 s of the day are 12:00:25
    while read -r now time_s; do
        run_quiet dccl-decode -s nav.proto --time "$now" <<< $frame
        assert_output "{\"time_s\":$time_s,\"depth_m\":31.4,\"leg\":12}"
    done << 'END'
2024-05-01T12:00:25Z 1714564825
2024-05-02T00:00:24Z 1714564825
2024-05-02T00:00:26Z 1714651225
2024-05-01T00:00:26Z 1714564825
2024-05-01T00:00:24Z 1714478425
@1714564825 1714564825
2024-05-01T14:00:25+02:00 1714564825
END
    run_quiet dccl-decode -s nav.proto <<< $frame
    now=$(date +%s)
    time_s=$(sed 's/.*"time_s":\([0-9]*\).*/\1/' <<< "$output")
    assert [ $((time_s % 86400)) -eq 43225 ]
    assert [ $((now - time_s)) -le 43202 ]
    assert [ $((time_s - now)) -le 43202 ]
}

@test "dccl-decode: digits of a time that only its resolution states" {
    # 43225.5 s are 86451 = 0x151b3 steps of half a second
    run_quiet dccl-decode -s clock.proto --time @43200 --full-time-resolution <<< 06b35101
    assert_output '{"time_s":43225.5}'
    run_quiet dccl-decode -s clock.proto --time @43200 <<< 06b35101
    assert_output '{"time_s":43226}' # as the reference library rounds it
}

@test "dccl-decode: bodies are decrypted, with the right passphrase" {
    for option in '--passphrase-file passphrase' '--passphrase-fd 5'; do
        # shellcheck disable=SC2086  # words of a command line
        run_quiet bash -c "dccl-encode -s nav.proto --passphrase-file passphrase | ${nav[*]} $option 5< passphrase" <<< "$message"
        assert_output "$message"
    done
    hidden=$(dccl-encode -s nav.proto --passphrase-file passphrase <<< "$message")
    SEAUTILS_PASSPHRASE_FILE=passphrase run_quiet "${nav[@]}" <<< "$hidden"
    assert_output "$message"
    # A wrong one gives garbage behind a header that is right, or a fault; never a crash.
    for ((k = 0; k < 20; k++)); do
        echo "wrong $k" > wrong
        run --separate-stderr "${nav[@]}" --passphrase-file wrong <<< "$hidden"
        [[ $status -eq 0 && $output == '{"time_s":1714564825,'* || $status -eq 1 && $stderr == *' (message Nav)' ]]
        [[ $output != "$message" ]]
    done
    run_quiet "${nav[@]}" --passphrase-file passphrase --skip-crypto-id 10 <<< $frame
    assert_output "$message"
    run -66 "${nav[@]}" --passphrase-file gone <<< "$hidden"
    assert_output 'dccl-decode: gone: No such file or directory'
}

@test "dccl-decode: --header-only needs no passphrase, and looks at nothing behind the header" {
    hidden=$(dccl-encode -s nav.proto --passphrase-file passphrase <<< "$message")
    for line in "$hidden" $frame 14d9a800 14d9a800ff "${frame}ffff"; do
        run_quiet "${nav[@]}" --header-only <<< "$line"
        assert_output '{"time_s":1714564825}'
    done
    assert_refused 'time_s takes 17 bits where 16 are left (message Nav)' -s nav.proto --header-only <<< 14d9a8
    run_quiet "${nav[@]}" -F raw --header-only < <(bytes 14d9a800 14d9a800)
    assert_output $'{"time_s":1714564825}\n{"time_s":1714564825}'
}

@test "dccl-decode: identifiers of the CCL, and none" {
    run_quiet "${nav[@]}" --id-codec ccl <<< 20$frame
    assert_output "$message"
    # the CCL's own message 33
    assert_refused "identifier $((0x0CC10021)) is of no message that is loaded" -s nav.proto --id-codec ccl <<< 21$frame
    assert_refused 'identifier 16 is of no message that is loaded' -s nav.proto <<< 20$frame
    run_quiet dccl-decode -s bare.proto <<< $'c8\nc9ca'
    assert_output $'{"seq":200}\n{"seq":201}\n{"seq":202}'
    run_quiet dccl-decode -s bare.proto -F raw < <(bytes c8c9)
    assert_output $'{"seq":200}\n{"seq":201}'
}

@test "dccl-decode: models of the arithmetic codec" {
    for steps in 0,0,0,0,0,0,0,0 1,-1,1,-1 ''; do
        run_quiet bash -c "dccl-encode -s series.proto --arithmetic-model steps.textpb |
            dccl-decode -s series.proto --arithmetic-model steps.textpb" <<< "{\"step\":[$steps]}"
        # an empty list is no list
        [[ $output == "{\"step\":[$steps]}" || -z $steps && $output == '{}' ]] || fail "$output"
    done
    # An adaptive model learns: the same steps take less the second time, and are read in order.
    echo 'is_adaptive: true' >> steps.textpb
    yes '{"step":[1,1,1,1,1,1]}' | head -20 > in
    run_quiet dccl-encode -s series.proto --arithmetic-model steps.textpb in
    assert [ ${#lines[0]} -gt ${#lines[19]} ]
    run_quiet bash -c "dccl-decode -s series.proto --arithmetic-model steps.textpb <<< '$output' | cmp - in"
}

@test "dccl-decode: JSON is valid whatever a text holds" {
    # A text that was cut within a character: code 4 in length, then abc and 0xc3.
    run_quiet bash -c "dccl-encode -s loss.proto --lenient | dccl-decode -s loss.proto" <<< '{"text":"abcé","least":[8,9]}'
    assert_output '{"text":"abc'$'\xef\xbf\xbd''","least":[8,9],"fixed":"auv"}'
    run_quiet bash -c "dccl-encode -s loss.proto --lenient | dccl-decode -s loss.proto -f text" <<< '{"text":"abcé","least":[8,9]}'
    assert_output 'text: "abc\303" least: 8 least: 9 fixed: "auv"'
    for text in '\u0000' '\u0001\t\r' '\"\\' '\u001b[0m' 'é☃'; do
        run_quiet bash -c "dccl-encode -s fleet -m Note | dccl-decode -s fleet -m Note" <<< "{\"text\":\"$text\"}"
        assert_output "{\"text\":\"$text\"}"
    done
}

@test "dccl-decode: a log of DCCL 1" {
    dive=$SEAUTILS_ROOT/examples/legacy/dive.xml
    # by hand, see dccl-encode.bats
    run_quiet dccl-decode -s "$dive" --time 1970-01-01T00:00:00Z <<< $'202d000000000660\n202d2a303e10'
    assert_output '{"_time":0,"_src_id":0,"_dest_id":0,"depth":5,"temperature":[null,null,null,null]}
{"_time":43200,"_src_id":31,"_dest_id":1,"temperature":[null,null,null,null]}'
    run_quiet dccl-decode -s "$dive" --time 2011-07-25T13:00:00Z -f csv <<< 202d2a303e10
    assert_line --index 0 '_time,_src_id,_dest_id,_multimessage_flag,_broadcast_flag,_unused,_ccl_id,_id,depth,temperature[0],temperature[1],temperature[2],temperature[3],phase,battery,healthy'
    assert_line --index 1 1311595200,31,1,,,,,,,,,,,,,
    sed 's/<layout>/<header><time><name>Stamp<\/name><\/time><src_id><name>Node<\/name><\/src_id><\/header>&/' "$dive" > renamed.xml
    run_quiet dccl-decode -s renamed.xml --time @0 <<< 202d2a303e10
    assert_output '{"Stamp":43200,"Node":31,"_dest_id":1,"temperature":[null,null,null,null]}'
    run_quiet bash -c "dccl-encode -s renamed.xml | dccl-decode -s renamed.xml --time @0" \
        <<< '{"Stamp":43200,"Node":31,"_dest_id":1}'
    assert_output '{"Stamp":43200,"Node":31,"_dest_id":1,"temperature":[null,null,null,null]}'
    assert_refused 'the header takes 6 bytes where 5 are left' -s "$dive" <<< 202d2a303e
    assert_refused 'identifier 91 is of no message that is loaded' -s "$dive" <<< 202daa303e10
    assert_refused 'body is 8 bytes long, more than 7 (message DIVE)' -s "$dive" <<< 202d2a303e100000000000000001
    echo '<message_set><message><name>B</name><id>1</id><size>32</size><layout><bool><name>b</name></bool></layout></message></message_set>' > bool.xml
    assert_refused 'body has bits where it is filled up with zeros (message B)' -s bool.xml <<< 20009530000006
    while IFS='|' read -r options said; do
        # shellcheck disable=SC2086  # words of a command line
        run -64 --separate-stderr dccl-decode -s "$dive" $options <<< 202d2a303e10
        assert_output ''
        assert_equal "$stderr" "dccl-decode: $said"
    done << 'END'
-F raw|frames of DCCL 1 do not say where they end: raw cannot hold them
-f text|messages of DCCL 1 are written as ndjson or csv only
-f delimited|messages of DCCL 1 are written as ndjson or csv only
--header-only|option --header-only is not for messages of DCCL 1
--id-codec ccl|option --id-codec is not for messages of DCCL 1
END
}

@test "dccl-decode: the vectors of DCCL 1" {
    vectors=$SEAUTILS_SHARED/vectors/dccl-legacy
    [[ -d $vectors ]] || skip "no vectors in $SEAUTILS_SHARED/vectors"
    command -v jq > /dev/null || skip "jq is not installed"
    for set in ctd status; do
        # of each vector its frame, and what must be read from it, in one order of keys
        jq -r 'select(.hex and .decoded and (.passphrase | not)) | .hex' "$vectors/$set.jsonl" > hex
        jq -cS 'select(.hex and .decoded and (.passphrase | not))
            | .decoded + {time: .time_s, src: .src, dest: .dest}' "$vectors/$set.jsonl" > want
        assert [ "$(wc -l < hex)" -ge 10 ]
        k=0
        while read -r line; do
            k=$((k + 1))
            time_s=$(sed -n "${k}p" want | jq .time)
            dccl-decode -s "$vectors/$set.xml" --time "@$time_s" <<< "$line"
        done < hex | jq -cS 'with_entries(.key |= ({"_time": "time", "Timestamp": "time", "_src_id": "src",
            "Node": "src", "_dest_id": "dest"}[.] // .)) | del(.["@type"])' > got
        # numbers as jq prints them; what is given as null is not set
        diff <(jq -cS 'walk(if type == "object" then with_entries(select(.value != null)) else . end)' want) \
            <(jq -cS 'walk(if type == "object" then with_entries(select(.value != null)) else . end)' got)
    done
}

@test "dccl-decode: what the reference library reads from 5000 status messages" {
    bulk=$SEAUTILS_SHARED/vectors/dccl/bulk
    [[ -d $bulk ]] || skip "no vectors in $SEAUTILS_SHARED/vectors"
    tool=(dccl-decode -s "$bulk/../schemas/p17_auv.proto" -m VehicleStatus --time @1700000000)
    run_quiet bash -c "${tool[*]} -f text $bulk/vehicle_status.hex | cmp - $bulk/vehicle_status.decoded.textpb"
    run_quiet bash -c "${tool[*]} $bulk/vehicle_status.hex | cmp - <(sed 's/: /:/g; s/, /,/g' $bulk/vehicle_status.decoded.jsonl)"
}

@test "dccl-decode: the reference library's frames with other options" {
    vectors=$SEAUTILS_SHARED/vectors/dccl
    [[ -d $vectors ]] || skip "no vectors in $SEAUTILS_SHARED/vectors"
    # pub-ids-021: a stream of five messages; pub-ids-020: bytes left over
    types='-m Zero -m One -m Long -m Nothing'
    for form in "hex:004d02fe0101810a00ff" raw; do
        # shellcheck disable=SC2086  # words of a command line
        run_quiet dccl-decode -s "$vectors/schemas/p01_ids.proto" $types -F "${form%:*}" \
            < <([[ $form == raw ]] && bytes 004d02fe0101810a00ff || echo "${form#*:}")
        assert_output '{"@type":"svp.ids.Zero","v":77}
{"@type":"svp.ids.One","v":254}
{"@type":"svp.ids.Long","v":128}
{"@type":"svp.ids.Nothing"}
{"@type":"svp.ids.Zero","v":255}'
    done
    run_quiet dccl-decode -s "$vectors/schemas/p01_ids.proto" -m Short --lenient <<< feffaabbcc
    assert_output '{"v":254}'
    # pub-time-002
    run_quiet dccl-decode -s "$vectors/schemas/p11_time.proto" -m TimeV3 --time @1700000000 \
        <<< dcc18ffa6889f9fb2848200c540afc8e1b8813
    assert_output '{"s":1699956801,"s3":1700000000.124,"us":"1700043199000000","us6":"1700000000123456","us4":"1699800000010000","old":1700000000}'
    # pub-header-015
    run_quiet dccl-decode -s "$vectors/schemas/p02_header.proto" -m SplitV2 --header-only <<< 28277d302a
    assert_output '{"src":7,"leg":{"seq":9},"dest":30,"tod":43200}'
}
