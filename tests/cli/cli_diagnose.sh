#!/bin/sh
# What `diagnose` writes and says: verdicts and exit codes, the corrected machine, all or nothing, wrong lists and recordings.
#   cli_diagnose.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
cd "$work" || exit 1

# A sinusoidal machine of 0.2 N·m/A and two pole pairs.
mkdir machine
printf 'name,value,unit,source\npole_pairs,2,1,test\nconnection,star,,test\n' >machine/machine.csv
printf '# kept as it is\norder,amplitude_Nm_per_A,phase_rad\n1,0.2,0\n' >machine/back_emf.csv

# recordings OFFSET_A BRAKE_NM FILE:SPEED:CURRENT...: a turn and a half each; the noise is of 12 numbers of Park and Miller.
recordings() {
    offset=$1 brake=$2
    shift 2
    awk -v offset="$offset" -v brake="$brake" -v points="$*" 'BEGIN {
        pi = atan2(0, -1)
        seed = 4711
        count = split(points, point, " ")
        for (f = 1; f <= count; f++) {
            split(point[f], x, ":")
            print "time_s,theta_m_rad,speed_rad_per_s,ia_A,ib_A,ic_A,torque_Nm" >x[1]
            for (k = 0; k < 150; k++) {
                angle = (x[2] < 0 ? -2 : 2) * pi * k / 100
                torque = -brake
                for (p = 0; p < 3; p++) {
                    i[p] = x[3] * sin(2 * angle - 2 * pi * p / 3)
                    torque += 0.2 * i[p] * sin(2 * angle - 2 * pi * p / 3)
                }
                for (n = 0; n < 12; n++) {
                    seed = 16807 * seed % 2147483647
                    torque += 0.01 * (seed / 2147483647 - 0.5)
                }
                printf "%.9f,%.9f,%g,%.9f,%.9f,%.9f,%.9f\n", angle / x[2], angle, x[2], i[0] + offset, i[1], i[2], torque >x[1]
            }
        }
    }'
}

# row FILE TEXT: the first row of a table with this text.
row() {
    grep -m 1 -e "$2" "$1"
}

# ---- explained

recordings 0.3 0 slow.csv:60:2 back.csv:-150:7 held.csv:90:4
printf 'file,role\nslow.csv,fit\nback.csv,fit\nheld.csv,holdout\n' >list.csv
run 0 diagnose machine --runs list.csv -o deep/out
says '^diagnosed: machine, list.csv: explained$' 'added +zeros of the current sensors: phase a = 0\.(29|30)' 'held.csv +holdout'
check "files: $(ls deep/out | tr '\n' ' ')" [ "$(ls deep/out | tr '\n' ' ')" = \
    'declared effects.csv errors.csv machine report.html residual_spectrum.csv summary.json ' ]
check "effects.csv: $(head -n 2 deep/out/effects.csv)" grep -Eq '^1,current_offset,added,[0-9.]+,0\.9[0-9]+,' deep/out/effects.csv
check "columns of effects.csv" [ "$(head -n 1 deep/out/effects.csv)" = rank,effect,verdict,delta_bic,residual_share,detail,stays,left_out ]
check "columns of errors.csv" grep -q '^file,role,mean_torque_Nm,rms_before_Nm,rms_after_Nm,noise_floor_Nm' deep/out/errors.csv
check "errors.csv: $(row deep/out/errors.csv held)" grep -Eq '^held.csv,holdout,1\.(19|20)' deep/out/errors.csv
check "not one more is added" [ "$(grep -c ',added,' deep/out/effects.csv)" -eq 1 ]
for table in machine.csv back_emf.csv; do
    check "$table has changed" cmp -s "machine/$table" "deep/out/machine/$table"
done
check "a table that the machine has not" [ ! -e deep/out/machine/cogging.csv ]
check "effects of the machine: $(row deep/out/machine/effects.csv current)" \
    grep -Eq '^current_offset,a,0\.(29|30)[0-9]*,A,0\.00' deep/out/machine/effects.csv

# The same bytes again, --json what summary.json is, -q no word, and without --out no file.
run 0 diagnose machine --runs list.csv -q --json -o again
nothing_on_stderr
check "other bytes" diff -r -x runs.csv deep/out again # paths from the folder
check "--json is not summary.json" cmp -s stdout again/summary.json
check "summary.json: $(row again/summary.json verdict)" grep -q '"verdict":.*"explained"' again/summary.json
mkdir empty && cp -R machine slow.csv back.csv held.csv list.csv empty && cd empty || exit 1
run 0 diagnose machine --runs list.csv -q
check "written without --out: $(ls)" [ "$(ls | tr '\n' ' ')" = 'back.csv held.csv list.csv machine slow.csv ' ]
cd .. || exit 1

# The corrected machine lacks nothing, and predicts as it was said.
run 0 diagnose deep/out/machine --runs list.csv
says ': complete$'
run 0 predict deep/out/machine held.csv
after=$(awk -F, '$1 == "held.csv" { printf "%.6f", $5 }' deep/out/errors.csv)
check "predict says other than $after: $(row stdout residual)" \
    [ "$(awk '/residual/ { printf "%.4f", $2 }' stdout)" = "$(awk "BEGIN { printf \"%.4f\", $after }")" ]

# A hundredth of the work is at its limit before all is compared, and says how it gets further.
run 1 diagnose machine --runs list.csv --work 0.01
says 'limit of its work' 'work 4'
run 0 diagnose machine --runs list.csv --work 4
says ': explained$'
run 2 diagnose machine --runs list.csv --work 0

# ---- not told apart

recordings 0 0.05 a.csv:60:1 b.csv:60:4 c.csv:60:8
printf 'file;role;note\na.csv;fit;\nb.csv;fit;x\nc.csv;fit;\n' >list2.csv
run 1 diagnose machine --runs list2.csv -o out2
says ': ambiguous$' 'ambiguous +friction' 'ambiguous +errors of the torque sensor' 'measure next'
check "an answer that is no is written all the same" [ -s out2/machine/effects.csv ]
check "ambiguous ones: $(grep -c ambiguous out2/effects.csv)" [ "$(grep -c ',ambiguous,' out2/effects.csv)" -eq 2 ]

# ---- again, with what was to be measured next

check "measure_next.csv: $(head -n 1 out2/measure_next.csv)" \
    [ "$(head -n 1 out2/measure_next.csv)" = id_A,iq_A,speed_rad_per_s,turns,why,test ]
next=$(sed -n '2s/^0,0,\(-[0-9.]*\),10,.*,dyno$/\1/p' out2/measure_next.csv)
check "where it tells: $(sed -n 2p out2/measure_next.csv)" [ -n "$next" ]
mkdir later
recordings 0 -0.05 "later/back.csv:${next:--15}:0" later/held.csv:-40:3
printf 'file,role\nback.csv,fit\nheld.csv,holdout\n' >later/list.csv
sed -i '1s/torque_Nm/shaft/' later/back.csv later/held.csv # another name than in the recordings before
run 0 diagnose --again out2 --runs later/list.csv --column torque_Nm=shaft -o round2
says ': explained$' 'added +friction'
for words in 'what was stated of the model holds' 'torque_sensor was ambiguous and is now rejected'; do
    check "summary.json does not say: $words" grep -q "\"words\":.*$words" round2/summary.json
done
check "measure_next.csv of something certain" [ ! -e round2/measure_next.csv ]
check "the list: $(tr '\n' ' ' <round2/declared/runs.csv)" [ "$(cut -d, -f1,2 round2/declared/runs.csv | tr '\n' ' ')" = \
    'file,role ../../a.csv,fit ../../b.csv,fit ../../c.csv,fit ../../later/back.csv,fit ../../later/held.csv,holdout ' ]
check "again in summary.json" grep -q '"within_bound":.*2' round2/summary.json
check "again in report.html" grep -q 'What the new recordings say of the last diagnosis' round2/report.html
recordings 0 0.05 third.csv:-60:6 # where friction was, a zero of the sensor is
printf 'file,role\nthird.csv,fit\n' >third_list.csv
run 1 diagnose --again round2 --runs third_list.csv -o round3
for words in 'what was stated of the model does not hold' 'What was promised of currents was not judged'; do
    check "summary.json does not say: $words" grep -q "\"words\":.*$words" round3/summary.json
done
mkdir moved && cp -R round2 a.csv b.csv c.csv later third.csv third_list.csv moved # the files belong together, not to a place
(cd moved && "$hci_solve" diagnose --again round2 --runs third_list.csv -q -o round3) >stdout 2>stderr
check "moved: $(cat stderr)" cmp -s round3/summary.json moved/round3/summary.json

# How the recordings were read goes along, and only for them.
for f in a b c; do
    sed '1s/torque_Nm/AI3/' "$f.csv" >"channel_$f.csv"
done
printf 'file,role\nchannel_a.csv,fit\nchannel_b.csv,fit\nchannel_c.csv,fit\n' >channel.csv
run 1 diagnose machine --runs channel.csv --column torque_Nm=AI3 -q -o channel
check "columns: $(sed -n 2p channel/declared/runs.csv)" [ "$(sed -n 2p channel/declared/runs.csv)" = '../../channel_a.csv,fit,torque_Nm=AI3,' ]
run 0 diagnose --again channel --runs later/list.csv --column torque_Nm=shaft -q -o channel2
check "other answers than by the name" cmp -s channel2/machine/effects.csv round2/machine/effects.csv
printf 'file,role,columns\nchannel_a.csv,fit,torque_Nm\n' >cell.csv
run 3 diagnose machine --runs cell.csv
says 'cell.csv:2: column `columns`: found `torque_Nm`, expected NAME=COLUMN'

# ---- wrong: one line that says what and where, and nothing is written

refused() { # CODE EXPRESSION WORD...
    code_wanted=$1 expression=$2
    shift 2
    run "$code_wanted" diagnose "$@" -q
    nothing_on_stdout
    one_line_is_said
    says "^hci-solve: .*$expression"
    check "something was written" [ ! -e refused ]
}

refused 2 'recordings are missing; add --runs LIST' machine -o refused
refused 2 'found 0 words, expected 1: MACHINE' --runs list.csv -o refused
refused 2 'found 1 word, expected 0: --again' machine --again out2 --runs list.csv -o refused
refused 3 'later/declared/machine.csv: found no such file, expected the --out of a diagnosis' --again later --runs list.csv -o refused
refused 3 'found .a.csv., expected new recordings only' --again out2 --runs list2.csv -o refused
"$hci_solve" diagnose machine --runs list2.csv --angle-offset 0.001 -q -o turned >stdout 2>stderr
refused 3 'no angle_offset for the new recordings, .* read with 0.001 degrees; add --angle-offset 0.001,' --again turned --runs later/list.csv --column torque_Nm=shaft -o refused
refused 2 'resolution' machine --runs list.csv --resolution -3 -o refused
refused 2 'resolution' machine --runs list.csv --resolution much -o refused
refused 2 'unknown|no option|--nosuch' machine --runs list.csv --nosuch
refused 3 'none.csv: .*No such file' machine --runs none.csv -o refused
refused 3 'nomachine' nomachine --runs list.csv -o refused
wrong_list() { # EXPRESSION TEXT [OPTION]
    printf "$2" >wrong.csv
    # shellcheck disable=SC2086
    refused 3 "$1" machine --runs wrong.csv ${3-} -o refused
}
wrong_list 'none.csv: .*No such file' 'file,role\nslow.csv,fit\nnone.csv,fit\n'
wrong_list 'wrong.csv:3: .*`fits`' 'file,role\nslow.csv,fit\nback.csv,fits\n'
wrong_list 'wrong.csv.*role' 'file\nslow.csv\n'
wrong_list '`fit`' 'file,role\nslow.csv,holdout\n'
cut -d, -f1-6 slow.csv >notorque.csv
printf 'file,role\nnotorque.csv,fit\n' >notorque_list.csv
run 1 diagnose machine --runs notorque_list.csv -o notorque # nothing can be said, and that is written
says 'notorque_list.csv: unknown$' 'Nothing can be said: no recording to fit to' 'torque_Nm'
check "the machine as it is declared" cmp -s machine/back_emf.csv notorque/machine/back_emf.csv
check "a report" [ -s notorque/report.html ]
cp machine/machine.csv machine.kept # a log without a torque is no free shaft, and its load takes no magnets away
echo 'inertia,0.001,kgm2,test' >>machine/machine.csv
printf 'file,role\nback.csv,fit\nnotorque.csv,fit\n' >loaded.csv
run 0 diagnose machine --runs loaded.csv
says 'no free shaft: by the model the current makes 0.6 N·m on average' 'its load is not known, so that only what varies is used' 'notorque.csv +fit'
echo 'rated_current,30,A,test' >>machine/machine.csv
printf 'file,role\nnotorque.csv,fit\n' >load.csv
run 1 diagnose machine --runs load.csv -o loaded # a load could be friction; no answer is refused
says 'load.csv: (ambiguous|partly explained)$' '^  (added|ambiguous) +friction'
check "no magnet is taken away" [ -z "$(grep ',back_emf,added' loaded/effects.csv)" ]

# A torque with the wrong sign is that, and a tenth of it is described best by a machine that nobody would believe.
for f in slow back held; do
    awk -F, -v OFS=, 'NR > 1 { $7 = -$7 } 1' "$f.csv" >"turned_$f.csv"
    awk -F, -v OFS=, 'NR > 1 { $7 = 0.1 * $7 } 1' "$f.csv" >"weak_$f.csv"
done
for list in turned weak; do
    printf 'file,role\n%s_slow.csv,fit\n%s_back.csv,fit\n%s_held.csv,holdout\n' $list $list $list >$list.csv
    run 1 diagnose machine --runs $list.csv -o $list
    says "$list.csv: unknown$"
    check "written all the same" [ -s $list/report.html ]
    check "only what is unknown is added" [ "$(grep ',added,' $list/effects.csv | cut -d, -f2)" = unknown ]
done
says 'values that'
check "what was left out" grep -q '"left_out":.*"back_emf"' weak/summary.json
check "a sign" grep -q 'with the opposite sign' turned/summary.json
for f in slow back held; do
    awk -F, -v OFS=, '{ b = $5; $5 = $6; $6 = b } 1' "$f.csv" | sed '1s/.*/time_s,theta_m_rad,speed_rad_per_s,ia_A,ib_A,ic_A,torque_Nm/' >"swapped_$f.csv"
done
printf 'file,role\nswapped_slow.csv,fit\nswapped_back.csv,fit\nswapped_held.csv,holdout\n' >swapped.csv
run 1 diagnose machine --runs swapped.csv
says 'check finds: phases b and c of the recordings are swapped' 'swapped_slow.csv:1: column ia_A' 'No effect was looked for'
sed 's/pole_pairs,2/pole_pairs,4/' machine.kept >machine/machine.csv
run 1 diagnose machine --runs list.csv -o poles # nor beside poles that were given for pole pairs
says 'list.csv: unknown$' 'check finds: pole_pairs is the number of poles' 'No effect was looked for'
check "an effect" [ "$(cut -d, -f2,3 poles/effects.csv | grep -c -e ,added -e ,ambiguous)" -eq 1 ]
check "a run to record next" [ ! -e poles/measure_next.csv ]
mv machine.kept machine/machine.csv
sed '4s/.*/1,2,3/' slow.csv >short.csv
wrong_list 'short.csv:4: ' 'file,role\nback.csv,fit\nshort.csv,fit\n' --strict
sed '7s/,60,/,nan,/' slow.csv >nan.csv
wrong_list 'nan.csv:7: column 3 `speed_rad_per_s`' 'file,role\nnan.csv,fit\n' --strict
printf 'effect,parameter,value,unit,std_error\nnosuch,a,1,A,\n' >machine/effects.csv
refused 3 'effects.csv:2: .*nosuch' machine --runs list.csv -o refused
rm machine/effects.csv

# ---- not written: older results stay, and nothing of the new ones is seen

snapshot() {
    (cd "$1" && find . -type f -exec cksum {} + | sort)
}
mkdir -p old/machine && echo mine >old/errors.csv && echo mine >old/machine/back_emf.csv && mkdir old/effects.csv
snapshot old >before
run 5 diagnose machine --runs list.csv -q -o old
says '^hci-solve: .*old/effects.csv: .*found a folder of this name'
snapshot old >after
check "older files have changed" cmp -s before after
rmdir old/effects.csv && rm -r old/machine && echo mine >old/machine
snapshot old >before
run 5 diagnose machine --runs list.csv -q -o old
says '^hci-solve: .*old/machine'
snapshot old >after
check "older files have changed" cmp -s before after
run 5 diagnose machine --runs list.csv -q -o list.csv

# A full disk: at each of these sizes of files, in blocks of 512 bytes, another one does not fit.
fitted=0
full=0
for blocks in 0 2 4 200 4000; do
    shown="ulimit -f $blocks; hci-solve diagnose"
    snapshot again >before
    (
        ulimit -f $blocks
        "$hci_solve" diagnose machine --runs list2.csv -q -o again 2>&1
        echo "exit $?"
    ) | cat >stderr
    snapshot again >after
    if grep -q '^exit 5$' stderr; then
        full=$((full + 1))
        check "older files have changed at $blocks blocks" cmp -s before after
    else
        fitted=$((fitted + 1))
        check "at $blocks blocks" diff -r again out2
    fi
done
check "no size was too small, or none large enough: $full, $fitted" [ $((full >= 3 && fitted >= 1)) -eq 1 ]

# ---- the machine that is read would be replaced

snapshot deep/out >before
run 2 diagnose deep/out/machine --runs list.csv -q -o deep/out
says 'replaced'
snapshot deep/out >after
check "the machine has changed" cmp -s before after

finish
