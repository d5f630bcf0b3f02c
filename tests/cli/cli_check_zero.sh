#!/bin/sh
# An encoder whose zero is off, without voltages: five loads on a torque sensor, one of them with another angle of the current. The zero is what is
# said, with its degrees and --angle-offset, and not another back-EMF; a common gain of the currents is said to be one of the back-EMF as well.
#   cli_check_zero.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
use_plain_build
cd "$work" || exit 1

# 4 pole pairs, 0.36 N·m/A, 5th 2 %, cogging torque of order 6, friction 0.05 N·m, zero of the sensor 0.03 N·m
load() { # FILE CURRENT_A AHEAD_rad SPEED_rpm ZERO_deg SEED [SENSOR_Nm]
    awk -v i="$2" -v ahead="$3" -v rpm="$4" -v zero="$5" -v seed="$6" -v sensor="${7:-0.03}" 'BEGIN { srand(seed); turn = 6.283185307179586; w = rpm * turn / 60
        print "time_s,theta_m_rad,speed_rad_per_s,ia_A,ib_A,ic_A,torque_Nm"
        for (k = 0; k < 2400; ++k) { x = 0.3 + (w > 0 ? 1 : -1) * 3 * turn * k / 2400; T = (w > 0 ? -0.05 : 0.05) + sensor + 0.06 * sin(24 * x + 0.9)
            row = sprintf("%.6f,%.6f,%.4f", (x - 0.3) / w, x + zero * turn / 360 / 4, w)
            for (s = 0; s < 3; ++s) { a = 4 * x - s * turn / 3; c = i * sin(a + ahead)
                T += 0.36 * (sin(a) + 0.02 * sin(5 * a + 0.3)) * c; row = row sprintf(",%.5f", c + 0.01 * (rand() - 0.5)) }
            print row sprintf(",%.5f", T + 0.01 * (rand() - 0.5)) } }' >"$1"
}
loads() { # ZERO_deg [SENSOR_Nm]
    load idle.csv 0 0 60 "$1" 1 "$2"
    load light.csv 2.3 0 60 "$1" 2 "$2"
    load half.csv 5.2 0 60 "$1" 3 "$2"
    load back.csv 7 0 -60 "$1" 4 "$2"
    load ahead.csv 4 0.3 150 "$1" 5 "$2"
}
logs='idle.csv light.csv half.csv back.csv ahead.csv'
mkdir motor
printf 'name,value,unit\npole_pairs,4,1\nrated_current,7.07,A\n' >motor/machine.csv
printf 'order,amplitude_Nm_per_A,phase_rad\n1,0.36,0\n' >motor/back_emf.csv

# ---- where it is right nothing is said of it; where it is off, its degrees

loads 0 0.03
run 0 check motor $logs
says '^consistent'
check "a zero that is right is off" [ "$(grep -c 'angle-offset' "$work/stdout")" -eq 0 ]
for zero in 30 -35; do
    loads $zero 0.03
    run 0 check motor $logs
    remedy=$((-zero))
    says "^  angle zero "
    found=$(sed -n 's/.*--angle-offset \([-0-9.]*\) takes it out.*/\1/p' "$work/stdout")
    check "an offset of ${found:-nothing} for $remedy" [ "$(awk -v a="${found:-999}" -v b="$remedy" 'BEGIN { print (a - b < 3 && b - a < 3) }')" -eq 1 ]
done
loads 50 0.03
run 1 check motor $logs
says '^ambiguous' 'possible run_angle_offset: the electrical zero of the angle in the recordings is (4[7-9]|5[0-3])\.[0-9] ± ' 'give --angle-offset -(4[7-9]|5[0-3])'
check "another reading goes before the zero" [ "$(grep '^  possible' "$work/stdout" | head -n 1 | grep -c run_angle_offset)" -eq 1 ]

# ---- a torque sensor that nobody tared, by an idle turn each way: neither a zero of the angle nor a unit of the back-EMF

for sensor in 0.5 -0.5; do
    loads 0 $sensor
    load idle_back.csv 0 0 -60 0 6 $sensor
    run 0 check motor $logs idle_back.csv
    says '^consistent'
    check "a sensor off by $sensor N·m turns the angle" [ "$(grep -c 'angle-offset' "$work/stdout")" -eq 0 ]
done

# ---- tune says it in a caveat

loads 30 0.03
run 1 tune $logs --pole-pairs 4 --flux 0.09 --rated-current 7.07 --torque 2 -o tuned
check "no caveat has the zero: $(head -n 5 "$work/stdout")" \
    [ "$(head -n 5 "$work/stdout" | grep -cE '^  - The electrical zero of the logs is (2[89]|3[0-2])\.[0-9] ± .*begin again with --angle-offset -(2[89]|3[0-2])')" -eq 1 ]
tuned="$logs --pole-pairs 4 --flux 0.09 --rated-current 7.07 --torque 2"
run 0 tune $tuned --angle-offset=-0.5235988rad -o radians
check "an offset in radians is not handed on in degrees" grep -q 'emit .*--angle-offset -30.0000' radians/commands.sh

# ---- all currents at one angle, as of a drive with its own zero and no i_d: the direction of its currents is the zero, the torques say which way it
# points, and within how much; a common convention, a quarter of a turn and such, is no better where the currents lie beside q in it

alike() { # ZERO_deg
    load idle.csv 0 0 60 "$1" 1
    load idle_back.csv 0 0 -60 "$1" 2
    load light.csv 2.3 0 60 "$1" 3
    load half.csv 5.2 0 60 "$1" 4
    load back.csv 7 0 -60 "$1" 5
}
logs='idle.csv idle_back.csv light.csv half.csv back.csv'
for zero in -73 50 73 -135 150; do
    alike $zero
    run 1 check motor $logs
    says "run_angle_offset: the electrical zero of the angle in the recordings is $zero\.[0-9] degrees off where the drive keeps its i_d at 0, and by the torques within (1[0-9]|2[0-9]): give --angle-offset $((-zero))\.[0-9]"
    check "$zero: another reading goes before the zero" [ "$(grep -E '^  (found|possible)' "$work/stdout" | head -n 1 | grep -c run_angle_offset)" -eq 1 ]
done
alike 85
run 0 tune $logs --pole-pairs 4 --flux 0.09 --rated-current 7.07 --torque 2 -o driven
says '^  - The electrical zero of the logs was found, --angle-offset -(84\.9|85\.[01])[0-9]*: there the phase currents lie along i_q, as where a drive keeps its i_d at 0, and the torques alone tell it within [12][0-9] degrees'
check "the zero of the drive is not in the commands" grep -q 'diagnose .*--angle-offset -8[45]\.' driven/commands.sh
alike 15
run 0 check motor $logs
says '^consistent' '^  angle zero   15\.[0-9] degrees electrical off in the recordings, where the drive keeps its i_d at 0 .*--angle-offset -15\.[0-9] takes it out'
run 0 check motor $logs --angle-offset -30
says '^  angle zero   -15\.[0-9] degrees electrical off .*--angle-offset -15\.[0-9] takes it out'
run 1 check motor $logs --angle-offset 100
says 'recordings is 115\.[0-9] degrees off .* give --angle-offset -15\.[0-9] in place of 100'
run 0 tune $logs --pole-pairs 4 --flux 0.09 --rated-current 7.07 --torque 2 -o beside
says '^  - The phase currents lie 15\.[0-9] degrees beside the i_q of this angle: .*--angle-offset -15\.[0-9] is right'
alike 0
run 0 check motor $logs
check "a zero that is right is off by the currents" [ "$(grep -c 'angle-offset' "$work/stdout")" -eq 0 ]

# ---- a saliency of 1.8 mH that sags under its i_q, and magnets that sag with it, at an angle that is right: both would do, and nobody is told
# to begin again; 3 pole pairs, 0.24 N·m/A

salient() { # FILE CURRENT_A AHEAD_rad SPEED_rpm SEED KIND
    awk -v i="$2" -v ahead="$3" -v rpm="$4" -v seed="$5" -v kind="$6" 'BEGIN { srand(seed); turn = 6.283185307179586; w = rpm * turn / 60
        print kind == "dq" ? "time_s,theta_m_rad,id_A,iq_A,torque_Nm" : "time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm"
        d = -i * sin(ahead); q = i * cos(ahead); s = q * q / 4900; flux = 0.08 * (1 - 0.12 * s / (1 + s)) + 0.0012 * d
        linked = 0.003 * q / sqrt(1 + s) - 0.0192 * d * q / 4900 / (1 + s) ^ 2
        for (k = 0; k < 2400; ++k) { x = 0.3 + (w > 0 ? 1 : -1) * 3 * turn * k / 2400; a = 3 * x
            T = 4.5 * (flux * q - linked * d) - (w > 0 ? 0.3 : -0.3) + 0.25 * sin(36 * x + 0.4) + 0.012 * 0.36 * q * sin(6 * a)
            row = sprintf("%.6f,%.6f", (x - 0.3) / w, x)
            if (kind == "dq") row = row sprintf(",%.4f,%.4f", d + 0.1 * (rand() - 0.5), q + 0.1 * (rand() - 0.5))
            else for (c = 0; c < 3; ++c) row = row sprintf(",%.4f", i * sin(a - c * turn / 3 + ahead) + 0.1 * (rand() - 0.5))
            print row sprintf(",%.5f", T + 0.05 * (rand() - 0.5)) } }' >"$1"
}
salients() { # KIND
    salient idle.csv 0 0 100 1 "$1"
    salient idle_back.csv 0 0 -100 2 "$1"
    salient light.csv 20 0 100 3 "$1"
    salient half.csv 40 0 -100 4 "$1"
    salient m30.csv 30 0.5 100 5 "$1"
    salient m60.csv 60 0.7 -100 6 "$1"
    salient lag.csv 30 -0.4 100 7 "$1"
}
whatever() { # the exit code is no matter here
    shown="hci-solve $*"
    "$hci_solve" "$@" >"$work/stdout" 2>"$work/stderr" </dev/null
}
logs='idle.csv idle_back.csv light.csv half.csv m30.csv m60.csv lag.csv'
sheet='--pole-pairs 3 --flux 0.08 --resistance 0.05 --rated-current 60'
run 0 init interior $sheet --inductance-d 0.0012 --inductance-q 0.003 -o interior
run 0 init unsaid $sheet -o unsaid
salients abc
for machine in interior unsaid; do
    whatever check $machine $logs
    check "$machine: another zero for a saliency" [ "$(grep -c 'angle-offset' "$work/stdout")" -eq 0 ]
done
for kind in abc dq; do
    salients $kind
    whatever tune $logs $sheet --torque 15 -o salient_$kind
    check "$kind: begin again for a saliency: $(grep -o 'the electrical zero of the logs.*\|--angle-offset [-0-9.]* takes' "$work/stdout" | head -n 1)" \
        [ "$(grep -cE 'begin again with|angle-offset [-0-9.]+ takes it out|theta = theta_read' "$work/stdout")" -eq 0 ]
done

# ---- a motor that brakes: the current vector is mirrored about d, and the ripple of its torque has the other sign

braking() { # FILE CURRENT_A AHEAD SEED: ripple of 26 and 40 a turn in proportion to the torque, as of magnets that differ
    awk -v i="$2" -v ahead="$3" -v seed="$4" 'BEGIN { srand(seed); turn = 6.283185307179586; w = 10
        print "time_s,theta_m_rad,speed_rad_per_s,ia_A,ib_A,ic_A,torque_Nm"
        for (k = 0; k < 8000; ++k) { t = k / 2000; x = w * t; a = 3 * x; T = 1.5 * 3 * (0.08 + 0.0018 * i * sin(ahead)) * i * cos(ahead) * (1 + 0.03 * sin(26 * x + 1) + 0.02 * sin(40 * x))
            row = sprintf("%.5f,%.6f,%.4f", t, x, w)
            for (c = 0; c < 3; ++c) row = row sprintf(",%.4f", i * sin(a - c * turn / 3 + ahead) + 0.1 * (rand() - 0.5))
            print row sprintf(",%.5f", T + 0.02 * (rand() - 0.5)) } }' >"$1"
}
braking drive.csv 60 0.5 11
braking brake.csv -60 -0.5 12
run 0 check unsaid drive.csv brake.csv
says '^consistent'

# ---- of torques over i_d and i_q alone no angle is corrected: a map whose axes lie 2 degrees off

awk 'BEGIN { srand(9); print "I_d,I_q,T"; for (i = 10; i <= 60; i += 10) for (b = -0.3; b < 1.3; b += 0.3) { d = -i * sin(b); q = i * cos(b); D = -i * sin(b + 0.035); Q = i * cos(b + 0.035)
    printf "%.4f,%.4f,%.5f\n", d, q, 4.5 * (0.08 - 0.0018 * D) * Q + 0.02 * (rand() - 0.5) } }' >map.csv
whatever tune map.csv $sheet --torque 15 -o map
check "an angle is corrected of a map" [ "$(grep -c 'from the electrical angle' "$work/stdout")" -eq 0 ]

finish
