#!/bin/sh
# How recordings are read is that in tests/files/kept/read.txt, number by number: those of loggers, and one log with other columns, units, clocks and holes;
# waves of voltages; slow turns. After a change that is meant: --renew, and look at the differences.
#   cli_kept_read.sh SOURCE_DIR BUILD_DIR HCI_SOLVE [--renew]
. "$1/tests/support/common.sh"
use_plain_build
. "$source_dir/tests/cli/kept_inputs.sh"

# Two dozen loggers.
mkdir logs
for log in $(python3 "$source_dir/tests/cli/loggers.py" logs); do
    run 0 predict logs/machine "logs/$log.csv" -q -o "kept/logger_$log.csv"
done

# A shaft that swings about 50 rad/s and turns back, p = 3: NAMES and NUMBERS are a header and what awk prints of t, m (angle), w, i_d, i_q, T, and ph(n).
log() { # NAME HEADER NUMBERS [AWK]
    awk -v header="$2" 'function noise(   n, sum) { for (n = 0; n < 12; n++) { seed = 16807 * seed % 2147483647; sum += seed / 2147483647 - 0.5 } return sum }
        function ph(n) { return -id * cos(3 * m - 2 * pi * n / 3) + iq * sin(3 * m - 2 * pi * n / 3) }
        function wrap(x, turn) { return x - turn * int(x / turn) }
        function clock(x) { return sprintf("%02d:%02d:%07.4f", int(x / 3600), int(x / 60) % 60, x - 60 * int(x / 60)) }
        BEGIN { seed = 21; pi = atan2(0, -1); print header; m = 2.2; dt = 1e-3
            for (k = 0; k < 500; k++) { t = k * dt; w = 50 + 9 * sin(7 * t); id = -1.5; iq = 4 + sin(11 * t); cell = ""
                T = 0.36 * iq + 0.05 * sin(18 * m + 0.2) + 0.01 * cos(m) - 0.02 - 3e-4 * w + 0.004 * noise()
                '"${4-}"'
                print '"$3"'; m += w * dt } }' >"$1.csv"
}
machine=read
mkdir read && printf 'order,amplitude_Nm_per_A,phase_rad\n1,0.24,0\n5,0.01,0.4\n' >read/back_emf.csv
printf 'name,value,unit,source\npole_pairs,3,1,test\ninertia,4e-4,kgm2,test\n' >read/machine.csv
predicted() { # NAME [OPTION...]
    name=$1
    shift
    "$hci_solve" predict $machine "$name.csv" "$@" -q -o "kept/$name.csv" >stdout 2>stderr
    check "$name is read: $(cat stderr)" [ -s "kept/$name.csv" ]
}
log plain time_s,theta_m_rad,speed_rad_per_s,ia_A,ib_A,ic_A,torque_Nm 't "," m "," w "," ph(0) "," ph(1) "," ph(2) "," T'
predicted plain
log dq 'time_ms;theta_e_deg;speed_rpm;id_mA;iq_mA;torque_mNm' '1000 * t ";" wrap(3 * m, 2 * pi) * 180 / pi ";" w * 30 / pi ";" 1000 * id ";" 1000 * iq ";" 1000 * T'
predicted dq
log mixed 'Zeit [ms];Winkel [°];Drehzahl [1/min];Strom U [A];Strom V [A];Drehmoment [Nm]' '1000 * t ";" wrap(m, 2 * pi) * 180 / pi ";" w * 30 / pi ";" ph(0) ";" ph(1) ";" T'
sed 's/\./,/g' mixed.csv >mark.csv
predicted mark
log slope time_s,theta_m_rad,iq_A,torque_Nm 't "," wrap(m, 2 * pi) "," iq "," T'
predicted slope
log rounded time_s,theta_m_rad,iq_A,torque_Nm 'int(t * 250) / 250 "," wrap(m, 2 * pi) "," iq "," T'
predicted rounded
log again time_s,theta_m_rad,speed_rad_per_s,iq_A,torque_Nm '(k > 350 ? t - 0.35 : t) "," m "," w "," iq "," T'
predicted again
log late time_s,theta_m_rad,speed_rad_per_s,iq_A,torque_Nm '(k > 200 ? t + 0.5 : t) "," m "," w "," iq "," T'
predicted late
log holes time_s,theta_m_rad,speed_rad_per_s,iq_A,torque_Nm 't "," (k % 50 == 7 ? "" : m) "," (k % 61 == 3 ? "NaN" : w) "," iq "," (k > 100 && k < 110 ? "#N/A" : T)'
predicted holes
log stamps time,theta_m_rad,speed_rad_per_s,iq_A,torque_Nm 'clock(43190 + 40 * t) "," m "," w "," iq "," T'
predicted stamps
log counts time_s,enc,iq_A,torque_Nm 't "," int(wrap(m, 2 * pi) / 2 / pi * 4096) "," iq "," T'
predicted counts --column theta_m=enc/4096
log moteus time_s,position,velocity,q_current,d_current,torque 't "," m / 2 / pi "," w / 2 / pi "," iq "," id "," T'
predicted moteus
log erpm time_s,theta,erpm,ia_A,ib_A,ic_A,torque_Nm 't "," wrap(3 * m, 2 * pi) "," 3 * w * 30 / pi "," ph(0) "," ph(1) "," ph(2) "," T'
predicted erpm --column theta_e=theta
log back time_s,theta_m_rad,iq_A,torque_Nm 't "," 8 * sin(2 * pi * t / 0.37 + 0.4) "," iq "," T'
predicted back
log free time_s,theta_m_rad,speed_rad_per_s,iq_A 't "," m "," w "," iq'
predicted free

# Cogging, with a torque sensor, of the acceleration, and of the current of a slow turn that waits between.
for name in plain dq rounded holes; do kept "c_$name" 0 harmonics $name.csv --quantity cogging --pole-pairs 3 --torque-constant 0.36; done
kept c_orders 0 harmonics plain.csv --quantity cogging --pole-pairs 3 --torque-constant 0.36 --orders 1/3,6
kept c_inertia 0 harmonics free.csv --quantity cogging --pole-pairs 3 --torque-constant 0.36 --inertia 4e-4
slow() { # NAME SPEED INERTIA
    awk -v w="$2" -v inertia="$3" 'BEGIN { srand(2); pi = atan2(0, -1); print "time_s,theta_m_rad,speed_rad_per_s,iq_A"; a = 0.4; dt = 0.004; n = int(2.6 * pi / w / dt)
        for (k = -40; k < 2 * n + 40; k++) { way = k < 0 || k >= 2 * n ? 0 : k < n ? 1 : -1; v = way * w * (1 + 0.1 * sin(12 * a))
            T = way * 0.01 + 0.02 * sin(12 * a + 0.3) + 0.006 * cos(36 * a) + inertia * way * w * 1.2 * cos(12 * a) * v
            printf "%.4f,%.8f,%.7f,%.7f\n", (k + 40) * dt, a, v, T / 0.36 + 0.003 * (((k * 7919) % 101) / 50 - 1); a += v * dt } }' >"$1.csv"
}
slow slow_a 1.1 4e-4
slow slow_b 2.3 4e-4
kept c_slow 0 harmonics slow_a.csv --quantity cogging --pole-pairs 3 --torque-constant 0.36 --holding
kept c_faster 0 harmonics slow_b.csv --quantity cogging --pole-pairs 3 --torque-constant 0.36 --holding --inertia 4e-4
printf 'file,role\nplain.csv,fit\nback.csv,fit\nmoteus.csv,fit\n' >fitted.csv
kept f_plain 0 fit read --runs fitted.csv

# Back-EMF: with an angle, by the clock of the waves alone, between terminals, and of given orders; the speed falls.
waves() { # NAME HEADER NUMBERS
    awk -v header="$2" 'function noise(   n, sum) { for (n = 0; n < 12; n++) { seed = 16807 * seed % 2147483647; sum += seed / 2147483647 - 0.5 } return sum }
        function e(n,   x) { x = 3 * a + 0.25 - 2 * pi * n / 3; return w * ((0.2 + 0.004 * n) * sin(x) + 0.03 * sin(5 * x + 0.6) + 0.012 * sin(7 * x - 0.2)) + 0.01 * noise() + 0.05 * n }
        BEGIN { seed = 8; pi = atan2(0, -1); print header; for (k = 0; k < 900; k++) { t = k * 5e-4; w = 70 - 20 * t; a = 70 * t - 10 * t * t; print '"$3"' } }' >"$1.csv"
}
waves emf_angle time_s,theta_m_rad,va_V,vb_V,vc_V 't "," a "," e(0) "," e(1) "," e(2)'
waves emf_clock time_s,va_V,vb_V,vc_V 't "," e(0) "," e(1) "," e(2)'
waves emf_line time_s,theta_m_rad,vab_V,vbc_V,vca_V 't "," a "," e(0) - e(1) "," e(1) - e(2) "," e(2) - e(0)'
for name in emf_angle emf_clock emf_line; do kept $name 0 harmonics $name.csv --quantity back_emf --pole-pairs 3; done
kept emf_orders 0 harmonics emf_angle.csv --quantity back_emf --pole-pairs 3 --orders 1,5
kept emf_clock_orders 0 harmonics emf_clock.csv --quantity back_emf --pole-pairs 3 --orders 1,7
kept_all read "${4-}"
finish
