#!/bin/sh
# What the zeros of the current sensors make of a torque, and what is left of it: logs of a torque sensor whose drive makes what its sensors read
# zero or even, so that what they read too much flows in all of them.
# labels: slow
#   cli_tune_sensors.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
use_plain_build
cd "$work" || exit 1

# 5 pole pairs, 0.1 N·m/A; cogging torque of order 12, 0.004 N·m; zeros of 30 mA make 0.003 N·m of order 1 beside any load, which cogging torque of that
# order would make as well; 2 turn/s. COLUMNS: 0: the log has no currents. ONCE: torque per ampere that varies once a turn, a
# share, with another phase in each log, as no effect has it.
sensor_log() { # FILE LOAD_A SEED COLUMNS ONE_Nm ONCE WAY NOISE
    awk -v load="$2" -v seed="$3" -v columns="$4" -v one="$5" -v once="$6" -v way="${7:-1}" -v level="${8:-0.0005}" 'BEGIN { srand(seed); turn = 6.283185307179586
        print "time_s,theta_m_rad,speed_rad_per_s," (columns ? "iq_A,id_A," : "") "torque_Nm"
        for (k = 0; k < 6000; ++k) { t = k / 1000; x = way * 2 * turn * t; noise = rand() + rand() + rand() - 1.5
            torque = 0.1 * load * (1 + once * sin(x + 2 * seed) + 0.01 * sin(30 * x)) + 0.004 * sin(60 * x + 0.3) + one * sin(5 * x + 1) - way * 0.002 + level * noise
            printf "%.4f,%.6f,%.4f,", t, x, way * 2 * turn
            if (columns) printf "%.5f,%.5f,", load + 0.002 * (rand() - 0.5), 0.002 * (rand() - 0.5)
            printf "%.6f\n", torque } }' >"$1"
}
motor='--pole-pairs 5 --flux 0.0133333333333333 --slots 12 --rated-current 1 --torque 0.08'
bound() { # FOLDER: the bound in N·m, 0: none
    tr -d ' \t' <"$1/summary.json" | sed -n 's/^"peak_to_peak_Nm_95":\([0-9.e-]*\).*/\1/p' | head -1
}

for load in 0.3 1; do sensor_log "one$load.csv" $load 2 1 0.003 0; done
sensor_log one0.6.csv 0.6 3 1 0.003 0 -1
sensor_log idle.csv 0 1 1 0.003 0
sensor_log open.csv 0 1 0 0.003 0

# ---- a drive was on in every log: cogging torque or zeros of the sensors, and the bound has both

run 0 tune idle.csv one0.3.csv one0.6.csv one1.csv $motor -o on
says '^  - Order 1, 0\.003 N·m, is cogging torque, or zeros of the current sensors that are off by up to 0\.03 A' 'Whether order 1, 0\.003 N·m, is cogging torque or' \
    'N·m are for order 1, which zeros'
check "the bound has no room for a sensor that is right: $(bound on)" awk -v b="$(bound on)" 'BEGIN { exit !(b > 0.006) }'
check "what solve and predict are told" grep -q '^sensor_zero,0\.0030*[0-9]*,Nm$' on/diagnose/machine/diagnosis.csv
run 0 solve on/diagnose/machine --target on/target.csv --auto -o on_solved
says 'zeros of the current sensors'

# ---- a log without currents shows the torque of the motor by itself

run 0 tune open.csv one0.3.csv one0.6.csv one1.csv $motor -o off
check "a doubt that the open machine takes away" [ "$(grep -c 'order 1, 0' off/summary.json)" -eq 0 ]
check "a bound of what is told: $(bound off)" awk -v b="$(bound off)" 'BEGIN { exit !(b > 0 && b < 0.004) }'

# ---- what repeats with the turn and no effect has is in the bound

# Orders 1/5 and 6, 2 and 1 % of the torque, come to 4.8 mN·m at 0.8 A: what the log of that load shows, and the median of all.
sensor_log left0.csv 0 1 1 0 0.02 1 0.002
sensor_log left0.6.csv 0.6 2 1 0 0.02 1 0.002
sensor_log left0.8.csv 0.8 3 1 0 0.02 -1 0.002
sensor_log left1.csv 1 4 1 0 0.02 1 0.002
run 0 tune left0.csv left0.6.csv left0.8.csv left1.csv $motor -o left
check "the bound lacks what the recordings show: $(bound left)" awk -v b="$(bound left)" 'BEGIN { exit !(b > 0.0048) }'
check "what is left is not in the file" grep -q '^left_orders,0\.00[34][0-9]*,Nm$' left/diagnose/machine/diagnosis.csv
says 'are for orders that|orders that the recordings'

# ---- a torque sensor that reads 4 % too much makes the machine that much stronger: it is said of what the figures are

for load in 0.3 0.6 1; do
    awk -F, -v OFS=, 'NR > 1 { $6 *= 1.04 } 1' "one$load.csv" >"more$load.csv"
done
awk -F, -v OFS=, 'NR > 1 { $4 *= 1.04 } 1' open.csv >more_open.csv
run 0 tune more_open.csv more0.3.csv more0.6.csv more1.csv $motor -o more
says '^  - The torque per ampere is 4 % more than --flux makes: stronger or colder magnets, or a gain of the torque sensor .* smaller than said\. Voltages of the open machine tell the magnets$'
check "a load at i_d = 0 is asked for beside three" [ "$(grep -c 'i_d = 0\|reluctance torque where' stdout)" = 0 ]
for load in 0.3 0.6 1; do
    awk -F, -v OFS=, 'NR > 1 { $6 *= 0.94 } 1' "one$load.csv" >"less$load.csv"
done
awk -F, -v OFS=, 'NR > 1 { $4 *= 0.94 } 1' open.csv >less_open.csv
run 0 tune less_open.csv less0.3.csv less0.6.csv less1.csv $motor -o less
says '^  - The torque per ampere is 6 % less than --flux makes: weaker or warmer magnets, or a gain of the torque sensor .* larger than said\. Voltages of the open machine tell the magnets$'
check "a sensor is named alone" [ "$(cat more/summary.json less/summary.json | grep -c 'torque sensor shows')" -eq 0 ]
check "a scale where there is none" [ "$(grep -c 'torque per ampere is' off/summary.json)" -eq 0 ]

# ---- at one speed a lag of the torque sensor would do nothing but take the noise of the currents out of the modelled torque: it is left out, and the
# ---- cogging torque is as large as the log without a current shows it

slow_log() { # FILE LOAD_A SEED: noise of the currents makes more than half of what is left
    awk -v load="$2" -v seed="$3" 'BEGIN { srand(seed); turn = 6.283185307179586
        print "time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm"
        for (k = 0; k < 8000; ++k) { t = k / 1000; x = turn * t / 2; noise = rand() + rand() + rand() - 1.5
            torque = 0.1 * load * (1 + 0.02 * sin(30 * x + 1)) + 0.006 * sin(60 * x + 0.3) + 0.002 * sin(10 * x) - 0.004 + 0.001 * noise
            printf "%.4f,%.6f", t, x
            for (s = 0; s < 3; ++s) printf ",%.4f", load * sin(5 * x - s * turn / 3) + 0.02 * (rand() + rand() + rand() - 1.5)
            printf ",%.6f\n", torque } }' >"$1"
}
for load in 0 0.5 1; do slow_log "slow$load.csv" $load "1$load"; done
run 1 tune slow0.csv slow0.5.csv slow1.csv $motor -o slow
check "a lag at one speed" [ "$(grep -c '^torque_sensor,time_constant' slow/diagnose/machine/effects.csv)" -eq 0 ]
says 'order 12: 0\.00(59|60)[0-9]* ± ' 'if the torque sensor is in time, which one speed does not tell' '^  ripple, peak to peak, N·m .* at most .* if the torque sensor is in time$'
says '^  - Each 1 ms that the torque is late .* leaves some 0\.0023 N·m' # 2 √(Σ (order × π rad/s × amplitude)²): 0.006 at 60, 0.002 at 30 and 10

# ---- gains that one load does not tell from the back-EMF are no instruction to the drive; a second load tells them

gained() { # FILE I_Q WAY SEED: sensors that read 10, 8 and 9 % too much
    awk -v q="$2" -v way="$3" -v seed="$4" 'BEGIN { srand(seed); turn = 6.283185307179586; g[0] = 1.1; g[1] = 1.08; g[2] = 1.09; print "time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm"
        for (k = 0; k < 8000; ++k) { t = k / 1000; x = 0.3 * seed + way * turn / 2 * t; e = 5 * x
            T = 1.5 * q * (0.2 + 0.008 * sin(6 * e + 0.4) + 0.003 * sin(12 * e)) + 0.03 * sin(60 * x + 1) - way * 0.02 + 0.004 * (rand() + rand() + rand() - 1.5)
            row = sprintf("%.5f,%.6f", t, x)
            for (s = 0; s < 3; ++s) row = row sprintf(",%.4f", g[s] * q * sin(e - s * turn / 3) + 0.01 * (rand() + rand() + rand() - 1.5))
            printf "%s,%.5f\n", row, T } }' >"$1"
}
gained gained0.csv 0 1 1
gained gainedb.csv 0 -1 2
gained gained2.csv 2 1 3
gained gained4.csv 4 1 4
gains='--pole-pairs 5 --torque-constant 0.3 --slots 12 --rated-current 5'
run 0 tune gained0.csv gainedb.csv gained4.csv $gains -o gained
says 'have to be corrected before, in the order of these lines:$' '^       i_a = i_a_read \* 0\.99' 'The torque per ampere is 8\.[0-9]* % less than --torque-constant makes: .* a gain of the torque sensor \(or of those of the currents\), which would make mean torque and ripple as much larger'
run 0 tune gained0.csv gainedb.csv gained2.csv gained4.csv $gains -o gained2
says 'have to be corrected before, in the order of these lines:$' '^       i_a = i_a_read \* 0\.99'
finish
