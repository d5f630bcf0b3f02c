#!/bin/sh
# What `predict` writes and says: the chain from `simulate`, columns, exit codes, the run it does not replace.
#   cli_predict.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
cd "$source_dir" || exit 1

# ---- what the plant did is what the model says, with and without effects

run 0 simulate data/machine_a data/drive/imposed.csv -q -o "$work/imposed"
run 0 predict data/machine_a "$work/imposed/trajectory.csv" -o "$work/deep/er/predicted.csv"
says '^predicted: data/machine_a, .*trajectory.csv$' 'torque as measured' 'mean 2.4629 N·m' "written .*/predicted.csv" \
    'residual     none above rounding'
check "header: $(head -n 1 "$work/deep/er/predicted.csv")" [ "$(head -n 1 "$work/deep/er/predicted.csv")" = \
    "$(head -n 1 "$work/imposed/trajectory.csv"),torque_model_Nm,residual_Nm" ]
cut -d, -f1-11 "$work/deep/er/predicted.csv" >"$work/own"
cut -d, -f1-11 "$work/imposed/trajectory.csv" >"$work/before"
check "the run's own columns have changed" cmp -s "$work/own" "$work/before"

cp -R data/machine_a "$work/machine"
printf 'effect,parameter,value,unit,std_error\ncurrent_gain,b,3,%%,\nposition_offset,angle,2,deg,\nfriction,viscous,0.001,Nms_per_rad,\n' \
    >"$work/machine/effects.csv"
run 0 simulate "$work/machine" data/drive/imposed.csv -q -o "$work/effects"
run 0 predict data/machine_a "$work/effects/trajectory.csv"
says 'residual     0\.[0-9]+ N·m rms'
run 0 predict "$work/machine" "$work/effects/trajectory.csv"
says 'residual     none above rounding'

# ---- same input, same bytes; the old prediction is replaced, not added to

run 0 predict data/machine_a "$work/deep/er/predicted.csv" -q -o "$work/again.csv"
nothing_on_stderr
check "a prediction of a prediction differs" cmp -s "$work/again.csv" "$work/deep/er/predicted.csv"
run 0 predict data/machine_a "$work/imposed/trajectory.csv" --json -q
nothing_on_stderr
check "--json lacks the residual" grep -q '"worst_sample":' "$work/stdout"

# ---- a run without torque, and one held at rest

printf 'theta_e_deg,iq_A\n0,1\n90,1\n' >"$work/run.csv"
run 0 predict data/machine_a "$work/run.csv" -o "$work/out.csv"
says 'no torque in the run'
check "a residual without a torque" [ "$(head -n 1 "$work/out.csv")" = theta_e_deg,iq_A,torque_model_Nm ]
printf 'theta_e_deg,iq_A,torque_Nm\n0,1,0\n90,1,-0\n' >"$work/run.csv"
run 0 predict data/machine_a "$work/run.csv"
says 'held at rest'
awk 'BEGIN { print "time_s,theta_e_rad,speed_rad_per_s,iq_A"; for (k = 0; k < 500; ++k) printf "%.3f,%.9f,50,2\n", k / 1000, 100 * k / 1000 }' >"$work/log.csv"
cp -R data/machine_a "$work/driving"
grep -v '^inertia,' data/machine_a/machine.csv >"$work/driving/machine.csv"
echo 'inertia,0.001,kgm2,' >>"$work/driving/machine.csv"
run 0 predict "$work/driving" "$work/log.csv" -o "$work/out.csv"
says 'no torque in the run' 'no free shaft: by the model the current makes'
check "a residual of a load that was not recorded" [ "$(head -n 1 "$work/out.csv")" = time_s,theta_e_rad,speed_rad_per_s,iq_A,torque_model_Nm ]
cd "$work" && rm -rf empty && mkdir empty && cd empty || exit 1
run 0 predict "$source_dir/data/machine_a" "$work/run.csv" -q
nothing_on_stderr
check "written without --out: $(ls -A)" [ -z "$(ls -A)" ]
run 0 predict "$source_dir/data/machine_a" "$work/run.csv" -q -o here.csv
check "a name without a folder" [ "$(ls -A)" = here.csv ]
cd "$source_dir" || exit 1

printf 'time_s,theta_e_deg,iq_A\n0,1,1\n0,2,1\n' >"$work/still.csv"
run 0 predict data/machine_a "$work/still.csv"
says 'note: the time does not go on: it is not used'

# ---- columns that the user names

printf 'AI1,AI2\n0,1\n90,1\n' >"$work/channels.csv"
run 0 predict data/machine_a "$work/channels.csv" --column theta_e_deg=AI1 --column=iq_A=AI2 --json
run 2 predict data/machine_a "$work/channels.csv" --column theta_e_dge=AI1
says 'found `theta_e_dge`, expected a quantity of a recording; did you mean `theta_e_deg`\?'
run 3 predict data/machine_a "$work/channels.csv" --column theta_e_deg=AI11
says 'found no column `AI11` in .*channels.csv; did you mean `AI1`\?'

# ---- wrong: one line that says what and where, and nothing is written

refused() { # CODE EXPRESSION WORD...
    code_wanted=$1 expression=$2
    shift 2
    run "$code_wanted" predict "$@"
    nothing_on_stdout
    says "^hci-solve: .*$expression"
    check "more than one line is said" [ "$(wc -l <"$work/stderr")" -eq 1 ]
}

refused 2 'found 1 word, expected 2: MACHINE RUN' data/machine_a
refused 3 'none.csv: .*No such file' data/machine_a "$work/none.csv" -o "$work/refused/x.csv"
refused 2 'run.csv would be replaced by its prediction' data/machine_a "$work/run.csv" -o "$work/./run.csv"
cp -R data/machine_a "$work/kept"
refused 2 'back_emf.csv is a file of the machine and would be replaced by a prediction' "$work/kept" "$work/run.csv" -o "$work/kept/./back_emf.csv"
check "the machine has changed" diff -r data/machine_a "$work/kept"
printf 'time_s,theta_e_deg,iq_A\n0,1,1\n1,,1\n' >"$work/wrong.csv"
refused 3 'wrong.csv:3: column 2 `theta_e_deg`: found an empty cell' data/machine_a "$work/wrong.csv" --strict -o "$work/refused/x.csv"
printf 'time_s,angle,iq_A\n0,1,1\n' >"$work/wrong.csv"
refused 3 '`angle`: found an angle that may be mechanical or electrical, expected theta_m or theta_e' data/machine_a "$work/wrong.csv" -o "$work/refused/x.csv"
check "something was written" [ ! -e "$work/refused" ]
: >"$work/file"
refused 5 'file' data/machine_a "$work/run.csv" -o "$work/file/x.csv"

# ---- a recording of a machine with other pole pairs

awk -F, -v OFS=, 'NR == 1 { for (k = 1; k <= NF; ++k) c[$k] = k; print "time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm"; next }
    { e = 2 * $c["theta_m_rad"]; print $c["time_s"], $c["theta_m_rad"], 5 * sin(e), 5 * sin(e - 2.0943951), 5 * sin(e + 2.0943951), $c["torque_Nm"] }' "$work/imposed/trajectory.csv" >"$work/two.csv"
cp -R data/machine_a "$work/three"
sed -i 's/^pole_pairs,2/pole_pairs,3/' "$work/three/machine.csv"
run 0 predict "$work/three" "$work/two.csv"
says 'the phase currents go round 2 times in a turn of the shaft, and the machine has 3 pole pairs'
run 0 predict data/machine_a "$work/two.csv"
check "the right pole pairs are doubted" [ "$(grep -c 'go round' "$work/stderr" "$work/stdout" | grep -vc ':0$')" -eq 0 ]
printf 'file,role\ntwo.csv,fit\n' >"$work/two_list.csv"
"$hci_solve" fit "$work/three" --runs "$work/two_list.csv" -o "$work/three_fit" >"$work/stdout" 2>"$work/stderr"
says 'the phase currents go round 2 times in a turn of the shaft, and the machine has 3 pole pairs'

finish
