#!/bin/sh
# What tune says of recordings that can be read and are not what they seem, and of a folder that is somebody's.
#   cli_tune_suspect.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
use_plain_build # what tune says has sanitizers in cli_tune_logs
cd "$work" || exit 1

# NAME ANGLE CURRENT: two turns forward and back of seven pole pairs at 6 rpm; angle and current as awk says, of the angle x and the current i that
# balances cogging torque of order 12 and friction
crawl() {
    awk "BEGIN { srand(5); print \"time_s,theta_m_rad,speed_rad_per_s,iq_A,id_A\"; turn = 6.283185307179586
        for (k = 0; k < 12000; ++k) { way = k < 6000 ? 1 : -1; x = 0.7 + 2 * turn * (k < 6000 ? k : 12000 - k) / 6000
            i = 0.036 * way - 0.05 * sin(84 * x + 0.4) + 0.002 * (rand() - 0.5)
            printf \"%.6f,%.7f,%.6f,%.5f,%.5f\n\", k / 300, $2, way * turn / 10, $3, 0.002 * (rand() - 0.5) } }" >"$1"
}
# EXIT NAME ...
tuned() {
    code=$1 name=$2
    shift 2
    run "$code" tune "$name.csv" --pole-pairs 7 --kv 100 --slots 12 --inertia 2e-5 "$@" -o "$name"
}
crawl even.csv x i
tuned 0 even
says '^tuned: A ripple of 0.008.* falls to' '± is a standard deviation of the noise alone' \
    '^  - Every torque here is a current times the 0\.0827 N·m/A of --kv: nothing in these logs tells it, and where it is ten times too large, so are they all'

crawl hall.csv 'int(42 * x / turn) * turn / 42' i
tuned 1 hall
says '^not enough in the logs: The angle stands and jumps by 60 electrical degrees, as Hall sensors'
check "a table over an angle that jumps" [ ! -e hall/table ]

crawl swapped.csv i x
tuned 1 swapped
says '^the conventions are not understood: The angle does not go where the speed leads'
check "a table over a current" [ ! -e swapped/table ]

crawl gear.csv 'x / 5' i
tuned 1 gear
check "a table over the angle behind a gear" [ ! -e gear/table ]

# an angle in a unit in which the shaft would have spun, without a speed that tells
for unit in 'degrees 57.29577951 theta_m_deg=theta_m_rad' 'counts 1303.797 theta_m=theta_m_rad/COUNTS_OF_A_TURN' 'electrical 7 theta_e_rad=theta_m_rad'; do
    set -- $unit
    crawl "$1.csv" "x * $2" i
    cut -d, -f1,2,4 "$1.csv" >fast.csv
    run 1 tune fast.csv --pole-pairs 7 --kv 100 --slots 12 -o fast
    says '^not enough in the logs: By its angle the shaft turns at [0-9.e+]* rpm' "column '$3'"
    check "a table over $1" [ ! -e fast/table ]
    rm -rf fast
done
run 1 tune even.csv --pole-pairs 7 --kv 100000 --resistance 8 --rated-current 1.5 --inertia 1e-9 -o krpm
says '^  - What the resistance takes at the rated current would turn this motor at 2\.[0-9]*e\+06 rpm: are --kv, --resistance and --rated-current'
crawl third.csv 'x / 3' i
tuned 1 third
says '^a convention is broken: Most likely the angle of the recordings is of a shaft behind a gear of 3'

# a shaft that waits before its turn, and at the end of it, is no shaft that sticks
crawl going.csv x i
awk -F, -v OFS=, 'NR == 1 { print; next } { time = $1; at = $2; wait = NR == 2 ? 3000 : NR == 6001 ? 400 : 0
    for (k = 0; k < wait; ++k) printf "%.6f,%s,0,%.5f,0\n", time + late + k / 300, at, 0.2 + 0.002 * (k % 7)
    late += wait / 300; $1 = time + late; print }' going.csv >waits.csv
tuned 0 waits
says 'in 3[34][0-9]* of 15400 rows the angle stays' '^tuned: A ripple of 0.008.* falls to'

crawl clipped.csv x '(i > 0.07 ? 0.07 : i < -0.07 ? -0.07 : i)'
tuned 1 clipped
says 'Currents in 1 of 1 logs are clipped' 'the crests of the current are all of one value'

# BEGIN END STAND: a shaft of four pole pairs that another machine turns, without current; the sensor's ends, and rows for which it stands at first
driven() {
    awk "BEGIN { srand(9); print \"time_s,theta_m_rad,torque_Nm\"
        for (k = 0; k < 12000; ++k) { x = 0.2 + 0.0016 * (k < $4 ? 0 : k - $4)
            y = 0.06 * sin(24 * x + 0.3) + 0.02 * sin(48 * x) - 0.02 + 0.003 * (rand() + rand() + rand() - 1.5)
            printf \"%.4f,%.7g,%.7g\\n\", k / 1000, x, (y < $2 ? $2 : y > $3 ? $3 : y) } }" >"$1"
}
for ends in '-0.03 0' '-0.07 0.03' '0 9'; do
    driven rail.csv $ends 0
    run 1 tune rail.csv --pole-pairs 4 --kv 18.38 --slots 12 -o rail
    says '^the torque is clipped: The torque in the logs is clipped' 'the torque is clipped: in [0-9]* of 12000 rows it stands'
    check "a clipped torque taken for a slow one" [ "$(grep -c "less often" stdout)" = 0 ]
    check "a table over a clipped torque" [ ! -e rail/table ]
    rm -rf rail
done
for stand in 1200 4000 6000; do
    driven wait.csv -9 9 $stand
    run 0 tune wait.csv --pole-pairs 4 --kv 18.38 --slots 12 -o wait
    says "in $stand of 12000 rows the angle stays" '  order 6: 0.0(59|6)'
    check "a delay of one turn at one speed" [ "$(grep -Ec "channel_delay .added|time_constant" stdout)" = 0 ]
    rm -rf wait
done
# an encoder that flickers by one count while it stands
driven flicker.csv -9 9 4000
awk -F, -v OFS=, 'NR > 1 { count = int($2 / 0.0003835) + (NR < 4000 && rand() < 0.3); $2 = count * 0.0003835 } 1' flicker.csv >wait.csv
run 0 tune wait.csv --pole-pairs 4 --kv 18.38 --slots 12 -o wait
says "in [34][0-9]* of 12000 rows the angle stays" '  order 6: 0.0(59|6)'
rm -rf wait

# RAD HUM: a driven shaft again, so many radians of the turn in a sample of 1 ms, and N·m of 50 Hz in its torque
driven_at() {
    awk "BEGIN { srand(9); print \"time_s,theta_m_rad,torque_Nm\"; turn = 6.283185307179586
        for (k = 0; k < 12000; ++k) { x = 0.2 + $1 * k
            y = 0.06 * sin(24 * x + 0.3) + 0.02 * sin(48 * x) - 0.02 + $2 * sin(turn * k / 20)
            printf \"%.4f,%.7g,%.7g\\n\", k / 1000, x, y + 0.003 * (rand() + rand() + rand() - 1.5) } }" >hum.csv
    rm -rf hum
    run 0 tune hum.csv --pole-pairs 4 --kv 18.38 --slots 12 -o hum
}
driven_at 0.001570796326795 0.02 # 15 rpm
says '^tuned: ' '^  - Order 50 is 50 Hz at this one speed, as hum of the mains is: another speed tells'
driven_at 0.001570796326795 0
check "hum where there is none" [ "$(grep -c "of the mains\|slower torque sensor" stdout)" = 0 ]
driven_at 0.0157 0 # 150 rpm
says '^tuned: ' '^  - At this one speed the ripple has [1-9][0-9]* Hz, of which a slower torque sensor or filter shows less'
# ten samples a turn, at the same ten angles in each of eighty turns, cover all of it
awk 'NR == 1 || NR % 40 == 0' hum.csv | awk -F, -v OFS=, 'NR > 1 { $2 = 0.2 + 0.6283185307 * NR } 1' >ten.csv
run 1 tune ten.csv --pole-pairs 4 --kv 18.38 -o ten
check "turns that are covered are said not to be" [ "$(grep -c "the logs cover 0" stdout)" = 0 ]

# an electrical speed beside the mechanical angle counts the pole pairs, a mechanical one does not
awk -F, -v OFS=, 'NR == 1 { $3 = "speed_e_rad_per_s" } NR > 1 { $3 *= 7 } 1' even.csv >counted.csv
awk -F, -v OFS=, 'NR == 1 { $2 = "theta_e_rad" } NR > 1 { $2 *= 7 } 1' even.csv >counting.csv
for log in counted counting; do
    tuned 0 $log
    check "$log.csv: pole pairs that the logs count are taken on trust" [ "$(grep -c 'on trust\|Whether there are 7' stdout)" = 0 ]
done
rm -rf even
tuned 0 even
says 'That there are 7 pole pairs is taken on trust, since nothing in these logs counts them$' 'Whether there are 7 pole pairs'

# what can be refused before any work, and names as they were given
run 2 tune even.csv --pole-pairs 7 --kv 100 --name 'my table' -o named
says 'table name: found `my table`, expected a C identifier'
check "work before the name was looked at" [ ! -e named ]
run 2 tune even.csv even.csv --pole-pairs 7 --kv 100 -o named
says 'found the log even.csv twice, expected each one once'
mkdir logs
printf 'MOT: Ready.\n1\t2\n2\t3\n3\t4\n' >logs/monitor.txt
run 3 tune logs/monitor.txt --pole-pairs 7 --kv 100 -o named
says '^hci-solve: logs/monitor.txt:2: found rows of 2 numbers and no line of names above them'
run 2 solve machine --limt 3
says 'unknown option `--limt`; did you mean `--limit-current`'
run 2 tune even.csv --torqe 3
says 'unknown option `--torqe`; did you mean `--torque`'

crawl weight.csv x 'i + 0.3 * sin(x + 1)'
tuned 1 weight
says 'come once or twice a turn, and a load on the shaft makes that as well as the motor'
crawl crank.csv x 'i + 0.1 * sin(2 * x)'
tuned 1 crank
says 'come once or twice a turn, and a load on the shaft makes that as well as the motor'

# a weight, or a zero of i_q, pulls the same way in both directions: it is said, and the rest is explained
for weight in 0.005 -0.02 0.2; do
    crawl hoist.csv x "i + $weight"
    tuned 0 hoist
    check "the weight is not said" grep -q 'the same way in both directions: a weight on the shaft, or a zero of i_q' hoist/summary.json
    says '^tuned: A ripple of 0.008.* falls to' '  friction .added.: coulomb = 0.0029[0-9]* ± '
    rm -rf hoist
done
check "a weight where there is none" [ "$(grep -c "the same way in both directions" even/summary.json)" = 0 ]

crawl still.csv x '0.036 * way + 0.0002 * (rand() - 0.5)'
tuned 1 still
says "^a table of no use: Nothing"

run 0 tune even.csv --pole-pairs 7 --kv 100 --slots 9 --inertia 2e-5 -o nine
says 'The largest order found, 12, is none that 9 slots and 14 poles make: 18 and its multiples'
crawl third.csv x 'i - 0.02 * sin(252 * x + 0.3)' # 36 is a multiple of 12 as well as of 18
run 0 tune third.csv --pole-pairs 7 --kv 100 --slots 9 --inertia 2e-5 -o third
says 'The largest order found, 12, is none that 9 slots and 14 poles make: 18 and its multiples'

awk -F, 'NR == 1 || int($2 / 3.14159) % 2 == 0' even.csv >gap.csv
tuned 1 gap
says 'The logs cover 0.5'

cut -d, -f1-4 even.csv >lone.csv
tuned 0 lone
check "i_d is taken as 0" grep -q "i_d in no column and taken as 0" lone/summary.json

mkdir mine
echo "my log" >mine/log.csv
run 2 tune even.csv --pole-pairs 7 --kv 100 -o mine
check "the folder is named" grep -q "mine has files in it that tune did not write, such as log.csv" "$work/stderr"
check "nothing beside my files" [ "$(ls -A mine)" = log.csv ]
mkdir broken && mkdir broken/machine && echo of_mine >broken/machine/machine.csv
run 2 tune even.csv --pole-pairs 7 --kv 100 -o broken
check "a folder that was not finished" grep -q "broken has machine in it and no summary.json, which tune writes last: a call was broken off" "$work/stderr"
check "its file is as it was" [ "$(cat broken/machine/machine.csv)" = of_mine ]

printf 'time_s,Crank angle,Motor encoder,iq_A\n0,1,2,3\n1,2,3,4\n' >two.csv
run 3 tune two.csv --pole-pairs 7 --kv 100 -o two
check "both angles are named" grep -q "so may .Motor encoder. be" "$work/stderr"
# Units that are others: i_q in mA named A, a torque in N·cm, and one in lbf·in that only a rated current makes suspicious
crawl milli.csv x '1000 * i'
tuned 1 milli
says '^the size is not believable: The table would take a peak current of' 'are currents and Kv in the unit'
check "a table of milliamperes" [ ! -e milli/table ]

# NAME FACTOR OFFSET SIGN WAYS: torque of order 12 without current, friction 0.02 N·m, times the factor, of a sensor at four pole pairs
sensor() {
    awk "BEGIN { srand(5); print \"time_s,theta_m_rad,torque_Nm\"; turn = 6.283185307179586
        for (k = 0; k < 8000; ++k) { way = $5 == 2 && k >= 4000 ? -1 : 1; x = 0.7 + 2 * turn * (way > 0 ? k : 8000 - k) / 4000
            torque = 0.06 * sin(24 * x + 0.4) - 0.02 * way + 0.003 * (rand() - 0.5)
            printf \"%.6f,%.7f,%.6f\\n\", k / 1000, x, $2 * $4 * torque + $3 } }" >"$1"
}
shaft() {
    code=$1 name=$2
    shift 2
    run "$code" tune "$name.csv" --pole-pairs 4 --kv 18.38 --slots 12 "$@" -o "$name"
}
sensor right.csv 1 0 1 2
shaft 0 right
sensor centi.csv 100 0 1 2
shaft 1 centi
says '^the size is not believable: The table would take' 'are torque and Kv in the unit' 'N·cm'
check "a table of newton centimetres" [ ! -e centi/table ]
cp centi.csv rated.csv
shaft 1 rated --rated-current 6
says '^the size is not believable: A torque without current of .* times the rated torque of 2.7 N·m, which no motor has'
sensor pound.csv 8.85 0 1 2
shaft 1 pound --rated-current 6
says 'few motors have so much: is the torque in N·m, and not in N·cm or lbf·in'

# A torque that friction does not brake: in both directions its sign, in one its sign or its zero
sensor turned.csv 1 0 -1 2
shaft 1 turned
says '^a convention is broken: The torque in turned.csv drives the shaft by 0.0[12].* in both directions' 'column torque=-COLUMN turns the sign'
check "a table of a torque of the other sign" [ ! -e turned/table ]
sensor one.csv 1 0 -1 1
shaft 1 one
says 'that is taken for the zero of its sensor; if its sign is the other one instead .--column torque=-COLUMN. the table doubles the ripple'
# a sensor that nobody tared: its mean explains nothing, the ripple about it does
for zero in 0.2 5; do
    sensor untared.csv 1 $zero 1 1
    shaft 1 untared
    says '^tuned.* falls to ' '  order 6: 0.0(59|6)'
    check "what is taken for the zero is not said" grep -q 'N·m, drives the shaft: it is taken for the zero of the sensor' untared/summary.json
    rm -rf untared
done

# FILE A FACTOR SEED: a loaded shaft of four pole pairs at 60 rpm, 0.45 N·m/A, torque times the factor
loaded() {
    awk "BEGIN { srand($4); print \"time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm\"; turn = 6.283185307179586
        for (k = 0; k < 6000; ++k) { x = 0.7 + turn * k / 1000
            torque = $2 * 0.45 + 0.06 * sin(24 * x + 0.4) - 0.02 + 0.003 * (rand() - 0.5)
            printf \"%.6f,%.7f,%.5f,%.5f,%.5f,%.6f\n\", k / 1000, x, $2 * sin(4 * x) + 0.002 * (rand() - 0.5), $2 * sin(4 * x - turn / 3) + 0.002 * (rand() - 0.5), $2 * sin(4 * x + turn / 3) + 0.002 * (rand() - 0.5), $3 * torque } }" >"$1"
}
loaded two.csv 2 1 1
loaded one_m.csv 1 1000 2
loaded one_c.csv 1 100 2
loaded none_m.csv 0 1000 3
for other in one_m:torque_mNm one_c:torque_Ncm none_m:torque_mNm; do
    name=${other%:*} unit=${other#*:}
    run 1 tune two.csv "$name.csv" --pole-pairs 4 --kv 18.38 -o mixed
    says "^a convention is broken: The torque in $name.csv .* times that in two.csv, .*; name its column $unit in that log"
    rm -rf mixed
    sed -i "1s/torque_Nm/$unit/" "$name.csv" # as it is said
    run 1 tune two.csv "$name.csv" --pole-pairs 4 --kv 18.38 -o mixed # at one speed something is left open
    says '^tuned, with something left open: A ripple of 0.12 .* falls to at most'
    rm -rf mixed
done
# the zero of the torque sensor is no torque to be wanted
zeroed() { # FILE A WAY SEED: 0.5 N·m too much
    awk "BEGIN { srand($4); print \"time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm\"; turn = 6.283185307179586
        for (k = 0; k < 4000; ++k) { x = 0.7 + $3 * turn * k / 1000
            torque = $2 * 0.45 + 0.06 * sin(24 * x + 0.4) - 0.02 * $3 + 0.5 + 0.003 * (rand() - 0.5)
            printf \"%.6f,%.7f,%.5f,%.5f,%.5f,%.6f\n\", k / 1000, x, $2 * sin(4 * x) + 0.002 * (rand() - 0.5), $2 * sin(4 * x - turn / 3) + 0.002 * (rand() - 0.5), $2 * sin(4 * x + turn / 3) + 0.002 * (rand() - 0.5), torque } }" >"$1"
}
zeroed z1.csv 0 1 1; zeroed z2.csv 0 -1 2; zeroed z3.csv 2 1 3; zeroed z4.csv 2 -1 4
run 0 tune z1.csv z2.csv z3.csv z4.csv --pole-pairs 4 --kv 18.38 -o zeroed
says 'a torque without ripple of 0.9[0-9]* N·m: the largest mean torque of the'
check "the zero is not said" grep -q 'less the zero of its sensor' zeroed/summary.json
# a number of the sheet that was typed without a unit is more often wrong than a column that says its own: it is said first
loaded three.csv 3 1 4
loaded none.csv 0 1 3
while read -r option given meant; do
    run 1 tune none.csv two.csv three.csv --pole-pairs 4 $option $given -o point
    says "^a convention is broken: The torques of the logs are [0-9.]* times those of $option $given, and $option $meant fits: begin again"
    check "$option $given: the column is said to be the slip" [ "$(grep -cE '^  slip:|Most likely' stdout)" = 0 ]
    check "$option $given: what fits is said twice" [ "$(grep -c -e "$option $meant fits" stdout)" = 1 ]
done <<'END'
--kv 183.8 18.38
--kv 18380 18.38
--kv 1.838 18.38
--torque-constant 0.045 0.45
--torque-constant 450 0.45
--volt-per-krpm 0.0385 38.5
--volt-per-krpm 38500 38.5
--flux 75 0.075
END
says 'Else the currents are in mA, whatever its column says .--column .ia_mA=ia_A.*, or the torque is of the other side of a gear'
# newtons on a lever of 150 or 120 mm in the column of the torque: what fits of the sheet is one of several, and what tells them apart is said
for log in none two three; do
    awk -F, -v OFS=, 'NR > 1 { $6 /= 0.15 } 1' $log.csv >longer_$log.csv
    awk -F, -v OFS=, 'NR > 1 { $6 /= 0.12 } 1' $log.csv >newton_$log.csv
done
run 1 tune longer_none.csv longer_two.csv longer_three.csv --pole-pairs 4 --torque-constant 0.45 -o point
says ' fits: begin again with it if that is meant\. Else .* or the column is a force in N on a lever of 15[0-9] mm .--column .torque_Nm=COLUMN/6' \
    'The logs alone do not tell which: voltages of the open machine tell the number of the sheet, a known weight on a lever the torque\. Nothing was solved'
run 1 tune newton_none.csv newton_two.csv newton_three.csv --pole-pairs 4 --torque-constant 0.45 -o point
says 'The torque is 8\.[0-9]* times what the currents make.*a force in N on a lever of 12[0-9] mm.*voltages of the open machine tell the number of the sheet, a known weight on a lever the torque'
# a log of a motor of other pole pairs and another torque constant: it is named, and no unit of a torque that its currents make in a wrong frame
run 1 tune even.csv two.csv --pole-pairs 7 --kv 100 -o point
says '^a convention is broken: The phase currents of two\.csv go round 4 times in a turn of its shaft, and the motor has 7 pole pairs: it is a log of another motor'
check "a unit of the torque is said" [ "$(grep -c 'magnets of no motor' stdout)" = 0 ]
# i_d and i_q exchanged: the load makes no torque along i_d
for log in two three; do
    awk -F, -v OFS=, -v i="$log" 'NR == 1 { print "time_s,theta_m_rad,id_A,iq_A,torque_Nm"; next } { print $1, $2, (i == "two" ? 2 : 3), 0.01 * sin($2), $6 }' $log.csv >dq_$log.csv
done
run 1 tune dq_two.csv dq_three.csv --pole-pairs 4 --kv 18.38 -o point
says "^a convention is broken: Most likely the torque in dq_.*\.csv goes with i_d .id_A.*: each is in the other.s place.*: --column 'iq=id_A' --column 'id=iq_A'$"
check "a column in another unit is said beside it" [ "$(grep -c 'magnets of no motor' stdout)" = 0 ]
run 3 tune dq_two.csv --pole-pairs 4 --kv 18.38 --column 'torque=torque_Nm*0.2' -o point
says 'found a column times 0.2, expected one divided by a number: torque=torque_Nm/5'
# beside a column without a unit it is not, and where the currents are a thousand times what is rated it is their column
for log in none two three; do
    sed '1s/torque_Nm/torque/' $log.csv >bare_$log.csv
    awk -F, -v OFS=, 'NR > 1 { for (k = 3; k <= NF; ++k) if (name[k] ~ /^i/) $k *= 1000 } NR == 1 { for (k = 1; k <= NF; ++k) name[k] = $k } 1' $log.csv >milli_$log.csv
done
run 1 tune bare_none.csv bare_two.csv bare_three.csv --pole-pairs 4 --volt-per-krpm 0.0385 -o point
says '^a convention is broken: Most likely the torque is in mN·m'
run 1 tune milli_none.csv milli_two.csv milli_three.csv --pole-pairs 4 --volt-per-krpm 38.5 --rated-current 3 -o point
says '^a convention is broken: Most likely the currents are in mA'
check "another constant is proposed beside it" [ "$(grep -c 'begin again with it' stdout)" = 0 ]

# a figure of the sheet with another unit: the first line has the number that fits, by torques or by what motors have
run 1 tune none.csv two.csv three.csv --pole-pairs 4 --kv 38.5 -o sheet
says '^[a-z ,]*: ' '^  - The torques of the logs are 2\.0?9?[0-9]* times those of --kv 38\.5, and --volt-per-krpm 38\.5 fits'
check "not in summary.json" grep -q 'volt-per-krpm 38\.5 fits' sheet/summary.json
for given in '--flux 14' '--kv 0.1' '--torque-constant 150'; do
    run 1 tune even.csv --pole-pairs 7 $given --torque 0.2 -o sheet
    number=${given#* }
    meant=$(awk -v n="$number" 'BEGIN { print n < 1 ? 1000 * n : n / 1000 }')
    says "^tuned, with something left open: " "^  - .*: is ${given% *} $meant meant, in another unit by a factor of 1000"
done
run 1 tune even.csv --pole-pairs 7 --kv 100 --rated-current 5000 --torque 0.2 -o sheet
says 'is it in mA .--rated-current 5.'
run 1 tune even.csv --pole-pairs 7 --kv 100 --resistance 800 --torque 0.2 -o sheet
says 'is it in mΩ .--resistance 0\.8.'
run 1 tune even.csv --pole-pairs 7 --kv 100 --inductance-d 0.5 --inductance-q 0.7 --rated-current 1 --torque 0.01 -o sheet
says 'is it in mH .--inductance-d 0\.0005, and the other likewise.'
run 1 tune none.csv two.csv three.csv --pole-pairs 4 --kv 18.38 --inertia 200 -o sheet
says '^  - With --inertia 200 a torque of [0-9.]* N·m .*is it in g·cm² .--inertia 2e-05.'
run 2 tune even.csv --pole-pairs 7 --kv 100 --inductance-d 5 --inductance-q 12 -o sheet
says '--inductance-q: found `12`, expected a number from 1e-12 to 10; give it in H, not mH'

# what is no log: a page, JSON, C, and currents that were calculated
run 1 tune none.csv two.csv three.csv --pole-pairs 4 --kv 18.38 -o whole
said=$(head -1 "$work/stdout")
for file in report.html:page summary.json:JSON table/tuned.c:C; do
    run 3 tune "whole/${file%:*}" --pole-pairs 4 --kv 18.38 -o nothing
    says "whole/${file%:*}:1: found (a )?${file#*:}.*, expected a table; give the CSV file"
done
run 3 tune whole/currents/waveform.csv --pole-pairs 4 --kv 18.38 -o nothing
says 'waveform.csv: found calculated currents, as solve writes them in waveform.csv, expected a log that was measured'

# logs that were sorted by their angle, within the turn, are those that they were
for log in none two three; do
    awk -F, -v OFS=, 'NR > 1 { $2 -= 6.283185307 * int($2 / 6.283185307) } 1' $log.csv >wrapped.csv
    { head -1 wrapped.csv; tail -n +2 wrapped.csv | sort -t, -gk2; } >sorted_$log.csv
done
run 1 tune sorted_none.csv sorted_two.csv sorted_three.csv --pole-pairs 4 --kv 18.38 -o sorted
says '3 of 3 recordings: its rows stand in the order of the angle, and are taken in'
check "other words: $(head -1 "$work/stdout")" [ "$(head -1 "$work/stdout" | tr -d '0-9.')" = "$(printf %s "$said" | tr -d '0-9.')" ]

# Anti-cogging alone
run 0 tune right.csv --pole-pairs 4 --kv 18.38 --slots 12 --torque 0 -o alone
check "no table of anti-cogging alone" [ -e alone/table/tuned.c ]

# ---- a model whose torque falls again with the current

mkdir drooping
printf 'name,value,unit\npole_pairs,5,1\nrated_current,8,A\n' >drooping/machine.csv
printf 'order,amplitude_Nm_per_A,phase_rad\n1,0.76,0\n' >drooping/back_emf.csv
printf 'order,amplitude_Nm,phase_rad\n18,0.05,0.3\n' >drooping/cogging.csv
printf 'effect,parameter,value,unit,std_error\nsaturation,d1q2_cosine_0,-6.3,Nm,\nsaturation,reference_current,8,A,\n' >drooping/effects.csv
for current in 0.4 0.6 0.8; do
    awk -v i="$current" 'BEGIN { srand(3); print "time_s,theta_m_rad,speed_rad_per_s,id_A,iq_A,torque_Nm"
        for (k = 0; k < 2400; ++k) { x = 3.14159265 * k / 300; e = 90 * x
            printf "%.5f,%.6f,3.14159265,0,%.4f,%.5f\n", k / 300, x, i, 1.14 * i - 31.5 * (i / 8) ^ 3 + 0.05 * sin(e + 0.3) + 0.01 * (rand() - 0.5) } }' >"droop$current.csv"
done
printf 'file,role\ndroop0.4.csv,fit\ndroop0.6.csv,fit\ndroop0.8.csv,fit\n' >droop.csv
run 1 tune drooping --runs droop.csv --torque 500 -o droop
says '^the model does not reach the torque: Nothing was solved: no current of this direction makes 500 N·m in the model' 'its torque falls again'
check "a table of a torque beyond the model" [ ! -e droop/table ] && [ ! -e droop/currents ]
# with inductances that are known the currents are free, and 1.14 i - 31.5 (i/8)^3 makes 500 N·m at -20.4 A: within ten times what is rated, against the torque
printf 'inductance_d,0.001,H\ninductance_q,0.001,H\n' >>drooping/machine.csv
run 1 tune drooping --runs droop.csv --torque 500 -o against
says '^the size is not believable: The currents of the model for 500 N·m have the sign that makes the other torque' '--torque with less, or logs at several loads'
check "a table of currents against the torque" [ ! -e against/table ]
mkdir magnets
cp drooping/machine.csv drooping/cogging.csv magnets
printf 'order,amplitude_Nm_per_A,phase_rad\n1,0.66,0\n' >magnets/back_emf.csv
for current in 0.4 0.6 0.8; do
    awk -v i="$current" 'BEGIN { srand(3); print "time_s,theta_m_rad,speed_rad_per_s,id_A,iq_A,torque_Nm"
        for (k = 0; k < 2400; ++k) { x = 3.14159265 * k / 300; e = 5 * x
            printf "%.5f,%.6f,3.14159265,0,%.4f,%.5f\n", k / 300, x, i, (1.14 + 0.04 * cos(6 * e)) * i + 0.05 * sin(18 * e + 0.3) + 0.01 * (rand() - 0.5) } }' >"droop$current.csv"
done
run 0 tune magnets --runs droop.csv --torque 0.5 -o magnets_out
says 'order 1: 0\.0[0-9]* ± .* N·m/A' 'order 5 or 7: 0\.0[0-9]* ±' '^  - That no drag before the torque sensor grows with the load, .* where it makes the [0-9.]* % '
run 1 tune magnets --runs droop.csv --torque 500 -o beyond
says '^the size is not believable: A torque of 500 N·m would take a sine of [0-9]* A, .* times the 8 A that are rated or recorded'
check "a table of a torque that no current of this motor makes" [ ! -e beyond/table ]
run 1 tune magnets --runs droop.csv --torque 12 -o above
says '^  - The currents do not keep a limit, rms 5\.657 A, but take [0-9.]*: the table is not for continuous use'

# ---- remedies that can work: files and units by what is there

run 3 tune droop0.4.csv drop0.6.csv --pole-pairs 5 --volt-per-krpm 97.5 -o none
says 'drop0.6.csv: No such file; did you mean `droop0.6.csv`.'
run 3 tune "$work/drop0.6.csv" --pole-pairs 5 --volt-per-krpm 97.5 -o none
says "did you mean .$work/droop0.6.csv.[?]"
run 3 tune 'nothing/*.csv' --pole-pairs 5 --volt-per-krpm 97.5 -o none
says 'found no file of that pattern'
run 3 tune nothing/at.csv --pole-pairs 5 --volt-per-krpm 97.5 -o none
says 'its folder is not there either'
awk -F, -v OFS=, 'NR > 1 { $6 *= 100 } 1' droop0.8.csv >centi.csv
run 1 tune centi.csv --pole-pairs 5 --volt-per-krpm 97.5 -o centi
says '^a convention is broken: ' '^  - The torques of the logs are [0-9]* times those of --volt-per-krpm 97.5, which magnets of no motor make: .*--column torque_Ncm=COLUMN'
check "a figure of the sheet in place of the unit of a column" [ "$(grep -c 'krpm 9750' "$work/stdout")" -eq 0 ]
awk -F, 'NR == 1 { print "t [s],Angle [rad],Speed [rad/s],i_q [A],Torque [Nm]"; next } { print $1 "," $2 * 57.29578 "," $3 "," $5 "," $6 }' droop0.8.csv >degrees_as_rad.csv
run 3 tune degrees_as_rad.csv --pole-pairs 5 --volt-per-krpm 97.5 -o none
says "degrees_as_rad.csv:1: column 2 .*: found an angle that does not go where speed and time lead, .*; the three agree where .Angle \[rad\]. is in another unit: --column 'theta_m_deg=Angle \[rad\]'"
awk -F, 'NR == 1 { print "t [s],Angle [rad],Speed [rad/s],i_q [A],Torque [Nm]"; next } { print $1 ",0.3,0," $5 "," $6 }' droop0.8.csv >still.csv
run 3 tune still.csv --pole-pairs 5 --volt-per-krpm 97.5 -o none
says 'still.csv:1: column 2 .*: found an angle that stands: the shaft does not turn in this recording, expected one that turns; .*record again with the shaft turned, once round or more'
{ echo 'Bench 3;Motor A;;;'; echo 't [s];Angle [rad];Speed [rad/s];i_q [A];Torque [Nm]'; } >no_rows.csv
run 3 tune no_rows.csv --pole-pairs 5 --volt-per-krpm 97.5 -o none
says 'no_rows.csv:2: found a header and no samples below it'
check "the speed is asked for although it is there" [ "$(grep -c 'add the speed' "$work/stderr")" -eq 0 ]

# ---- voltages of a scope alone: what the drive has to know of its angle

awk 'BEGIN { print "time_s,v_ab_V,v_bc_V"; turn = 6.283185307179586
    for (k = 0; k < 1500; ++k) { e = turn * 30 * k / 5000; for (s = 0; s < 3; ++s) { x = e - s * turn / 3; v[s] = 10 * sin(x) + 0.4 * sin(5 * e + s * turn / 3) }
        printf "%.5f,%.5f,%.5f\n", k / 5000, v[0] - v[1], v[1] - v[2] } }' >scope.csv
run 1 tune scope.csv --pole-pairs 3 --volt-per-krpm 20 --rated-current 3 -o scope
says '^  - No log has an angle: the table begins where the back-EMF of phase a rises through zero, and cannot be played before'
check "a zero of logs without an angle" [ "$(tr '\n' ' ' <"$work/stdout" | grep -c 'from the zero of the  *logs')" -eq 0 ]

# ---- nothing is read before it is true

# NAME RPM IQ: order 12 of four pole pairs; the torque sensor is 0.3 ms late, which without a current is an angle that is early
late() {
    awk -v rpm="$2" -v q="$3" 'function noise() { return rand() + rand() + rand() + rand() - 2 }
    function phase(s) { return q * sin(4 * x - 2.0943951 * s) + 0.01 * noise() }
    BEGIN { srand(8 + q); w = rpm * 6.283185307179586 / 60; print "time_s,theta_m_rad,speed_rpm,ia_A,ib_A,ic_A,torque_Nm"
        for (k = 0; k < 6000; ++k) { t = k / 1000; x = 0.3 + w * t; e = 4 * (x - 0.0003 * w)
            printf "%.4f,%.6f,%.3f,%.3f,%.3f,%.3f,%.5f\n", t, x, rpm + 0.02 * noise(), phase(0), phase(1), phase(2),
                0.45 * q + 0.03 * sin(12 * e + 1.2) + 0.05 * sin(6 * e) - 0.02 * (w > 0 ? 1 : -1) + 0.002 * noise() } }' >"$1.csv"
}
late early0 60 0
late early1 -60 0
"$hci_solve" tune early?.csv --pole-pairs 4 --kv 18.38 -o early >"$work/stdout" 2>"$work/stderr"
says 'The angle seems to be read 0.0003 s before it is true, as no sensor does: most likely the torque sensor is late by as much or more and reads the ripple too small, by how much one speed does not tell, so that no bound holds, and nothing is corrected for it'
late early2 120 0
"$hci_solve" tune early?.csv --pole-pairs 4 --kv 18.38 -o early_two >"$work/stdout" 2>"$work/stderr"
says 'most likely the torque sensor is late by as much, and nothing is corrected for it'

# A filter of 30 ms reads the finest orders much too small, which at one speed is taken for an angle that is early: no promise.
lagged() { # NAME IQ
    awk -v q="$2" 'function noise() { return 2 * (rand() + rand() + rand() - 1.5) }
    function read_A(s, gain, zero) { return gain * q * sin(5 * x - 2.0943951 * s) + zero + 0.01 * noise() }
    BEGIN { srand(8 + q); print "time_s,theta_m_rad,speed_rpm,ia_A,ib_A,ic_A,torque_Nm"
        for (k = 0; k < 6400; ++k) { way = k < 3200 ? 1 : -1; t = (k + (k < 3200 ? 0 : 80)) / 80; w = 0.6283185307 * way; x += w / 80; e = 5 * x
            torque = q * (0.82 * (1 - 0.06 * q * q / 64) + 0.02 * sin(6 * e + 0.5)) - 0.05 * way + 0.045 * sin(60 * x + 0.7) + 0.011 * sin(120 * x - 0.9) + 0.008 * sin(10 * x + 0.2) + 0.012 * sin(12 * x - 1.4)
            y = k ? y + (1 - exp(-1 / 2.4)) * (torque - y) : torque
            printf "%.4f,%.5f,%.3f,%.3f,%.3f,%.3f,%.4f\n", t, x, 6 * way, read_A(0, 1, 0.05), read_A(1, 1.015, -0.03), read_A(2, 1, 0), y + 0.042 + 0.0096 * noise() } }' >"$1.csv"
}
for load in 0 1.5 3 5; do lagged lag_$load $load; done
run 1 tune lag_*.csv --pole-pairs 5 --slots 12 --torque-constant 0.82 --rated-current 5 -o lagged
says '^tuned, with something left open.*if the torque sensor is in time, which these logs deny'

finish
