#!/bin/sh
# labels: cli
# What `check` says and writes: verdict, place, evidence, exit codes, JSON; that it changes nothing.
#   cli_check.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$(dirname "$0")/cli/common.sh"
cd "$source_dir" || exit 1

# ---- nothing wrong

run 0 check data/machine_c
nothing_on_stdout
says '^consistent: ' '0\.9964 +1  rated torque over what the rated current makes' 'not checked, for want of' 'a recording of currents, angle and torque: torque_size'
run 0 check data/fem_c/machine data/fem_c/runs/*.csv -q
nothing_on_stdout
nothing_on_stderr

# ---- a slip: the line-to-line back-EMF, √3 × 0.892 = 1.545

cp -R data/fem_c/machine "$work/typed"
sed 's/^1,0.89205945,/1,1.545092,/' data/fem_c/machine/back_emf.csv >"$work/typed/back_emf.csv"
cp -R "$work/typed" "$work/before"
run 1 check "$work/typed" data/fem_c/runs/I0.csv data/fem_c/runs/id0_iq6.csv
nothing_on_stdout
says '^1 slip found: the back-EMF is given line to line, not line to star point, more than 99.9 % sure' \
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
says '^ambiguous: ' 'possible angle_zero_d_axis' 'or instead: emf_sign; would tell: '

# ---- a summary for scripts

run 1 check "$work/typed" data/fem_c/runs/I0.csv --json -o "$work/out"
nothing_on_stderr
check "summary.json is not what --json says" cmp -s "$work/stdout" "$work/out/summary.json"
if command -v python3 >/dev/null 2>&1; then
    check "the summary lacks what scripts read" python3 - "$work/out/summary.json" <<'PYTHON'
import json, sys
s = json.load(open(sys.argv[1]))
assert s["command"] == "check" and s["verdict"] == "ambiguous" and s["machine"].endswith("typed")
assert s["runs"] == ["data/fem_c/runs/I0.csv"]
for f in s["findings"]:
    assert {"slip", "file", "line", "column", "found", "should_be", "probability", "words", "alternatives"} <= set(f)
assert s["findings"][0]["slip"] == "angle_zero_d_axis" and s["findings"][0]["alternatives"] == ["emf_sign"]
assert s["findings"][0]["line"] == 2 and s["findings"][0]["file"].endswith("back_emf.csv")
for e in s["evidence"]:
    assert {"name", "words", "declared", "expected", "as_read", "tolerance", "state"} <= set(e)
assert all({"name", "words", "needs"} <= set(u) for u in s["unchecked"])
PYTHON
fi
run 0 check data/machine_a --json
check "no verdict" grep -q '"verdict":	"consistent"' "$work/stdout"

# ---- wrong: one line that says what and where

run 2 check
says 'check: found 0 words, expected 1 or more: MACHINE'
run 3 check "$work/none"
says 'none: No such file'
run 3 check data/machine_a data/machine_a/cogging.csv
says 'cogging.csv:.*no column `theta_m_rad`'
printf 'name,value,unit\npole_pairs,2.5,1\n' >"$work/typed/machine.csv"
run 3 check "$work/typed"
says 'machine.csv:2: `pole_pairs`: found 2.5'
: >"$work/file"
run 5 check data/machine_a -o "$work/file/x"

finish
