#!/usr/bin/env bats
# tl-model computes transmission loss and arrivals, from files and for requests.
# shellcheck disable=SC2016  # the variables of a stand-in are its own

setup() {
    load test_helper
    cd "$BATS_TEST_TMPDIR" || return
    # Lloyd's mirror: a source under a smooth surface, above water that does not end.
    cat > lloyd.json << 'END'
{
 "name": "lloyd", "title": "Lloyd's mirror", "frequency_hz": 400,
 "source": {"depth_m": 25},
 "receivers": {"depth_m": [10, 100], "range_m": {"start": 500, "stop": 1500, "count": 3}},
 "water": {"ssp_interpolation": "c-linear", "profile_z_c": [[0, 1500], [600, 1500]], "absorption": {"model": "none"}},
 "surface": {"type": "pressure-release"},
 "bottom": {"type": "fluid-halfspace", "depth_m": 600, "sound_speed_m_s": 1500, "density_g_cm3": 1, "attenuation_db_per_wavelength": 0},
 "fan": {"min_deg": -89, "max_deg": 89, "positive": "down"},
 "arrivals": {"depth_m": [10], "range_m": [500]}
}
END
    whole='{"id":7,"frequency_hz":400,"source":{"depth_m":25},"receivers":{"depth_m":[10,100],"ranges":{"start_m":500,"stop_m":1500,"count":3}},"profile":{"depth_m":[0,600],"sound_speed_mps":[1500,1500]},"bottom":{"sound_speed_mps":1500,"density_gcm3":1},"bottom_depth_m":600,"fan":{"min_deg":-89,"max_deg":89}}'
    proto=$SEAUTILS_ROOT/schemas
}

# need_cases: the reference cases, which are not part of the repository.
need_cases() {
    cases=$SEAUTILS_SHARED/cases
    [[ -d $cases ]] || skip "the cases of $cases are not there"
}

# assert_near MOST A... = B...: numbers that differ by no more.
assert_near() {
    local most=$1
    shift
    awk -v most="$most" -v all="$*" 'BEGIN {
        n = split(all, sides, " = ")
        k = split(sides[1], a, " "); m = split(sides[2], b, " ")
        if (n != 2 || k != m || k == 0) exit 1
        for (i = 1; i <= k; i++) { d = a[i] - b[i]; if (d < -most || d > most) exit 1 }
    }' || fail "not within $1: $*"
}

# cells FILE: its losses without ranges and depths, on one line.
cells() { tail -n +2 "$1" | cut -d, -f2- | tr ',\n' '  '; }

# stand_in NAME SCRIPT: a program of others, in bin/, which alone is in PATH with the system's.
stand_in() {
    mkdir -p bin
    printf '#!/bin/sh\nhere=%q\n%s\n' "$PWD" "$2" > "bin/$1"
    chmod +x "bin/$1"
    PATH=$PWD/bin:$SEAUTILS_BIN:/usr/bin:/bin
}

# assert_says STATUS WHAT COMMAND...: that status, that line on standard error.
assert_says() {
    local status_wanted=$1 said=$2
    shift 2
    run "-$status_wanted" --separate-stderr "$@"
    # shellcheck disable=SC2154  # run sets it
    assert_equal "$stderr" "tl-model: $said"
}

@test "tl-model: losses of a mirror are those of theory, in each sum" {
    # (500, 10), (1500, 10), (500, 100), (1500, 100): two paths, added in closed form
    while read -r sum losses; do
        run_quiet tl-model --sum "$sum" --beam hat --format csv lloyd.json
        printf '%s\n' "$output" > out.csv
        # shellcheck disable=SC2046,SC2086
        assert_near 0.1 $(awk -F, 'NR > 1 { print $2, $4 }' out.csv) = $losses
    done << 'END'
coherent 50.559 68.697 48.686 66.685
incoherent 50.982 60.513 51.148 60.532
semicoherent 51.195 61.207 54.660 61.172
END
}

@test "tl-model: the table has ranges above, depths beside, two decimals, and nothing where there is no value" {
    jq '.receivers = {depth_m: [0.5, 10, 700], range_m: [0, 100, 333.25]}' lloyd.json > grid.json
    run_quiet tl-model --engine rays --format csv grid.json
    assert_line --index 0 'depth_m\range_m,0,100,333.25'
    assert_line --index 1 --regexp '^0\.5,,[0-9]+\.[0-9][0-9],[0-9]+\.[0-9][0-9]$'
    assert_line --index 2 --regexp '^10,,[0-9]+\.[0-9][0-9],[0-9]+\.[0-9][0-9]$'
    assert_line --index 3 '700,,,'
    assert_equal "${#lines[@]}" 4
}

@test "tl-model: grids of the reference cases have the reference's layout" {
    need_cases
    for case in "$cases"/p*; do
        run_quiet tl-model --engine rays --beams 300 --format csv "$case/case.json"
        gzip -dc "$case/csv/bellhop_gauss_inc.csv.gz" > reference
        assert_equal "$(head -1 <<< "$output")" "$(head -1 reference)"
        assert_equal "$(cut -d, -f1 <<< "$output")" "$(cut -d, -f1 reference)"
    done
}

@test "tl-model: an answer says what it rests on" {
    run_quiet tl-model --engine rays lloyd.json
    assert_equal "$(jq -c '[.depth_m, .range_m, (.tl_db | length), .source_depth_m, .id]' <<< "$output")" \
        '[[10,100],[500,1000,1500],6,25,null]'
    assert_equal "$(jq -c '.basis | [.engine, .sum, .beam, .absorption, .absorption_db_per_km, (.beams > 10)]' <<< "$output")" \
        '["rays","incoherent","gaussian","none",0,true]'
    tl-model --engine rays -f csv lloyd.json > out.csv
    # shellcheck disable=SC2046
    assert_near 0.0001 $(jq '.tl_db[]' <<< "$output") = $(cells out.csv)
    jq '.frequency_hz = 25120 | .water.absorption = {model: "francois-garrison", temperature_c: 10, salinity_psu: 35, ph: 8, depth_m: 0}' lloyd.json > fg.json
    run_quiet tl-model --engine rays fg.json
    # the formula's check value
    # shellcheck disable=SC2046
    assert_near 1e-5 $(jq .basis.absorption_db_per_km <<< "$output") = 5.04061
}

@test "tl-model: arrivals of a mirror are its two paths" {
    run_quiet tl-model --arrivals lloyd.json
    assert_equal "${#lines[@]}" 1
    assert_equal "$(jq -c '[.depth_m, .range_m, .columns]' <<< "$output")" \
        '[10,500,["amplitude","phase_deg","delay_s","delay_imag_s","launch_deg","arrival_deg","n_surface","n_bottom","n_caustic"]]'
    # sqrt(500² + 15²) and sqrt(500² + 35²) m at 1500 m/s; the latter by the surface
    # shellcheck disable=SC2046
    assert_near 1e-8 $(jq '.arrivals[0:2][] | .[2]' <<< "$output") = 0.3334832996 0.3341490020
    # shellcheck disable=SC2046
    assert_near 1e-6 $(jq '.arrivals[0:2][] | .[0]' <<< "$output") = 0.001999101 0.001995118
    assert_equal "$(jq -c '.arrivals[0:2][] | .[6:8]' <<< "$output" | xargs)" '[0,0] [1,0]'
    # shellcheck disable=SC2046
    assert_near 1e-4 $(jq '.arrivals[0:2][] | .[4]' <<< "$output") = -1.718358 -4.004173
    run_quiet tl-model --arrivals -f delimited lloyd.json
}

@test "tl-model: absorption of a path is the imaginary part of its delay" {
    jq '.water.absorption = {model: "fixed", db_per_km: 10}' lloyd.json > fixed.json
    run_quiet tl-model --arrivals fixed.json
    # 10 dB/km over 500.2249 m: exp(2 pi f imaginary)
    assert_near 1e-3 "$(jq '.arrivals[0] | 20 * (.[3] * 400 * 2 * 3.14159265358979 / (10 | log))' <<< "$output")" = -5.002249
    assert_near 1e-6 "$(jq '.arrivals[0][0]' <<< "$output")" = 0.001999100
}

@test "tl-model: a request says only what changed" {
    cat > requests << END
$whole
{"id":8,"source":{"depth_m":50}}
{"id":9,"source":{"depth_m":25},"receivers":{"depth_m":[100]}}
{"reset":true,"id":10}
{"id":11,"sum":"COHERENT"}
END
    run -1 --separate-stderr tl-model --engine rays requests
    assert_equal "$(jq -c '[.id, (.tl_db | length), .source_depth_m]' <<< "$output" | xargs)" \
        '[7,6,25] [8,6,50] [9,3,25] [10,0,null] [11,3,25]'
    jq -c .tl_db <<< "$output" > all
    assert_equal "$(jq -c '.[3:6]' <(sed -n 1p all))" "$(sed -n 3p all)"
    assert_equal "$(sed -n 4p <<< "$output")" '{"id":10,"error":"frequency_hz is not given"}'
    assert_equal "$stderr" 'tl-model: requests:4: frequency_hz is not given'
    # and as from a file
    tl-model --engine rays -f csv lloyd.json > out.csv
    # shellcheck disable=SC2046
    assert_near 0.011 $(sed -n 1p <<< "$output" | jq '.tl_db[]') = $(cells out.csv)
}

@test "tl-model: a bad request is answered with what is wrong, and all others are answered" {
    while IFS='|' read -r request error; do
        printf '%s\n' "$whole" "$request" '{"id":2}' > requests
        run -1 --separate-stderr tl-model --engine rays requests
        assert_equal "$(sed -n 2p <<< "$output" | jq -r .error)" "$error"
        assert_equal "$stderr" "tl-model: requests:2: $error"
        assert_equal "$(sed -n 3p <<< "$output" | jq -c .tl_db)" "$(sed -n 1p <<< "$output" | jq -c .tl_db)"
    done << 'END'
{"frequency_hz":0}|frequency_hz 0 is outside 0.1 to 10000000 Hz
{"frequency_hz":"NaN"}|frequency_hz nan is outside 0.1 to 10000000 Hz
{"source":{"depth_m":601}}|source.depth_m 601 is outside 0 to 600 m
{"bathymetry":{"range_m":[0,0],"depth_m":[600,600]}}|bathymetry.range_m[1] 0 is not more than the 0 before it
{"profile":{"depth_m":[0,1],"sound_speed_mps":[1500]}}|profile.depth_m has 2 values, profile.sound_speed_mps 1
{"profile":{"depth_m":[0],"sound_speed_mps":[15]}}|profile[0].sound_speed_mps 15 is outside 100 to 10000 m/s
{"receivers":{"ranges":{"start_m":1,"stop_m":2,"count":0}}}|receivers.ranges.count 0 is outside 1 to 100000
{"receivers":{"range_m":[1],"ranges":{"start_m":1}}}|receivers.range_m and receivers.ranges exclude each other
{"receivers":{"ranges":{"start_m":1,"stop_m":2000,"count":2000},"depths":{"start_m":1,"stop_m":500,"count":500}}}|receivers of 500 depths and 2000 ranges are 1000000 cells, which is outside 1 to 200000
{"engine":"magic"}|engine 'magic' is none of auto, rays, modes, wavenumber
{"min_amp":2}|min_amp 2 is outside 0 to 1
{"sum":"LOUD"}|sum 'LOUD' is not in enum seautils.TlRequest.Sum
{"frequenzy_hz":1}|field 'frequenzy_hz' is not in message seautils.TlRequest (did you mean 'frequency_hz'?)
{"bottom":{"grain_phi":12}}|bottom.grain_phi 12 is outside -1 to 9
{"bottom":{"layer_thickness_m":[4]}}|bottom.layer_speed_mps is not given
{"bottom":{"layer_thickness_m":[4,5],"layer_speed_mps":[1480]}}|bottom.layer_thickness_m has 2 values, bottom.layer_speed_mps 1
{"bottom":{"layer_density_gcm3":[4]}}|bottom.layer_thickness_m has 0 values, bottom.layer_density_gcm3 1
{"bottom":{"layer_thickness_m":[-4],"layer_speed_mps":[1480]}}|bottom.layers[0].thickness_m -4 is outside 0.0001 to 20000 m
{"surface":{"layer_thickness_m":[4],"layer_speed_mps":[1480]}}|surface.layer_thickness_m is for a bottom
{"surface":{"magnitude":[1],"grazing_deg":[0],"phase_deg":[]}}|surface.grazing_deg has 1 value, surface.phase_deg 0
END
}

@test "tl-model: --jobs changes nothing but the time" {
    for ((k = 1; k <= 40; k++)); do
        ((k % 7 == 3)) && echo "{\"id\":$k,\"frequency_hz\":-1}" && continue
        echo "${whole/\"id\":7/\"id\":$k}" | jq -c ".source.depth_m = $k"
    done > requests
    tl-model --engine rays requests > one 2> one.err || [[ $? == 1 ]]
    tl-model --engine rays --jobs 4 requests > four 2> four.err || [[ $? == 1 ]]
    cmp one four
    cmp one.err four.err
    assert_equal "$(jq .id one | xargs)" "$(seq 40 | xargs)"
    assert_equal "$(wc -l < one.err)" 6
}

@test "tl-model: a request is answered at once" {
    echo "$whole" > request
    tl-model --engine rays request > answer
    assert_answered_at_once request answer tl-model --engine rays
    assert_answered_at_once request answer tl-model --engine rays --jobs 3
}

@test "tl-model: binary requests and answers are what the schema declares" {
    echo "$whole" | tl-model --engine rays > answer
    cat > request.txt << 'END'
id: 7 frequency_hz: 400 source { depth_m: 25 }
receivers { depth_m: [10, 100] ranges { start_m: 500 stop_m: 1500 count: 3 } }
profile { depth_m: [0, 600] sound_speed_mps: [1500, 1500] }
bottom { sound_speed_mps: 1500 density_gcm3: 1 } bottom_depth_m: 600 fan { min_deg: -89 max_deg: 89 }
END
    protoc -I "$proto" --encode seautils.TlRequest seautils/acoustics.proto < request.txt > message
    length=$(($(wc -c < message)))
    ((length > 127 && length < 16384))
    { bytes "$(printf '%02x%02x' $((length % 128 + 128)) $((length / 128)))" && cat message; } > request.bin
    run_quiet tl-model --engine rays -F delimited request.bin
    assert_output "$(cat answer)"
    tl-model --engine rays -F delimited -f delimited request.bin > answer.bin
    # the length in front is a varint of two bytes here
    tail -c +3 answer.bin | protoc -I "$proto" --decode seautils.TlAnswer seautils/acoustics.proto > decoded
    assert_equal "$(sed -n 's/^tl_db: //p' decoded | xargs)" "$(jq '.tl_db[]' answer | xargs)"
    assert_equal "$(sed -n 's/^id: //p' decoded)" 7
}

@test "tl-model: every field of a request is understood" {
    cat > requests << END
$whole
{"id":1,"source":{"depth_m":1,"pattern_deg":[0],"pattern_db":[0],"line":false}}
{"id":2,"receivers":{"depths":{"start_m":1,"stop_m":2,"count":2},"range_m":[100]}}
{"id":3,"mesh":{"range_m":[0],"depth_m":[0],"sound_speed_mps":[1500]},"interpolation":"C_LINEAR"}
{"id":4,"water_density_gcm3":1,"absorption":{"model":"FIXED","temperature_c":1,"salinity":1,"ph":7,"depth_m":1,"db_per_km":1}}
{"id":5,"surface":{"kind":"VACUUM"},"altimetry":{"curved":false,"range_m":[0],"depth_m":[0]}}
{"id":6,"bottom":{"kind":"TABLE","shear_speed_mps":0,"attenuation_db_per_wavelength":0,"shear_attenuation_db_per_wavelength":0,"roughness_m":0,"grazing_deg":[0,90],"magnitude":[1,1],"phase_deg":[0,0]}}
{"id":7,"bottom":{"grain_phi":2},"fan":{"min_deg":-60,"max_deg":60,"beams":100}}
{"id":8,"sum":"INCOHERENT","beam":"HAT","engine":"rays","min_amp":0.01,"baffle_from_deg":0,"baffle_to_deg":0,"smooth":true,"loss":true,"arrivals":true}
{"id":9,"levels":{"source_level_db":1,"bandwidth_hz":1,"noise_db":1,"wind_mps":1,"beaufort":1,"shipping":1,"noise_fades":true,"array_gain_db":1,"threshold_db":1,"noise_depth_m":[0],"noise_at_depth_db":[1]}}
{"id":10,"bottom":{"kind":"HALF_SPACE","sound_speed_mps":1700,"layer_thickness_m":[4,10],"layer_speed_mps":[1480,1600],"layer_bottom_speed_mps":[1520,1650],"layer_density_gcm3":[1.4,1.8],"layer_attenuation_db_per_wavelength":[0.1,0.5]}}
{"id":11,"bottom":{"layer_thickness_m":[4],"layer_speed_mps":[1480]}}
END
    run_quiet tl-model --engine rays requests
    assert_equal "$(jq -c 'select(.error)' <<< "$output")" ''
    assert_equal "$(tail -1 <<< "$output" | jq -c '[(.arrivals | length), (.arrivals[0] | .delay_spread_s >= 0, .within_20db >= 1)]')" '[2,true,true]'
}

@test "tl-model: layers of the bottom count until there are none" {
    local layers='"layer_thickness_m":[3,2],"layer_speed_mps":[1600,1800],"layer_density_gcm3":[1.5,1.9]'
    cat > requests << END
$whole
{"bottom":{$layers}}
{"bottom":{"layer_attenuation_db_per_wavelength":[0,0],"layer_bottom_speed_mps":[1600,1800],$layers}}
{"bottom":{"kind":"HALF_SPACE"}}
END
    run_quiet tl-model --engine rays requests
    jq -c .tl_db <<< "$output" > losses
    [[ $(sed -n 1p losses) != "$(sed -n 2p losses)" ]] || fail 'layers count for nothing'
    assert_equal "$(sed -n 3p losses)" "$(sed -n 2p losses)"
    assert_equal "$(sed -n 4p losses)" "$(sed -n 1p losses)"
    # The same as a file says it.
    jq '.bottom.layers = [
        {"thickness_m": 3, "sound_speed_m_s": 1600, "density_g_cm3": 1.5},
        {"thickness_m": 2, "sound_speed_top_m_s": 1800, "sound_speed_bottom_m_s": 1800, "density_g_cm3": 1.9}]' \
        lloyd.json > layers.json
    run_quiet tl-model --engine rays layers.json
    assert_equal "$(jq -c .tl_db <<< "$output")" "$(sed -n 2p losses)"
}

@test "tl-model: levels give signal to noise ratios" {
    # wind of 5 m/s and half the ships at 25.12 kHz: 38.51 dB re 1 µPa²/Hz (check value); 4160 Hz are 36.19 dB
    cat > requests << END
$whole
{"frequency_hz":25120,"levels":{"source_level_db":190,"wind_mps":5,"bandwidth_hz":4160}}
{"levels":{"noise_db":50,"bandwidth_hz":1,"threshold_db":10,"array_gain_db":3}}
END
    run_quiet tl-model --engine rays requests
    assert_equal "$(head -1 <<< "$output" | jq -c .snr_db)" null
    sed -n 2p <<< "$output" > windy
    assert_near 0.01 "$(jq .noise_in_band_db windy)" = 74.70
    # shellcheck disable=SC2046
    assert_near 0.02 $(jq '.snr_db[]' windy) = $(jq '190 - .tl_db[] - 74.70' windy)
    assert_equal "$(jq -c .signal_excess_db windy)" null
    tail -1 <<< "$output" > excess
    # shellcheck disable=SC2046
    assert_near 0.011 $(jq '.signal_excess_db[]' excess) = $(jq '190 - .tl_db[] - 50 + 3 - 10' excess)
    echo "${whole/\"id\":7/\"levels\":{\"shipping\":2\}}" > requests
    assert_says 1 'requests:1: levels.shipping 2 is outside 0 to 1' tl-model requests
}

@test "tl-model: --base is known before the first request" {
    echo '{"source":{"depth_m":25}}' > request
    run_quiet tl-model --engine rays --base lloyd.json request
    assert_equal "$(jq -c .tl_db <<< "$output")" "$(tl-model --engine rays lloyd.json | jq -c .tl_db)"
    assert_says 66 'gone.json: No such file or directory' tl-model --base gone.json request
}

@test "tl-model: requests that want nothing only tell" {
    echo '{"id":1,"loss":false,"frequency_hz":400}' > requests
    jq -c 'del(.frequency_hz)' <<< "$whole" >> requests
    echo '{"id":2,"loss":true}' >> requests
    run_quiet tl-model --engine rays requests
    assert_equal "$(head -2 <<< "$output")" '{"id":1}'$'\n''{"id":7}'
    assert_equal "$(tail -1 <<< "$output" | jq -c .tl_db)" "$(tl-model --engine rays <<< "$whole" | jq -c .tl_db)"
}

@test "tl-model: a file that is wrong is refused by the field" {
    while IFS='|' read -r change what; do
        jq "$change" lloyd.json > bad.json
        assert_says 1 "bad.json: $what" tl-model bad.json
        assert_output ''
    done << 'END'
del(.water)|water is not given
.frequency_hz = "low"|frequency_hz '"low"' is not a number
.water.profile_z_c[1][1] = null|water.profile_z_c[1][1] 'null' is not a number
.source.depth_m = -2|source.depth_m -2 is outside 0 to 600 m
.bottom.type = "mud"|bottom.type 'mud' is none of pressure-release, vacuum, rigid, fluid-halfspace, elastic-halfspace, halfspace, grain-size, reflection-table
.receivers.range_m = [5, 4]|receivers.range_m[1] 4 is not more than the 5 before it
END
    echo '{"frequency_hz": 4,}' > bad.json
    assert_says 1 "bad.json: line 1 column 20: this is no JSON ('}')" tl-model bad.json
    assert_says 66 'gone.json: No such file or directory' tl-model gone.json
    jq '.tides = 3' lloyd.json > more.json
    assert_says 0 "more.json: field 'tides' is not known: left alone" tl-model --engine rays more.json
}

@test "tl-model: environments of the Acoustics Toolbox give what their cases give" {
    need_cases
    for case in p1-glint10-25k p5-beach-3k5 p6-beam-10k; do
        from=$cases/$case
        run_quiet tl-model --engine rays --beams 300 -f csv "$from/case.json"
        printf '%s\n' "$output" > case.csv
        run_quiet tl-model --engine rays --beams 300 -f csv "$from/env/bellhop_gauss_inc.env"
        printf '%s\n' "$output" | diff case.csv -
        run_quiet tl-model --engine rays --arrivals "$from/env/arrivals.env"
        assert_equal "$output" "$(tl-model --engine rays --arrivals "$from/case.json")"
    done
}

# lloyd_env RUNTYPE: the mirror as an environment of the Acoustics Toolbox, with two sources.
lloyd_env() {
    printf '%s\n' "'Lloyd'" 400 1 "'CVW'" '0 0.0 600' '0 1500 /' '600 1500 /' "'A' 0" '600 1500 0 1 0 /' \
        2 '25 50 /' 2 '10 100 /' 3 '0.5 1.5 /' "'$1'" 0 '-89 89 /' '0 606 1.6' > lloyd.env
}

@test "tl-model: an .env with two sources is answered for each" {
    lloyd_env IB
    run_quiet tl-model lloyd.env
    assert_equal "$(jq -c '[.source_depth_m, (.tl_db | length)]' <<< "$output" | xargs)" '[25,6] [50,6]'
    assert_equal "$(head -1 <<< "$output" | jq -c .tl_db)" "$(tl-model --engine rays lloyd.json | jq -c .tl_db)"
    lloyd_env XB
    assert_says 1 "lloyd.env: line 16: RUNTYPE 'XB     ': letter 1 is none of C, S, I, A, a, E" tl-model lloyd.env
    lloyd_env 'IB*'
    assert_says 1 'lloyd.env: RUNTYPE asks for a .sbp file, which is not there' tl-model lloyd.env
    lloyd_env IB
    sed -i 's/^25 50/-1 50/' lloyd.env
    assert_says 0 'lloyd.env: depths outside of the water are put at its boundary' tl-model lloyd.env
}

@test "tl-model: .shd files have the layout of their year" {
    lloyd_env CG
    tl-model -f csv lloyd.env > out.csv
    for year in 2022 2023; do
        tl-model -f shd --shd-format $year lloyd.env > out.shd
        # records of 41 words: 10 of them, and one for each source and depth
        assert_equal "$(wc -c < out.shd)" $((14 * 164))
        assert_equal "$(od -An -td4 -N4 out.shd | xargs)" 41
        assert_equal "$(head -c 174 out.shd | tail -c 10)" 'rectilin  '
        assert_equal "$(od -An -td4 -j328 -N28 out.shd | xargs)" '1 1 1 1 2 2 3'
        assert_equal "$(od -An -tf4 -j$((7 * 164)) -N8 out.shd | xargs)" '25 50'
        assert_equal "$(od -An -tf4 -j$((8 * 164)) -N8 out.shd | xargs)" '10 100'
        [[ $year == 2022 ]] && form='-tf4 -N12' || form='-tf8 -N24'
        # shellcheck disable=SC2086
        assert_equal "$(od -An $form -j$((9 * 164)) out.shd | xargs)" '500 1000 1500'
        # shellcheck disable=SC2046
        assert_near 0.006 $(for ((row = 10; row < 14; row++)); do od -An -v -tf4 -w8 -j$((row * 164)) -N24 out.shd; done |
            awk '{ print -10 * log($1 * $1 + $2 * $2) / log(10) }') = $(grep -v depth_m out.csv | cut -d, -f2- | tr , ' ')
    done
    assert_says 64 'option --format: shd is for CASE.json and .env files' tl-model -f shd
    assert_says 64 "option --shd-format: '2024' is none of 2022, 2023" tl-model -f shd --shd-format 2024 lloyd.env
}

@test "tl-model: .arr files are as the Acoustics Toolbox writes them" {
    lloyd_env AG
    run_quiet tl-model -f arr lloyd.env
    assert_equal "$(head -5 <<< "$output" | xargs -d '|')" "'2D'
400
2 25 50
2 10 100
3 500 1000 1500"
    # the first path of the first receiver is the straight one
    # shellcheck disable=SC2046
    assert_near 1e-7 $(sed -n 8p <<< "$output" | awk '{ print $1, $3, $7, $8 }') = 0.0019991005 0.3334833 0 0
    tl-model -f arr-binary lloyd.env > out.arr
    assert_equal "$(od -An -td4 -j20 -N4 out.arr | xargs)" 4
    assert_equal "$(head -c 8 out.arr | tail -c 4)" "'2D'"
}

@test "tl-model: --smooth averages intensity" {
    jq '.receivers.depth_m = {start: 20, stop: 24, count: 5} | .receivers.range_m = {start: 500, stop: 508, count: 9}' lloyd.json > grid.json
    tl-model --engine rays --sum coherent -f csv grid.json > rough.csv
    tl-model --engine rays --sum coherent --smooth -f csv grid.json > smooth.csv
    mean=$(cells rough.csv | awk '{ for (i = 1; i <= NF; i++) s += 10 ^ (-$i / 10) } END { print -10 * log(s / NF) / log(10) }')
    # the middle has all 5 by 9 cells around it
    assert_near 0.02 "$(awk -F, 'NR == 4 { print $6 }' smooth.csv)" = "$mean"
}

@test "tl-model: --plot draws" {
    command -v gnuplot > /dev/null || skip 'no gnuplot'
    run_quiet tl-model --engine rays -f csv --plot loss.svg lloyd.json
    assert_line --index 0 'depth_m\range_m,500,1000,1500'
    grep -q 'transmission loss, dB re 1 m' loss.svg
    grep -q 'sound speed, m/s' loss.svg
    run_quiet tl-model --engine rays -f csv --plot rays.svg --rays 9 lloyd.json
    assert [ "$(grep -c '<path' rays.svg)" -ge "$(($(grep -c '<path' loss.svg) + 9))" ]
    assert_says 64 'option --rays needs --plot' tl-model --engine rays --rays 9 lloyd.json
    run_quiet tl-model --engine rays --arrivals --plot arrivals.png lloyd.json
    assert_equal "$(head -c 4 arrivals.png | tail -c 3)" PNG
    assert_says 64 "option --plot: 'a.gif' ends neither in .png nor .svg" tl-model --plot a.gif lloyd.json
    mkdir bare
    assert_says 69 'option --plot needs gnuplot (package gnuplot-nox)' \
        env PATH="$PWD/bare" "$(command -v tl-model)" --engine rays --plot a.svg lloyd.json
}

@test "tl-model: an engine of others that behaves is taken at its word" {
    tl-model --engine rays --beam hat -f shd lloyd.json > good.shd
    tl-model --engine rays --arrivals -f arr lloyd.json > good.arr
    stand_in bellhop 'cp "$here/good.shd" "$1.shd"; cp "$here/good.arr" "$1.arr"; cp "$1.env" "$here/fed.env"'
    run_quiet tl-model --engine bellhop -f csv lloyd.json
    assert_output "$(tl-model --engine rays --beam hat -f csv lloyd.json)"
    assert_equal "$(tl-model --engine bellhop lloyd.json | jq -r .basis.engine)" bellhop
    # it was fed the same sea
    assert_equal "$(tl-model --engine rays -f csv fed.env)" "$(tl-model --engine rays -f csv lloyd.json)"
    run_quiet tl-model --engine bellhop --arrivals lloyd.json
    assert_equal "$(jq -c '[.arrivals[] | .[6:8]] | .[0:2]' <<< "$output")" '[[0,0],[1,0]]'
}

@test "tl-model: an engine of others that misbehaves is not" {
    tl-model --engine rays -f shd lloyd.json > good.shd
    stand_in bellhop 'cp "$here/good.shd" sea.shd; printf "*** FATAL ERROR ***\nGenerated by program: BELLHOP\n"> sea.prt'
    assert_says 1 "lloyd.json: bellhop failed: 'Generated by program: BELLHOP'" tl-model --engine bellhop lloyd.json
    assert_output ''
    stand_in bellhop 'cp "$here/good.shd" sea.shd; exit 2'
    assert_says 1 'lloyd.json: bellhop ended with status 2' tl-model --engine bellhop lloyd.json
    stand_in bellhop 'head -c 1000 "$here/good.shd" > sea.shd'
    assert_says 1 'lloyd.json: bellhop: its result is not as it should be: it is cut at byte 1000' tl-model --engine bellhop lloyd.json
    stand_in bellhop 'sleep 60'
    assert_says 1 'lloyd.json: bellhop did not end within 0.2 s' tl-model --engine bellhop --engine-timeout 0.2 lloyd.json
    assert_says 1 'lloyd.json: kraken: no such program is installed' tl-model --engine kraken lloyd.json
    stand_in bellhop '[ "$(ulimit -v)" = 65536 ] && cp "$here/good.shd" sea.shd'
    run_quiet tl-model --engine bellhop --engine-memory 64 lloyd.json
}

# A stand-in for OAST: it finds depths and frequency in what it is fed, and leaves plots of Lloyd's mirror over range,
# as the guide of OASES has them.
oast() { # [SCRIPT]: what is done behind it
    stand_in oast 'cp sea.dat "$here/fed.dat"
awk "
NR == 3 { k = 6.283185307179586 * \$1 / 1500 }
NR > 4 && NF == 1 && !source { source = \$1; next }
source && NF == 4 && !count { first = \$1; last = \$2; count = \$3 }
END {
    print 128, \"MODULO\" > \"sea.plp\"
    for (i = 0; i < count; i++) {
        depth = count > 1 ? first + (last - first) * i / (count - 1) : first
        printf \" OAST  STLRAN\\n LOSS\\n t\\n 1 LABELS\\n RD: %.1f m\$\\n 20\\n 12\\n 0\\n 0\\n 2\\n 1\\n 1\\n Range (km)\$\\n LIN\\n\", depth > \"sea.plp\"
        printf \" 80\\n 20\\n 10\\n 1\\n Normal stress (dB//1Pa)\$\\n LIN\\n 1 NC\\n 601 N\\n 0.1 XMIN\\n 0.25-002 DX\\n 0 YMIN\\n 0 DY\\n\" > \"sea.plp\"
        for (n = 0; n < 601; n++) {
            r = 100 + 2.5 * n
            up = sqrt(r * r + (depth - source) ^ 2); down = sqrt(r * r + (depth + source) ^ 2)
            re = cos(k * up) / up - cos(k * down) / down; im = sin(k * up) / up - sin(k * down) / down
            printf \"%15.6E\\n\", -10 * log(re * re + im * im) / log(10) > \"sea.plt\"
        }
    }
    print \" OAST  PLTEND\" > \"sea.plp\"
}" sea.dat
'"${1-}"
}

@test "tl-model: OAST of OASES, where it behaves and where not" {
    oast
    run_quiet tl-model --engine oases --sum coherent -f csv lloyd.json
    # its curves are those of the closed form: 50.559 dB at 500 m and 10 m, 68.697 at 1500 m
    assert_near 0.02 "$(sed -n 2,3p <<< "$output" | cut -d, -f2,4 | tr ',\n' '  ')" = 50.559 68.697 48.686 66.685
    assert_equal "$(sed -n 2p fed.dat)" 'N T J'
    # depths that are not evenly spaced: one by one
    jq '.receivers.depth_m = [10, 30, 100, 700]' lloyd.json > depths.json
    run_quiet tl-model --engine oases --sum coherent -f csv depths.json
    assert_equal "$(sed -n 2p <<< "$output" | cut -d, -f2)" 50.56
    assert_equal "$(sed -n 5p <<< "$output")" 700,,,
    assert_says 1 'lloyd.json: oases adds coherently alone (--sum coherent)' tl-model --engine oases lloyd.json
    local what
    while IFS='|' read -r script what; do
        oast "$script"
        assert_says 1 "lloyd.json: $what" tl-model --engine oases --sum coherent lloyd.json
    done << 'END'
rm sea.plt|oast left no result
rm sea.plp|oast: its result is not as it should be: the .plp file: line 1: it ends where MODULO is expected
head -n 700 sea.plt > cut; mv cut sea.plt|oast: its result is not as it should be: the .plt file: it ends before value 701
sed -i '5s/.*/ NaN/' sea.plt|oast: its result is not as it should be: the .plt file: value 5: 'NaN' is not a number
sed -i 's/Range (km)/Depth (m)/' sea.plp|oast: its result has 0 plots over range in place of 2
sed -i 's/0.25-002/0.10-002/' sea.plp|oast: its curves end at 0.7 km, before 1 km
exit 3|oast ended with status 3
END
}

@test "tl-model: nothing of a run by others is left behind" {
    mkdir tmp
    stand_in bellhop 'touch sea.shd other; mkdir deep; touch deep/file; exit 1'
    TMPDIR=$PWD/tmp run -1 tl-model --engine bellhop lloyd.json
    assert_equal "$(ls tmp)" ''
}

@test "tl-model: a signal ends the engine of others, too, and leaves nothing" {
    mkdir tmp
    stand_in bellhop 'echo $$ > "$here/pid.new"; mv "$here/pid.new" "$here/pid"; sleep 60'
    jq -c '{id: 1}' <<< '{}' > request.ndjson
    for name in TERM INT HUP; do
        rm -f pid
        (
            trap - INT
            TMPDIR=$PWD/tmp exec tl-model --engine bellhop lloyd.json
        ) &
        until [[ -s pid ]]; do sleep 0.02; done
        assert_equal "$(find tmp -mindepth 1 -maxdepth 1 | wc -l)" 1
        kill "-$name" $!
        # a shell in the background makes its children ignore SIGINT: then it is left to end as it would
        [[ $name == INT ]] && kill -TERM $! 2> /dev/null
        wait $! && fail "it ended as if nothing had been"
        assert_equal "$(ls tmp)" ''
        ! kill -0 "$(cat pid)" 2> /dev/null || fail 'the engine still runs'
    done
    # of a stream of requests as of a file
    rm -f pid
    TMPDIR=$PWD/tmp tl-model --base lloyd.json --engine bellhop request.ndjson > /dev/null 2>&1 &
    until [[ -s pid ]]; do sleep 0.02; done
    kill $!
    wait $! && fail "it ended as if nothing had been"
    assert_equal "$(ls tmp)" ''
}

# --- receivers that are pairs ---

# a track through Lloyd's field: back and forth, one receiver twice
track='"depth_m":[100,10,100,10],"range_m":[1000,500,1500,500]'

@test "tl-model: pairs of receivers have the grid's losses, in their order" {
    tl-model --engine rays -f csv lloyd.json > grid.csv
    jq -c ".receivers = {$track, layout: \"irregular\"}" lloyd.json > track.json
    run_quiet tl-model --engine rays -f csv track.json
    assert_output "range_m,depth_m,loss_db
1000,100,$(sed -n 3p grid.csv | cut -d, -f3)
500,10,$(sed -n 2p grid.csv | cut -d, -f2)
1500,100,$(sed -n 3p grid.csv | cut -d, -f4)
500,10,$(sed -n 2p grid.csv | cut -d, -f2)"
    tail -n +2 <<< "$output" | cut -d, -f3 | xargs > wanted
    # the same by requests, where pairs stay pairs until something else is said
    printf '%s\n' "$whole" "{\"receivers\":{\"pairs\":true,$track}}" '{"receivers":{"depth_m":[10,100,10,100]}}' \
        '{"receivers":{"pairs":false,"depth_m":[10],"range_m":[500]}}' '{"receivers":{"pairs":true,"range_m":[1,2]}}' > asked
    run -1 --separate-stderr tl-model --engine rays asked
    assert_equal "$(jq -c '[.pairs, (.tl_db | length)]' <<< "$output" | xargs)" '[null,6] [true,4] [true,4] [null,1] [null,0]'
    assert_equal "$(jq -r 'select(.pairs) | .tl_db[]' <<< "${lines[1]}" | xargs printf '%.2f ')" "$(cat wanted) "
    assert_equal "$stderr" 'tl-model: asked:5: receivers.depth_m has 1 value, receivers.range_m 2, which are no pairs'
    assert_says 1 'track.json: smooth is for a grid of receivers, not for pairs' tl-model --smooth track.json
}

@test "tl-model: pairs in files of the Acoustics Toolbox, and to others' engines" {
    jq -c ".receivers = {$track, layout: \"irregular\"} | del(.arrivals)" lloyd.json > track.json
    tl-model --engine rays --beam hat -f csv track.json > wanted.csv
    tl-model --engine rays --beam hat -f shd track.json > shd
    assert_equal "$(od -An -j164 -N10 -c shd | tr -d ' ')" irregular
    assert_equal "$(od -An -j1640 -N32 -tf4 shd | xargs -n2 | awk '{ printf "%.2f ", -20 * log($1) / log(10) }')" \
        "$(tail -n +2 wanted.csv | cut -d, -f3 | xargs) "
    run_quiet tl-model --arrivals -f arr track.json
    assert_equal "$(sed -n '4,5p' <<< "$output")" $'4 100 10 100 10\n4 1000 500 1500 500'
    run_quiet tl-model --arrivals track.json
    assert_equal "$(jq -c '[.range_m, .depth_m, (.arrivals | length)]' <<< "$output" | xargs)" '[1000,100,2] [500,10,2] [1500,100,2] [500,10,2]'
    # BELLHOP wants growing ranges, and gets them
    assert_says 1 'track.json: bellhop takes pairs of receivers at ranges that differ: 500 m is there twice' tl-model --engine bellhop track.json
    jq -c '.receivers |= (.depth_m |= .[0:3] | .range_m |= .[0:3])' track.json > three.json
    jq -c '.receivers |= (.depth_m = [10, 100, 100] | .range_m |= sort)' three.json > sorted.json
    tl-model --engine rays --beam hat -f shd sorted.json > good.shd
    tl-model --arrivals -f arr sorted.json > good.arr
    stand_in bellhop 'cp "$here/good.shd" "$1.shd"; cp "$here/good.arr" "$1.arr"; cp "$1.env" "$here/fed.env"'
    run_quiet tl-model --engine bellhop -f csv three.json
    assert_output "$(head -n 4 wanted.csv)"
    assert_equal "$(grep -c "^'IB.*I'" fed.env)" 1
    assert_equal "$(tl-model --engine rays --beam hat -f csv fed.env)" "$(tl-model --engine rays --beam hat -f csv sorted.json)"
    assert_equal "$(tl-model --engine bellhop --arrivals three.json | jq -c .range_m | xargs)" '1000 500 1500'
    assert_says 1 "three.json: engine 'kraken' takes no receivers that are pairs" tl-model --engine kraken three.json
    tl-model --engine rays -f shd lloyd.json > good.shd
    run -1 --separate-stderr tl-model --engine bellhop three.json
}

@test "tl-model: a hundred thousand pairs take a bounded time" {
    skip_if_sanitized "time and memory are not those of a release"
    awk 'BEGIN { printf "{\"layout\":\"irregular\",\"depth_m\":[1"; for (k = 1; k < 100000; k++) printf ",%.3f", 300 + 290 * sin(k / 7000)
        printf "],\"range_m\":[1"; for (k = 1; k < 100000; k++) printf ",%.2f", 100 + k / 10; print "]}" }' > receivers
    jq -c --slurpfile r receivers '.receivers = $r[0]' lloyd.json > long.json
    run -0 bash -c "/usr/bin/env time -f '%U %M' tl-model --engine rays -f csv long.json 2>&1 > got"
    read -r seconds kib <<< "$output"
    assert_equal "$(wc -l < got)" 100001
    assert [ "$kib" -le 262144 ]
    [[ $(awk "BEGIN { print ($seconds < 60) }") == 1 ]] || fail "$seconds s"
}

@test "tl-model: options that are wrong" {
    while IFS='|' read -r options what; do
        # shellcheck disable=SC2086
        assert_says 64 "$what" tl-model $options lloyd.json
    done << 'END'
--sum loud|option --sum: 'loud' is none of incoherent, semicoherent, coherent
--beam laser|option --beam: 'laser' is none of gaussian, hat
--engine magic|option --engine: 'magic' is none of auto, rays, modes, wavenumber, bellhop, bellhopcxx, kraken, krakenc, scooter, oases
--threads 0|option --threads: '0' is outside 1 to 64
--beams x|option --beams: 'x' is outside 1 to 1000000
--min-amp 2|option --min-amp: '2' is outside 0 to 1
--arrivals --format csv|option --arrivals: format csv holds losses
END
}

@test "tl-model: a full disk is status 74; the end of a reader ends it" {
    run -74 --separate-stderr bash -c 'tl-model --engine rays lloyd.json > /dev/full'
    assert_equal "$stderr" 'tl-model: write failed: No space left on device'
    run -0 bash -c "for k in \$(seq 3000); do echo '$whole'; done | tl-model --engine rays | head -1 | jq .id"
    assert_output 7
}

@test "tl-model: memory does not grow with the requests" {
    skip_if_sanitized "what is freed is held there for a while"
    # receivers that move, now and then another source, now and then what is refused
    windows() {
        awk -v to="$1" -v whole="$whole" 'BEGIN { print whole; for (k = 1; k < to; ++k)
            printf "{\"source\":{\"depth_m\":%d},\"receivers\":{\"range_m\":[%d,%d]}}\n",
                k % 500 == 7 ? -5 : 20 + int(k / 100) % 12, 100 + k * 7 % 900, 1100 + k * 7 % 90 }'
    }
    most_kb() { # REQUESTS: the most memory that they took
        windows "$1" > requests
        /usr/bin/time -f %M -o most "$SEAUTILS_BIN/tl-model" -q requests > answers || true
        assert_equal "$(wc -l < answers)" "$1"
        tail -n 1 most
    }
    [[ -x /usr/bin/time ]] || skip "time is not installed"
    local few many
    few=$(most_kb 2000)
    many=$(most_kb 20000)
    echo "$few kB for 2000, $many kB for 20000"
    ((few > 1000 && many < few + 1024))
}
