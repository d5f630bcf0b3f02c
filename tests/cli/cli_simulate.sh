#!/bin/sh
# What `simulate` writes: files, headers, figures recomputed from the trajectory, the chain from `solve`, exit codes, wrong scenarios.
#   cli_simulate.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
cd "$source_dir" || exit 1

scenario=$work/scenario.csv
rows() { # ROW...: the scenario
    { echo name,value,unit; printf '%s\n' "$@"; } >"$scenario"
}
value() { # FILE KEY: the number of a key that the summary has once
    sed -n "s/.*\"$2\":[[:space:]]*\([-0-9.e+]*\),*\$/\1/p" "$1"
}
near() { # FOUND EXPECTED RELATIVE
    check "found $1, expected $2" awk -v a="$1" -v b="$2" -v e="$3" 'BEGIN { d = a - b; if (d < 0) d = -d; if (b < 0) b = -b; exit !(d <= e * b) }'
}

# ---- what solve promises is what the plant does

run 0 solve data/machine_a --target data/scenarios/12/target.csv --auto -q -o "$work/solution"
run 0 simulate data/machine_a data/drive/imposed.csv --currents "$work/solution" -o "$work/imposed"
says '^simulated: data/machine_a, data/drive/imposed.csv$' '2 whole periods at 1500 rpm' 'mean 2.4629 N·m' 'copper loss'
check "files: $(ls -A "$work/imposed" | tr '\n' ' ')" [ "$(ls -A "$work/imposed" | tr '\n' ' ')" = "spectrum.csv summary.json trajectory.csv " ]
check "header of the spectrum" [ "$(head -n 1 "$work/imposed/spectrum.csv")" = order,torque_Nm,torque_phase_rad ]
check "header of the trajectory" grep -q '^time_s,theta_m_rad,theta_e_rad,speed_rad_per_s,ia_A,ib_A,ic_A,id_A,iq_A,torque_Nm,' "$work/imposed/trajectory.csv"
awk -F, '!/^[0-9]/ { file++; next }
    file == 1 { s[$1] = $4 * cos($5); c[$1] = $4 * sin($5); next }
    { ds = $2 * cos($3) - s[$1]; dc = $2 * sin($3) - c[$1]; if (ds * ds + dc * dc > 6e-12) bad = 1; rows++ }
    END { exit bad || rows != 61 }' "$work/solution/spectrum.csv" "$work/imposed/spectrum.csv"
check "the spectrum is not the one of solve, to 1e-6 of 2.46 N·m" [ $? -eq 0 ]

# ---- the shipped currents are those of the command that their comment names

sed -n 's/^# *hci-solve //p' data/drive/machine_a_currents.csv >"$work/command"
# shellcheck disable=SC2046
run 0 $(cat "$work/command") -q -o "$work/again"
check "data/drive/machine_a_currents.csv is not what solve finds" awk -F, '/^#/ || /^order/ { next }
    FNR == NR { s[$1 $2] = $3 * cos($4); c[$1 $2] = $3 * sin($4); n++; next }
    { d = ($3 * cos($4) - s[$1 $2]) ^ 2 + ($3 * sin($4) - c[$1 $2]) ^ 2; if (d > 1e-16) bad = 1; m++ }
    END { exit bad || n != m || !n }' data/drive/machine_a_currents.csv "$work/again/currents.csv"
run 0 simulate data/machine_a data/drive/imposed.csv
says 'T_ripple 0 %'

# ---- L_d and L_q that differ beside an effect that tells the saliency: the torque of i_d i_q counts once, in closed form; what is
# missing is named at once

mkdir "$work/salient"
printf 'name,value,unit,source\npole_pairs,2,1,test\nemf_frequency,50,Hz,test\nconnection,star,,test\n' >"$work/salient/machine.csv"
printf 'order,amplitude_V,phase_rad\n1,21.93,0\n' >"$work/salient/back_emf.csv"
printf 'effect,parameter,value,unit,std_error\nreluctance,dd_cosine_0,-20,mH,\n' >"$work/salient/effects.csv"
printf 'order,set,amplitude_A,phase_rad\n1,pos,5,0.6\n' >"$work/salient_currents.csv"
rows duration,0.04,s prescribed_speed,1500,rpm
salient="simulate $work/salient $scenario --currents $work/salient_currents.csv --json -q"
wanted=$(awk 'BEGIN { print 1.5 * 21.93 / (50 * 3.14159265358979) * 5 * cos(0.6) + 1.5 * 2 * -0.02 * (-5 * sin(0.6)) * 5 * cos(0.6) }')
for rows in '' 'inductance_d,10,mH,test\ninductance_q,30,mH,test\n'; do
    printf "$rows" >>"$work/salient/machine.csv"
    # shellcheck disable=SC2086
    run 0 $salient
    near "$(sed -n '/"torque"/,/}/s/.*"mean_Nm":[[:space:]]*\([-0-9.e+]*\),*$/\1/p' "$work/stdout" | head -n 1)" "$wanted" 1e-5
done
sed -i '/inductance/d' "$work/salient/machine.csv"
rows duration,0.04,s prescribed_speed,1500,rpm torque_reference,1,Nm current_control,pi, dc_link_voltage,100,V
run 3 simulate "$work/salient" "$scenario"
says 'add `resistance,VALUE,ohm,SOURCE`, `inductance_d,VALUE,H,SOURCE`, `inductance_q,VALUE,H,SOURCE`'

# ---- switched voltages are told of (the second paper's experiment is run in cli_examples.sh); the figures from the trajectory

rows duration,0.4,s settle,0.02,s step,10,us prescribed_speed,80,rpm torque_reference,8,Nm current_control,hysteresis, switching_frequency_max,5,kHz
run 0 simulate data/machine_c "$scenario"
says 'evaluated    0.02 s to 0.395 s, 1 whole period at 80 rpm' 'switching    [0-9.]+ Hz' 'energy .* J in'

rows duration,0.45,s prescribed_speed,80,rpm torque_reference,5,Nm strategy,id0, step,40,us trajectory_every,1, settle,0.05,s
run 0 simulate data/machine_c "$scenario" --json -o "$work/one"
check "--json differs from summary.json" cmp -s "$work/stdout" "$work/one/summary.json"
nothing_on_stderr
awk -F, -v from="$(value "$work/one/summary.json" from_s)" -v to="$(value "$work/one/summary.json" to_s)" '
    NR == 1 || $1 < from - 1e-9 || $1 > to + 1e-5 { next }
    n == 0 { min = max = $10 }
    n++ { sum += ($1 - t) * ($10 + last) / 2; square += ($1 - t) * ($10 ^ 2 + last ^ 2) / 2 }
    { if ($10 > max) max = $10; if ($10 < min) min = $10; last = $10; if (n == 1) first = $1; t = $1 }
    END { mean = sum / (t - first); print 100 * (max - min) / mean, 100 * sqrt(square / (t - first) - mean ^ 2) / mean, mean }
    ' "$work/one/trajectory.csv" >"$work/figures"
read -r t_ripple f_ripple mean <"$work/figures"
near "$(value "$work/one/summary.json" T_ripple)" "$t_ripple" 1e-6
near "$(value "$work/one/summary.json" F_ripple)" "$f_ripple" 1e-3 # the period ends within a step of 9 375
near "$(value "$work/one/summary.json" mean_Nm)" "$mean" 1e-4
check "there is no ripple to compare" awk -v t="$t_ripple" 'BEGIN { exit !(t > 10) }'

# ---- same input, same bytes; words to standard error; nothing without --out

TZ=Asia/Tokyo LC_ALL=de_DE.UTF-8 "$hci_solve" simulate ./data/machine_c "$scenario" -q -o "$work/deep/er" 2>"$work/stderr"
check "other bytes" diff -r "$work/one" "$work/deep/er"
run 0 simulate data/machine_c "$scenario" --quiet --json -o "$work/one"
nothing_on_stderr
check "--json differs with --quiet" cmp -s "$work/stdout" "$work/one/summary.json"
mkdir "$work/empty" && cd "$work/empty" || exit 1
run 0 simulate "$source_dir/data/machine_c" "$scenario" -q
nothing_on_stdout
check "written without --out: $(ls -A)" [ -z "$(ls -A)" ]
cd "$source_dir" || exit 1

# ---- effects.csv of a machine acts

cp -R data/machine_c "$work/machine"
printf 'effect,parameter,value,unit,std_error\ncurrent_offset,a,0.4,A,\n' >"$work/machine/effects.csv"
run 0 simulate "$work/machine" "$scenario" -q -o "$work/effects"
check "the reading lacks the offset" awk -F, 'NR == 1 { for (k = 1; k <= NF; ++k) name[$k] = k; next }
    { d = $name["ia_A"] - $name["ia_true_A"] - 0.4; if (d * d > 1e-18) bad = 1 } END { exit bad || !name["ia_true_A"] }' "$work/effects/trajectory.csv"

# ---- wrong: one line that says what and where, and nothing is written

refused() { # CODE EXPRESSION WORD...
    code_wanted=$1 expression=$2
    shift 2
    run "$code_wanted" simulate "$@" -o "$work/refused"
    nothing_on_stdout
    says "^hci-solve: .*$expression"
    check "more than one line is said" [ "$(wc -l <"$work/stderr")" -eq 1 ]
    check "something was written" [ ! -e "$work/refused" ]
}

refused 2 'expected MACHINE SCENARIO, or MACHINE with --table' data/machine_c
refused 3 'none.csv: .*No such file' data/machine_c "$work/none.csv"
rows duratoin,1,s; refused 3 'scenario.csv:2: column 1 `name`: found `duratoin`, .*; did you mean `duration`\?' data/machine_c "$scenario"
rows duration,1,A; refused 3 'scenario.csv:2: .*a unit that converts to s' data/machine_c "$scenario"
rows duration,1,s prescribed_speed,80,rpm torque_reference,2,Nm current_control,pi,
refused 3 'machine.csv: currents that a voltage drives need .*; add `resistance,VALUE,ohm,SOURCE`, `inductance_d,' data/machine_a "$scenario"
refused 2 '--currents' data/machine_c "$scenario" --currents ''
rows duration,1,s speed_reference,80,rpm viscous_friction,1e4, step,1,ms; refused 4 'smaller `step`' data/machine_c "$scenario"
rows duration,0.1,s prescribed_speed,80,rpm torque_reference,2,Nm
: >"$work/file"
run 5 simulate data/machine_c "$scenario" -o "$work/file"
nothing_on_stdout

# ---- figures that mean nothing are not passed off as results

rows prescribed_speed,80,rpm torque_reference,8,Nm current_control,hysteresis, step,5,ms duration,2,s
run 0 simulate data/machine_c "$scenario"
says 'energy does not balance within 1 %.*spectrum ends at order 18'
run 0 simulate data/machine_c "$scenario" --json
check "the imbalance is not in the summary" grep -q '"balances":[[:space:]]*false' "$work/stdout"
rows prescribed_speed,80,rpm torque_reference,0,Nm duration,0.9,s
run 0 simulate data/machine_c "$scenario" --json
check "a ripple without a mean has a figure" grep -q '"T_ripple":[[:space:]]*null' "$work/stdout"
printf 'order,amplitude_Nm,phase_rad\n0,8,0\n' >"$work/eight.csv"
run 0 solve data/machine_c --target "$work/eight.csv" -q -o "$work/interior"
rows prescribed_speed,80,rpm torque_reference,4,Nm currents,"$work/interior", duration,0.9,s
refused 3 'no currents_per_Nm.csv: it is for one torque' data/machine_c "$scenario"

# ---- the help and docs/simulate.md name the same names

run 0 simulate --help
sed -n '/^A scenario is/,$s/^  \([a-z0-9_]\{1,\}\) .*/\1/p' "$work/stdout" | sort >"$work/in_help"
sed -n 's/^| `\([a-z0-9_]*\)` | .*/\1/p' docs/simulate.md | grep -v -E '^(torque|current|current_dqx|control|energy)$|_[bc]$' | sort >"$work/in_docs"
check "names: $(diff "$work/in_help" "$work/in_docs" | head -n 3)" cmp -s "$work/in_help" "$work/in_docs"

finish
