#!/bin/sh
# What a reader of the first line has to know of the columns of logs: a current that was not read, a constant that the drive has as well, a column of
# amperes that is no torque, a speed in the unit of another tool, logs of two motors; and one slip that is accused of nothing else.
# labels: slow
#   cli_tune_columns.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
use_plain_build
cd "$work" || exit 1

# 5 pole pairs, 0.1 N·m/A; a torque sensor, 2 turn/s, cogging torque ORDER times a turn. NAMES of the phase currents: "": none in the log.
sensor_log() { # FILE LOAD_A SEED NAMES ORDER
    awk -v load="$2" -v seed="$3" -v names="$4" -v order="$5" 'BEGIN { srand(seed); turn = 6.283185307179586
        print "time_s,theta_m_rad,speed_rad_per_s," (names ? names "," : "") "torque_Nm"
        for (k = 0; k < 5000; ++k) { t = k / 1000; x = 2 * turn * t; noise = rand() + rand() + rand() - 1.5
            printf "%.4f,%.6f,%.4f,", t, x, 2 * turn
            if (names) printf "%.5f,%.5f,%.5f,", load * sin(5 * x) + 0.001 * rand(), load * sin(5 * x - turn / 3) + 0.001 * rand(), load * sin(5 * x + turn / 3) + 0.001 * rand()
            printf "%.6f\n", 0.1 * load * (1 + 0.02 * sin(30 * x)) + 0.008 * sin(order * x + 0.3) - 0.002 + 0.0005 * noise } }' >"$1"
}
# Turned slowly there and back without a sensor, as drives log it. NAMES: time, angle, speed, current, and what else is CURRENT times MORE. UNIT: of the
# speed, in rad/s.
slow_log() { # FILE NAMES MORE UNIT ORDER
    awk -v names="$2" -v more="$3" -v unit="$4" -v order="$5" 'BEGIN { srand(4); turn = 6.283185307179586; print names
        w = 1.2; one = 1.4 * turn / w; dt = 0.005; x = 0.3
        for (t = 0; t < 2 * one; t += dt) { way = t < one ? 1 : -1
            q = (way * 0.006 + 0.004 * sin(order * x + 0.3)) / 0.1 + 0.004 * (rand() - 0.5)
            printf "%.4f,%.6f,%.5f,%.6f,%.6f\n", t, x, way * w * (1 + 0.02 * (rand() - 0.5)) / unit, q, more * q; x += way * w * dt } }' >"$1"
}
motor='--pole-pairs 5 --flux 0.0133333333333333 --slots 12 --rated-current 1 --torque 0.08'

# ---- one slip explains it, and the constant of the sheet is not accused as well

for load in 0 0.3 0.6 1; do sensor_log "log$load.csv" "$load" 2 ia_A,ib_A,ic_A 60; done
for load in 0.3 0.6 1; do sensor_log "swap$load.csv" "$load" 2 ib_A,ia_A,ic_A 60; done
run 1 tune log0.csv swap0.3.csv swap0.6.csv swap1.csv $motor -o swapped
says '^a convention is broken: Most likely phases a and b of the recordings are swapped \([0-9.]* %\), so nothing was solved: --column .ia=ib_A. --column .ib=ia_A.$'
run 1 tune log0.csv log0.3.csv log0.6.csv log1.csv --pole-pairs 4 --flux 0.0166666666666667 -o poles
says '^a convention is broken: Most likely pole_pairs is not .*, so nothing was solved$'
run 1 tune log0.csv log0.3.csv log0.6.csv log1.csv --pole-pairs 5 --flux 0.00133333333333333 -o point # a number of the sheet is still named
says '--flux 0\.0133333 fits'

# ---- a column that one log calls otherwise is that of one log, for check too; one that none has is an error

sed '1s/theta_m_rad/probe/' log0.6.csv >probe.csv
"$hci_solve" tune log0.csv log0.3.csv probe.csv log1.csv $motor --column theta_m=probe -o probed >probed.out 2>&1
check "a column of one log: exit code $?" [ -s probed/summary.json ]
"$hci_solve" check probed/machine log0.csv probe.csv --column theta_m=probe >check.out 2>&1
check "check, a column of one log: exit code $?" grep -q '^consistent' check.out
run 3 check probed/machine log0.csv log1.csv --column theta_m=probe
says 'found no column `probe` in log0.csv'

# ---- a current that is not read

for load in 0 0.3 0.6 1; do
    awk -F, -v OFS=, -v load="$load" 'NR == 1 { print "time_s", "theta_m_rad", "speed_rad_per_s", "Axis_1.ActualCurrent [A rms]", "torque_Nm" } NR > 1 { print $1, $2, $3, load / 1.41421356, $7 }' "log$load.csv" >"plc$load.csv"
    sensor_log "bare$load.csv" "$load" 2 "" 60
done
run 1 tune plc0.csv plc0.3.csv plc0.6.csv plc1.csv $motor -o plc
says '^  - No current was read in 4 of 4 logs, and it was taken as 0: if the column `Axis_1.ActualCurrent \[A rms\]` is i_q, add'
run 1 tune log0.csv bare0.6.csv bare1.csv $motor -o bare
says '^  - No current was read in 2 of 3 logs, bare0.6.csv and such, though their torque is that of a load'
run 1 tune bare0.csv log0.3.csv log0.6.csv log1.csv $motor -o idle # friction is no load; in one direction it may be the zero of the sensor
check "a machine without current is accused" [ "$(grep -c 'no current was read' idle/summary.json)" -eq 0 ]

# ---- the constant that the drive has

slow_log drive.csv time,position,velocity,q_current,torque 0.12 6.283185307179586 60
awk -F, -v OFS=, 'NR > 1 { $2 /= 6.283185307179586 } 1' drive.csv >rev.csv # position and velocity of moteus are in turns
run 0 tune rev.csv $motor -o rev
says '^  - By its own torque in rev.csv the drive counts on 0\.12 N·m per A of i_q, and --flux makes 0\.1: one of the two is off'
run 0 tune rev.csv --pole-pairs 5 --flux 0.016 --slots 12 --rated-current 1 --torque 0.08 -o same
check "two constants that agree" [ "$(grep -c 'the drive counts on' same/summary.json)" -eq 0 ]

# ---- amperes are no torque, whatever the name says

slow_log ampere.csv 'Timestamp,Axis_1.ActualPosition [rad],Axis_1.ActualVelocity [rad/s],Axis_1.TorqueCurrent [A],Axis_1.FollowingError [rad]' 0 1 60
run 1 tune ampere.csv $motor -o ampere
says "No current was read: if the column \`Axis_1.TorqueCurrent \[A\]\` is i_q, add --column 'iq=Axis_1.TorqueCurrent \[A\]'"
check "a current is offered as a torque" [ "$(grep -c 'torque=Axis_1' ampere/summary.json)" -eq 0 ]
run 0 tune ampere.csv $motor --column 'iq=Axis_1.TorqueCurrent [A]' -o read
says '  order 12: 0\.00(4|39)[0-9]* ± '

# ---- a speed in another unit than the tool has under its name: the way of the angle tells

slow_log foc.csv time_s,angle,velocity,current_q_A,target 0 1 60
run 0 tune foc.csv $motor -o foc
says '`velocity` is read as the mechanical speed in rad/s, since the angle goes as' '  order 12: 0\.00(4|39)[0-9]* ± '
run 0 tune foc.csv $motor --column theta_m_rad=angle -o named
says '`velocity` is read as the mechanical speed in rad/s'
slow_log electrical.csv time_s,angle,omega,current_q_A,target 0 1 60
awk -F, -v OFS=, 'NR > 1 { $2 *= 5 } 1' electrical.csv >turned.csv # an electrical angle is no other unit of the speed
run 0 tune turned.csv $motor -o turned
check "an electrical angle makes another speed" [ "$(grep -c 'since the angle goes as far' turned/summary.json)" -eq 0 ]

# ---- two motors

slow_log other.csv time_s,theta_m_rad,speed_rad_per_s,iq_A,target 0 1 84
run 1 tune log0.csv log0.6.csv other.csv $motor -o two
says '^  - The ripple of log0.csv comes 60 times a turn and that of other.csv 84 times, and neither has the other.s: are both logs of one motor'
says 'up to 0\.0[0-9]* N·m rms of their ripple is not in it, and a plain sine of .* No table was written'
check "one motor is taken for two" [ "$(grep -c 'neither has the other' idle/summary.json)" -eq 0 ]

# ---- the results of an earlier call are replaced as a whole: a list that nothing is solved with leaves no table

"$hci_solve" init motor --pole-pairs 5 --flux 0.0133333333333333 --slots 12 --rated-current 1 >stdout 2>stderr
for load in 0 0.3 0.6 1; do echo "log$load.csv,fit"; done | sed '1i file,role' >good.csv
sed 's/log\([0-9.]*[1-9]\)\.csv/swap\1.csv/; s/log1/swap1/' good.csv >bad.csv
"$hci_solve" tune motor --runs good.csv --torque 0.08 -o again >stdout 2>stderr
check "no table to begin with" [ -s again/table/tuned.c ]
run 1 tune motor --runs bad.csv --torque 0.08 -o again
says '^a convention is broken'
check "the table of the call before: $(ls again)" [ ! -e again/table ]
check "no results" grep -q 'a convention is broken' again/summary.json
"$hci_solve" tune motor --runs good.csv --torque 0.08 -o again >stdout 2>stderr
run 2 tune again/diagnose/machine --runs good.csv --torque 0.08 -o again
says 'again/diagnose/machine is among the results in again'
check "the results are gone" [ -s again/table/tuned.c ]

finish
