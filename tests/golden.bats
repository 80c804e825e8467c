#!/usr/bin/env bats
# Recordings go through the tools as they always did; bad ones are refused as they always were.

setup() {
    load test_helper
    data=$BATS_TEST_DIRNAME/data
    cd "$SEAUTILS_ROOT" || return
}

@test "golden: each recording gives what is kept beside it" {
    run -0 scripts/update-golden --check
    assert_output --regexp '^update-golden: [0-9]+ cases, 0 differ$'
}

@test "golden: each recording says where it comes from" {
    for about in "$data"/*/*.about; do
        for key in Command Source Date Notes; do
            grep -q "^$key: ." "$about" || fail "$about has no $key"
        done
    done
}

@test "golden: what the mission's frames hold is within half a step of what went in" {
    run_quiet awk -v got="$data/dccl-decode/seaexplorer.out" -f examples/mission/compare.awk \
        "$data/dccl-encode/seaexplorer.in"
    assert_output --regexp '[1-9][0-9]+ values in 43 messages compared: all the same within half a resolution$'
}

@test "golden: what must be refused is, in one located line" {
    refused=0
    for tool in dccl-encode dccl-decode; do
        for file in "$data/$tool"/refuse/*; do
            run -1 --separate-stderr "$tool" -s schemas/seautils -m Status "$file"
            assert_output ''
            assert_equal "${#stderr_lines[@]}" 1
            [[ $stderr == "$tool: $file:1: "* ]] || fail "not located: $stderr"
            [[ ${#stderr} -lt 400 ]] || fail "too long: $stderr"
            refused=$((refused + 1))
        done
    done
    assert [ "$refused" -ge 15 ]
}
