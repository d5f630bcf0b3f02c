"""solve, emit --drive and simulate --table of three salient machines against plant.py; exit code 1 where they differ.

    python3 tests/rigs/salient/score.py build/release/hci-solve
"""
import json
import subprocess
import sys
import tempfile

import numpy as np
from scipy.optimize import least_squares

import plant
from plant import TURN, Machine

GRID = np.linspace(0, TURN, 361)[:-1]
SETS = (((1, 1),), ((1, 1), (5, -1), (7, 1)), ((1, 1), (5, -1), (7, 1), (11, -1), (13, 1)))
worse = 0


def dq(d, q, of_d=(), of_q=(), mutual=()):
    def inductance(t):
        of = np.zeros(t.shape + (2, 2))
        of[..., 0, 0] = d + sum((a * np.cos(n * t + g) for n, a, g in of_d), 0 * t)
        of[..., 1, 1] = q + sum((a * np.cos(n * t + g) for n, a, g in of_q), 0 * t)
        of[..., 0, 1] = of[..., 1, 0] = sum((a * np.sin(n * t + g) for n, a, g in mutual), 0 * t)
        return of

    return inductance


def uneven(t, of):
    of = of.copy()
    of[..., 0, 0] += 6e-4 + 1e-4 * np.cos(2 * t + 0.3)
    of[..., 1, 2] -= 1e-4
    of[..., 2, 1] -= 1e-4
    return of


MACHINES = {  # with the torque that is wanted
    "interior": (Machine(4, [(1, 0.30, 0), (5, 0.012, 0.4), (7, 0.008, -1), (11, 0.004, 2)], [(6, 0.05, 0.3), (12, 0.03, 1.1)],
                         dq(0.002, 0.0052, [(6, 1.2e-4, 0.5)], [(6, 3e-4, -0.2), (12, 8e-5, 1)], [(6, 1e-4, 0.3)]), 0.35), 4),
    "uneven": (Machine(3, [(1, 0.5, 0), (3, 0.06, 0.2), (5, 0.03, 1), (7, 0.01, 0)], [(6, 0.02, 0), (2, 0.05, 0.7)],
                       dq(0.0061, 0.0039, [(6, 1e-4, 0)]), 0.8, uneven), 6),
    "reluctance": (Machine(5, [(1, 0.08, 0), (5, 0.004, 0)], [(12, 0.02, 0.5)],
                           dq(0.001, 0.0045, [(6, 5e-5, 1)], [(6, 4e-4, 0)], [(6, 1.5e-4, 0)]), 0.12), 3)}


def say(what, found, true, share, floor=0.0):
    global worse
    good = abs(found - true) <= share * abs(true) + floor
    worse += not good
    print(f"  {what:44} {found:10.4g} {true:10.4g}{'' if good else '   DIFFERS'}", flush=True)


def run(program, *words):
    done = subprocess.run([program, *map(str, words), "-q", "--json"], capture_output=True, text=True)
    if done.returncode > 1:
        sys.exit(done.stderr)
    return json.loads(done.stdout)


def squared_error(machine, wanted, phases):
    """Sum of the squared amplitudes of the torque less the wanted one."""
    off = machine.torque(GRID, phases) - wanted
    return 2 * (off**2).mean() - off.mean() ** 2


def least(machine, wanted, components, start):
    """The least of it near currents: coordinates of scipy's least squares."""
    columns = []
    for order, sequence in components:
        at = order * GRID[:, None] - sequence * plant.PHASES
        columns += [np.sin(at), np.cos(at)]
    columns = np.array(columns)
    x = np.linalg.lstsq(columns.reshape(len(columns), -1).T, start.ravel(), rcond=None)[0]

    def off(x):
        spectrum = np.fft.rfft(machine.torque(GRID, np.tensordot(x, columns, 1)) - wanted) / len(GRID)
        return np.r_[spectrum[0].real, 2 * spectrum[1:90].real, 2 * spectrum[1:90].imag]

    return 2 * least_squares(off, x, xtol=1e-13, ftol=1e-13).cost


def few(program, work, name, machine, wanted):
    for components in SETS:
        words = {1: "pos", -1: "neg"}
        plant.write_table(f"{work}/set.csv", "order,set", [(n, words[s]) for n, s in components])
        run(program, "solve", f"{work}/{name}", "--target", f"{work}/target.csv", "--harmonics", f"{work}/set.csv", "--ignore-ratings",
            "-o", f"{work}/few")
        found = plant.currents_of(f"{work}/few")(GRID)
        error = squared_error(machine, wanted, found)
        say(f"squared error, {len(components)} components", error, least(machine, wanted, components, found), 0.02, 1e-10 * wanted**2)


def between(program, work, name, machine, wanted):
    dq_of, folders = [], []
    for torque in (-wanted, 0, wanted):
        folder = f"{work}/level_{torque}"
        plant.write_table(f"{work}/level.csv", "order,amplitude_Nm,phase_rad", [(0, torque, 0)])
        run(program, "solve", f"{work}/{name}", "--target", f"{work}/level.csv", "--auto", "--ignore-ratings", "-o", folder)
        dq_of.append(plant.to_dq(GRID, plant.currents_of(folder)(GRID)))
        folders.append(folder)
    told = run(program, "emit", *folders, "--name", "t", "--machine", f"{work}/{name}", "--drive", f"{work}/drive.csv", "-o", f"{work}/c")
    mean, ripple = 0.0, 0.0
    for u in (-0.75, -0.5, -0.25, 0.25, 0.5, 0.75):
        x = dq_of[0] * u * (u - 1) / 2 + dq_of[1] * (1 - u * u) + dq_of[2] * u * (u + 1) / 2
        off = machine.torque(GRID, plant.to_phases(GRID, x)) - u * wanted
        mean, ripple = max(mean, abs(off.mean())), max(ripple, np.ptp(off))
    say("mean off between levels, N m", abs(told["between_mean_off_Nm"]), mean, 0.005, 1e-4 * wanted)
    say("ripple between levels, N m", told["between_ripple_Nm"], ripple, 0.01, 5e-4 * wanted)


def loop(program, work, name, machine, wanted, rpm):
    told = run(program, "simulate", f"{work}/{name}", "--table", f"{work}/all", "--drive", f"{work}/drive.csv", "--speeds", rpm)
    row = {r["remedy"]: r for r in told["speeds"][0]["remedies"]}
    speed_e = rpm * TURN / 60 * machine.pole_pairs
    theta = np.arange(3601) * TURN / 3600
    table = plant.to_dq(theta, plant.currents_of(f"{work}/all")(theta))
    reads = lambda at: np.array([np.interp(at % TURN, theta, table[:, 0]), np.interp(at % TURN, theta, table[:, 1])])
    mean, ripple = plant.loop_ripple(machine, speed_e, reads)
    say(f"{rpm} rpm, table: T_ripple, %", row["table"]["T_ripple"], ripple, 0.005)
    say(f"{rpm} rpm, table: mean, N m", row["table"]["mean_Nm"], mean, 0.0005)


def main(program):
    with tempfile.TemporaryDirectory() as work:
        plant.write_table(f"{work}/drive.csv", "name,value,unit", [("decoupling", "constant", "")])
        for name, (machine, wanted) in MACHINES.items():
            print(f"{name}, {wanted} N m: of hci-solve, and true")
            machine.write(f"{work}/{name}", 2000)
            plant.write_table(f"{work}/target.csv", "order,amplitude_Nm,phase_rad", [(0, wanted, 0)])
            run(program, "solve", f"{work}/{name}", "--target", f"{work}/target.csv", "--auto", "--ignore-ratings", "-o", f"{work}/all")
            made = machine.torque(GRID, plant.currents_of(f"{work}/all")(GRID))
            say("mean torque of --auto, N m", wanted, made.mean(), 1e-6)
            say("T_ripple of --auto, %", 0.0, 100 * np.ptp(made) / wanted, 0, 1e-3)
            few(program, work, name, machine, wanted)
            between(program, work, name, machine, wanted)
            loop(program, work, name, machine, wanted, 300.0)
    return 1 if worse else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
