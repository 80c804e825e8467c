#!/usr/bin/env bats
# The manual says what the tools do. (Its examples are run by scripts/check-man-examples.)

setup() {
    load test_helper
    bats_require_minimum_version 1.5.0
    source=$BATS_TEST_DIRNAME/..
    pages=$SEAUTILS_BUILD/man # with the shared fragments put in
    cd "$BATS_TEST_TMPDIR" || return
}

tools() {
    for tool in "$source"/tools/*.cpp; do basename "$tool" .cpp; done
}

# help_of TOOL: its --help, and that of each of its commands.
help_of() {
    local command
    "$1" --help
    for command in $("$1" --help | sed -n '/^Commands/,/^$/s/^  \([a-z-]*\) .*/\1/p'); do "$1" "$command" --help; done
}

@test "man: each page names the options that --help names, and no others" {
    for tool in $(tools); do
        run_quiet help_of "$tool"
        grep -E '^ +(-., )?--' <<< "$output" | sed 's/^ \{2,6\}//; s/   .*//' |
            grep -oE -- '(^|[ ,])--?[a-zA-Z-]+' | tr -d ' ,' | sort -u > said
        grep -E '^\*-' "$pages/$tool.1.scd" | grep -oE -- '\*--?[a-zA-Z-]+' | tr -d '*' | sort > documented
        assert [ -s said ]
        diff said documented || fail "$tool: < only in --help, > only in its page (or there twice)"
    done
}

@test "man: each tool's page has the sections of the house, in their order" {
    for tool in $(tools); do
        house='NAME SYNOPSIS DESCRIPTION OPTIONS INPUT OUTPUT EXIT STATUS ENVIRONMENT ACCURACY SECURITY EXAMPLES SEE ALSO'
        run_quiet sed -n 's/^# //p' "$pages/$tool.1.scd"
        for section in NAME SYNOPSIS DESCRIPTION OPTIONS 'EXIT STATUS' EXAMPLES 'SEE ALSO'; do
            assert_line "$section"
        done
        for section in "${lines[@]}"; do
            [[ " $house " == *" $section "* ]] || fail "$tool: $section is out of order, or none of the house"
            house=${house#*"$section"}
        done
    done
}

@test "man: each page is given its fragments and its version" {
    for page in "$source"/man/*.scd; do
        page=$pages/${page##*/}
        run grep -nE '@[A-Z_]+@' "$page"
        refute_output
        run_quiet head -1 "$page"
        assert_output --regexp '^[a-z-]+\([157]\) "seautils [0-9]+\.[0-9]+\.[0-9]+" "Marine robot filters"$'
    done
}

@test "man: each page that a page refers to exists, ours or a well-known one" {
    for reference in $(grep -ohE '\*[a-z-]+\*\([157]\)' "$source"/man/*.scd "$source"/man/fragments/*.scd | tr -d '*' | sort -u); do
        case $reference in
            'jq(1)' | 'protoc(1)') continue ;;
        esac
        section=${reference#*\(}
        assert_file_exists "$source/man/${reference%\(*}.${section%)}.scd"
    done
}

@test "man: the pages are clean" {
    command -v mandoc > /dev/null || skip "mandoc is not installed"
    command -v scdoc > /dev/null || skip "scdoc is not installed"
    for page in "$source"/man/*.scd; do
        page=${page##*/}
        assert_file_exists "$pages/${page%.scd}"
        # scdoc writes .PP where none is needed; there is no way to tell it not to.
        run bash -c "mandoc -T lint -W warning '$pages/${page%.scd}' | grep -v 'skipping paragraph macro'"
        refute_output
    done
}

@test "check-man-examples: a difference is located and makes the status 1" {
    printf '%s\n' 'x(1)' '' '# EXAMPLES' '' '```' '$ echo one' one '$ echo two' three '```' > wrong.scd
    run -1 "$source/scripts/check-man-examples" "$SEAUTILS_BUILD" wrong.scd
    assert_line --index 0 'wrong.scd:8: $ echo two'
    assert_line -- '-three'
    assert_line '+two'
    assert_line 'check-man-examples: 2 commands of 1 pages, 1 differ'
}

@test "check-man-examples: what a command must not print, or lacks, differs" {
    printf '%s\n' '```' '$ printf "%s\\n" a b' a '```' > more.scd
    run -1 "$source/scripts/check-man-examples" "$SEAUTILS_BUILD" more.scd
    printf '%s\n' '```' '$ printf a' a '```' > end.scd # no line end
    run -1 "$source/scripts/check-man-examples" "$SEAUTILS_BUILD" end.scd
    printf '%s\n' '```' '$ echo bad >&2' '```' > error.scd
    run -1 "$source/scripts/check-man-examples" "$SEAUTILS_BUILD" error.scd
    assert_line '+bad'
}

@test "check-man-examples: a page without examples, and a fence without end, are faults" {
    printf '%s\n' 'x(1)' > none.scd
    run -1 "$source/scripts/check-man-examples" "$SEAUTILS_BUILD" none.scd
    printf '%s\n' '```' '$ echo one' one > open.scd
    run -1 "$source/scripts/check-man-examples" "$SEAUTILS_BUILD" open.scd
    assert_line 'open.scd:1: the fence is never closed'
}

@test "check-man-examples: lines that begin with > continue a command" {
    printf '%s\n' '```' '$ for x in 1 2; do' '> echo $x' '> done' 1 2 '```' > long.scd
    run -0 "$source/scripts/check-man-examples" "$SEAUTILS_BUILD" long.scd
}
