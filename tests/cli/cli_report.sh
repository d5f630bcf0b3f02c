#!/bin/sh
# report.html of `diagnose`, `solve` and `simulate`: there when it is asked for, with the numbers of the tables beside it, alone.
#   cli_report.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
cd "$source_dir" || exit 1

# column FILE K [K...]: numbers of columns of a table, one a line; names are in quotes where they hold a comma.
column() {
    file=$1
    shift
    for k; do
        sed -e '/^#/d' -e 's/^"[^"]*"/NAME/' "$file" | awk -F, -v k="$k" 'FNR > 1 && $k != "" { print $k }'
    done
}
# holds PAGE: every one of the numbers, of which there are some, is in a table of the page to the last digit.
holds() {
    check "no numbers" [ -s "$work/numbers" ]
    while read -r number; do
        checks=$((checks + 1))
        grep -Fq "<data value=\"$number\">" "$1" || fail "$1 lacks $number"
    done <"$work/numbers"
}
alone() { # PAGE
    check "no page $1" [ -s "$1" ]
    check "a path of this machine" [ "$(grep -c -F -e "$work" -e "$source_dir" "$1")" -eq 0 ]
    check "something from elsewhere" [ "$(sed 's|http://www.w3.org/2000/svg||g' "$1" | grep -c -i -e '://' -e '<script' -e 'src=' -e 'url(')" -eq 0 ]
    pictures=$(grep -c '<svg ' "$1")
    check "pictures without a title" [ "$pictures" -gt 0 ] && [ "$(grep -c '^<title id=' "$1")" -eq "$pictures" ]
    ! command -v xmllint >/dev/null || check "not well-formed" xmllint --noout "$1"
}

# ---- diagnose writes it always: a machine without the cogging that its recordings have

mkdir -p "$work/bench/machine" "$work/bench/runs"
cd "$work/bench" || exit 1
printf 'name,value,unit,source\npole_pairs,2,1,test\n' >machine/machine.csv
printf 'order,amplitude_Nm_per_A,phase_rad\n1,0.2,0\n' >machine/back_emf.csv
measure() { # FILE CURRENT SPEED
    awk -v i="$2" -v w="$3" 'BEGIN { srand(7); print "time_s,theta_m_rad,speed_rad_per_s,id_A,iq_A,torque_Nm"; p = 6.283185307179586
        for (k = 0; k < 500; ++k) { a = p * k * 3 / 500
            n = 0.004 * sqrt(-2 * log(1 - rand())) * cos(p * rand())
            printf "%.12g,%.12g,%g,0,%g,%.12g\n", a / w, a, w, i, 1.5 * 0.2 * i + 0.05 * sin(12 * a + 0.3) + n } }' >"$1"
}
hostile='<b>&,.csv'
measure runs/1.csv 1 20 && measure runs/2.csv 4 35 && measure "runs/$hostile" 2 27 && measure runs/4.csv 3 50
printf 'file,role\nruns/1.csv,fit\nruns/2.csv,fit\n"runs/%s",holdout\nruns/4.csv,fit\n' "$hostile" >runs.csv
run 0 diagnose machine --runs runs.csv -q -o out
alone out/report.html
check "the name of a run is not escaped" grep -q 'runs/&#60;b&#62;&#38;,.csv' out/report.html
check "no machine" grep -q 'Machine: machine<' out/report.html
check "no list of runs" grep -q 'List of runs: runs.csv<' out/report.html
check "figures do not say what they were made from" [ "$(grep -c 'Made from: machine, runs.csv\.' out/report.html)" -eq "$(grep -c '<figure>' out/report.html)" ]
check "cogging was not found" grep -q '^1,cogging,added,' out/effects.csv
check "the verdict is not that of the summary" grep -q 'The model lacked cogging' out/report.html
check "a fall of 0 that nobody computed" [ "$(grep -c ',rejected,0,' out/effects.csv)" -eq 0 ]
check "nothing was rejected" grep -q ',rejected,,,""' out/effects.csv
column out/errors.csv 3 4 5 6 7 8 >"$work/numbers"
holds out/report.html
column out/effects.csv 4 >"$work/numbers"
holds out/report.html
column out/machine/effects.csv 3 5 >"$work/numbers"
holds out/report.html
TZ=Asia/Tokyo LC_ALL=de_DE.UTF-8 "$hci_solve" diagnose machine --runs runs.csv -q -o again 2>"$work/stderr"
check "other bytes" cmp -s out/report.html again/report.html

# with a target, both pages
printf 'order,amplitude_Nm,phase_rad\n0,0.5,1.5707963267948966\n' >target.csv
run 0 diagnose machine --runs runs.csv --target target.csv -q -o resolved
alone resolved/report.html
alone resolved/solution/report.html
check "old and new currents" grep -q 'Old currents' resolved/report.html

# ---- solve and simulate on request; a page of an earlier run does not stay beside other results

cd "$source_dir" || exit 1
solve() {
    run 0 solve data/machine_a --target data/scenarios/02/target.csv --auto -q -o "$work/solved" "$@"
}
solve --report
alone "$work/solved/report.html"
check "the current loop has to follow other orders" grep -q 'up to electrical order 48' "$work/solved/report.html"
printf 'order,amplitude_Nm,phase_rad\n0,1e-6,0\n' >"$work/nearly_none.csv"
run 0 solve data/machine_a --target "$work/nearly_none.csv" --auto -q --report -o "$work/nearly_none"
check "a percentage of no mean" [ "$(grep -c '% of the mean' "$work/nearly_none/report.html")" -eq 0 ]
column "$work/solved/currents.csv" 1 3 4 >"$work/numbers"
holds "$work/solved/report.html"
check "the target is not named" grep -q 'Wanted torque: data/scenarios/02/target.csv<' "$work/solved/report.html"
solve
check "the page of an earlier run" [ ! -e "$work/solved/report.html" ]
printf 'order,amplitude_Nm,phase_rad\n0,2,1.5707963267948966\n6,0.5,0\n' >"$work/target.csv"
printf 'order,set\n1,pos\n' >"$work/set.csv"
run 1 solve data/machine_a --target "$work/target.csv" --harmonics "$work/set.csv" -q -o "$work/missed" --report
check "a missed target is not told" grep -q 'badge bad">Not reached' "$work/missed/report.html"

run 0 simulate data/machine_a data/drive/imposed.csv -q -o "$work/imposed" --report
alone "$work/imposed/report.html"
sed -n '2p' "$work/imposed/spectrum.csv" | tr ',' '\n' | sed -n '2,3p' >"$work/numbers"
holds "$work/imposed/report.html"
sed -n 's/.*"mean_Nm":[[:space:]]*\([-0-9.e+]*\),*$/\1/p' "$work/imposed/summary.json" | sed 's/0*$//' >"$work/mean"
check "the mean is not that of the summary" grep -Fq "<data value=\"$(cut -c 1-12 "$work/mean")" "$work/imposed/report.html"
check "imposed currents taken for a strategy" [ "$(grep -c 'A strategy asks' "$work/imposed/report.html")" -eq 0 ]
run 0 simulate data/machine_a data/drive/imposed.csv -o "$work/again" --report
plain=$(sed -n 's/.*of 11.76 A as it should flow, T_ripple \([0-9]*\)\..*/\1/p' "$work/stdout")
check "the terminal names no ripple before" [ -n "$plain" ]
check "the page has another ripple before" grep -q "T_ripple, peak to peak to mean</th><td>$plain" "$work/imposed/report.html"
check "another order before" [ "$(awk '$1 == 6 { print $2 }' "$work/stdout")" = "$(sed -n 's|.*>6</data></td><td><data value="\([0-9.]\{6\}\).*|\1|p' "$work/imposed/report.html" | head -n 1)" ]
run 0 simulate data/machine_a data/drive/imposed.csv -q -o "$work/imposed"
check "the page of an earlier simulation" [ ! -e "$work/imposed/report.html" ]

# ---- a report needs a folder

run 2 solve data/machine_a --target data/scenarios/02/target.csv --report
says '--report .*--out FOLDER'
run 2 simulate data/machine_a data/drive/imposed.csv --report
says '--report .*--out FOLDER'

finish
