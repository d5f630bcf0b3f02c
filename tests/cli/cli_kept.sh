#!/bin/sh
# The results of commands on small inputs are those that are kept in tests/files/kept.txt, number by number: what no other test
# looks at must not change unnoticed. After a change that is meant: --renew, and look at the differences.
#   cli_kept.sh SOURCE_DIR BUILD_DIR HCI_SOLVE [--renew]
. "$1/tests/support/common.sh"
use_plain_build
cd "$source_dir" || exit 1
export OPENBLAS_NUM_THREADS=1
out=$work/kept
a=data/machine_a h=data/scenarios/02/harmonics.csv t=data/scenarios/02/target.csv
mkdir "$out"

# Machine A with what a voltage limit needs, and recordings of one with an offset of phase a and cogging that it does not know.
cp -r $a "$work/m" && cd "$work" || exit 1
printf 'resistance,0.1,ohm,test\ninductance_d,0.5,mH,test\ninductance_q,0.5,mH,test\n' >>m/machine.csv
awk 'BEGIN {
    seed = 1; pi = atan2(0, -1); count = split("slow:60:2 back:-150:7 fast:400:5 held:90:4", run, " ")
    for (r = 1; r <= count; r++) {
        split(run[r], x, ":")
        print "time_s,theta_m_rad,speed_rad_per_s,ia_A,ib_A,ic_A,torque_Nm" >x[1] ".csv"
        for (k = 0; k < 150; k++) {
            angle = (x[2] < 0 ? -2 : 2) * pi * k / 100
            torque = 0.03 * sin(12 * angle + 0.4)
            for (p = 0; p < 3; p++) {
                i[p] = x[3] * sin(2 * angle - 2 * pi * p / 3)
                torque += 0.2 * i[p] * sin(2 * angle - 2 * pi * p / 3)
            }
            for (n = 0; n < 12; n++) { seed = 16807 * seed % 2147483647; torque += 0.01 * (seed / 2147483647 - 0.5) }
            printf "%.9f,%.9f,%g,%.9f,%.9f,%.9f,%.9f\n", angle / x[2], angle, x[2], i[0] + 0.3, i[1], i[2], torque >x[1] ".csv"
        }
    }
}' || exit 1
mkdir simple && printf 'name,value,unit,source\npole_pairs,2,1,test\n' >simple/machine.csv
printf 'order,amplitude_Nm_per_A,phase_rad\n1,0.2,0\n' >simple/back_emf.csv
printf 'file,role\nslow.csv,fit\nback.csv,fit\nfast.csv,fit\nheld.csv,holdout\n' >runs.csv
printf 'motor,batch,date,machine,runs\n' >motors.csv
for k in 1 2 3 4 5 6; do
    printf 'file,role\n%s.csv,fit\nback.csv,fit\n' "$(echo slow held fast held slow fast | cut -d' ' -f$k)" >"runs$k.csv"
    echo "m$k,b$((k % 2)),2025-01-0$k,simple,runs$k.csv"
done >>motors.csv
ln -s "$source_dir/data" data || exit 1
sed 's/^duration,[^,]*/duration,0.3/; s/^settle,[^,]*/settle,0.1/' data/drive/filho_strategy_2.csv >filho.csv
head -n 7 $h >few.csv

# kept NAME CODE WORD...: the results of a command go where they are compared.
kept() {
    name=$1 code=$2
    shift 2
    run "$code" "$@" -q -o "kept/$name"
}
kept auto 0 solve $a --target $t --auto --report
kept limited 1 solve m --target $t --harmonics $h --limit-current 12 --limit-voltage 40 --speed 1500 --report
kept limited_auto 1 solve $a --target $t --auto --limit-current 17 --limit-rms 10
kept few 1 solve data/machine_b --target data/scenarios/12/target.csv --auto 9 --max-loss 1.5
kept interior 0 solve data/machine_c --target $t --auto
kept saturated 0 solve data/machine_c_saturated --target $t --auto
kept imposed 0 simulate $a data/drive/imposed.csv --report
kept driven 0 simulate $a data/drive/driven.csv
kept filho 0 simulate data/machine_c filho.csv
kept speeds 0 simulate $a --table kept/auto --drive data/drive/machine_a_10kHz.csv --speeds 100,1000
kept cogging 0 harmonics kept/driven/trajectory.csv --quantity cogging --pole-pairs 2
kept predicted.csv 0 predict $a kept/imposed/trajectory.csv
kept check 0 check data/fem_c/machine data/fem_c/runs/I0.csv data/fem_c/runs/id0_iq6.csv
kept fit 0 fit data/fem_c/machine --runs data/fem_c/runs.csv
kept diagnose 0 diagnose simple --runs runs.csv
kept trade 0 sweep $a --trade-off --torque 1 --currents 8 --harmonics few.csv --report
kept envelope 0 sweep $a --envelope --speeds 0 --ripple 40 --limit-current 20 --harmonics few.csv --report
kept map 0 sweep m --map --torques 1,2 --speeds 300,1500 --limit-current 12 --limit-voltage 40 --harmonics $h --report
kept servo 0 init servo --pole-pairs 4 --volt-per-krpm 98 --resistance 1.9 --resistance-of line --inductance-d 4e-3 --inductance-q 6e-3 --slots 12
kept rows 0 emit kept/auto --name rows --points 64
kept knots 0 emit kept/auto --name knots --frame dq --format i16 --per-torque --max-error 0.05
kept batch 0 batch motors.csv --command fit -j 1
kept fleet 0 fleet kept/batch

shown="tests/cli/kept.py"
check "results differ from tests/files/kept.txt; where that is meant: sh tests/cli/cli_kept.sh . $2 $3 --renew" python3 "$source_dir/tests/cli/kept.py" kept "$source_dir/tests/files/kept.txt" ${4-}
finish
