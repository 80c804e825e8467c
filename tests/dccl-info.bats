#!/usr/bin/env bats
# dccl-info says what messages cost, and what is wasteful in them.

setup() {
    load test_helper
    schemas=$SEAUTILS_ROOT/schemas/seautils
    cd "$BATS_TEST_TMPDIR" || return
}

# schema NAME BODY: a file NAME.proto with the import, and what is given behind it.
schema() {
    printf 'syntax = "proto2";\nimport "dccl/option_extensions.proto";\n%s\n' "$2" > "$1.proto"
}

# lint_of NAME: "kind field" of each remark on the one message of NAME.proto, in order.
lint_of() {
    dccl-info -s "$1.proto" -f ndjson | jq -r '.lint[] | .kind + " " + (.field // "-")'
}

@test "dccl-info: our own messages take no more than the published sizes" {
    run_quiet bash -c "dccl-info -s $schemas -f ndjson | jq -r '.message + \" \" + (.largest_bytes | tostring)'"
    declare -A published=([DeployCommand]=31 [ProsecuteCommand]=31 [Status]=27 [StatusFillIn]=29 [Contact]=29
        [Track]=29 [Ctd]=256 [BeamTimeRecord]=64 [DebugPoke]=32 [SurfaceDeploy]=13 [SourceActivation]=5 [WinchControl]=3
        [TrackPacket]=257 [TrackAck]=257)
    assert_equal "${#lines[@]}" "${#published[@]}"
    for line in "${lines[@]}"; do
        read -r name bytes <<< "${line#seautils.}"
        [[ -v published[$name] && $bytes -le ${published[$name]} ]] || fail "$line"
    done
}

@test "dccl-info: bits add up to the sizes, as the format counts them" {
    # 170 takes two bytes of identifier; 4 bits of header; 8 + 1 bits of body: 3 + 2 bytes.
    schema sum 'message M { option (dccl.msg) = { id: 170 max_bytes: 32 codec_version: 4 };
      required uint32 h = 1 [(dccl.field) = { min: 0 max: 15 in_head: true }];
      required uint32 b = 2 [(dccl.field) = { min: 0 max: 255 }]; required bool c = 3; }'
    run_quiet bash -c "dccl-info -s sum.proto -f ndjson |
        jq -c '[.id, .id_bits, .head_max_bits, .body_max_bits, .min_bytes, .largest_bytes, .max_bytes, [.fields[].max_bits]]'"
    assert_output '[170,16,4,9,5,5,32,[4,8,1]]'
    run_quiet dccl-info -s sum.proto
    assert_line '  identifier 16 bits, header 4 bits, body 9 bits'
}

@test "dccl-info: each field has its bounds, step, length, repeats and part" {
    schema fields 'message M { option (dccl.msg) = { id: 1 max_bytes: 200 codec_version: 4 unit_system: "si" };
      enum E { A = 0; B = 1; C = 2; }
      required double time_s = 1 [(dccl.field) = { codec: "dccl.time" in_head: true }];
      optional double depth_m = 2 [(dccl.field) = { min: -3 max: 6550 precision: 1 units { base_dimensions: "L" } }];
      optional string name = 3 [(dccl.field) = { max_length: 12 }];
      optional E state = 4; repeated uint32 n = 5 [(dccl.field) = { min: 0 max: 7 max_repeat: 6 min_repeat: 2 }]; }'
    run_quiet bash -c "dccl-info -s fields.proto -f ndjson | jq -c '.fields[]'"
    assert_line --index 0 --partial '"path":"time_s","type":"required double","codec":"dccl.time4","part":"head"'
    assert_line --index 1 '{"path":"depth_m","type":"double","codec":"dccl.default4","part":"body","min":-3,"max":6550,"resolution":0.1,"unit":"m","min_bits":16,"max_bits":16}'
    # 4 bits of length; the unset form is an absent presence bit
    assert_line --index 2 --partial '"max_length":12,"min_bits":1,"max_bits":101'
    assert_line --index 3 --partial '"values":3,"min_bits":2,"max_bits":2'
    # a count of 2 to 6 in 3 bits, elements of 3 bits
    assert_line --index 4 --partial '"min_repeat":2,"max_repeat":6,"min_bits":9,"max_bits":21'
    run_quiet dccl-info -s fields.proto
    assert_line --regexp '^  depth_m +double +-3 to 6550 m +0.1 +16  body$'
    assert_line --regexp '^  n +repeated uint32 +0 to 7, 2 to 6 times +1 +9 to 21  body$'
}

@test "dccl-info: a typical message is sized beside protobuf's form and plain numbers" {
    schema typical 'message M { option (dccl.msg) = { id: 1 max_bytes: 32 codec_version: 4 };
      required uint32 a = 1 [(dccl.field) = { min: 0 max: 255 }]; required double b = 2 [(dccl.field) = { min: 0 max: 255 }];
      required bool c = 3; }'
    # dccl: 1 + (8 + 8 + 1 bits); protobuf: 2 or 3 for 63 (or 127), 9 for a double, 2; plain: three times 4
    run_quiet bash -c "dccl-info -s typical.proto -f ndjson | jq -c .typical"
    assert_output --regexp '^\{"dccl_bytes":4,"protobuf_bytes":13,"plain_bytes":12\}$'
}

@test "dccl-info: bounds that waste codes are named, with what would be free" {
    schema waste 'message M { option (dccl.msg) = { id: 1 max_bytes: 32 codec_version: 4 };
      required double time_s = 1 [(dccl.field) = { codec: "dccl.time" in_head: true }];
      optional int32 wide = 2 [(dccl.field) = { min: -100 max: 1000 }];
      optional int32 full = 3 [(dccl.field) = { min: 0 max: 1022 }]; }'
    run lint_of waste
    assert_output 'wasted-codes wide'
    run_quiet dccl-info -s waste.proto
    # 2048 codes, one of them "not set": 2047 values from -100 end at 1946; 1023 from -100 at 922
    assert_line --partial 'wide: uses 1102 of 2048 codes (11 bits): max 1946 fits for free, max 922 saves a bit'
}

@test "dccl-info: a message of version 2 has a row in each part that its bits are in" {
    schema split 'message M { option (dccl.msg) = { id: 1 max_bytes: 32 codec_version: 2 };
      message Head { optional int32 a = 1 [(dccl.field) = { min: 0 max: 14 in_head: true }]; }
      message Body { optional int32 a = 1 [(dccl.field) = { min: 0 max: 14 }]; }
      message Both { optional int32 a = 1 [(dccl.field) = { min: 0 max: 14 in_head: true }]; optional bool b = 2; }
      optional Head h = 1; optional Body b = 2; optional Both c = 3; }'
    run_quiet bash -c "dccl-info -s split.proto -f ndjson | jq -r '.fields[] | .part + \" \" + .path'"
    assert_output $'head h\nhead h.a\nhead c\nhead c.a\nbody b\nbody b.a\nbody c\nbody c.b'
}

@test "dccl-info: a body that may be encrypted wants a time in its header" {
    schema notime 'message M { option (dccl.msg) = { id: 1 max_bytes: 32 codec_version: 4 }; required bool b = 1; }'
    run lint_of notime
    assert_output 'no-time-in-header -'
    schema headonly 'message M { option (dccl.msg) = { id: 1 max_bytes: 32 codec_version: 4 };
      required bool b = 1 [(dccl.field).in_head = true]; }'
    run lint_of headonly
    assert_output ''
    run_quiet dccl-info -s headonly.proto
    assert_line '  identifier 8 bits, header 1 bit, body 0 bits'
}

@test "dccl-info: ids that collide are named on both sides, and an error where -m names both" {
    schema one 'package p; message A { option (dccl.msg) = { id: 9 max_bytes: 32 codec_version: 4 }; required bool b = 1 [(dccl.field).in_head = true]; }
        message B { option (dccl.msg) = { id: 9 max_bytes: 32 codec_version: 3 }; required bool b = 1 [(dccl.field).in_head = true]; }'
    run_quiet dccl-info -s one.proto
    assert_line --partial 'p.B has the identifier 9 too'
    assert_line --partial 'p.A has the identifier 9 too'
    run -78 dccl-encode -s one.proto <<< '{}'
    assert_output --partial '9'
    # either alone is sound; named together they are a receiver's types
    run_quiet dccl-info -s one.proto -m A
    run -78 --separate-stderr dccl-info -s one.proto -m A -m B
    assert_equal "$stderr" 'dccl-info: one.proto:4: id 9 is both message p.A and message p.B'
}

@test "dccl-info: header leaves that versions 3 and 4 never send are named" {
    for version in 2 3 4; do
        schema lost$version "message M { option (dccl.msg) = { id: 1 max_bytes: 32 codec_version: $version };
          message S { optional int32 q = 1 [(dccl.field) = { min: 0 max: 14 in_head: true }]; optional int32 r = 2 [(dccl.field) = { min: 0 max: 14 }]; }
          required double time_s = 1 [(dccl.field) = { codec: \"dccl.time\" in_head: true }]; optional S sub = 2; }"
    done
    run lint_of lost2
    refute_output --partial lost-field
    for version in 3 4; do
        run lint_of lost$version
        assert_line 'lost-field sub.q'
    done
}

@test "dccl-info: a float that cannot hold its own bound is named" {
    schema floats 'message M { option (dccl.msg) = { id: 1 max_bytes: 32 codec_version: 4 };
      required double time_s = 1 [(dccl.field) = { codec: "dccl.time" in_head: true }];
      required float f = 2 [(dccl.field) = { min: 0 max: 0.7 precision: 1 }];
      required float g = 3 [(dccl.field) = { min: 0 max: 0.3 precision: 1 }];
      required double d = 4 [(dccl.field) = { min: 0 max: 0.3 precision: 1 }]; }'
    run lint_of floats
    # as binary32, 0.7 is below itself and 0.3 above
    assert_output 'unreachable-bound g'
    run -1 dccl-encode -s floats.proto <<< '{"time_s":1,"f":0.7,"g":0.3,"d":0.3}'
    assert_output --partial ': g 0.3 is outside 0 to 0.3'
}

@test "dccl-info: whole numbers in broken steps are said to be cut" {
    schema cut 'message M { option (dccl.msg) = { id: 1 max_bytes: 32 codec_version: 4 };
      required double time_s = 1 [(dccl.field) = { codec: "dccl.time" in_head: true }];
      required int32 broken = 2 [(dccl.field) = { min: 0 max: 100 resolution: 2.5 }];
      required int32 whole = 3 [(dccl.field) = { min: 0 max: 62 resolution: 2 }]; }'
    run lint_of cut
    assert_line 'cut-values broken'
    refute_output --partial whole
    # 37 is 14.8 steps: 14 travel
    run_quiet bash -c "echo '{\"time_s\":1,\"broken\":37,\"whole\":0}' | dccl-encode -s cut.proto | dccl-decode -s cut.proto --time @1"
    assert_output '{"time_s":1,"broken":35,"whole":0}'
}

@test "dccl-info: a message that may pass 32, 64 or 256 bytes names the field that does" {
    schema mtu 'message M { option (dccl.msg) = { id: 1 max_bytes: 400 codec_version: 4 };
      required double time_s = 1 [(dccl.field) = { codec: "dccl.time" in_head: true }];
      required string a = 2 [(dccl.field) = { max_length: 20 }]; required string b = 3 [(dccl.field) = { max_length: 20 }];
      required string c = 4 [(dccl.field) = { max_length: 250 }]; }'
    run lint_of mtu
    assert_line --index 0 'over-mtu b'
    assert_line --index 1 'over-mtu c'
    assert_line --index 2 'over-mtu c'
    assert_equal "${#lines[@]}" 3
}

@test "dccl-info: DCCL 1 has its table too" {
    run_quiet dccl-info -s "$SEAUTILS_ROOT/examples/legacy/dive.xml"
    # 48 bits of header; depth 0 to 200 in 0.1 and "not given": 2002 codes in 11 bits
    assert_line --index 0 'DIVE: id 90, codec version 1, 6 to 13 bytes of at most 32'
    assert_line --regexp '^  depth +number +0 to 200 +0.1 +11  body$'
}

@test "dccl-info: a message that cannot be coded is a warning, and an error where it was asked for" {
    schema bad 'message Good { option (dccl.msg) = { id: 1 max_bytes: 32 codec_version: 4 }; required bool b = 1; }
        message Bad { option (dccl.msg) = { id: 2 max_bytes: 32 codec_version: 4 }; optional int32 n = 1; }'
    run -0 --separate-stderr dccl-info -s bad.proto
    assert_line --index 0 --partial 'Good: id 1'
    [[ $stderr == 'dccl-info: '*'message Bad: field n: option min is missing' ]] || fail "$stderr"
    run -78 --separate-stderr dccl-info -s bad.proto -m Bad
    assert_output ''
    [[ $stderr == 'dccl-info: '*'field n: option min is missing' ]] || fail "$stderr"
}

@test "dccl-info: wrong command lines and schemas have their statuses" {
    run -64 dccl-info
    run -64 dccl-info -s "$schemas" --nonsense
    run -64 dccl-info -s "$schemas" -f csv
    run -64 dccl-info -s "$schemas" one-file-too-many
    run -66 dccl-info -s nowhere.proto
    run -78 dccl-info -s "$schemas" -m Nobody
    echo 'message {' > broken.proto
    run -78 --separate-stderr dccl-info -s broken.proto
    [[ $stderr == 'dccl-info: broken.proto:1'* ]] || fail "$stderr"
}

@test "dccl-info: a passphrase is none of its business" {
    SEAUTILS_PASSPHRASE_FILE=gone run_quiet dccl-info -s "$schemas" -m WinchControl
    assert_line --index 0 --partial 'WinchControl: id 107'
}

@test "dccl-info: a schema may come through a pipe" {
    schema piped 'message M { option (dccl.msg) = { id: 1 max_bytes: 32 codec_version: 4 }; required bool b = 1; }'
    run_quiet dccl-info -s <(cat piped.proto)
    assert_line --index 0 --partial 'M: id 1'
    run -78 --separate-stderr dccl-info -s /dev/zero
    [[ $stderr == 'dccl-info: /dev/zero: larger than 1 MiB' ]] || fail "$stderr"
}

@test "dccl-info: a full disk is 74, help and version are 0 and on standard output" {
    run -74 bash -c "dccl-info -s $schemas > /dev/full"
    run_quiet dccl-info --help
    assert_line --index 0 'Say what messages cost on the link, field by field, and what is wasteful.'
    run_quiet dccl-info --version
    assert_output --regexp '^dccl-info \(seautils\) [0-9]+\.[0-9]+\.[0-9]+$'
}
