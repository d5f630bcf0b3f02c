# mistakes.sh: in a folder with r0.csv, r1.csv, r2.csv of a servo (bounds.py makes them); hci-solve on the path
T="--pole-pairs 5 --slots 12 --torque-constant 0.412 --rated-current 6"
run(){ echo "### $NAME :: $*"; timeout 120 "$@" > m2.txt 2>&1; echo "rc=$?"; grep -v 'commands.sh\|^    hci-solve' m2.txt | grep -v 'samples\|up to 96\|phase currents up' | head -${L:-8}; rm -rf o m2.txt; }
F="f0.csv f1.csv f2.csv"
each(){ for k in 0 1 2; do awk -F, -v OFS=, "$1" r$k.csv > f$k.csv; done; }
NAME="1 phases b,c swapped in header"; each 'NR==1{print "time_s,theta_m_deg,ia_A,ic_A,ib_A,torque_Nm";next}1'; run hci-solve tune $F $T -o o
NAME="2 clamp b reversed"; each 'NR>1{$4=-$4}1'; run hci-solve tune $F $T -o o
NAME="3 clamp c x10"; each 'NR>1{$5*=10}1'; run hci-solve tune $F $T -o o
NAME="4 torque in lbf.in called Nm"; each 'NR>1{$6*=8.8507}1'; run hci-solve tune $F $T -o o
NAME="5 angle in gon called deg"; each 'NR>1{$2*=400/360}1'; run hci-solve tune $F $T -o o
NAME="6 mech angle called electrical"; each 'NR==1{sub("theta_m","theta_e")}1'; run hci-solve tune $F $T -o o
NAME="7 slots and poles swapped: --slots 10 --pole-pairs 6"; run hci-solve tune r0.csv r1.csv r2.csv --pole-pairs 6 --slots 10 --torque-constant 0.412 --rated-current 6 -o o
NAME="8 torque in mNm"; run hci-solve tune r0.csv r1.csv r2.csv $T --torque 2200 -o o
NAME="9 rated current in mA"; run hci-solve tune r0.csv r1.csv r2.csv --pole-pairs 5 --slots 12 --torque-constant 0.412 --rated-current 6000 -o o
NAME="10 decimal comma in comma file"; each 'NR>1{for(i=1;i<=NF;++i)gsub(/\./,",",$i)}1'; run hci-solve tune $F $T -o o
NAME="11 cat of three logs, headers inside, clock begins anew"; cat r0.csv r1.csv r2.csv > f0.csv; run hci-solve tune f0.csv $T -o o
NAME="12 sep=, of Excel in first line"; for k in 0 1 2; do (echo 'sep=,'; cat r$k.csv) > f$k.csv; done; run hci-solve tune $F $T -o o
NAME="13 gzip named csv"; gzip -c r0.csv > f0.csv; run hci-solve tune f0.csv $T -o o
NAME="14 Excel made dates of numbers"; for k in 0 1 2; do awk -F, -v OFS=, 'NR>1 && $6>0.01 && $6<0.13 {$6=int($6*100)".Jan"}1' r$k.csv >f$k.csv; done;  run hci-solve tune $F $T -o o
NAME="15 encoder index moved between logs by 40 deg"; cp r0.csv f0.csv; cp r1.csv f1.csv; awk -F, -v OFS=, 'NR>1{$2=($2+40)%360}1' r2.csv > f2.csv; run hci-solve tune $F $T -o o
NAME="16 en-dash option from a PDF"; run hci-solve tune r0.csv r1.csv –pole-pairs 5 --kv 20 -o o
NAME="17 log of another motor mixed in (gimbal)"; run hci-solve tune r0.csv r1.csv r2.csv ../a_hub/log2.txt --column theta_m=pos_deg $T -o o
NAME="18 resistance 1.2 mOhm meaning 1.2 Ohm, unit in value"; run hci-solve tune r0.csv r1.csv r2.csv $T --resistance 1.2mOhm -o o
NAME="19 torque in percent of rated"; each 'NR==1{sub("torque_Nm","torque_%")}NR>1{$6=$6/2.4*100}1'; run hci-solve tune $F $T -o o
NAME="20 torque sensor upside down and time in ms called s"; each 'NR>1{$6=-$6;$1*=1000}1'; run hci-solve tune $F $T -o o
NAME="21 load logs only, no idle"; run hci-solve tune r1.csv r2.csv $T -o o
NAME="22 nothing but options order: -o before and missing folder name"; run hci-solve tune r0.csv r1.csv r2.csv $T -o
NAME="23 Kt per phase rms given as Kv in V/krpm"; run hci-solve tune r0.csv r1.csv r2.csv --pole-pairs 5 --kv 30.5 -o o
NAME="24 rows sorted by angle in Excel"; for k in 0 1 2; do (head -1 r$k.csv; tail -n +2 r$k.csv | sort -t, -k2 -n) > f$k.csv; done; run hci-solve tune $F $T -o o
