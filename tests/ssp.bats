#!/usr/bin/env bats
# ssp makes profiles of sound speed from casts and live samples of a CTD.

setup() {
    load test_helper
    cd "$BATS_TEST_TMPDIR" || return
    printf '%s\n' depth_m,temperature_c,salinity 0,10,35 10,9.5,35 20,9,35 > cast.csv
    sample='{"time":"2024-05-01T12:00:00Z","depth_m":10,"temperature_c":10,"salinity":35}'
}

# need_casts: the folder of real casts, which is not part of the repository.
need_casts() {
    casts=$SEAUTILS_SHARED/data/ctd
    [[ -d $casts ]] || skip "the casts of $casts are not there"
}

# samples SECONDS DEPTH...: one sample each, so far apart, down the depths.
samples() {
    local step=$1 k=0
    shift
    for depth in "$@"; do
        printf '{"time":"@%s","depth_m":%s,"sound_speed_mps":1500}\n' $((k++ * step + 1714564800)) "$depth"
    done | sed 's/"@\([0-9]*\)"/\1/' | jq -c '.time |= todate'
}

# worst COLUMN...: the largest difference between two columns of numbers on standard input.
worst() { awk '{ d = $1 - $2; if (d < 0) d = -d; if (d > most) most = d } END { print NR, most + 0 }'; }

# assert_refused WHAT OPTION...: status 64, one line, nothing on standard output.
assert_refused() {
    local said=$1
    shift
    run -64 --separate-stderr ssp "$@" cast.csv
    assert_output ''
    # shellcheck disable=SC2154  # run sets it
    assert_equal "$stderr" "ssp: $said"
}

@test "ssp: a cast becomes a profile" {
    run_quiet ssp cast.csv
    # 10 °C, 35, the surface: 1489.832 by Chen and Millero (UNESCO; table of Wong and Zhu's form)
    assert_equal "$(jq -c '[.depth_m, .sound_speed_mps[0], .count, .samples, .formula, .source]' <<< "$output")" \
        '[[0,10,20],1489.832,[1,1,1],3,"chen-millero","cast.csv"]'
    assert_equal "$(jq -c '[.temperature_c, .measured_to_m, .time, .extension, .extrapolated, .dropped]' <<< "$output")" \
        '[[10,9.5,9],20,null,null,null,null]'
}

@test "ssp: each formula, and outside its range a flag" {
    while read -r formula speed; do
        printf 'depth,temp,sal\n0,20,35\n' > at20.csv
        run_quiet ssp --formula "$formula" at20.csv
        assert_equal "$formula $(jq -c .sound_speed_mps[0] <<< "$output")" "$formula $speed"
        assert_equal "$(jq -c .extrapolated <<< "$output")" null
    done << 'END'
chen-millero 1521.478
del-grosso 1521.48
mackenzie 1521.463
leroy 1521.578
medwin 1521.52
coppens 1521.45
END
    printf 'depth,temp,sal\n0,20,35\n1500,1,35\n' > deep.csv
    assert_equal "$(ssp --formula medwin deep.csv | jq -c .extrapolated)" '[false,true]'
    assert_equal "$(ssp --formula mackenzie deep.csv | jq -c .extrapolated)" '[false,true]'
    assert_equal "$(ssp --formula leroy deep.csv | jq -c .extrapolated)" null
    run_quiet bash -c 'ssp --formula medwin -f csv deep.csv | tail -1'
    assert_output --regexp '^1,,1500,.*,1$'
}

@test "ssp: binary output is the message that the schema declares" {
    ssp --extend 150 -f delimited cast.csv > one.bin
    ssp --extend 150 cast.csv > one.ndjson
    # the length in front is a varint of two bytes here
    tail -c +3 one.bin | protoc -I "$SEAUTILS_ROOT/schemas" --decode seautils.SoundSpeedProfile seautils/acoustics.proto > decoded
    assert_equal "$(sed -n 's/^depth_m: //p' decoded | xargs)" "$(jq -r '.depth_m[]' one.ndjson | xargs)"
    assert_equal "$(sed -n 's/^sound_speed_mps: //p' decoded | xargs)" "$(jq -r '.sound_speed_mps[]' one.ndjson | xargs)"
    assert_equal "$(sed -n 's/^count: //p' decoded | xargs)" '1 1 1 0 0'
    run cat decoded
    assert_line 'formula: "chen-millero"'
    assert_line 'extension: ISOTHERMAL'
    assert_line 'measured_to_m: 20'
    refute_line --regexp '^[0-9]+:' # nothing that the schema does not know
    # every field
    awk 'BEGIN { print "time,pressure,temp,sal,lat,lon"
        for (k = 0; k < 60; ++k) print 1714564800 + k, k < 30 ? k : 60 - k, k == 9 ? 44 : k == 5 ? 99 : -1, 35, 43.5, -70.25 }' > all.csv
    ssp --split leg --spike 3 --extend 50 -f delimited all.csv | head -c 2000 > all.bin
    ssp --split leg --spike 3 --extend 50 all.csv | head -1 > all.ndjson
    length=$(od -An -tu1 -N2 all.bin | awk '{ print $1 - 128 + 128 * $2 }')
    tail -c +3 all.bin | head -c "$length" | protoc -I "$SEAUTILS_ROOT/schemas" --decode seautils.SoundSpeedProfile seautils/acoustics.proto > decoded
    run cat decoded
    refute_line --regexp '^[0-9]+:'
    for name in time start latitude_deg longitude_deg source direction depth_m sound_speed_mps standard_deviation_mps \
        count extrapolated temperature_c salinity formula samples dropped measured_from_m measured_to_m extension; do
        assert_line --regexp "^$name( \{|:)"
        jq -e ".$name" all.ndjson > /dev/null || fail "no $name"
    done
    assert_line 'latitude_deg: 43.5'
    assert_line 'longitude_deg: -70.25'
    assert_line 'direction: DIVE'
    assert_line '  out_of_bounds: 1'
    # and samples are read in that form
    printf 'time { seconds: 1714564800 } depth_m: 10 temperature_c: 10 salinity: 35' |
        protoc -I "$SEAUTILS_ROOT/schemas" --encode seautils.CtdSample seautils/acoustics.proto > sample
    { bytes "$(printf %02x "$(wc -c < sample)")" && cat sample; } > sample.bin
    assert_equal "$(ssp -F delimited sample.bin | jq -c 'del(.source)')" "$(ssp <<< "$sample" | jq -c .)"
}

@test "ssp: csv is read again as it was written" {
    ssp -f csv cast.csv > profile.csv
    assert_equal "$(head -1 profile.csv)" 'profile,time,depth_m,sound_speed_mps,standard_deviation_mps,count,temperature_c,salinity,extrapolated'
    ssp -f csv profile.csv > again.csv
    cmp profile.csv again.csv
    # a profile in JSON too: its speeds count, as they are
    ssp cast.csv | ssp > again.ndjson
    assert_equal "$(jq -c '[.depth_m, .sound_speed_mps, .formula]' again.ndjson)" "$(ssp cast.csv | jq -c '[.depth_m, .sound_speed_mps, null]')"
}

@test "ssp: columns are named by options, or by their places" {
    printf 'd,T1,S1\n5,10,35\n' > odd.csv
    run -1 --separate-stderr ssp odd.csv
    assert_equal "$stderr" "ssp: odd.csv:1: header 'd,T1,S1' names no depth or pressure beside a temperature or a sound speed (--column)"
    run_quiet ssp --column depth_m=d --column temperature_c=T1 --column salinity=S1 odd.csv
    assert_equal "$(jq -c .depth_m <<< "$output")" '[5]'
    run_quiet ssp --column depth_m=1 --column sound_speed_mps=2 <<< '7 1500.25'
    assert_equal "$(jq -c '[.depth_m, .sound_speed_mps]' <<< "$output")" '[[7],[1500.25]]'
    assert_refused "option --column: 'depth' is not of the form QUANTITY=NAME" --column depth
    assert_refused "option --column: quantity 'deep' is none of time, pressure_dbar, depth_m, temperature_c, temperature_68_c, salinity, conductivity_spm, conductivity_mspcm, sound_speed_mps, latitude_deg, longitude_deg" --column deep=x
}

@test "ssp: what is left out is counted, and said with its place and reason" {
    {
        echo pressure_dbar,temperature_c,salinity
        for k in {0..39}; do echo "$k,10,35"; done
        echo 15,99,35
        echo 16,10,
        echo -0.4,10,35
    } | sed '20s/10,35/14,35/' > odd.csv
    run -0 --separate-stderr ssp -v odd.csv
    assert_equal "$(jq -c .dropped <<< "$output")" '{"incomplete":1,"out_of_bounds":1,"above_surface":1,"spike":1}'
    assert_equal "$(jq -c .samples <<< "$output")" 39
    assert_equal "$stderr" 'ssp: odd.csv:42: left out (out_of_bounds): temperature_c 99 is outside -4 to 45 °C
ssp: odd.csv:43: left out (incomplete): no sound_speed_mps, and not both of temperature and salinity
ssp: odd.csv:44: left out (above_surface): above the surface
ssp: odd.csv:20: left out (spike)
ssp: odd.csv: profile of 39 levels of 39 samples, left out 1 incomplete, 1 out_of_bounds, 1 above_surface, 1 spike'
    assert_equal "$(ssp --spike 0 odd.csv | jq -c .dropped.spike)" null
}

@test "ssp: a cast of which nothing can be used is status 1, and says why" {
    printf 'depth,temp\n1,10\n2,10\n' > bare.csv
    run -1 --separate-stderr ssp bare.csv
    assert_output ''
    assert_equal "$stderr" 'ssp: bare.csv: no profile: 2 scans left out (2 incomplete)'
    run -65 ssp --strict bare.csv
    run_quiet ssp --salinity 35 bare.csv
    assert_equal "$(jq -c '[.salinity, .remark]' <<< "$output")" '[[35,35],["salinity is assumed in some samples"]]'
}

@test "ssp: depth of pressure by latitude, and said where none is known" {
    printf 'pressure,temp,sal\n10000,2,35\n' > deep.csv
    # UNESCO 44: 10000 dbar at 30 degrees are 9712.653 m
    run_quiet ssp --latitude 30 deep.csv
    assert_equal "$(jq -c '[.depth_m, .latitude_deg, .remark]' <<< "$output")" '[[9712.653],30,null]'
    run_quiet ssp deep.csv
    assert_equal "$(jq -c .remark <<< "$output")" '["depths are of pressures at latitude 45, as none is known"]'
}

@test "ssp: salinity of conductivity" {
    # PSS-78: 42.914 mS/cm at 15 °C (IPTS-68) and the surface are 35
    for column in conductivity_spm=4.2914 conductivity_mscm=42.914; do
        printf 'depth_m,t068,%s\n0,15,%s\n' "${column%=*}" "${column#*=}" > c.csv
        assert_equal "$(ssp c.csv | jq -c .salinity)" '[35]'
    done
}

@test "ssp: windows follow each other, or overlap" {
    samples 60 {1..61} > hour.ndjson
    spans() { jq -r '[.samples, .start, .time] | @tsv' | tr '\t' ' '; }
    assert_equal "$(ssp hour.ndjson | spans)" '30 2024-05-01T12:00:00Z 2024-05-01T12:29:00Z
30 2024-05-01T12:30:00Z 2024-05-01T12:59:00Z
1 2024-05-01T13:00:00Z 2024-05-01T13:00:00Z'
    assert_equal "$(ssp --window 600 --every 1500 hour.ndjson | spans)" '10 2024-05-01T12:15:00Z 2024-05-01T12:24:00Z
10 2024-05-01T12:40:00Z 2024-05-01T12:49:00Z
10 2024-05-01T12:51:00Z 2024-05-01T13:00:00Z'
    assert_equal "$(ssp --every 0 hour.ndjson | wc -l)" 61
    assert_equal "$(ssp --split cast hour.ndjson | jq .samples)" 61
    assert_refused "option --window is for --split window" --split leg --window 5
    assert_refused "option --split: 'dive' is none of window, leg, cast" --split dive
}

@test "ssp: a profile of each dive and each climb" {
    samples 10 $(seq 0 2 40) $(seq 38 -2 0) $(seq 2 2 40) > yoyo.ndjson
    assert_equal "$(ssp --split leg yoyo.ndjson | jq -c '[.direction, .samples, .measured_from_m, .measured_to_m]')" '["DIVE",21,0,40]
["CLIMB",20,0,38]
["DIVE",20,2,40]'
}

@test "ssp: a profile goes on below its last sample by a stated rule" {
    run_quiet ssp --extend 1000 cast.csv
    assert_equal "$(jq -c '[.extension, .measured_to_m, .depth_m[-1], .count[-1], .depth_m[3]]' <<< "$output")" '["ISOTHERMAL",20,1000,0,100]'
    # the terms of Mackenzie's equation that hold depth, at 9 °C from 20 to 1000 m:
    # 0.0163 * 980 + 1.675e-7 * (1000^2 - 20^2) - 7.139e-13 * 9 * (1000^3 - 20^3) = 16.135
    assert_equal "$(ssp --formula mackenzie --extend 1000 cast.csv | jq -c '(.sound_speed_mps[-1] - .sound_speed_mps[2]) * 1000 | round')" 16135
    printf 'depth,sound_speed\n0,1500\n20,1495\n120,1485\n800,1480\n' > levitus.csv
    run_quiet ssp --climatology levitus.csv --blend 200 cast.csv
    assert_equal "$(jq -c '[.extension, .depth_m]' <<< "$output")" '["CLIMATOLOGY",[0,10,20,120,220,800]]'
    # half of the difference at 20 m is left at 120 m, and nothing at 220 m
    assert_equal "$(jq -c '(.sound_speed_mps | [(.[3] - 1485) * 2 - (.[2] - 1495), .[5]]) | map(. * 100 | round)' <<< "$output")" '[0,148000]'
    run -66 --separate-stderr ssp --climatology gone.csv cast.csv
    assert_equal "$stderr" 'ssp: gone.csv: No such file or directory'
    printf 'depth,sound_speed\n0,1500\n20,fast\n' > wrong.csv
    run -65 --separate-stderr ssp --climatology wrong.csv cast.csv
    assert_equal "$stderr" "ssp: wrong.csv:3: sound_speed_mps 'fast' is no number"
    assert_refused 'option --blend is for --climatology' --blend 3
}

@test "ssp: each FILE is a cast of its own" {
    run_quiet ssp cast.csv cast.csv
    assert_equal "${#lines[@]}" 2
    assert_equal "${lines[0]}" "${lines[1]}"
}

@test "ssp: the form is told by the first line, or said" {
    printf '* Sea-Bird\r\n# name 0 = depSM: d\r\n# name 1 = svCM: v\r\n*END*\r\n      5.000    1500.25\r\n' > cast.cnv
    assert_equal "$(ssp cast.cnv | jq -c '[.depth_m, .sound_speed_mps]')" '[[5],[1500.25]]'
    assert_equal "$(ssp -F cnv cast.cnv | jq -c .depth_m)" '[5]'
    run -1 --separate-stderr ssp -F cnv cast.csv
    assert_equal "$stderr" 'ssp: cast.csv:1: no header of a .cnv file'
    assert_equal "$(printf '\xef\xbb\xbf%s\n' "$sample" | ssp | jq -c .depth_m)" '[10]'
    run -1 --separate-stderr bash -c 'gzip < cast.csv | ssp'
    assert_equal "$stderr" 'ssp: <stdin>:1: compressed by gzip (zcat FILE | ssp)'
}

@test "ssp: samples without a time are of the clock's" {
    bare='{"depth_m":10,"sound_speed_mps":1500}'
    run bash -c "echo '$bare' | ssp --clock warp:0.001,0,2024-05-01T12:00:00Z | jq -r .time"
    assert_output --regexp '^2024-05-0[1-9]T' # a thousandth of the time since the machine's start later
    assert_equal "$(echo "$bare" | ssp --clock input | jq -r .time)" null
    echo "$bare" > bare.ndjson # a file is not of now
    assert_equal "$(ssp - < bare.ndjson | jq -r .time)" null
    assert_equal "$(printf '%s\n' "$sample" "$bare" | ssp --clock input | jq -c '[.time, .samples]')" '["2024-05-01T12:00:00Z",2]'
}

# --- a sensor that falls silent ---

# at MINUTE DEPTH: a sample
at() {
    local now=${sample/12:00/12:0$1}
    echo "${now/:10,/:$2,}"
}

# answers_before_the_end N COMMAND...: what it writes of so many samples a minute apart, while its pipe stays open
answers_before_the_end() {
    local n=$1 hold pid k
    shift
    rm -f live.pipe got
    mkfifo live.pipe
    "$@" < live.pipe > got 2> said 3>&- &
    pid=$!
    exec {hold}> live.pipe
    for ((k = 0; k < n; k++)); do at "$k" "1$k" >&"$hold"; done
    for ((k = 0; k < 200; k++)); do
        [[ ! -s got ]] || break
        sleep 0.05
    done
    jq -c '[.time, .samples]' got
    kill -0 "$pid" # so it was no end of its input that made it answer
    { at 8 10 && at 9 30; } >&"$hold"
    exec {hold}>&-
    wait "$pid"
}

@test "ssp: what a silent sensor has measured is written after --silence" {
    for split in window leg cast; do
        run answers_before_the_end 3 ssp --split $split --silence 0.2
        assert_output '["2024-05-01T12:02:00Z",3]'
        assert_equal "$(jq -c .samples got | xargs)" '3 2'
        assert_equal "$(cat said)" ''
    done
}

@test "ssp: with --clock input silence is that between the samples' times" {
    printf '%s\n' "$sample" "${sample/12:00:00/12:00:30}" "${sample/12:00:00/12:01:31}" > gap.ndjson
    silence() { ssp --clock input --split cast --silence "$1" gap.ndjson | jq -c .samples | xargs; }
    assert_equal "$(silence 60)" '2 1'
    assert_equal "$(silence 62)" '3'
    assert_equal "$(silence 20)" '1 1 1'
    # what was written after each sample is not written again
    assert_equal "$(ssp --clock input --every 0 --silence 60 gap.ndjson | jq -c .samples | xargs)" '1 2 1'
    # a scan that is left out breaks no silence, and tells the time
    sed -n '1p; 2s/"depth_m":10/"depth_m":-9/p; 3p' gap.ndjson | ssp --clock input --split cast --silence 20 > got
    assert_equal "$(jq -c .samples got | xargs)" '1 1'
    # without the option nothing is split, and lines are counted as ever
    assert_equal "$(ssp --clock input --split cast gap.ndjson | jq -c .samples)" 3
    run -1 --separate-stderr ssp --silence 9 <<< "$sample"$'\n\n'"{\"depth_m\":"
    assert_regex "$stderr" '^ssp: <stdin>:3: '
}

@test "ssp: a profile that waits for silence is written where it is told to end" {
    echo "$sample" > in
    mkfifo quiet.pipe
    ssp -v --silence 1000 < quiet.pipe > got 2> said 3>&- &
    pid=$!
    exec {hold}> quiet.pipe
    printf '%s\n' "${sample/:10,/:-9,}" "$sample" >&"$hold"
    for ((k = 0; k < 200; k++)); do grep -q 'left out' said && break || sleep 0.05; done
    sleep 0.1
    kill $pid
    wait $pid || assert_equal $? 143
    exec {hold}>&-
    assert_equal "$(jq -c .samples got)" 1
    assert_regex "$(cat said)" '<stdin>:1: left out'
}

# --- real casts ---

@test "ssp: every cast of the shared data goes through" {
    need_casts
    number=0
    for file in "$casts"/*.csv; do
        [[ $file != */ctd_index.csv ]] || continue
        run_quiet ssp "$file"
        # as many samples as the table has rows, but for those that it says are left out
        assert_equal "$(jq -s 'map(.samples + ([.dropped[]?] | add // 0)) | add' <<< "$output")" $(($(wc -l < "$file") - 1))
        # at most 3 % are, but where a sensor was in air
        run jq -e '([.dropped // {} | to_entries[] | select(.key != "above_surface").value] | add // 0) < .samples * 0.03' <<< "$output"
        [[ $status -eq 0 ]] || fail "too much of $file is left out"
        number=$((number + 1))
    done
    assert [ $number -ge 14 ]
    for file in "$casts"/*.csv.gz; do
        run_quiet bash -c "zcat '$file' | ssp"
        assert [ "${#lines[@]}" -ge 3 ]
    done
}

@test "ssp: the speed is that of a glider's own basestation (EOS-80), scan by scan" {
    need_casts
    for dive in 304 306 308; do
        file=$casts/seaglider_sg542_dive$dive.csv
        # bins so low that each holds one scan, or scans of one depth
        keep=(--bin 0.01 --spike 0 --loop 0 -f csv)
        ssp "${keep[@]}" "$file" | cut -d, -f3,4 > ours
        ssp "${keep[@]}" --formula measured "$file" | cut -d, -f3,4 > theirs
        run awk '{ exit !($1 > 700 && $2 <= 0.02) }' <<< "$(join -t, <(sort ours) <(sort theirs) | awk -F, '$2 + 0 > 0 { print $2, $3 }' | worst)"
        [[ $status -eq 0 ]] || fail "dive $dive differs"
    done
}

@test "ssp: the speed is Sea-Bird's own, depth and position those of the header" {
    need_casts
    orig=$SEAUTILS_SHARED/data/orig
    zcat "$orig/d201211_0011.cnv.gz" > beaufort.cnv
    run_quiet ssp beaufort.cnv
    assert_equal "$(jq -c '[.time, .latitude_deg, .longitude_deg]' <<< "$output")" '["2012-08-09T06:34:34Z",71.345,-151.7876667]'
    # svCM is given to 0.01 m/s, and meant for ITS-68
    ssp --spike 0 --bin 0.1 -f csv beaufort.cnv | cut -d, -f4 | tail -n +2 > ours
    ssp --spike 0 --bin 0.1 --formula measured -f csv beaufort.cnv | cut -d, -f4 | tail -n +2 > theirs
    assert_equal "$(paste ours theirs | worst | awk '{ print $1, ($2 <= 0.011) }')" '78 1'
    run_quiet bash -c "ssp --split cast '$orig/BED0302.CNV' | jq -c '[.start, .latitude_deg, .longitude_deg, .dropped.out_of_bounds]'"
    assert_output --regexp '^\["2003-10-15T[0-9:]+Z",44.6842667,-63.6438833,1\]$'
}

@test "ssp: an archive's original and the table made of it give the same" {
    need_casts
    orig=$SEAUTILS_SHARED/data/orig
    for pair in a22_00025_00001_ct1=caribbean_a22_s25_19970821 a23_00043_00001_ct1=scotia_sea_a23_s43_19950410; do
        latitude=$(sed -n 's/^LATITUDE = *//p' "$orig/${pair%=*}.csv")
        run_quiet ssp "$orig/${pair%=*}.csv"
        theirs=$(jq -c '[.depth_m, .sound_speed_mps]' <<< "$output")
        run_quiet ssp --latitude "$latitude" "$casts/${pair#*=}.csv"
        assert_equal "$(jq -c '[.depth_m, .sound_speed_mps]' <<< "$output" | md5sum)" "$(md5sum <<< "$theirs")"
    done
}

# --- what every tool does ---

@test "ssp: a bad row is located, dropped, and makes the status 1" {
    printf '%s\n' depth,temp,sal 1,10,35 2,x,35 3 '4,10,35' > bad.csv
    run -1 --separate-stderr ssp bad.csv
    assert_equal "$(jq -c .depth_m <<< "$output")" '[1,4]'
    assert_equal "$stderr" "ssp: bad.csv:3: temperature_c 'x' is no number
ssp: bad.csv:4: 1 column where the header has 3"
    run -65 --separate-stderr ssp --strict bad.csv
    assert_output ''
    assert_equal "$stderr" "ssp: bad.csv:3: temperature_c 'x' is no number"
    run -1 --separate-stderr ssp <<< "{\"depth_m\":"$'\n'"$sample"
    assert_equal "$(jq -c .depth_m <<< "$output")" '[10]'
    assert_regex "$stderr" '^ssp: <stdin>:1: '
    run -1 --separate-stderr ssp <<< '{"depth_m":[1,2],"sound_speed_mps":[1500]}'
    assert_equal "$stderr" 'ssp: <stdin>:1: depth_m has 2 values, sound_speed_mps 1'
    run -66 --separate-stderr ssp gone.csv
    assert_equal "$stderr" 'ssp: gone.csv: No such file or directory'
}

@test "ssp: a profile with too many levels is refused, and the next one is made" {
    awk 'BEGIN { print "depth,svel"; for (k = 0; k < 20001; ++k) print k / 10, 1500 }' | tr ' ' , > fine.csv
    run -1 --separate-stderr ssp --bin 0.1 fine.csv cast.csv
    assert_equal "$stderr" 'ssp: fine.csv: more than 20000 bins of 0.1 m hold something (--bin)'
    assert_equal "$(jq -c .depth_m <<< "$output")" '[0,10,20]'
}

@test "ssp: bytes that are no text are refused in one printable line" {
    printf 'dep\0th,sa\033lt\n1,2\n' > nul.csv
    run -1 bash -c 'ssp nul.csv 2> said'
    assert_equal "$(wc -l < said)" 1
    assert_equal "$(tr -d '[:print:]\n' < said | wc -c)" 0
    head -c 100000 "$SEAUTILS_BIN/ssp" > noise
    run bash -c 'ssp noise > got 2> said'
    assert [ "$status" -eq 1 ]
    assert_equal "$(wc -c < got)" 0
}

@test "ssp: a live pipe is answered at once" {
    echo "$sample" > in
    ssp --every 0 in | jq -c 'del(.source)' > out
    jq -c . < out > wanted
    assert_answered_at_once in wanted ssp --every 0
}

@test "ssp: a log that grows is followed" {
    echo "$sample" > log
    ssp --every 0 --follow log > got 2> said 3>&- &
    pid=$!
    for ((k = 0; k < 200; k++)); do [[ $(wc -l < got) -eq 1 ]] && break || sleep 0.05; done
    echo "${sample/00Z/30Z}" >> log
    for ((k = 0; k < 200; k++)); do [[ $(wc -l < got) -eq 2 ]] && break || sleep 0.05; done
    kill $pid
    wait $pid || assert_equal $? 143
    assert_equal "$(jq -c .samples got | xargs)" '1 2'
    assert_equal "$(cat said)" ''
}

@test "ssp: a full disk is status 74; a reader that goes ends it; an empty input is none" {
    run -74 --separate-stderr bash -c 'ssp cast.csv > /dev/full'
    assert_equal "$stderr" 'ssp: write failed: No space left on device'
    run -0 bash -c "samples() { :; }; yes '$sample' | ssp --every 0 --window 1 | head -1 | wc -l"
    assert_output 1
    run_quiet ssp < /dev/null
    assert_output ''
}

@test "ssp: options are checked, with their bounds" {
    assert_refused "option --bin: '0' is outside 0.01 to 1000 m" --bin 0
    assert_refused "option --bin: 'x' is outside 0.01 to 1000 m" --bin x
    assert_refused "option --silence: '0' is outside 0.001 to 2592000 s" --silence 0
    assert_refused "option --latitude: '91' is outside -90 to 90 degrees" --latitude 91
    assert_refused "option --formula: 'wilson' is none of chen-millero, del-grosso, mackenzie, leroy, medwin, coppens, measured" --formula wilson
    assert_refused 'unknown option --depth (try --help)' --depth
    assert_refused "option --format: 'xml' is none of ndjson, csv, delimited" -f xml
    echo 'bin = 0' > wrong.conf
    run -78 --separate-stderr ssp -c wrong.conf cast.csv
    assert_equal "$stderr" "ssp: wrong.conf:1: option --bin: '0' is outside 0.01 to 1000 m"
}

@test "ssp: --help fits a terminal, and names what the manual names" {
    run_quiet ssp --help
    assert [ "${#lines[@]}" -le 45 ]
    for line in "${lines[@]}"; do [[ ${#line} -le 100 ]] || fail "$line"; done
    sed -n 's/^ *\(-., \)\{0,1\}\(--[a-z-]*\).*/\2/p' <<< "$output" | sort > helped
    man=$SEAUTILS_BUILD/man/ssp.1.scd
    [[ -f $man ]] || skip "the manual is not built"
    sed -n '/^# OPTIONS/,/^# INPUT/p' "$man" | grep '^\*-' | grep -o -- '--[a-z][a-z-]*' | sort -u > told
    run comm -23 helped told
    assert_output ''
}

@test "ssp: a FILE may stand behind a repeatable option" {
    run_quiet ssp --column salinity=salinity cast.csv
    assert_equal "${#lines[@]}" 1
}

@test "ssp: a cast of a million samples takes a second or so, and bounded memory" {
    skip_if_sanitized "time and memory are not those of a release"
    awk 'BEGIN { print "depth_m,temperature_c,salinity"; for (k = 0; k < 1000000; ++k) printf "%.3f,%.3f,35\n", k / 1000, 20 - k / 1e5 }' > long.csv
    run -0 bash -c "/usr/bin/env time -f '%U %M' ssp --split cast long.csv 2>&1 > got"
    read -r seconds kib <<< "$output"
    assert_equal "$(jq -c '[.samples, (.depth_m | length)]' got)" '[1000000,1001]'
    assert [ "$kib" -le 131072 ]
    [[ $(awk "BEGIN { print ($seconds < 5) }") == 1 ]] || fail "$seconds s"
}
