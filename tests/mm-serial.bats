#!/usr/bin/env bats
# mm-serial: the dialogue with a modem that is played here, over a pair of pseudo-terminals; logs.

setup() {
    load test_helper
    cd "$BATS_TEST_TMPDIR" || return
    pids=()
}

teardown() {
    local pid
    for pid in "${pids[@]}"; do kill "$pid" 2> /dev/null || true; done
    wait 2> /dev/null || true
}

# sentence BODY: with its checksum
sentence() {
    local sum=0 k code
    for ((k = 0; k < ${#1}; k++)); do
        printf -v code %d "'${1:k:1}"
        sum=$((sum ^ code))
    done
    printf '$%s*%02X\r\n' "$1" $sum
}

# line_pair: `host` and `modem` are the two ends of a serial line
line_pair() {
    socat pty,raw,echo=0,link=host pty,raw,echo=0,link=modem 3>&- &
    socat=$!
    pids+=("$socat")
    local k
    for ((k = 0; k < 100; k++)); do
        [[ ! -e modem || ! -e host ]] || return 0
        sleep 0.05
    done
    fail 'no pair of terminals'
}

# play: a modem at `modem` that echoes settings, starts anew, takes its clock, and a cycle at rate 0
play() {
    local line rest
    while IFS= read -r line; do
        line=${line%%\**} rest=${line#?CC???}
        echo "$line" >> said
        case $line in
            '$CCCFG'*) sentence "CACFG$rest" ;;
            '$CCCFQ,SRC') sentence CACFG,SRC,1 ;;
            '$CCMSC'*) sentence CAREV,120000,AUV,0.93.0.30 ;;
            '$CCCLK'*) sentence "CACLK$rest" ;;
            '$CCCYC'*)
                sentence "CACYC$rest" && sentence CATXP,4 && sentence CATXF,4
                sentence CADRQ,120000,1,2,1,32,1
                ;;
            '$CCTXD'*)
                sentence "CATXD$rest" && sentence CATXP,2 && sentence CATXF,2
                sentence CAXST,6,20240501,120003.0000,0,0,200,4000,25000,0,1,2,1,1,1,1,2
                sentence CARXP,1 && sentence CAACK,2,1,1,1
                ;;
            '$CCMPC'*) sentence "CAMPC$rest" && sentence CAMPR,2,1,0.2501 ;;
        esac
    done < modem > modem 2> /dev/null # until the line is taken away
}

# until_it_says WHAT FILE: waits until FILE has it, ten seconds at most
until_it_says() {
    local k
    for ((k = 0; k < 200; k++)); do
        ! grep -qs -- "$1" "$2" || return 0
        sleep 0.05
    done
    fail "no $1 in $2: $(cat "$2")"
}

# start OPTION...: mm-serial at `host` between the FIFO `in` and the file `out`
start() {
    [[ -p in ]] || mkfifo in
    mm-serial --id 1 "$@" host < in > out 2> err 3>&- &
    tool=$!
    pids+=("$tool")
    exec {in}> in
}

start_ready() {
    line_pair
    play 3>&- &
    pids+=("$!")
    start "$@"
    until_it_says READY out
}

# transmission NUMBER [MORE]
transmission() {
    echo "{\"transmission\":{\"number\":$1,\"src\":1,\"dest\":2,\"rate\":0,\"ack_requested\":true,\"frame\":[\"aGk=\"]${2-}}}"
}

@test "mm-serial: settings are written and echoed, the clock is set, then it is ready" {
    start_ready --set XST=1 --set DTO=10
    run_quiet head -7 said
    assert_output '$CCCFG,CST,1
$CCCFG,XST,1
$CCCFG,DTO,10
$CCCFG,SRC,1
$CCCFG,REV,1
$CCCFG,RXP,1
$CCMSC,1,1,0'
    run_quiet grep -c '^$CCCLK,20' said
    assert_output 1
    run_quiet jq -r '.modem.event' out
    assert_output $'CLOCK_SET\nREADY'
}

@test "mm-serial: a transmission has one result, and its acknowledgement; feedback gets both" {
    mkfifo fb
    exec {fb}<> fb
    start_ready --feedback fb
    transmission 7 >&"$in"
    until_it_says '"ack"' out
    run_quiet grep '^$CCTXD' said
    assert_output '$CCTXD,1,2,1,6869'
    run_quiet jq -c 'del(.time) | del(.result.statistics, .result.air_time_s, .modem.text)' out
    assert_line --index 2 '{"result":{"transmission":7,"outcome":"SENT"}}'
    assert_line --index 3 '{"ack":{"src":2,"dest":1,"transmission":7,"frame":[0]}}'
    read -r -t 5 first <&"$fb"
    read -r -t 5 second <&"$fb"
    run_quiet jq -r 'keys[0]' <<< "$first"
    assert_output result
    run_quiet jq -r 'keys[0]' <<< "$second"
    assert_output ack
}

@test "mm-serial: pings, late transmissions and those that cannot be" {
    start_ready --sound-speed 1480
    echo '{"transmission":{"number":8,"src":1,"dest":2,"kind":"PING"}}' >&"$in"
    until_it_says '"range_m":370.148' out
    transmission 9 ',"deadline":"2020-01-01T00:00:00Z"' >&"$in"
    echo '{"transmission":{"number":10,"dest":2,"rate":0,"frame":["aGk=","aGk="]}}' >&"$in"
    echo nonsense >&"$in"
    echo '{"message":{"id":1}}' >&"$in"
    until_it_says '"transmission":10' out
    run_quiet jq -c '.result | select(.) | [.transmission, .outcome, .why]' out
    assert_output --partial '[9,"LATE","it would end behind its deadline"]'
    assert_output --partial '[10,"REFUSED","2 frames where a packet of rate 0 has at most 1"]'
    run cat err
    assert_output --regexp '^mm-serial: <stdin>:4: '
    kill "$tool"
    wait "$tool" || [[ $? -eq 143 ]]
}

@test "mm-serial: a device that vanishes is said, and opened when it is back" { # nothing else stops
    start_ready
    kill "$socat"
    until_it_says DEVICE_LOST out
    transmission 11 >&"$in"
    until_it_says '"transmission":11' out
    rm -f host modem
    : > out
    line_pair
    play 3>&- &
    pids+=("$!")
    until_it_says DEVICE_BACK out
    until_it_says READY out
    run cat err
    assert_line --index 0 --regexp '^mm-serial: host: lost: '
    assert_line 'mm-serial: host: is back'
}

@test "mm-serial: the end of its input is no reason to stop listening, --linger is" {
    start_ready
    exec {in}>&-
    sentence CAMPA,3,1 > modem
    until_it_says '"HEARD","src":3' out
    kill "$tool"
    wait "$tool" || [[ $? -eq 143 ]]
    run_quiet mm-serial --id 1 --linger 0.2 host < /dev/null
}

@test "mm-serial: noise is told and skipped, with its number at the end" {
    start_ready
    printf 'gar\001bage\r\n$CAMPA,3,1*00\r\n' > modem
    sentence CAMPA,3,1 > modem
    until_it_says '"HEARD","src":3' out
    run_quiet jq -c '.raw | select(.) | [.line, .fault]' out
    assert_output '["gar\\x01bage","no sentence begins in it"]
["$CAMPA,3,1*00","checksum 00 is not the 5C of its bytes"]'
    kill "$tool"
    wait "$tool" || [[ $? -eq 143 ]]
    run cat err
    assert_output 'mm-serial: host: 2 lines could not be used'
}

@test "mm-serial: the serial line never waits for a reader; what is lost is counted" { # pitfall: back-pressure
    line_pair
    mkfifo slow
    exec {slow}<> slow
    mm-serial --id 1 --raw host < /dev/null > slow 2> err 3>&- &
    pids+=("$!")
    play 3>&- &
    pids+=("$!")
    sleep 0.5
    local line k
    line=$(sentence "CADBG,$(printf '%080d' 0)")
    for ((k = 0; k < 1200; k++)); do echo "$line"; done > flood
    timeout 60 cp flood modem # writes all of it: so it was read
    timeout 5 cat <&"$slow" > seen || true
    sentence CAMPA,3,1 > modem
    timeout 2 cat <&"$slow" >> seen || true
    run_quiet jq -c '.modem | select(.event == "GAP") | .count > 100' seen
    assert_line --index 0 true
    run_quiet jq -c '.modem | select(.event == "HEARD") | .src' seen
    assert_output 3
}

@test "mm-serial: a full feedback drops and counts, and holds nothing up" {
    mkfifo fb
    exec {fb}<> fb
    start_ready --feedback fb
    local k
    for ((k = 0; k < 1000; k++)); do echo "{\"transmission\":{\"number\":$k,\"dest\":2}}"; done >&"$in"
    until_it_says '"transmission":999' out
    kill "$tool"
    wait "$tool" || [[ $? -eq 143 ]]
    run cat err
    assert_output --regexp '^mm-serial: fb: [0-9]+ records found no room$'
}

@test "mm-serial: a serial server, tcp:HOST:PORT" {
    socat -d -d tcp-listen:0,bind=127.0.0.1,reuseaddr pty,raw,echo=0,link=modem 2> port 3>&- &
    pids+=("$!")
    until_it_says 'listening on' port
    local number
    number=$(sed -n 's/.*listening on .*:\([0-9]*\)$/\1/p' port)
    mm-serial --id 1 --linger 3 "tcp:127.0.0.1:$number" < /dev/null > out 2> err 3>&- &
    tool=$!
    pids+=("$tool")
    for ((k = 0; k < 100; k++)); do [[ -e modem ]] && break || sleep 0.05; done
    run_quiet timeout 5 head -n 1 modem
    assert_output $'$CCCFG,CST,1*37\r'
}

@test "mm-serial: devices that are not there, or not to be had" {
    run -69 --separate-stderr mm-serial --id 1 gone < /dev/null
    assert_equal "$stderr" 'mm-serial: gone: No such file or directory'
    touch file
    run -69 --separate-stderr mm-serial --id 1 file < /dev/null
    assert_equal "$stderr" 'mm-serial: file: is no terminal'
    run -69 --separate-stderr mm-serial --id 1 tcp:127.0.0.1:1 < /dev/null
    assert_equal "$stderr" 'mm-serial: tcp:127.0.0.1:1: Connection refused'
    line_pair
    mm-serial --id 1 host < /dev/null > /dev/null 2>&1 3>&- &
    pids+=("$!")
    head -n 1 modem > /dev/null
    run -69 --separate-stderr mm-serial --id 1 host < /dev/null
    assert_equal "$stderr" 'mm-serial: host: another program uses it'
}

@test "mm-serial: command lines that cannot be" {
    refused() { # MESSAGE OPTION...
        run -64 --separate-stderr mm-serial "${@:2}" < /dev/null
        assert_equal "$stderr" "mm-serial: $1"
    }
    refused 'option --id is required (try --help)' host
    refused 'DEVICE is required (try --help)' --id 1
    refused 'id 31 is not 1 to 30' --id 31 host
    refused "option --set: 'SRC' is not NAME=VALUE" --id 1 --set SRC host
    refused "setting SRC is the modem's id, and said as such" --id 1 --set SRC=2 host
    refused "option --lbl: 'sonar' is none of remus, narrowband, coded" --id 1 --lbl sonar host
    refused "option --lbl-transponders: 'E' is not A to D" --id 1 --lbl-transponders AE host
    refused 'baud 12345 is none that the system knows' --id 1 --baud 12345 host
    refused 'option --clock: a modem does not wait for records' --id 1 --clock input host
    refused "'tcp:host' is not of the form tcp:HOST:PORT" --id 1 tcp:host
    run -66 --separate-stderr mm-serial --id 1 --rates gone host < /dev/null
    assert_equal "$stderr" 'mm-serial: gone: No such file or directory'
    echo 'data 0 1 32 3.2 0 0.9' > bad.rates
    run -78 --separate-stderr mm-serial --id 1 --rates bad.rates host < /dev/null
    [[ $stderr == 'mm-serial: bad.rates:1: 7 columns where there should be 8: '* ]]
}

@test "mm-serial: a log comes to the records that were given out when it was made" {
    start_ready --raw
    transmission 7 >&"$in"
    until_it_says '"ack"' out
    sentence CAMPA,3,1 > modem
    until_it_says '"HEARD","src":3' out
    kill "$tool"
    wait "$tool" || [[ $? -eq 143 ]]
    simple='select(.result or .ack or .modem.event == "HEARD") | del(.result.air_time_s) | (.result, .ack | select(.) | .transmission) = 0'
    jq -c "$simple" out > live
    jq -c 'select(.raw)' out > log
    run_quiet mm-serial --replay log
    run_quiet jq -c "$simple" <<< "$output"
    assert_output "$(cat live)"
    assert_equal "${#lines[@]}" 3
    # and by the lines alone
    jq -r '.raw | (if .direction == "OUT" then "[tx] " else "[rx] " end) + .line' log > goby.log
    run_quiet mm-serial --replay goby.log
    run_quiet jq -c '.result.outcome, .ack.frame | select(.)' <<< "$output"
    assert_output $'"SENT"\n[0]'
}

@test "mm-serial: logs in binary, too" {
    sentence CAMPA,1,2 > log
    mm-serial --replay --raw -f delimited log > raw.bin
    run_quiet mm-serial --replay -F delimited raw.bin
    assert_output '{"time":"1970-01-01T00:00:00Z","modem":{"event":"HEARD","src":1,"dest":2}}'
}
