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
[[ -n ${SEAUTILS_SANITIZE:-} || ! -f $SEAUTILS_BUILD/CMakeCache.txt ]] ||
    SEAUTILS_SANITIZE=$(sed -n 's/^SEAUTILS_SANITIZE:[A-Z]*=//p' "$SEAUTILS_BUILD/CMakeCache.txt")
export SEAUTILS_ROOT SEAUTILS_BUILD SEAUTILS_BIN SEAUTILS_SHARED SEAUTILS_SANITIZE
export PATH=$SEAUTILS_BIN:$PATH LC_ALL=C TZ=UTC TERM=dumb
# Nothing of whoever runs the tests has a say.
unset SEAUTILS_PASSPHRASE_FILE JOURNAL_STREAM NO_COLOR
unset XDG_CONFIG_HOME XDG_CONFIG_DIRS XDG_DATA_HOME XDG_DATA_DIRS

# run_quiet COMMAND...: it succeeds, and says nothing on standard error.
run_quiet() {
    run --separate-stderr "$@"
    # shellcheck disable=SC2154  # run sets it
    [[ $status -eq 0 ]] || fail "status $status of $*"$'\n'"$output"$'\n'"$stderr"
    assert_equal "$stderr" ''
}

# skip_if_sanitized WHY: a limit of time or memory says nothing of a build with sanitizers.
skip_if_sanitized() {
    case ${SEAUTILS_SANITIZE:-} in
        '' | OFF | 0) ;;
        *) skip "sanitizers: $1" ;;
    esac
}

# bytes DIGITS...: writes them, two hexadecimal digits a byte.
bytes() {
    local all
    all=$(printf %s "$@" | sed 's/../\\x&/g')
    # shellcheck disable=SC2059  # the format is made of \x escapes alone
    printf "$all"
}

# digits: standard input in hexadecimal digits, on one line.
digits() {
    od -An -v -tx1 | tr -d ' \n'
}

# assert_answered_at_once IN OUT COMMAND...: a pipe that brings the file IN, and then nothing more
# while it stays open, is answered with the file OUT.
assert_answered_at_once() {
    local in=$1 out=$2 hold pid k
    shift 2
    rm -f live.pipe
    mkfifo live.pipe
    "$@" < live.pipe > live.out 3>&- &
    pid=$!
    exec {hold}> live.pipe
    cat "$in" >&"$hold"
    for ((k = 0; k < 200; k++)); do
        ! cmp -s live.out "$out" || break
        sleep 0.05
    done
    cmp live.out "$out"
    kill -0 "$pid" # so it was no end of its input that made it answer
    exec {hold}>&-
    wait "$pid"
    cmp live.out "$out"
}

# signal_that_ends SIGNAL IN COMMAND...: sends SIGNAL to COMMAND after its answer to the file IN, and
# prints the number of the signal that it died of; 0 where it exited.
signal_that_ends() {
    perl -e '
        my ($signal, $in, @command) = @ARGV;
        pipe my $from, my $to;
        pipe my $answer, my $back;
        my $pid = fork;
        if (!$pid) {
            open STDIN, "<&", $from;
            open STDOUT, ">&", $back;
            close $_ for $to, $answer;
            $SIG{$_} = "DEFAULT" for qw(INT TERM PIPE HUP);
            exec @command or exit 127;
        }
        close $_ for $from, $back;
        open my $file, "<", $in;
        syswrite $to, join "", <$file>;
        sysread $answer, my $byte, 1;
        kill $signal, $pid;
        waitpid $pid, 0;
        print $? & 127;' "$@" 3>&-
}

# assert_dies_of SIGNAL IN COMMAND...
assert_dies_of() {
    run_quiet signal_that_ends "$@"
    assert_output "$(kill -l "$1")"
}

# on_terminal COMMAND_LINE: runs it with a terminal for all three streams; what it says goes to
# standard output without carriage returns, and its status is passed on.
on_terminal() {
    local status=0
    command -v script > /dev/null || skip "script(1) is not installed"
    script -qec "$1" terminal.log < /dev/null > /dev/null 2>&1 3>&- || status=$?
    # The first and the last line are script's own; ^D is what it sends at the end of its input.
    sed '1d; $d' terminal.log | tr -d '\r\004\010' | sed 's/\^D//'
    return $status
}

# peak_kib PID: the most memory that a running process has held so far.
peak_kib() {
    sed -n 's/^VmHWM:[^0-9]*\([0-9]*\) kB$/\1/p' "/proc/$1/status"
}
