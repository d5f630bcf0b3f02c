#!/bin/sh
# Torques over the angle at several constant currents in one file, as finite elements give them: the same answer as from a file
# for each operating point, whether the angle or the currents change first.
#   cli_torque_map.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
use_plain_build

points="I0 id-3_iq-4 id-3_iq3 id-6_iq3 id-6_iq6 id0_iq3 id0_iq6 id0_iq8 id3_iq3 id3_iq6"
for point in $points; do
    echo "$source_dir/data/fem_c/runs/$point.csv,fit"
done | sed '1i file,role' >"$work/files.csv"
head -1 "$source_dir/data/fem_c/runs/I0.csv" >"$work/map.csv"
for point in $points; do
    sed 1d "$source_dir/data/fem_c/runs/$point.csv"
done >"$work/rows"
cat "$work/rows" >>"$work/map.csv"
head -1 "$work/map.csv" >"$work/by_angle.csv"
sort -t, -k1,1g -s "$work/rows" >>"$work/by_angle.csv"

for list in map by_angle; do
    printf 'file,role\n%s.csv,fit\n' $list >"$work/list_$list.csv"
done

for list in files list_map list_by_angle; do
    "$hci_solve" diagnose "$source_dir/data/fem_c/machine" --runs "$work/$list.csv" -o "$work/of_$list" >"$work/$list.out" 2>"$work/$list.err"
    echo $? >"$work/$list.rc"
done
for list in list_map list_by_angle; do
    check "$list: exit code $(cat "$work/$list.rc"), of files $(cat "$work/files.rc")" cmp -s "$work/$list.rc" "$work/files.rc"
    # Rounding of the rotor frame, no more.
    check "$list: other effects than of files" awk -F, '
        FNR == NR { value[$1 "," $2] = $3; next }
        { seen[$1 "," $2] = 1; d = $3 - value[$1 "," $2]; if (FNR > 1 && (!(($1 "," $2) in value) || d * d > 1e-8 * $3 * $3 + 1e-18)) bad = 1 }
        END { for (k in value) if (!(k in seen)) bad = 1; exit bad }' "$work/of_files/machine/effects.csv" "$work/of_$list/machine/effects.csv"
    check "$list: not $(wc -l <"$work/of_files/errors.csv") lines of errors" [ "$(wc -l <"$work/of_$list/errors.csv")" = "$(wc -l <"$work/of_files/errors.csv")" ]
    check "$list: no operating point named" grep -q '(i_d -6 A; i_q 3 A)' "$work/of_$list/errors.csv"
    check "$list: its points are not told" grep -q '10 operating points in one file, i_d -6 to 3 A and i_q -4 to 8 A' "$work/$list.err"
    check "$list: the file is not in the list once" [ "$(grep -c '\.csv,fit' "$work/of_$list/declared/runs.csv")" = 1 ]
done

# What is found of it goes on with other recordings: the file is read and its points told once more.
printf 'file,role\n%s,fit\n' "$source_dir/data/fem_c/runs/id-3_iq6.csv" >"$work/new.csv"
"$hci_solve" diagnose --again "$work/of_list_map" --runs "$work/new.csv" -o "$work/second" >"$work/second.out" 2>&1
check "--again: not 11 recordings" [ "$(sed 1d "$work/second/errors.csv" | wc -l)" = 11 ]

# tune: one line for the file, and the log as it was given in the call of check.
"$hci_solve" tune "$work/map.csv" --pole-pairs 2 --torque-constant 1.338 --rated-current 8 --torque 10 --work 0.05 -o "$work/tuned" >"$work/tuned.out" 2>&1
check "tune: exit code $?" [ -s "$work/tuned/commands.sh" ]
check "tune: the map is not read as one file" [ "$(grep -c 'samples at each operating point' "$work/tuned.out")" = 1 ]
tr -s '[:space:]' ' ' <"$work/tuned.out" >"$work/tuned.words"
check "tune: what is to be calculated" grep -q 'To be calculated, each over an electrical turn' "$work/tuned.words"
for words in 'On the bench' 'turns forward' 'turns at' 'The sensors of the drive' 'that no inductance of the machine declares'; do
    check "tune: $words" [ "$(grep -c "$words" "$work/tuned.words")" = 0 ]
done
# The sine is that of the back-EMF: what reluctance adds to its torque is shown.
sine=$(sed -n 's/^  mean torque in the model, N·m *\([0-9.]*\) .*/\1/p' "$work/tuned.out")
of_json=$(sed -n 's/.*"mean_Nm":[[:space:]]*\([0-9.]*\).*/\1/p' "$work/tuned/summary.json" | head -1)
check "tune: mean torque of the sine ${sine:-not shown}, $of_json" awk -v x="${sine:-0}" -v y="$of_json" 'BEGIN { exit !(x > 10.01 && x - y < 0.006 && y - x < 0.006) }'
check "tune: not one row in its list" [ "$(wc -l <"$work/tuned/runs.csv")" = 2 ]

# Beside a log over time no promise is made: both need not be of one machine.
awk -F, -v OFS=, 'NR == 1 { print "time_s", $0; next } { print (NR - 2) * 0.001, $0 }' "$source_dir/data/fem_c/runs/id0_iq6.csv" >"$work/log.csv"
"$hci_solve" tune "$work/map.csv" "$work/log.csv" --pole-pairs 2 --torque-constant 1.338 --rated-current 8 --work 0.05 -o "$work/mixed" >"$work/mixed.out" 2>&1
mixed=$?
check "mixed: exit code $mixed, not 1" [ "$mixed" -eq 1 ]
check "mixed: not said" grep -q '10 of 11 recordings have no time and constant currents, as finite elements give them' "$work/mixed.out"
check "mixed: no remark of the log" [ "$(tr -s '[:space:]' ' ' <"$work/mixed.out" | grep -c 'beside torques without a time')" = 1 ]
check "map: others are spoken of" [ "$(grep -c 'others were measured' "$work/tuned.out")" = 0 ]
finish
