#!/bin/sh
# Logs of drives as people have them: a commanded voltage without a current, counts of 16 bits, a time under a name of its own, a speed that is held over
# many rows, an angle in gon, the force of a load cell; and slips of the command line.
# labels: slow
#   cli_tune_readings.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
use_plain_build
cd "$work" || exit 1

# Turned slowly there and back without a sensor, 5 pole pairs, 0.1 N·m/A, cogging torque 60 times a turn. NAMES: time, angle, speed, current; the numbers are
# those of s, rad, rad/s and A times SCALES. UQ: 1 writes the voltage of a drive by 2 Ω in place of the current.
slow_log() { # FILE NAMES SCALES [UQ]
    awk -v names="$2" -v scales="$3" -v uq="${4:-0}" 'BEGIN { srand(4); turn = 6.283185307179586; print names; split(scales, by, ",")
        w = 1.2; one = 1.4 * turn / w; dt = 0.005; x = 0.3
        for (t = 0; t < 2 * one; t += dt) { way = t < one ? 1 : -1
            q = (way * 0.006 + 0.004 * sin(60 * x + 0.3)) / 0.1 + 0.004 * (rand() - 0.5)
            if (uq) q = 2 * q + 0.1 / 1.5 * way * w
            printf "%.6f,%.6f,%.5f,%.6f\n", t * by[1], x * by[2], way * w * (1 + 0.02 * (rand() - 0.5)) * by[3], q * by[4]; x += way * w * dt } }' >"$1"
}
motor='--pole-pairs 5 --flux 0.0133333333333333 --slots 12 --rated-current 1 --torque 0.08'

# ---- the voltage that a drive commands is no back-EMF

slow_log uq.csv time_s,shaft_angle,shaft_velocity,voltage_q 1,1,1,1 1
run 1 tune uq.csv $motor --resistance 2 -o uq
says '^not enough in the logs' "^  - \`voltage_q\` is a voltage that the drive commands and no back-EMF.*--column 'iq_A=voltage_q/2' --holding"
check "a table of a command" [ ! -e uq/table ]
run 0 tune uq.csv $motor --resistance 2 --column 'iq_A=voltage_q/2' --holding -o held
says '  order 12: 0\.00(4|39)[0-9]* ± '
run 3 tune uq.csv $motor --holding -o none
says "--column 'iq_A=voltage_q/OHM'"
sed '1s/voltage_q/Uq_V/' uq.csv >unit.csv # in a unit of its own, and over a number a current
run 0 tune unit.csv $motor --column 'iq_A=Uq_V/2' --holding -o unit
says '  order 12: 0\.00(4|39)[0-9]* ± '

finish
