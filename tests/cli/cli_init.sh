#!/bin/sh
# What `init` writes and says: readings of data sheets, the folder in other commands, what is refused.
#   cli_init.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
cd "$source_dir" || exit 1

# ---- a hobby motor, and what follows

run 0 init mn4004 --poles 24 --kv 300 --slots 18 -o "$work/mn4004"
says '^machine: .*mn4004: machine.csv, back_emf.csv, cogging.csv$' 'pole pairs   12 \(24 magnets\)' \
    'from 300 rpm/V read as Kv of the line-to-line peak' '0\.027566 Nm/A +torque per ampere peak' '0\.038985 Nm/A +torque per ampere rms' \
    '2\.357 V/krpm +line-to-line rms' ' 300 rpm/V +Kv of the line-to-line peak' 'first at order 6 \(72 in a mechanical turn\)' \
    'hci-solve harmonics RUN --quantity back_emf --pole-pairs 12 -o .*mn4004' 'hci-solve diagnose'
check "files: $(ls -A "$work/mn4004")" [ "$(ls -A "$work/mn4004" | tr '\n' ' ')" = "back_emf.csv cogging.csv machine.csv " ]
check "header of machine.csv" grep -qx 'name,value,unit,source' "$work/mn4004/machine.csv"
check "header of back_emf.csv" grep -qx 'order,amplitude_Nm_per_A,phase_rad' "$work/mn4004/back_emf.csv"
check "cogging orders" [ "$(grep -v '^#' "$work/mn4004/cogging.csv" | tr '\n' ' ')" = "order,amplitude_Nm,phase_rad 6,0,0 12,0,0 18,0,0 " ]
check "a path in a table" eval "! grep -q '$work' '$work/mn4004/'*"

run 0 solve "$work/mn4004" --target data/scenarios/02/target.csv --auto -o "$work/currents"
# 3/2 k_e I = T with k_e = 60/(2 pi sqrt(3) 300)
awk -F, '$1 == 1 { k = 60 / (8 * atan2(1, 1) * sqrt(3) * 300); found = ($3 * 1.5 * k / 2.462900341 - 1) ^ 2 < 1e-16 } END { exit !found }' \
    "$work/currents/currents.csv"
check "the current is not that of the torque constant: $(cat "$work/currents/currents.csv")" [ $? -eq 0 ]

# every row that is missing, filled in as the file says
sed -i 's/^# \([a-z_]*\),,\([A-Za-z0-9_]*\),/\1,0.01,\2,/' "$work/mn4004/machine.csv"
check "rows to fill in" [ "$(grep -c ',0.01,' "$work/mn4004/machine.csv")" -eq 10 ]
run 0 solve "$work/mn4004" --target data/scenarios/02/target.csv --auto -q
nothing_on_stderr

# ---- the same motor in every reading gives the same table

same() {
    run 0 init same --pole-pairs 4 "$@" -q -o "$work/same"
    nothing_on_stderr
    awk -F, '$1 == 1 { found = ($2 / 0.0208 - 1) ^ 2 < 1e-8 } END { exit !found }' "$work/same/back_emf.csv"
    check "not 0.0208: $(tail -n 1 "$work/same/back_emf.csv")" [ $? -eq 0 ]
    rm -r "$work/same"
}
same --flux 0.0052
same --kv 265.062
same --kv 265.062 --kv-of line-peak
same --kv 374.854 --kv-of line-rms
same --kv 459.101 --kv-of phase-peak
same --volt-per-krpm 2.66770
same --volt-per-krpm 2.66770 --volt-of line-rms
same --volt-per-krpm 3.77270 --volt-of line-peak
same --volt-per-krpm 2.17817 --volt-of phase-peak
same --volt-per-krpm 1.54020 --volt-of phase-rms
same --torque-constant 0.0312
same --torque-constant 0.0312 --torque-of peak
same --torque-constant 0.0441235 --torque-of rms
same --torque-constant 0.0360267 --torque-of dc
same --poles 8 --flux 0.0052

# ---- a servo motor with all its values; JSON

run 0 init servo --pole-pairs 4 --volt-per-krpm 98 --resistance 1.9 --resistance-of line --inductance-d 4e-3 --inductance-q 6e-3 --inertia 2e-4 \
    --rated-current 5 --current-of rms --rated-torque 7.9 --rated-speed 3000 --dc-link 560 --json -q -o "$work/servo"
nothing_on_stderr
for expected in 'resistance,0.95,ohm,"data sheet: 1.9 ohm between two terminals; halved"' 'rated_current,7.07106781186547[0-9]*,A,"data sheet: 5 A rms; times sqrt\(2\)"' \
    'rated_speed,3000,rpm,"data sheet: 3000 rpm"' 'inductance_q,0.006,H,"data sheet: 0.006 H of a phase"'; do
    check "machine.csv lacks: $expected" grep -Eqx "$expected" "$work/servo/machine.csv"
done
check "without slots there is no cogging.csv" [ ! -e "$work/servo/cogging.csv" ]
for expected in '"back_emf_Vs_per_rad":[[:space:]]*0.76410' '"torque_constant_rms_Nm_per_A":[[:space:]]*1.6209' '"resistance_ohm":[[:space:]]*0.95' \
    '"cogging_order":[[:space:]]*null' '"remark":[[:space:]]*""'; do
    check "summary lacks: $expected" grep -q "$expected" "$work/stdout"
done
if command -v python3 >/dev/null; then check "not JSON" python3 -m json.tool "$work/stdout" "$work/json"; fi

# ---- L_d and L_q that differ: with inductance.csv reluctance torque, without it every command says so

says_inductance() { for word in "$@"; do check "summary lacks: $word" grep -q "$word" "$work/stdout"; done; }
says_inductance '"inductance.csv"'
printf 'order,amplitude_Nm,phase_rad\n0,4,0\n' >"$work/four.csv"
run 0 solve "$work/servo" --target "$work/four.csv" -q
nothing_on_stderr
run 0 check "$work/servo"
check "check speaks of a table that is there" [ "$(cat "$work/stdout" "$work/stderr" | grep -c 'reluctance')" -eq 0 ]
cp -r "$work/servo" "$work/salient"
rm "$work/salient/inductance.csv"
silent='salient: L_d of 0\.004 H and L_q of 0\.006 H differ, but there is no inductance.csv:.* without the reluctance torque .* write inductance.csv'
run 0 solve "$work/salient" --target "$work/four.csv"
says "note: .*$silent"
run 0 check "$work/salient"
says "note: .*$silent"
run 0 check "$work/salient" --json
check "the summary of check lacks it" grep -q 'without the reluctance' "$work/stdout"
run 0 sweep "$work/salient" --map --torques 4 --speeds 0 --limit-current 20 -o "$work/salient_map"
says "note: .*$silent"
run 0 simulate "$work/salient" data/drive/imposed.csv
says "note: .*$silent"
printf 'effect,parameter,value,unit,std_error\nreluctance,qq_cosine_6,0,H,\n' >"$work/salient/effects.csv"
run 0 simulate "$work/salient" data/drive/imposed.csv -q
run 0 check "$work/salient"
check "check does not see effects.csv" [ "$(grep -c 'without the reluctance' "$work/stderr")" -eq 0 ]

# ratings that need another reading
run 0 init servo --pole-pairs 4 --volt-per-krpm 98 --rated-current 5 --rated-torque 7.9 -o "$work/slip"
says 'note: rated torque 7.9 N·m.*5\.731 N·m: 1\.38 times: about sqrt\(2\)'

# the name is the folder; parts of a path do not get into the tables
cd "$work" || exit 1
run 0 init some/where/mine --pole-pairs 4 --flux 0.01 -q
check "name" grep -q '^# Machine `mine`,' some/where/mine/machine.csv
TZ=Asia/Tokyo LC_ALL=de_DE.UTF-8 "$hci_solve" init mine --pole-pairs 4 --flux 0.01 -q -o again
check "other bytes" diff -r some/where/mine again
cd "$source_dir" || exit 1

# ---- the folder takes measured harmonics over, and is a machine for the other commands

run 0 init a --pole-pairs 2 --volt-per-krpm 17.906 --inertia 1e-3 --slots 24 -q -o "$work/a" # machine A: 21.93 V at 50 Hz
run 0 simulate data/machine_a data/drive/driven.csv -q -o "$work/driven"
run 0 harmonics "$work/driven/trajectory.csv" --quantity cogging --pole-pairs 2 -q -o "$work/a"
check "cogging.csv is not the measured one" grep -q '^12,0\.3' "$work/a/cogging.csv"
run 0 predict "$work/a" "$work/driven/trajectory.csv"
says 'residual     0\.00[0-9]+ N·m rms'
run 0 simulate "$work/a" data/drive/imposed.csv -q -o "$work/imposed"
nothing_on_stderr

# ---- nothing is overwritten

cp -r "$work/servo" "$work/before"
run 5 init servo --pole-pairs 4 --flux 0.01 -o "$work/servo"
says 'servo/machine.csv: is there already, and nothing is overwritten; name another folder'
check "overwritten" diff -r "$work/servo" "$work/before"
: >"$work/plain"
run 5 init x --pole-pairs 4 --flux 0.01 -o "$work/plain"

# ---- wrong command lines: the option, what was found, what was expected, what to do

wrong() {
    expression=$1
    shift
    run 2 init x "$@" -o "$work/wrong"
    nothing_on_stdout
    says "$expression"
    check "something is written" [ ! -e "$work/wrong" ]
}
wrong 'no pole pairs; add --pole-pairs P, or --poles N' --kv 300
wrong 'how strong the magnets are; add one of --kv RPM_PER_V, --volt-per-krpm V' --pole-pairs 4
wrong '--poles: found `7`, expected an even number from 2 to 2000; count the magnets' --poles 7 --kv 300
wrong '--poles: found `14` beside --pole-pairs 14, expected 28; leave out one' --poles 14 --pole-pairs 14 --kv 300
wrong '--pole-pairs: found `3.5`, expected a whole number from 1 to 1000; a machine with N magnets' --pole-pairs 3.5 --kv 300
wrong '--flux: found `0.1` beside --kv, expected one of them; leave out' --pole-pairs 4 --kv 300 --flux 0.1
wrong '--kv-of: found `line-rms` without --kv; add --kv RPM_PER_V, or leave it out' --pole-pairs 4 --kv-of line-rms --flux 0.1
wrong '--kv-of: found `rms`, expected one of: line-peak, line-rms, phase-peak' --pole-pairs 4 --kv 300 --kv-of rms
wrong '--volt-of: found `peak`, expected one of: line-rms, line-peak, phase-peak, phase-rms' --pole-pairs 4 --volt-per-krpm 9 --volt-of peak
wrong '--torque-of: found `x`, expected one of: peak, rms, dc' --pole-pairs 4 --torque-constant 1 --torque-of x
wrong '--resistance-of: found `line` without --resistance' --pole-pairs 4 --kv 300 --resistance-of line
wrong '--current-of: found `x`, expected one of: peak, rms' --pole-pairs 4 --kv 300 --rated-current 3 --current-of x
wrong '--inductance: found `1e-3` beside --inductance-d' --pole-pairs 4 --kv 300 --inductance 1e-3 --inductance-d 1e-3
wrong '--inductance-q: found `1e-3` without --inductance-d; give both' --pole-pairs 4 --kv 300 --inductance-q 1e-3
wrong '--slots: found `14`, expected a multiple of 3 from 3 to 600; count the teeth' --pole-pairs 7 --kv 300 --slots 14
for text in 0 -1 nan inf 300rpm 1,5 '' 1e9; do
    wrong "--kv: found \`$text\`, expected a number from 0.001 to 1e\\+06; give it in rpm/V, with a decimal point" --pole-pairs 4 --kv "$text"
done
for option in resistance inductance inertia rated-current rated-torque rated-speed dc-link; do
    wrong "--$option: found \`0\`, expected a number from .* to .*; give it in" --pole-pairs 4 --kv 300 "--$option" 0
done
run 2 init '' --pole-pairs 4 --kv 300
says 'found an empty word, expected NAME'
run 2 init
says 'found 0 words, expected 1: NAME; see hci-solve init --help'

finish
