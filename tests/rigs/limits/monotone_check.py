"""`hci-solve solve` within limits that widen step by step: nothing may become worse, and prices are slopes.

    python3 monotone_check.py HCI_SOLVE SOURCE_DIR {few,all} [--random COUNT]

Machine A, machine C and saturated machine C, and of the last others with each value of saturation and the wanted torque
drawn anew. Of the currents without limits a value is limited (peak current, rms current, copper loss, line voltage at a
speed) to shares of itself from 0.9 to 1.02, with each wish for the ripple. From one limit to the next

    mean, ripple, copper    none is worse unless one before it is better: the mean by 1e-6 and the ripple by 1e-5 of the
                            wanted torque (interior magnets; 1e-6 else), the copper by 1e-3 where there is no ripple
    above 1                 limits cost nothing
    gain                    where cost is the same on both sides, between the slopes to them, with a fifth of room

A line tells each answer, WRONG what does not hold. Nothing but the standard library is needed.
"""
import csv
import json
import os
import random
import shutil
import subprocess
import sys
import tempfile

SHARES = [0.9, 0.92, 0.94, 0.95, 0.955, 0.96, 0.965, 0.97, 0.975, 0.98, 0.985, 0.99, 0.993, 0.996, 0.998, 0.999, 0.9999, 1.0001, 1.01, 1.02]
FEW = [0.96, 0.98, 0.999, 1.01]
LINEAR, CURVED = 1e-6, 1e-5  # of the torque: ripple that may be more
LESS_COPPER = 1e-3
ROOM = 0.2  # of a gain


def solve(program, machine, options, out):
    run = subprocess.run([program, "solve", machine, *map(str, options), "-o", out], capture_output=True, text=True, check=False)
    if run.returncode not in (0, 1):
        return None, run.stderr.strip()
    with open(f"{out}/summary.json") as file:
        return json.load(file), run.stdout


class Answer:
    """What is compared, in the order of the wishes."""

    def __init__(self, summary, wish, wanted):
        self.limits = summary["limits"]
        self.cost = self.limits["cost"]
        self.missed = abs(summary["torque"]["mean_Nm"] - wanted)
        self.copper = summary["current"]["mean_square_A2"]
        least = self.limits["minimised_Nm"]
        self.ripple = summary["torque"]["worst_error_Nm"] if wish == "worst" and least is not None else least or 0.0
        entry = self.limits["limit"][0]
        self.limit = entry["limit"]
        self.gain = entry["gain"] if entry["binds"] else 0.0

    def worth(self):
        return {"torque": self.missed, "ripple": self.ripple, "copper": self.copper}.get(self.cost)


def worse(narrow, wide, wanted, ripple):
    """What is worse with the wider limit."""
    if wide.missed > narrow.missed + 1e-6 * wanted:
        return "mean"
    if wide.missed < narrow.missed - 1e-6 * wanted:
        return None
    if wide.ripple > narrow.ripple + ripple * wanted:
        return "ripple"
    if max(wide.ripple, narrow.ripple) < 1e-6 * wanted and wide.copper > (1.0 + LESS_COPPER) * narrow.copper:
        return "copper"
    return None


def is_price(before, at, after, least):
    """Whether the gain is between the slopes to both sides, as that of a convex function is."""
    if at.gain is None or not before.cost == at.cost == after.cost or at.worth() is None:
        return True
    left, right = ((a.worth() - b.worth()) / (b.limit - a.limit) for a, b in ((before, at), (at, after)))
    noise = least / (after.limit - at.limit)
    return min(left, right) * (1.0 - ROOM) - noise <= at.gain <= max(left, right) * (1.0 + ROOM) + noise


def sweep(program, name, machine, options, wanted, kind, value, shares, wish, is_linear, out):
    """Solves at each share of the value; returns how much is wrong."""
    answers, bad = [], 0
    for share in shares:
        limit = f"{share * value!r}{'x' if kind == 'copper' else ''}"
        summary, words = solve(program, machine, [*options, f"--limit-{kind}", limit, "--minimise", wish], out)
        if summary is None:
            print(f"WRONG {name} {kind} {share}: {words}", flush=True)
            bad += 1
            continue
        a = Answer(summary, wish, wanted)
        answers.append((share, a))
        print(f"{name} {kind} {wish} {share} × {value:.6g}: {a.cost}, mean off by {a.missed:.2g}, ripple {a.ripple:.6g} N·m, copper {a.copper:.7g} A², "
              f"gain {a.gain}, {summary['current']['components']} components", flush=True)
        if share > 1.0 and a.cost != "none":
            print(f"WRONG {name} {kind} {wish} {share}: a limit that is not reached costs {a.cost}")
            bad += 1
    steps = LINEAR if is_linear else CURVED
    for (_, narrow), (share, wide) in zip(answers, answers[1:]):
        what = worse(narrow, wide, wanted, steps)
        bad += what is not None
        if what:
            print(f"WRONG {name} {kind} {wish} {share}: {what} is worse than with a narrower limit")
    for (_, before), (share, at), (_, after) in zip(answers, answers[1:], answers[2:]):
        if not is_price(before, at, after, (steps if at.cost == "ripple" else 1e-6) * wanted):
            print(f"WRONG {name} {kind} {wish} {share}: gain {at.gain} is not between the slopes to both sides")
            bad += 1
    return bad


def drawn(source, seed, folder):
    """Saturated machine C with other values of its saturation."""
    draw = random.Random(seed)
    shutil.copytree(f"{source}/data/machine_c_saturated", folder)
    with open(f"{folder}/effects.csv") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    with open(f"{folder}/effects.csv", "w") as file:
        for row in rows:
            if rows.index(row) > 0 and row[0] in ("saturation", "reluctance"):
                row[2] = repr(float(row[2]) * draw.uniform(0.5, 1.5))
            file.write(",".join(row) + "\n")
    return draw.uniform(3.0, 10.0)


def cases(source, work, count):
    yield "A", f"{source}/data/machine_a", 2.46, [1000.0, 2000.0], True
    yield "C", f"{source}/data/machine_c", 8.0, [400.0, 600.0], False
    yield "saturated C", f"{source}/data/machine_c_saturated", 8.0, [400.0], False
    for seed in range(count):
        folder = f"{work}/drawn{seed}"
        yield f"drawn {seed}", folder, drawn(source, seed, folder), [300.0], False


def limited(program, machine, options, speeds, out):
    """Kinds of limits with the options they need and their values without limits."""
    free, words = solve(program, machine, options, out)
    if free is None:
        sys.exit(words)
    current = free["current"]
    yield "current", [], current["peak_phase_A"]
    yield "rms", [], current["rms_phase_A"]
    yield "copper", [], current["loss_ratio_to_plain"]
    for speed in speeds:
        at_speed, words = solve(program, machine, [*options, "--speed", speed, "--limit-voltage", "1e5"], out)
        if at_speed is not None:
            yield "voltage", ["--speed", speed], at_speed["current"]["peak_line_voltage_V"]


def main():
    program, source = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
    is_few = sys.argv[3] == "few"
    count = int(sys.argv[5]) if len(sys.argv) > 5 else 0
    bad = 0
    with tempfile.TemporaryDirectory() as work:
        for name, machine, wanted, speeds, is_linear in cases(source, work, count):
            target, out = f"{work}/target.csv", f"{work}/out"
            with open(target, "w") as file:
                file.write(f"order,amplitude_Nm,phase_rad\n0,{wanted!r},1.5707963267948966\n")
            for kind, more, value in limited(program, machine, ["--target", target], speeds, out):
                for wish in ("worst", "peak-to-peak", "rms"):
                    if is_few and (wish != "worst" or kind != "current"):
                        continue
                    bad += sweep(program, name, machine, ["--target", target, *more], wanted, kind, value, FEW if is_few else SHARES, wish, is_linear, out)
    print(f"{bad} wrong")
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
