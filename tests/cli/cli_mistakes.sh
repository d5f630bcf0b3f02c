#!/bin/sh
# Mistakes that users make, each with the words that tell it: what was found, what was expected and a remedy that works.
#   cli_mistakes.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
. "$1/tests/cli/small_machine.sh"
cd "$work" || exit 1
m=m t=t.csv h=h.csv
fresh

# log HEADER [SED]: a recording of one turn of two pole pairs under that header, changed by a sed script.
rows=$(awk 'BEGIN { for (k = 0; k < 400; ++k) printf "%.4f,%.6f,%.4f,%.4f\n", k * 1e-3, k * 0.0314159, 0.5, 0.3 + 0.1 * sin(12 * k * 0.0314159) }')
log() { { echo "$1"; echo "$rows" | sed "${2-}"; } >r.csv; }
# told CODE COMMAND EXPRESSION... [-- OPTION...]: what is said on standard error.
told() {
    wanted=$1 command=$2
    shift 2
    expressions=
    while [ $# -gt 0 ] && [ "$1" != -- ]; do expressions="$expressions$1
"; shift; done
    [ $# -eq 0 ] || shift
    if [ "$command" = cogging ]; then
        run "$wanted" harmonics r.csv --quantity cogging --pole-pairs 2 "$@"
    else
        run "$wanted" solve m --target t.csv "$@"
    fi
    old_ifs=$IFS
    IFS='
'
    for expression in $expressions; do says "$expression"; done
    IFS=$old_ifs
    fresh
}
cogging() { code_of=$1; shift; told "$code_of" cogging "$@"; }
solved() { code_of=$1; shift; told "$code_of" solve "$@"; }
names=time_s,theta_m_rad,iq_A,torque_Nm

# ---- recordings as they are saved

log $names 's/^0\./12:00:00./'; cogging 0 'the speed is the slope of the angle'
log $names 's/^0\./2024-03-01T12:00:00./'; cogging 0 'the speed is the slope of the angle'
log $names 's/,/ /g'; sed -i '1s/,/ /g' r.csv; cogging 0 'the speed is the slope'
log $names 's/,/	/g; s/\./,/g'; sed -i '1s/,/	/g' r.csv; cogging 0 'the speed is the slope'
log $names 's/,/;/g; s/;[^;]*$/;1.234/; s/0\.\([0-9]*;\)/0,\1/'; sed -i '1s/,/;/g' r.csv
cogging 3 'r.csv:2: column 4 `torque_Nm`: found `1.234`, expected one decimal mark in all of the file' 'no marks between thousands'
log $names 's/,[^,]*$/,"1,234"/'; cogging 3 'column 4 `torque_Nm`: found `1,234`' 'may be a number or a thousand times it'
log $names 's/,\([^,]*\)$/,\1 Nm/'; cogging 0 'the speed is the slope of the angle'
log $names 's/,[^,]*$/,0.1 A/'; cogging 3 'found `0.1 A`' 'write the unit into the column.s name' '399 more cells of the column are none: lines 3, 4, 5, ...'
log $names '9s/,[^,]*$/,NaN/; 5s/,[^,]*$/,/'; cogging 0 '2 of 400 rows have a hole and are left out, first line 6, column 4 `torque_Nm`: found an empty cell'
log $names '9s/,[^,]*$/,NaN/'; cogging 3 'r.csv:10: column 4 `torque_Nm`: found `NaN`' -- --strict
log $names '1,300s/,[^,]*$/,#DIV\/0!/'; cogging 3 'found `#DIV/0!`' 'a spreadsheet writes this for an error' '299 more cells'
log $names; sed -i 1d r.csv; cogging 3 'r.csv:1: .*expected a column name; put a row of column names first'
printf 'PK\003\004zz' >r.csv; cogging 3 'found a workbook .*save the table in it as CSV'
log $names '1,400s/\.\([0-9]*\),/,\1,/g'; cogging 3 'if the comma is the decimal mark'

# ---- columns

log time_s,enc_count,iq_A,torque_Nm; cogging 3 'if `enc_count` is an encoder, say --column "theta_m=enc_count/COUNTS"'
log time_s,enc_count,iq_A,torque_Nm; cogging 3 'looks like the counts of an encoder' 'enc_count/4096' -- --column theta_m_rad=enc_count
log time_s,enc_count,iq_A,torque_Nm; cogging 0 'the speed is the slope' -- --column theta_m=enc_count/6.283185307
log time,angle,iq,torque; cogging 3 '`angle`: found an angle that may be mechanical or electrical.*say --column "theta_m=angle" .theta_m_deg in degrees'
log time,angle,iq,torque; cogging 0 'the speed is the slope' -- --column theta_m_rad=angle
log t,theta,iq,T; cogging 3 'column 2 `theta`: found an angle that may be mechanical or electrical'
log $names; cogging 3 'found no column `Current` in r.csv; it has' -- --column iq=Current
log $names; cogging 2 'found `torqe`, expected a quantity of a recording' -- --column torqe=iq_A
log time_s,theta_m_rad,iq_A,spare; cogging 3 'found no torque' 'say --holding --torque-constant'
log time_s,theta_m_rad,iq_A,spare; cogging 0 'read as a holding test' -- --holding --torque-constant 1
{ echo theta_m,iq_A,torque_Nm; awk 'BEGIN { for (k = 0; k < 360; ++k) print k ",0.5," k % 7 }'; } >r.csv
run 0 predict m r.csv -o out.csv; says '`theta_m` has no unit and is read in rad, but looks like degrees: name it theta_m_deg'
{ echo 'Time(s),Torque(Nm)'; awk 'BEGIN { for (k = 0; k < 90; ++k) print k ",1" }'; } >r.csv
cogging 3 'found no angle of the rotor' 'a column `speed_rpm` beside the time will do, too'

# ---- the wrong file or folder

run 3 harmonics m --quantity cogging --pole-pairs 2; says 'm: found a folder, expected a CSV file'
run 3 harmonics none.csv --quantity cogging --pole-pairs 2; says 'none.csv: cannot be read: No such file'
run 3 emit m --name x -o out; says 'm: found the folder of a machine, expected one that solve wrote' 'hci-solve solve m --target TARGET -o OUT'
mkdir empty
run 3 emit empty --name x -o out; says 'empty: found a folder without currents.csv'
run 3 solve empty --target t.csv; says 'empty/machine.csv: No such file; expected the folder of a machine' 'hci-solve init'
run 3 check empty; says 'empty/machine.csv: No such file; expected the folder of a machine' 'hci-solve init'
run 3 solve m/machine.csv --target t.csv; says 'found a file, expected the folder of a machine'
log $names; run 3 diagnose m --runs r.csv; says 'r.csv: found a recording with time_s, expected a list of recordings' 'file,role'
printf 'r.csv,fit\n' >runs.csv; run 3 diagnose m --runs runs.csv; says 'runs.csv:1: found no column `file`' 'write that header as the first line'
printf 'file,role\nr.csv,train\n' >runs.csv; run 3 diagnose m --runs runs.csv; says 'found `train`, expected `fit` or `holdout`'

# ---- machines

two='pole_pairs,2,1,x emf_frequency,50,Hz,x'
machine $two phases,6,1,x; solved 3 'machine.csv:4: .*found `6`, expected 3: machines with another number of phases are not supported'
machine $two phases,3,1,x type,PMSM,,x; run 0 solve m --target t.csv -q; fresh
machine $two type,induction,,x; solved 3 'machine.csv:4: .*found `induction`, expected a permanent-magnet synchronous machine'
machine poles,4,1,x emf_frequency,50,Hz,x; solved 3 'no `pole_pairs`; add a row `pole_pairs,N,1,source`, with half of `poles`'
machine $two resistence,1,ohm,x; solved 0 '`resistence` in line 4 \(did you mean `resistance`\?\)'
machine pole_pairs,2,1,x emf_frequency,3000,rpm,x; solved 3 'electrical Hz are mechanical rpm / 60 x pole pairs'
printf '%s\n6,0.1,-45\n12,0.3,90\n' $header >m/cogging.csv; solved 0 'm/cogging.csv: a phase of 90 rad, which looks like degrees: .*phase_deg'
printf '%s\n0,2,0\n6,0.1,90\n' $header >t.csv; solved 0 't.csv: a phase of 90 rad, which looks like degrees'
printf '%s\n6,0,0\n' $header >m/cogging.csv; solved 0 'every amplitude is 0, so that no cogging torque is counteracted: if it was not measured'
printf 'effect,parameter,value,unit\nfricton,coulomb,12,mNm\n' >m/effects.csv; solved 3 'did you mean `friction`\?'; rm -f m/effects.csv

# ---- orders

printf '%s\n12/2,0.3,0\n' $header >m/cogging.csv; run 0 solve m --target t.csv -q; fresh
printf '%s\n0,2,0\n12/0,0.1,0\n' $header >t.csv; solved 3 't.csv:3: .*found `12/0`'
printf 'mechanical_%s\n24,0.3,0\n' $header >m/cogging.csv; run 0 solve m --target t.csv -q; fresh
solved 3 'back_emf.csv:2: .*expected an order that the pole pairs divide; .*name this column electrical_order' -- --order-base mechanical
fresh

# ---- options and names

solved 2 'did you mean `--target`\?' -- --targt t.csv
solved 2 'found `ummfpack`, expected one of: .*; did you mean `umfpack`\?' -- --method ummfpack
solved 2 '.*give the number without its unit' -- --limit-voltage 48V --speed 1000
for kv in 28,5 28.5rpm/V 28,5rpm/V; do run 2 init kv --pole-pairs 7 --kv $kv -o kv; says '; write --kv 28\.5$'; done
for case in inertia=2gcm2=2e-07 inertia=2e-7kgm2=2e-7 resistance=900mohm=0.9 torque-constant=50mNm/A=0.05 inductance=1,2mH=0.0012 rated-current=8Arms=11.3137; do
    given=${case#*=}; run 2 init units --pole-pairs 7 --kv 100 --${case%%=*} ${given%%=*} -o units; says "; write --${case%%=*} ${given##*=}\$"
done
run 2 init units --pole-pairs 7 --kv 100 --inertia 2furlong; check 'a number of a unit that is not known is proposed' [ "$(grep -c 'write --inertia' stderr)" = 0 ]
run 2 init kv --pole-pairs 7 --kv -28 -o kv; check 'a number that is none is proposed' [ "$(grep -c 'write --kv' stderr)" = 0 ]
run 2 init kv --pole-pairs 7 --KV 28; says 'unknown option `--KV`; did you mean `--kv`\?'
run 0 init henry --pole-pairs 7 --kv 100 --inductance 0.5; says 'a short circuit of this motor would carry 0\.016 A at any speed: is it 0\.5 mH, which are 0\.0005 H\?'
run 0 init milli --pole-pairs 7 --kv 100 --inductance 0.0005; check 'half a millihenry is doubted' [ ! -s stderr ]
run 0 init krpm --pole-pairs 11 --kv 28000 --resistance 8 --rated-current 1.5; says 'would turn this motor at 5\.8e\+05 rpm: are Kv, resistance and current'
run 2 batch tune motors.csv -o batch; says 'found the word `tune` before the list, expected --command tune: hci-solve batch motors.csv --command tune'
run 2 batch tune motors.csv --command tune -o batch; says 'hci-solve batch motors.csv --command tune'
run 3 diagnose --again m --runs runs.csv -o diagnosed; says 'found no such file, expected the --out of a diagnosis'
check 'the machine is to be written over' [ "$(grep -c -- '--out m ' stderr)" = 0 ]
mkdir -p tuned/diagnose/declared; cp m/machine.csv tuned/diagnose/declared
run 3 diagnose --again tuned --runs runs.csv -o diagnosed; says 'found the --out of `tune`, .*; write --again tuned/diagnose$'
rm -r tuned
for kind in tune=currents diagnose=solution; do
    mkdir -p held/machine held/${kind#*=}; cp m/machine.csv held/machine; echo order,set,amplitude_A,phase_rad >held/${kind#*=}/currents.csv
    run 3 emit held --name x -o emitted; says "held: found the results of ${kind%=*}, .*; it stands in there: give held/${kind#*=}\$"; rm -r held
done
mkdir -p held/machine; cp m/machine.csv held/machine
run 3 emit held --name x -o emitted; says 'held: found the results of diagnose, .*hci-solve solve held/machine '; rm -r held
printf 'time_s,theta_m_rad,iq_A\n0,0,1\n' >log.csv
run 3 simulate m log.csv -o s; says 'log.csv: found a table whose first column is `time_s`, expected a scenario: .*a recording to `predict`, '
run 2 sovle m; says 'did you mean `solve`\?'
run 2 harmonics r.csv --quantity back-emf --pole-pairs 2; says 'did you mean `back_emf`\?'
printf 'name,value,unit\nduration,40,ms\nprescribed_sped,1500,rpm\n' >s.csv
run 3 simulate m s.csv; says 's.csv:3: .*`prescribed_sped`.*did you mean `prescribed_speed`\?'
printf 'name,value,unit\nduration,40,ms\nfrobnicate,1,\n' >s.csv
run 3 simulate m s.csv; says 'found `frobnicate`, expected a name that is known here; docs/simulate.md lists all'

# ---- a number for a file, an option before the command, a name with blanks that is not quoted

run 3 solve m --target 2.46 --auto; says 'target: found the number 2.46, expected a file of orders; for a constant torque one with the two lines order,amplitude_Nm,phase_rad and 0,2.46,0'
run 2 --pole-pairs 2 tune r.csv; says 'found the option `--pole-pairs` in place of a command, expected one first, such as hci-solve tune LOG --pole-pairs'
run 2 tune r.csv --pole-pairs 2 --kv 39 --column torque -o unquoted; says "quote a name with blanks: --column 'torque_Nm=Torque"

# ---- a machine among logs, and why a motor failed

log $names
run 2 tune m r.csv -o with_machine; says 'found the folder m among the logs, expected files; .*tune m --runs LIST'
printf 'motor,logs\nm1,r.csv\n' >motors.csv
"$hci_solve" batch motors.csv --command tune -o batch_said >stdout 2>stderr
check 'why a motor failed is in fleet.csv alone' grep -q '^  m1  *init: no pole pairs; add --pole-pairs P' stdout

finish
