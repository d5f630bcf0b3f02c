#!/bin/sh
# motor 4 with the inductances that the sheet has: tune MACHINE --runs LIST
for n in 4_base 4_less 4_two 4_sens2 4_brake; do
 rm -rf out/${n}_L mach_L; mkdir -p lists/${n}_L
 hci-solve init m4 --pole-pairs 2 --flux 0.1522 --slots 36 --resistance 0.5 --rated-current 20 --inductance-d 0.010 --inductance-q 0.050 -q -o mach_L
 (echo file,role; for f in $(tr ' ' '\n' <lists/$n/cmd | grep csv$); do echo $f,fit; done) >lists/${n}_L/runs.csv
 hci-solve tune mach_L --runs lists/${n}_L/runs.csv -o out/${n}_L >lists/${n}_L/said.txt 2>&1; echo $n rc $?; head -8 lists/${n}_L/said.txt | cut -c1-500
done
