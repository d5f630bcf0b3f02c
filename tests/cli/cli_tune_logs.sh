#!/bin/sh
# Logs that a table cannot be made of: no angle, a torque that was typed, currents in mA, a shaft that sticks. Nothing is searched in them: it takes a second.
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

# ---- a shaft that sticks

slow_turn jerks.csv 0.9
run 1 tune jerks.csv --pole-pairs 7 --kv 120 -o jerks
says '^the shaft sticks and slips: ' 'varies by [0-9]+ % rms' 'What of the current in jerks.csv answers cogging torque' 'Turn the shaft evenly'
refused jerks

finish
