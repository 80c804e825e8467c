#!/usr/bin/env bats
# Nodes made of the tools: two in a shell, one under systemd.

setup() {
    load test_helper
    units=$SEAUTILS_ROOT/examples/systemd
    two=$SEAUTILS_ROOT/examples/two-nodes
    cd "$BATS_TEST_TMPDIR"
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
    cp "$units"/seautils-*@.* .
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
        grep -qx "FileDescriptorName=$name" "$units/seautils-$name@.socket"
    done
    for name in $(grep -o '/etc/seautils/[a-z]*\.conf' "$units"/*.service | sed 's,.*/,,'); do
        assert [ -r "$units/etc/$name" ]
    done
    assert [ -r "$units/etc/ttyUSB0.env" ]
}
