#!/bin/sh
# `sweep`: words that belong together, lists, points that go on from where they were after an interruption, shares that join to the bytes of
# the whole, the same bytes with one process and with several, points without a result, and that a point is what `solve` gives.
#   cli_sweep.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
. "$1/tests/cli/small_machine.sh"
cd "$source_dir" || exit 1

fresh
printf 'resistance,0.3,ohm,test\ninductance_d,1.5,mH,test\ninductance_q,1.5,mH,test\n' >>"$m/machine.csv"
printf 'order,set\n1,pos\n5,neg\n7,pos\n11,neg\n13,pos\n' >"$h"

# ---- words that belong together

refused() { # EXPRESSION WORD...
    expression=$1
    shift
    run 2 sweep "$@" -o "$work/out"
    one_line_is_said
    says "$expression"
    check "something was written by $*" [ ! -e "$work/out" ]
}
refused 'expected --trade-off, --envelope, --map, or a GRID' "$m"
refused 'three sweeps; give one' "$m" --map --envelope
refused 'add --torque NM' "$m" --trade-off
refused 'one torque at one speed' "$m" --trade-off --torque 1 --speeds 100,200
refused 'add --speeds' "$m" --envelope --limit-current 5
refused 'looks for the torque' "$m" --envelope --speeds 100 --torques 1,2
refused 'add --torques NM,... and --speeds' "$m" --map --torques 1
refused '--ripple goes with --envelope' "$m" --map --torques 1 --speeds 100 --ripple 2
refused 'go with --trade-off' "$m" --envelope --speeds 100 --torque 1
refused 'takes the place of --torques' "$m" "$t" --torques 1
refused 'expected MACHINE, or MACHINE and a GRID' "$m" "$t" "$h" --map
refused 'give the limit in W' "$m" --envelope --speeds 0 --limit-copper 1.2x
no_link='no dc link is known that limits it at 100 rpm; add .*--limit-voltage V or, in machine.csv, `dc_link_voltage`'
refused "$no_link" "$m" --envelope --speeds 0,100 --limit-current 5
refused "$no_link" "$m" --map --torques 1 --speeds 100
refused "$no_link" "$m" --trade-off --torque 1 --speed 100
printf 'torque_Nm,speed_rpm\n1,100\n' >"$work/unlinked.csv"
refused "$no_link" "$m" "$work/unlinked.csv"
refused 'without --ignore-ratings' data/machine_c --map --torques 1 --speeds 100 --ignore-ratings
refused 'limited at a speed; add --speed RPM' "$m" --trade-off --torque 1 --limit-voltage 50
refused 'such as 3/16' "$m" --map --torques 1 --speeds 100 --shard 3
refused 'such as 3/16' "$m" --map --torques 1 --speeds 100 --shard 4/3
refused 'takes none; expected a torque above 0' "$m" --trade-off --torque 0
for list in '' ' ' 1,1 2,1 1:2 1:2:0 2:1:1 1:2:x nan 1,,2 1:1e9:1e-3 '1;2'; do
    refused '--torques: found .*expected ascending values' "$m" --map --torques "$list" --speeds 100
done
refused '--dc-links and --limit-voltage are both dc links' "$m" --map --torques 1 --speeds 100 --dc-links 50,100 --limit-voltage 24
printf 'torque_Nm,speed_rpm,dc_link_V\n1,300,40\n' >"$work/linked.csv"
refused 'dc_link_V of the GRID and --limit-voltage' "$m" "$work/linked.csv" --limit-voltage 24
run 2 sweep "$m" --map --torques 1 --speeds 100 --shard 1/2
says 'add --out FOLDER'
run 2 sweep "$m" --map --torques 1 --speeds 100 --report
says 'add --out FOLDER'

# ---- one run, several processes, shares

map="sweep $m --map --torques 0.5:2:0.5 --speeds 300,1500 --limit-current 12 --limit-voltage 40 --harmonics $h --report"
# shellcheck disable=SC2086
{
    run 0 $map --jobs 1 -o "$work/one"
    says '^swept: .*, map, 8 points' 'phase current at most 12 A; line voltage at most 40 V'
    check "files: $(ls -A "$work/one" | tr '\n' ' ')" [ "$(ls -A "$work/one" | tr '\n' ' ')" = "map.csv map.svg points.csv report.html summary.json sweep.csv " ]
    run 0 $map --jobs 3 --json -o "$work/three"
    check "--json differs from summary.json" cmp -s "$work/stdout" "$work/three/summary.json"
    run 0 $map --shard 1/3 -o "$work/share1"
    says '^3 of 8 points are done and kept in ' '--join'
    check "files: $(ls -A "$work/share1" | tr '\n' ' ')" [ "$(ls -A "$work/share1" | tr '\n' ' ')" = "points.csv sweep.csv " ]
    run 0 $map --shard 2/3 -q -o "$work/share2"
    nothing_on_stderr
    run 0 $map --shard 3/3 -q -o "$work/share3"
    run 0 $map --join "$work/share1" --join "$work/share2" --join "$work/share3" -q -o "$work/joined"
    run 0 $map --join "$work/share1" --join "$work/share2" -o "$work/lacking"
    says 'note: 2 of 8 points are in none of the folders that are joined, and are solved here'
}
# of the limits those that bind have a mark, and verdicts that no point has are not told
said=$(grep -o '>none<\|>current<\|>rms<\|>voltage<\|>copper<\|>several<' "$work/one/map.svg" | tr -d '<>' | sort | tr '\n' ' ')
bind=$(cut -d, -f16 "$work/one/points.csv" | sed '1d;s/.*+.*/several/;s/^$/none/' | sort -u | tr '\n' ' ')
check "marks of limits: $said, expected $bind" [ "$said" = "$bind" ]
check "verdicts of the points" grep -q '8 points: 8 with the smallest ripple there is\.' "$work/one/report.html"
for folder in three joined lacking; do
    check "$folder is not the whole" diff -r "$work/one" "$work/$folder"
done

# ---- one at a time in a folder

cp -R "$work/share1" "$work/held"
python3 -c 'import fcntl, os, sys, time
held = os.open(sys.argv[1], os.O_RDONLY)
fcntl.flock(held, fcntl.LOCK_EX)
open(sys.argv[2], "w").close()
time.sleep(60)' "$work/held" "$work/is_held" &
holder=$!
tries=0
while [ ! -e "$work/is_held" ] && [ $tries -lt 200 ]; do sleep 0.05 && tries=$((tries + 1)); done
# shellcheck disable=SC2086
run 5 $map --shard 2/3 -o "$work/held"
says 'another process works at the sweep there.*give each --shard its own --out'
kill $holder
wait $holder 2>/dev/null
check "points of another process were touched" diff -r "$work/share1" "$work/held"

# ---- gone on, and refused with other inputs; cli_sweep_interrupt.sh ends it

# shellcheck disable=SC2086
{
    run 0 $map --shard 1/4 -q -o "$work/again"
    rm "$work/again/sweep.csv"
    run 3 $map -q -o "$work/again"
    says 'sweep.csv: is not there' 'delete points.csv to begin anew'
    rm -r "$work/again"
    run 0 $map --shard 1/4 -q -o "$work/again"
    run 3 $map --ignore-ratings -q -o "$work/again"
    says '`ignore-ratings` was not given, and is yes; expected the same command'
    sed 's/,0.3,ohm/,0.4,ohm/' "$m/machine.csv" >"$work/other.csv" && cp "$m/machine.csv" "$work/own.csv" && cp "$work/other.csv" "$m/machine.csv"
    run 3 $map -q -o "$work/again"
    says '`machine.csv` was checksum'
    cp "$work/own.csv" "$m/machine.csv"
    run 0 $map -q -o "$work/again"
    rm "$work/again/map.csv"
    truncate -s -40 "$work/again/points.csv"
    run 0 $map -o "$work/again"
    says 'points.csv:[0-9]*: the row ends before its last column; it is left out, and solved again'
}
check "gone on is not the whole" diff -r "$work/one" "$work/again"

# ---- a point is what `solve` gives; a grid in a file

printf 'order,amplitude_Nm,phase_rad\n0,1.5,0\n' >"$t"
run 1 solve "$m" --target "$t" --harmonics "$h" --limit-current 12 --limit-voltage 40 --speed 1500 --json
awk -F: '/"peak_phase_A"|"peak_line_voltage_V"/ { gsub(/[ ,\t]/, "", $2); printf "%.14g\n", $2 }' "$work/stdout" | sort >"$work/solved"
awk -F, 'NR == 1 { for (k = 1; k <= NF; ++k) at[$k] = k } $1 == 1.5 && $2 == 1500 { printf "%.14g\n%.14g\n", $at["peak_phase_A"], $at["peak_line_V"] }' \
    "$work/one/map.csv" | sort >"$work/swept"
check "a point is not what solve gives: $(cat "$work/solved" "$work/swept" | tr '\n' ' ')" cmp -s "$work/solved" "$work/swept"
printf 'torque_mNm,speed_rpm,dc_link_V\n500,300,40\n1500,1500,40\n' >"$work/grid.csv"
run 0 sweep "$m" "$work/grid.csv" --limit-current 12 --harmonics "$h" -q -o "$work/grid"
check "a grid is not its points" [ "$(cut -d, -f4-8 "$work/grid/map.csv" | sed -n 3p)" = "$(grep '^1.5,1500,' "$work/one/map.csv" | cut -d, -f4-8)" ]
printf 'torque_Nm,speed_rpm,dc_link_V\n1,300,0\n' >"$work/grid.csv"
run 3 sweep "$m" "$work/grid.csv" --limit-current 12 -o "$work/out"
says 'grid.csv:2: .*a voltage above 0'

# ---- no result

grep -v '^inductance' "$work/own.csv" >"$m/machine.csv"
run 3 sweep "$m" --map --torques 1,2 --speeds 300 --limit-voltage 40 -o "$work/all_failed"
says 'machine.csv: .*inductance'
check "a sweep whose points all fail left a folder" [ ! -e "$work/all_failed" ]
run 0 sweep "$m" --map --torques 1,2 --speeds 300 --limit-voltage 40 --shard 1/2 -q -o "$work/failed_share"
check "a share whose points all fail is not kept" grep -q '^1,.*,failed,.*inductance' "$work/failed_share/points.csv"
cp "$work/own.csv" "$m/machine.csv"
run 3 sweep "$m" --envelope --speeds 0 -q
says 'limit-current'
run 0 sweep "$m" --envelope --speeds 300,1200 --ripple 60 --limit-current 12 --limit-voltage 40 --harmonics "$h" -o "$work/envelope"
says "any  ripple %      sine  ripple %  binds"
says 'envelope, 2 points' '^ +300 rpm +[0-9.]+ +[0-9.]+ +[0-9.]+ +[0-9.]+ +[0-9.]+'

# ---- an envelope makes the swing smallest that it limits, and is not below a plain sine that has as little ripple

cell() { # COLUMN FILE: of the first row
    awk -F, -v name="$1" 'NR == 1 { for (k = 1; k <= NF; ++k) if ($k == name) at = k } NR == 2 { print $at }' "$2"
}
run 0 sweep data/machine_a --envelope --ripple 40 --speeds 0 --limit-current 20 --harmonics "$h" -o "$work/swing"
says 'largest mean torque found' 'with these 5 components; others may make more'
run 0 sweep data/machine_a --envelope --ripple 40 --speeds 0 --limit-current 20 --harmonics "$h" --minimise worst -q -o "$work/worst"
check "the swing is not made smallest: $(cell mean_Nm "$work/swing/envelope.csv") N·m" \
    awk -v a="$(cell mean_Nm "$work/swing/envelope.csv")" -v b="$(cell mean_Nm "$work/worst/envelope.csv")" 'BEGIN { exit !(a > 1.1 * b) }'
cp -R "$m" "$work/interior"
printf '%s\n' name,value,unit,source pole_pairs,4,1,t emf_frequency,66.6666666666667,Hz,t connection,star,,t resistance,0.02,ohm,t \
    dc_link_voltage,320,V,t >"$work/interior/machine.csv"
printf 'order,amplitude_V,phase_rad\n1,29.3215314335047,0\n' >"$work/interior/back_emf.csv"
printf '%s\n' "$header" >"$work/interior/cogging.csv"
awk 'function c(of) { return cos(2 * t + of) / 1e4 } BEGIN { print "theta_e_rad,La_H,Lb_H,Lc_H,Mab_H,Mbc_H,Mca_H"; third = atan2(0, -1) / 1.5
    for (k = 0; k < 36; ++k) { t = k * third / 12; s = 7e-4 / 3
        printf "%.12g,%.12g,%.12g,%.12g,%.12g,%.12g,%.12g\n", t, s - c(0), s - c(third), s - c(-third), -s / 2 - c(-third), -s / 2 - c(0), -s / 2 - c(third) } }' \
    >"$work/interior/inductance.csv"
printf 'order,set\n1,pos\n5,neg\n7,pos\n' >"$work/three.csv"
run 0 sweep "$work/interior" --envelope --ripple 0 --speeds 3500 --limit-current 260 --harmonics "$work/three.csv" -q -o "$work/bound"
check "$(cell mean_Nm "$work/bound/envelope.csv") N·m is below the plain sine" \
    awk -v a="$(cell mean_Nm "$work/bound/envelope.csv")" -v b="$(cell sine_mean_Nm "$work/bound/envelope.csv")" 'BEGIN { exit !(a >= b && b > 140) }'

# ---- what remains

run 0 sweep "$m" --trade-off --torque 1 --currents 5,8 --coppers 1.1 --harmonics "$h" -o "$work/trade_off"
says 'trade-off, 3 points' 'plain sine' 'least limit of the phase current'

finish
