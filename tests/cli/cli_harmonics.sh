#!/bin/sh
# What `harmonics` writes and says: the chain from `simulate` and back into a machine, options, exit codes, measured data.
#   cli_harmonics.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
cd "$source_dir" || exit 1

# ---- a recording of cogging torque gives the machine's own table

run 0 simulate data/machine_a data/drive/driven.csv -q -o "$work/driven"
recording=$work/driven/trajectory.csv
run 0 harmonics "$recording" --quantity cogging --pole-pairs 2 -o "$work/table"
says '^cogging torque: .*trajectory.csv, [6-8] orders$' 'mechanical' 'errors       from how the turns differ' 'only whole turns in one direction are used'
check "files: $(ls -A "$work/table")" [ "$(ls -A "$work/table" | tr "\n" " ")" = "cogging.csv cogging.svg " ]
check "header" [ "$(head -n 1 "$work/table/cogging.csv")" = order,amplitude_Nm,phase_rad,std_error_Nm ]
awk -F, '/^#/ || /^order/ { next }
    FNR == NR { s[$1] = $2 * cos($3); c[$1] = $2 * sin($3); if ($2 > 0) n++; next }
    { d = sqrt(($2 * cos($3) - s[$1]) ^ 2 + ($2 * sin($3) - c[$1]) ^ 2); if (d > 5 * $4 + 1e-4) bad = 1; if ($1 in s) m++ }
    END { exit bad || n != m }' data/machine_a/cogging.csv "$work/table/cogging.csv"
check "the table is not the machine's within five standard errors" [ $? -eq 0 ]

mkdir "$work/machine"
cp data/machine_a/machine.csv data/machine_a/back_emf.csv "$work/machine"
run 0 harmonics "$recording" --quantity cogging --pole-pairs 2 -q -o "$work/machine"
nothing_on_stderr
run 0 predict "$work/machine" "$recording"
says 'residual     0\.00[0-9]+ N·m rms' # the sensor's 2 mN·m

# ---- options

run 0 harmonics "$recording" --quantity cogging --pole-pairs 2 --orders 12,24,71/2 --json -q
nothing_on_stderr
check "orders in the summary" [ "$(grep -c '"order":' "$work/stdout")" -eq 3 ]
check "35.5 is not among them" grep -q '"order":[[:space:]]*35.5' "$work/stdout"
run 0 harmonics "$recording" --quantity cogging --pole-pairs 2 --max-order 13
says 'of 26 orders up to 13'
cp "$work/stdout" "$work/first"
TZ=Asia/Tokyo LC_ALL=de_DE.UTF-8 "$hci_solve" harmonics "$recording" --quantity cogging --pole-pairs 2 --max-order 13 >"$work/second" 2>/dev/null
check "other words" cmp -s "$work/first" "$work/second"
mkdir "$work/empty" && cd "$work/empty" || exit 1
run 0 harmonics "$recording" --quantity cogging --pole-pairs 2 -q
check "written without --out: $(ls -A)" [ -z "$(ls -A)" ]
cd "$source_dir" || exit 1

# ---- back-EMF from voltages alone: 40 Hz electrical, 5 V, channel c through a probe, 20 % of order 5

awk 'BEGIN { print "time_s,va_V,vb_V,vc_V"; p = 8 * atan2(1, 1)
    for (k = 0; k < 4000; ++k) { t = k / 20000; x = p * 40 * t + 0.5; printf "%.6f", t
        for (s = 0; s < 3; ++s) { y = x - s * p / 3; printf ",%.9f", (s == 2 ? 0.1 : 1) * (5 * sin(y) + sin(5 * y)) + (s == 1 ? 0.7 : 0) }
        print "" } }' >"$work/voltages.csv"
run 0 harmonics "$work/voltages.csv" --quantity back_emf --pole-pairs 4 -o "$work/table"
says 'frequency    40 Hz' 'speed        600 rpm' 'channel vc reads 0.1 times the others: a x10 probe\?' 'channel vb has an offset of 0.7 V' '\(left out\)'
check "header" [ "$(head -n 1 "$work/table/back_emf.csv")" = order,amplitude_Nm_per_A,phase_rad,std_error_Nm_per_A ]
# 5 V at 62.83 rad/s; order 5 is in phase with the fundamental
awk -F, 'NR == 1 { next } { n++ }
    $1 == 1 { one = ($2 - 5 / 62.83185) ^ 2 < 1e-12 && $3 ^ 2 < 1e-10 }
    $1 == 5 { five = ($2 - 1 / 62.83185) ^ 2 < 1e-12 && $3 ^ 2 < 1e-8 }
    END { exit !(one && five && n == 2) }' "$work/table/back_emf.csv"
check "orders: $(cat "$work/table/back_emf.csv")" [ $? -eq 0 ]
awk -F, 'NR == 1 { print "time_s,va_V,vb_V,vc_V"; next } { printf "%s,%s,%s,%.9f\n", $1, $2, $3, 10 * $4 }' "$work/voltages.csv" >"$work/full.csv"
run 0 harmonics "$work/full.csv" --quantity back_emf --pole-pairs 4
check "a channel is left out" eval "! grep -q '(left out)' '$work/stdout'"
awk -F, 'NR == 1 { print "time_s,va_V,vb_V,vc_V"; next } { print $1 "," $2 "," $4 "," $3 }' "$work/full.csv" >"$work/swapped.csv"
run 0 harmonics "$work/swapped.csv" --quantity back_emf --pole-pairs 4
says 'a-c-b: taken as turned backward' 'frequency    -40 Hz'

# ---- an angle with another zero, and doing what is said: v_a = sin x, recorded with theta_e = x - 0.3 or x + 0.3

shifted() { # RAD FILE
    awk -v zero="$1" 'BEGIN { print "time_s,theta_e_rad,speed_rad_per_s,va_V,vb_V,vc_V,iq_A"; turn = 8 * atan2(1, 1)
        for (k = 0; k < 4000; ++k) { t = k / 20000; x = turn * 40 * t; e = x - zero; e -= turn * int(e / turn); if (e < 0) e += turn
            printf "%.6f,%.9f,%.9f,%.9f,%.9f,%.9f,2\n", t, e, turn * 10, 5 * sin(x), 5 * sin(x - turn / 3), 5 * sin(x + turn / 3) } }' >"$2"
}
for zero in 0.3 -0.3; do
    shifted $zero "$work/shifted.csv"
    run 0 harmonics "$work/shifted.csv" --quantity back_emf --pole-pairs 4
    says 'currents of 1\.41 A rms flow'
    run 0 harmonics "$work/shifted.csv" --quantity back_emf --pole-pairs 4 -o "$work/turned"
    check "the fundamental that is written is not the zero" grep -q '^1,[0-9.e-]*,0,' "$work/turned/back_emf.csv"
    offset=$(tr '\n' ' ' <"$work/stderr" | sed -n 's/.*--angle-offset \([-0-9.]*\) does.*/\1/p')
    run 0 harmonics "$work/shifted.csv" --quantity back_emf --pole-pairs 4 --angle-offset "$offset"
    check "$zero: still told with --angle-offset $offset" eval "! grep -q 'zero crossing' '$work/stderr'"
    run 0 harmonics "$work/shifted.csv" --quantity back_emf --pole-pairs 4
    advice=$(tr '\n' ' ' <"$work/stderr" | sed -n 's/.*zero crossing: *\([a-z]* [0-9.]* rad [a-z]* theta_e\).*/\1/p')
    case $advice in
        'add '*' to theta_e') follows=$(echo "$advice" | awk '{ print $2 }') ;;
        'subtract '*' from theta_e') follows=$(echo "$advice" | awk '{ print -$2 }') ;;
        *) follows=0 ;;
    esac
    awk -F, -v add="$follows" 'NR > 1 { $2 = sprintf("%.9f", $2 + add) } { print }' OFS=, "$work/shifted.csv" >"$work/mended.csv"
    run 0 harmonics "$work/mended.csv" --quantity back_emf --pole-pairs 4 -o "$work/mended"
    check "$zero: \"$advice\" leaves the phase $(awk -F, '$1 == 1 { print $3 }' "$work/mended/back_emf.csv")" \
        awk -F, '$1 == 1 { exit !($3 ^ 2 < 1e-8) }' "$work/mended/back_emf.csv"
    check "$zero: still told" eval "! grep -q 'zero crossing' '$work/stderr'"
done

# ---- wrong: one line that says what and where, and nothing is written

refused() { # CODE EXPRESSION WORD...
    code_wanted=$1 expression=$2
    shift 2
    run "$code_wanted" harmonics "$@" -o "$work/refused"
    nothing_on_stdout
    says "^hci-solve: .*$expression"
    check "more than one line is said" [ "$(wc -l <"$work/stderr")" -eq 1 ]
    check "something was written" [ ! -e "$work/refused" ]
}

refused 2 'add --quantity back_emf or cogging' "$recording" --pole-pairs 2
refused 2 '--quantity: found `torque`, expected one of: back_emf, cogging' "$recording" --pole-pairs 2 --quantity torque
refused 2 'add --pole-pairs P' "$recording" --quantity cogging
for number in 0 1.5 x -2; do
    refused 2 "--pole-pairs: found \`$number\`" "$recording" --quantity cogging --pole-pairs "$number"
done
for list in '' , 1, x 1/0 1,,2 1e; do
    refused 2 "--orders: found \`" "$recording" --quantity cogging --pole-pairs 2 --orders "$list"
done
refused 2 'order 1: expected each once and ascending' "$recording" --quantity cogging --pole-pairs 2 --orders 2,1
refused 2 'give --orders or --max-order, not both' "$recording" --quantity cogging --pole-pairs 2 --orders 1 --max-order 3
refused 2 '--max-order: found `0`' "$recording" --quantity cogging --pole-pairs 2 --max-order 0
refused 2 '--torque-constant goes with --quantity cogging' "$work/voltages.csv" --quantity back_emf --pole-pairs 2 --torque-constant 1
refused 2 'whole electrical orders only' "$work/voltages.csv" --quantity back_emf --pole-pairs 2 --orders 1.5
refused 3 'found no voltages' "$recording" --quantity back_emf --pole-pairs 2
refused 3 'found no angle' "$work/voltages.csv" --quantity cogging --pole-pairs 2
refused 3 'none.csv: .*No such file' "$work/none.csv" --quantity cogging --pole-pairs 2
sed '1s/theta_e_rad/theta/' "$work/shifted.csv" | cut -d , -f 1,2,4-7 >"$work/theta.csv"
refused 3 'theta.csv:1: column 2 `theta`: found an angle that may be mechanical or electrical' "$work/theta.csv" --quantity back_emf --pole-pairs 4
refused 3 'back_emf.csv:3: found a table of orders.*expected a recording' "$source_dir/data/machine_a/back_emf.csv" --quantity back_emf --pole-pairs 4
printf 'theta_m_deg,iq_A,torque_Nm\n0,1,0\n1,2,0\n' >"$work/held.csv"
awk 'BEGIN { print "time_s,theta_e_rad,ia_A,ib_A,ic_A,torque_Nm"; for (k = 0; k < 200; k++) print k / 1000 "," k / 10 ",1,-0.5,-0.5,1" }' >"$work/typed.csv"
refused 3 'typed.csv: found the same torque in every row, typed .*leave the column out' "$work/typed.csv" --quantity cogging --pole-pairs 2
refused 3 'add --torque-constant' "$work/held.csv" --quantity cogging --pole-pairs 2
refused 3 'do not go round' "$work/held.csv" --quantity cogging --pole-pairs 2 --torque-constant 1

# ---- measured, where the recordings are at hand

# Voltages of a machine with three pole pairs, taken for one with six: no order of them comes again each turn.
awk 'BEGIN { srand(7); print "time_s,theta_m_rad,va_V,vb_V,vc_V"
    for (k = 0; k < 6000; ++k) { t = 0.001 * k; x = 4.2 * t; printf "%.4f,%.6f", t, x
        for (s = 0; s < 3; ++s) printf ",%.5f", 0.8 * sin(3 * x - s * 2.0943951) + 0.01 * (rand() - 0.5)
        print "" } }' >"$work/three.csv"
run 0 harmonics "$work/three.csv" --quantity back_emf --pole-pairs 3 -o "$work/three"
run 1 harmonics "$work/three.csv" --quantity back_emf --pole-pairs 6
says '0 orders' 'no order of the voltages repeats from turn to turn with 6 pole pairs.*another --pole-pairs'
run 1 harmonics "$work/three.csv" --quantity back_emf --pole-pairs 6 --json

measured=$source_dir/../shared/measured
if [ -d "$measured" ]; then
    run 0 harmonics "$measured/laas_mn4004/hold.csv" --quantity cogging --pole-pairs 12 --torque-constant 0.0279 -o "$work/laas"
    says 'friction     0.00150' '1 forward, 1 backward'
    for order in 1 1.5 2 3 6; do
        check "order $order of the MN4004" grep -q "^$order," "$work/laas/cogging.csv"
    done
    run 0 harmonics "$measured/trampa6340_back_emf/0500rpm.csv" --quantity back_emf --pole-pairs 7
    says 'channel vc reads 0.0998 times the others: a x10 probe' 'channel vb has an offset of -0.22' 'speed        499.70. rpm mean'
else
    echo "without measured recordings: no $measured"
fi

finish
