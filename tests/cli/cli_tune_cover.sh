#!/bin/sh
# What tune says of recordings that show a part of the turn, or too few samples of it.
#   cli_tune_cover.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
cd "$work" || exit 1

# NAME TURNS: i_q answers cogging torque of orders 2 and 12 of seven pole pairs, at 12 rpm, over so much of the turn
crawl() {
    awk -v turns="$2" 'BEGIN { srand(3); print "time_s,speed_rpm,theta_m_rad,id_A,iq_A"; turn = 6.283185307179586; count = int(500 * turns)
        for (k = 0; k < count; ++k) { x = 0.2 + turn * k / 500; printf "%.3f,12,%.6f,%.5f,%.5f\n", 0.01 * k, x, 0.002 * (rand() - 0.5),
            0.05 + 0.1 * sin(14 * x) + 0.3 * sin(84 * x + 0.4) + 0.01 * (rand() - 0.5) } }' >"$1"
}
crawl tenth.csv 0.11
run 1 tune tenth.csv --pole-pairs 7 --kv 120 --inertia 1e-6 -o tenth
says '^not enough in the logs: The logs cover not even one electrical turn' 'tenth.csv: 55 samples, 0.54 s, 0.108 turns'
check "a table in tenth" [ ! -e tenth/table ]
crawl half.csv 0.52
run 1 tune half.csv --pole-pairs 7 --kv 120 --inertia 1e-6 -o half
says '^tuned, with something left open: ' '^  - The logs cover 0.52 of a turn'
check "how much to record" grep -q "Record at least one whole turn, better several" half/summary.json

# ---- 33 slots and 10 poles: their order is above all that is looked at, however many samples there are, and nothing stands for it

awk 'BEGIN { srand(6); print "time_s,theta_m_rad,speed_rad_per_s,id_A,iq_A"; turn = 6.283185307179586; for (k = 0; k < 10000; ++k) { t = 0.004 * k
    way = t < 20 ? 1 : -1; x = 0.2 + 0.6 * (t < 20 ? t : 40 - t); printf "%.3f,%.6f,%.4f,0,%.5f\n", t, x, 0.6 * way,
        0.05 * way + 0.3 * sin(33 * x + 0.4) + 0.2 * sin(30 * x + 0.1) + 0.01 * (rand() - 0.5) } }' >many.csv
run 0 tune many.csv --pole-pairs 5 --kv 120 --slots 33 -o many
says '^tuned: ' '  order 33/5: 0\.0'
check "what is not looked at" grep -q 'The cogging torque of slots and poles, order 66: none above order 60 is looked at' many/summary.json
check "samples are called too few" [ "$(grep -c 'lie too far apart' many/summary.json)" -eq 0 ]
check "the slots of a turn are called strangers" [ "$(grep -c 'is none that' many/summary.json)" -eq 0 ]

# NAME RPM AMPERES SAMPLES HELD: ten turns of four pole pairs, so many samples a turn; cogging torque of orders 6 and 12, a torque that is refreshed
# at each HELD-th row
dyno() {
    awk -v rpm="$2" -v amp="$3" -v samples="$4" -v held="$5" 'BEGIN { srand(rpm + amp + 500); print "time_s,theta_m_rad,speed_rpm,ia_A,ib_A,ic_A,torque_Nm"
        turn = 6.283185307179586; for (k = 0; k < 10 * samples; ++k) { x = turn * (k / samples + 0.0137); e = 4 * x
            if (k % held == 0) torque = 0.75 * amp + 0.12 * sin(6 * e + 1) + 0.03 * sin(12 * e + 2) - 0.1 + 0.01 * (rand() - 0.5)
            printf "%.6f,%.6f,%g,%.5f,%.5f,%.5f,%.5f\n", k / samples * 60 / rpm, x, rpm, amp * sin(e) + 0.01 * (rand() - 0.5),
                amp * sin(e - turn / 3) + 0.01 * (rand() - 0.5), amp * sin(e + turn / 3) + 0.01 * (rand() - 0.5), torque } }' >"$1"
}
# FOLDER SAMPLES HELD
bench() {
    dyno zero.csv 60 0 "$2" "$3"
    dyno half_load.csv 240 5 "$2" "$3"
    dyno load.csv 60 10 "$2" "$3"
    dyno fast.csv 240 10 "$2" "$3"
    run 0 tune zero.csv half_load.csv load.csv fast.csv --pole-pairs 4 --flux 0.125 --slots 24 --rated-current 11 -o "$1"
}
bench coarse 86.5 1
says 'Orders above 10.4 were not looked at' 'Ripple above the electrical order 10.4: no recording has'
check "a bound of what was not looked at" [ "$(grep -c '(95 %)' "$work/stdout")" -eq 0 ]
bench held 692 8
says 'Orders above 10.4 were not looked at'
check "the readings in a turn" grep -q '865 samples, .*, 86.[4-6] samples a turn' held/summary.json
check "a bound of what a held torque does not show" [ "$(grep -c '(95 %)' "$work/stdout")" -eq 0 ]

# ---- a torque at places all round, without a time: 264 a turn of 24 slots and 22 poles look like 64 at 200 of them

places() { # FILE PLACES
    awk -v n="$2" 'BEGIN { srand(8); print "theta_m_deg,torque_Nm"; turn = 6.283185307179586
        for (k = 0; k < n; ++k) printf "%.4f,%.6f\n", 360 * k / n, 0.01 * sin(264 * turn * k / n) + 0.03 * sin(24 * turn * k / n) + 0.001 * (rand() - 0.5) }' >"$1"
}
places few.csv 200
run 1 tune few.csv --pole-pairs 11 --torque-constant 0.8 --slots 24 --rated-current 6 -o few
says '^the samples lie too far apart: ' '^  - Order 24, which slots and poles make, was not looked at'
check "a table in few" [ ! -e few/table ]
places enough.csv 1200
run 0 tune enough.csv --pole-pairs 11 --torque-constant 0.8 --slots 24 --rated-current 6 -o enough
says 'order 24: 0\.01 '
run 1 tune enough.csv --pole-pairs 12 --torque-constant 0.8 --slots 24 --rated-current 6 -o twelve
says '24 slots and 24 poles are of no winding of three equal phases'

# ---- exactly once round each way: the rows of the start and of the turning point are not used, and leave a gap

# FILE TURNS [GAP SHIFT [SPEED]]: forward and back, at SPEED times 6 rpm; GAP seconds of rows are missing in the middle of each way, of the way back
# SHIFT seconds off the same place
to_and_fro() {
    awk -v turns="$2" -v gap="${3:-0}" -v shift="${4:-0}" -v speed="${5:-1}" 'BEGIN { srand(3); print "time_s,theta_m_rad,iq_A"
        w = 0.6283185 * speed; end = 6.2831853 * turns / w + 0.125; n = 2000 * (end + 0.5)
        for (k = 0; k <= n; ++k) { t = 0.001 * k; half = end + 0.25; u = t < half ? t : 2 * half - t; if (u < 0) u = 0
            x = u < 0.25 ? 0.5 * w / 0.25 * u * u : u < end ? w * (u - 0.125) : w * (end - 0.125) + w * (u - end) - 2 * w * (u - end) * (u - end)
            way = u <= 0 ? 0 : t < half ? 1 : -1; at = u - 0.4 * end + (way < 0 ? shift : 0)
            if (at > 0 && at < gap) continue
            printf "%.3f,%.6f,%.5f\n", t, 0.2 + x, 0.05 * way + 0.1 * sin(14 * x) + 0.3 * sin(84 * x + 0.4) + 0.01 * (rand() - 0.5) } }' >"$1"
}
to_and_fro once.csv 0.9875
run 1 tune once.csv --pole-pairs 7 --kv 120 --slots 12 --inertia 1e-6 -o once
says '^not enough in the logs: A small part of the turn has no samples' 'Turn somewhat further than once round each way, such as 1.1 turns'
check "samples are called too few" [ "$(grep -c 'lie too far apart' once/summary.json)" -eq 0 ]
to_and_fro further.csv 1.1
run 0 tune further.csv --pole-pairs 7 --kv 120 --slots 12 --inertia 1e-6 -o further
says '^tuned: ' '  order 12: 0\.0'

# ---- rows are missing: where the other direction has samples there, both together tell the order; where not, a slower turn does

to_and_fro holes.csv 1.25 0.06 2
run 0 tune holes.csv --pole-pairs 7 --kv 120 --slots 12 --inertia 1e-6 -o holes
says '^tuned: ' '  order 12: 0\.02'
check "an order that was looked at" [ "$(grep -c 'was not looked at' holes/summary.json)" -eq 0 ]
to_and_fro hole.csv 1.1 0.1 0
run 1 tune hole.csv --pole-pairs 7 --kv 120 --slots 12 --inertia 1e-6 -o hole
says '^not enough in the logs: A small part of the turn has no samples' 'Turn more slowly, at 0\.4 of the speed, or log without missing rows: 3\.'
check "advice that was followed already" [ "$(grep -c '1.1 turns' hole/summary.json)" -eq 0 ]
to_and_fro slower.csv 1.1 0.1 0 0.4
run 0 tune slower.csv --pole-pairs 7 --kv 120 --slots 12 --inertia 1e-6 -o slower
says '^tuned: ' '  order 12: 0\.02'

# ---- as many samples in each turn, at the same places: order 24 of slots and poles goes through 140 of them as order 4 does, and not through 147.3

at_places() { # NAME SAMPLES: of a turn; four recordings forward and back
    for load in 0 1.5 3 5; do
        awk -v n="$2" -v q="$load" 'function noise() { return rand() + rand() + rand() + rand() - 2 }
            BEGIN { srand(3 + q); turn = 6.283185307179586; print "time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm"
            for (way = 1; way >= -1; way -= 2) for (k = 0; k < 4 * n; ++k) { j = way > 0 ? k : 4 * n - k
                x = 0.1 + j / n * turn; e = 5 * x; t = (way < 0 ? 90 : 0) + k / 14
                printf "%.4f,%.7f,%.4f,%.4f,%.4f,%.5f\n", t, x, q * sin(e) + 0.005 * noise(), q * sin(e - turn / 3) + 0.005 * noise(),
                    q * sin(e + turn / 3) + 0.005 * noise(), q * (0.82 + 0.02 * sin(6 * e + 0.3)) + 0.045 * sin(60 * x + 0.7) + 0.011 * sin(120 * x - 0.9) - 0.05 * way + 0.008 * noise() } }' >"$1_$load.csv"
    done
}
at_places locked 140
run 1 tune locked_0.csv locked_1.5.csv locked_3.csv locked_5.csv --pole-pairs 5 --slots 12 --torque-constant 0.82 --rated-current 5 -o locked
says '^tuned, with something left open: A ripple of .* .if order 4 is not order 24, which these samples show as it. in the model' \
    '^  - Order 4, 0\.011 N·m, may be order 24, .* up to 0\.04[0-9]* N·m from peak to peak'
check "an order that may be another is known" [ "$(grep -c 'are known to' locked/summary.json)" -eq 0 ]
at_places between 147.3
run 0 tune between_0.csv between_1.5.csv between_3.csv between_5.csv --pole-pairs 5 --slots 12 --torque-constant 0.82 --rated-current 5 -o between
check "orders that the samples tell apart" [ "$(grep -c 'which these samples show as it' between/summary.json)" -eq 0 ]
finish
