#!/bin/sh
# `solve` with effects.csv: what a machine that saturates gets, what is left out, and what the temperature does.
#   cli_solve_effects.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
cd "$source_dir" || exit 1

printf 'order,amplitude_Nm,phase_rad\n0,8,0\n' >"$work/target.csv"
cell() { awk -F, -v row="$2" -v column="$3" 'NR == row { print $column }' "$1"; }

# ---- machine C as finite elements have it: another current than with the inductance at no load, and no ripple

run 0 solve data/machine_c_saturated --target "$work/target.csv" -q -o "$work/new"
nothing_on_stdout
run 0 solve data/machine_c --target "$work/target.csv" -q -o "$work/old"
awk -F, 'FNR == 1 { next } NR == FNR { a[FNR] = $2; next } FNR in a { d = a[FNR] - $2; if (d * d > most) most = d * d }
    END { exit !(most > 0.04) }' "$work/new/waveform.csv" "$work/old/waveform.csv"
check "saturation changes no current by 0.2 A" [ $? -eq 0 ]
awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) n[$k] = k; next } { d = $n["torque_Nm"] - 8; if (d * d > 1e-8) bad = 1 } END { exit bad }' \
    "$work/new/waveform.csv"
check "the torque of waveform.csv is not 8 N·m" [ $? -eq 0 ]
check "parts of a current that has none" [ ! -e "$work/new/currents_per_Nm.csv" ]

# ---- effects on the bench are left out, and that is said

cp -r data/machine_a "$work/bench"
printf 'effect,parameter,value,unit,std_error\nposition_offset,angle,2,deg,\ncurrent_offset,a,0.1,A,\nfriction,coulomb,0.2,Nm,\n' >"$work/bench/effects.csv"
run 0 solve "$work/bench" --target data/scenarios/02/target.csv -o "$work/with_bench"
says 'effects.csv: not compensated, since it acts on the shaft or in a sensor and not in the machine: .*position_offset.*true angle'
run 0 solve data/machine_a --target data/scenarios/02/target.csv -q -o "$work/without_bench"
check "effects on the bench change the currents" cmp -s "$work/without_bench/currents.csv" "$work/with_bench/currents.csv"

# ---- hot magnets: linear, so the current grows as the back-EMF falls

cp -r data/machine_a "$work/hot"
rm -f "$work/hot/cogging.csv"
printf 'effect,parameter,value,unit,std_error\nmagnet_temperature,emf_per_kelvin,-0.001,1/K,\n' >"$work/hot/effects.csv"
run 0 solve "$work/hot" --target data/scenarios/02/target.csv -q -o "$work/at20"
run 0 solve "$work/hot" --target data/scenarios/02/target.csv --temperature 120 -o "$work/at120"
grep -q 'temperature changes nothing' "$work/stderr"
check "a temperature that is used is said to change nothing" [ $? -ne 0 ]
check "the current at 120 °C is not that at 20 °C divided by 0.9" awk -v cold="$(cell "$work/at20/currents.csv" 2 3)" \
    -v hot="$(cell "$work/at120/currents.csv" 2 3)" 'BEGIN { d = 0.9 * hot / cold - 1; exit !(d * d < 1e-18) }'
check "hot magnets have no linear parts" [ -s "$work/at120/currents_per_Nm.csv" ]

# ---- what the real machine will do: not known, known from what recordings leave open, and of another machine

run 0 solve data/machine_a --target data/scenarios/02/target.csv --temperature 80 -o "$work/declared"
says 'not known: no recordings' 'note: --temperature changes nothing'
grep -q '"T_ripple_percent_95":[[:space:]]*null' "$work/declared/summary.json" && grep -q '"known":[[:space:]]*false' "$work/declared/summary.json"
check "a figure without recordings" [ $? -eq 0 ]
cp -r data/machine_a "$work/left_open"
printf 'effect,parameter,value,unit,departures\ncogging,sine_6,0,Nm,0.01 -0.03 0.02\ncogging,sine_12,0,Nm,0 0 0\n' >"$work/left_open/uncertainty.csv"
printf 'file,id_least_A,id_most_A,iq_least_A,iq_most_A,speed_least_rad_per_s,speed_most_rad_per_s,misfit\na.csv,-1,1,0,2,,,1\n' \
    >"$work/left_open/measured.csv"
run 0 solve "$work/left_open" --target data/scenarios/02/target.csv
says 'not known: the currents lie far'
printf '%s.csv,-1,1,0,2,,,1\n' b c >>"$work/left_open/measured.csv"
run 0 solve "$work/left_open" --target data/scenarios/02/target.csv -o "$work/expected" --report
says 'Ripple at most 2.5 % of the mean torque \(95 %\)' 'Worst order' 'outside of' 'further outside than'
# recordings that tell no order above 6
cp -r "$work/left_open" "$work/low"
sed -i '/sine_12/d' "$work/low/uncertainty.csv"
run 0 solve "$work/low" --target data/scenarios/02/target.csv
says 'not known: the recordings tell of no order of the torque, or of the'
check "the currents are others" cmp -s "$work/expected/currents.csv" "$work/declared/currents.csv"
grep -q 'On the real machine: Ripple at most 2.5 %' "$work/expected/report.html"
check "the page does not say what to expect" [ $? -eq 0 ]
printf 'effect,parameter,value,unit,std_error\ncogging,sine_6,0.1,Nm,\n' >"$work/left_open/effects.csv"
run 0 solve "$work/left_open" --target data/scenarios/02/target.csv
says 'effects.csv is not the one'
printf 'effect,parameter,value,unit,departures\ncogging,sine_6,0,Nm,0.01 much\n' >"$work/left_open/uncertainty.csv"
run 3 solve "$work/left_open" --target data/scenarios/02/target.csv
says 'uncertainty.csv:2: column 5 `departures`: found `0.01 much`'

finish
