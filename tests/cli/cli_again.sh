#!/bin/sh
# What `diagnose --again` says of a recording in which the solved currents are played: theirs, at another angle, of another
# size, a plain sine, and currents that are not known; and whether the promised ripple was kept.
#   cli_again.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
use_plain_build
cd "$work" || exit 1

# The servo of docs/tutorials/dyno.md.
"$hci_solve" init servo --pole-pairs 4 --volt-per-krpm 40 --resistance 1.2 --rated-current 6 --slots 24 --quiet
cp -R servo bench
printf 'order,amplitude_Nm_per_A,phase_rad\n1,0.3088,0\n5,0.006,0.2\n7,0.004,3\n11,0.002,0.5\n' >bench/back_emf.csv
printf 'order,amplitude_Nm,phase_rad\n6,0.05,0.8\n12,0.012,-0.5\n' >bench/cogging.csv
mkdir runs

record() { # NAME SPEED DURATION TORQUE [WORD...]; TORQUE: - where currents are given as they are
    name=$1 speed=$2 duration=$3 torque=$4
    shift 4
    printf '%s\n' name,value,unit "duration,$duration,s" "prescribed_speed,$speed,rpm" "torque_reference,$torque,Nm" strategy,id0, \
        current_control,ideal, "torque_noise,${noise:-5},mNm" current_noise,10,mA trajectory_every,8, |
        grep -v '^torque_reference,-,' >"scenario_$name.csv"
    run 0 simulate bench "scenario_$name.csv" --quiet "$@" -o "log/$name"
    cut -d, -f1,2,5-7,10 "log/$name/trajectory.csv" >"runs/$name.csv"
    printf 'file,role\nruns/%s.csv,holdout\n' "$name" >"list_$name.csv"
}
record idle 60 3 0
record light 60 3 0.7
record half -60 3 1.4
record full 60 3 2.1
record fast 300 0.6 1
printf 'file,role\nruns/idle.csv,fit\nruns/light.csv,fit\nruns/half.csv,fit\nruns/full.csv,fit\nruns/fast.csv,holdout\n' >runs.csv
printf 'order,amplitude_Nm,phase_rad\n0,1.5,0\n' >smooth.csv
mkdir out
run 0 diagnose servo --runs runs.csv -q -o out/diagnosed
run 0 solve out/diagnosed/machine --target smooth.csv --auto -q -o out/currents

# The same currents, AHEAD rad of the angle and GAIN times as large.
turned() { # AHEAD GAIN FILE
    awk -F, -v ahead="$1" -v gain="$2" 'NR == 1 { print; next }
        { printf "%s,%s,%.12g,%.12g\n", $1, $2, gain * $3, $4 + ahead * $1 }' out/currents/currents.csv >"$3"
}
turned 0.3 1 ahead.csv
turned 0 0.8 small.csv
record played 60 3 1.5 --currents out/currents
record ahead 60 3 - --currents ahead.csv
record small 60 3 - --currents small.csv
record plain 60 3 1.5

again() { # CODE NAME LAST
    run "$1" diagnose --again "$3" --runs "list_$2.csv" -o "again_$2"
    tr -s ' \n' ' ' <"$work/stdout" >words
}
finds() { # KEY VALUE
    check "$name: $1: $(grep "\"$1\"" "again_$name/summary.json")" grep -Eq "\"$1\":[[:space:]]*$2" "again_$name/summary.json"
}
tells() { # EXPRESSION
    check "$name: does not say $1" grep -Eq "$1" words
}
never_kept() {
    check "$name: a promise is called kept" sh -c '! grep -q "promise was kept" words'
}

# ---- they: kept; and of a machine with more cogging torque than the recordings had: not kept

name=played
again 0 $name out/diagnosed
finds currents '"as_solved"' && finds promise '"kept"'
tells 'currents are those that were solved .* measured ripple is .* from peak to peak.*was promised .*: the promise was kept'
check "report.html" grep -q 'measured ripple, peak to peak, and what was promised' again_played/report.html

printf 'order,amplitude_Nm,phase_rad\n6,0.05,0.8\n12,0.012,-0.5\n18,0.04,0\n' >bench/cogging.csv
record moved 60 3 1.5 --currents out/currents
name=moved
again 1 $name out/diagnosed
finds currents '"as_solved"' && finds promise '"not_kept"' && finds ripple_peak_to_peak_Nm '0\.08'
tells 'the promise was not kept'
never_kept
printf 'order,amplitude_Nm,phase_rad\n6,0.05,0.8\n12,0.012,-0.5\n' >bench/cogging.csv

# ---- they, in so much noise that the ripple is not told

noise=400
record noisy 60 3 1.5 --currents out/currents
noise=5
name=noisy
run 0 diagnose --again out/diagnosed --runs list_noisy.csv -o again_noisy
tr -s ' \n' ' ' <"$work/stdout" >words
finds currents '"as_solved"' && finds promise '"not_told"'
never_kept

# ---- others

name=ahead
again 1 $name out/diagnosed
finds currents '"turned"' && finds promise '"not_judged"' && finds currents_rotation_rad '0\.(299[89]|300[01])' # three of its standard errors
tells 'not those that were solved: the table is read 17.1[89] degrees electrical ahead of the angle in the log'
tells 'hci-solve check out/diagnosed/machine runs/ahead.csv --table out/currents'
never_kept
"$hci_solve" check out/diagnosed/machine runs/ahead.csv --table out/currents >"$work/stdout"
check "the command that is named: $(head -n 1 "$work/stdout")" grep -q '17.1[89]' "$work/stdout"

name=small
again 0 $name out/diagnosed
finds currents '"another_size"' && finds promise '"not_judged"'
tells 'not those that were solved, but 0\.(799|8)[0-9]* times them'
never_kept

name=plain
again 0 $name out/diagnosed
finds currents '"others"' && finds promise '"not_judged"'
tells 'not those that were solved, as in a run without the table .* --table out/currents'
never_kept

# ---- none are known: no solution, one for another machine, one that was edited

mkdir alone
cp -R servo runs runs.csv list_played.csv smooth.csv alone
name=played
cd alone || exit 1
not_judged() { # WHY
    run 0 diagnose --again last --runs list_played.csv -o again_played
    tr -s ' \n' ' ' <"$work/stdout" >words
    tells "What was promised of currents was not judged: .*$1"
    finds solution '""' && finds currents '"not_known"'
    never_kept
}
run 0 diagnose servo --runs runs.csv -q -o last
not_judged 'none stand in LAST/solution'
run 0 solve servo --target smooth.csv --auto -q -o currents
not_judged 'those in currents were solved for another machine'
rm -r currents
cp -R ../out/currents currents
echo '17,pos,0.1,0' >>currents/currents.csv
not_judged 'it was edited'

# The solution within the diagnosis comes first.
run 0 diagnose servo --runs runs.csv --target smooth.csv -q -o within
run 0 diagnose --again within --runs list_played.csv -q -o again_played
finds solution '"within/solution"' && finds currents '"as_solved"' && finds promise '"kept"'

# ---- new recordings are read as all of last time were, unless they have not those columns

cd .. || exit 1
for f in idle light half played; do sed '1s/torque_Nm/mess/' "runs/$f.csv" >"runs/${f}_mess.csv"; done
printf 'file,role\nruns/idle_mess.csv,fit\nruns/light_mess.csv,fit\nruns/half_mess.csv,fit\n' >mess.csv
printf 'file,role\nruns/played_mess.csv,holdout\n' >list_mess.csv
run 0 diagnose servo --runs mess.csv --column torque_Nm=mess -q -o out/mess
name=mess
run 0 diagnose --again out/mess --runs list_mess.csv -o again_mess
tr -s ' \n' ' ' <"$work/stdout" >words
tells 'On 1 new recording the machine of last time was off by 0\.00'
check "how it was read" grep -q 'read as the recordings of last time: torque_Nm=mess' "$work/stderr"
run 0 diagnose --again out/mess --runs list_played.csv -o again_played_mess
tr -s ' \n' ' ' <"$work/stdout" >words
tells 'On 1 new recording the machine of last time was off by 0\.00'

finish
