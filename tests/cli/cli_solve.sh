#!/bin/sh
# What `solve` writes: files, headers, numbers, exit codes; the promised torque against a recomputation from the currents.
#   cli_solve.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
recompute=$source_dir/tests/cli/recompute.awk
cd "$source_dir" || exit 1

python3 -c '' 2>/dev/null && has_python=yes || has_python=no

files_are() { # FOLDER NAME...: these and no others, hidden ones included
    folder=$1
    shift
    check "files of $folder: $(ls -A "$folder" | tr '\n' ' ')" [ "$(ls -A "$folder")" = "$(printf '%s\n' "$@" | sort)" ]
}

# The columns of formats.md; more may follow them.
header_is() { # FILE COLUMNS
    case $(head -n 1 "$1") in
        "$2" | "$2",*) check "" true ;;
        *) check "header of $1: $(head -n 1 "$1")" false ;;
    esac
}

# Each cell after the header is a plain finite number, or a word where the column holds words; LF ends each line.
numbers_are_plain() { # FILE
    check "carriage return in $1" eval "! grep -q \"\$(printf '\\r')\" '$1'"
    check "no newline at the end of $1" [ -z "$(tail -c 1 "$1" | tr -d '\n')" ]
    awk -F, 'NR == 1 { columns = NF; next }
        NF != columns { print "row " NR ": " NF " cells"; bad = 1 }
        { for (k = 1; k <= NF; k++) if ($k !~ /^-?[0-9]+(\.[0-9]+)?(e[-+]?[0-9]+)?$/ && $k !~ /^(pos|neg|sym|asym|zero|reached|free|missed|parasitic|unreachable)$/) { print "row " NR ": " $k; bad = 1 } }
        END { exit bad || NR < 2 }' "$1"
    check "numbers of $1" [ $? -eq 0 ]
    [ $has_python = no ] || check "a number of $1 is not the shortest text" python3 -c '
import re, sys
cells = [c for line in open(sys.argv[1]) for c in line.strip().split(",") if re.match(r"-?[0-9.]+(e[-+]?\d+)?$", c)]
digits = lambda text: len(re.sub(r"e.*", "", text).replace("-", "").replace(".", "").strip("0"))
sys.exit(any(digits(c) > digits(repr(float(c))) for c in cells))' "$1"
}

tables_are_right() { # FOLDER
    header_is "$1/currents.csv" order,set,amplitude_A,phase_rad
    header_is "$1/waveform.csv" theta_e_rad,ia_A,ib_A,ic_A,id_A,iq_A,torque_Nm
    header_is "$1/spectrum.csv" order,target_Nm,target_phase_rad,torque_Nm,torque_phase_rad,error_Nm
    for table in currents waveform spectrum; do numbers_are_plain "$1/$table.csv"; done
    check "solution.svg has no end" [ "$(tail -c 7 "$1/solution.svg")" = '</svg>' ]
}

torque_is_right() { # FOLDER MACHINE TARGET MEAN TURNS HELD [SCALE]: 1e-6 of SCALE, else of the mean, counts as reached
    awk -v turns="$5" -v held="$6" -v mean="$4" -f "$recompute" "$2/machine.csv" "$2/back_emf.csv" "$2/cogging.csv" "$3" \
        "$1/currents.csv" "$1/spectrum.csv" "$1/waveform.csv" >"$work/wrong" 2>"$work/worst"
    check "recomputed: $(head -n 3 "$work/wrong")" [ $? -eq 0 ]
    worst=$(sed -n 's/^worst //p' "$work/worst")
    check "worst order off by $worst N·m but exit code $code" \
        awk -v worst="$worst" -v scale="${7:-$4}" -v code="$code" 'BEGIN { exit (worst <= 1e-6 * scale) != (code == 0) }'
    [ $has_python = no ] || check "summary.json says otherwise" python3 -c '
import json, sys
s = json.load(open(sys.argv[1]))
worst, code = map(float, sys.argv[2:])
sys.exit(not (s["reached"] == (code == 0) and abs(s["torque"]["worst_error_Nm"] - worst) < 1e-9 and s["command"] == "solve"))' \
        "$1/summary.json" "$worst" "$code"
}

linear="currents_constant.csv currents_per_Nm.csv"
mean=2.462900341 # the mean of every target in data/

# ---- a set that is chosen

target=data/scenarios/02/target.csv
run 0 solve data/machine_a --target $target --auto -o "$work/auto"
says '^reached: data/machine_a, data/scenarios/02/target.csv$' 'mean 2.4629 N·m' 'copper loss'
files_are "$work/auto" currents.csv $linear solution.svg spectrum.csv summary.json waveform.csv
tables_are_right "$work/auto"
torque_is_right "$work/auto" data/machine_a $target $mean 1 ''
header_is "$work/auto/currents_per_Nm.csv" order,set,amplitude_A_per_Nm,phase_rad
header_is "$work/auto/currents_constant.csv" order,set,amplitude_A,phase_rad
awk -F, -v mean=$mean 'FNR == 1 { file++; next }
    file == 1 { s[FNR] = mean * $3 * cos($4); c[FNR] = mean * $3 * sin($4) }
    file == 2 { s[FNR] += $3 * cos($4); c[FNR] += $3 * sin($4) }
    file == 3 { d = (s[FNR] - $3 * cos($4)) ^ 2 + (c[FNR] - $3 * sin($4)) ^ 2; if (d > 1e-18) bad = 1; rows++ }
    END { exit bad || !rows }' "$work/auto/currents_per_Nm.csv" "$work/auto/currents_constant.csv" "$work/auto/currents.csv"
check "currents.csv is not mean × per_Nm + constant" [ $? -eq 0 ]

# ---- the published set with a held fundamental: not reached, and everything is written all the same

target=data/scenarios/07/target.csv
run 1 solve data/machine_a --target $target --harmonics data/scenarios/07/harmonics.csv --fundamental 12,0.2 -o "$work/held"
says '^not reached' 'unreachable +no component of the set reaches: order 5 off by 3 N·m \((pos|neg) [0-9]+ would reach it\)'
files_are "$work/held" currents.csv solution.svg spectrum.csv summary.json waveform.csv
tables_are_right "$work/held"
torque_is_right "$work/held" data/machine_a $target $mean 1 12,0.2
awk -F, 'NR == 2 { exit !($1 == 1 && $2 == "pos" && $3 == 12 && ($4 - 0.2) ^ 2 < 1e-30) }' "$work/held/currents.csv"
check "the held fundamental is not first" [ $? -eq 0 ]
check "order 5 is not unreachable" grep -Eq '^5(\.0)?,.*,unreachable$' "$work/held/spectrum.csv"

# ---- the remedy that it names is one: with it the torque is reached

remedy=$(sed -n 's/.*(\([a-z]*\) \([0-9]*\) would reach it).*/\2,\1/p' "$work/stdout")
{ cat data/scenarios/07/harmonics.csv; echo "$remedy"; } >"$work/with_remedy.csv"
run 1 solve data/machine_a --target $target --harmonics "$work/with_remedy.csv" --fundamental 12,0.2
check "order 5 is unreachable with $remedy too" eval "! grep -q 'unreachable.* order 5 ' '$work/stdout'"

# ---- another machine, a fractional order, a pointwise current

run 0 solve data/machine_b --target data/scenarios/12/target.csv --auto --quiet -o "$work/b"
torque_is_right "$work/b" data/machine_b data/scenarios/12/target.csv $mean 1 ''
printf 'order,amplitude_Nm,phase_rad\n0,2,0\n0.5,0.3,0\n4.5,0.4,1\n' >"$work/target.csv"
run 0 solve data/machine_a --target "$work/target.csv" --quiet -o "$work/fractional"
torque_is_right "$work/fractional" data/machine_a "$work/target.csv" 2 2 ''
check "the period is not two turns" grep -q '"period_electrical_turns":[[:space:]]*2,' "$work/fractional/summary.json"

# ---- within limits: the currents that are written keep them, and the words and the page say what they cost

target=data/scenarios/02/target.csv
run 1 solve data/machine_a --target $target --auto --limit-current 17 --report -o "$work/within"
says 'limits       kept; the largest order of the ripple is the smallest within them' 'limit        phase current 17 of 17 A; 1 A more: 0\.0[0-9]* N·m less ripple' 'touched at a '
check "a phase has more than 17 A" awk -F, 'NR > 1 { for (k = 2; k <= 4; k++) if ($k > 17 || $k < -17) exit 1 }' "$work/within/waveform.csv"
check "no section of limits" grep -q '<h2>The limits cost smoothness' "$work/within/report.html"
check "the summary does not say what limits cost" grep -q '"cost":[[:space:]]*"ripple"' "$work/within/summary.json"
check "there are currents per N·m" [ ! -e "$work/within/currents_per_Nm.csv" ]
run 1 solve data/machine_a --target $target --auto --limit-current a=0 -o "$work/open"
check "phase a has current" awk -F, 'NR > 1 && ($2 > 1e-9 || $2 < -1e-9) { exit 1 }' "$work/open/waveform.csv"
run 0 solve data/machine_a --target $target --auto --limit-current 24.5 --quiet -o "$work/wide"
check "a limit that is kept anyhow changes the currents" cmp "$work/wide/currents.csv" "$work/auto/currents.csv"

# ---- a wish that is not cared for

printf 'order,amplitude_Nm,phase_rad,weight\n0,%s,0,1\n5,3,0,0\n' $mean >"$work/free.csv"
run 0 solve data/machine_a --target "$work/free.csv" --harmonics data/scenarios/07/harmonics.csv --quiet -o "$work/free"
check "order 5 is not free" grep -Eq '^5(\.0)?,.*,free$' "$work/free/spectrum.csv"

# ---- no mean torque: nothing to compare the copper loss with but the limit

printf 'order,amplitude_Nm,phase_rad\n0,0,0\n6,0.1,0\n' >"$work/target.csv"
run 0 solve data/machine_a --target "$work/target.csv" -o "$work/no_mean"
says 'copper loss  ([0-9.]+ % above |)the least that the wanted torque takes$'
torque_is_right "$work/no_mean" data/machine_a "$work/target.csv" 0 1 '' 0.3702 # the largest cogging order
check "there is a plain fundamental" grep -q '"plain_amplitude_A":[[:space:]]*0,' "$work/no_mean/summary.json"

# ---- same input, same bytes: another folder, another time zone and locale, over older results, beside other output

target=data/scenarios/02/target.csv
for again in 1 2; do
    TZ=Asia/Tokyo LC_ALL=de_DE.UTF-8 "$hci_solve" solve ./data/machine_a --target "$source_dir/$target" --auto --json \
        -o "$work/deep/er/again/" >"$work/json" 2>/dev/null
    check "run $again gave other bytes" diff -r "$work/auto" "$work/deep/er/again"
done
check "a path is in the results" eval "! grep -rqF -e '$work' -e '$source_dir' -e data/machine_a '$work/auto'"
run 1 solve data/machine_a --target data/scenarios/07/target.csv --harmonics data/scenarios/07/harmonics.csv \
    --fundamental 12,0.2 --quiet -o "$work/deep/er/again"
for table in "$work"/held/*; do
    check "$table was not replaced" cmp -s "$table" "$work/deep/er/again/${table##*/}"
done

# ---- words to standard error, data to standard output

run 0 solve data/machine_a --target $target --auto --json -o "$work/auto"
check "--json differs from summary.json" cmp -s "$work/stdout" "$work/auto/summary.json"
nothing_on_stderr
run 0 solve data/machine_a --target $target --auto --json --quiet -o "$work/auto"
check "--json differs with --quiet" cmp -s "$work/stdout" "$work/auto/summary.json"
nothing_on_stderr
[ $has_python = no ] || check "not JSON" python3 -c 'import json, sys; json.load(open(sys.argv[1]))' "$work/stdout"
run 0 solve data/machine_a --target $target --auto --quiet
nothing_on_stdout
nothing_on_stderr
run 1 solve data/machine_a --target data/scenarios/07/target.csv --harmonics data/scenarios/07/harmonics.csv --quiet
nothing_on_stdout
nothing_on_stderr
check "colours or a progress bar in a file" eval "! grep -rq \"\$(printf '\\033')\" '$work/auto'"

# ---- what a current loop makes of the currents: ten times as fast, ten times the speed

run 0 solve data/machine_a --target $target --auto --bandwidth 100 -o "$work/auto100"
says 'a current loop of 100 Hz adds no more than 0.38 N·m, a tenth of' '16 rpm'
run 0 solve data/machine_a --target $target --auto --bandwidth 1000 --speed 160 -o "$work/auto1000"
says 'at 160 rpm a current loop of 1000 Hz adds 0.3[0-9]* N·m from peak to peak'
run 2 tune nothing.csv --pole-pairs 2 --kv 39 --speed 300 -o "$work/never"
says '--speed is the speed at which a current loop is asked for; add --bandwidth HZ'

# ---- without --out nothing is written; a relative --out is below the working folder

mkdir "$work/empty" && cd "$work/empty" || exit 1
run 0 solve "$source_dir/data/machine_a" --target "$source_dir/$target" --auto --json
check "written without --out: $(ls -A)" [ -z "$(ls -A)" ]
run 0 solve "$source_dir/data/machine_a" --target "$source_dir/$target" --auto -q -o .
check "-o . is not here" diff -r "$work/auto" .

finish
