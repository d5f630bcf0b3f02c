"""What `hci-solve solve` says a limit costs against the difference of two solves, and the reason that it gives.

    python3 prices_check.py HCI_SOLVE SOURCE_DIR

Scenarios of machine A with 0.5 ohm and 1 mH. Each limit that binds is made wider and narrower by 1e-4 of itself and all
is solved again: of the first wish that limits cost something of (the mean torque, the ripple, the copper) the central
difference over the limit has to be the `gain` that the summary gives, in N·m or A² for an ampere, volt or A² of copper.
The reason, `cost`, has to be the first wish that falls short of what there is without limits.

Exit code 77: numpy, scipy or clarabel is not installed (clarabel_check.py writes the machine).
"""
import math
import os
import sys
import tempfile

import clarabel_check as check

STEP = 1e-4
TOLERANCE = 2e-2  # of the gain: where others begin to act within the step the slope is not one


def options(limits):
    return [word for name, value in limits.items() for word in (f"--{name}", repr(float(value)))]


def answer(program, folder, target, harmonics, limits):
    return check.run(program, folder, ["--target", target, "--harmonics", harmonics, "--minimise", "worst", *options(limits)],
                     f"{folder}/out")[1]


def reason(summary, free):
    """The first wish that falls short, of the figures of the result alone."""
    torque = summary["torque"]
    if abs(torque["mean_Nm"] - free["torque"]["mean_Nm"]) > 1e-6 * abs(free["torque"]["mean_Nm"]):
        return "torque"
    if torque["worst_error_Nm"] > free["torque"]["worst_error_Nm"] + 1e-6 * abs(free["torque"]["mean_Nm"]):
        return "ripple"
    return "copper" if summary["current"]["mean_square_A2"] > (1 + 1e-9) * free["current"]["mean_square_A2"] else "none"


def worth(summary):
    """Of the first wish that limits cost something of, in the unit of gain: what is missed of the mean, the ripple, the copper."""
    cost, torque = summary["limits"]["cost"], summary["torque"]
    if cost == "torque":
        return abs(torque["mean_Nm"] - summary["limits"]["wanted_mean_Nm"])
    if cost == "ripple":
        return summary["limits"]["minimised_Nm"]
    return summary["current"]["mean_square_A2"]


def main():
    program, source = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
    machine, bad, count = check.machine_a(source), 0, 0
    with tempfile.TemporaryDirectory() as work:
        machine.write(f"{work}/a")
        for k in (2, 5, 8, 11):
            target = f"{source}/data/scenarios/{k:02d}/target.csv"
            rows, free = check.run(program, f"{work}/a", ["--target", target, "--auto"], f"{work}/free{k}")
            with open(f"{work}/h{k}.csv", "w") as out:
                out.write("order,set\n" + "".join(f"{r['order']},{r['set']}\n" for r in rows))
            components = check.components_of(rows)
            wanted = [(float(r[0]), float(r[1]), float(r[2])) for r in check.read_csv(target)]
            speed = 1500 * math.pi / 30
            volts = check.Task(machine, components, wanted, None, 1.0, speed).peaks(check.coordinates(components, rows))[1]
            peak, rms = free["current"]["peak_phase_A"], free["current"]["rms_phase_A"]
            copper = 0.5 * free["current"]["mean_square_A2"]
            cases = [{"limit-current": 0.9 * peak}, {"limit-current": 0.6 * peak}, {"limit-current": 0.2 * peak},
                     {"limit-rms": 0.97 * rms}, {"limit-rms": 0.5 * rms}, {"limit-copper": 0.95 * copper}, {"limit-copper": 0.3 * copper},
                     {"limit-voltage": 0.95 * volts, "speed": 1500}, {"limit-voltage": 0.8 * volts, "speed": 1500},
                     {"limit-voltage": 0.8 * volts, "speed": 1500, "limit-current": 0.8 * peak}]
            for limits in cases:
                name = f"scenario {k} " + " ".join(f"{n[6:] if n != 'speed' else n} {v:.5g}" for n, v in limits.items())
                summary = answer(program, f"{work}/a", target, f"{work}/h{k}.csv", limits)
                said, why = summary["limits"], reason(summary, free)
                bad += why != said["cost"]
                if why != said["cost"]:
                    print(f"WRONG {name}: {said['cost']} is said, {why} falls short")
                for limit in said["limit"]:
                    option = f"limit-{limit['kind']}"
                    sides = [answer(program, f"{work}/a", target, f"{work}/h{k}.csv", {**limits, option: limits[option] * (1 + s)})
                             for s in (-STEP, STEP)]
                    low, high = (worth(s) for s in sides)
                    found = (low - high) / (2 * STEP * limit["limit"])
                    gain = limit["gain"]
                    off = abs(found - gain) / max(abs(gain), 1e-9)
                    count += 1
                    wrong = limit["binds"] and off > TOLERANCE or not limit["binds"] and abs(found) > 1e-6
                    bad += wrong
                    print(f"{'WRONG ' if wrong else ''}{name}: {said['cost']}, {limit['kind']} {'binds' if limit['binds'] else 'does not bind'}: "
                          f"gain {gain:.6g}, difference {found:.6g}, off by {off:.2g}", flush=True)
    print(f"{count} limits, {bad} wrong")
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
