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
finish
