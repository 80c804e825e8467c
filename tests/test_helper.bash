# Loaded by setup() of each .bats file: `load test_helper`.
bats_require_minimum_version 1.5.0
for library in bats-support bats-assert bats-file; do
    load "/usr/lib/bats/$library/load"
done

# The tools of the build under test; those of build/release when bats is run by hand.
SEAUTILS_ROOT=$(cd "$BATS_TEST_DIRNAME/.." && pwd)
SEAUTILS_BUILD=${SEAUTILS_BUILD:-$SEAUTILS_ROOT/build/release}
SEAUTILS_BIN=${SEAUTILS_BIN:-$SEAUTILS_BUILD/bin}
SEAUTILS_SHARED=${SEAUTILS_SHARED:-$SEAUTILS_ROOT/../shared}
export SEAUTILS_ROOT SEAUTILS_BUILD SEAUTILS_BIN SEAUTILS_SHARED
export PATH=$SEAUTILS_BIN:$PATH LC_ALL=C TZ=UTC
unset SEAUTILS_PASSPHRASE_FILE JOURNAL_STREAM NO_COLOR

# run_quiet COMMAND...: it succeeds, and says nothing on standard error.
run_quiet() {
    run -0 --separate-stderr "$@"
    assert_equal "$stderr" ''
}
