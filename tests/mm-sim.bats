#!/usr/bin/env bats
# mm-sim: modems on terminals that any program may open, and what became of their packets.

setup() {
    load test_helper
    cd "$BATS_TEST_TMPDIR" || return
    cat > sea.conf << 'END'
[water]
epoch = 2024-05-01T20:45:00Z
[nodes]
nvram = CST:1, RXP:1
[node ship]
id = 1
x_m = 0
y_m = 0
[node auv]
id = 2
x_m = 375.15
y_m = 0
END
}

teardown() {
    [[ -z ${sim:-} ]] || kill "$sim" 2> /dev/null || true
    [[ -z ${sim:-} ]] || wait "$sim" 2> /dev/null || true
    # shellcheck disable=SC2086  # one or several
    [[ -z ${listeners:-} ]] || kill $listeners 2> /dev/null || true
}

# sail OPTION...: starts mm-sim, and waits until its modems have terminals and, where time runs fast,
# have booted.
sail() {
    mm-sim --dir run "$@" sea.conf > truth 2> said 3>&- &
    sim=$!
    until_true test -e run/auv
    sleep 0.2
}

# listen NODE: keeps what a modem says in NODE.out.
listen() {
    cat "run/$1" > "$1.out" 2> /dev/null 3>&- &
    listeners+=" $!"
    sleep 0.1 # until it has opened it
}

# host NODE LINE...: says lines to a modem.
host() {
    local node=$1
    shift
    printf '%s\r\n' "$@" > "run/$node"
}

# until_true COMMAND...: repeats it, for ten seconds at most.
until_true() {
    local k
    for ((k = 0; k < 200; k++)); do
        ! "$@" > /dev/null 2>&1 || return 0
        sleep 0.05
    done
    fail "never: $*"
}

# hears NODE TEXT: waits until a modem has said a line that begins so.
hears() {
    until_true grep -qF -- "$2" "$1.out"
}

@test "mm-sim: a ping is answered, with its true travel time; both modems and the water tell" {
    sail --warp 20
    listen ship
    listen auv
    host ship '$CCMPC,1,2*5D'
    hears ship '$CAMPR,2,1,0.2501*7A'
    hears auv '$CAMPA,1,2*5D'
    until_true jq -e 'select(.acoustic.packet == "reply")' truth
    run_quiet jq -c '.acoustic | [.src, .receiver, .packet, .outcome, .range_m, .air_time_s]' truth
    assert_output '[1,2,"ping","RECEIVED",375.15,0.9]
[2,1,"reply","RECEIVED",375.15,0.9]'
    assert_equal "$(cat said)" ''
}

@test "mm-sim: data go from one host to another and are acknowledged" {
    sail --warp 20
    listen ship
    listen auv
    host ship '$CCCYC,0,1,2,0,1,1*5A'
    hears ship '$CADRQ,'
    host ship '$CCTXD,1,2,1,48656c6c6f'
    hears auv '$CARXD,1,2,1,1,48656c6c6f*'
    hears ship '$CAACK,2,1,1,1*48'
    until_true jq -e 'select(.acoustic.packet == "ack")' truth
    run_quiet jq -r '.acoustic | .packet + " " + .outcome' truth
    assert_output 'cycle RECEIVED
data RECEIVED
ack RECEIVED'
}

@test "mm-sim: programs may close a terminal and open it again; nothing old is in it" {
    sail --warp 20
    for k in 1 2 3; do
        run timeout 5 bash -c 'exec 5<> run/ship; printf "\$CCCFQ,SRC\r" >&5; IFS= read -r line <&5; echo "${line%$'"'\r'"'}"'
        assert_output '$CACFG,SRC,1*33'
        host ship '$CCCFQ,SRC' # the answer comes when nobody has it open
        sleep 0.1
    done
}

@test "mm-sim: the terminal is raw: every byte as it is" {
    sail
    run_quiet stty -F run/ship -a
    for setting in -echo -icanon -icrnl -opost -isig -ixon; do assert_output --partial " ${setting}" || assert_output --partial "${setting} "; done
}

@test "mm-sim: --raw records each line with its modem, in the order of time" {
    sail --warp 20 --raw
    listen ship
    host ship '$CCCFQ,SRC*3A' '$CCCFQ,SRC*00'
    hears ship '$CAERR,'
    run_quiet jq -rs 'map(.raw | select(.node == "ship" and (.line | startswith("$CAREV") | not)) |
        .direction + " " + (.line | sub("[0-9]{6}"; "hhmmss")))[]' truth
    assert_line 'OUT $CCCFQ,SRC*3A'
    assert_line 'IN $CACFG,SRC,1*33'
    assert_line 'OUT $CCCFQ,SRC*00'
    assert_line --partial 'IN $CAERR,hhmmss,NMEA,1,bad checksum*'
    run_quiet jq -s '[.[].time] | . == sort' truth
    assert_output true
}

@test "mm-sim: --duration ends it, after so much simulated time; links and clock are gone" {
    start=$(date +%s%N)
    run_quiet mm-sim --dir run --warp 100 --duration 50 --raw sea.conf
    elapsed_ms=$((($(date +%s%N) - start) / 1000000))
    assert [ "$elapsed_ms" -ge 450 ]
    [[ -n ${SEAUTILS_SANITIZE:-} ]] || assert [ "$elapsed_ms" -le 5000 ]
    assert_line --index 0 --regexp '^\{"time":"2024-05-01T20:45:01\.[0-9]+Z","raw":\{"direction":"IN","line":"\$CAREV,204501,INIT,2\.0\.27087\*[0-9A-F]{2}","node":"ship"\}\}$'
    assert_equal "$(ls run)" ''
}

@test "mm-sim: where no host says anything the same scenario gives the same records, however fast" {
    printf 'reboot_s = 5, 9.5\n' >> sea.conf
    run_quiet mm-sim --dir run --warp 100 --duration 20 --raw sea.conf
    once=$output
    run_quiet mm-sim --dir run --warp 400 --duration 20 --raw sea.conf
    assert_output "$once"
    assert_equal "$(grep -c INIT <<< "$once")" 4
}

@test "mm-sim: run/clock is the clock of all; a clock that is given is taken" {
    sail --warp 20
    run_quiet cat run/clock
    assert_output --regexp '^warp:20,[0-9]+\.[0-9]{9},2024-05-01T20:45:00Z$'
    kill "$sim" && wait "$sim" || true
    sim=''
    word="warp:1000,$(cut -d' ' -f1 /proc/uptime),2030-01-01T00:00:00Z"
    run_quiet mm-sim --dir run --clock "$word" --duration 10 --raw sea.conf
    assert_line --index 0 --regexp '^\{"time":"2030-01-01T00:'
    SEAUTILS_CLOCK=$word run_quiet mm-sim --dir run --duration 10 --raw sea.conf
    assert_line --index 0 --regexp '^\{"time":"2030-01-01T00:'
    run -64 --separate-stderr mm-sim --dir run --clock "$word" --warp 2 sea.conf
    assert_equal "$stderr" 'mm-sim: option --warp: the clock is given already'
    run -64 --separate-stderr mm-sim --dir run --clock input sea.conf
    assert_equal "$stderr" "mm-sim: option --clock: 'input' makes no time pass"
}

@test "mm-sim: SIGTERM ends it: what it knows is written, links are gone, and it dies of the signal" {
    sail --warp 20 --raw
    listen ship
    host ship '$CCCFQ,SRC'
    hears ship '$CACFG'
    kill -TERM "$sim"
    status=0
    wait "$sim" || status=$?
    assert_equal "$status" 143
    sim=''
    assert [ ! -e run/ship ]
    assert [ ! -L run/ship ]
    assert [ ! -e run/clock ]
    run_quiet jq -r 'select(.raw.line == "$CACFG,SRC,1*33") | .raw.node' truth
    assert_output ship
}

@test "mm-sim: an old link is replaced; any other file is left alone" {
    mkdir run
    ln -s /dev/pts/999 run/ship
    run_quiet mm-sim --dir run --warp 1000 --duration 1 sea.conf
    echo mine > run/auv
    run -73 --separate-stderr mm-sim --dir run --warp 1000 --duration 1 sea.conf
    assert_equal "$stderr" 'mm-sim: run/auv: exists and is no link'
    assert_equal "$(cat run/auv)" mine
    assert [ ! -L run/ship ]
    run -73 --separate-stderr mm-sim --dir no/such/folder sea.conf
    assert_equal "$stderr" 'mm-sim: no/such/folder: No such file or directory'
}

@test "mm-sim: a host that does not read loses sentences, and holds nobody up" {
    sail --warp 100
    exec 5<> run/ship
    listen auv
    for ((k = 0; k < 300; k++)); do printf '$CCCFQ,ALL\r\n' >&5; done # some 170 kB, at 192 kB/s
    sleep 2
    host auv '$CCCFQ,SRC'
    hears auv '$CACFG,SRC,2'
    kill -TERM "$sim"
    wait "$sim" || true
    sim=''
    exec 5>&-
    run cat said
    assert_output --regexp '^mm-sim: [0-9]+ sentences lost: a host did not read them in time$'
}

@test "mm-sim: faults of a scenario are located, status 78; one that is not there is 66" {
    sed -i 's/^id = 2/id = 1/' sea.conf
    run -78 --separate-stderr mm-sim --dir run sea.conf
    assert_output ''
    assert_equal "$stderr" "mm-sim: sea.conf:12: nodes 'ship' and 'auv' have the same id 1"
    run -66 --separate-stderr mm-sim --dir run gone.conf
    assert_equal "$stderr" 'mm-sim: gone.conf: No such file or directory'
    mkdir deep && printf '[node a]\nid = 1\ntrack = t.csv\n' > deep/s.conf
    run -66 --separate-stderr mm-sim --dir run deep/s.conf
    assert_equal "$stderr" 'mm-sim: deep/t.csv: No such file or directory'
    printf '[node clock]\nid = 1\nx_m = 0\ny_m = 0\n' > c.conf
    run -78 --separate-stderr mm-sim --dir run c.conf
    assert_equal "$stderr" "mm-sim: c.conf: the name 'clock' is taken"
    run -64 --separate-stderr mm-sim
    assert_equal "$stderr" 'mm-sim: SCENARIO is missing (try --help)'
    for option in --warp=0 --warp=1001 --warp=x --duration=0; do
        run -64 --separate-stderr mm-sim "$option" sea.conf
        assert_regex "$stderr" "^mm-sim: option ${option%=*}: '${option#*=}' is outside 0.001 to [0-9]+( s)?$"
    done
}

@test "mm-sim: a full disk is 74; a reader that goes away ends it" {
    run -74 --separate-stderr bash -c 'mm-sim --dir run --warp 1000 --duration 5 --raw sea.conf > /dev/full'
    assert_equal "$stderr" 'mm-sim: write failed: No space left on device'
    printf 'reboot_s = %s\n' "$(seq -s, 10 10 1000)" >> sea.conf
    run -141 bash -c 'set -o pipefail; timeout 20 mm-sim --dir run --warp 1000 --raw sea.conf | head -1'
}

@test "mm-sim: binary records come back as the same" {
    run_quiet mm-sim --dir run --warp 1000 --duration 2 --raw --format delimited sea.conf
    [[ -n $output ]]
    run -64 --separate-stderr on_terminal 'mm-sim --format delimited sea.conf'
}

@test "mm-sim: the shipped example is sound" {
    cp "$SEAUTILS_ROOT"/examples/two-nodes/two-nodes.conf .
    run_quiet mm-sim --dir run --warp 1000 --duration 2 --raw two-nodes.conf
    assert_line --partial '"node":"vehicle"'
}

@test "mm-sim: both generations satisfy mm-serial, in both directions" {
    command -v mm-serial > /dev/null || skip "mm-serial is not built"
    sed -i 's/^id = 2/id = 2\nmodem = mm1/' sea.conf
    sail --warp 10
    export SEAUTILS_CLOCK
    SEAUTILS_CLOCK=$(cat run/clock)
    for node in ship auv; do
        mkfifo "$node.in"
        exec {hold}<> "$node.in"
        id=1
        [[ $node == ship ]] || id=2
        mm-serial --id $id "run/$node" < "$node.in" > "$node.records" 2> "$node.said" 3>&- &
        listeners+=" $!"
    done
    ready() { grep -q '"READY"' "$1.records"; }
    until_true ready ship
    until_true ready auv
    send() { # FROM TO NUMBER MORE
        echo "{\"time\":\"2024-05-01T20:45:00Z\",\"transmission\":{\"number\":$3,\"src\":$1,\"dest\":$2,$4}}"
    }
    send 1 2 7 '"rate":0,"ack_requested":true,"kind":"DATA","frame":["SGVsbG8="]' > ship.in
    until_true grep -q '"ack":{"src":2,"dest":1,"transmission":7,"frame":\[0\]}' ship.records
    until_true grep -q '"frame":\["SGVsbG8="\]' auv.records
    send 2 1 8 '"rate":2,"ack_requested":true,"kind":"DATA","frame":["AQ==","Ag=="]' > auv.in
    until_true grep -q '"ack":{"src":1,"dest":2,"transmission":8,"frame":\[1\]}' auv.records
    until_true grep -q '"frame":\["AQ==","Ag=="\]' ship.records
    send 1 2 9 '"kind":"PING"' > ship.in
    until_true grep -q '"one_way_travel_time_s":0.2501' ship.records
}
