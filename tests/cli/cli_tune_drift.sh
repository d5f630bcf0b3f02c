#!/bin/sh
# A torque sensor whose zero drifts along logs of four turns, by some times its noise: the drift is said and taken out, and what repeats with the turn
# is explained as without it. Where it is another one in each log, their means are known the less, and the ripple is explained all the same.
# labels: slow
#   cli_tune_drift.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
use_plain_build
cd "$work" || exit 1

# 5 pole pairs, 0.412 N·m/A, 5th 2 %, cogging torque of orders 12 and 60 of the turn, friction 0.04 N·m; 20 rpm for 12 s; BENT_Nm: of the square of the time
drift_log() { # FILE CURRENT_A WAY DRIFT_Nm SEED BENT_Nm
    awk -v i="$2" -v way="$3" -v drift="$4" -v seed="$5" -v bent="$6" 'BEGIN { srand(seed); turn = 6.283185307179586; w = way * 20 * turn / 60
        print "time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm"
        for (k = 0; k < 9600; ++k) { t = k / 800; x = 0.7 * seed + w * t; T = 0.018 - way * 0.04 + 0.025 * sin(60 * x + 0.8) + 0.015 * sin(12 * x + 0.3) + drift * t / 12 + bent * (t / 6 - 1) ^ 2
            row = sprintf("%.5f,%.6f", t, x)
            for (s = 0; s < 3; ++s) { a = 5 * x - s * turn / 3; c = i * sin(a); T += 0.412 / 1.5 * (sin(a) + 0.02 * sin(5 * a + 0.4)) * c
                row = row sprintf(",%.4f", c + 0.02 * (rand() + rand() + rand() - 1.5)) }
            printf "%s,%.5f\n", row, T + 0.008 * (rand() + rand() + rand() - 1.5) } }' >"$1"
}
logs='idle.csv back.csv half.csv full.csv'
motor='--pole-pairs 5 --slots 12 --torque-constant 0.412 --rated-current 6'

drift_log idle.csv 0 1 0.015 1 0
drift_log back.csv 0 -1 0.015 2 0
drift_log half.csv 3 1 0.015 3 0
drift_log full.csv 6 1 0.015 4 0
run 0 tune $logs $motor -o straight
says '^tuned: A ripple of 0\.1[0-9]* N·m from peak to peak falls to at most 0\.00[0-9]* N·m' 'The torque drifts by up to 0\.01[3-7] N·m along 4 of 4 runs' \
    'order 12: 0\.025' 'order 12/5: 0\.015' 'coulomb = 0\.0[34]' 'order 5 or 7: 0\.005'
check "no drift in summary.json" [ "$(tr -d ' \t' <straight/diagnose/summary.json | grep -c '^"drifts":4,')" -eq 1 ]

# The machine that was found lacks nothing, but whether the drift is the sensor's nobody knows.
run 1 diagnose straight/diagnose/machine --runs straight/runs.csv
says ': unknown$' 'Nothing is missing beside a drift'

drift_log idle.csv 0 1 0.01 1 0
drift_log back.csv 0 -1 -0.015 2 0.01
drift_log half.csv 3 1 0.02 3 0
drift_log full.csv 6 1 -0.008 4 -0.01
"$hci_solve" tune $logs $motor -o each >"$work/stdout" 2>"$work/stderr" </dev/null
shown='tune with another drift in each log'
says 'The torque drifts by up to 0\.0[12][0-9]* N·m along 4 of 4 runs' 'order 12: 0\.025' 'order 12/5: 0\.015' 'order 5 or 7: 0\.005'

# The zero of the sensor is another one in each log, and nothing explains their means: the ripple is explained, and the first line says so.
zero() { # LOG ZERO_Nm
    awk -F, -v OFS=, -v zero="$2" 'NR > 1 { $6 += zero } 1' "$1" >moved.csv && mv moved.csv "$1"
}
drift_log idle.csv 0 1 0 1 0
drift_log half.csv 3 1 0 3 0
drift_log more.csv 4.5 1 0 5 0
drift_log full.csv 6 1 0 4 0
zero idle.csv 0.1 && zero half.csv -0.15 && zero more.csv -0.06 && zero full.csv 0.08
run 1 tune idle.csv half.csv more.csv full.csv $motor -o zeros
says '^tuned, with something left open: A ripple of [0-9.]* N·m from peak to peak falls to at most 0\.0[0-9]* N·m .*; the mean torque of each recording is not explained, .* may be 0\.[0-9]* N·m off' \
    'of their mean torques 0\.1[0-9]* N·m rms are not' \
    'order 12: 0\.025' 'order 12/5: 0\.015' 'order 5 or 7: 0\.005' '^  ripple, peak to peak, N·m .* at most 0\.0[0-9]* '

finish
