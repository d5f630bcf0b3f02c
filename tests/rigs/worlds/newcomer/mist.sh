O="--pole-pairs 3 --volt-per-krpm 77 --slots 9 --rated-current 4 --current-of rms --rated-torque 4.5 --resistance 3.8 --resistance-of line"
W="--column"; A='theta_m_deg=Winkel [°]'
i=0; r(){ i=$((i+1)); echo "### $i: $1"; shift; echo "\$ $*"; timeout 60 nice -n 5 "$@" >M/$i.out 2>&1; echo "rc=$?"; head -c 1400 M/$i.out | head -${N:-4}; echo; }
L="C/leer_re.csv C/l2.csv C/l6.csv"
r "no motor data" hci-solve tune $L -o M/o1
r "German motor table: --ke" hci-solve tune $L --pole-pairs 3 --ke 77 -o M/o2
r "no -o" hci-solve tune $L $O $W "$A"
r "folder instead of log" hci-solve tune C $O -o M/o4
r "xlsx" sh -c "cp C/l2.csv M/l2.xlsx; printf 'PK\003\004abc' >M/l2.xlsx; hci-solve tune M/l2.xlsx $O -o M/o5"
r "mat" sh -c "printf 'MATLAB 5.0 MAT-file, Platform: PCWIN64' >M/l.mat; hci-solve tune M/l.mat $O -o M/o6"
r "glob that matches nothing" hci-solve tune 'C/last*.csv' $O -o M/o7
r "same log twice" hci-solve tune C/l2.csv C/l2.csv C/leer_re.csv $O $W "$A" -o M/o8
r "torque in mNm unit missing (column scaled 1000 named Nm)" sh -c "awk -F';' -v OFS=';' 'NR>6{gsub(\",\",\".\",\$3);\$3=sprintf(\"%.1f\",\$3*1000);gsub(/\\./,\",\",\$3)}1' C/l4.csv >M/mnm.csv; hci-solve tune M/mnm.csv C/leer_re.csv $O $W '$A' -o M/o9"
r "rated current 4000 (mA)" hci-solve tune $L --pole-pairs 3 --volt-per-krpm 77 --rated-current 4000 $W "$A" -o M/o10
r "--torque 60 (far too much)" hci-solve tune $L $O $W "$A" --torque 60 -o M/o11
r "torque in Ncm: --torque 450" hci-solve tune $L $O $W "$A" --torque 0,5 -o M/o12
r "angle in rad named deg" sh -c "sed 's/Winkel \\[°\\]/Winkel [rad]/' C/l4.csv | sed 's/Winkel \\[.\\]/Winkel [rad]/' >M/rad.csv; hci-solve tune M/rad.csv $O --column 'theta_m_rad=Winkel [rad]' -o M/o13"
r "truncated last row + blank in middle" sh -c "head -c 200000 C/l4.csv >M/trunc.csv; hci-solve tune M/trunc.csv C/leer_re.csv $O $W '$A' -o M/o14"
r "two tests with header repeated in the middle" sh -c "cat C/leer_re.csv C/l4.csv >M/cat.csv; hci-solve tune M/cat.csv $O $W '$A' -o M/o15"
r "text OVL in torque cells" sh -c "awk 'NR%500==0{sub(/;-?[0-9]+,[0-9]{4};/,\";OVL;\")}1' C/l4.csv >M/ovl.csv; grep -c OVL M/ovl.csv; hci-solve tune M/ovl.csv C/leer_re.csv $O $W '$A' -o M/o16"
r "clipped current at 3.5 A" sh -c "awk -F';' -v OFS=';' 'NR>6{for(j=4;j<=6;j++){x=\$j;gsub(\",\",\".\",x);if(x>3.5)\$j=\"3,500\";if(x<-3.5)\$j=\"-3,500\"}}1' C/l4.csv >M/clip.csv; hci-solve tune M/clip.csv C/leer_re.csv $O $W '$A' -o M/o17"
r "Excel: points and commas swapped in angle (1.234 as 1234)" sh -c "sed 's/,/./3' C/l4.csv >M/mix.csv; hci-solve tune M/mix.csv $O $W '$A' -o M/o18"
r "runs list with Windows path" sh -c "hci-solve init M/m --pole-pairs 3 --volt-per-krpm 77 --quiet; printf 'file;role\r\nC:\\\\logs\\\\l2.csv;fit\r\n' >M/list.csv; hci-solve tune M/m --runs M/list.csv -o M/o19"
r "role train" sh -c "printf 'file,role\n../C/l2.csv,train\n' >M/list2.csv; hci-solve tune M/m --runs M/list2.csv -o M/o20"
r "list of logs given as log" hci-solve tune M/list2.csv $O -o M/o21
r "-o in existing folder of mine" sh -c "mkdir -p M/mine; echo x>M/mine/notes.txt; hci-solve tune C/leer_re.csv $O $W '$A' -o M/mine"
r "option typo" hci-solve tune $L --polepairs 3 -o M/o23
r "diagnose without list" hci-solve diagnose M/m C/l2.csv
r "tune MACHINE and logs" hci-solve tune M/m C/l2.csv -o M/o25
r "7 poles" hci-solve tune $L --poles 7 --volt-per-krpm 77 -o M/o26
r "emit table of other name into sketch: --for arduino" hci-solve emit C/u6/currents --for arduino -o M/o27
r "check with log of loaded run vs table without -o" hci-solve check C/u6/diagnose/machine C/l4.csv --table C/u6/table $W "$A"
r "rms current columns: [Aeff]" sh -c "LC_ALL=C sed 's/Strom \\([UVW]\\) \\[A\\]/Strom \\1 [Aeff]/g' C/l4.csv >M/aeff.csv; hci-solve tune M/aeff.csv C/leer_re.csv $O $W '$A' -o M/o29"
