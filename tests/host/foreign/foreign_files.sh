#!/bin/sh
# Maps that are not whole, options that do not belong together, and nothing half written.
#   foreign_files.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
cd "$source_dir" || exit 1

printf 'order,amplitude_Nm,phase_rad\n0,0,0\n' >"$work/zero.csv"
run 0 solve data/machine_a --target "$work/zero.csv" --auto -q -o "$work/zero"
run 0 solve data/machine_a --target data/scenarios/02/target.csv --auto -q -o "$work/loaded"

emit() {
    code=$1
    shift
    run "$code" emit "$work/zero" --name map --machine data/machine_a -o "$work/out" "$@"
}

# same FILE FILE: the same bytes
same() {
    cmp -s "$1" "$2"
}

# ---- options

run 2 emit "$work/zero" --name map --for moteus -o "$work/out"
says '--for TARGET needs --machine FOLDER'
emit 2 --for moteus --format i16
says 'the form of a map --for TARGET is that of the drive'
emit 2 --for moteus --drive data/drive/machine_a_10kHz.csv
says 'give one of them'
emit 2 --for moteus --points 512
says 'leave out --points'
run 2 emit "$work/loaded" --name map --machine data/machine_a -o "$work/out" --for moteus --per-torque
says 'leave out --per-torque'
emit 2 --for moteus --encoder-direction 0
says 'expected one of: 1, -1|expected .*1.*-1'
run 2 emit "$work/zero" --name map --encoder-offset 3 -o "$work/out"
says 'go with --for TARGET'
check "files without a map" [ ! -e "$work/out" ]

# ---- a machine that i_q alone cannot serve

mkdir "$work/steep" && cp data/machine_a/*.csv "$work/steep" && printf 'order,amplitude_V,phase_rad\n1,10,0\n5,12,0\n' >"$work/steep/back_emf.csv"
run 3 emit "$work/zero" --name map --machine "$work/steep" --for moteus -o "$work/out"
says 'i_q alone cannot cancel the ripple of this machine'
check "files of a map that cannot be" [ ! -e "$work/out" ]

# ---- moteus: the same request, the same bytes; what a dump lacks

emit 0 --for moteus && cp "$work/out/map.cfg" "$work/map.cfg"
emit 0 --for moteus
check "the same request gives other bytes" same "$work/map.cfg" "$work/out/map.cfg"

harmonics() {
    code=$1
    shift
    run "$code" harmonics "$@" --quantity cogging --pole-pairs 2 --torque-constant 0.2094
}

grep -v 'comp\.77 ' "$work/map.cfg" >"$work/gap.cfg"
harmonics 3 "$work/gap.cfg"
says 'found no motor.cogging_dq_comp.77' 'moteus_tool --dump-config'
grep -v scale "$work/map.cfg" >"$work/unscaled.cfg"
harmonics 3 "$work/unscaled.cfg"
says 'found no motor.cogging_dq_scale'
sed 's/comp\.5 .*/comp.5 128/' "$work/map.cfg" >"$work/large.cfg"
harmonics 3 "$work/large.cfg"
says 'found motor.cogging_dq_comp.5 128'
sed 's/^# encoder_direction.*/# encoder_direction 0/' "$work/map.cfg" >"$work/turned.cfg"
harmonics 3 "$work/turned.cfg"
says 'found encoder_direction 0, expected 1 or -1'

# a dump has other settings about it, and "conf set" stands before each line of a script
{
    printf 'clock.hsitrim 64\nmotor.poles 4\n'
    grep -v '^#' "$work/map.cfg"
    printf 'servo.pid_dq.kp 0.05\n'
} >"$work/dump.txt"
sed -n 's/^motor/conf set &/p' "$work/map.cfg" >"$work/commands.txt"
harmonics 0 "$work/map.cfg" --json && cp "$work/stdout" "$work/read"
for form in dump.txt commands.txt; do
    harmonics 0 "$work/$form" --json
    check "$form is read as another map" same "$work/read" "$work/stdout"
done
harmonics 0 "$work/map.cfg"
says 'a map of moteus, read as the recording of a shaft that its currents hold'

# ---- the other tables: what they lack

emit 0 --for novanta && cp "$work/out/map.csv" "$work/novanta.csv"
sed '/^300,/d' "$work/novanta.csv" >"$work/gap.csv"
harmonics 3 "$work/gap.csv"
says 'found `301,.*expected the indices 0 to 511'
echo '512,0' | cat "$work/novanta.csv" - >"$work/long.csv"
harmonics 3 "$work/long.csv"
says 'found `512,0`'

emit 0 --for beckhoff && cp "$work/out/map.csv" "$work/beckhoff.csv"
grep -v ',0x0A,' "$work/beckhoff.csv" >"$work/gap.csv"
harmonics 3 "$work/gap.csv"
says 'found no value at 0x32CB:0A'
sed 's/^\(0x32CB,0x07,UINT32\),[0-9]*/\1,201/' "$work/beckhoff.csv" >"$work/large.csv"
harmonics 3 "$work/large.csv"
says 'found 201 at 0x32CB:07'
# halved by the gain, or shifted by a quarter of a turn
harmonics 0 "$work/beckhoff.csv" --orders 12 --json
awk -F'[:,]' '/"amplitude"/ { print $2 }' "$work/stdout" >"$work/whole"
sed 's/^\(0x32CB,0x02,REAL32\),1/\1,0.5/' "$work/beckhoff.csv" >"$work/half.csv"
harmonics 0 "$work/half.csv" --orders 12 --json
check "the gain is not read" awk -F'[:,]' -v whole="$(cat "$work/whole")" '/"amplitude"/ { r = $2 / whole; exit !(r > 0.4999 && r < 0.5001) }' "$work/stdout"
sed 's/^# wave sine$/# wave cosine/' "$work/beckhoff.csv" >"$work/cosine.csv"
harmonics 0 "$work/beckhoff.csv" --orders 12 --json
awk -F'[:,]' '/"phase_rad"/ { print $2 }' "$work/stdout" >"$work/sine"
harmonics 0 "$work/cosine.csv" --orders 12 --json
check "the wave is not read" awk -F'[:,]' -v sine="$(cat "$work/sine")" '/"phase_rad"/ { turn = cos($2 - sine - 1.5707963); exit !(turn > 0.999999) }' "$work/stdout"

emit 2 --for openffboard
says 'add --counts-per-ampere N'
emit 2 --for moteus --counts-per-ampere 3
says 'leave out --counts-per-ampere'
emit 2 --for moteus --wave cosine
says 'leave out --wave'
emit 0 --for openffboard --counts-per-ampere 400 && cp "$work/out/map.txt" "$work/openffboard.txt"
harmonics 0 "$work/openffboard.txt" --json && cp "$work/stdout" "$work/read"
{
    echo '# counts_per_ampere 400'
    printf '[tmc.0.coggingHarmonics?|%s]\n' "$(grep -v '^#' "$work/openffboard.txt")"
} >"$work/answer.txt"
harmonics 0 "$work/answer.txt" --json
check "what a board answers is read as another map" same "$work/read" "$work/stdout"
# A board answers in whole counts and milliradians.
harmonics 0 "$work/openffboard.txt" --orders 12 --json
awk -F'[:,]' '/"amplitude"/ { print $2 } /"phase_rad"/ { print $2 }' "$work/stdout" >"$work/exact"
{
    echo '# counts_per_ampere 400'
    grep -v '^#' "$work/openffboard.txt" | tr ',' '\n' | awk -F: '{ printf("%s%d:%d:%d", (NR > 1) ? "," : "", $1, $2, 1000 * $3) } END { print "" }'
} >"$work/whole.txt"
harmonics 0 "$work/whole.txt" --orders 12 --json
awk -F'[:,]' '/"amplitude"/ { print $2 } /"phase_rad"/ { print $2 }' "$work/stdout" | paste "$work/exact" - >"$work/both"
check "an answer in milliradians is read as another map" awk '{ d = $1 - $2; if (d < 0) d = -d; if (d > 0.003) exit 1 } END { exit NR != 2 }' "$work/both"
grep -v '^#' "$work/openffboard.txt" >"$work/bare.txt"
harmonics 3 "$work/bare.txt"
says 'found no comment `counts_per_ampere N`'

emit 2 --for csv --points 500
says 'expected a power of two'
emit 0 --for csv --points 64 && cp "$work/out/map.csv" "$work/table.csv"
sed '20d' "$work/table.csv" >"$work/gap.csv"
harmonics 3 "$work/gap.csv"
says 'in equal steps of one turn from 0'

# ---- code: what the tables of the source lack

run 0 emit "$work/loaded" --name map --machine data/machine_a -o "$work/out" --for st-mcsdk --counts-per-ampere 600 --per-torque
cp "$work/out/map.h" "$work/map.h"
harmonics 0 "$work/map.h"
says 'a map of st-mcsdk'
grep -v counts_per_ampere "$work/map.h" >"$work/bare.h"
harmonics 3 "$work/bare.h"
says 'found no comment `counts_per_ampere N`'
sed '40d' "$work/map.h" >"$work/gap.h"
harmonics 3 "$work/gap.h"
says 'a power of two of them'
sed '40s/, [-0-9]*}/}/' "$work/map.h" >"$work/torn.h"
harmonics 3 "$work/torn.h"
says 'expected rows'
emit 0 --for simplefoc && cp "$work/out/map.h" "$work/simple.h"
harmonics 0 "$work/simple.h"
check "two columns" grep -q 'map_table\[256\]\[2\]' "$work/simple.h"
emit 2 --for simplefoc --points 300
says 'expected a power of two from 8 to 4096'

# counts that are too many for 16 bits are cut, and that is said
emit 0 --for st-mcsdk --counts-per-ampere 20000
says 'cut +[0-9]+ values that are too large for it'

# ---- figures: sine and map at one mean torque, whatever constant the drive has; counts that end before it

for target in novanta 'st-mcsdk --counts-per-ampere 600 --per-torque'; do
    for constant in '' '--torque-constant 0.3'; do
        # shellcheck disable=SC2086
        run 0 emit "$work/loaded" --name map --machine data/machine_a -o "$work/out" --for $target $constant --json
        awk -F'[:,]' '/sine_peak/ { print $2 }' "$work/stdout" >"$work/sine$constant"
        awk -F'[:,]' '/"map_mean_Nm"/ && (d = $2 - m) * d > 1e-6 { bad = 1 } /"torque_Nm"/ { m = $2 } END { exit bad }' "$work/stdout"
        check "$target $constant: another mean torque" [ $? -eq 0 ]
    done
    check "$target: the sine depends on the constant of the drive" awk 'NR == FNR { v[FNR] = $1; next } { d = v[FNR] - $1; if (d * d > 1e-10) bad = 1 }
        END { exit bad || FNR != 3 }' "$work/sine" "$work/sine--torque-constant 0.3"
done
for target in 'openffboard --counts-per-ampere 3277' 'st-mcsdk --counts-per-ampere 1e9'; do
    # shellcheck disable=SC2086
    run 0 emit "$work/loaded" --name map --machine data/machine_a -o "$work/out" --for $target
    says 'at +2.463 N·m +3.778 +not reached' 'note: the torque 2.463 N·m is not reached'
    check "$target: not in the file" grep -q '2.463 N\*m is not reached: the counts of the drive end at' "$work/out/map.$([ "${target%% *}" = st-mcsdk ] && echo h || echo txt)"
done
run 0 emit "$work/loaded" --name map --machine data/machine_a -o "$work/out" --for csv --points 8
says 'with this map the ripple at 2.463 N·m is larger than without: 4.678 N·m and 3.778 N·m'
run 0 emit "$work/loaded" --name map -o "$work/out" --points 7
says 'the table is off by up to .* of the peak current: give it more --points'
run 0 emit "$work/loaded" --name map -o "$work/out"
check "a remark on a good table" eval "! grep -q 'off by up to' '$work/stderr'"

# ---- read by the other commands

run 0 predict data/machine_a "$work/map.cfg" --json
check "the machine is not held by the map" awk -F'[:,]' '/"worst_Nm"/ { found = $2 + 0 } END { exit !(found > 0 && found < 0.02) }' "$work/stdout"
run 0 check data/machine_a "$work/map.cfg" --json
finish
