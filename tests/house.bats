#!/usr/bin/env bats
# What all tools have in common. Each file of tools/ must have a job here.

setup() {
    load test_helper
    cd "$BATS_TEST_TMPDIR" || return
    cp "$BATS_TEST_DIRNAME/data/schemas/nav.proto" .
    # 43225 s of the day are 0xa8d9; 31.4 m are 314 = 0x013a steps of 0.1 m, in 16 bits; leg 12 is
    # code 13 of 6 bits. Id 10 is sent as 20.
    echo '{"time_s":1714564825,"depth_m":31.4,"leg":12}' > message
    echo 14d9a8003a010d > frame
    echo '$CAMPA,1,2*5D' > sentence
    echo '{"time":"1970-01-01T00:00:00Z","modem":{"event":"HEARD","src":1,"dest":2}}' > heard
}

# The tools that load schemas; those of the link have all this in their own suites.
tools() {
    for tool in "$BATS_TEST_DIRNAME"/../tools/dccl-*.cpp; do basename "$tool" .cpp; done
}

# job TOOL: `job` is a sound call; for a filter `in` and `out` are a record and its answer, `bad` is
# a record that it refuses, and `fault` what it says of that.
job() {
    in='' out='' bad='' fault=''
    case $1 in
        dccl-encode)
            job=(dccl-encode -s nav.proto) in=message out=frame
            bad='{"time_s":1714564825,"depth_m":99999}'
            fault='depth_m 99999 is outside 0 to 6000 m (message Nav)'
            ;;
        dccl-decode)
            job=(dccl-decode -s nav.proto --time 2024-05-01T12:00:00Z) in=frame out=message
            bad=14d9a8003a01
            fault='leg takes 6 bits where 0 are left (message Nav)'
            ;;
        dccl-info) job=(dccl-info -s nav.proto) ;;
        mm-serial)
            job=(mm-serial --replay) in=sentence out=heard
            bad='$CAMPA,1,2*5E'
            fault='checksum 5E is not the 5D of its bytes'
            ;;
        *) fail "house.bats has no job for $1" ;;
    esac
}

filters() {
    for tool in $(tools); do
        job "$tool"
        [[ -z $in ]] || echo "$tool"
    done
}

# work: the job, given its record if it wants one.
work() {
    "${job[@]}" "$@" < "${in:-/dev/null}"
}

@test "house: a full disk is status 74, and is told" {
    for tool in $(tools); do
        job "$tool"
        for words in "${job[*]}" "$tool --help" "$tool --version" "$tool --print-config"; do
            run -74 --separate-stderr bash -c "$words < ${in:-/dev/null} > /dev/full"
            assert_equal "$stderr" "$tool: write failed: No space left on device"
        done
    done
}

@test "house: a closed standard output is status 74, a closed standard error no matter" {
    for tool in $(tools); do
        job "$tool"
        run -74 --separate-stderr bash -c "${job[*]} < ${in:-/dev/null} >&-"
        assert_equal "$stderr" "$tool: write failed: Bad file descriptor"
        run -0 bash -c "${job[*]} < ${in:-/dev/null} 2>&-"
        assert_output "$(work)"
    done
}

@test "house: --help is on standard output, with all parts, and fits a terminal" {
    for tool in $(tools); do
        run_quiet "$tool" --help
        long=$output
        assert_line --index 0 --regexp '^[A-Z].*[a-z]\.$'
        assert_output --partial "Usage: $tool [OPTION]..."
        assert_line 'Options:'
        assert_line 'Examples:'
        assert_line --regexp "^  $tool "
        assert_line "The manual: man $tool"
        assert [ "${#lines[@]}" -le 45 ]
        for line in "${lines[@]}"; do [[ ${#line} -le 100 ]] || fail "$tool: $line"; done
        refute_output --regexp 'FLOAT|TEXT|INT|UINT| in \['
        run_quiet "$tool" -h
        assert_output "$long"
    done
}

@test "house: --version is the project's" {
    version=$(sed -n 's/^project(seautils VERSION \([0-9.]*\).*/\1/p' "$SEAUTILS_ROOT/CMakeLists.txt")
    assert [ -n "$version" ]
    for tool in $(tools); do
        for option in --version -V; do
            run_quiet "$tool" "$option"
            assert_output "$tool (seautils) $version"
        done
    done
}

@test "house: an unknown option is named, even when a required one is missing" {
    for tool in $(tools); do
        run -64 --separate-stderr "$tool" --slots
        assert_output ''
        assert_equal "$stderr" "$tool: unknown option --slots (try --help)"
        run -64 --separate-stderr "$tool" --slots=3
        assert_equal "$stderr" "$tool: unknown option --slots (try --help)"
        run -64 --separate-stderr "$tool" -Z
        assert_equal "$stderr" "$tool: unknown option -Z (try --help)"
        run -64 --separate-stderr "$tool" --shcema nav.proto
        assert_equal "$stderr" "$tool: unknown option --shcema (did you mean --schema?)"
    done
}

@test "house: what else is wrong with a command line is said in our words" {
    for tool in $(tools); do
        job "$tool"
        while IFS='|' read -r words said; do
            run -64 --separate-stderr bash -c "${job[*]} $words < /dev/null"
            assert_output ''
            assert_equal "$stderr" "$tool: $said"
        done << 'END'
--color red|option --color: 'red' is none of auto, always, never
--color|option --color lacks its value (WHEN)
--color=|option --color: the value is empty
--schema ''|option --schema: the value is empty
--color never --color never|option --color is given twice
--time noon --time noon|option --time is given twice
--quiet=perhaps|option --quiet: 'perhaps' is neither true nor false
--id-codec usbl|option --id-codec: 'usbl' is none of default, ccl
END
        run -64 --separate-stderr "$tool"
        assert_equal "$stderr" "$tool: option --schema is required (try --help)"
        run -64 --separate-stderr "${job[@]}" --format png
        assert_regex "$stderr" "^$tool: option --format: 'png' is none of [a-z]+(, [a-z0-9]+)+$"
    done
    for tool in $(filters); do
        job "$tool"
        while IFS='|' read -r words said; do
            run -64 --separate-stderr bash -c "${job[*]} $words < /dev/null"
            assert_output ''
            assert_equal "$stderr" "$tool: $said"
        done << 'END'
--max-record 0|option --max-record: '0' is outside 1 to 16777216 bytes
--max-record 16777217|option --max-record: '16777217' is outside 1 to 16777216 bytes
--max-record -1|option --max-record: '-1' is outside 1 to 16777216 bytes
--max-record 1k|option --max-record: '1k' is outside 1 to 16777216 bytes
''|the name of a FILE is empty
END
        run -64 --separate-stderr "${job[@]}" --input-format morse
        assert_regex "$stderr" "^$tool: option --input-format: 'morse' is none of [a-z]+(, [a-z0-9]+)+$"
    done
}

@test "house: a time is UTC, and refused without a zone" {
    for tool in $(tools); do
        job "$tool"
        for time in noon 2024-05-01T12:00:25 2024-13-01T00:00:00Z 12:00Z @ @x '@1 '; do
            run -64 --separate-stderr "$tool" -s nav.proto --time "$time"
            assert_equal "$stderr" "$tool: option --time: time '$time' is not of the form 2024-05-01T12:00:25Z"
        done
        run_quiet bash -c "$tool -s nav.proto --time @1714564800 < /dev/null"
    done
}

@test "house: a schema that is not there is 66, one that is wrong is 78 and located" {
    mkdir none
    printf '%s\n' 'syntax = "proto2";' 'message A {' '  required deep = 1;' '}' > wrong.proto
    sed 's/id: 10/id: 40000/' nav.proto > id.proto
    sed 's/max: 6000 //' nav.proto > max.proto
    printf '%s\n' 'syntax = "proto2";' 'import "gone.proto";' > import.proto
    for tool in $(tools); do
        run -66 --separate-stderr "$tool" -s gone.proto
        assert_equal "$stderr" "$tool: gone.proto: No such file or directory"
        run -66 --separate-stderr "$tool" -s none
        assert_equal "$stderr" "$tool: none: no .proto file in this folder"
        run -78 --separate-stderr "$tool" -s wrong.proto
        assert_equal "${#stderr_lines[@]}" 1
        assert_regex "$stderr" "^$tool: wrong.proto:3:[0-9]+: [a-z]"
        run -78 --separate-stderr "$tool" -s import.proto
        assert_equal "${#stderr_lines[@]}" 1
        assert_regex "$stderr" "^$tool: import.proto:2:[0-9]+: .*gone.proto"
        run -78 --separate-stderr "$tool" -s id.proto -m Nav
        assert_equal "$stderr" "$tool: id.proto:5: message Nav: id 40000 is outside 0 to 32767"
        run -78 --separate-stderr "$tool" -s max.proto -m Nav
        assert_equal "$stderr" "$tool: max.proto:8: message Nav: field depth_m: option max is missing"
        run -78 --separate-stderr "$tool" -s nav.proto -m Nab
        assert_equal "$stderr" "$tool: message 'Nab' is not in the schema (did you mean 'Nav'?)"
    done
}

@test "house: text that is no schema is refused in one line" {
    head -c 3000 /dev/urandom > noise.proto
    head -c 100000 /dev/zero | tr '\0' '{' > deep.proto
    head -c 2M /dev/zero | tr '\0' ' ' > long.proto
    for tool in $(tools); do
        for file in noise.proto deep.proto long.proto frame; do
            run -78 --separate-stderr "$tool" -s "$file"
            assert_output ''
            assert_equal "${#stderr_lines[@]}" 1
            assert_regex "$stderr" "^$tool: $file:"
        done
    done
}

@test "house: messages have the journal's priorities where standard error is the journal" {
    for tool in $(tools); do
        run -66 bash -c "exec 2> log; JOURNAL_STREAM=\$(stat -Lc %d:%i log) $tool -s gone.proto"
        assert_equal "$(cat log)" "<3>$tool: gone.proto: No such file or directory"
        run -66 bash -c "exec 2> log; JOURNAL_STREAM=1:1 $tool -s gone.proto"
        assert_equal "$(cat log)" "$tool: gone.proto: No such file or directory"
    done
    # A type that cannot be coded is left out with a warning.
    { cat nav.proto && sed -n 's/Nav/Bad/; s/id: 10/id: 11/; /^message/,$p' nav.proto | sed 's/max: 62/max: -1/'; } > two.proto
    for tool in $(filters); do
        run -0 bash -c "exec 2> log; JOURNAL_STREAM=\$(stat -Lc %d:%i log) $tool -s two.proto < /dev/null"
        run cat log
        assert_output --regexp "^<4>$tool: left out: two.proto:19: message Bad: field leg: min 0 and max -1"
        run_quiet bash -c "$tool -q -s two.proto < /dev/null"
        assert_output ''
    done
}

@test "house: colour is on a terminal only, where nobody objects, and never in records" {
    red=$'\033[31m'
    for tool in $(tools); do
        fault="$tool: gone.proto: No such file or directory"
        run -66 on_terminal "TERM=xterm $tool -s gone.proto"
        assert_output "$red$fault"$'\033[0m'
        for without in TERM=dumb 'TERM=xterm NO_COLOR=1' '-u TERM'; do
            run -66 on_terminal "env $without $tool -s gone.proto"
            assert_output "$fault"
        done
        run -66 on_terminal "TERM=xterm $tool -s gone.proto --color never"
        assert_output "$fault"
        run -66 --separate-stderr "$tool" -s gone.proto --color=always
        assert_equal "$stderr" "$red$fault"$'\033[0m'
        TERM=xterm run -66 --separate-stderr "$tool" -s gone.proto
        assert_equal "$stderr" "$fault"
        job "$tool"
        plain=$(work)
        run_quiet work --color always
        assert_output "$plain"
        TERM=xterm run -0 on_terminal "${job[*]} ${in:-} --color always"
        assert_output "$plain"
    done
}

@test "house: a live pipe is answered before its end" {
    for tool in $(filters); do
        job "$tool"
        assert_answered_at_once "$in" "$out" "${job[@]}"
    done
}

@test "house: a reader that goes away ends a filter silently" {
    for tool in $(filters); do
        job "$tool"
        yes "$(cat "$in")" | head -20000 > many
        run_quiet bash -c "${job[*]} many | head -1; exit \${PIPESTATUS[0]/141/0}"
        assert_output "$(cat "$out")"
        # also where whoever starts it ignores the signal
        run -141 --separate-stderr bash -c "trap '' PIPE; set -o pipefail; ${job[*]} many | head -1"
        assert_equal "$stderr" ''
    done
}

@test "house: a filter dies of the signal that is sent to it" {
    for tool in $(filters); do
        job "$tool"
        for signal in TERM INT HUP; do assert_dies_of $signal "$in" "${job[@]}"; done
    done
}

@test "house: a bad record is located, dropped, and makes the status 1; the next one is read" {
    for tool in $(filters); do
        job "$tool"
        { cat "$in" && echo "$bad" && cat "$in"; } > three
        run -1 --separate-stderr "${job[@]}" three
        assert_output "$(cat "$out" "$out")"
        assert_equal "$stderr" "$tool: three:2: $fault"
        run -1 --separate-stderr bash -c "${job[*]} < three"
        assert_equal "$stderr" "$tool: <stdin>:2: $fault"
        run -1 --separate-stderr "${job[@]}" "$in" - three < three
        assert_equal "$stderr" "$tool: <stdin>:2: $fault"$'\n'"$tool: three:2: $fault"
        run -1 --separate-stderr "${job[@]}" --quiet three
        assert_equal "$stderr" "$tool: three:2: $fault"
        run -65 --separate-stderr "${job[@]}" --strict three
        assert_output "$(cat "$out")"
        assert_equal "$stderr" "$tool: three:2: $fault"
    done
}

@test "house: an input that cannot be read is 66, after what stood in front of it" {
    for tool in $(filters); do
        job "$tool"
        run -66 --separate-stderr "${job[@]}" "$in" gone
        assert_output "$(cat "$out")"
        assert_equal "$stderr" "$tool: gone: No such file or directory"
        run -66 --separate-stderr "${job[@]}" .
        assert_equal "$stderr" "$tool: .: Is a directory"
        run -74 --separate-stderr bash -c "${job[*]} <&-"
        assert_equal "$stderr" "$tool: <stdin>: read failed: Bad file descriptor"
    done
}

@test "house: CR LF, a last line without its end, empty lines, and nothing at all" {
    for tool in $(filters); do
        job "$tool"
        { sed 's/$/\r/' "$in" && echo && printf '\r\n' && printf %s "$(cat "$in")"; } > lines
        run_quiet "${job[@]}" lines
        assert_output "$(cat "$out" "$out")"
        run_quiet "${job[@]}" /dev/null
        assert_output ''
        { echo && echo "$bad"; } > second
        run -1 --separate-stderr "${job[@]}" second
        assert_equal "$stderr" "$tool: second:2: $fault" # an empty line counts
    done
}

@test "house: a record above --max-record is refused, and the next one is read" {
    for tool in $(filters); do
        job "$tool"
        length=$(($(wc -c < "$in") - 1))
        { printf '%*s\n' $((length + 1)) x && cat "$in"; } > lines
        run -1 --separate-stderr "${job[@]}" --max-record "$length" lines
        assert_output "$(cat "$out")"
        assert_equal "$stderr" "$tool: lines:1: longer than $length bytes (--max-record)"
        run -65 --separate-stderr "${job[@]}" --max-record "$length" --strict lines
        assert_output ''
    done
}

@test "house: a NUL byte is refused, not taken for an end, and does not reach the terminal" {
    for tool in $(filters); do
        job "$tool"
        { printf '\0\n' && tr '\n' '\0' < "$in" && echo && cat "$in"; } > nul
        run -1 bash -c "${job[*]} nul 2> said"
        assert_output "$(cat "$out")"
        run cat said
        assert_line --index 0 --regexp "^$tool: nul:1: .*(NUL|x00)"
        assert_line --index 1 --regexp "^$tool: nul:2: .*(NUL|x00)"
        assert_equal "${#lines[@]}" 2
        assert_equal "$(tr -d '[:print:]\n' < said | wc -c)" 0
    done
}

@test "house: a line of 1 GB is refused in little memory, and the next one is read" {
    skip_if_sanitized "memory is not that of a release"
    for tool in $(filters); do
        job "$tool"
        rm -f wide.pipe && mkfifo wide.pipe
        "${job[@]}" < wide.pipe > got 2> said 3>&- &
        pid=$!
        exec {hold}> wide.pipe
        head -c 1G /dev/zero | tr '\0' a >&"$hold"
        { echo && cat "$in"; } >&"$hold"
        for ((k = 0; k < 200; k++)); do cmp -s got "$out" && break || sleep 0.05; done
        peak=$(peak_kib $pid)
        exec {hold}>&-
        wait $pid && status=0 || status=$?
        assert_equal "$status" 1
        run cat got said
        assert_output "$(cat "$out")"$'\n'"$tool: <stdin>:1: longer than 1048576 bytes (--max-record)"
        [[ $peak -le 20480 ]] || fail "$tool held $peak KiB, more than 20 MB"
    done
}

@test "house: a long stream takes no more memory than 20 MB" {
    skip_if_sanitized "memory is not that of a release"
    for tool in $(filters); do
        job "$tool"
        mkfifo "$tool.pipe"
        "${job[@]}" < "$tool.pipe" > got 3>&- &
        pid=$!
        exec {hold}> "$tool.pipe"
        yes "$(cat "$in")" | head -200000 >&"$hold"
        for ((k = 0; k < 200; k++)); do [[ $(wc -l < got) -eq 200000 ]] && break || sleep 0.05; done
        peak=$(peak_kib $pid)
        exec {hold}>&-
        wait $pid
        assert_equal "$(sort -u got)" "$(cat "$out")"
        [[ $peak -le 20480 ]] || fail "$tool held $peak KiB, more than 20 MB"
    done
}

@test "house: --follow waits for more, reads on in a new file, and joins no halves" {
    for tool in $(filters); do
        job "$tool"
        cat "$in" > log
        "${job[@]}" --follow log > got 2> said 3>&- &
        pid=$!
        expect() { # LINES
            for ((k = 0; k < 200; k++)); do [[ $(wc -l < got) -eq $1 ]] && return || sleep 0.05; done
            fail "$tool: $(wc -l < got) lines instead of $1"
        }
        expect 1
        printf %s "$(cat "$in")" >> log # the line is not complete
        sleep 0.3
        expect 1
        echo >> log
        expect 2
        # replaced: the old file's last line has no end and is a record all the same
        printf %s "$(cat "$in")" >> log
        cat "$in" > new
        mv new log
        expect 4
        echo "$bad" >> log
        cat "$in" >> log
        expect 5
        # cut, as logrotate's copytruncate does
        : > log
        sleep 0.3
        cat "$in" >> log
        expect 6
        kill -0 $pid
        kill -TERM $pid
        wait $pid && status=0 || status=$?
        assert_equal "$status" 143
        assert_equal "$(sort -u got)" "$(cat "$out")"
        assert_equal "$(cat said)" "$tool: log:2: $fault" # the second line of the new file
    done
}

@test "house: progress is on a terminal, after two seconds, and never in records" {
    # The readers sleep, all at a time, so that the work takes two seconds on any machine.
    for tool in $(filters); do
        job "$tool"
        yes "$(cat "$in")" | head -20000 > "$tool.many"
        mkdir "$tool" "$tool.no"
        (cd "$tool" && on_terminal "cd .. && ${job[*]} $tool.many | (sleep 2.3; cat) > $tool.got" > said) &
        (cd "$tool.no" && on_terminal "cd .. && ${job[*]} --no-progress $tool.many | (sleep 2.3; cat) > $tool.no.got" > said) &
        ("${job[@]}" --progress "$tool.many" 2> "$tool.file" | (sleep 2.3 && cat) > "$tool.file.got") &
    done
    wait
    for tool in $(filters); do
        job "$tool"
        assert_regex "$(cat "$tool/said")" "$tool.many: [0-9]+ %"
        assert_equal "$(cat "$tool.no/said" "$tool.file")" ''
        for got in "$tool".{,no.,file.}got; do assert_equal "$(sort -u "$got")" "$(cat "$out")"; done
    done
}

@test "house: text from a terminal is read after a line that says so; binary is refused" {
    for tool in $(filters); do
        job "$tool"
        run -0 on_terminal "${job[*]}"
        assert_output "$tool: reading from the terminal (end with Ctrl-D)"
        run -64 on_terminal "${job[*]} -F delimited"
        assert_output "$tool: binary input is not read from a terminal"
        run -64 on_terminal "${job[*]} -f delimited $in"
        assert_output "$tool: format delimited is binary and not written to a terminal"
    done
    run -64 on_terminal "dccl-encode -s nav.proto -f raw message"
    assert_output "dccl-encode: format raw is binary and not written to a terminal"
    run -64 on_terminal "dccl-decode -s nav.proto -F raw"
    assert_output "dccl-decode: binary input is not read from a terminal"
}

@test "house: a configuration file, its layers, and the command line over them" {
    for tool in $(filters); do
        job "$tool"
        schema='schema = nav.proto'
        printf '%s\n' '# the fleet' "$schema" 'time = @1714564800' 'max-record = 4 # too short' > fleet.conf
        echo 'max-record = 4096' > mission.conf
        run -1 "$tool" -c fleet.conf "$in"
        run_quiet "$tool" -c mission.conf -c fleet.conf "$in"
        assert_output "$(cat "$out")"
        run -1 "$tool" -c fleet.conf -c mission.conf "$in"
        run_quiet "$tool" -c fleet.conf --max-record 4096 "$in"
        assert_output "$(cat "$out")"
        printf '%s\n' "$schema" 'time = @1714564800' 'strict = true' > strict.conf
        run -65 "$tool" -c strict.conf <<< "$bad"
    done
}

@test "house: what is wrong in a configuration file is located, and is status 78" {
    for tool in $(tools); do
        job "$tool"
        while IFS='|' read -r line said; do
            printf '%s\n' '# a comment' 'schema = nav.proto' "$line" > one.conf
            : > none.conf
            run -78 --separate-stderr bash -c "$tool -c none.conf -c one.conf < /dev/null"
            assert_output ''
            assert_equal "$stderr" "$tool: one.conf:3: $said"
        done << 'END'
shcema = nav.proto|unknown key 'shcema' (did you mean 'schema'?)
nonsense = 1|unknown key 'nonsense'
quiet|a line that is neither 'key = value' nor '[section]'
color = red|option --color: 'red' is none of auto, always, never
time = noon|option --time: time 'noon' is not of the form 2024-05-01T12:00:25Z
time =|option --time: the value is empty
quiet = perhaps|option --quiet: 'perhaps' is neither true nor false
config = other.conf|unknown key 'config'
END
        printf '%s\n' 'color = red' > one.conf
        run_quiet bash -c "${job[*]} -c one.conf --color never < ${in:-/dev/null}"
        assert_output "$(work)"
        run -66 --separate-stderr "$tool" -c gone.conf
        assert_equal "$stderr" "$tool: gone.conf: No such file or directory"
        head -c 2M /dev/zero | tr '\0' '#' > long.conf
        run -78 --separate-stderr "$tool" -c long.conf
        assert_equal "$stderr" "$tool: long.conf: longer than 1 MiB"
    done
}

@test "house: --print-config has every option but those that no file may set, and is such a file" {
    for tool in $(tools); do
        job "$tool"
        run_quiet "$tool" --print-config
        sed -n 's/^#\([a-z-]*\) = .*/--\1/p' <<< "$output" | sort > keys
        "$tool" --help | sed -n 's/^ *\(-., \)\{0,1\}\(--[a-z-]*\).*/\2/p' |
            grep -vxE -- '--(help|version|config|print-config)' | sort > options
        run -0 diff keys options
        assert [ -s keys ]
        "$tool" --print-config > whole.conf
        run_quiet work -c whole.conf
        assert_output "$(work)"
        # Without the comment sign each key is taken: flags as they stand, others with a value.
        sed -n 's/^#\([a-z-]* = true\)$/\1/p' whole.conf > flags.conf
        assert [ -s flags.conf ]
        sed -i 's/^#schema = .*/schema = nav.proto/' whole.conf
        run_quiet bash -c "$tool ${job[*]:3} -c whole.conf < ${in:-/dev/null}"
        assert_output "$(work)"
    done
}
