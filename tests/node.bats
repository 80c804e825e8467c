#!/usr/bin/env bats
# Nodes made of the tools: two in a shell, one under systemd.

setup() {
    load test_helper
    units=$SEAUTILS_ROOT/examples/systemd
    two=$SEAUTILS_ROOT/examples/two-nodes
    cd "$BATS_TEST_TMPDIR"
    declare -gA started=()
}

teardown() {
    ((${#started[@]} == 0)) || kill "${started[@]}" 2> /dev/null || true
    wait 2> /dev/null || true
}

@test "two nodes: a message arrives at both ends, and nothing stays behind" {
    run -0 timeout 60 "$two/run" -k kept 3>&-
    assert_line --regexp '^\{"@received":"2024-05-01T12:[0-9:.]+Z","@from":2,"@type":"seautils.Status","time_s":1714564800,"src":2,"dest":1,"x_m":1480.5,"y_m":12,"depth_m":19.8,"state":"TRANSIT","battery_percent":87\}$'
    assert_line --regexp '^\{"@received":"2024-05-01T12:[0-9:.]+Z","@from":1,"@type":"seautils.DeployCommand","time_s":1714564800,"src":1,"dest":2,"command_id":1,"behaviour":"LOITER","x_m":1500,"y_m":0,"depth_m":20\}$'
    assert [ "$(wc -l < kept/ship.received)" -ge 1 ]
    # the ocean's own view of the same
    run -0 jq -c 'select(.acoustic.packet == "data" and .acoustic.outcome == "RECEIVED").acoustic.src' kept/truth.ndjson
    assert_line 1
    assert_line 2
    # the sea's clock and terminals go with mm-sim, the sockets with queue-sched
    run -0 find kept '(' -type s -o -type l -o -name clock ')'
    assert_output ''
    assert_nobody_in kept
}

@test "two nodes: ended by a signal, nothing stays behind" {
    "$two/run" -w 1 -k kept > out 2>&1 3>&- &
    local pid=$!
    for ((k = 0; k < 200; k++)); do
        [[ ! -S kept/vehicle.sock ]] || break
        sleep 0.05
    done
    assert [ -S kept/vehicle.sock ]
    kill -TERM "$pid"
    wait "$pid" || true
    run -0 find kept '(' -type s -o -type l -o -name clock ')'
    assert_output ''
    assert_nobody_in kept
}

@test "two nodes: a wrong command line is 64" {
    run -64 "$two/run" -w 0
    run -64 "$two/run" --nonsense
    run -64 "$two/run" more
}

@test "two nodes: the lines of the README are those that run" {
    sed -n '/^```sh$/,/^```$/p' "$two/README.md" | sed '/^```/d' > shown
    sed 's,"\$here/\([a-z-]*\.conf\)",\1,; s/"\$warp"/10/' "$two/run" > made
    assert [ "$(wc -l < shown)" -ge 15 ]
    # in one piece, after the `set -m`
    run -0 sed -n "/^mm-sim /,/^ *'{.*Status\|^ *'{.*TRANSIT/p" made
    assert_equal "$(grep -v '^$\|^#' <<< "$output")" "$(grep -v '^$\|^#' shown)"
}

# assert_nobody_in FOLDER: no process works there
assert_nobody_in() {
    local folder all
    folder=$(cd "$1" && pwd -P)
    all=$(readlink /proc/[0-9]*/cwd || true)
    run -1 grep -xF -- "$folder" <<< "$all"
}

# units_here: copies of the units that run the tools under test
units_here() {
    cp "$units"/seautils-*.{service,socket,target} .
    sed -i "s,^ExecStart=/usr/bin/,ExecStart=$SEAUTILS_BIN/," -- *.service
}

@test "systemd: the units are sound" {
    command -v systemd-analyze > /dev/null || skip 'systemd-analyze is not installed'
    printf '%s\n' '[Service]' 'ExecStart=/bin/true' > plain.service
    systemd-analyze verify --man=no "$PWD/plain.service" > plain.log 2>&1 ||
        skip "systemd-analyze verify does not run here: $(head -n 1 plain.log)"
    units_here
    run -0 systemd-analyze verify --man=no "$PWD"/seautils-*
    assert_output ''
}

@test "systemd: a unit with a mistake is noticed" {
    command -v systemd-analyze > /dev/null || skip 'systemd-analyze is not installed'
    printf '%s\n' '[Service]' 'ExecStart=/bin/true' > plain.service
    systemd-analyze verify --man=no "$PWD/plain.service" > plain.log 2>&1 ||
        skip "systemd-analyze verify does not run here: $(head -n 1 plain.log)"
    units_here
    sed -i 's/^StandardInput=/StandardImput=/' seautils-mm-serial@.service
    run systemd-analyze verify --man=no "$PWD/seautils-mm-serial@.service"
    assert_output --partial StandardImput
}

@test "systemd: each command line is one that its tool takes" {
    local file
    for file in "$units"/*.service; do
        local command
        command=$(sed -n 's,^ExecStart=/usr/bin/,,p' "$file")
        command=${command//'${SEAUTILS_ID}'/2}
        command=${command//%[iI]/ttyUSB0}
        command=${command//%t/$PWD}
        command=${command//%S/$PWD}
        command=${command//'/etc/seautils'/$units/etc}
        command=${command//'/usr/share/seautils'/$SEAUTILS_ROOT}
        # shellcheck disable=SC2086  # one word an argument
        run -0 $command --print-config
        # the same with an option that does not exist
        # shellcheck disable=SC2086
        run -64 $command --nonsense --print-config
    done
}

@test "systemd: the example's slots and queues are read" {
    run -0 tdma-slot -c "$units/etc/slots.conf" --from 2024-05-01T12:00:00Z --to 2024-05-01T12:00:45Z
    assert_equal "${#lines[@]}" 3
    # the node's own messages, by its own queues
    run -0 queue-sched --id 2 -c "$units/etc/queues.conf" --clock input --stats /dev/null
    run -78 queue-sched --id 2 -c <(sed 's/^ttl_s = 300$/ttl_s = never/' "$units/etc/queues.conf") /dev/null
}

@test "systemd: every FIFO and configuration file that a service names is there" {
    local name
    for name in $(sed -n 's,.*[[:space:]=]%t/seautils/%i/\([a-z]*\.fifo\).*,\1,p' "$units"/*.service); do
        grep -qF "ListenFIFO=%t/seautils/%i/$name" "$units"/*.socket
    done
    for name in $(sed -n 's/^Standard[A-Za-z]*=fd:\(.*\)$/\1/p' "$units"/*.service); do
        grep -qsx "FileDescriptorName=$name" "$units/seautils-$name"{,@}.socket
    done
    for name in $(grep -o '/etc/seautils/[a-z]*\.conf' "$units"/*.service | sed 's,.*/,,'); do
        assert [ -r "$units/etc/$name" ]
    done
    assert [ -r "$units/etc/ttyUSB0.env" ]
}

@test "systemd: from samples of a CTD to the depth at which to be heard" {
    mkfifo samples.fifo states.fifo
    sed "s,/etc/seautils,$units/etc," "$units/etc/depth.conf" > depth.conf
    # as the units run them, but sooner
    ssp -c "$units/etc/ssp.conf" --silence 1 <> samples.fifo 1<> states.fifo 2> ssp.log 3>&- &
    started[ssp]=$!
    depth-plan acomms -c depth.conf --every 0 <> states.fifo > decisions 2> depth-plan.log 3>&- &
    started[depth-plan]=$!
    local depth
    for depth in 1 10 20 30 50 80 100; do
        jq -nc --argjson z "$depth" '{time: (now - 20 + $z / 5 | todate), depth_m: $z, temperature_c: (20 - $z / 10), salinity: 35}'
    done > samples.fifo
    state() { jq -nc '{time: (now | todate), x_m: 0, y_m: 0, depth_m: 40, speed_mps: 1.5, heading_deg: 0, water_depth_m: 110, contact: {x_m: 0, y_m: -1000, depth_m: 30}}' > states.fifo; }
    heard() {
        state
        jq -es 'any(.[]; .rule == "BEST" and .depth_m >= 5 and .depth_m <= 100 and .window_from_m == 1000)' decisions > /dev/null
    }
    soon heard
    kill "${started[@]}"
    wait "${started[@]}" || true
    started=()
    assert_equal "$(cat ssp.log depth-plan.log)" ''
}

@test "systemd: the state that the README sends is answered by the best depth, held back by no limit" {
    sed "s,/etc/seautils,$units/etc," "$units/etc/depth.conf" > depth.conf
    sed -n '/^printf /,/> .*states\.fifo$/p' "$units/README.md" | sed "s,/run/seautils/depth/states.fifo,state," > send
    assert [ -s send ]
    bash send
    run -0 depth-plan acomms -c depth.conf state
    assert_equal "$(jq -c '[.rule, has("bound_by"), .window_from_m]' <<< "$output")" '["BEST",false,1000]'
}

# stage NODE STAGE: starts it as the units do, on FIFOs that somebody holds open
stage() {
    local id=1
    [[ $1 != vehicle ]] || id=2
    case $2 in
        tdma-slot) exec tdma-slot -q --id "$id" -c "$two/slots.conf" 1<> "$1-slots.fifo" ;;
        queue-sched)
            exec queue-sched --id "$id" --spool "$1.db" --listen "$1.sock" --feedback "$1-queue.fifo" \
                <> "$1-slots.fifo" 1<> "$1-transmissions.fifo"
            ;;
        mm-serial)
            exec mm-serial -q --id "$id" --feedback "$1-queue.fifo" "sea/$1" \
                <> "$1-transmissions.fifo" 1<> "$1-receptions.fifo"
            ;;
        dccl-decode)
            exec dccl-decode -s "$SEAUTILS_ROOT/schemas/seautils" --records --duplicates 3600 \
                <> "$1-receptions.fifo" >> "$1.received"
            ;;
    esac 2>> "$1.log" 3>&- &
    started[$1-$2]=$!
}

# soon COMMAND...: it succeeds within 20 seconds
soon() {
    local k
    for ((k = 0; k < 400; k++)); do
        ! "$@" || return 0
        sleep 0.05
    done
    cat ./*.log
    return 1
}

@test "systemd: a stage that is killed takes nobody down, and what was accepted arrives" {
    local node one sent=0
    declare -A held
    mm-sim --dir sea --warp 20 "$two/two-nodes.conf" > truth.ndjson 3>&- &
    started[sea]=$!
    soon test -e sea/vehicle
    SEAUTILS_CLOCK=$(< sea/clock)
    export SEAUTILS_CLOCK
    for node in ship vehicle; do
        for one in slots transmissions receptions; do
            mkfifo "$node-$one.fifo"
            exec {held[$node-$one]}<> "$node-$one.fifo"
        done
        for one in tdma-slot queue-sched mm-serial dccl-decode; do stage "$node" "$one"; done
    done
    soon test -S ship.sock
    for one in '' tdma-slot queue-sched mm-serial dccl-decode; do
        sent=$((sent + 1))
        dccl-encode -s "$SEAUTILS_ROOT/schemas/seautils" -m seautils.DeployCommand --src 1 --dest 2 --ack --send ship.sock \
            <<< '{"time_s":1714564800,"src":1,"dest":2,"command_id":'$sent'}'
        if [[ $one ]]; then
            for node in ship vehicle; do
                kill -KILL "${started[$node-$one]}"
                wait "${started[$node-$one]}" 2> /dev/null || true
                stage "$node" "$one"
            done
            soon test -S ship.sock
        fi
        soon grep -qs "\"command_id\":$sent}" vehicle.received
        for node in "${!started[@]}"; do
            kill -0 "${started[$node]}" || { echo "$node is gone" && false; }
        done
    done
}
