#!/bin/sh
# Remedies that are printed work when they are typed as they stand, and what the user says by --column holds.
#   cli_remedies.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
use_plain_build
cd "$work" || exit 1

# log HEADER ANGLE SPEED CURRENT [ONE_WAY]: a slow turn of 7 pole pairs, two turns forward and back, in so many units of the
# columns to a turn, to a turn/s and to an ampere.
log() {
    echo "$1"
    awk -v angle="$2" -v speed="$3" -v current="$4" -v way="${5-}" 'BEGIN {
        pi = atan2(0, -1); n = way ? 2090 : 4190; v = 2 / 20.5; a = v / 0.5; seed = 1
        for (k = 5; k < n; ++k) {
            t = k * 0.01; d = t < 21 ? 1 : -1; x = t < 21 ? t : 42 - t
            w = x < 0.5 ? a * x : x > 20.5 ? a * (21 - x) : v
            s = x < 0.5 ? a * x * x / 2 : x > 20.5 ? 2 - a * (21 - x) ^ 2 / 2 : v * (x - 0.25)
            b = x < 0.5 ? a : x > 20.5 ? -a : 0
            turn = 0.1 + s; seed = (seed * 16807) % 2147483647; noise = seed / 2147483647 - 0.5
            i = 0.02 * d + 0.04 * sin(168 * pi * turn) + 0.005 * sin(24 * pi * turn) + 0.03 * b + 0.01 * noise
            format = "%.4f,%." (angle > 1000 ? 0 : 6) "f,%.6f,%.6f\n"
            printf format, t, angle * turn, speed * w * d, current * i
        }
    }'
}
# tuned CODE LOG WORD...: says what it found into `said`, in one line.
tuned() {
    code_of=$1 name=$2
    shift 2
    rm -rf o
    run "$code_of" tune "$name" --pole-pairs 7 --kv 90 --torque 0.05 -o o "$@"
    tr '\n' ' ' <"$work/stdout" | tr -s ' ' >said
    tr '\n' ' ' <"$work/stderr" | tr -s ' ' >>said
}
tells() { for words in "$@"; do check "not said: $words" grep -qE -e "$words" said; done; }
tells_not() { check "said: $1" eval "! grep -qE -e \"\$1\" said"; }
# typed LOG: the first remedy that was printed, with all its options, and what was said before, typed as they stand.
typed() {
    name=$1
    grep -oE -e "--column ('[^']*'|\"[^\"]*\")( --column '[^']*')?" said | head -n 1 >remedy
    check "no remedy is printed for $name" test -s remedy
    echo "\"\$hci_solve\" tune $name --pole-pairs 7 --kv 90 --torque 0.05 -o again $(cat remedy) ${2-}" >line.sh
    rm -rf again
    hci_solve=$hci_solve sh line.sh >again.txt 2>&1
    check "$name: the remedy $(cat remedy) does not work: $(head -n 1 again.txt)" eval "grep -q '^tuned: ' again.txt"
}

# ---- units

log time_s,theta_m_rad,speed_rad_per_s,iq_A 6.283185307 6.283185307 1 >rad.csv
tuned 0 rad.csv
log time_s,theta_m_rad,x,iq_A 360 0 1 | cut -d, -f1,2,4 >degrees.csv
tuned 1 degrees.csv; tells "angle is in degrees .5.73 rpm; --column 'theta_m_deg=theta_m_rad'."; typed degrees.csv
check 'the unit that is said is not remarked' grep -q 'is read in deg, as `theta_m_deg` says' again.txt
log time_s,theta_m_rad,speed_rad_per_s,iq_A 6.283185307 60 1 >rpm.csv
tuned 1 rpm.csv; tells "the speed is in rpm .*--column 'speed_rpm=speed_rad_per_s'"; typed rpm.csv
log time_s,theta_m_rad,speed_rad_per_s,iq_A 6.283185307 1 1 >turn_per_s.csv
tuned 1 turn_per_s.csv; tells "--column 'speed_turn_per_s=speed_rad_per_s'"; tells_not 'electrical, not mechanical'; typed turn_per_s.csv
log time_s,theta_m_rad,speed_rad_per_s,iq_A 6.283185307 360 1 >deg_per_s.csv
tuned 1 deg_per_s.csv; tells "--column 'speed_deg_per_s=speed_rad_per_s'"; tells_not 'a gear of'; typed deg_per_s.csv
log time_s,theta_m_rad,speed_rad_per_s,iq_A 6.283185307 6.283185307 1000 >milli.csv
tuned 0 milli.csv --column iq_mA=iq_A; tells 'phase currents up to 0.0[0-9]* A' '`iq_A` is read in mA, as `iq_mA` says'
log time_s,theta_m_rad,speed_rad_per_s,x 6.283185307 6.283185307 1 >minus.csv
tuned 1 minus.csv --column iq_A=-x/2; tells "with the opposite sign: --column 'iq_A=x/2'"; typed minus.csv
log t,angle,vel,current 1 1 1 >turns.csv
tuned 1 turns.csv --column theta_m=angle --column iq=current --column speed=vel
tells "it is 2 whole turns and .angle. is in turns and not in rad: --column 'theta_m_turn=angle' --column 'speed_turn_per_s=vel'"
typed turns.csv '--column iq=current'
printf 'name,column\niq_mA,iq_A\n' >columns.csv
tuned 0 milli.csv; tells '`iq_A` is read in mA, as `iq_mA` says'
rm columns.csv

# ---- columns

log time_s,encoder,x,iq_A 4096 0 1 | cut -d, -f1,2,4 >counts.csv
tuned 3 counts.csv; tells 'if `encoder` is an encoder, say --column "theta_m=encoder/COUNTS" .* such as 4096'
sed -i 's/COUNTS/4096/' said; typed counts.csv
tuned 3 counts.csv --column theta_m=encoder; tells 'encoder/4096'
tuned 1 counts.csv --column theta_m_deg=encoder; tells 'in counts of an encoder'; tells_not 'is in degrees'
tuned 3 turns.csv --column theta_m_turn=angel --column iq=current
tells 'found no column `angel` in turns.csv; did you mean `angle`\? It has `t`, `angle`, `vel`, `current`'
log time_s,theta_m_turn,speed_rpm,m0.current_control.Iq_meas 1 60 1 >name.csv
tuned 1 name.csv; tells "No current was read: if the column .m0.current_control.Iq_meas. is i_q, add --column 'iq_A=m0.current_control.Iq_meas'"; typed name.csv
log time_s,theta_e_turn,speed_rpm,iq_A 7 60 1 >poles.csv
rm -rf o; run 1 tune poles.csv --pole-pairs 14 --kv 90 --torque 0.05 -o o
tr '\n' ' ' <stdout | tr -s ' ' >said; tells '0.5 times as far: .*--pole-pairs 7: 7 pole pairs would fit, and not 14, which is the number of poles'
tuned 0 poles.csv
log time_s,theta_m_turn,speed_rpm,iq_A 1 60 1 one >one.csv
tuned 1 one.csv; tells 'The shaft turns in one direction alone'; tells_not 'role `fit`'
tuned 0 one.csv --holding

# ---- columns almost named

# wrong CODE NAME=COLUMN EXPRESSION
wrong() { run "$1" predict kept/machine turns.csv --column "$2"; says "$3"; }
tuned 0 rad.csv; cp -r o kept
wrong 2 theta_m_dge=angle 'did you mean `theta_m_deg`\?'
wrong 2 theta-m-turn=angle 'did you mean `theta_m_turn`\?'
wrong 2 speed_Hz=vel 'it has units as in `speed_rad_per_s`, `speed_rpm`, `speed_turn_per_s`'
wrong 2 angle=theta_m 'the column stands behind the sign: theta_m=angle'
wrong 3 theta_m=2 'expected a column by its name; column 2 is `angle`'
run 2 predict kept/machine turns.csv --column theta_m_turn=angle --column iq=angle; says 'found `angle`, which is `theta_m_turn` already'
run 3 predict kept/machine turns.csv --column theta_m_turn=angle --column theta_m_turn=vel; says 'found `vel` beside `angle` in turns.csv'
run 0 predict kept/machine turns.csv --column 'theta_m_turn = angle' --column 'iq_A= current'
log 'time [s],theta_m [turn],speed [rpm],iq [mA]' 1 60 1000 >headers.csv
run 2 predict kept/machine headers.csv --column 'foo=iq [mA]'; says 'the column `iq .mA.` is read by iq=iq .mA., and the column `foo` by iq=foo'
run 0 predict kept/machine headers.csv --column 'iq=iq [mA]' # as it is said, in the unit of the header
run 2 predict kept/machine headers.csv --column '-iq=iq [mA]'; says 'the opposite sign stands before the column: iq=-iq .mA.'
run 0 predict kept/machine headers.csv --column 'iq=-iq [mA]'
for other in iq_A=iq iq=-iq iq=iq/10; do # the last one would have won
    run 2 predict kept/machine turns.csv --column theta_m_turn=angle --column iq_mA=current --column "${other%%=*}=$(echo "${other#*=}" | sed s/iq/current/)"
    says 'found it beside `iq_mA=current`, expected one of the two; leave the other out'
done
run 2 predict kept/machine turns.csv --column theta_m_turn=angle --column angle_offset=3 --angle-offset 4; says 'beside `angle_offset=3`, expected one of the two'
run 0 predict kept/machine turns.csv --column theta_m_turn=angle --column iq=current --column iq=current # the same once more
printf 'theta_m_turn,angle\n' >columns.csv # without its header, which the row is not
run 3 predict kept/machine turns.csv; says 'columns.csv:1: found `theta_m_turn`, expected the header name,column; write it above the rows'
sed -i '1i name,column' columns.csv; echo iq,current >>columns.csv; run 0 predict kept/machine turns.csv
rm columns.csv
log time_ms,theta_m_turn,speed_rpm,iq_A 1 60 1 >seconds.csv
tuned 1 seconds.csv; tells "1000 is s in a column that is read in ms; say --column 'time_s=time_ms'"; typed seconds.csv
log time_s,theta_m_turn,speed_rpm,iq_A 1 420 1 >electrical.csv
tuned 1 electrical.csv; tells "the speed is electrical.*--column 'speed_e=speed_rpm'"; typed electrical.csv
run 2 tune rad.csv -p 7 -o p; says 'those that begin so are `--pole-pairs`, `--poles`'

# ---- values that contradict the log

rm -rf o; run 0 tune rad.csv --pole-pairs 7 --volt-per-krpm 90 --torque 0.02 -o o
tr '\n' ' ' <stdout | tr -s ' ' >said; tells 'By this Kv 0.02 N..m take 0.019 A, and the shaft without a load took up to 0.0[0-9]* A: is --volt-per-krpm the right number'

# ---- the same folder again

tuned 0 rad.csv
run 0 tune rad.csv --pole-pairs 7 --kv 90 --torque 0.06 -o o
check 'the results are not replaced' grep -q '^0,0.06' o/target.csv
check 'something is left beside them' eval '! ls -A | grep -q before'
run 3 tune rad.csv --pole-pairs 7 --kv 90 --torque 0.07 --column iq=nix -o o
check 'a call that failed took the results away' grep -q '^0,0.06' o/target.csv
mv o .o.before; mkdir -p o/machine; echo x >o/machine/machine.csv
run 0 tune rad.csv --pole-pairs 7 --kv 90 --torque 0.05 -o o
check 'what a killed call left is not mended' diff -r kept o
touch -d '+1 minute' o/machine/effects.csv
run 2 tune rad.csv --pole-pairs 7 --kv 90 -o o; says 'o/machine/effects.csv was changed since the results were written, and would be lost'
rm o/machine/effects.csv; echo mine >o/notes.txt
run 2 tune rad.csv --pole-pairs 7 --kv 90 -o o; says 'such as notes.txt'

# ---- words

run 2 tune rad.csv --pole-pairs 7 --kv 90 -o -p; says 'found `-p`, expected FOLDER; a path that begins with `-` is written ./-p'
run 2 tune rad.csv --pole-pairs 7 --kv 90 --out=-p26; says 'written ./-p26'
check 'half a run is left' eval '! ls | grep -q "^-p"'
run 2 tune - --pole-pairs 7 --kv 90 -o p; says 'found `-`, expected a file'
run 2 tune rad.csv --pole-pairs 7 --kv 90 -o p --angle-offset abc; says '^hci-solve: --angle-offset abc: found `abc`'
run 2 solve m --limit-peak 5; says 'those that begin so are `--limit-current`, .*`--limit-voltage`'
mkdir 'my motor'
run 2 solve my motor --target t.csv; says "one path with a blank in it; put it in quotes: 'my motor'"
printf 'file,role\nrad.csv,fit\nnix.csv,fit\n' >list.csv
cp -r kept/machine m
run 3 diagnose m --runs list.csv; says 'list.csv:3: column 1 `file`: found `nix.csv`, expected a recording that can be read; nix.csv: No such file'
sed -i 's/pole_pairs/polepairs/' m/machine.csv
run 3 solve m --target kept/target.csv; says 'm/machine.csv:[0-9]*: column 1 `name`: found `polepairs`, expected `pole_pairs`, which is missing'
printf 'order,amplitude_Nm,phase_rad\n0,2.46,0\n24/5,0.1,0\n' >t.csv
run 0 solve kept/machine --target t.csv --auto -o c; says 'a rotor angle cannot drive it'
run 0 emit c --name x --machine kept/machine -o c; says 'no part of the mechanical turn of 7; a rotor angle cannot drive it'

finish
