#!/bin/sh
# What tune says of one file with several tests in it.
#   cli_tune_several.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
cd "$work" || exit 1

# NAME RPM RAMP GAP MOVED ROWS: without current and at three loads, each at its own speed ("100 100 100 100"), 6 s long, with a ramp of RAMP s before
# and behind it and GAP s that were not logged, in which the shaft is turned to another place, and the index of the encoder by MOVED rad. Four pole
# pairs, a torque sensor before Coulomb friction of 0.05 N·m; ROWS a second.
tests() {
    awk -v rpm="$2" -v ramp="$3" -v gap="$4" -v moved="$5" -v rate="$6" 'function noise() { return rand() + rand() + rand() + rand() - 2 }
    BEGIN { srand(5); split(rpm, n_of, " "); turn = 6.283185307179586; x = 0.3; last = 6 + 2 * ramp; print "time_s,theta_m_rad,speed_rpm,id_A,iq_A,torque_Nm"
        for (part = 1; part <= 4; ++part) {
            for (k = 0; k < last * rate; ++k) { t = k / rate; share = t < ramp ? t / ramp : t > last - ramp ? (last - t) / ramp : 1
                w = share * n_of[part] * turn / 60; x += w / rate; q = 2 * (part - 1) * share; e = 4 * x + moved * part * part; way = w > 0 ? 1 : w < 0 ? -1 : 0
                printf "%.5f,%.6f,%.4f,%.4f,%.4f,%.5f\n", at + t, x, w * 60 / turn + 0.5 * noise(), 0.02 * noise(), q + 0.02 * noise(),
                    q * (0.45 + 0.0105 * sin(6 * e + 2.2)) + 0.06 * sin(6 * e + 0.5) + 0.03 * sin(12 * e + 1.2) - 0.05 * way - 0.0008 * w + 0.02 * noise() }
            at += last + gap; x += gap > 0 ? 0.9 + part : 0 } }' >"$1.csv"
}
# EXIT NAME
tuned() {
    run "$1" tune "$2.csv" --pole-pairs 4 --kv 18.38 -o "$2"
}

# the angle is not followed over what was not logged: none of its columns is another's
tests pieces '100 100 100 100' 0 30 0 500
run 0 init motor --pole-pairs 4 --kv 18.38 -o motor
run 0 check motor pieces.csv
says '^consistent: '
run 1 tune pieces.csv --pole-pairs 4 --kv 18.38 -o pieces
says '^tuned, with something left open: A ripple of 0.1[0-9]* N·m from peak to peak falls to at most 0.0'

# rows in which noise turns the sign of the speed, as where the shaft starts, tell no zero of the torque sensor
tests stops '100 100 100 100' 0.5 30 0 500
tuned 0 stops
says 'friction .added.: coulomb = 0.0[45]' 'rows noise turns the sign of the recorded speed about'
check "a zero of the torque sensor" [ "$(grep -c 'errors of the torque sensor (added)' "$work/stdout")" -eq 0 ]

# several speeds in one file are several speeds
tests speeds '100 300 50 150' 0.5 0 0 500
tuned 0 speeds
check "one speed, of a file with four" [ "$(grep -c 'one speed' "$work/stdout")" -eq 0 ]

# loads are no ripple, where the search ends before all was compared
tests moved '100 100 100 100' 0.5 30 0.35 2000
run 1 tune moved.csv --pole-pairs 4 --kv 18.38 --work 0.5 -o moved
says '^tuned.*; the recording moved.csv shows 0.[12][0-9]* N·m from peak to peak'

# loads of another direction, of which a torque wanders that no effect makes, beside three along i_q
aside() { # FILE SPEED_rad_per_s ID_A IQ_A WANDER_Nm SEED
    awk -v w="$2" -v id="$3" -v iq="$4" -v wander="$5" -v seed="$6" 'BEGIN { srand(seed); print "time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm"; pi = 3.141592653589793
        for (k = 0; k < 3000; ++k) { t = 0.001 * k; x = w * t; e = 4 * x; y = 0.98 * y + 0.2 * (rand() - 0.5)
            for (s = 0; s < 3; ++s) i[s] = iq * sin(e - 2 * pi * s / 3) - id * cos(e - 2 * pi * s / 3) + 0.01 * (rand() - 0.5)
            printf "%.3f,%.6f,%.5f,%.5f,%.5f,%.5f\n", t, x, i[0], i[1], i[2], 0.6 * iq + 0.05 * sin(6 * e + 0.3) + wander * y * (1 + sin(5.3 * x)) + 0.002 * (rand() - 0.5) } }' >"$1"
}
aside q0.csv 12 0 0 0 1; aside q2.csv 12 0 2 0 2; aside q3.csv 12 0 3 0 3; aside q4.csv -12 0 4 0 4
aside d3.csv 12 -3 3 0.6 5; aside d4.csv 12 -4 2 0.9 6
run 1 tune q?.csv d?.csv --pole-pairs 4 --flux 0.1 --slots 24 --rated-current 5 -o aside
says 'Without d3\.csv and d4\.csv: the currents of the other loads have one direction'
run 0 tune q?.csv --pole-pairs 4 --flux 0.1 --slots 24 --rated-current 5 -o along
check "a direction that is the only one" [ "$(grep -c 'have one direction in the rotor frame, and there' "$work/stdout")" -eq 0 ]

# without a current backward, and with one forward: two speeds that have nothing but cogging torque in common
aside b0.csv -12 0 0 0 7
aside f0.csv 12 0 0 0 8
run 0 tune b0.csv q2.csv q3.csv --pole-pairs 4 --flux 0.1 --slots 24 --rated-current 5 -o apart
says '^tuned.* if the torque sensor is in time, which one speed does not tell'
run 0 tune b0.csv f0.csv q2.csv q3.csv --pole-pairs 4 --flux 0.1 --slots 24 --rated-current 5 -o bothways
check "two speeds without a current are one" [ "$(grep -c 'which one speed does not tell' "$work/stdout")" -eq 0 ]

# slow turns there and back at three speeds, whose control lets the speed swing, as where nothing tells the inertia: what harmonics of the
# back-EMF make under load they tell no more than one of them, and a bound that is larger than the torque is none
swinging() { # FILE RPM SEED
    awk -v rpm="$2" -v seed="$3" 'function noise() { return rand() + rand() + rand() + rand() - 2 }
        BEGIN { srand(seed); turn = 6.283185307179586; dt = 0.0002; x = 0.3; print "time_s,theta_m_rad,speed_rad_per_s,id_A,iq_A"
            for (way = 1; way >= -1; way -= 2) { wanted = way * rpm * turn / 60; steps = 2.2 * turn / (rpm * turn / 60) / dt
                for (k = 0; k < steps; ++k) { e = wanted - w; sum += 60 * e * dt; q = 1.2 * e + sum; y = w / 0.02
                    brake = 0.006 * (y > 1 ? 1 : y < -1 ? -1 : y) + 2e-5 * w
                    torque = 0.0435 * q * (1 - 0.031 * sin(7 * x) * sin(35 * x) + 0.016 * sin(7 * x) * sin(49 * x))
                    w += (torque + 0.0062 * sin(84 * x + 1.1) + 0.0016 * sin(12 * x + 0.4) - brake) / 6e-5 * dt; x += w * dt; t += dt
                    if (k % 50 == 0) printf "%.4f,%.4f,%.4f,%.4f,%.4f\n", t, x, w, 0.04 * noise(), q + 0.04 * noise() } } }' >"$1"
}
swinging slow6.csv 6 1; swinging slow3.csv 3 2; swinging slow12.csv 12 3
for logs in slow6.csv 'slow6.csv slow3.csv slow12.csv'; do
    # shellcheck disable=SC2086
    run 0 tune $logs --pole-pairs 7 --kv 190 --slots 12 -o slow
    says '^tuned: A ripple of .* in the model; what harmonics of the real back-EMF add under load is not known'
done
says 'Ripple not known: no recording shows a torque under load'

# forward and back in one log without a time: the way the angle goes tells friction from cogging torque; a log of one way has none to tell
ways() { # FILE IQ_A SEED
    awk -v iq="$2" -v seed="$3" 'BEGIN { srand(seed); print "theta_m_deg,ia_A,ib_A,ic_A,torque_Nm"; turn = 6.283185307179586
        for (k = 0; k < 4000; ++k) { way = k < 2000 ? 1 : -1; x = 0.3 + 2 * turn * (k < 2000 ? k : 4000 - k) / 2000; e = 4 * x
            for (s = 0; s < 3; ++s) i[s] = iq * sin(e - s * turn / 3) + 0.004 * (rand() - 0.5)
            printf "%.5f,%.5f,%.5f,%.5f,%.5f\n", x * 360 / turn, i[0], i[1], i[2], iq * (0.6 + 0.012 * sin(6 * e + 0.3)) + 0.04 * sin(6 * e + 1) - 0.05 * way + 0.004 * (rand() - 0.5) } }' >"$1"
}
ways w0.csv 0 1; ways w2.csv 2 2; ways w4.csv 4 3
run 0 tune w?.csv --pole-pairs 4 --flux 0.1 --slots 24 --rated-current 5 -o ways
says '^tuned: A ripple of' 'friction .added.: coulomb = 0\.0(5|49)' 'no time and no speed: the shaft turned slowly, the way'

finish
