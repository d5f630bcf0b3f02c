#!/bin/sh
# Slow turns against a brake as drives log them: a shaft that waits, one that turns round with a jerk, and brakes of two sizes, whose mean nobody
# knows. The sign of i_q is told either way, the ripple beside the load is found, and nothing is said of what the load hides.
# labels: slow
#   cli_tune_loads.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
use_plain_build
cd "$work" || exit 1

# 5 pole pairs, 12 slots, 0.1 N·m/A: cogging torque of order 12, 0.004 N·m, a back-EMF of order 5, 2 %, friction
# and a brake; forward two turns and back at 0.6 rad/s. WAIT: s at the start and at the turning point, in which the
# speed dithers and i_q stays where friction lets it; JERK: 1: the shaft overshoots after it has turned round. ARM_Nm: once a turn.
brake_log() { # FILE BRAKE_Nm WAIT_s JERK SIGN SEED [ARM_Nm]
    awk -v brake="$2" -v wait="$3" -v jerk="$4" -v sign="$5" -v seed="$6" -v arm="${7:-0}" 'BEGIN { srand(seed); print "time_s,theta_m_rad,speed_rad_per_s,iq_A"
        turn = 6.283185307179586; w = 0.6; one = 2 * turn / w; x = 0.4; t = 0; dt = 0.005; stuck = 0
        while (t < 2 * wait + 2 * one) {
            goes = t < wait ? 0 : t < wait + one ? 1 : t < 2 * wait + one ? 0 : -1
            v = goes * w
            since = t - 2 * wait - one
            if (jerk && since > 0 && since < 0.4) v *= 1 + 0.9 * cos(8 * since) * exp(-6 * since)
            q = (goes * brake + arm * cos(x + 0.7) + 0.004 * sin(12 * 5 * x + 0.3)) / (0.1 + 0.002 * sin(6 * 5 * x + 0.3))
            if (jerk && since > -0.1 && since < 0.1) q = 5 * (0.1 - since) * brake * 2 / 0.1 - brake / 0.1
            if (goes) stuck = q; else q = 0.97 * stuck
            printf "%.4f,%.6f,%.4f,%.5f\n", t, x + 2e-4 * (rand() - 0.5), v + (rand() - 0.5) * (goes ? 0.05 : 0.25), sign * (q + 0.01 * (rand() - 0.5))
            x += v * dt; t += dt } }' >"$1"
}
motor='--pole-pairs 5 --flux 0.0133333333333333 --slots 12 --torque 0.06'
rated='--pole-pairs 5 --flux 0.0133333333333333 --slots 12 --rated-current 1'

# ---- a shaft that waits is accused of nothing, and one whose current is counted the other way still is

brake_log waits.csv 0.04 1.5 0 1 1
run 1 tune waits.csv $motor -o waits # no less is promised than without the table
says '^tuned, with something left open: .* do not promise less' '^  conventions: consistent' '  order 12: 0\.00(40|399)[0-9]* ± ' 'rows are not used'
check "waiting rows are not counted" grep -q '[0-9][0-9]* of [0-9]* rows are not used: in [0-9]* the shaft waits' waits/summary.json
brake_log against.csv 0.04 1.5 0 -1 1
run 1 tune against.csv $motor -o against
says '^a convention is broken: .*(counted out of the machine|backward|works against the motion)'

# ---- the mean is a load, and no friction; no torque was measured, and no bound of the mean is stated

check "a brake is called friction" [ "$(grep -c 'friction (added)' waits/summary.json)" -eq 0 ]
check "the load is not said" grep -q 'i_q makes 0\.040* N·m forward and -0\.040* N·m back on the average: a load, friction and what brakes together' waits/summary.json
check "a bound of a mean that nobody measured" [ "$(grep -c 'as the torque was measured' waits/summary.json waits/report.html | sed 's/.*://' | sort -u)" = 0 ]
check "a current of rounding" [ "$(grep -c 'e-1[0-9] A' waits/report.html)" -eq 0 ]
check "what says that the constant is declared" grep -q '^torque_constant,declared,' waits/diagnose/machine/diagnosis.csv

run 0 tune waits.csv $rated -o rated # the two directions of a brake add up to nothing, and are a load
says 'a torque without ripple of 0\.04[0-9]* N·m: what the recorded current makes against'
check "a brake is no load" [ "$(grep -c 'no recording has a load' rated/summary.json)" -eq 0 ]

# ---- the shaft turns round with a jerk; two loads without a torque sensor

brake_log light.csv 0.02 0 1 1 2
brake_log heavy.csv 0.09 0 1 1 3
run 0 tune heavy.csv $motor -o heavy
says '^tuned: ' '  order 12: 0\.00(4|39)[0-9]* ± ' 'rows are not used.*speeds up, slows|speeds up, slows'
run 0 tune light.csv heavy.csv $motor -o both # each brake a mean of its own, the ripple of both one machine's
says '^tuned: ' '  order 12: 0\.00(40|399)[0-9]* ± '
check "loads are not apart" grep -q 'light.csv: .*i_q makes 0\.02[0-9]* N·m forward' both/summary.json
check "what a load adds is said to take a sensor" [ "$(grep -c 'What load adds takes' both/summary.json)" -eq 0 ]

# ---- a load that is the same forward and back is one, and what i_q alone does not tell of the back-EMF is named

run 0 tune waits.csv --pole-pairs 5 --flux 0.0133333333333333 --slots 12 -o even
says '^tuned: ' 'a torque without ripple of 0.04[0-9]* N·m: what the recorded current makes' '  order 5 or 7: 0\.00[0-9]* ± ' 'Which of two orders of the back-EMF makes a ripple, 5 or 7'

run 0 solve even/diagnose/machine --target even/target.csv
says 'No recording has an i_d: --method pointwise --current-angle 0'
run 0 solve even/diagnose/machine --target even/target.csv --method pointwise --current-angle 0
check "the advice is given to who follows it" [ "$(grep -c 'does without' "$work/stdout")" -eq 0 ]
run 2 solve even/diagnose/machine --target even/target.csv --current-angle 0
says 'add --method pointwise'

# ---- beside an arm no bound is stated, by tune, by solve alone and by the commands that tune prints

brake_log arm.csv 0.02 1.5 0 1 5 0.03
run 1 tune arm.csv --pole-pairs 5 --flux 0.0133333333333333 --slots 12 --torque 0.02 -o arm
says 'come once or twice a turn, and a load on the shaft makes that' 'Ripple not known: what a load once or twice a turn makes'
check "an arm is no load" [ "$(grep -c 'the shaft without a load took' arm/summary.json)" -eq 0 ]
check "the load that turns is in no file" grep -q '^turning_load,0\.0[23][0-9]*,Nm$' arm/diagnose/machine/diagnosis.csv
run 0 solve arm/diagnose/machine --target arm/target.csv --auto -o arm_solved
says 'Ripple not known: what a load once or twice a turn makes'
run 0 diagnose arm/machine --runs arm/runs.csv -o arm_diagnosed
check "diagnose leaves the load out" grep -q '^turning_load,' arm_diagnosed/machine/diagnosis.csv
check "a load once a turn where there is none" [ "$(grep -c turning_load waits/diagnose/machine/diagnosis.csv)" -eq 0 ]

# ---- what an eccentric encoder makes of the cogging torque is none of slow turns that others under a load lie beside

eccentric() { # FILE
    awk -F, -v OFS=, 'NR > 1 { $2 = sprintf("%.6f", $2 + 0.004 * sin($2 + 0.8)) } 1' "$1" >read.csv && mv read.csv "$1"
}
brake_log idle.csv 0.004 0 0 1 8
brake_log braked.csv 0.05 0 0 1 9
eccentric idle.csv && eccentric braked.csv
run 0 tune idle.csv braked.csv $motor -o eccentric
says 'an eccentric encoder \(added\): order 1, mechanical angle = 0\.0040[0-9]* ± ' '  order 12: 0\.00[34][0-9]* ± ' 'friction \(added\): coulomb = 0\.00[34]'
check "its side bands are cogging torque" [ "$(grep -c 'order 61/5\|order 59/5' eccentric/summary.json)" -eq 0 ]

# ---- a load alone is no machine in which nothing is missing, and a table that takes nothing away is not to be loaded

awk 'BEGIN { srand(4); print "time_s,theta_m_rad,speed_rad_per_s,iq_A"; for (k = 0; k < 8000; ++k) { t = 0.005 * k; way = t < 20 ? 1 : -1
    printf "%.4f,%.6f,%.4f,%.5f\n", t, 0.6 * (20 - (t < 20 ? 20 - t : t - 20)), 0.6 * way, way * 0.5 + 0.01 * (rand() - 0.5) } }' >smooth.csv
run 1 tune smooth.csv $motor -o smooth
says '^a table of no use: ' 'Nothing is missing in the ripple, and the mean of the torque is an' 'takes no ripple away'
check "how to load a table of no use" [ "$(grep -c 'need hci/table.h alone\|First turn on the bench' smooth/summary.json)" -eq 0 ]

finish
