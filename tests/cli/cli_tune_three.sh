#!/bin/sh
# Three logs of a torque sensor: without a current, and under two loads, one of them the other way round. Each alone tells the mean of its load
# and direction: what of friction, the zero of the sensor and saturated iron makes it stays open, but not what makes the ripple.
# labels: slow
#   cli_tune_three.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
use_plain_build
cd "$work" || exit 1

# 5 pole pairs, 20 rpm, 0.412 N·m/A with 2 % of order 5, which iron that saturates makes less by LESS of it at 6 A; cogging torque of 12 and 12/5 a turn;
# friction of 0.04 N·m, a zero of 0.018 N·m.
log() { # FILE CURRENT_A WAY SEED LESS
    awk -v i="$2" -v way="$3" -v seed="$4" -v less="$5" 'BEGIN { srand(seed); turn = 6.283185307179586; w = way * 20 * turn / 60
        print "time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm"
        for (k = 0; k < 9600; ++k) { t = k / 800; x = 0.7 * seed + w * t; T = 0.018 - way * 0.04 + 0.025 * sin(60 * x + 0.8) + 0.015 * sin(12 * x + 0.3)
            row = sprintf("%.5f,%.6f", t, x)
            for (s = 0; s < 3; ++s) { a = 5 * x - s * turn / 3; c = i * sin(a); T += 0.412 / 1.5 * (1 - less * i * i / 36) * (sin(a) + 0.02 * sin(5 * a + 0.4)) * c
                row = row sprintf(",%.4f", c + 0.02 * (rand() + rand() + rand() - 1.5)) }
            printf "%s,%.5f\n", row, T + 0.008 * (rand() + rand() + rand() - 1.5) } }' >"$1"
}
motor='--pole-pairs 5 --slots 12 --torque-constant 0.412 --rated-current 6'
bound() { # FOLDER: the bound in N·m, 0: none
    tr -d ' \t' <"$1/summary.json" | sed -n 's/^"peak_to_peak_Nm_95":\([0-9.e-]*\).*/\1/p' | head -1
}

log idle.csv 0 1 1 0
log half.csv 4 1 2 0
log back.csv 6 -1 3 0
run 0 tune idle.csv half.csv back.csv $motor -o same
says '^tuned: A ripple of 0\.1[0-9]* N·m from peak to peak falls to at most 0\.00[0-9]* N·m' 'order 12: 0\.025' 'order 12/5: 0\.015' 'order 5 or 7: 0\.00[58]|order [57]: 0\.00[58]' \
    'coulomb = 0\.0[34]'

# Iron that takes 2 % at 6 A: what the table adds to the torque per ampere changes by three times that, 0.006 N·m of this ripple.
log half.csv 4 1 2 0.02
log back.csv 6 -1 3 0.02
run 1 tune idle.csv half.csv back.csv $motor -o less
says '^tuned, with something left open: A ripple of 0\.1[0-9]* N·m from peak to peak falls to at most 0\.0[0-9]* N·m' 'order 12: 0\.025' 'order 12/5: 0\.015'
check "the bound has no room for saturated iron: $(bound less)" awk -v b="$(bound less)" 'BEGIN { exit !(b > 0.006 && b < 0.08) }'

# ---- the same with a rating in mA: it is asked for, and what the logs show is solved for

run 1 tune idle.csv half.csv back.csv --pole-pairs 5 --slots 12 --torque-constant 0.412 --rated-current 6000 -o much
says '^tuned, with something left open: A ripple of 0\.1[0-9]* N·m' '^  - A rated current of 6000 A is [0-9]* times the largest that was recorded, 6(\.[0-9]*)? A: is it in mA \(--rated-current 6\)\?'
check "a table of kiloamperes" awk -F, 'NR == 1 { for (k = 1; k <= NF; ++k) c[$k] = k; next } $c["iq_A"] > 12 { exit 1 }' much/currents/waveform.csv

finish
