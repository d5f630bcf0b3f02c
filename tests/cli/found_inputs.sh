# Machines and recordings of several stands, in the folder that is worked in: sourced by cli_kept_found.sh and cli_scaled_*.sh.
# machine NAME PAIRS K_E ROW...: a sinusoidal one with more rows of machine.csv.
machine() {
    folder=$1
    mkdir "$folder"
    printf 'order,amplitude_Nm_per_A,phase_rad\n1,%s,0\n5,0.01,0.4\n' "$3" >"$folder/back_emf.csv"
    printf 'name,value,unit,source\npole_pairs,%s,1,test\n' "$2" >"$folder/machine.csv"
    shift 3
    for row; do echo "$row,test"; done >>"$folder/machine.csv"
}
# runs PROGRAM LIST: awk writes a file for each word FILE:SPEED:ID:IQ of the list; noise() has about the deviation 1.
runs() {
    awk -v list="$2" 'function noise(   n, sum) { for (n = 0; n < 12; n++) { seed = 16807 * seed % 2147483647; sum += seed / 2147483647 - 0.5 } return sum }
        function phase(p, d, q, e) { return d * cos(e - 2 * pi * p / 3) + q * sin(e - 2 * pi * p / 3) }
        BEGIN { seed = 99; pi = atan2(0, -1); turn = 2 * pi; count = split(list, word, " ")
            for (r = 1; r <= count; r++) { split(word[r], x, ":"); file = x[1] ".csv"; w = x[2]; id = x[3]; iq = x[4]; '"$1"' } }'
}

# Iron: p = 3, 0.3 V·s, L_d − L_q = −4 mH, a torque that bends with the current and has its orders; the torque sensor has a zero, and the shaft drags.
machine iron 3 0.3 inductance_d,4,mH inductance_q,8,mH resistance,0.7,ohm rated_current,9,A slots,18,1
runs 'print "time_s,theta_m_deg,speed_rpm,ia_A,ib_A,ic_A,torque_Nm" >file
    for (k = 0; k < 160; k++) { a = k * turn / 120 * (w < 0 ? -1 : 1); e = 3 * a
        T = 0.45 * iq - 4.5 * 0.004 * id * iq - 0.0006 * iq * iq * iq + 0.02 * iq * sin(18 * a + 0.3) + 0.03 * sin(18 * a) + 0.012 * sin(a + 1) + 0.05
        if (w) T -= (w < 0 ? -1 : 1) * 0.03 + 0.0002 * w
        printf "%.9f,%.7f,%.6f,%.7f,%.7f,%.7f,%.7f\n", k * turn / 120 / (w < 0 ? -w : w), a * 360 / turn, w * 60 / turn, phase(0, -id, iq, e), phase(1, -id, iq, e), phase(2, -id, iq, e), T + 0.004 * noise() >file }' \
    'iron_a:40:0:2 iron_b:-70:-3:5 iron_c:110:-5:8 iron_d:20:2:-6 iron_e:90:0:0 iron_f:55:-2:7 iron_g:-60:-4:3 iron_h:80:3:4 iron_i:-30:-1:-8'
{ echo file,role; for k in a b c d e g h i; do echo "iron_$k.csv,fit"; done; echo iron_f.csv,holdout; } >iron.csv

# Free: J = 8e-4 kg m², drag and cogging torque; two that coast and one that i_q accelerates.
machine free 4 0.1 inertia,8e-4,kgm2 rated_current,5,A slots,12,1
runs 'print "time_s,theta_m_rad,speed_rad_per_s,iq_A" >file; a = 0.1; v = w; dt = 2e-4
    for (k = 0; k < 4000; k++) { if (k % 4 == 0) printf "%.6f,%.9f,%.9f,%.7f\n", k * dt, a, v + 0.02 * noise(), iq >file
        T = 0.15 * iq * (1 + 0.02 * sin(24 * a)) - 0.01 - 3e-4 * v + 0.02 * sin(12 * a + 0.5) + 0.006 * sin(24 * a); v += T / 8e-4 * dt; a += v * dt }' \
    'free_a:60:0:0 free_b:90:0:0 free_c:25:0:0.25'
printf 'file,role\nfree_a.csv,fit\nfree_b.csv,fit\nfree_c.csv,fit\n' >free.csv

# Slow: there and back without a torque sensor, at two currents of the zero; its cogging torque is in i_q.
machine slow 5 0.0666 rated_current,1,A slots,12,1
runs 'print "time_s,theta_m_rad,speed_rad_per_s,iq_A" >file; a = 0.3; dt = 0.006; n = int(1.3 * turn / w / dt)
    for (k = 0; k < 2 * n; k++) { way = k < n ? 1 : -1
        q = (way * (0.006 + 0.001 * w) + 0.004 * sin(60 * a + 0.3) + 0.002 * sin(12 * a) + 0.001 * cos(a)) / 0.1 + iq + 0.002 * noise()
        printf "%.6f,%.7f,%.6f,%.7f\n", k * dt, a, way * w * (1 + 0.01 * noise()), q >file; a += way * w * dt }' \
    'slow_a:1.2:0:0 slow_b:0.8:0:0.003'
printf 'file,role\nslow_a.csv,fit\nslow_b.csv,fit\n' >slow.csv

# Swinging: the speed goes up and down with the turn and ramps; the angle has an eccentric disc, the current an offset.
machine swung 2 0.2 inertia,1e-3,kgm2
runs 'print "time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm" >file; a = 0; dt = 1e-3
    for (k = 0; k < 700; k++) { v = w * (1 + 0.2 * sin(a)) + (w > 0 ? 8 : -5) * k * dt; e = 2 * a
        T = 0.3 * iq + 0.05 * sin(12 * a) - 0.002 * v
        printf "%.6f,%.9f,%.7f,%.7f,%.7f,%.7f\n", k * dt, a + 0.008 * sin(a + 0.3), phase(0, 0, iq, e) + 0.2, phase(1, 0, iq, e) - 0.1, phase(2, 0, iq, e), T + 0.003 * noise() >file
        a += v * dt }' \
    'swung_a:30:0:1.5 swung_b:-45:0:4 swung_c:60:0:3 swung_d:-20:0:2.5'
printf 'file,role\nswung_a.csv,fit\nswung_b.csv,fit\nswung_c.csv,holdout\n' >swung.csv
printf 'file,role\nswung_d.csv,fit\n' >later.csv
