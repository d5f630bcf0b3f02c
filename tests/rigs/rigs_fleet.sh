#!/bin/sh
# A line of motors from equations of its own (tests/rigs/fleet): `fit` finds what each of them has, within its standard errors, in folders and in
# fleet.sqlite. Takes some seconds.
#   rigs_fleet.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
use_plain_build

"$built/tests/motors" 60 5 "$work/line" 1 0.2 || fail "motors"
run 0 batch "$work/line/motors.csv" --command fit --jobs 2 -q -o "$work/fitted"
cat >"$work/compare.py" <<'PY'
import csv, glob, sqlite3, sys
line, fitted = sys.argv[1:]
truth = {row["motor"]: row for row in csv.DictReader(open(line + "/truth.csv"))}
base = sqlite3.connect(fitted + "/fleet.sqlite")
if base.execute("SELECT count(*) FROM motor WHERE state = 'done' AND seconds > 0").fetchone()[0] != len(truth):
    sys.exit("fleet.sqlite has not each motor")
squares = []
for name, row in truth.items():
    if row["fault"] == "pole":
        continue
    found = {(p["effect"], p["parameter"]): p for p in csv.DictReader(open(f"{fitted}/motors/{name}/parameters.csv"))}
    phases = [float(row["phase_" + s]) for s in "abc"]
    mean = sum(phases) / 3
    flux = float(row["magnets"])
    common = (1 + flux) * (1 + mean) - 1
    wanted = {("back_emf", "common"): common, ("position_offset", "angle"): float(row["offset_rad"]),
              ("friction", "coulomb"): float(row["coulomb_Nm"]) - 0.03}
    for s, phase in zip("abc", phases):
        wanted["phase_imbalance", s] = (1 + flux) * (phase - mean)
    for key, value in wanted.items():
        p = found[key]
        z = (float(p["value"]) - value) / float(p["std_error"])
        squares.append(z * z)
        if abs(z) > 5:
            sys.exit(f"{name} {key}: found {p['value']} ± {p['std_error']}, is {value}")
        kept = base.execute("SELECT value FROM parameter WHERE motor = ? AND effect = ? AND parameter = ?", (name, *key)).fetchone()
        if kept[0] != float(p["value"]):
            sys.exit(f"{name} {key}: fleet.sqlite has {kept}")
mean = sum(squares) / len(squares)
print(f"{len(squares)} values, mean square of (found - true)/standard error {mean:.3g}")
if not 0.7 < mean < 1.4:
    sys.exit("standard errors are not those of the noise")
PY
check "$(python3 "$work/compare.py" "$work/line" "$work/fitted" 2>&1 | tail -n 1)" python3 "$work/compare.py" "$work/line" "$work/fitted"

# Shares are joined to the rows of the whole; the hidden faults are caught and named.
for share in 1 2; do run 0 batch "$work/line/motors.csv" --command fit --jobs 2 -q --shard $share/2 -o "$work/share$share"; done
run 0 fleet "$work/share1" "$work/share2" -q -o "$work/joined"
run 0 fleet "$work/fitted" -o "$work/whole"
says '^stand out: [0-9]+ of 60 motors' 'limit +3\.9' 'phase_imbalance b: -'
check "joined shares are not the whole" diff -r "$work/whole" "$work/joined"
check "fleet.csv is not that of the batch" cmp -s "$work/whole/fleet.csv" "$work/fitted/fleet.csv"
python3 "$source_dir/tests/rigs/fleet/score.py" "$work/whole" "$work/line/truth.csv" --require 0.95 0.04 >"$work/stdout" 2>&1 || fail "score"
# A motor that stands out is not drawn to the others: what it has beside the mean is what was fitted.
cat >"$work/own.py" <<'PY'
import csv, sys
fitted, whole = sys.argv[1:]
mean = {(row["effect"], row["parameter"]): float(row["mean"]) for row in csv.DictReader(open(whole + "/line.csv")) if row["mean"]}
out = [row for row in csv.DictReader(open(whole + "/deviations.csv")) if row["stands_out"] == "yes" and row["effect"] != "residual"]
for row in out:
    key = row["effect"], row["parameter"]
    (found,) = [float(p["value"]) for p in csv.DictReader(open(f"{fitted}/motors/{row['motor']}/parameters.csv")) if (p["effect"], p["parameter"]) == key]
    (own,) = [float(value) for name, value in row.items() if name == "_".join(key) or name.startswith("_".join(key) + "_")]
    if abs(own - (found - mean[key])) > 1e-6 * abs(found):
        sys.exit(f"{row['motor']} {key}: {own}, fitted {found}, mean {mean[key]}")
sys.exit(0 if len(out) > 3 else "none stands out")
PY
check "$(python3 "$work/own.py" "$work/fitted" "$work/whole" 2>&1 | tail -n 1)" python3 "$work/own.py" "$work/fitted" "$work/whole"
if command -v parallel >/dev/null; then
    shown='examples/fleet/parallel.sh'
    HCI_SOLVE=$hci_solve JOBS=2 "$source_dir/examples/fleet/parallel.sh" "$work/line/motors.csv" fit 2 "$work/parallel" >"$work/stdout" 2>"$work/stderr" || fail "GNU parallel"
    check "shares by GNU parallel are not the whole" diff -r "$work/whole" "$work/parallel/line"
else
    echo "skipped: no GNU parallel here"
fi
run 2 fleet "$work/fitted" -o "$work/fitted"
says 'the folder of a batch'
run 3 fleet "$work/line"
says 'fleet.csv: cannot be read'
finish
