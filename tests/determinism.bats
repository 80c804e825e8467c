#!/usr/bin/env bats
# The same input and options give the same bytes: twice, elsewhere, and however the input comes.

setup() {
    load test_helper
    cd "$BATS_TEST_TMPDIR" || return
    cp -r "$BATS_TEST_DIRNAME/data/schemas"/. "$SEAUTILS_ROOT/examples" "$SEAUTILS_ROOT/schemas" .
    cp "$SEAUTILS_ROOT"/man/examples/{queues.conf,link.ndjson,modem.log,track.csv,cast.csv,losses.csv,dive.ndjson,mirror.json,requests.ndjson} .
    poscode encode --datum 60,5 track.csv > track.hex
    printf %s 'correct horse' > passphrase
    awk 'BEGIN { print "depth_m,received,tl_db"; for (k = 0; k < 500; ++k) print k * 7 % 101, k * k % 3 == 0, 60 + k % 47 }' | tr ' ' , > link.csv
    # messages of all kinds, some of them bad
    awk 'BEGIN {
        for (k = 0; k < 3000; ++k) {
            printf "{\"@type\":\"Nav\",\"time_s\":%d,\"depth_m\":%.2f,\"leg\":%d}\n", 1714521600 + k, k * 2.03, k % 64
            printf "{\"@type\":\"fleet.Note\",\"text\":\"n%d\",\"fix\":{\"x_m\":%.3f},\"step\":[%d,%d]}\n", k, k / 33, k % 6, -k % 7
            printf "{\"@type\":\"fleet.Ping\",\"seq\":%d}\n", k % 300
        }
    }' > in.ndjson
    # a glider's yo-yo, by its conductivity
    awk 'BEGIN {
        print "time,pressure_dbar,temperature_c,conductivity_spm,lat"
        for (k = 0; k < 3000; ++k) {
            p = k % 600 < 300 ? k % 300 : 300 - k % 300
            printf "%d.5,%.2f,%.3f,%.4f,%.3f\n", 1714521600 + 7 * k, p * 0.9, 17 - p / 30, 4.4 - p / 400, 43 + k / 1e5
        }
    }' > yoyo.csv
    printf '%s\n' 'every = 600' 'bin = 2' 'extend = 1500' > ssp.conf
    types=(-s nav.proto -s fleet)
    dccl-encode "${types[@]}" in.ndjson > in.hex 2> /dev/null || [[ $? -eq 1 ]]
    dccl-encode "${types[@]}" -f raw in.ndjson > in.raw 2> /dev/null || [[ $? -eq 1 ]]
    assert [ "$(wc -l < in.hex)" -ge 8000 ]
}

# Jobs of every tool, a line each; a file of tools/ without one is a failure.
jobs_of_all() {
    cat << 'END'
dccl-encode -s nav.proto -s fleet in.ndjson
dccl-encode -s nav.proto -s fleet --lenient --passphrase-file passphrase -f delimited in.ndjson
dccl-encode -s nav.proto -s fleet --id-codec ccl -f base64 in.ndjson
dccl-encode -s schemas -m Status --time @1714564800 -v in.ndjson
dccl-decode -s nav.proto -s fleet --time @1714564800 in.hex
dccl-decode -s nav.proto -s fleet --time @1714564800 -F raw --resync -f text in.raw
dccl-decode -s nav.proto -s fleet --time @1714564800 -F raw --resync in.hex
dccl-decode -s nav.proto -m Nav --time @1714564800 -f csv in.hex
dccl-decode -s examples/legacy/dive.xml --time 2011-07-25T12:00:00Z examples/legacy/log.hex
depth-plan acomms --loss losses.csv --exclude 20,40 --min-altitude 5 dive.ndjson
depth-plan snr --loss losses.csv --critical-depth 50 -f csv dive.ndjson
depth-plan link-stats --bandwidth 10 link.csv
mm-serial --replay --raw modem.log
dccl-info -s schemas
dccl-info -s schemas -s fleet --format ndjson
mm-sim --dir run --warp 1000 --duration 30 --raw examples/two-nodes/two-nodes.conf
poscode encode track.csv
poscode encode --codec kalman -f message --deltas-per-packet 7 track.csv
poscode stat --format csv --deltas-per-packet 3 track.csv
poscode decode --format csv --datum 60,5 track.hex
ssp -c ssp.conf --climatology cast.csv -v yoyo.csv
ssp --split leg --formula del-grosso -f csv yoyo.csv
queue-sched -c queues.conf --clock input --explain --stats link.ndjson
tdma-slot --slot src=1,length=15 --slot src=2,length=20,kind=ping,dest=1 --id 2 --from 2024-05-01T23:00:00Z --to 2024-05-02T01:00:00Z
tl-model --engine rays --threads 3 --sum coherent -f csv mirror.json
tl-model --engine rays --arrivals mirror.json
tl-model --engine rays --jobs 3 -v requests.ndjson
tdma-slot --subsets 3 --runs 5 --p-collide 0.7 --limit 1000 --seed 9
END
}

# run_all NAME COMMAND...: runs each job by COMMAND; output, messages and status go into NAME.N.
run_all() {
    local name=$1 k=0 line status
    shift
    while read -r line; do
        k=$((k + 1))
        status=0
        # shellcheck disable=SC2086  # words of a command line
        "$@" $line > "$name.$k" 2> "$name.$k.said" < /dev/null || status=$?
        echo "$status" >> "$name.$k.said"
    done < <(jobs_of_all | grep -v "^${without:-$}")
}

# assert_same NAME NAME
assert_same() {
    local k=0 line
    while read -r line; do
        k=$((k + 1))
        cmp "$1.$k" "$2.$k" || fail "differs: $line"
        diff "$1.$k.said" "$2.$k.said" || fail "says something else: $line"
    done < <(jobs_of_all | grep -v "^${without:-$}")
    assert [ "$k" -ge 8 ]
}

@test "determinism: every tool has a job, and each does something" {
    for tool in "$BATS_TEST_DIRNAME"/../tools/*.cpp; do
        jobs_of_all | grep -q "^$(basename "$tool" .cpp) " || fail "no job for $tool"
    done
    run_all one command
    for file in one.?; do
        [[ -s $file || $(wc -l < "$file.said") -gt 1 ]] || fail "$file: neither output nor message"
    done
    run cat one.*.said
    refute_line 64
    refute_line 66
    refute_line 70
    refute_line 78
}

@test "determinism: twice the same" {
    run_all one command
    run_all two command
    assert_same one two
}

@test "determinism: neither locale, time zone, host nor home has a say" {
    run_all one command
    for where in LC_ALL=de_DE.UTF-8 'LC_ALL=tr_TR.UTF-8 LANG=tr_TR.UTF-8 LC_NUMERIC=de_DE.UTF-8' \
        TZ=Pacific/Kiritimati 'HOSTNAME=other HOME=/nowhere USER=nobody' \
        'COLUMNS=20 TERM=xterm LINES=5' 'MALLOC_PERTURB_=165'; do
        # shellcheck disable=SC2086  # one word or several
        run_all other env $where
        assert_same one other
    done
    run_all bare env -i "PATH=$PATH" "LD_LIBRARY_PATH=${LD_LIBRARY_PATH:-}"
    assert_same one bare
}

@test "determinism: the clock has no say where --time stands in for it" {
    command -v faketime > /dev/null || skip "faketime is not installed"
    skip_if_sanitized "faketime is loaded before their library"
    without='mm-sim ' # it does take time, of a clock that this fakes by halves
    run_all one command
    run_all later faketime '2031-02-03 04:05:06'
    assert_same one later
}

@test "determinism: however the input comes, in pieces or whole, from a file or a pipe" {
    dccl-encode "${types[@]}" in.ndjson > whole 2> /dev/null || [[ $? -eq 1 ]]
    dccl-encode "${types[@]}" < in.ndjson > got 2> /dev/null || [[ $? -eq 1 ]]
    cmp whole got
    dccl-encode "${types[@]}" < <(cat in.ndjson) > got 2> /dev/null || [[ $? -eq 1 ]]
    cmp whole got
    for piece in 1000 65536 65537; do
        dccl-encode "${types[@]}" < <(dd if=in.ndjson bs=$piece iflag=fullblock 2> /dev/null) > got 2> /dev/null || [[ $? -eq 1 ]]
        cmp whole got
    done
    # byte by byte, which cuts each message anywhere
    head -c 4000 in.ndjson > little.ndjson
    head -c 2000 in.raw > little.raw
    dccl-encode "${types[@]}" little.ndjson > whole 2> /dev/null || [[ $? -eq 1 ]]
    dccl-encode "${types[@]}" < <(dd if=little.ndjson bs=1 2> /dev/null) > got 2> /dev/null || [[ $? -eq 1 ]]
    cmp whole got
    dccl-decode "${types[@]}" --time @0 -F raw --resync little.raw > whole 2> said || [[ $? -eq 1 ]]
    dccl-decode "${types[@]}" --time @0 -F raw --resync < <(dd if=little.raw bs=1 2> /dev/null) > got 2> piped || [[ $? -eq 1 ]]
    cmp whole got
    diff <(sed 's/little.raw/<stdin>/' said) piped
    # what one run makes of many records, many runs make of one each
    head -40 in.ndjson | while read -r line; do
        dccl-encode "${types[@]}" <<< "$line" 2> /dev/null || [[ $? -eq 1 ]]
    done > got
    head -40 in.ndjson | dccl-encode "${types[@]}" > whole 2> /dev/null || [[ $? -eq 1 ]]
    cmp whole got
}
