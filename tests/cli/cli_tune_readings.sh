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

# ---- numbers of 16 bits

awk -F, 'BEGIN { print "Timestamp,Mechanical Angle (s16degree),I_Q (s16A),SPEED_MEAS (u/min)" } NR > 1 { c = int($2 / 6.283185307179586 * 65536) % 65536
    printf "%s,%d,%d,%.0f\n", $1 * 1000, (c > 32767 ? c - 65536 : c), $4 * 1638, $3 * 9.5492966 }' uq.csv >digits.csv
run 1 tune digits.csv $motor -o digits
says "add --column 'theta_m=Mechanical Angle \(s16degree\)/65536'" \
    "No current was read: if the column \`I_Q \(s16A\)\` is i_q, add --column 'iq_A=I_Q \(s16A\)/DIGITS_PER_A', with what the firmware has for 1 A"
sed '1s/Mechanical Angle (s16degree)/enc counts/' digits.csv >plain.csv # by a time in another unit a turn would have 65 counts, less than the column has
run 1 tune plain.csv $motor -o plain
says 'counts/COUNTS'
angle='theta_m=Mechanical Angle (s16degree)/65536'
run 3 tune digits.csv $motor --column "$angle" --column 'iq_A=I_Q (s16A)' -o whole
says 'expected how many of them are 1 of the quantity, which the firmware knows; write iq_A=I_Q \(s16A\)/NUMBER'
run 1 tune digits.csv $motor --column "$angle" --column 'iq_A=I_Q (s16A)/1638' -o over
says 'Most likely the time is in milliseconds'
check "a unit of digits" [ "$(grep -c 'are in mA' over/summary.json)" -eq 0 ]
run 0 tune digits.csv $motor --column "$angle" --column 'iq_A=I_Q (s16A)/3276' --column time_ms=Timestamp -o over # the voltage is by 2 Ω
says '  order 12: 0\.00(4|39)[0-9]* ± '

# ---- a time under a name of its own

for what in 'unix 1 time_s=unix' 'tick10ms 100 time_s=tick10ms/100' 'ticks 500 time_s=ticks/TICKS_PER_S' 'sample_ms_x 1000'; do
    set -- $what
    slow_log time.csv "$1,theta_m_rad,speed_rad_per_s,iq_A" "$2,1,1,1"
    run 1 tune time.csv $motor -o time
    if [ -n "${3-}" ]; then says "^  - No time was read: if the column \`$1\` is it, add --column '$3'; or --holding"; else says "^  - No time was read: name its column by --column 'time_s=COLUMN'"; fi
    says '^not enough in the logs: The log has an angle and a current and no time'
    check "a slow turn that there was" [ "$(grep -c 'turn the shaft slowly' time/summary.json)" -eq 0 ]
    run 0 tune time.csv $motor --column "time_s=$1/$2" -o read
    says '  order 12: 0\.00(4|39)[0-9]* ± '
done
slow_log time.csv millis,theta_m_rad,speed_rad_per_s,iq_A 1000,1,1,1
run 0 tune time.csv $motor -o millis
says '`millis` is read as the time, in ms' '  order 12: 0\.00(4|39)[0-9]* ± '
slow_log time.csv unix,theta_m_rad,speed_rad_per_s,iq_A -1,1,1,1 # what goes back is no time
run 1 tune time.csv $motor -o back
says "No time was read: name its column by --column 'time_s=COLUMN'"

# ---- a speed of a slower channel, in one row of twenty

slow_log every.csv 'time_s,Winkel [rad],Drehzahl [1/min],iq_A' 1,1,9.5492966,1
awk -F, -v OFS=, 'NR > 1 && NR % 20 != 2 { $3 = "" } 1' every.csv >sparse.csv
run 0 tune sparse.csv $motor -o sparse
says 'as of a slower' '`Winkel \[rad\]` is the mechanical angle' '  order 12: 0\.00(4|39)[0-9]* ± '

# ---- an angle in gon, of 400 to a turn, and a gear that nobody builds

for load in 0 0.3 0.6; do
    awk -v load="$load" 'BEGIN { srand(3); turn = 6.283185307179586; print "time_s,theta_m_deg,ia_A,ib_A,ic_A,torque_Nm"
        for (k = 0; k < 4000; ++k) { t = k / 1000; x = 2 * turn * t
            printf "%.4f,%.4f,%.5f,%.5f,%.5f,%.6f\n", t, x / turn * 400, load * sin(5 * x), load * sin(5 * x - turn / 3), load * sin(5 * x + turn / 3),
                0.1 * load + 0.008 * sin(60 * x + 0.3) - 0.002 + 0.0005 * (rand() + rand() + rand() - 1.5) } }' >"gon$load.csv"
done
run 1 tune gon0.csv gon0.3.csv gon0.6.csv $motor -o gon
says '^a convention is broken: Most likely the angle of the recordings is in gon' "'theta_m_gon=theta_m_deg'"
run 1 tune gon0.csv gon0.3.csv gon0.6.csv $motor --column theta_m_gon=theta_m_deg -o read
check "gon: $(grep -o 'convention is broken' read/summary.json)" [ "$(grep -c 'convention is broken' read/summary.json)" -eq 0 ]

# ---- the force of a load cell on a lever of 150 mm, in g

awk -F, -v OFS=, 'NR == 1 { $2 = "theta_m_gon"; $6 = "load_g" } NR > 1 { $6 *= 680 } 1' gon0.csv >lever.csv
run 1 tune lever.csv $motor -o lever
says '^  - If the column .load_g. is the force of a load cell, the torque is it times the lever: --column .torque_Nm=load_g/NUMBER'
check "no lever" grep -q 'force x lever' lever/summary.json lever/report.html
run 0 tune lever.csv $motor --column 'torque_Nm=load_g/680' -o lever
says '  order 12: 0\.00(8|79)[0-9]* ± '

# ---- slips of the command line

run 2 tune gon0.csv –pole-pairs 5 --flux 0.013 -o new
says 'found `–pole-pairs`, which begins with another dash than `-`.*write --pole-pairs'
run 2 tune gon0.csv —kv=100 --pole-pairs 5 -o new
says 'found `—kv=100`, which begins with another dash than `-`.*write --kv'
run 2 tune gon0.csv $motor -o gon0.3.csv
says '--out gon0.3.csv is a file, expected a new folder'
check "the file is gone" [ -s gon0.3.csv ]

finish
