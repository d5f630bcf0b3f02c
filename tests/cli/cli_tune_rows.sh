#!/bin/sh
# What tune makes of rows as test benches write them: without a clock, there and back in one file, of sensors that are at their end or off at zero.
# labels: slow
#   cli_tune_rows.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
use_plain_build
cd "$work" || exit 1

# FILE LOAD_A OFF: six turns, 512 rows each, read at even steps of the angle, three pole pairs, OFF times 0.9 N·m/A with a ripple of 3 %. The current
# sensors have zeros and noise; theirs is a gain of 1, or with OFF 1 another one each.
by_angle() {
    awk -v load="$2" -v off="$3" 'function noise() { return rand() + rand() + rand() + rand() - 2 }
        BEGIN { srand(3 + load); turn = 6.283185307179586; print "theta_m_deg,torque_Nm,ia_A,ib_A,ic_A,speed_rpm"
        for (k = 0; k < 3072; ++k) { x = 0.4 + k * turn / 512; e = 3 * x
            a = load * sin(e); b = load * sin(e - turn / 3); c = load * sin(e + turn / 3)
            torque = off * load * (0.9 + 0.03 * sin(6 * e + 0.4)) + 0.05 * sin(6 * x + 1) + 0.02 * sin(12 * x) - 0.01
            printf "%.4f,%.4f,%.4f,%.4f,%.4f,30.0\n", x * 360 / turn, torque + 0.008 * noise(),
                a * (off == 1 ? 0.995 : 1) + 0.01 + 0.02 * noise(), b * (off == 1 ? 0.988 : 1) - 0.006 + 0.02 * noise(), c * (off == 1 ? 0.991 : 1) + 0.001 + 0.02 * noise() } }' >"$1"
}
plain='--pole-pairs 3 --flux 0.2 --slots 9'
motor="$plain --rated-current 4"

# ---- without a clock: what was read without a load is noise by its rows as well, and the load tells the back-EMF

by_angle idle.csv 0 1
by_angle load.csv 4 1
run 1 tune idle.csv load.csv $motor -o untimed
# whether the ripple of one load goes with the current or with its square these two do not tell: what the table leaves at another one is wide
says 'at most .* \(95 %\) if the torque sensor is in time' 'These recordings do not tell back-EMF, reluctance torque, saturation' 'zeros of the sensors, taken as no current' \
    'Whether the torque sensor reads late: no recording with it has a column' 'same logs with a column of the time'
check "a back-EMF that was not found" [ "$(grep -c 'back_emf,rejected' untimed/diagnose/effects.csv)" -eq 0 ]

# ---- a torque per ampere that is another one is not told from what else one load shows: another load is asked for, and tells

by_angle one.csv 4 0.99
by_angle half.csv 2 0.99
# The motor at the currents of a folder, at 720 angles: peak to peak.
true_Nm() {
    awk -F, 'FNR > 1 { n[++m] = $1; sign[m] = $2 == "pos" ? 1 : $2 == "neg" ? -1 : 0; A[m] = $3; g[m] = $4 }
        END { turn = 6.283185307179586; low = 1e9; high = -1e9
            for (k = 0; k < 720; ++k) { e = k * turn / 720; q = 0
                for (s = 0; s < 3; ++s) for (j = 1; j <= m; ++j) q += 2 / 3 * A[j] * sin(n[j] * e - sign[j] * s * turn / 3 + g[j]) * sin(e - s * turn / 3)
                T = 0.99 * q * (0.9 + 0.03 * sin(6 * e + 0.4)) + 0.05 * sin(2 * e + 1) + 0.02 * sin(4 * e)
                if (T < low) low = T
                if (T > high) high = T }
            printf "%.5f\n", high - low }' "$1/currents/currents.csv"
}
run 1 tune idle.csv one.csv $motor --json -o one
bound=$(sed -n 's/.*"peak_to_peak_Nm_95":[[:space:]]*\([0-9.e-]*\).*/\1/p' "$work/stdout" | head -1)
check "one load: true $(true_Nm one), stated ${bound:-none}" awk -v x="$(true_Nm one)" -v b="${bound:-0}" 'BEGIN { exit !(x < b && b < 0.1) }'
run 1 tune idle.csv one.csv half.csv $motor -o two
says '^tuned.*falls to at most 0\.00[0-9]* N·m on the machine'
says '^  On the bench, each steady .diagnose/measure_next.csv.:$' '^    10 turns (forward|back) at [0-9.]* rpm: i_d [-0-9.]* A, i_q [-0-9.]* A$'
check "a row for each of measure_next.csv" [ "$(grep -c '^    10 turns ' "$work/stdout")" -eq "$(sed 1d two/diagnose/measure_next.csv | wc -l)" ]
check "one load, of two" [ "$(grep -c 'All loads are of one size' "$work/stdout")" -eq 0 ]

# ---- phase currents that swing are no rms values, whatever their header says, unless the user does

for log in idle one half; do sed '1s/\(i[abc]\)_A/\1 [Aeff]/g' $log.csv >$log.eff.csv; done
run 1 tune idle.eff.csv one.eff.csv half.eff.csv $motor -o eff
says '^tuned.*falls to at most 0\.00[0-9]* N·m on the machine' 'phase currents up to 4\.0' 'swings to both' 'over √2 say' '^  conventions: consistent'
run 1 check eff/machine one.eff.csv --column 'ia_Arms=ia [Aeff]' --column 'ib_Arms=ib [Aeff]' --column 'ic_Arms=ic [Aeff]'
check "a user who says rms and is not heard" [ "$(grep -c 'swings to both' "$work/stdout")" -eq 0 ]

# ---- zeros of sensors behind a filter: its noise is no current, against which nothing is held, and the zeros and what they make are told

awk 'function noise() { return rand() + rand() + rand() + rand() - 2 }
    BEGIN { srand(9); turn = 6.283185307179586; print "time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm,speed_rpm"
    for (k = 0; k < 40000; ++k) { x = 0.4 + k * turn / 5000
        a = 0.6 * a + 0.05 * noise(); b = 0.6 * b + 0.05 * noise(); c = 0.6 * c + 0.05 * noise()
        printf "%.4f,%.5f,%.4f,%.4f,%.4f,%.5f,60\n", k / 5000, x, a + 0.04, b - 0.025, c + 0.01,
            -0.1 + 0.3 * sin(18 * x + 1) + 0.04 * noise() } }' >zeros.csv
run 0 tune zeros.csv $plain --rated-current 40 --torque 20 -o zeros
says '^tuned: ' 'In 1 of 1 runs what was read as current, up to 0.04 A, stands still' '^       i_a = .i_a_read - 0.0[0-9]* A.$' '^       i_b = .i_b_read . 0.0[0-9]* A.$' \
    'The offsets of the currents are those of the logs: .*these make 0.0[0-9]* N·m once an electrical turn'
check "noise that a rating is held against" [ "$(grep -c 'largest recorded one' "$work/stdout")" -eq 0 ]

# ---- a rated current in mA: no sign is accused of what is a load beside the logs without one

awk -F, -v OFS=, 'NR == 1 { print; next } { row[NR] = $0 } END { for (k = NR; k > 1; --k) { split(row[k], x, ","); print x[1], x[2] + 0.02, x[3], x[4], x[5], -x[6] } }' \
    idle.csv >back.csv
milli="$plain --rated-current 4000"
run 1 tune idle.csv back.csv one.csv half.csv $milli -o milli
says '^tuned' 'A rated current of 4000 A is [0-9]* times the largest that was recorded, 4.* A: is it in mA .--rated-current 4.'
check "a sign, of a rating in mA" [ "$(grep -c 'generator' "$work/stdout")" -eq 0 ]
run 1 tune idle.csv back.csv $milli -o unloaded
says 'A rated current of 4000 A would make [0-9]*000 times all torque that is found or asked for: is it in mA .--rated-current 4.'
run 0 check milli/machine idle.csv back.csv one.csv half.csv
says '^consistent'

# ---- a slip of the sheet is said without digits that nobody wrote

run 1 tune idle.csv one.csv half.csv --pole-pairs 3 --volt-per-krpm 54.4 --slots 9 --rated-current 4 -o sheet
says 'slip'
check "more digits than anybody wrote" [ "$(grep -c '[0-9]\.[0-9]\{9,\}' "$work/stdout")" -eq 0 ]

# ---- current sensors that end at 3.7 A: what they do not show is taken from the two others, and said with rows, value and remedy

awk -F, -v OFS=, 'NR > 1 { for (k = 3; k <= 5; ++k) $k = $k > 3.7 ? "3.7000" : $k < -3.7 ? "-3.7000" : $k } 1' one.csv >ended.csv
run 1 tune idle.csv ended.csv half.csv $motor -o ended
says '^tuned.*falls to at most 0\.0[0-9]* N·m on the machine' 'phase currents are clipped: in [12][0-9]* of 3072 rows one stands at -3.7$' \
    'is taken from the two others' 'sensors of a wider range would show it'
check "a slow channel, of sensors at their end" [ "$(grep -c 'read less often' "$work/stdout")" -eq 0 ]

# ---- there and back in one file, with a pause in which the shaft is turned on: one speed, of which the sign tells friction from the sensor's zero

# FILE SPEED_COLUMN: 12 turns of 4 s each way, a torque sensor of 0.02 N·m behind a friction of 0.03.
there_and_back() {
    awk -v with="$2" 'function noise() { return rand() + rand() + rand() + rand() - 2 }
        BEGIN { srand(7); turn = 6.283185307179586; print "time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm" (with ? ",speed_rpm" : "")
        for (way = 1; way >= -1; way -= 2) for (k = 0; k < 12000; ++k) {
            t = (way < 0 ? 15 : 0) + k / 1000; x = (way < 0 ? 41.3 : 1.7) + way * k / 4000 * turn
            printf "%.4f,%.5f,%.4f,%.4f,%.4f,%.5f%s\n", t, x, 0.01 + 0.01 * noise(), -0.006 + 0.01 * noise(), 0.01 * noise(),
                0.05 * sin(18 * x + 1) + 0.02 * sin(36 * x) + 0.02 - 0.03 * way + 0.007 * noise(), with ? sprintf(",%.2f", 15 * way) : "" } }' >"$1"
}
for speed in '' speed; do
    there_and_back "ways$speed.csv" "$speed"
    run 0 tune "ways$speed.csv" $motor -o "ways$speed"
    says '^tuned: A ripple of 0.1[0-9]* N·m from peak to peak falls' 'friction .added.: coulomb = 0.03' 'errors of the torque sensor .added.: offset = 0.0[12]'
done

# ---- turned slowly by control there and back: what the model leaves is no better known than what it has

awk 'BEGIN { srand(6); turn = 6.283185307179586; print "time_s,theta_m_rad,speed_rad_per_s,iq_A"; w = 0.6; one = 1.2 * turn / w; dt = 0.005; x = 0.3
    for (t = 0; t < 2 * one; t += dt) { way = t < one ? 1 : -1
        printf "%.4f,%.6f,%.5f,%.5f\n", t, x, way * w, (way * 0.006 + 0.004 * sin(60 * x + 0.3)) / 0.1 + 0.1 * (rand() - 0.5); x += way * w * dt } }' >slow.csv
run 0 tune slow.csv --pole-pairs 5 --flux 0.0133333333333333 --slots 12 --rated-current 1 --torque 0.05 -o slow
says '^tuned: .* \(its orders are known to 0\.000[0-9]* N·m\) in the model; what harmonics' '^  ripple in the model, N·m .* not known$'
check "the report has figures of more than the model" grep -q 'Torque ripple in the model, peak to peak' slow/currents/report.html

finish
