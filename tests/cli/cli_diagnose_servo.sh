#!/bin/sh
# `diagnose` comes to its end with seven ordinary logs of a servo, three turns each with 3000 rows: two without a current, the
# others loaded; one of them another speed. With what such a machine has: harmonics of the back-EMF, cogging torque, friction
# that grows with the speed, iron that saturates a little, and a torque sensor with an offset and a lag.
#   cli_diagnose_servo.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
use_plain_build
cd "$work" || exit 1

# FILE I_Q I_D RPM SECONDS, at 500 rows a second; what the sensor lags by is the sum over 2000 steps a second.
awk -v points="empty_there:0:0:30:6 empty_back:0:0:-30:6 load_3:3:0:30:6 load_6:6:-2:-30:6 load_10:10:0:30:6 load_8:8:2:120:2 load_5:-5:0:40:6" '
function normal() {
    seed = 16807 * seed % 2147483647; u = seed / 2147483647
    seed = 16807 * seed % 2147483647
    return sqrt(-2 * log(u)) * cos(2 * pi * seed / 2147483647)
}
function torque(theta, q, d, w,    e, p, x, s, t) {
    t = 0
    for (p = 0; p < 3; p++) {
        x = 5 * theta - 2 * pi * p / 3
        e = E * (sin(x) + .022 * sin(5 * x + 3) + .012 * sin(7 * x + .3) + .006 * sin(11 * x + 2) + .004 * sin(13 * x - .5))
        t += e * (q * sin(x) - d * cos(x))
    }
    t = t * (1 - 1.2e-4 * (q * q + d * d)) - 1.5 * 5 * 4e-4 * d * q
    t += .045 * sin(60 * theta + 1.1) + .008 * sin(120 * theta - .3) + .016 * sin(12 * theta + .2) + .011 * sin(10 * theta + 2.5)
    return t - (w < 0 ? -.06 : .06) - 2e-3 * w
}
BEGIN {
    pi = atan2(0, -1); seed = 4711
    E = .985 * 52 * sqrt(2 / 3) * 60 / (2000 * pi)
    count = split(points, point, " ")
    for (f = 1; f <= count; f++) {
        split(point[f], v, ":")
        file = v[1] ".csv"
        print "time_s,theta_m_rad,speed_rpm,ia_A,ib_A,ic_A,torque_Nm" >file
        w = v[4] * 2 * pi / 60; a = w < 0 ? -w : w; sign = w < 0 ? -1 : 1
        n = int(v[5] * 2000)
        for (k = 0; k < n; k++) {
            t = k / 2000
            theta = .2 + w * t + sign * .004 * sin(t * a + .3)
            now = torque(theta, v[2], v[3], w)
            read = k ? read + (1 - exp(-1 / (2000 * .0008))) * (now - read) : now
            if (k % 4) continue
            printf "%.4f,%.6f,%.6g", t, theta, (w + sign * .004 * a * cos(t * a + .3)) * 30 / pi >file
            for (p = 0; p < 3; p++) {
                x = 5 * theta - 2 * pi * p / 3
                printf ",%.5g", v[2] * sin(x) - v[3] * cos(x) + .03 * normal() >file
            }
            printf ",%.5g\n", read + .03 + .02 * normal() >file
        }
        close(file)
    }
}'
run 0 init machine --pole-pairs 5 --volt-per-krpm 52 --slots 12 --resistance 0.9 --rated-current 12 -o machine
echo file,role >runs.csv
for log in empty_there empty_back load_3 load_6 load_10 load_8 load_5; do echo "$log.csv,fit" >>runs.csv; done
run 0 diagnose machine --runs runs.csv -o d
says 'added +friction' 'added +cogging torque: order ' 'added +back-EMF: order ' 'added +errors of the torque sensor: '
check "the search does not come to its end" grep -Eq '"search":[[:space:]]*"complete"' d/summary.json
check "something is left" sh -c '! grep -q "left  *what is not known" stdout'

# Friction is 0.060 + 2e-3 N·m s/rad · ω: 0.066 N·m at 30 rpm.
brakes() {
    awk -F, '$1 == "friction" { v[$2] = $3 * ($4 == "mNm" ? 1e-3 : 1); seen = 1 }
        END { w = 3.1416; x = v["coulomb"] + v["viscous"] * w + v["quadratic"] * w * w; exit !(seen && x > 0.060 && x < 0.072) }' "$1"
}
check "friction is another one: $(cat d/machine/effects.csv)" brakes d/machine/effects.csv

finish
