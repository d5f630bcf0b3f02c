"""Machines and recordings of currents and torques of another size, and whether results differ by that size alone.

    scaled.py scale A T FROM TO NAME...    copies CSV files and machine folders, currents times A and torques times T
    scaled.py compare A T ONE OTHER        the results in OTHER are those in ONE, so scaled: names of columns, keys and values that are not

Speeds, angles and times stay, so voltages go by T/A, inductances and resistances by T/A², inertias and powers by T.
"""
import csv
import json
import math
import pathlib
import re
import sys


def factors(a, t):
    """Of the units that files and results have."""
    return {"A": a, "Nm": t, "V": t / a, "Nm_per_A": t / a, "V_per_rad_per_s": t / a, "H": t / a**2, "mH": t / a**2, "ohm": t / a**2,
            "kgm2": t, "W": t, "Nms_per_rad": t, "Nms2_per_rad2": t, "Nm_per_rad_per_s": t, "Nm_per_A2": t / a**2, "Nm_per_A3": t / a**3, "H_per_A": t / a**3,
            "H_per_A2": t / a**4, "Nm2": t * t, "A2": a * a, "J": t,
            "A_per_Nm": a / t, "mNm": t}


KINDS = {"current": "A", "rms": "A", "voltage": "V", "copper": "A2"}  # of limits
LEFT_OUT = {"sweep.csv"}  # words and numbers of all kinds


def factor_of_name(name, units):
    """By the unit that ends a name, the longest that does; 1 where none does. Currents in the frame dq_x are times the back-EMF."""
    if "dqx" in name:
        return units["Nm"]
    found = [unit for unit in units if name == unit or name.endswith("_" + unit)]
    return units[max(found, key=len)] if found else 1.0


def number(text):
    try:
        return float(text)
    except (TypeError, ValueError):
        return None


def rows_of(path):
    with open(path, newline="") as file:
        return [row for row in csv.reader(file) if row and not row[0].startswith("#")]


def scaled_row(header, row, units):
    """A row with a cell `unit` has its own, which its value and error are in; else the columns have theirs."""
    own = units.get(row[header.index("unit")], 1.0) if "unit" in header else None
    for k, cell in enumerate(row):
        x = number(cell)
        factor = (own if header[k] in ("value", "std_error", "minimum", "maximum") else 1.0) if own else factor_of_name(header[k], units)
        yield x * factor if x is not None and factor != 1.0 else cell


def scale_file(path, to, units):
    rows = rows_of(path)
    to.parent.mkdir(parents=True, exist_ok=True)
    with open(to, "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([rows[0]] + [[repr(c) if isinstance(c, float) else c for c in scaled_row(rows[0], row, units)] for row in rows[1:]])


def scale(units, source, to, names):
    for name in names:
        path = source / name
        for file in sorted(path.glob("*.csv")) if path.is_dir() else [path]:
            scale_file(file, to / file.relative_to(source), units)


def same(x, y, size):
    """Some numbers are written with three digits, and some are rounding alone."""
    return abs(x - y) <= 6e-3 * max(abs(x), abs(y)) + 1e-7 * size + 1e-16


def values_of(value, units, name="", own=1.0):
    """(name, number times its factor) and (name, word) of JSON; sentences hold rounded numbers and are left out. What stands beside a
    `unit`, or a `kind` of limit, is in it, and a `gain` is a torque for each of it."""
    if isinstance(value, dict):
        own = units.get(value.get("unit", KINDS.get(value.get("kind"))), 1.0)
        for key, inner in value.items():
            yield from values_of(inner, units, f"{name}.{key}", units["Nm"] / own if key == "gain" and "kind" in value else own)
    elif isinstance(value, list):
        for inner in value:
            yield from values_of(inner, units, name, own)
    elif isinstance(value, (int, float)) and not isinstance(value, bool):
        is_own = own != 1.0 and name.rsplit(".", 1)[-1] in ("value", "limit", "gain", "std_error")
        yield name, value * (own if is_own else factor_of_name(name, units))
    elif isinstance(value, str) and not re.search(r"\d", value):
        yield name, value


def cells_of(path, units):
    rows = rows_of(path)
    for row in rows[1:]:
        for name, cell, new in zip(rows[0], row, scaled_row(rows[0], row, units)):
            x = number(new)
            if name == "torque_phase_rad":  # of amplitudes that are rounding
                continue
            if x is not None or not re.search(r"\d", cell):
                yield name, cell if x is None else x


def read(path, units):
    values = values_of(json.loads(path.read_text()), units) if path.suffix == ".json" else cells_of(path, units)
    found = {}
    for name, value in values:
        found.setdefault(name, []).append(value)
    return found


def differences(one, other):
    """Names whose values differ by more than rounding, and by 1e-7 of the largest of the same name."""
    for name in sorted({*one, *other}):
        x, y = one.get(name, []), other.get(name, [])
        size = max((abs(v) for v in x if isinstance(v, float) and math.isfinite(v)), default=0.0)
        if len(x) != len(y):
            yield name, f"{len(x)} and {len(y)} values"
        for p, q in zip(x, y):
            if (p != q) if isinstance(p, str) or isinstance(q, str) else not same(p, q, size):
                yield name, f"{p} and {q}"
                break


def compare(units, one, other):
    """Of the folders that OTHER has."""
    plain, count, off = {unit: 1.0 for unit in units}, 0, 0
    for folder in other.iterdir():
        missing = sorted(p.name for p in (one / folder.name).rglob("*.*") if not (other / p.relative_to(one)).exists())
        off += len(missing)
        print("".join(f"{folder.name}: no {name}\n" for name in missing), end="")
    for path in sorted(p for p in [*other.rglob("*.csv"), *other.rglob("summary.json")] if p.name not in LEFT_OUT):
        there = one / path.relative_to(other)
        for name, words in differences(read(there, units), read(path, plain)) if there.exists() else [("", "is one more")]:
            off += 1
            print(f"{path.relative_to(other)} {name}: {words}")
        count += 1
    print(f"{count} files, {off} names of values differ")
    return off > 0 or count == 0


def main():
    what, a, t, *rest = sys.argv[1:]
    units = factors(float(a), float(t))
    if what == "scale":
        return scale(units, pathlib.Path(rest[0]), pathlib.Path(rest[1]), rest[2:])
    return compare(units, pathlib.Path(rest[0]), pathlib.Path(rest[1]))


sys.exit(main())
