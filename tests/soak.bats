#!/usr/bin/env bats
# The short form of tests/soak/run: four nodes whose every stage is killed, on the simulator.

setup() {
    load test_helper
    skip_if_sanitized "time at sea runs 30 times as fast, and does not wait for tools that are ten times as slow"
    cd "$BATS_TEST_TMPDIR" || return
}

@test "link: what was accepted is decoded or dropped with a reason, whatever is killed, stepped, full or started anew" {
    run_quiet "$BATS_TEST_DIRNAME/soak/run" --seconds 15 --seed 1 --dir sea
    echo "$output"
    assert_line 'violations: 0'
    assert_line --regexp '^kills [0-9]+ \(tdma-slot [1-9][0-9]*, queue-sched [1-9][0-9]*, mm-serial [1-9][0-9]*, dccl-decode [1-9][0-9]*\), reboots at sea [1-9]'
    assert_line --regexp 'steps [1-9][0-9]*, stalls with a full FIFO [1-9][0-9]*, full disks [1-9]'

    # And it would have said so: the same sea without one message, and with one too many.
    key=$(gawk '$1 == "decoded" && $2 == $4 { n[$3]++; last = $3 } $1 == "dropped" { gone[$3] } END { for (key in n) if (!(key in gone)) { print key; exit } }' sea/facts)
    clock=$(gawk -F '[:,]' '{ print $2, $3 }' sea/modems.clock)
    judge() { gawk -v to_sim="$clock 1714564800" -f "$BATS_TEST_DIRNAME/soak/verify.awk" "$1" | sed -n '/^violations/,$p'; }
    grep -vE "^(decoded|heard|afresh|replayed) [0-9] $key( |\$)|^said " sea/facts > lost
    run judge lost
    assert_line --partial "message $key to node"
    assert_line --partial 'accepted, never said there, and no drop record'
    { cat sea/facts && grep "^decoded [0-9] $key " sea/facts; } > twice
    run judge twice
    assert_line --partial "message $key came 2 times to node"
}
