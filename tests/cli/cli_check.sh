#!/bin/sh
# What `check` says and writes: verdict, place, evidence, exit codes, JSON; that it changes nothing.
#   cli_check.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
cd "$source_dir" || exit 1

# ---- nothing wrong

run 0 check data/machine_c
says '^consistent: ' '^  checked      10 relations agree; 25 not checked, ' '^  not told     by these files: the pole pairs; kind and unit of the back-EMF; '
check "a clean check is more than three lines" [ "$(wc -l <"$work/stdout")" -eq 3 ]
run 0 check data/machine_c --verbose
says '^consistent: ' '0\.9964 +1  rated torque over what the rated current makes' 'not checked, for want of' 'a recording of currents, angle and torque: torque_size'
run 0 check data/fem_c/machine data/fem_c/runs/*.csv -q
nothing_on_stdout
nothing_on_stderr

# ---- a slip: the line-to-line back-EMF, √3 × 0.892 = 1.545

cp -R data/fem_c/machine "$work/typed"
sed 's/^1,0.89205945,/1,1.545092,/' data/fem_c/machine/back_emf.csv >"$work/typed/back_emf.csv"
cp -R "$work/typed" "$work/before"
run 1 check "$work/typed" data/fem_c/runs/I0.csv data/fem_c/runs/id0_iq6.csv
says '^1 slip found: the back-EMF is given line to line, not line to star point, (99.8|more than 99.9) % sure' \
    'typed/back_emf.csv:2: column amplitude_Nm_per_A: found 1.545092, should be 0.892059' \
    'evidence: ' '0\.5894 .*torque over 3/2 k_e i_q and the reluctance torque'
check "check has changed the machine" diff -r "$work/before" "$work/typed"

# ---- two slips of a folder that the loader of machines refuses, and what looks the same

sed 's/^pole_pairs,2,/pole_pairs,4,/' data/fem_c/machine/machine.csv >"$work/typed/machine.csv"
printf 'order,amplitude_Nm_per_A,phase_rad\n4,0.892,0\n20,0.05,3.1416\n' >"$work/typed/back_emf.csv"
run 1 check "$work/typed"
says 'emf_orders_mechanical: the orders of back_emf.csv are per mechanical turn'
printf 'order,amplitude_Nm_per_A,phase_rad\n1,-0.892,0\n' >"$work/typed/back_emf.csv"
run 1 check "$work/typed"
says '^ambiguous: ' 'possible angle_zero_d_axis' 'or instead: [a-z][^;]* .emf_sign.; would tell: '

# ---- bounds, what leaves no trace, what is only possible, what is nearer

run 0 check data/machine_a -v
says '<= 300  factor between the flux linkage' '^  not told     by these files: poles_for_pole_pairs, emf_rms, '
printf 'name,value,unit\npole_pairs,4,1\nresistance,0.38,ohm\ninductance_d,1,mH\ninductance_q,1,mH\nrated_current,7.0710678,A\nrated_torque,1.5,Nm\n' \
    >"$work/typed/machine.csv"
printf 'order,amplitude_Nm_per_A,phase_rad\n1,0.1,0\n' >"$work/typed/back_emf.csv"
rm "$work/typed/cogging.csv"
# drive NAME ID IQ: p = 4, k_e = 0.1, R = 0.2, L = 1 mH at 50 rad/s, as a drive logs it.
drive() {
    awk -v d="$2" -v q="$3" 'BEGIN {
        print "time_s,theta_m_rad,erpm,id_A,iq_A,vd_V,vq_V,torque_Nm,odd"
        for (k = 0; k < 400; ++k) {
            t = 0.000314159265 * k
            printf "%.9g,%.9g,%.9g,%g,%g,%g,%g,%g,0\n", t, 50 * t + 0.3, 200 * 9.54929658551, d, q, 0.2 * d - 0.2 * q, 0.2 * q + 0.2 * d + 5, 0.15 * q
        }
    }' >"$work/$1.csv"
}
drive load -2 10
drive back 0 0
run 1 check "$work/typed" "$work/load.csv" "$work/back.csv" --verbose
says '^hci-solve: note: .*`erpm` is read as' '^hci-solve: note: .*columns not used: `odd`' '^1 slip found, 1 more possible: rated_current is rms' \
    'possible resistance_line' ' 1  change of the angle over time against the speed'
check "the same remark twice" [ "$(grep -c 'note:' "$work/stderr")" -eq 2 ]
says 'note: .*2 of 2 recordings: ' 
sed -i 's/^resistance,0.38/resistance,0.2/; s/^rated_current,7.0710678/rated_current,10/' "$work/typed/machine.csv"
printf 'order,amplitude_Nm_per_A,phase_rad\n1,0.2,0\n' >"$work/typed/back_emf.csv"
run 1 check "$work/typed" "$work/load.csv" "$work/back.csv"
says '^1 slip found: the back-EMF is given line to line' '^  better as read, but still off'
# a row of units: the remedy is one that the file accepts
awk -F, -v OFS=, 'NR == 1 { print "time,theta_m,erpm,id,iq,vd,vq,torque,odd"; print "s,rad,rpm,A,A,V,V,Nm,"; next } { $8 *= 1000 } 1' "$work/load.csv" >"$work/units.csv"
printf 'order,amplitude_Nm_per_A,phase_rad\n1,0.1,0\n' >"$work/typed/back_emf.csv"
run 1 check "$work/typed" "$work/units.csv"
says '^1 slip found: the torque is in mN·m' 'column torque: found torque, should be mNm in line 2, the row of units'
sed -i '2s/Nm/mNm/' "$work/units.csv"
run 0 check "$work/typed" "$work/units.csv"
# orders of a mechanical turn, as they are declared
mkdir -p "$work/turn" && cp data/machine_a/machine.csv "$work/turn"
for table in back_emf cogging; do awk -F, -v OFS=, '!/^#/ && !/order/ { $1 *= 2 } 1' "data/machine_a/$table.csv" >"$work/turn/$table.csv"; done
run 1 check "$work/turn"
run 0 check "$work/turn" --order-base mechanical
run 0 predict "$work/turn" "$work/load.csv" --order-base mechanical
run 0 simulate "$work/turn" data/drive/driven.csv --order-base mechanical -q
printf 'order,set,amplitude_A,phase_rad\n1,pos,1,0\n' >"$work/sine.csv"
run 0 emit "$work/sine.csv" --name sine --machine "$work/turn" --order-base mechanical -q -o "$work/sine"
# the remedy for an angle under another name
sed 's/theta_m_rad/turned/' "$work/load.csv" >"$work/turned.csv"
run 0 check "$work/typed" "$work/turned.csv"
says 'no angle: what needs it is not compared' '--column theta_m_deg=COLUMN'
sed 's/theta_m_rad/theta/; s/vd_V,vq_V/va_V,vb_V/; s/odd/vc_V/' "$work/load.csv" >"$work/either.csv"
run 3 check "$work/typed" "$work/either.csv"
says 'theta.*mechanical or electrical'

cp data/fem_c/machine/back_emf.csv "$work/typed/back_emf.csv"
for slots in 1e12 4.5 -7; do
    { cat data/fem_c/machine/machine.csv; echo "slots,$slots,1,typed"; } >"$work/typed/machine.csv"
    run 3 check "$work/typed"
    says 'machine.csv:[0-9]+: `slots`: found .*, expected a whole number from 3 to '
done
cp data/fem_c/machine/machine.csv "$work/typed/machine.csv"

# ---- a summary for scripts

printf 'order,amplitude_Nm_per_A,phase_rad\n1,-0.892,0\n' >"$work/typed/back_emf.csv"
run 1 check "$work/typed" data/fem_c/runs/I0.csv --json -o "$work/out"
nothing_on_stderr
check "summary.json is not what --json says" cmp -s "$work/stdout" "$work/out/summary.json"
if command -v python3 >/dev/null 2>&1; then
    check "the summary lacks what scripts read" python3 - "$work/out/summary.json" <<'PYTHON'
import json, sys
s = json.load(open(sys.argv[1]))
assert s["command"] == "check" and s["verdict"] == "ambiguous" and s["machine"].endswith("typed")
assert s["runs"] == ["data/fem_c/runs/I0.csv"] and s["remarks"] == []
assert "poles_for_pole_pairs" in s["untold"] and "angle_zero_d_axis" not in s["untold"]
for f in s["findings"]:
    assert {"slip", "file", "line", "column", "found", "should_be", "probability", "words", "alternatives"} <= set(f)
assert s["findings"][0]["slip"] == "angle_zero_d_axis" and s["findings"][0]["alternatives"] == ["emf_sign"]
assert s["findings"][0]["line"] == 2 and s["findings"][0]["file"].endswith("back_emf.csv")
for e in s["evidence"]:
    assert {"name", "words", "declared", "expected", "at_most", "as_read", "tolerance", "state"} <= set(e)
assert all({"name", "words", "needs"} <= set(u) for u in s["unchecked"])
PYTHON
fi
run 0 check data/machine_a --json
check "no verdict" grep -q '"verdict":	"consistent"' "$work/stdout"

# ---- what several recordings have in common is said once; a list of columns among them is none

mkdir -p "$work/both"
for k in 1 2 3; do
    printf 'time_s,theta_m_rad,AI3,lamp\n0,0,1,0\n1,%s,2,0\n2,1,1,0\n' "0.$k" >"$work/both/run$k.csv"
done
printf 'name,column\ntorque_Nm,AI3\n' >"$work/both/columns.csv"
sed -i 's/^1,0.2/x,0.2/' "$work/both/run2.csv"
run 0 check data/machine_a "$work/both/"*.csv
says '3 of 3 recordings: columns not used: `lamp`$'
check "unused columns are said again" [ "$(grep -c 'lamp' "$work/stderr")" -eq 1 ]

# ---- wrong: one line that says what and where

run 2 check
says 'check: found 0 words, expected 1 or more: MACHINE'
run 3 check "$work/none"
says 'none: No such file'
run 3 check data/machine_a data/machine_a/cogging.csv
says 'cogging.csv:.*found a table of orders'
printf 'name,value,unit\npole_pairs,2.5,1\n' >"$work/typed/machine.csv"
run 3 check "$work/typed"
says 'machine.csv:2: `pole_pairs`: found 2.5'
: >"$work/file"
run 5 check data/machine_a -o "$work/file/x"

# A table that is read behind the angle, in a log with its time, is perhaps a log whose currents are late; ahead of it it is not.
"$hci_solve" solve "$source_dir/data/machine_a" --target "$source_dir/data/scenarios/02/target.csv" --auto --quiet -o "$work/played" >/dev/null 2>&1
for turned in 10 -10; do
    awk -F, -v turned=$turned 'NR == 1 { print "time_s,theta_e_deg,ia_A,ib_A,ic_A"; next } { printf "%.6f,%.6f,%s,%s,%s\n", $1 / 20, $1 * 57.29577951 + turned, $2, $3, $4 }' "$work/played/waveform.csv" >"$work/turned$turned.csv"
    "$hci_solve" check "$source_dir/data/machine_a" "$work/turned$turned.csv" --table "$work/played" >"$work/turned$turned.out" 2>&1
done
check "behind: no delay is named" grep -q 'or late .* by 8\.7 ms' "$work/turned10.out"
check "ahead: a delay is named" [ "$(grep -c 'or late' "$work/turned-10.out")" = 0 ]
check "ahead: not rotated" grep -q '^rotated' "$work/turned-10.out"
finish
