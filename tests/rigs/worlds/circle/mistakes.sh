#!/bin/bash
# usage: mistakes.sh [binary] ; needs lists/x_sat0 and lists/a01
H=${1:-hci-solve}
W=${TMPDIR:-.}/mistakes; rm -rf $W; mkdir -p $W; cd $W
cp ../lists/b01b/load*.csv . ; cp ../lists/a01/slow.csv slow.csv
A="--pole-pairs 5 --torque-constant 0.368 --slots 12 --rated-current 3.7 --torque 0.7"
B="--pole-pairs 7 --kv 270 --slots 12 --rated-current 12 --torque 0.15"
n=0; t(){ n=$((n+1)); echo "=== m$n: $1"; shift; echo "\$ hci-solve $*"; timeout 200 $H "$@" -o o$n 2>&1 | head -${LN:-7} | cut -c1-700; echo "rc ${PIPESTATUS[0]}"; }
t "option misspelt" tune load0.csv load33.csv --polepairs 5 --kv 22
t "value forgotten" tune slow.csv --pole-pairs --kv 270
t "folder instead of file" tune . $A
t "file does not exist" tune load1.csv $A
t "pole pairs forgotten" tune slow.csv --kv 270
t "Kv forgotten" tune slow.csv --pole-pairs 7
t "Kt in mNm/A" tune load0.csv load33.csv load66.csv load100.csv --pole-pairs 5 --torque-constant 368 --torque 0.7
t "Kt in oz-in (52.1)" tune load0.csv load33.csv load66.csv load100.csv --pole-pairs 5 --torque-constant 52.1 --torque 0.7
t "wrong pole pairs 10 (poles)" tune load0.csv load33.csv load66.csv load100.csv --pole-pairs 10 --torque-constant 0.368 --torque 0.7
t "wrong pole pairs 4" tune load0.csv load33.csv load66.csv load100.csv --pole-pairs 4 --torque-constant 0.368 --torque 0.7
awk -F, 'NR==1{print;next}{print $1","$2","$3","$5","$4","$6","$7}' OFS=, load66.csv >swap66.csv; awk -F, 'NR==1{print;next}{print $1","$2","$3","$5","$4","$6","$7}' load100.csv >swap100.csv;awk -F, 'NR==1{print;next}{print $1","$2","$3","$5","$4","$6","$7}' load33.csv >swap33.csv
t "phases a and b swapped" tune load0.csv swap33.csv swap66.csv swap100.csv $A
tail -n +2 load66.csv >nohead.csv
t "header missing" tune load0.csv load33.csv nohead.csv load100.csv $A
head -c 300000 load100.csv >half100.csv
t "half a log, cut in a line" tune load0.csv load33.csv load66.csv half100.csv $A
cut -d, -f1,3-7 load66.csv >noang.csv
t "angle column forgotten in all" tune noang.csv $A
cut -d, -f1-3,7 load66.csv >nocur.csv;cut -d, -f1-3,7 load33.csv >nocur33.csv
t "currents forgotten in loaded logs" tune load0.csv nocur33.csv nocur.csv $A
for f in 0 33 66 100; do sed '1s/theta_m_deg/theta_m_rad/' load$f.csv >rad$f.csv; done
t "degrees named rad" tune rad0.csv rad33.csv rad66.csv rad100.csv $A
for f in 0 33 66 100; do sed '1s/torque_Nm/torque_mNm/' load$f.csv >mnm$f.csv; done
t "Nm named mNm" tune mnm0.csv mnm33.csv mnm66.csv mnm100.csv $A
for f in 0 33 66 100; do awk -F, -v OFS=, 'NR==1{print;next}{$4*=1000;$5*=1000;$6*=1000;print}' load$f.csv >ma$f.csv; done
t "mA named A" tune ma0.csv ma33.csv ma66.csv ma100.csv $A
t "same log twice" tune load66.csv load66.csv $A
cp load66.csv load0x.csv
t "wrong file: summary.json" tune ../lists/b01b/t/summary.json $A
t "wrong file: table .c" tune ../lists/b01b/t/table/tuned.c $A
t "torque asked in mNm (700)" tune load0.csv load33.csv load66.csv load100.csv --pole-pairs 5 --torque-constant 0.368 --rated-current 3.7 --torque 700
t "rated current rms as peak tiny" tune load0.csv load33.csv load66.csv load100.csv --pole-pairs 5 --torque-constant 0.368 --rated-current 0.5 --torque 0.7
t "logs of two motors mixed" tune load0.csv load66.csv slow.csv $A
t "machine given as log" tune ../lists/b01b/t/machine $A
t "check --table with wrong log" check ../lists/b01b/t/machine load66.csv --table ../lists/b01b/t/currents
t "slow log, Kv with unit" tune slow.csv --pole-pairs 7 --kv 270rpm/V
t "decimal comma" tune load0.csv load33.csv load66.csv load100.csv --pole-pairs 5 --torque-constant 0,368
echo "=== out folder holds own files"; mkdir -p mine; echo x>mine/notes.txt; $H tune load0.csv $A -o mine 2>&1 | head -5; echo rc $?
