O="--volt-per-krpm 95 --slots 36 --rated-current 20 --resistance .9 --inductance-d 0.005 --inductance-q 0.012"
all() { for r in leer_vor last07 last14 last20 leer_rueck; do printf '%s/%s.csv ' $1 $r; done; }
n=0
m() { n=$((n+1)); echo "#### $n $1"; shift; echo "   $*" | cut -c1-250; nice "$@" -o out/m$n >out/m$n.txt 2>&1; echo "   rc $?"; sed -n '1,/^What was read/p' out/m$n.txt | grep -v '^What was' | head -${HEAD:-9} | cut -c1-520; grep -E '^ *(slip|possible slip)' -A5 out/m$n.txt | head -8; }
S=$(all s)
m "pole pairs 4 (true 3)" hci-solve tune $S --pole-pairs 4 $O
m "poles given as pole pairs (6)" hci-solve tune $S --pole-pairs 6 $O
m "phases V,W swapped" hci-solve tune $(all m/swap) --pole-pairs 3 $O
m "electrical angle named Winkel" hci-solve tune $(all m/elec) --pole-pairs 3 $O
m "degrees labelled rad" hci-solve tune $(all m/rad) --pole-pairs 3 $O
m "mA labelled A" hci-solve tune $(all m/mA) --pole-pairs 3 $O
m "unknown column names" hci-solve tune $(all m/names) --pole-pairs 3 $O
m "missing file" hci-solve tune s/leer_vor.csv s/last70.csv --pole-pairs 3 $O
m "two motors' logs mixed" hci-solve tune s/leer_vor.csv s/last07.csv s/last14.csv w/load20.tsv --pole-pairs 3 $O
m "wrong option name" hci-solve tune $S --polepairs 3 $O
m "--volt-per-krpm in V per rpm" hci-solve tune $S --pole-pairs 3 --volt-per-krpm 0.095 --slots 36 --rated-current 20
m "kv typed as V/krpm" hci-solve tune $S --pole-pairs 3 --kv 95 --slots 36 --rated-current 20
m "logs at standstill" hci-solve tune m/x/still.csv --pole-pairs 3 $O
m "empty file" hci-solve tune m/x/empty.csv --pole-pairs 3 $O
m "header only" hci-solve tune m/x/header.csv --pole-pairs 3 $O
m "currents rms labelled A" hci-solve tune $(all m/rms) --pole-pairs 3 $O
m "torque of the other sign" hci-solve tune $(all m/sign) --pole-pairs 3 $O
m "torque column in Nm labelled mNm" hci-solve tune $(all m/tmNm) --pole-pairs 3 $O
m "encoder counts the other way" hci-solve tune $(all m/anglerev) --pole-pairs 3 $O
m "ms labelled s" hci-solve tune $(all m/sec) --pole-pairs 3 $O
m "no angle column" hci-solve tune m/x/noangle.csv --pole-pairs 3 $O
m "a thirteenth of a turn only" hci-solve tune m/x/short.csv --pole-pairs 3 $O
m "no pole pairs" hci-solve tune $S $O
m "inductance in mH" hci-solve tune $S --pole-pairs 3 --volt-per-krpm 95 --slots 36 --rated-current 20 --inductance-d 5 --inductance-q 12
m "gimbal kv 10 times" hci-solve tune g/slow2_both.csv --pole-pairs 11 --kv 220 --slots 24
m "gimbal poles for pairs" hci-solve tune g/slow2_both.csv g/brake25_both.csv --pole-pairs 22 --kv 22 --slots 24
m "machine folder instead of logs" hci-solve tune s/mach --pole-pairs 3
m "-o forgotten: file as out" hci-solve tune $S --pole-pairs 3 --volt-per-krpm 95 --slots 36,
