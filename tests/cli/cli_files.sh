#!/bin/sh
# labels: docs
# docs/files.md against the program: the columns of each file that is written, the keys of each summary, and each example read.
# (The table of foreign names is compared with that of the program in test_csv_foreign.c.)
#   cli_files.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
cd "$source_dir" || exit 1
page=docs/files.md

# ---- the page

# section HEADING: its lines up to the next heading.
section() {
    awk -v wanted="### $1" '/^##/ { inside = $0 == wanted; next } inside' "$page"
}

# columns HEADING: a line for each column of the section's first table: optional or needed, then its names.
columns() {
    section "$1" | awk '/^\| `/ { split($0, cell, "|"); line = cell[2] ~ / optional / ? "optional" : "needed"
            count = split(cell[2], part, "`"); for (k = 2; k <= count; k += 2) line = line " " part[k]; print line; seen = 1; next }
        seen { exit }'
}

example() {
    section "$1" | awk '/^```csv/ { inside = 1; next } /^```/ { if (inside) exit } inside'
}

header() {
    grep -v '^#' "$1" | head -n 1
}

# fits HEADER HEADING: the names of a header row are the columns of the section, in their order.
fits() {
    columns "$2" | awk -v names="$1" '
        { kind[NR] = $1; for (k = 2; k <= NF; ++k) is[NR, $k] = 1 }
        END { count = split(names, name, ","); row = 1
            if (NR == 0) exit 1
            for (k = 1; k <= count; ++k) { while (row <= NR && !((row, name[k]) in is)) if (kind[row++] != "optional") exit 1
                if (row++ > NR) exit 1 }
            while (row <= NR) if (kind[row++] != "optional") exit 1 }'
}

# written FILE HEADING: the file is there, with the columns of the page; so is the example, if its units are those.
written() {
    checks=$((checks + 1))
    if [ ! -s "$1" ]; then
        fail "$2: no file $1"
    elif ! fits "$(header "$1")" "$2"; then
        fail "$2: the page has other columns than $(header "$1")"
    fi
}

# named JSON HEADING: the fields of the page are those of the summary; every key within is named.
named() {
    checks=$((checks + 1))
    awk '/^\t"/ { split($0, part, "\""); print part[2] }' "$1" | grep -vx -e command -e version -e checksums >"$work/keys"
    columns "$2" | awk -v keys="$(tr '\n' ' ' <"$work/keys")" '
        { listed[$2] = 1; if ($1 == "needed" && index(" " keys, " " $2 " ") == 0) { print "not written: " $2; bad = 1 } }
        END { n = split(keys, key, " "); for (k = 1; k <= n; ++k) if (!(key[k] in listed)) { print "not listed: " key[k]; bad = 1 }; exit bad }' \
        >"$work/stderr" || fail "$2: fields"
    section "$2" >"$work/section"
    for key in $(grep -o '"[A-Za-z0-9_]*":' "$1" | tr -d '":' | sort -u); do
        case $key in command | version | checksums | *.*) continue ;; esac
        checks=$((checks + 1))
        grep -q "\`$key\`" "$work/section" || fail "$2: $key is not named"
    done
}

# ---- each example is read again

m=$work/machine
mkdir -p "$m" "$work/interior" "$work/runs"
for file in machine.csv back_emf.csv cogging.csv; do
    example "\`$file\`" | tee "$m/$file" >"$work/interior/$file"
    check "no example of $file" [ -s "$m/$file" ]
done
example '`effects.csv` of a machine' >"$m/effects.csv"
example '`inductance.csv`' >"$work/interior/inductance.csv"
example '`target.csv`' >"$work/target.csv"
example '`harmonics.csv`' >"$work/harmonics.csv"
example '`scenario.csv`' >"$work/scenario.csv"
example '`runs.csv`' >"$work/runs.csv"
example 'A run' >"$work/run.csv"
for name in currents.csv currents_per_Nm.csv currents_constant.csv waveform.csv trajectory.csv; do
    mkdir -p "$work/solution"
    example "\`$name\`" >"$work/solution/$name"
    check "the example of $name has other columns" fits "$(header "$work/solution/$name")" "\`$name\`"
done

example '`spectrum.csv` of solve' >"$work/solution/spectrum.csv"

run 1 solve "$m" --target "$work/target.csv" --harmonics "$work/harmonics.csv" -q -o "$work/by_set" # three components do not reach it
run 0 solve "$work/interior" --target "$work/target.csv" --auto -q -o "$work/by_auto"
run 0 predict "$m" "$work/run.csv" --json -q -o "$work/predicted.csv"
nothing_on_stderr
named "$work/stdout" 'summary.json of predict'
run 0 simulate "$m" "$work/scenario.csv" -q -o "$work/simulated"
printf 'name,value,unit\nduration,40,ms\nprescribed_speed,1500,rpm\n' >"$work/imposed.csv"
run 0 simulate "$m" "$work/imposed.csv" --currents "$work/solution/currents.csv" -q -o "$work/imposed"
{ cat "$work/imposed.csv"; echo torque_reference,2,Nm; } >"$work/scaled.csv"
run 0 simulate "$m" "$work/scaled.csv" --currents "$work/solution" -q -o "$work/scaled"
run 0 emit "$work/solution" --name page -q -o "$work/emitted"
run 0 emit "$work/solution" --name page --per-torque -q -o "$work/emitted"
example '`drive.csv`' >"$work/drive.csv"
example '`loop.csv`' >"$work/loop.csv"
sed '/^current_kp\|^current_ki/d; $a response,loop.csv,' "$work/drive.csv" >"$work/measured.csv"
run 0 emit "$work/solution" --name drive --machine "$m" --drive "$work/measured.csv" --per-torque -q -o "$work/for_drive"
check "loop.csv is not in what is emitted" grep -q 'drive_responses\[[0-9]*\]' "$work/for_drive/drive.c"
run 0 predict "$m" "$work/solution/trajectory.csv"
run 0 predict "$m" "$work/solution/waveform.csv"
for heading in '`spectrum.csv` of solve' '`spectrum.csv` of simulate' '`effects.csv` of diagnose' '`errors.csv`' '`residual_spectrum.csv`' '`unexplained.csv`' '`measure_next.csv`'; do
    example "$heading" >"$work/example.csv"
    check "the example of $heading has other columns: $(header "$work/example.csv")" fits "$(header "$work/example.csv")" "$heading"
done

# ---- solve

run 0 solve data/machine_a --target data/scenarios/02/target.csv --auto --report -q -o "$work/solve"
written "$work/solve/currents.csv" '`currents.csv`'
written "$work/solve/currents_per_Nm.csv" '`currents_per_Nm.csv`'
written "$work/solve/currents_constant.csv" '`currents_constant.csv`'
written "$work/solve/waveform.csv" '`waveform.csv`'
written "$work/solve/spectrum.csv" '`spectrum.csv` of solve'
named "$work/solve/summary.json" 'summary.json of solve'
named "$work/by_set/summary.json" 'summary.json of solve' # with orders that are missed

# ---- simulate: with and without voltages, sensors, a set point

sed 's/^duration,0.4,/duration,0.12,/' data/drive/driven.csv >"$work/driven.csv"
run 0 simulate data/machine_a "$work/driven.csv" -q -o "$work/driven"
for folder in simulated imposed scaled driven; do
    written "$work/$folder/trajectory.csv" '`trajectory.csv`'
    written "$work/$folder/spectrum.csv" '`spectrum.csv` of simulate'
    named "$work/$folder/summary.json" 'summary.json of simulate'
done

example '`speeds.csv`' >"$work/example.csv"
check "the example of speeds.csv has other columns" fits "$(header "$work/example.csv")" '`speeds.csv`'
run 0 simulate data/machine_a --table "$work/solve" --drive data/drive/machine_a_10kHz.csv --speeds 300,600 -q -o "$work/speeds"
written "$work/speeds/speeds.csv" '`speeds.csv`'
named "$work/speeds/summary.json" 'summary.json of simulate --table'

# ---- sweep

for name in trade_off.csv envelope.csv map.csv points.csv sweep.csv; do
    example "\`$name\`" >"$work/example.csv"
    check "the example of $name has other columns" fits "$(header "$work/example.csv")" "\`$name\`"
done
example 'A grid' >"$work/grid.csv"
check "the example of a grid: $(header "$work/grid.csv")" [ "$(sed -n 2p "$work/grid.csv")" ]
sweep="sweep $m --limit-current 12 --harmonics $work/harmonics.csv -q"
# shellcheck disable=SC2086
{
    run 0 $sweep --trade-off --torque 1 --currents 4,8 --coppers 1.2 -o "$work/sweep_trade_off"
    run 0 $sweep --envelope --speeds 0 --ripple 500 --report -o "$work/sweep_envelope"
    run 0 $sweep --map --torques 1 --speeds 0 -o "$work/sweep_map"
    run 3 $sweep "$work/grid.csv" -o "$work/by_grid" # read, but there is no inductance
    says 'inductance'
}
for kind in trade_off envelope map; do
    written "$work/sweep_$kind/$kind.csv" "\`$kind.csv\`"
    written "$work/sweep_$kind/points.csv" '`points.csv`'
    written "$work/sweep_$kind/sweep.csv" '`sweep.csv`'
    named "$work/sweep_$kind/summary.json" "summary.json of sweep --$(echo $kind | tr _ -)"
done

# ---- batch

example '`motors.csv`' >"$work/example.csv"
check "the example of motors.csv has other columns" fits "$(header "$work/example.csv")" '`motors.csv`'
run 0 batch data/fleet/motors.csv --command solve -o "$work/batch" -q
written "$work/batch/fleet.csv" '`fleet.csv` of solve'
named "$work/batch/summary.json" 'summary.json of batch'
printf 'motor,machine,runs,logs\nnone,none,none,none\n' >"$work/motors.csv"
for command in fit diagnose tune; do
    run 1 batch "$work/motors.csv" --command $command -o "$work/batch_$command" -q
    written "$work/batch_$command/fleet.csv" "\`fleet.csv\` of $command"
done

run 0 fit data/fem_c/machine --runs data/fem_c/runs.csv -o "$work/fitted" -q
written "$work/fitted/parameters.csv" '`parameters.csv`'
named "$work/fitted/summary.json" 'summary.json of fit'

run 0 fleet "$work/batch_fit" -q -o "$work/line"
header "$work/line/deviations.csv" >"$work/line/header"
written "$work/line/line.csv" '`line.csv`'
check "deviations.csv: $(cat "$work/line/header")" grep -q "^$(columns '`deviations.csv`' | cut -d ' ' -f 2 | paste -s -d ,)" "$work/line/header"
named "$work/line/summary.json" 'summary.json of fleet'

# ---- harmonics and predict

run 0 harmonics "$work/driven/trajectory.csv" --quantity cogging --pole-pairs 2 --json -q -o "$work/table"
named "$work/stdout" 'summary.json of harmonics'
written "$work/table/cogging.csv" '`cogging.csv`'
awk 'BEGIN { p = 8 * atan2(1, 1); print "time_s,va_V,vb_V,vc_V"
    for (k = 0; k < 2000; ++k) { t = k / 20000; printf "%.6f", t; for (s = 0; s < 3; ++s) printf ",%.9f", 5 * sin(p * 40 * t - s * p / 3); print "" } }' >"$work/volts.csv"
run 0 harmonics "$work/volts.csv" --quantity back_emf --pole-pairs 4 --json -q -o "$work/table"
named "$work/stdout" 'summary.json of harmonics'
written "$work/table/back_emf.csv" '`back_emf.csv`'
own=$(header "$work/run.csv")
added=$(header "$work/predicted.csv")
check "the run's own columns come first" [ "${added#"$own",}" != "$added" ]
check "the prediction: ${added#"$own",}" fits "${added#"$own",}" 'The run with its prediction'
example 'The run with its prediction' >"$work/example.csv"
run 0 predict "$m" "$work/example.csv" -q -o "$work/again.csv"
check "a prediction is not replaced" [ "$(header "$work/again.csv")" = "$(header "$work/example.csv")" ]

# ---- diagnose: the runs that the page's list names, from a plant with friction and an offset

for name in slow fast held_out; do
    case $name in slow) figures='400 2' ;; fast) figures='900 1' ;; *) figures='700 1.5' ;; esac
    # shellcheck disable=SC2086
    set -- $figures
    printf 'name,value,unit\nduration,0.2,s\nprescribed_speed,%s,rpm\ntorque_reference,%s,Nm\ntrajectory_every,20,\ntorque_noise,2,mNm\nseed,%s,\n' "$1" "$2" "$1" >"$work/$name.csv"
    run 0 simulate "$m" "$work/$name.csv" -q -o "$work/plant"
    cp "$work/plant/trajectory.csv" "$work/runs/$name.csv"
done
mkdir "$work/declared"
cp "$m/machine.csv" "$m/back_emf.csv" "$m/cogging.csv" "$work/declared"
shown="hci-solve diagnose"
"$hci_solve" diagnose "$work/declared" --runs "$work/runs.csv" --target "$work/target.csv" -q -o "$work/diagnosed" >"$work/stdout" 2>"$work/stderr"
check "diagnose: exit code $?" [ $? -le 1 ]
written "$work/diagnosed/effects.csv" '`effects.csv` of diagnose'
written "$work/diagnosed/errors.csv" '`errors.csv`'
written "$work/diagnosed/residual_spectrum.csv" '`residual_spectrum.csv`'
written "$work/diagnosed/machine/machine.csv" '`machine.csv`'
written "$work/diagnosed/machine/effects.csv" '`effects.csv` of a machine'
[ ! -e "$work/diagnosed/measure_next.csv" ] || written "$work/diagnosed/measure_next.csv" '`measure_next.csv`'
[ ! -e "$work/diagnosed/unexplained.csv" ] || written "$work/diagnosed/unexplained.csv" '`unexplained.csv`'
named "$work/diagnosed/summary.json" 'summary.json of diagnose'
written "$work/diagnosed/declared/runs.csv" '`runs.csv`'
sed '/held_out/d' "$work/runs.csv" >"$work/first.csv"
sed '1p;/held_out/!d' "$work/runs.csv" >"$work/later.csv"
"$hci_solve" diagnose "$work/declared" --runs "$work/first.csv" -q -o "$work/round1" >"$work/stdout" 2>"$work/stderr"
"$hci_solve" diagnose --again "$work/round1" --runs "$work/later.csv" -q -o "$work/round2" >"$work/stdout" 2>"$work/stderr"
check "diagnose --again: exit code $?" [ $? -le 1 ]
named "$work/round2/summary.json" 'summary.json of diagnose'

# ---- check

sed 's/^1,21.93/1,37.98/' "$m/back_emf.csv" >"$work/declared/back_emf.csv" # line for phase voltage
run 1 check "$work/declared" "$work/runs/slow.csv" -q -o "$work/checked"
named "$work/checked/summary.json" 'summary.json of check'
run 0 check data/machine_a "$work/solve/waveform.csv" --table "$work/solve" --json -q
named "$work/stdout" 'summary.json of check --table'

# ---- emit and init

run 0 emit "$work/solve" --name page --json -q -o "$work/emitted"
named "$work/stdout" 'summary.json of emit'
run 0 emit "$work/solve" --name page --machine data/machine_a --drive data/drive/machine_a_10kHz.csv --json -q -o "$work/emitted"
named "$work/stdout" 'summary.json of emit --drive'
run 0 emit data/example_currents/currents.csv --name map --machine data/machine_a --for moteus -o "$work/map" --json
named "$work/stdout" 'summary.json of emit --for'
run 0 init "$work/first" --pole-pairs 7 --kv 400 --slots 12 --json -q
named "$work/stdout" 'summary.json of init'
run 0 export-fmu "$work/first" --inputs currents --sources-only -o "$work/first.fmu" --json -q
named "$work/stdout" 'summary.json of export-fmu'
for file in machine.csv back_emf.csv; do
    written "$work/first/$file" "\`$file\`"
done

# ---- no file is written that the page does not name

for file in $(cd "$work" && find solve sweep_trade_off sweep_envelope sweep_map fitted driven speeds diagnosed first emitted -type f | sed 's#.*/##' | sort -u); do
    case $file in
        page.h | page.c) file=ID.${file#page.} ;;
    esac
    check "$file is not on the page" grep -q -e "\`$file\`" -e "## $file" "$page"
done

finish
