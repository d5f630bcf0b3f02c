"""`hci-solve solve` within limits against clarabel, an independent solver of conic programs.

    python3 clarabel_check.py HCI_SOLVE SOURCE_DIR {few,scenarios,random} [COUNT]

The task is built anew from the physics: torque of each component by sampling e·i over the turn and a Fourier
transform, voltages by R i + ω L di/dθ + ω_m e, peaks on a dense grid with refinement. Nothing of the project's
matrices is used, only the files that it writes. Each wish is solved with what the project got for the wishes before:

    mean     |mean − wanted| cannot be smaller
    ripple   at the project's mean torque the worst order cannot be smaller
    copper   at the project's mean torque and worst order the copper cannot be smaller

Next to the smallest ripple the copper is steep: 1e-9 of a limit can be worth 3e-5 of it, and no solver keeps a limit
closer. Where the copper is off by more than 1e-6 it is held against that of limits which are 1e-9 wider and tighter.

Exit code 77: numpy, scipy or clarabel is not installed.
"""
import csv
import json
import math
import os
import subprocess
import sys
import tempfile

try:
    import clarabel
    import numpy as np
    import scipy.sparse as sparse
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)

TOLERANCE = 1e-6  # of the mean torque, and of the copper loss
TIGHTER = 2e-9  # share by which the project takes limits tighter, lest a peak be above
TURN = 2.0 * math.pi


class Machine:
    """A star machine with constant inductance, as a folder and as functions of the angle."""

    def __init__(self, pole_pairs, emf, cogging, resistance, inductance):
        self.pole_pairs, self.emf, self.cogging = pole_pairs, emf, cogging
        self.resistance, self.inductance = resistance, inductance

    def write(self, folder):
        os.makedirs(folder)
        with open(f"{folder}/machine.csv", "w") as out:
            out.write("name,value,unit,source\n"
                      f"pole_pairs,{self.pole_pairs},1,made up\nresistance,{self.resistance!r},ohm,made up\n"
                      f"inductance_d,{self.inductance!r},H,made up\ninductance_q,{self.inductance!r},H,made up\n")
        for name, column, rows in (("back_emf", "amplitude_Nm_per_A", self.emf), ("cogging", "amplitude_Nm", self.cogging)):
            with open(f"{folder}/{name}.csv", "w") as out:
                out.write(f"order,{column},phase_rad\n")
                for order, amplitude, phase in rows:
                    out.write(f"{order!r},{float(amplitude)!r},{float(phase)!r}\n")

    def e(self, theta):
        return np.array([sum(a * np.sin(n * (theta - TURN * s / 3) + g) for n, a, g in self.emf) for s in range(3)])

    def cogging_torque(self, theta):
        return sum((a * np.sin(n * theta + g) for n, a, g in self.cogging), np.zeros_like(theta))


def basis(components, theta, slope=False):
    """Phase currents (3, angles, 2·components) for S = 1 or C = 1 of each component, or their slopes."""
    columns = np.empty((3, len(theta), 2 * len(components)))
    for s in range(3):
        for k, (n, sigma) in enumerate(components):
            u = n * theta - sigma * TURN * s / 3
            columns[s, :, 2 * k] = n * np.cos(u) if slope else np.sin(u)
            columns[s, :, 2 * k + 1] = -n * np.sin(u) if slope else np.cos(u)
    return columns


class Task:
    """What is wanted and allowed, in rows over the coordinates x."""

    def __init__(self, machine, components, target, limit_A, line_V, speed):
        self.machine, self.components, self.target = machine, components, target
        self.limit_A, self.line_V, self.speed = limit_A, line_V, speed
        self.top = max(n for n, _ in components)
        self.make_torque()

    def make_torque(self):
        """Spectrum of the torque, by the transform of samples: rows S and C of each order that a component reaches."""
        orders = self.top + max(n for n, _, _ in self.machine.emf) + max([n for n, _, _ in self.machine.cogging] + [0])
        count = 4 * int(orders + 8)
        theta = TURN * np.arange(count) / count
        torque = np.einsum("sk,skj->kj", self.machine.e(theta), basis(self.components, theta))
        wanted = sum((a * np.sin(n * theta + g) for n, a, g in self.target), np.zeros_like(theta))
        rest = wanted - self.machine.cogging_torque(theta)
        u, h = np.fft.rfft(torque, axis=0) * 2 / count, np.fft.rfft(rest) * 2 / count
        self.mean_u, self.mean_h = u[0].real / 2, h[0].real / 2
        keep = [m for m in range(1, count // 2) if np.abs(u[m]).max() > 1e-12]
        self.u = np.array([[-u[m].imag, u[m].real] for m in keep])  # order, (S, C), coordinate
        self.h = np.array([[-h[m].imag, h[m].real] for m in keep])

    def limited(self, theta):
        """Rows and constants of all that is limited at some angles, over the limits."""
        i, e = basis(self.components, theta), self.machine.e(theta)
        rows, constants = [], []
        if self.limit_A:
            rows += [i[s] / self.limit_A for s in range(3)]
            constants += [np.zeros(len(theta))] * 3
        if self.line_V:
            v = self.machine.resistance * i + self.machine.pole_pairs * self.speed * self.machine.inductance * basis(
                self.components, theta, slope=True)
            for s in range(3):
                rows.append((v[s] - v[(s + 1) % 3]) / self.line_V)
                constants.append(self.speed * (e[s] - e[(s + 1) % 3]) / self.line_V)
        return np.array(rows), np.array(constants)

    def peaks(self, x, beyond=1 + 3e-10):
        """Angles of all local peaks that are beyond a share of the limit, refined, and the largest share."""
        count = int(64 * max(self.top, max(n for n, _, _ in self.machine.emf)))
        step = TURN / count
        theta = step * np.arange(count)
        rows, constants = self.limited(theta)
        value = np.abs(rows @ x + constants)
        found, most = [], 0.0
        for q in range(len(value)):
            v = value[q]
            for k in np.flatnonzero((v >= np.roll(v, 1)) & (v > np.roll(v, -1)) & (v > 0.98)):
                at, width = theta[k], step
                for _ in range(6):
                    r, c = self.limited(np.array([at - width, at, at + width]))
                    low, middle, high = np.abs(r[q] @ x + c[q])
                    bend = low - 2 * middle + high
                    if bend < 0:
                        at += max(-1.0, min(1.0, 0.5 * (low - high) / bend)) * width
                    width *= 0.3
                r, c = self.limited(np.array([at]))
                peak = float(np.abs(r[q] @ x + c[q])[0])
                most = max(most, peak)
                if peak > beyond:
                    found.append((q, at))
        return found, max(most, float(value.max()))

    def mean(self, x):
        return float(self.mean_u @ x)

    def worst(self, x):
        error = self.u @ x - self.h
        return float(np.hypot(error[:, 0], error[:, 1]).max()) if len(self.h) else 0.0


def conic(p, q, a, b, cones):
    """The answer of clarabel, as exact as it can get: rows that nearly repeat each other are hard for it."""
    for tolerance in (1e-9, 1e-8, 1e-7):
        for price in (p, 0.0 * p, 1e3 * p) if p.max() < 1.0 else (p,):
            settings = clarabel.DefaultSettings()
            settings.verbose = False
            settings.tol_gap_abs = settings.tol_gap_rel = settings.tol_feas = tolerance
            answer = clarabel.DefaultSolver(price, q, sparse.csc_matrix(a), b, cones, settings).solve()
            if str(answer.status) in ("Solved", "PrimalInfeasible"):
                return answer
    return answer


def solve(task, wish, mean=None, worst=None, near=None):
    """Optimum of one wish: peaks beyond the limits are added until there are none. near: currents whose peaks are
    among the first angles, which saves rounds; rows of any angles are rows of the task."""
    n = 2 * len(task.components)
    scale = task.limit_A or 10.0
    extra = 0 if wish == "copper" else 1
    best, most = None, math.inf
    kinds = len(task.limited(np.zeros(1))[0])
    theta = TURN * (0.0137 + np.arange(4 * int(task.top))) / (4 * int(task.top))
    places = [(q, at) for q in range(kinds) for at in theta]
    if near is not None:
        places += task.peaks(near, 0.99)[0]
    for _ in range(40):
        rows, constants = task.limited(np.array([at for _, at in places]))
        which = np.array([q for q, _ in places])
        g = rows[which, np.arange(len(places))] * scale
        c = constants[which, np.arange(len(places))]
        pad = np.zeros((len(g), extra))
        a, b, cones = [np.hstack([g, pad]), np.hstack([-g, pad])], [1 - c, 1 + c], [clarabel.NonnegativeConeT(2 * len(g))]
        mean_row = np.hstack([task.mean_u * scale, np.zeros(extra)])
        if wish == "mean":
            side = np.zeros(n + 1)
            side[n] = 1.0
            a += [(mean_row - side)[None], (-mean_row - side)[None]]
            b += [np.array([task.mean_h]), np.array([-task.mean_h])]
            cones.append(clarabel.NonnegativeConeT(2))
        else:
            a.append(mean_row[None])
            b.append(np.array([mean]))
            cones.append(clarabel.ZeroConeT(1))
            for u, h in zip(task.u, task.h):
                head = np.zeros(n + extra)
                if wish == "ripple":
                    head[n] = -1.0
                a.append(np.vstack([head, np.hstack([u * scale, np.zeros((2, extra))])]))
                b.append(np.array([0.0 if wish == "ripple" else worst, h[0], h[1]]))
                cones.append(clarabel.SecondOrderConeT(3))
        p = sparse.diags([1.0 if wish == "copper" else 1e-10] * n + [0.0] * extra, format="csc")
        q = np.zeros(n + extra)
        if extra:
            q[n] = 1.0
        answer = conic(p, q, np.vstack(a), np.concatenate(b), cones)
        if str(answer.status) not in ("Solved", "AlmostSolved"):
            return best, f"clarabel says {answer.status} with {len(places)} angles; the round before is {most} of a limit"
        x = scale * np.array(answer.x[:n])
        best = 1.5 * float(x @ x) if wish == "copper" else float(answer.x[n])
        found, most = task.peaks(x)
        if most < 1 + 1e-9:
            return best, ""
        value = np.abs(g @ x / scale + c)
        places = [place for place, v in zip(places, value) if v > 0.6] + found
    return best, ""


def run(program, folder, arguments, out):
    done = subprocess.run([program, "solve", folder, "-q", "-o", out, *arguments], capture_output=True, text=True)
    if done.returncode > 1:
        raise SystemExit(f"hci-solve {' '.join(arguments)}: {done.stderr}")
    with open(f"{out}/currents.csv") as file:
        rows = list(csv.DictReader(file))
    with open(f"{out}/summary.json") as file:
        return rows, json.load(file)


def coordinates(components, rows):
    x = np.zeros(2 * len(components))
    for row in rows:
        k = components.index((float(row["order"]), {"pos": 1, "neg": -1}[row["set"]]))
        a, g = float(row["amplitude_A"]), float(row["phase_rad"])
        x[2 * k:2 * k + 2] = a * math.cos(g), a * math.sin(g)
    return x


class Tally:
    """Largest deviations, and what was beyond the tolerance."""

    def __init__(self):
        self.cases = self.limited = self.steep = 0
        self.most = {"mean": 0.0, "ripple": 0.0, "copper": 0.0, "peak": 0.0}
        self.bad, self.open = [], []

    def note(self, name, what, deviation, allowed):
        self.most[what] = max(self.most[what], deviation)
        if not deviation <= allowed:
            self.bad.append(f"{name}: {what} off by {deviation:.3g} (allowed {allowed:.3g})")


    def judge(self, name, what, ours, theirs, why, scale, room=0.0):
        """Where clarabel stops between, theirs is of fewer rows than the task and so a lower bound: a current that
        keeps all limits and comes as near to it is the best; one that does not leaves it open."""
        deviation = math.inf if theirs is None else (ours - theirs) / scale
        if why and not deviation <= TOLERANCE + room:
            self.open.append(f"{name}: {what}: {why}")
        else:
            self.note(name, what, abs(deviation), TOLERANCE + room)


def compare(program, machine, target, name, tally, work, limits):
    """One case: limit_A, or line_V with a speed in rad/s, and the components."""
    folder = f"{work}/{name.replace(' ', '_').replace('/', '_')}"
    machine.write(folder)
    with open(f"{folder}/target.csv", "w") as out:
        out.write("order,amplitude_Nm,phase_rad\n" + "".join(f"{n!r},{a!r},{g!r}\n" for n, a, g in target))
    with open(f"{folder}/harmonics.csv", "w") as out:
        out.write("order,set\n" + "".join(f"{n!r},{'pos' if s > 0 else 'neg'}\n" for n, s in limits["components"]))
    arguments = ["--target", f"{folder}/target.csv", "--harmonics", f"{folder}/harmonics.csv", "--minimise", "worst"]
    if limits.get("limit_A"):
        arguments += ["--limit-current", repr(limits["limit_A"])]
    if limits.get("line_V"):
        arguments += ["--limit-voltage", repr(limits["line_V"]), "--speed", repr(limits["speed"] * 30 / math.pi)]
    rows, summary = run(program, folder, arguments, f"{folder}/out")
    task = Task(machine, limits["components"], target, limits.get("limit_A"), limits.get("line_V"), limits.get("speed", 0.0))
    x = coordinates(limits["components"], rows)
    scale = max(abs(task.mean_h), 1e-3 * max([a for _, a, _ in target] + [1e-9]))
    tally.cases += 1
    tally.limited += summary["limits"]["cost"] != "none"
    if summary["limits"]["cost"] == "limits":
        answer, why = solve(task, "mean")
        tally.note(name, "mean", 0.0 if answer is None else 1.0, TOLERANCE)
        return
    tally.note(name, "peak", max(0.0, task.peaks(x)[1] - 1.0), 1e-9)
    least, _ = solve(task, "mean")
    room = TIGHTER * sum(limit["gain"] * limit["limit"] for limit in summary["limits"]["limit"]) / scale
    tally.note(name, "mean", abs(abs(task.mean(x) - task.mean_h) - max(least, 0.0)) / scale, TOLERANCE + room)
    if summary["limits"]["cost"] == "torque":  # next to the largest torque a wish for ripple has next to no room
        return
    smallest, why = solve(task, "ripple", task.mean(x), near=x)
    tally.judge(name, "ripple", task.worst(x), smallest, why, scale, room)
    compare_copper(task, x, name, tally, scale)


def compare_copper(task, x, name, tally, scale):
    """The copper that clarabel needs for the same mean and ripple, or where that is steep how far outside of what it
    needs with limits 1e-9 wider and tighter."""
    ours, mean, worst = 1.5 * float(x @ x), task.mean(x), task.worst(x) + 1e-12 * scale
    limit_A, line_V = task.limit_A, task.line_V

    def theirs(tighter):
        task.limit_A = limit_A and limit_A * (1 - tighter)
        task.line_V = line_V and line_V * (1 - tighter)
        return solve(task, "copper", mean, worst, x)

    copper, why = theirs(TIGHTER)
    if copper is None or why or abs(ours - copper) <= TOLERANCE * copper:
        tally.judge(name, "copper", ours, copper, why, copper)
        return
    tally.steep += 1
    low, why_low = theirs(TIGHTER - 1e-9)
    high, why_high = theirs(TIGHTER + 1e-9)
    nearest = None if low is None or high is None else min(max(ours, low), high)
    tally.judge(name, "copper", ours, nearest, why_low or why_high, copper)


def read_csv(path):
    with open(path) as file:
        return list(csv.reader(line for line in file if not line.startswith("#")))[1:]


def machine_a(source):
    to_torque = 2 / (TURN * 50.0)
    emf = [(int(n), float(a) * to_torque, float(g)) for n, a, g in read_csv(f"{source}/data/machine_a/back_emf.csv")]
    cogging = [(int(n), float(a), float(g)) for n, a, g in read_csv(f"{source}/data/machine_a/cogging.csv")]
    return Machine(2, emf, cogging, 0.5, 0.001)


def components_of(rows):
    return [(float(r["order"]), 1 if r["set"] == "pos" else -1) for r in rows]


def scenarios(program, source, tally, work, which):
    machine = machine_a(source)
    machine.write(f"{work}/a")
    for k in which:
        target = [(float(r[0]), float(r[1]), float(r[2])) for r in read_csv(f"{source}/data/scenarios/{k:02d}/target.csv")]
        rows, summary = run(program, f"{work}/a", ["--target", f"{source}/data/scenarios/{k:02d}/target.csv", "--auto"],
                            f"{work}/free{k}")
        components = components_of(rows)
        peak = summary["current"]["peak_phase_A"]
        x = coordinates(components, rows)
        for share in (0.9, 0.7):
            compare(program, machine, target, f"scenario {k} current {share}", tally, work,
                    {"components": components, "limit_A": share * peak})
        for rpm, share in ((500.0, 0.95), (1500.0, 0.9), (3000.0, 0.85)):
            speed = rpm * math.pi / 30
            free = Task(machine, components, target, None, 1.0, speed).peaks(x)[1]
            voltage = {"components": components, "line_V": share * free, "speed": speed}
            compare(program, machine, target, f"scenario {k} {rpm:g} rpm", tally, work, voltage)
            for of_peak in (0.9, 0.7):
                compare(program, machine, target, f"scenario {k} {rpm:g} rpm current {of_peak}", tally, work,
                        {**voltage, "limit_A": of_peak * peak})
        print(f"scenario {k}: {tally.most}", flush=True)


def random_machines(program, tally, work, count):
    draw = np.random.default_rng(7)
    for k in range(count):
        orders = [1] + sorted(draw.choice([5, 7, 11, 13], draw.integers(1, 4), replace=False).tolist())
        strength = draw.uniform(0.05, 0.5)
        emf = [(n, strength * (1 if n == 1 else draw.uniform(0.02, 0.3)), 0.0 if n == 1 else draw.uniform(-3, 3)) for n in orders]
        cogging = [(n, strength * draw.uniform(0, 1.5), draw.uniform(-3, 3)) for n in (6, 12)]
        machine = Machine(int(draw.integers(1, 6)), emf, cogging, draw.uniform(0.05, 1.0), draw.uniform(1e-4, 3e-3))
        wanted = 1.5 * strength * draw.uniform(5, 15)
        target = [(0.0, wanted, math.pi / 2)]
        if draw.uniform() < 0.3:
            target.append((6.0, 0.2 * wanted, draw.uniform(-3, 3)))
        components = [(1.0, 1)] + [(float(n), 1 if n % 3 == 1 else -1) for n in (5, 7, 11, 13, 17, 19)[:draw.integers(2, 7)]]
        if draw.uniform() < 0.3:
            components += [(float(n), -1 if n % 3 == 1 else 1) for n in (1, 5, 7)]
        plain = wanted / (1.5 * strength)
        limits = {"components": components, "limit_A": plain * draw.uniform(0.8, 1.4)}
        if draw.uniform() < 0.5:
            limits["speed"] = draw.uniform(50.0, 400.0)
            limits["line_V"] = math.sqrt(3) * strength * limits["speed"] * draw.uniform(0.9, 1.5)
        compare(program, machine, target, f"random {k}", tally, work, limits)


def main():
    program, source, which = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), sys.argv[3]
    tally = Tally()
    with tempfile.TemporaryDirectory() as work:
        if which == "few":
            scenarios(program, source, tally, work, (2, 8))
            random_machines(program, tally, work, 6)
        elif which == "scenarios":
            scenarios(program, source, tally, work, range(1, 13))
        else:
            random_machines(program, tally, work, int(sys.argv[4]) if len(sys.argv) > 4 else 200)
    print(f"{tally.cases} cases, {tally.limited} in which a limit acts; largest deviations: "
          + ", ".join(f"{k} {v:.2g}" for k, v in tally.most.items()) + f"; steep copper in {tally.steep}")
    for line in [f"open: {line}" for line in tally.open] + [f"wrong: {line}" for line in tally.bad]:
        print(line)
    sys.exit(1 if tally.bad else 0)


if __name__ == "__main__":
    main()
