#!/bin/sh
# What `diagnose` finds of benches that have several faults at a time, or hardly enough recordings, is that in tests/files/kept/faults.txt, number by
# number, and in the same words. After a change that is meant: --renew, and look at the differences.
#   cli_kept_faults.sh SOURCE_DIR BUILD_DIR HCI_SOLVE [--renew]
. "$1/tests/support/common.sh"
use_plain_build
. "$source_dir/tests/cli/kept_inputs.sh"
cd "$work" || exit 1

# p = 3, 0.2 N·m/A; 18 slots.
mkdir bench && printf 'order,amplitude_Nm_per_A,phase_rad\n1,0.2,0\n5,0.004,0.3\n' >bench/back_emf.csv
printf 'name,value,unit,source\npole_pairs,3,1,test\nresistance,0.5,ohm,test\ninductance_d,2,mH,test\ninductance_q,3,mH,test\nrated_current,8,A,test\nslots,18,1,test\ninertia,6e-4,kgm2,test\n' >bench/machine.csv

# runs NAME COUNT STEP PROGRAM WORD...: NAME_k.csv of each word SPEED:ID:IQ[:h, held out], COUNT samples, STEP of a turn apart. PROGRAM changes what the shaft does and what
# is read: a (angle, read as m), v (speed), id and iq (read as phase currents x[0..2]), T (torque), t (time), r (number of the run); noise() has about the deviation 1.
runs() {
    name=$1 count=$2 step=$3 program=$4 header=${header:-time_s,theta_m_rad,speed_rad_per_s,ia_A,ib_A,ic_A,torque_Nm}
    shift 4
    awk -v name="$name" -v count="$count" -v step="$step" -v list="$*" -v header="$header" 'function noise(   n, sum) { for (n = 0; n < 12; n++) { seed = 16807 * seed % 2147483647; sum += seed / 2147483647 - 0.5 } return sum }
        function sign(x) { return x < 0 ? -1 : x > 0 }
        BEGIN { seed = 5; pi = atan2(0, -1); runs = split(list, word, " "); print "file,role" >(name ".csv")
            for (r = 1; r <= runs; r++) { split(word[r] ":", y, ":"); w = y[1]; id = y[2]; iq = y[3]; file = name "_" r ".csv"
                print file (y[4] == "h" ? ",holdout" : ",fit") >(name ".csv"); print header >file; t = 0; a = 0.2 * r
                for (k = 0; k < count; k++) { v = w; more = ""; dt = step * 2 * pi / (w < 0 ? -w : w); m = a; e = 3 * a
                    T = 0.3 * iq - 0.006 * (iq * cos(6 * e + 0.3) + id * sin(6 * e + 0.3)) + 0.002 * noise()
                    for (p = 0; p < 3; p++) x[p] = -id * cos(e - 2 * pi * p / 3) + iq * sin(e - 2 * pi * p / 3)
                    '"$program"'
                    printf "%.9f,%.9f,%.7f,%.7f,%.7f,%.7f,%.7f%s\n", t, m, v, x[0], x[1], x[2], T, more >file
                    t += dt; a += v * dt } close(file) } }'
    header=
}
# found NAME OPTION...
found() {
    name=$1
    shift
    "$hci_solve" diagnose bench --runs "$name.csv" "$@" --color never -o "kept/$name" >stdout 2>stderr </dev/null || [ $? -eq 1 ]
    check "$name is diagnosed: $(cat stderr)" [ -s "kept/$name/summary.json" ]
    cat stdout stderr | no_numbers >"kept/$name.said.txt"
    page_words "kept/$name/report.html" >"kept/$name.page.txt"
}
four='60:0:2 -60:0:6 120:-2:4 -200:1:7:h'
pull='0.03 * sin(18 * a + 0.5) + 0.01 * cos(36 * a) - 0.02 * sign(v) - 2e-4 * v'

# Cogging, friction and: a phase that reads too much and one that is off; unequal phases; a sensor that lags; an angle that is late and eccentric.
runs phases 150 0.01 "T += $pull; x[1] *= 1.04; x[0] += 0.15" $four
found phases --target $t
runs unequal 150 0.01 "T += $pull + x[2] * 0.012 * sin(e - 4 * pi / 3) + 0.006 * iq * sin(6 * e + 1) + 0.004 * sin(a)" $four
found unequal
runs sensor 160 0.0125 "s = 6 * w * 1e-3; g = 1 / sqrt(1 + s * s); T = 1.03 * 0.3 * iq + 0.04 * iq * g * sin(6 * e + 0.3 - atan2(s, 1)) + 0.03 - 0.02 * sign(v) + 0.002 * noise()" $four 400:0:5
found sensor
runs late 150 0.01 "T += $pull; m = a - 2e-4 * v + 0.006 * sin(a + 0.4)" $four
found late

# Without a current, held, and at one: what each leaves open. Two runs at one current; one run.
runs idle 150 0.01 "T += $pull + 0.004 * sin(a)" 60:0:0 -60:0:0 150:0:0
found idle
runs two 150 0.01 "T = 1.05 * T + $pull + 0.04" 60:0:4 60:0:4
found two
runs one 200 0.01 "T += $pull" 90:-1:5
found one --resolution 0.2

# Along the time: a zero that drifts over turns; a magnet that warms; a current that ripples; a speed that swings and a load.
runs drift 500 0.009 "T += $pull + (r == 2 ? 0.02 : -0.03) * (k / 250 - 1) + 0.01 * (k / 250 - 1) ^ 2" $four
found drift
header=time_s,theta_m_rad,speed_rad_per_s,ia_A,ib_A,ic_A,torque_Nm,temperature_C
runs warm 150 0.01 "c = 20 + 15 * r + 0.05 * k; T = T * (1 - 0.0011 * (c - 20)) + $pull; more = sprintf(\",%.3f\", c)" $four
found warm
runs ripple 160 0.0125 "q = iq + 0.4 * sin(6 * e + 0.2); T += 0.3 * (q - iq) + $pull; for (p = 0; p < 3; p++) x[p] += (q - iq) * sin(e - 2 * pi * p / 3)" $four
found ripple
runs a_shaft_whose_speed_goes_up_and_down 300 0.01 "v = w * (1 + 0.15 * sin(2 * a + r) + 0.1 * k / 300); T += $pull + 6e-4 * v * v * 0.3 * cos(2 * a + r)" $four
found a_shaft_whose_speed_goes_up_and_down

# Many turns of few samples each, whose mean is taken; an index that was lost; stamps that come early and late; runs that are no more of one machine.
runs turns 700 0.0173 "T += $pull + 0.01 * sin(a / 7)" 60:0:2 -90:0:6
found turns
runs index 160 0.0125 "T = r < 4 ? 0 : T; for (n = 1; n < 8; n++) T += 0.01 * sin((3 * n + 1) * a + n); m = a + (r == 2 ? 0.9 : 0); T += 0.001 * noise()" 60:0:0 60:0:0 -60:0:0 60:0:4
found index
runs jitter 200 0.01 "T += $pull; t += 0.3 * dt * noise() * (k > 0) * (r > 2)" $four
found jitter
runs apart 150 0.01 "T += $pull; if (r == 3) T += 0.1 * sin(5 * a) + 0.05" $four 70:0:3
found apart
kept_all faults "${4-}"
finish
