#!/bin/sh
# From logs to a table in one go: on logs of a simulated machine with known cogging torque the currents do on that machine what the report
# states; the steps are the ordinary commands; what a log does not hold is said, with exit code 1.
# labels: slow
#   cli_tune.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
use_plain_build
cd "$work" || exit 1

# ---- a machine, and logs of it as a drive with a torque sensor writes them

mkdir true
printf 'name,value,unit\npole_pairs,7,1\nrated_current,6,A\n' >true/machine.csv
printf 'order,amplitude_Nm_per_A,phase_rad\n1,0.1,0\n' >true/back_emf.csv
printf 'order,amplitude_Nm,phase_rad\n1.7142857142857142,0.004,0.7\n12,0.02,0.3\n' >true/cogging.csv
log() { # NAME TORQUE_Nm SPEED_rpm SEED
    printf 'name,value,unit\nduration,0.5,s\nprescribed_speed,%s,rpm\ncurrent_control,ideal,\nstrategy,id0,\ntorque_reference,%s,Nm\ntorque_noise,2,mNm\nseed,%s,\ntrajectory_every,6,\n' \
        "$3" "$2" "$4" >scenario.csv
    "$hci_solve" simulate true scenario.csv -q -o "$1" || exit 1
    awk -F, -v OFS=, 'NR == 1 { for (k = 1; k <= NF; ++k) c[$k] = k; print "time_s,theta_m_rad,speed_rad_per_s,ia_A,ib_A,ic_A,torque_Nm"; next }
        { print $c["time_s"], $c["theta_m_rad"], $c["speed_rad_per_s"], $c["ia_A"], $c["ib_A"], $c["ic_A"], $c["torque_Nm"] }' "$1/trajectory.csv" >"$1.csv"
}
log idle 0 240 1
log load 0.6 240 2
log back -0.4 -250 4
number() { # NAME FILE: the first number of that name
    sed -n "s/.*\"$1\":[[:space:]]*\([-0-9.e+]*\),*\$/\1/p" "$2" | head -n 1
}

# ---- what the report states is what the true machine does

run 0 tune idle.csv load.csv back.csv --pole-pairs 7 --flux 0.0142857142857143 --rated-current 6 -o out
says '^tuned: A ripple of 0\.04[0-9]* N·m from peak to peak falls to at most 0\.00[0-9]* N·m on the machine \(95 %\), of which the table makes 0\.00[0-9]' '^  - The figures are of currents that flow as in the table: a current loop adds no more than 0\.004[78] N·m, a tenth of what a plain sine leaves, up to [0-9.]* rpm for each 100 Hz' \
    'order 12: 0\.0(20|19)[0-9]* ± [0-9.e-]+ N·m' 'a torque without ripple of 0\.6 N·m' 'with i_q alone, as in the recordings' 'hci-solve emit out/currents --name tuned '
files_are() { check "files of $1: $(ls "$1" | tr '\n' ' ')" [ "$(ls "$1" | tr '\n' ' ')" = "$2 " ]; }
files_are out 'check commands.sh currents diagnose machine report.html runs.csv summary.json table target.csv'
check "code is not set as code" grep -q '<code>hci_currents_dq i' out/report.html
check "the orders are not set in" grep -q '<p class="of">order 12: ' out/report.html
files_are out/table 'tuned.c tuned.h'
bound=$(number T_ripple_percent_95 out/summary.json)
printf 'name,value,unit\nduration,0.3,s\nprescribed_speed,240,rpm\ncurrent_control,ideal,\ncurrents,out/currents/currents.csv,\n' >played.csv
run 0 simulate true played.csv -q -o played
ripple=$(number T_ripple played/summary.json)
check "of the bound the table makes $(number table_peak_to_peak_Nm out/summary.json) N·m" awk -v a="$(number peak_to_peak_Nm_95 out/summary.json)" \
    -v t="$(sed -n 's/.*cut to this table makes \([0-9.e-]*\) N.*/\1/p' out/table/tuned.h)" -v b="$(number peak_to_peak_Nm_95 out/currents/summary.json)" \
    'BEGIN { exit !(t > 0 && t < 0.02 * 0.047 && (a - b - t) ^ 2 < (1e-3 * t) ^ 2) }'
check "the true machine has $ripple % of ripple, stated were at most $bound %" awk -v a="$ripple" -v b="$bound" 'BEGIN { exit !(a > 0 && a <= b && b < 0.5) }'
# No log has i_d and no sheet L_d and L_q: the table is of i_q alone, and what i_d i_q makes is in none of its torque. With both declared i_d is used.
says_not() { check "said: $1" [ "$(grep -c "$1" stdout)" = 0 ]; }
cp -r out/machine round
printf 'inductance_d,0.1,mH,test\ninductance_q,0.1,mH,test\n' >>round/machine.csv
run 0 tune round --runs out/runs.csv -o out_round
says_not 'with i_q alone'
bound=$(number T_ripple_percent_95 out_round/summary.json)
check "the true machine has $ripple % of ripple, stated for a declared round rotor were at most $bound %" awk -v a="$ripple" -v b="$bound" 'BEGIN { exit !(a > 0 && a <= b && b < 0.3) }'
sed '/^inertia/d; /^dc_link_voltage/s/,[0-9.]*,/,24,/; /^resistance/s/,[0-9.]*,/,0.1,/' "$source_dir/data/drive/machine_a_10kHz.csv" >drive.csv
run 0 simulate true --table out/currents --drive drive.csv --speeds 20 -q -o speeds
check "through the current loop the table does not take the ripple away: $(cat speeds/speeds.csv)" \
    awk -F, '{ at[$2] = $3 } END { exit !(at["sine"] > 7 && at["compensation"] < 0.01 * at["sine"]) }' speeds/speeds.csv

# ---- i_d and i_q of a drive do not tell where the electrical zero is, whatever torque is measured beside them

for name in load back; do
    awk -F, -v OFS=, 'NR == 1 { print "time_s,theta_m_rad,speed_rad_per_s,id_A,iq_A,torque_Nm"; next }
        { x = 7 * $2; t = 2.0943951023931953; print $1, $2 + 0.2, $3, 0, 2 / 3 * ($4 * sin(x) + $5 * sin(x - t) + $6 * sin(x + t)), $7 }' "$name.csv" >"dq_$name.csv"
done
awk -F, -v OFS=, '{ print $1, NR == 1 ? $2 : $2 + 0.2, $3, $7 }' idle.csv >dq_idle.csv
run 0 tune dq_idle.csv dq_load.csv dq_back.csv --pole-pairs 7 --flux 0.0142857142857143 --rated-current 6 -o of_logs
says 'Where the electrical zero is: ' '--angle-of-logs'
check "the header says a zero that is not known" [ "$(grep -c 'the rising zero crossing of the fundamental' of_logs/table/tuned.h)" -eq 0 ]
check "whose zero the angle has" grep -q 'the zero of the logs, which do not tell where phase' of_logs/table/tuned.h

# ---- each step is the ordinary command

mkdir bin && ln -s "$hci_solve" bin/hci-solve
check "commands.sh fails" env PATH="$work/bin:$PATH" sh out/commands.sh repeated >"$work/stdout" 2>"$work/stderr"
rm -f out/report.html out/summary.json out/commands.sh
grep -rl repeated repeated | while read -r file; do sed -i 's/repeated/out/g' "$file"; done # the folder, where a report names it
# a page names its folder, and summary.json beside it has its checksum
find out repeated -name summary.json -exec sed -i '/"report.html":/d' {} +
find out repeated -name report.html -exec rm {} +
check "the steps are other ones: $(diff -rq out repeated)" diff -rq out repeated
run 0 tune true --runs out/runs.csv --torque 0.5 --name smooth --json -o listed
check "not the torque that was asked for" grep -q 'N·m: as asked for by --torque"' "$work/stdout"
check "summary.json is not what --json says" cmp -s "$work/stdout" listed/summary.json
check "no table of that name" [ -s listed/table/smooth.h ]

# ---- logs that do not hold it

awk -F, -v OFS=, '{ print $1, $3 }' idle.csv >clock.csv
run 1 tune clock.csv --pole-pairs 7 --flux 0.0142857 -o clock
says '^not enough in the logs: The log has no angle of the rotor' 'Log the angle of the rotor beside the current'
files_are clock 'check commands.sh machine report.html runs.csv summary.json'
# voltages of the open machine beside sensors that show no current but their noise
awk 'BEGIN { srand(3); print "theta_e_rad,speed_rad_per_s,va_V,vb_V,vc_V,ia_A,ib_A,ic_A"; turn = 6.283185307179586
    for (k = 0; k < 700; ++k) { x = turn * k / 100; y = x - turn / 3; z = x + turn / 3
        printf "%.9f,10,%.9f,%.9f,%.9f,%.4f,%.4f,%.4f\n", x, sin(x) + 0.05 * sin(5 * x), sin(y) + 0.05 * sin(5 * y), sin(z) + 0.05 * sin(5 * z),
            0.02 * (rand() - 0.5), 0.02 * (rand() - 0.5), 0.02 * (rand() - 0.5) } }' >open.csv
run 1 tune open.csv --pole-pairs 7 --flux 0.0142857 -o open
says '^tuned.*: No log has a torque, so the table takes no cogging torque away; the ripple that the measured back-EMF makes, 0\.015 N·m from peak to peak, falls to [^;]* in the model$' 'order 5: 0\.005 ± ' 'what 1 A makes' 'No recording tells of the cogging torque'
run 1 tune open.csv --pole-pairs 7 --flux 0.0142857 --slots 12 -o open_slots # orders that are known and amplitudes that are not
says '^tuned.*: No log has a torque, so the table takes no cogging torque away; the ripple'
check "a torque is not explained that nobody measured" [ "$(grep -Ec '(does|has) not explain' "$work/stdout")" -eq 0 ]
sed '1s/$/,Torque of bench 9,torque_command_Nm/; 2,$s/$/,0.1,0.1/' open.csv >unread.csv
run 1 tune unread.csv --pole-pairs 7 --flux 0.0187 -o half
says "^tuned.*: No log has a torque, .* if the column .Torque of bench 9. is one, add --column 'torque_Nm=Torque of bench 9';" \
    '^tuned' '^  - The measured back-EMF is 0\.76[0-9]* times that of the data sheet' 'Which back-EMF is right: ' 'order 1: 0\.1 ± '
awk -F, 'NR > 1 { print $2, $7 }' OFS=, idle.csv | sed '1i theta_m_rad,torque_Nm' >torque.csv
run 1 tune torque.csv --poles 12 --slots 12 --flux 0.0142857 -o slip
says '^a convention is broken: Most likely .* %\), so nothing was solved$' 'slip: '
# a sign that two slips explain is certain all the same, and so is a torque from the other side of a gear
for wrong in 'negative -1' 'geared 8'; do
    for name in idle load back; do
        awk -F, -v OFS=, -v times="${wrong#* }" 'NR > 1 { $7 *= times } 1' $name.csv >"${name}_${wrong% *}.csv"
    done
done
run 1 tune idle_negative.csv load_negative.csv back_negative.csv --pole-pairs 7 --flux 0.0142857142857143 -o negative
says '^a convention is broken: (Something is read wrongly|Most likely) .*, so nothing was solved'
run 1 tune idle_geared.csv load_geared.csv back_geared.csv --pole-pairs 7 --flux 0.0142857142857143 -o geared
says '^a convention is broken: The torque is [78](\.[0-9]*)? times what the currents make .* of a gear'
check "a table although a convention is broken" [ ! -e slip/table ]

# ---- a slow turn of a hobby drive: forward and back, which nobody has to say; the encoder's zero is not known; a shaft that sticks is refused

# NAME SHARE: i_q answers cogging torque of order 12 at 12 rpm; its speed varies by this share at that order
slow_turn() { # FILE SHARE: the speed varies by it; cogging torque has no mean over the angle
    awk -v share="$2" 'BEGIN { srand(1); print "ms_today;erpm;q_axis_current;encoder_position"; turn = 6.283185307179586; w = 1.2566
        for (k = 0; k < 2000; ++k) { t = 0.01 * k; way = t < 10 ? 1 : -1; x = w * (10 + (t - 10) * way); n = 84 * x
            printf "%d;%.3f;%.5f;%.5f\n", 1000 * t, way * w * 66.84507 * (1 + share * cos(n)),
                way * 0.05 + 0.3 * (sin(n + 0.4) - share / 2 * sin(0.4)) + 0.004 * (rand() - 0.5), (x + share * sin(n) / 84) * 57.29577951 % 360 } }' >"$1"
}
slow_turn slow.csv 0.1
run 0 tune slow.csv --pole-pairs 7 --kv 120 -o slow
check "not said: turned slowly forward and back" grep -q 'turned slowly forward and back' slow/summary.json
says '^tuned: .* in the model; what harmonics of the real back-EMF add under load is not known' '^  - The figures are of' \
    'Where the electrical zero is: ' '  order 12: 0\.02[0-9]* ± ' '--max-order 60'
check "cogging torque is found twice: $(grep -c 'cogging' "$work/stdout")" [ "$(grep -c '^  order 12: ' "$work/stdout")" = 0 ]
check "what was not looked at is known to 0 ± 0" [ "$(grep -c '= 0 ± 0' slow/summary.json)" -eq 0 ]
check "a shaft with friction has sensors to correct" [ "$(grep -c 'true current' slow/currents/summary.json)" -eq 0 ]
check "orders that the motor has not, in a table of several turns" grep -q 'emit slow/currents --name tuned --for simplefoc ' slow/summary.json
check "not said up to which torque" grep -q 'N·m, for which it was solved' slow/summary.json
check "the electrical speed does not count the pole pairs" [ "$(grep -c 'nothing in these logs counts them' slow/summary.json)" -eq 0 ]
check "the table's period is not said" grep -q "the angle is $(sed -n 's/.*2^32 = \([0-9]* electrical turns*\).*/\1/p' slow/table/tuned.h) from" slow/summary.json
# the same in two files, one for each direction: neither of them tells it by itself
slow_turn both.csv 0.02
head -1001 both.csv >there.csv
sed -n '1p; 1002,$p' both.csv >back.csv
run 0 tune there.csv back.csv --pole-pairs 7 --kv 120 -o apart
says '^tuned: ' '  order 12: 0\.02[0-9]* ± ' 'forward in one recording and back in another'
check "each step can be repeated" grep -q 'harmonics there.csv .* --holding' apart/commands.sh
# voltages without an angle beside it: their size is taken, and not their harmonics, whose phases are of another zero
awk 'BEGIN { print "Time (s),CH1 (V),CH2 (V),CH3 (V)"; turn = 6.283185307179586
    for (k = 0; k < 4000; ++k) { x = turn * k / 100 + 1; y = x - turn / 3; z = x + turn / 3
        printf "%.6f,%.6f,%.6f,%.6f\n", k / 5000, 2.06 * (sin(x) + 0.05 * sin(5 * x)), 2.06 * (sin(y) + 0.05 * sin(5 * y)), 2.06 * (sin(z) + 0.05 * sin(5 * z)) } }' >scope.csv
run 0 tune scope.csv slow.csv --pole-pairs 7 --kv 120 -o scope # all of it is explained: the row in which the shaft turns round is not used
says '^tuned' 'Where the back-EMF of scope.csv lies beside the angle' 'order 5: '
check "harmonics of another zero are in the machine: $(cat scope/machine/back_emf.csv)" [ "$(wc -l <scope/machine/back_emf.csv)" -eq 2 ]
# against a brake, there and back: the ripple of the back-EMF turns its sign with the load, and is no cogging torque
for way in 1 -1; do
    awk -v way="$way" 'BEGIN { srand(5); print "time_s,pos_rad,speed_rad_per_s,iq_A"; w = 1.2566
        for (k = 0; k < 2000; ++k) { t = 0.01 * k; x = way * w * t
            printf "%.3f,%.5f,%.4f,%.5f\n", t, x, way * w,
                (way * 0.4 - 0.02 * sin(84 * x)) / (0.15 * (1 + 0.03 * cos(42 * x))) + 0.02 * (rand() - 0.5) } }' >"brake$way.csv"
done
run 1 tune brake1.csv brake-1.csv --pole-pairs 7 --flux 0.0142857142857143 --inertia 1e-4 -o brake # no less is promised than without the table
says '^tuned, with something left open: .* do not promise less' 'slowly by control' '  order 12: 0\.0(2|20|19)[0-9]* ± ' '  order 5 or 7: 0\.00(3|29|30)[0-9]* ± .* N·m/A' \
    'a torque without ripple of 0\.4 N·m: what the recorded current makes against'
check "cogging torque from one direction of it" [ "$(grep -c 'harmonics' brake/commands.sh)" -eq 0 ]
# voltages that are mostly what the current drops are no back-EMF, rated for much or not
awk -F';' -v OFS=';' 'NR > 1 { $3 += 0.03 * sin(7 * $4 / 57.29577951) } { print $0, NR == 1 ? "d_axis_voltage;q_axis_voltage" : "0;" 0.5 * $3 + $2 / 66.84507 * 0.08 }' slow.csv >volts.csv
run 0 tune volts.csv --pole-pairs 7 --kv 120 --slots 12 --rated-current 20 -o volts
says '^tuned: .* in the model; what harmonics of the real back-EMF add ' 'The back-EMF is not taken from the voltages of volts.csv: '
check "order 1 is not said to be an offset" grep -q 'order 1 is of the machine: an offset of the current sensors, 0\.03 A of i_q, makes order 1 whatever the load, and magnets or teeth that are not alike make it too' volts/summary.json
check "not said what follows the current, nor what to record" grep -q 'and [89][0-9] % of the voltage follows them\. Record voltages with open terminals' volts/summary.json
check "a back-EMF from a driven machine" [ "$(grep -c back_emf volts/commands.sh)" -eq 0 ]
for folder in slow volts; do
    check "whose zero the angle of $folder has" grep -q 'the zero of the logs, which do not tell where phase' $folder/table/tuned.h
    check "the header says a zero that nobody knows" [ "$(grep -c 'the rising zero crossing of the fundamental' $folder/table/tuned.h)" -eq 0 ]
    check "the report of $folder does not say that the zero is not known" grep -q 'Where the electrical zero is: ' $folder/summary.json
done
check "orders that were looked at are said to be not" [ "$(grep -c 'was not looked at' volts/summary.json)" -eq 0 ]
# polled so slowly that the order of slots and poles is out of reach
awk 'NR % 20 == 1' slow.csv >sparse.csv
run 1 tune sparse.csv --pole-pairs 7 --kv 120 --slots 12 -o sparse
says '^the samples lie too far apart: ' '^  - Order 12, which slots and poles make, was not looked at$' \
    'The cogging torque of slots and poles, order 12: orders above 1\.2857 were not' 'Turn more slowly, or log more often: four samples'
check "an alias goes into a table" [ ! -e sparse/table ]
# the index of the encoder is 31 degrees off: taken out everywhere, and the fundamental is the zero
awk 'BEGIN { print "time_s,theta_e_deg,speed_rad_per_s,va_V,vb_V,vc_V"; turn = 6.283185307179586
    for (k = 0; k < 700; ++k) { x = turn * k / 100; y = x - turn / 3; z = x + turn / 3
        printf "%.9f,%.9f,10,%.9f,%.9f,%.9f\n", x / 70, 31 + x * 360 / turn, sin(x) + 0.05 * sin(5 * x), sin(y) + 0.05 * sin(5 * y), sin(z) + 0.05 * sin(5 * z) } }' >index.csv
awk -F, -v OFS=, 'NR == 1 { print; next } { $2 += 59; print }' index.csv >crest.csv # it happens to lie on an axis, which is no other thing
run 1 tune crest.csv --pole-pairs 7 --flux 0.0142857 -o crest
says 'angle-offset -90\.0[0-9]*: the electrical zero of the angle, by ' 'order 5: 0\.005 ± '
run 1 tune index.csv --pole-pairs 7 --flux 0.0142857 -o index
says 'angle-offset -31\.0[0-9]*: the electrical zero of the angle, by ' 'order 5: 0\.005 ± ' 'from the zero of the logs with --angle-offset -31'
check "the fundamental is not the zero: $(cat index/machine/back_emf.csv)" awk -F, '$1 == 1 { found = $3 ^ 2 < 1e-6 } END { exit !found }' index/machine/back_emf.csv
check "later steps lack the offset" grep -q 'diagnose.*--angle-offset -31' index/commands.sh
check "a map of another drive lacks the zero that was found" grep -q 'takes --encoder-offset 4\.42[89]' index/summary.json
check "the first turn is checked without the zero" grep -q 'check .*--table .* --angle-offset -31' index/summary.json
# a shaft that sticks is left out beside one that does not
slow_turn jerks.csv 0.9
run 0 tune jerks.csv slow.csv --pole-pairs 7 --kv 120 -o jerks
says '^tuned: ' '^  - 1 of 2 logs left out$' 'varies by [0-9]+ % rms' 'What of the current in jerks.csv answers cogging torque'
check "the table is not that of the log that is kept" cmp -s jerks/table/tuned.c slow/table/tuned.c
check "a step has the log that is left out" [ "$(grep -v '^for log\|check' jerks/commands.sh | grep -c 'jerks.csv')" -eq 0 ]

# ---- wrong

run 2 tune idle.csv --pole-pairs 7 --kv 100
says 'tune: add --out FOLDER'
run 2 tune idle.csv --pole-pairs 7 -o nothing
says 'init: nothing says how strong the magnets are' 'the step `init` failed'
run 2 tune idle.csv --pole-pairs x --kv 100 -o nothing
says '--pole-pairs: found `x`'
run 2 tune true load.csv --runs runs.csv -o nothing
says 'found 2 words, expected one machine beside --runs LIST'
check "something is left" [ ! -e nothing ]
run 3 tune none.csv --pole-pairs 7 --kv 100 -o none
says 'none.csv: No such file'
sed 's/,theta_m_rad,/,turned,/' idle.csv >unnamed.csv
run 3 tune unnamed.csv --pole-pairs 7 --kv 100 -o none
says '--column theta_m_deg=COLUMN'
check "what failed is left: $(ls none 2>/dev/null)" [ ! -e none ]
run 3 tune out/runs.csv --pole-pairs 7 --kv 100 -o none
says 'out/runs.csv: found a list of recordings' '--runs'

# ---- a shaft that runs out: the slope of its speed, from noisy samples, hides the cogging torque of its slots

awk 'BEGIN { srand(3); print "time_s,theta_m_rad,speed_rad_per_s"; J = 2.1e-4; w = 120; h = 1e-4
    for (n = 0; w > 6; ++n) {
        if (n % 10 == 0) printf "%.4f,%.6f,%.4f\n", n * h, x, w + 0.2 * (rand() - 0.5)
        w += h / J * (-0.006 - 2e-5 * w + 0.004 * sin(84 * x + 0.4)); x += h * w } }' >coast.csv
run 1 tune coast.csv --pole-pairs 14 --kv 90 --inertia 2.1e-4 --slots 12 -o coast
says '^a table of no use: Nothing was found ' '^  - These recordings do not show cogging torque above order 0\.[0-9]*' '^  - That there are 14 pole pairs is taken on trust, since nothing in these logs counts them$' 'Cogging torque above the electrical order 0\.[0-9]*: '

finish
