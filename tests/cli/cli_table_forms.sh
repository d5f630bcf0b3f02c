#!/bin/sh
# Tables that `emit` refuses, names that need care, and the forms of a table that mean the same: the same bytes.
#   cli_table_forms.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
. "$1/tests/cli/small_machine.sh"

fresh

# ---- emit reads currents

mkdir "$work/c"
for rows in '1,sym,x,0' '1,what,1,0' '-1,pos,1,0' '1,pos,1' '1,pos,nan,0'; do
    printf 'order,set,amplitude_A,phase_rad\n%s\n' "$rows" >"$work/c/currents.csv"
    for given in "$work/c" "$work/c/currents.csv"; do
        run 3 emit "$given" --name t -o "$work/out"
        nothing_on_stdout
        says '/c/currents.csv:2: '
        check "something was written" [ ! -e "$work/out" ]
    done
done
run 3 emit "$work/nowhere" --name t -o "$work/out"
says '/nowhere: .*(No such file|not exist)'
run 3 emit "$work/c" --name t --per-torque -o "$work/out"
says 'no currents_per_Nm.csv: .*not linear'
check "something was written" [ ! -e "$work/out" ]

# ---- names that need care

for name in 'with blank' 'naïve' '%s%n' "quote'" '-dash'; do
    mkdir "$work/$name" && cp -R "$m" "$work/$name/m" && echo 'order,what' >"$work/$name/t.csv"
    run 3 solve "$work/$name/m" --target "$work/$name/t.csv"
    checks=$((checks + 1))
    grep -qF "/$name/t.csv" "$work/stderr" || fail "the file is not named: $name"
    run 0 solve "$work/$name/m" --target "$t" -q -o "$work/$name/out"
    check "nothing in $name/out" [ -s "$work/$name/out/currents.csv" ]
done
run 3 solve "$m" --target "$(awk 'BEGIN { for (k = 0; k < 5000; k++) printf "x" }')"
run 3 solve "$(awk 'BEGIN { for (k = 0; k < 5000; k++) printf "x" }')" --target "$t"
check "a long name floods the terminal" [ "$(wc -c <"$work/stderr")" -lt 1200 ]

# ---- other forms of the same tables

fresh
run 0 solve "$m" --target "$t" -q -o "$work/plain"

same() { # WHAT: the files as they are give the same bytes
    rm -rf "$work/other"
    run 0 solve "$m" --target "$t" -q -o "$work/other"
    check "$1: other results" diff -r "$work/plain" "$work/other"
    fresh
}

# each table through a filter
each() {
    for file in "$m/machine.csv" "$m/back_emf.csv" "$m/cogging.csv" "$t"; do
        "$@" <"$file" >"$work/filtered" && mv "$work/filtered" "$file"
    done
}
bom() { printf '\357\273\277'; cat; }
crlf() { sed "s/\$/$(printf '\r')/"; }
semicolons() { tr ',.' ';,'; }
tabs() { tr ',' '\t'; }
quotes() { sed 's/[^,]*/"&"/g'; }
comments() { sed 's/^/# before\n/'; echo '# after'; }
no_newline() { awk '{ printf "%s%s", (NR > 1 ? "\n" : ""), $0 }'; }
blanks() { sed 's/,/ , /g; s/^/ /; s/$/ /'; }
capitals() { sed '1s/.*/\U&/'; }
empty_lines() { sed 's/$/\n/'; }
for filter in bom crlf semicolons tabs quotes comments no_newline blanks empty_lines; do
    each $filter
    same $filter
done
each crlf; each comments; each bom; same 'BOM before a comment, CRLF and LF mixed'
printf 'ORDER,Amplitude_Nm,PHASE_RAD\n0,2,0\n6,0.1,0.5\n' >"$t"; same 'upper case'
printf 'phase_rad,order,note,amplitude_Nm\n0,0,mean,2\n0.5,6,ripple,0.1\n' >"$t"; same 'other columns in another order'
printf '%s\n6,0.1,0.5\n0,2,0\n' $header >"$t"; same 'rows in another order'
printf '%s\n0,2,1.5707963267948966\n6,0.1,0.5\n' $header >"$t"; same 'the mean with phase π/2'
printf '%s,weight\n0,2,0,1\n6,0.1,0.5,1\n' $header >"$t"; same 'weights of 1'
printf 'order,amplitude,phase\n1,Nm,rad\n0,2,0\n6,0.1,0.5\n' >"$t"; same 'a row of units'
printf 'order,amplitude_mNm,phase_rad\n0,2000,0\n6,100,0.5\n' >"$t"; same 'mN·m'
printf '%s\n0,2e0,0.0\n6.000,+1.0E-1,.5\n' $header >"$t"; same 'numbers in other forms'
machine 'pole_pairs,2,1,x' 'emf_frequency,0.05,kHz,x' 'connection,star,,x'; same 'kHz'
machine 'pole_pairs,2,-,x' 'emf_frequency,50,,x'; same 'units left out, star by default'
printf 'name,value,unit,source\npole_pairs,2,1,"a, ""quoted"" source\nin two lines"\nemf_frequency,50,Hz,x\n' >"$m/machine.csv"; same 'a quoted line break'

# degrees: the same to rounding
printf 'order,amplitude_Nm,phase_deg\n0,2,0\n6,0.1,28.64788975654116\n' >"$t"
run 0 solve "$m" --target "$t" -q -o "$work/degrees"
awk -F, 'FNR == 1 { file++ }
    FNR > 1 && file == 1 { order[FNR] = $1; sine[FNR] = $4 * sin($5); cosine[FNR] = $4 * cos($5) }
    FNR > 1 && file == 2 { if ($1 != order[FNR] || (sine[FNR] - $4 * sin($5)) ^ 2 + (cosine[FNR] - $4 * cos($5)) ^ 2 > 1e-24) bad = 1; rows++ }
    END { exit bad || rows < 5 }' "$work/plain/spectrum.csv" "$work/degrees/spectrum.csv"
check "degrees: another torque" [ $? -eq 0 ]

finish
