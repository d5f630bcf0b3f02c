#!/bin/sh
# `emit --format csv` and `json`: the rows of a table against the currents themselves, and what is refused.
#   cli_emit_data.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"

mkdir "$work/c"
printf 'order,set,amplitude_A,phase_rad\n1,pos,10,0.3\n5,neg,1.5,-1\n' >"$work/c/currents.csv"

# 10 sin(θ − 2πs/3 + 0.3) + 1.5 sin(5θ + 2πs/3 − 1), s = 0, 1, 2
rows() { # FILE: the largest departure and how many rows
    awk -F, 'NR > 1 { for (s = 0; s < 3; ++s) {
            turn = s * 2.0943951023931953
            d = $(2 + s) - 10 * sin($1 - turn + 0.3) - 1.5 * sin(5 * $1 + turn - 1)
            most = d > most ? d : -d > most ? -d : most } }
        END { printf "%.3g %d\n", most, NR - 1 }' "$1"
}

run 0 emit "$work/c" --name t --format csv --points 48 -o "$work/out"
says 'emitted.*: .*/t.csv' 'straight lines'
check "columns: $(head -n 1 "$work/out/t.csv")" [ "$(head -n 1 "$work/out/t.csv")" = theta_e_rad,ia_A,ib_A,ic_A ]
set -- $(rows "$work/out/t.csv")
check "$1 A off in $2 rows" awk -v x="$1" -v n="$2" 'BEGIN { exit !(x < 2e-6 && n == 48) }'
check "C files beside the data" [ "$(ls "$work/out")" = t.csv ]

run 0 emit "$work/c" --name t --format json --points 48 -o "$work/out"
python3 - "$work/out" <<'EOF' || fail "t.json is not what t.csv is"
import csv, json, sys
table = json.load(open(sys.argv[1] + '/t.json'))
rows = list(csv.reader(open(sys.argv[1] + '/t.csv')))
assert rows[0] == table['columns'] and [[float(x) for x in r] for r in rows[1:]] == table['rows']
assert table['points'] == len(table['rows']) == 48 and table['period_turns'] == 1
peak = max(abs(x) for row in table['rows'] for x in row[1:])
assert 0 < table['max_error_A'] < 0.2 and peak <= table['peak_A'] < 1.01 * peak
EOF

# The rotor's frame: 10 A at 0.3 rad is i_q = 10 cos 0.3, i_d = −10 sin 0.3 and the fifth as a ripple of order 6.
run 0 emit "$work/c" --name t --format csv --frame dq --points 48 -o "$work/out"
mean=$(awk -F, 'NR > 1 { d += $2 / 48; q += $3 / 48 } END { printf "%.4f %.4f\n", d, q }' "$work/out/t.csv")
check "mean of i_d, i_q: $mean" [ "$mean" = '-2.9552 9.5534' ]

run 2 emit "$work/c" --name t --format csv --shape cubic -o "$work/none"
says 'table shape: found `cubic` with format `csv`.*i16'
run 2 emit "$work/c" --name t --format json --blob -o "$work/none"
says 'blob: found with format `json`, expected'
check "something was written" [ ! -e "$work/none" ]
finish
