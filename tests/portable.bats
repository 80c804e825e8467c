#!/usr/bin/env bats
# The codecs of a track make the same bits by any compiler, at any optimisation, in 64 bits and in 32.

setup() {
    load test_helper
    cd "$BATS_TEST_TMPDIR" || return
}

# hashes COMPILER FLAG...: builds the program of tests/portable, and prints what it says.
hashes() {
    local part parts=(codecs horizon mix thesis) jobs=() CCACHE
    CCACHE=$(command -v ccache || true)
    for part in "${parts[@]}"; do
        ${CCACHE:+"$CCACHE"} "$@" -std=c++20 -I "$BATS_TEST_DIRNAME/portable" -I "$SEAUTILS_ROOT/lib" \
            -c -o "$part.o" "$BATS_TEST_DIRNAME/portable/$part.cpp" &
        jobs+=($!)
    done
    for part in "${jobs[@]}"; do wait "$part" || return; done
    "$@" -o codecs "${parts[@]/%/.o}"
    ./codecs
}

# assert_same_bits COMPILER FLAG...: as those of g++ -O0, which are made once.
assert_same_bits() {
    command -v "$1" > /dev/null || skip "$1 is not installed"
    local first=$BATS_FILE_TMPDIR/first
    [[ -s $first ]] || hashes g++ -O0 > "$first"
    hashes "$@" > other
    diff "$first" other || fail "other bits by $*"
    assert [ "$(wc -l < other)" -ge 20 ]
}

@test "portable: -O3" {
    assert_same_bits g++ -O3
}

@test "portable: 32-bit x86, whose floating point has 80 bits" {
    echo 'int main() {}' > empty.cpp
    g++ -m32 empty.cpp -o empty 2> /dev/null || skip "g++ -m32 cannot link (g++-multilib)"
    assert_same_bits g++ -m32 -O2
}

@test "portable: clang" {
    assert_same_bits clang++ -O2
}
