#!/bin/sh
# Currents within limits of each kind, sweeps, the folders of data sheets, FMUs and fleets of several folders are those in tests/files/kept/limits.txt, number by
# number, with their pictures. After a change that is meant: --renew, and look at the differences.
#   cli_kept_limits.sh SOURCE_DIR BUILD_DIR HCI_SOLVE [--renew]
. "$1/tests/support/common.sh"
use_plain_build
. "$source_dir/tests/cli/kept_inputs.sh"
# at NAME WORD...: as kept, whether all is reached or not.
at() {
    name=$1
    shift
    "$hci_solve" "$@" -q --json -o "kept/$name" >stdout 2>stderr </dev/null || [ $? -eq 1 ]
    check "$name: $(cat stderr)" [ -e "kept/$name" ]
    cp stdout "kept/$name.said.json"
}
cp -r data/machine_b n && sed -i.bak 's/^connection.*/connection,star-neutral,,test/' n/machine.csv && rm n/machine.csv.bak
printf 'max_current,9,A,test\n' >>n/machine.csv
few='--harmonics few.csv'

# Currents: a peak, of one phase, an open phase; rms and copper; a neutral; nothing to reach.
at peak solve m --target $t $few --limit-current 11.5,b=10.5 --report
at open solve m --target $t --harmonics $h --limit-current 14,a=0
at rms solve m --target $t $few --limit-rms 8,c=7.5
at copper solve m --target $t $few --limit-copper 1.1x
at watts solve m --target $t $few --limit-copper 19 --minimise rms
at worst solve m --target $t $few --limit-current 11.5 --minimise worst
at peak_to_peak solve m --target $t $few --limit-current 11.5 --minimise peak-to-peak
at neutral solve n --target data/scenarios/12/target.csv --auto 7 --ignore-ratings
at neutral_limited solve n --target data/scenarios/12/target.csv --auto 7 --report
at small solve m --target $t $few --limit-current 3
# Voltages: of a dc link, with a reserve and dead time, at a speed that leaves little of it.
at link solve m --target $t $few --limit-voltage 40 --speed 1300 --report
at reserve solve m --target $t $few --limit-voltage 40 --speed 1100 --voltage-reserve 0.08 --dead-time 1e-6 --pwm-frequency 12000
at both solve m --target $t $few --limit-voltage 38 --speed 1200 --limit-current 12
at loop solve m --target $t $few --bandwidth 300 --speed 200
# Strategies, angles and what is compared.
at mtpa solve data/machine_c_saturated --target $t --method pointwise --strategy mtpa
at id0 solve data/machine_c --target $t --method pointwise --strategy id0
at angle solve data/machine_c --target $t --method pointwise --current-angle 25
at square solve $a --target $t $few --compare square --fundamental 12,0.2
# Sweeps.
at coppers sweep m --trade-off --torque 2 --coppers 1.05,1.2 $few --report
at speeds sweep m --envelope --speeds 0,900,1500 --ripple 30 --limit-current 12 --limit-voltage 40 $few --report
at links sweep m --map --torques 1,2 --speeds 600,1400 --dc-links 36,48 --limit-current 12 $few --report
# Data sheets in each form of their values.
at kv init kv --poles 14 --kv 270 --slots 12 --resistance 0.06 --inductance 2e-5 --rated-current 20 --dc-link 24
at kt init kt --pole-pairs 4 --torque-constant 0.9 --torque-of rms --rated-current 7 --current-of rms --rated-torque 6.3 --rated-speed 3000 --inertia 4e-4
at flux init flux --pole-pairs 3 --flux 0.011 --inductance-d 3e-3 --inductance-q 5e-3 --slots 36
# Models.
at inputs.fmu export-fmu data/machine_c --inputs currents --sources-only --fmi 3
at driven.fmu export-fmu $a --drive data/drive/machine_a_10kHz.csv --sources-only
# Two folders of one make, of which a motor stands out; in one of its batches torques are larger, and rise from day to day.
echo motor,batch,date,machine,runs >more.csv
for k in 01 02 03 04 05 06 07 08 09 10 11 12 13 14; do
    list=runs$(((${k#0} - 1) % 6 + 1)).csv batch=$(echo C D D | cut -d' ' -f$((${k#0} % 3 + 1)))
    log=$(sed -n '2s/,.*//p' "$list")
    awk -F, -v OFS=, -v k="$k" -v batch="$batch" 'NR > 1 { $7 *= (batch == "D" ? 1.02 : 1) * (1 + 0.0005 * k) } 1' "$log" >"n$k.csv"
    printf 'file,role\nn%s.csv,fit\nback.csv,fit\n' "$k" >"list$k.csv"
    [ "$k" != 06 ] || cp worn.csv list06.csv
    echo "n$k,$batch,$k.03.2025,simple,list$k.csv"
done >>more.csv
run 0 batch motors.csv --command fit -j 1 -q -o first
run 0 batch more.csv --command fit -j 1 -q -o second
at line fleet first second
at alarms fleet second --false-alarms 10
kept_all limits "${4-}"
finish
