#!/usr/bin/env bats
# The field codec seautils.position in dccl-encode, dccl-decode and dccl-info.

setup() {
    load test_helper
    cd "$BATS_TEST_TMPDIR" || return
    cp "$SEAUTILS_ROOT"/man/examples/brief.proto .
    sed '/optional Place/d; s/, and where//' brief.proto > without.proto
    sed 's/"seautils.position"/"dccl.default"/' brief.proto > plain.proto
}

# brief K [BATTERY]: the K-th message of a vehicle that goes east and down.
brief() {
    printf '{"vehicle":7,"place":{"time_s":%d,"x_m":%d,"y_m":-40,"depth_m":%d},"battery_percent":%d}\n' \
        $((1714564800 + 10 * $1)) $((100 + 12 * $1)) $((20 + $1)) "${2:-81}"
}

# send K: its frame, by a sender that keeps its state and hears of acknowledgements.
send() {
    brief "$1" | dccl-encode -s brief.proto --position-state sent --position-acks acks
}
# hear FRAME: what the receiver makes of it.
hear() {
    dccl-decode -s brief.proto --position-state heard --position-acks acks "${@:2}" <<< "$1"
}

@test "dccl position: each message brings its position, and is short once one was acknowledged" {
    for k in {0..9}; do
        frame=$(send "$k")
        run_quiet hear "$frame"
        assert_output "$(brief "$k")"
        if ((k == 0)); then
            # 13 bits of id and vehicle: 2 bytes; start and full fix, more than 43 + 17 + 17 + 13 bits, and check.
            assert [ $((${#frame} / 2)) -gt 15 ]
        else
            assert [ $((${#frame} / 2)) -le 9 ]
        fi
    done
    # A plain position takes 14 + 16 + 16 + 13 bits and the 60th says that there is one.
    assert_equal "$(brief 9 | dccl-encode -s plain.proto | tr -d '\n' | wc -c)" $((2 * (2 + 9)))
    assert [ ${#frame} -lt 16 ]
}

@test "dccl position: lost messages and acknowledgements leave nothing wrong" {
    for k in {0..29}; do
        frame=$(send "$k")
        ((k % 3 != 1)) || continue
        ((k % 4 == 0)) && said=acks || said=lost
        run_quiet dccl-decode -s brief.proto --position-state heard --position-acks "$said" <<< "$frame"
        assert_output "$(brief "$k")"
    done
    assert [ "$(wc -l < acks)" -eq 5 ]
}

@test "dccl position: a receiver that lost its state tells all but the position, until it is told anew" {
    for k in 0 1 2; do hear "$(send "$k")"; done
    rm heard
    frame=$(send 3)
    run -0 --separate-stderr hear "$frame" -v
    assert_output '{"vehicle":7,"battery_percent":81}'
    assert_regex "$stderr" '^dccl-decode: Brief.place of vehicle 0: '
    # It asked for that at once.
    run_quiet hear "$(send 4)"
    assert_output "$(brief 4)"
}

@test "dccl position: a damaged state is said, and nothing wrong comes of it" {
    hear "$(send 0)"
    hear "$(send 1)"
    printf x >> heard
    run -0 --separate-stderr hear "$(send 2)"
    assert_output '{"vehicle":7,"battery_percent":81}'
    assert_regex "$stderr" '^dccl-decode: heard: .*: positions begin anew$'
    printf '\xff' > sent
    run -0 --separate-stderr send 3
    assert_regex "$stderr" '^dccl-encode: sent: .*: positions begin anew$'
    run_quiet hear "$output"
    assert_output "$(brief 3)"
}

@test "dccl position: twice the same message brings the position once" {
    frame=$(send 0)
    run_quiet hear "$frame"
    assert_output "$(brief 0)"
    run_quiet hear "$frame"
    assert_output '{"vehicle":7,"battery_percent":81}'
}

@test "dccl position: other fields keep their bits" {
    # Not set it is 5 zeros in front of the battery's 7 bits: 82 in 0000 0101 0010 (least significant first).
    run_quiet dccl-encode -s without.proto <<< '{"vehicle":7,"battery_percent":81}'
    assert_output "$(printf 'f006%02x' 82)"
    run_quiet dccl-encode -s brief.proto <<< '{"vehicle":7,"battery_percent":81}'
    assert_output "$(printf 'f006%02x%02x' $((82 << 5 & 255)) $((82 >> 3)))"
    run_quiet dccl-decode -s brief.proto <<< "$output"
    assert_output '{"vehicle":7,"battery_percent":81}'
    # And with a position of any length.
    for battery in 0 50 100; do
        frame=$(brief 0 $battery | dccl-encode -s brief.proto)
        run_quiet dccl-decode -s brief.proto <<< "$frame"
        assert_output "$(brief 0 $battery)"
    done
}

@test "dccl position: what is no position is refused, and named" {
    refused() {
        run -1 --separate-stderr dccl-encode -s brief.proto <<< "{\"vehicle\":7,\"place\":{$1}}"
        assert_output ''
        assert_equal "$stderr" "dccl-encode: <stdin>:1: place $2 (message Brief)"
    }
    refused '"x_m":1,"y_m":2,"depth_m":3' 'time_s is not set'
    refused '"time_s":5,"x_m":1,"y_m":2' 'depth_m is not set'
    refused '"time_s":-1,"x_m":1,"y_m":2,"depth_m":3' 'time_s -1 is outside the years 1970 to 2248'
    run -1 --separate-stderr dccl-encode -s brief.proto \
        <<< '{"vehicle":7,"place":{"time_s":5,"x_m":32001,"y_m":2,"depth_m":3}}'
    assert_regex "$stderr" '^dccl-encode: <stdin>:1: place .*32001.*32000'
}

@test "dccl position: a schema that does not suit is refused, and says why" {
    unsuited() {
        sed "$1" brief.proto > bad.proto
        run --separate-stderr dccl-info -s bad.proto -m Brief
        assert_failure
        assert_regex "$stderr" "bad.proto:[0-9]+: message Brief: field place: codec seautils.position: $2"
    }
    unsuited 's/resolution: 10//' 'time_s has no option resolution'
    unsuited '/x_m/s/resolution: 1 /resolution: 2 /' 'x_m and y_m differ in their resolution'
    unsuited '/y_m/s/max: 32000//' 'y_m has no option min or max'
    unsuited '/depth_m/d' 'message Place has no field depth_m'
    unsuited '/x_m/s/32000/32000.5/' 'min -32000.5 of x_m is no multiple'
    unsuited 's/optional Place place = 2/repeated Place place = 2/' 'is for optional fields'
    unsuited 's/\[(dccl.field).codec = "seautils.position"\]/[(dccl.field) = { codec: "seautils.position" max_length: 4 }]/' \
        'max_length 4 is outside'
    sed 's/seautils.position/seautils.nothing/' brief.proto > bad.proto
    run --separate-stderr dccl-info -s bad.proto -m Brief
    assert_failure
    assert_regex "$stderr" "no codec 'seautils.nothing' for its type"
}

@test "dccl position: dccl-info has its bounds" {
    run_quiet dccl-info -f ndjson -s brief.proto
    # Of nothing: 5 bits.
    assert_regex "$output" '"path":"place"[^}]*"codec":"seautils.position"[^}]*"min_bits":5,'
}

@test "dccl position: vehicles are told apart by their records" {
    for vehicle in 3 5; do
        brief $vehicle | dccl-encode -s brief.proto --position-state sent.$vehicle > frame.$vehicle
    done
    for vehicle in 3 5; do
        printf '{"time":"2024-05-01T12:00:00Z","reception":{"src":%d,"dest":1,"kind":"DATA","frame":["%s"]}}\n' \
            $vehicle "$(bytes "$(< frame.$vehicle)" | base64 -w0)"
    done > receptions
    run_quiet dccl-decode -s brief.proto --records --position-state heard --position-acks acks receptions
    assert_output "$(brief 3)"$'\n'"$(brief 5)"
    assert_equal "$(cut -d, -f1 acks)" '{"@dest":3'$'\n''{"@dest":5'
    # Each goes on from its own.
    for vehicle in 3 5; do
        run_quiet dccl-encode -s brief.proto --position-state sent.$vehicle --position-acks acks <<< "$(brief $((vehicle + 1)))"
        assert [ ${#output} -lt 24 ]
    done
}

@test "dccl position: a FIFO brings acknowledgements to a live encoder" {
    mkfifo acks in out
    dccl-encode -s brief.proto --position-acks acks < in > out 3>&- &
    pid=$!
    exec {in}> in {out}< out
    for k in 0 1 2; do
        brief $k >&"$in"
        read -r -t 20 frame <&"$out"
        run_quiet hear "$frame"
        assert_output "$(brief $k)"
    done
    exec {in}>&-
    wait $pid
    assert [ ${#frame} -lt 20 ]
}

@test "dccl position: lines that are no acknowledgement are warned of" {
    printf '%s\n' '{"ack":5}' 'noise' '{"ack":"AAAA"}' '{}' > acks
    run -0 --separate-stderr send 0
    assert_equal "$(grep -c '^dccl-encode: acks: no acknowledgement: ' <<< "$stderr")" 2
    run_quiet hear "$output"
    assert_output "$(brief 0)"
}

@test "dccl position: random frames are refused or tell no position" {
    for k in {0..4}; do hear "$(send "$k")" > last; done
    awk 'BEGIN { x = 1
        for (k = 0; k < 500; k++) {
            printf "f006"
            for (b = 0; b < 12; b++) { x = x * 16807 % 2147483647; printf "%02x", int(x / 1000) % 256 }
            print ""
        } }' > noise.hex
    dccl-decode -s brief.proto --position-state heard noise.hex > told 2> /dev/null || true
    run -1 grep place told
    assert [ "$(wc -l < told)" -gt 0 ]
}
