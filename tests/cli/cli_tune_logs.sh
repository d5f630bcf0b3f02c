#!/bin/sh
# Logs that a table cannot be made of: no angle, a torque that was typed, currents in mA or of the other sign, a shaft that sticks. Nothing is searched in them: it takes a second.
#   cli_tune_logs.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
cd "$work" || exit 1
refused() { # FOLDER: no table, and nothing solved
    check "a table in $1" [ ! -e "$1/table" ]
    check "a zero of the table that is not there" [ "$(grep -c 'angle of the table is that of the logs' "$1/summary.json")" -eq 0 ]
}

# NAME SHARE: i_q answers cogging torque of order 12 at 12 rpm; its speed varies by this share at that order
slow_turn() {
    awk -v share="$2" 'BEGIN { srand(1); print "timestamp_ms,vel_estimate,encoder_counts,pos_estimate,Iq_measured"; turn = 6.283185307179586; w = 1.2566
        for (k = 0; k < 2000; ++k) { t = 0.01 * k; way = t < 10 ? 1 : -1; x = w * (10 + (t - 10) * way); n = 84 * x; at = x + share * sin(n) / 84
            printf "%d,%.5f,%d,%.5f,%.5f\n", 1000 * t, way * w * (1 + share * cos(n)) / turn, at / turn * 4000, at / turn, way * 0.05 + 0.3 * sin(n + 0.4) } }' >"$1"
}
slow_turn slow.csv 0.1

# ---- no angle: a table over one whose zero nobody knows cannot be played, with the inertia or without

awk -F, -v OFS=, '{ print $1, $2, $5 }' slow.csv >bare.csv
for inertia in '' '--inertia 1e-5'; do
    run 1 tune bare.csv --pole-pairs 7 --kv 120 $inertia -o "bare$inertia"
    says '^not enough in the logs: The log has no angle of the rotor, ' 'Log the angle of the rotor beside the current'
    check "asks for the inertia first" [ "$(grep -c 'Give --inertia' "$work/stdout")" -eq 0 ]
    refused "bare$inertia"
done
awk -F, -v OFS=, '{ print $1, $2, $3, $5 }' slow.csv >counts.csv
run 1 tune counts.csv --pole-pairs 7 --kv 120 --inertia 1e-5 -o counts
check "the column of counts is not named" grep -q "say which column it is: --column 'theta_m=encoder_counts/4000'" counts/summary.json
says '^not enough in the logs: The log has no angle of the rotor, '
refused counts

awk -F, -v OFS=, '{ print $1, $2, $4 }' slow.csv >turned.csv
run 1 tune turned.csv --pole-pairs 7 --kv 120 -o turned
says '^not enough in the logs: The logs tell neither' 'turn the shaft slowly under position control'

# ---- a torque that somebody typed

awk -F, -v OFS=, '{ print $1, $2, $4, 3 + $5 + ($5 < 0 ? 0.01 : 0), NR == 1 ? "torque_Nm" : 0.4 }' slow.csv | sed '1s/,3,/,Iq_measured,/' >typed.csv
for inertia in '' '--inertia 1e-5'; do
    run 1 tune typed.csv --pole-pairs 7 --kv 120 $inertia -o "typed$inertia"
    says '^not enough in the logs: The torque in the log is one number in every row, typed and not measured' \
        'The ripple in typed.csv: its torque is one number in every row' 'take the brake off, leave the column out'
    check "the number is not said" grep -q 'the torque is 0.4 N·m in every row while the current varies' "typed$inertia/summary.json"
    refused "typed$inertia"
done

# ---- mA under a name that is read as A

awk -F, -v OFS=, '{ print $1, $2, $4, NR == 1 ? $5 : 1000 * $5 }' slow.csv >milli.csv
run 1 tune milli.csv --pole-pairs 7 --kv 120 -o milli
says '^a convention is broken: ' 'slip: the currents are in mA \(9[0-9]\.[0-9] %\)'
check "the remedy is not named" grep -q "in mA: --column 'iq_mA=Iq_measured'" milli/summary.json
refused milli
# degrees in a column that is read in turns look like jerks: it is the unit that is said
awk -F, -v OFS=, '{ print $1, $2, NR == 1 ? $4 : 360 * $4, $5 }' slow.csv >degrees.csv
run 1 tune degrees.csv --pole-pairs 7 --kv 120 -o degrees
says '^(the conventions are not understood|a convention is broken): '
check "the unit is not said" grep -q '360 is degrees in a column that is read in turns' degrees/summary.json
check "jerks are accused" [ "$(grep -c 'Turn the shaft evenly\|left out' degrees/summary.json)" -eq 0 ]
refused degrees

# ---- i_q, or angle and speed, with the opposite sign: a table of it would double the ripple

# NAME CURRENT MOTION SPEED...: a shaft of 1e-4 kg·m² under speed control, a second at each speed, with cogging torque of order 12 and friction; signs
spin() {
    awk -v current="$2" -v motion="$3" -v speeds="$4" 'BEGIN { srand(2); print "time_s,theta_m_rad,speed_rad_per_s,iq_A"; n = split(speeds, set, " "); w = set[1]
        for (k = 0; k < 10000 * n; ++k) {
            want = set[1 + int(k / 10000)]; sum += (want - w) * 1e-4; iq = 0.1 * (want - w) + sum
            if (k % 10 == 0) printf "%.4f,%.6f,%.4f,%.5f\n", 1e-4 * k, motion * x, motion * w, current * iq + 0.005 * (rand() + rand() - 1)
            w += (0.069 * iq + 0.012 * sin(84 * x + 0.4) - (w > 0 ? 1 : -1) * (0.004 + 0.00002 * (w > 0 ? w : -w))) / 1e-4 * 1e-4; x += 1e-4 * w } }' >"$1"
}
is_refused() { # NAME: by one of both signs, and each of the other motion too
    for signs in '-1 1' '1 -1'; do
        spin "$1" ${signs% *} ${signs#* } "$2"
        run 1 tune "$1" --pole-pairs 7 --kv 120 --inertia 1e-4 -o "$1$signs"
        says '^a convention is broken: ' "$3"
        refused "$1$signs"
    done
}
is_refused spin.csv '6 15 30 -6 -15 -30' 'the currents are counted out of the machine, or angle and speed are both backward'
is_refused one.csv '10 10 10' 'angle and speed'
spin right.csv 1 1 '6 15 30 -6 -15 -30'
run 0 tune right.csv --pole-pairs 7 --kv 120 --inertia 1e-4 -o right
says '^tuned: '
check "a sign is accused" [ "$(grep -c 'works against\|Whether i_q drives' right/summary.json)" -eq 0 ]
# a holding map: friction there and back tells it; without friction nothing does, and that is said
map() { # NAME SIGN FRICTION_A
    awk -v sign="$2" -v friction="$3" 'BEGIN { print "theta_m_rad,iq_A,torque_Nm"
        for (k = 0; k < 1440; ++k) { there = k < 720; x = 6.283185307179586 / 720 * (there ? k : 1439 - k)
            printf "%.6f,%.6f,0\n", x, sign * ((there ? 1 : -1) * friction - 0.2 * sin(84 * x + 0.4)) } }' >"$1"
}
map against.csv -1 0.06
run 1 tune against.csv --pole-pairs 7 --kv 120 -o against
says '^a convention is broken: i_q works against the motion in against.csv: i_q has the opposite sign, or angle and speed have'
refused against
map smooth.csv 1 0
run 0 tune smooth.csv --pole-pairs 7 --kv 120 -o smooth
says '^tuned: ' '^  - The sign of i_q is not told, and with the other one the ripple doubles' 'Whether i_q drives the shaft the way in which the angle is counted'

# phase currents of a drive that keeps its i_d at 0 tell it too, count the pole pairs, and show where the zero is
phases() { # NAME OFF_deg FRICTION_A HASTENED: the zero of the angle is so much behind the drive's; hastened by so much against its cogging torque of 0.2 A
    awk -v off="$2" -v friction="$3" -v hastened="$4" 'BEGIN { srand(4); third = 6.283185307179586 / 3; print "time_s,theta_m_rad,ia_A,ib_A,ic_A"; way = 1
        for (k = 0; x >= 0; ++k) { answer = 0.2 * sin(84 * x + 0.4); x += way * 0.005 * 0.6 * (1 + hastened * answer * way); if (x > 12.8) way = -1
            q = way * friction + 0.2 * sin(84 * x + 0.4) + 0.004 * (rand() - 0.5); e = 7 * x + off / 360 * 3 * third
            printf "%.3f,%.7f,%.5f,%.5f,%.5f\n", 0.005 * k, x, q * sin(e), q * sin(e - third), q * sin(e + third) } }' >"$1"
}
phases phases.csv 0 0.06 -0.5
run 0 tune phases.csv --pole-pairs 7 --kv 120 -o phases
says '^tuned: '
check "phase currents tell nothing" [ "$(grep -c 'Whether i_q drives\|taken on trust' phases/summary.json)" -eq 0 ]
phases half.csv 180 0.06 -0.5
run 1 tune half.csv --pole-pairs 7 --kv 120 -o half
says '^a convention is broken: .*the zero of the angle is half an electrical turn off, .*--angle-offset 180'
run 0 tune half.csv --pole-pairs 7 --kv 120 --angle-offset 180 -o half
phases third.csv 60 0.06 -0.5
run 1 tune third.csv --pole-pairs 7 --kv 120 -o third
says '^tuned, with something left open: ' '^  - .*do not lie along the i_q of this angle: .*--angle-offset 60 or -120 is right'
run 0 tune third.csv --pole-pairs 7 --kv 120 --angle-offset 60 -o third
# a current without friction has a mean that turns round with the motion, where the shaft is longer where it is slow, and is accused of nothing
phases ideal_phases.csv 0 0 0.25
awk -F, -v OFS=, 'NR == 1 { print "time_s,theta_m_rad,iq_A"; next } { e = 7 * $2; print $1, $2, 2 / 3 * ($3 * sin(e) + $4 * sin(e - 2.0943951) + $5 * sin(e + 2.0943951)) }' ideal_phases.csv >ideal.csv
"$hci_solve" tune ideal.csv --pole-pairs 7 --kv 120 -o ideal >stdout 2>stderr
check "a shaft without friction is accused" [ "$(grep -c 'works against' ideal/summary.json)" -eq 0 ]

# ---- an offset of the angle, with which the logs were read, is in the table

run 0 tune smooth.csv --pole-pairs 7 --kv 120 --angle-offset -31 -o offset
says '^  - The table is over the angle of the logs with --angle-offset -31: .* add -31 electrical degrees to it'
check "the header has no offset" grep -q 'theta = pole pairs \* mechanical angle + (-31) degrees electrical' offset/table/tuned.h
check "commands.sh has no offset for emit" grep -q 'hci-solve emit .* --angle-offset -31' offset/commands.sh
check "an offset nobody gave" [ "$(grep -c 'degrees electrical' smooth/table/tuned.h)" -eq 0 ]

# ---- a shaft that sticks

slow_turn jerks.csv 0.9
run 1 tune jerks.csv --pole-pairs 7 --kv 120 -o jerks
says '^the shaft sticks and slips: ' 'varies by [0-9]+ % rms' 'What of the current in jerks.csv answers cogging torque' 'Turn the shaft evenly'
refused jerks

finish
