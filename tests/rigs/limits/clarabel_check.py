"""`hci-solve solve` within limits against clarabel, an independent solver of conic programs.

    python3 clarabel_check.py HCI_SOLVE SOURCE_DIR {few,scenarios [NUMBER...],random [COUNT]} [--table FILE]

The task is built anew from the physics: torque of each component by sampling e·i over the turn and a Fourier
transform, voltages by R i + ω L di/dθ + ω_m e, peaks on a dense grid with refinement. Nothing of the project's
matrices is used, only the files that it writes. Each wish is solved with what the project got for the wishes before:

    mean     |mean − wanted| cannot be smaller
    ripple   at the project's mean torque the worst order cannot be smaller than it says; its currents may have 5e-7 of
             the torque more, which it leaves for the copper
    copper   at the project's mean torque and worst order the copper cannot be smaller

Next to the smallest ripple the copper is steep: 1e-9 of a limit or of the mean torque can be worth 3e-5 of it, and
clarabel keeps a limit no closer. Where the copper is off by more than 1e-6 it is held against what multipliers at the
project's own currents prove (by numpy, no solver), where it is less against that of limits which are 1e-9 wider, and
these cases are listed.

A line a case tells how far it is. --table: a CSV file with a row for each wish of each case: what the project got, what
clarabel got, the difference over the wanted mean torque or over the copper, and the processor time of the program (all
wishes) and of clarabel with its rows and peaks (this wish).

Exit code 77: numpy, scipy or clarabel is not installed.
"""
import argparse
import csv
import functools
import json
import math
import os
import subprocess
import sys
import tempfile

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # threads that wait count as processor time

try:
    import clarabel
    import numpy as np
    import scipy.sparse as sparse
    from scipy.optimize import nnls
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)

TOLERANCE = 1e-6  # of the mean torque, and of the copper loss
TIGHTER = 2e-9  # share by which the project takes limits tighter, lest a peak be above
ENOUGH = 1e-7  # share of the optimum to which a bound and currents that reach it need not be told apart
ROUNDS = 60
PATIENCE = 6  # rounds without a better bound
KEPT = 0.9  # share of a limit below which an angle is left out in the next round
APART = 5e-4  # steps of the dense grid: a peak between angles so near is 3e-10 of a limit, and nearer rows are alike
STEEP = 1e-9  # share to which a solver keeps limits and torque
ACTS = 1e-6  # share of a limit, or of the worst order, to which what acts reaches it
NEWTON = 4  # steps from the project's currents to those whose multipliers prove a bound
PULL = 1e-6  # to the currents of the round before, where many have next to the same torque
CLOSE = 2e-8  # share to which what clarabel reaches and what its multipliers prove are the same
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

    def e_of(self, phase, theta):
        return sum(a * np.sin(n * (theta - TURN / 3 * phase) + g) for n, a, g in self.emf)

    def cogging_torque(self, theta):
        return sum((a * np.sin(n * theta + g) for n, a, g in self.cogging), np.zeros_like(theta))


def basis(components, theta, phase, slope=False):
    """Phase currents (angles, 2·components) for S = 1 or C = 1 of each component, or their slopes; phase: a number, or
    one for each angle."""
    n, sigma = (np.array(column, dtype=float) for column in zip(*components))
    u = np.multiply.outer(theta, n) - np.multiply.outer(TURN / 3 * np.asarray(phase) * np.ones_like(theta), sigma)
    columns = np.empty((len(theta), 2 * len(components)))
    columns[:, 0::2] = n * np.cos(u) if slope else np.sin(u)
    columns[:, 1::2] = -n * np.sin(u) if slope else np.cos(u)
    return columns


class Places:
    """Where something is limited: kind (Task.kinds), angle, and the sign of the limit."""

    def __init__(self, kind, angle, sign):
        self.kind, self.angle, self.sign = kind, angle, sign

    def where(self, chosen):
        return Places(self.kind[chosen], self.angle[chosen], self.sign[chosen])

    def with_new(self, new, apart):
        """New places besides these, but for those next to one: rows that nearly repeat each other are hard."""
        near = (np.abs(self.angle[:, None] - new.angle) < apart) & (self.kind[:, None] == new.kind) & (self.sign[:, None] == new.sign)
        new = new.where(~near.any(0))
        return Places(*(np.concatenate([getattr(self, k), getattr(new, k)]) for k in ("kind", "angle", "sign")))


class Task:
    """What is wanted and allowed, in rows over the coordinates x."""

    def __init__(self, machine, components, target, limit_A, line_V, speed):
        self.machine, self.components, self.target = machine, components, target
        self.limit_A, self.line_V, self.speed = limit_A, line_V, speed
        self.top = max(n for n, _ in components)
        self.make_torque()
        self.scale = max(abs(self.mean_h), 1e-3 * max([a for _, a, _ in target] + [1e-9]))

    def make_torque(self):
        """Spectrum of the torque, by the transform of samples: rows S and C of each order that a component reaches."""
        orders = self.top + max(n for n, _, _ in self.machine.emf) + max([n for n, _, _ in self.machine.cogging] + [0])
        count = 4 * int(orders + 8)
        theta = TURN * np.arange(count) / count
        torque = sum(self.machine.e_of(s, theta)[:, None] * basis(self.components, theta, s) for s in range(3))
        wanted = sum((a * np.sin(n * theta + g) for n, a, g in self.target), np.zeros_like(theta))
        rest = wanted - self.machine.cogging_torque(theta)
        u, h = np.fft.rfft(torque, axis=0) * 2 / count, np.fft.rfft(rest) * 2 / count
        self.mean_u, self.mean_h = u[0].real / 2, h[0].real / 2
        keep = [m for m in range(1, count // 2) if np.abs(u[m]).max() > 1e-12]
        self.u = np.array([[-u[m].imag, u[m].real] for m in keep])  # order, (S, C), coordinate
        self.h = np.array([[-h[m].imag, h[m].real] for m in keep])

    def kinds(self):
        """What is limited: phase current (A) or line voltage (V), and of which phase."""
        return [(line, s) for line in (False, True) if (self.line_V if line else self.limit_A) for s in range(3)]

    def unlimited(self, line, phase, theta):
        """Rows and constants of phase currents, in A, or line voltages, in V: one angle each."""
        i = basis(self.components, theta, phase)
        if not line:
            return i, np.zeros(len(theta))
        second = (phase + 1) % 3
        e = self.machine.e_of(phase, theta) - self.machine.e_of(second, theta)
        di = basis(self.components, theta, phase, True) - basis(self.components, theta, second, True)
        return (self.machine.resistance * (i - basis(self.components, theta, second))
                + self.machine.pole_pairs * self.speed * self.machine.inductance * di, self.speed * e)

    def limited(self, which, theta):
        """Rows and constants at angles over the limits; which: for each angle a place in kinds()."""
        rows, constants = np.empty((len(theta), 2 * len(self.components))), np.empty(len(theta))
        kinds = self.kinds()
        for line in {line for line, _ in kinds}:
            here = np.array([kinds[q][0] == line for q in which], dtype=bool)
            phase = np.array([kinds[q][1] for q in which[here]], dtype=int)
            limit = self.line_V if line else self.limit_A
            r, c = self.unlimited(line, phase, theta[here])
            rows[here], constants[here] = r / limit, c / limit
        return rows, constants

    def on_grid(self, x):
        """What is limited over its limit, at the angles of a dense grid (kinds, angles). Its rows are kept."""
        if not hasattr(self, "grid"):
            count = int(64 * max(self.top, max(n for n, _, _ in self.machine.emf)))
            self.angles = TURN / count * np.arange(count)
            self.grid = {kind: self.unlimited(*kind, self.angles) for kind in self.kinds()}
        return np.array([(self.grid[kind][0] @ x + self.grid[kind][1]) / (self.line_V if kind[0] else self.limit_A)
                         for kind in self.kinds()])

    @functools.lru_cache
    def root(self, line):
        """R where |R (x, 1)| is the root of the mean square of the currents or voltages of the dense grid."""
        rows, constants = (np.concatenate(part) for part in zip(*[self.grid[kind] for kind in self.grid if kind[0] == line]))
        return np.linalg.qr(np.column_stack([rows, constants]), mode="r") / math.sqrt(len(rows))

    def peaks(self, x, beyond=1 + 3e-10):
        """Places of all local peaks that are beyond a share of the limit, refined, and the largest share."""
        value = np.abs(self.on_grid(x))
        which, k = np.nonzero((value >= np.roll(value, 1, 1)) & (value > np.roll(value, -1, 1)) & (value > 0.98))
        at, width = self.angles[k], self.angles[1]

        def at_angles(theta):
            rows, constants = self.limited(which, theta)
            return np.abs(rows @ x + constants)

        for _ in range(6):
            low, middle, high = at_angles(at - width), at_angles(at), at_angles(at + width)
            bend = np.minimum(low - 2 * middle + high, -1e-300)
            at = at + np.clip(0.5 * (low - high) / bend, -1.0, 1.0) * width * (low - 2 * middle + high < 0)
            width *= 0.3
        peak = at_angles(at)
        rows, constants = self.limited(which, at)
        sign, far = np.sign(rows @ x + constants), peak > beyond
        return Places(which[far], at[far], sign[far]), float(max([value.max(), *peak]))

    def mean(self, x):
        return float(self.mean_u @ x)

    def worst(self, x):
        error = self.u @ x - self.h
        return float(np.hypot(error[:, 0], error[:, 1]).max()) if len(self.h) else 0.0


def conic(p, q, a, b, cones):
    """The answer of clarabel, as exact as it can get."""
    for tolerance in (1e-11, 1e-10, 1e-9, 1e-8):
        settings = clarabel.DefaultSettings()
        settings.verbose = False
        settings.tol_gap_abs = settings.tol_gap_rel = settings.tol_feas = tolerance
        answer = clarabel.DefaultSolver(p, q, sparse.csc_matrix(a), b, cones, settings).solve()
        if str(answer.status) in ("Solved", "PrimalInfeasible"):
            break
    return answer


def to_cones(z, cones):
    """Multipliers that rounding has left outside of their cones, inside."""
    z, at = z.copy(), 0
    for cone in cones:
        part = z[at:at + cone.dim]
        if isinstance(cone, clarabel.NonnegativeConeT):
            part[:] = np.maximum(part, 0.0)
        elif isinstance(cone, clarabel.SecondOrderConeT):
            part[0] = max(part[0], np.linalg.norm(part[1:]))
        at += cone.dim
    return z


def least_copper(a, b, z):
    """What ½|x|² with b − a x in the cones is at least, by multipliers z in them: the minimum over x of ½|x|² + z(a x − b)."""
    of_x = a.T @ z
    return -0.5 * float(of_x @ of_x) - float(b @ z)


def least_torque(a, b, z, cones):
    """What the last unknown is at least where b − a u is in the cones, the last of which bounds all the others: any
    multipliers do, of which the last cone's make up for what they lack of a.T z = −(0, …, 0, 1)."""
    z = to_cones(z, cones)
    heads = -float(a[:, -1] @ z)
    if not heads > 0.0:
        return -math.inf
    z /= heads
    tail = a[1 - cones[-1].dim:, :-1]
    z[1 - cones[-1].dim:] -= np.linalg.lstsq(tail.T, a[:, :-1].T @ z, rcond=None)[0]
    return -float(b @ to_cones(z, cones))


def wish_rows(task, wish, mean, worst, unit_A):
    """Rows, right sides and cones of a wish without limits, over x / unit_A and, but for copper, the optimum, in shares
    of the torque task.scale."""
    extra = 0 if wish == "copper" else 1
    mean_row = np.hstack([task.mean_u * unit_A / task.scale, np.zeros(extra)])
    if wish == "mean":
        side, wanted = np.eye(len(mean_row))[-1], task.mean_h / task.scale
        return [np.array([mean_row - side, -mean_row - side])], [np.array([wanted, -wanted])], [clarabel.NonnegativeConeT(2)]
    a, b, cones = [mean_row[None]], [np.array([mean / task.scale])], [clarabel.ZeroConeT(1)]
    for u, h in zip(task.u, task.h):
        head = np.zeros(len(mean_row))
        if wish == "ripple":
            head[-1] = -1.0
        a.append(np.vstack([head, np.hstack([u * unit_A / task.scale, np.zeros((2, extra))])]))
        b.append(np.array([0.0 if wish == "ripple" else worst, *h]) / task.scale)
        cones.append(clarabel.SecondOrderConeT(3))
    return a, b, cones


def mean_squares(task, unit_A, extra):
    """What is within a limit at every angle is so in the mean of its square over the turn and the three phases: a cone
    for current and one for voltage. They exclude nothing, and bound all directions where few angles do not."""
    a, b, cones = [], [], []
    for line in sorted({line for line, _ in task.kinds()}):
        root = task.root(line) / (task.line_V if line else task.limit_A)
        a.append(np.hstack([np.vstack([np.zeros(root.shape[1] - 1), root[:, :-1] * unit_A]), np.zeros((len(root) + 1, extra))]))
        b.append(np.hstack([1.0, -root[:, -1]]))
        cones.append(clarabel.SecondOrderConeT(len(root) + 1))
    return a, b, cones


def solve(task, wish, mean=None, worst=None, near=None, known=math.inf):
    """Optimum of one wish: limits at a few angles, then at the peaks of what comes of them too, until on a dense grid,
    refined, no peak is beyond a limit: the optimum of all angles. Each round is of fewer rows than the task, and its
    multipliers prove a bound from below, however well clarabel has solved it: where a current within the limits is known
    to reach that bound, that is the end.

    near: currents whose peaks are among the first angles, which saves rounds; rows of any angles are rows of the task.
    known: what currents within the limits reach. Returned: the bound, infinite where nothing is within the limits, and
    why it may be below the optimum."""
    n = 2 * len(task.components)
    unit_A, of_torque = task.limit_A or 10.0, wish != "copper"
    unit = task.scale if of_torque else 3.0 * unit_A ** 2
    task.on_grid(np.zeros(n))
    fixed, right, cones = (u + v for u, v in zip(wish_rows(task, wish, mean, worst, unit_A), mean_squares(task, unit_A, int(of_torque))))
    pull = PULL if of_torque else 1.0
    p, at = sparse.diags([pull] * n + [0.0] * of_torque, format="csc"), np.zeros(n) if near is None or not of_torque else near / unit_A
    places, best, bounds = first_places(task, near), -math.inf, []
    for _ in range(ROUNDS):
        rows, constants = task.limited(places.kind, places.angle)
        rows, constants = rows * places.sign[:, None], constants * places.sign
        a = np.vstack([np.hstack([rows * unit_A, np.zeros((len(rows), int(of_torque)))]), *fixed])
        b, all_cones = np.concatenate([1 - constants, *right]), [clarabel.NonnegativeConeT(len(rows)), *cones]
        answer = conic(p, np.append(-pull * at, [1.0] * of_torque), a, b, all_cones)
        if str(answer.status) == "PrimalInfeasible":
            return math.inf, ""
        x, z = unit_A * np.array(answer.x[:n]), to_cones(np.array(answer.z), all_cones)
        at = x / unit_A if of_torque else at
        best = max(best, unit * (least_torque(a, b, z, all_cones) if of_torque else least_copper(a, b, z)))
        reached = unit * (float(answer.x[n]) if of_torque else float(x @ x) / unit_A ** 2 / 2)
        found, most = task.peaks(x)
        whole = task.scale if of_torque else best
        if known - best <= ENOUGH * whole or most < 1 + 1e-9 and reached - best < CLOSE * whole:
            return best, ""
        bounds.append(best)
        if len(bounds) > PATIENCE and best - bounds[-1 - PATIENCE] < CLOSE * whole:
            break
        kept = places.where(rows @ x + constants > KEPT)
        places = kept.with_new(found, APART * task.angles[1])
        if len(places.angle) == len(kept.angle):
            break
    return best, f"clarabel's currents are at {most} of a limit"


def first_places(task, near):
    """Limits on either side at a few angles, and where currents that are near touch them."""
    angle = TURN * (0.0137 + np.arange(4 * int(task.top))) / (4 * int(task.top))
    kinds = np.arange(len(task.kinds()))
    kind, angle, sign = (m.ravel() for m in np.meshgrid(kinds, angle, [-1.0, 1.0], indexing="ij"))
    places = Places(kind, angle, sign)
    if near is None:
        return places
    rows, constants = task.limited(kind, angle)
    return places.where((rows @ near + constants) * sign > 0.6).with_new(task.peaks(near, 0.99)[0], 0.0)


def processor_s():
    """Of this process and of those that it has waited for."""
    return sum(os.times()[:4])


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
    """Largest deviations, what was beyond the tolerance, and a table of all."""

    def __init__(self):
        self.cases = self.limited = 0
        self.steep, self.table = [], []
        self.most = {"mean": 0.0, "ripple": 0.0, "ripple of the currents": 0.0, "copper": 0.0, "peak": 0.0}
        self.bad, self.open = [], []

    def begin(self, name):
        """A case, from the program on."""
        self.cases += 1
        self.name, self.began, self.first = name, processor_s(), len(self.table)

    def program_has_ended(self, limits):
        self.limited += limits["cost"] != "none"
        self.program_s = processor_s() - self.began
        self.began = processor_s()

    def row(self, what, ours, theirs, scale, remark=""):
        """What both got of a wish, after clarabel has been at it."""
        unit, apart = "A2" if what == "copper" else "Nm", abs(ours - theirs) / scale if ours != theirs else 0.0
        self.table.append([self.name, what, unit, f"{ours:.12g}", f"{theirs:.12g}", f"{apart:.2g}", f"{self.program_s:.3f}",
                           f"{processor_s() - self.began:.2f}", remark])
        self.began = processor_s()

    def tell(self):
        """The case in a line."""
        rows = self.table[self.first:]
        print(f"{self.name}: " + ", ".join(f"{row[1]} {row[5]}{' ' + row[8] if row[8] else ''}" for row in rows)
              + f"; hci-solve {self.program_s:.2f} s, clarabel {sum(float(row[7]) for row in rows):.1f} s", flush=True)

    def write(self, path):
        with open(path, "w", newline="") as out:
            head = ["case", "wish", "unit", "hci_solve", "clarabel", "relative_difference", "hci_solve_s", "clarabel_s", "remark"]
            csv.writer(out, lineterminator="\n").writerows([head, *self.table])

    def note(self, name, what, deviation, allowed):
        self.most[what] = max(self.most[what], deviation)
        if not deviation <= allowed:
            self.bad.append(f"{name}: {what} off by {deviation:.3g} (allowed {allowed:.3g})")

    def note_steep(self, name, deviation, proven, worth):
        self.steep.append(f"{name}: copper {deviation:.2g} from clarabel's bound, {proven:.2g} from what its own multipliers prove; "
                          f"1e-9 of the limits is worth {worth:.2g} of it")

    def judge(self, name, what, ours, theirs, why, scale, room=0.0):
        """Where clarabel stops between, theirs is of fewer rows than the task and so a lower bound: a current that
        keeps all limits and comes as near to it is the best; one that does not leaves it open."""
        deviation = (ours - theirs) / scale
        self.row(what, ours, theirs, scale, "bound" if why else "")
        if why and not deviation <= TOLERANCE + room:
            self.open.append(f"{name}: {what} off by {deviation:.3g} at most: {why}")
        else:
            self.note(name, what, abs(deviation), TOLERANCE + room)


def compare(program, machine, target, name, tally, work, limits, asked=1.0):
    """One case: limit_A, or line_V with a speed in rad/s, and the components. asked: share of the peak current that the
    program is told in place of limit_A, for a wrong answer. Returned: the program's limits."""
    folder = f"{work}/{name.replace(' ', '_').replace('/', '_')}"
    machine.write(folder)
    with open(f"{folder}/target.csv", "w") as out:
        out.write("order,amplitude_Nm,phase_rad\n" + "".join(f"{n!r},{a!r},{g!r}\n" for n, a, g in target))
    with open(f"{folder}/harmonics.csv", "w") as out:
        out.write("order,set\n" + "".join(f"{n!r},{'pos' if s > 0 else 'neg'}\n" for n, s in limits["components"]))
    arguments = ["--target", f"{folder}/target.csv", "--harmonics", f"{folder}/harmonics.csv", "--minimise", "worst"]
    if limits.get("limit_A"):
        arguments += ["--limit-current", repr(float(limits["limit_A"] * asked))]
    if limits.get("line_V"):
        arguments += ["--limit-voltage", repr(limits["line_V"]), "--speed", repr(limits["speed"] * 30 / math.pi)]
    tally.begin(name)
    rows, summary = run(program, folder, arguments, f"{folder}/out")
    tally.program_has_ended(summary["limits"])
    task = Task(machine, limits["components"], target, limits.get("limit_A"), limits.get("line_V"), limits.get("speed", 0.0))
    x = coordinates(limits["components"], rows)
    compare_wishes(task, x, name, tally, summary["limits"])
    tally.tell()
    return summary["limits"]


def compare_wishes(task, x, name, tally, said):
    """Each wish with what the project has got for the wishes before. said: the program's limits."""
    scale = task.scale
    if said["cost"] == "limits":
        answer, why = solve(task, "mean")
        tally.row("mean", math.inf, answer, scale, "no current keeps the limits")
        tally.note(name, "mean", 0.0 if answer == math.inf else 1.0, TOLERANCE)
        return
    tally.note(name, "peak", max(0.0, task.peaks(x)[1] - 1.0), 1e-9)
    room = TIGHTER * sum(limit["gain"] * limit["limit"] for limit in said["limit"]) / scale
    missed = abs(task.mean(x) - task.mean_h)
    least, why = (0.0, "") if missed <= ENOUGH * scale else solve(task, "mean", near=x, known=missed)
    tally.judge(name, "mean", missed, least, why, scale, room)
    if said["cost"] == "torque":  # next to the largest torque a wish for ripple has next to no room
        return
    claimed = task.worst(x) if said["minimised_Nm"] is None else min(task.worst(x), said["minimised_Nm"])
    smallest, why = solve(task, "ripple", task.mean(x), near=x, known=claimed)
    tally.judge(name, "ripple", claimed, smallest, why, scale, room)
    tally.note(name, "ripple of the currents", abs(task.worst(x) - smallest) / scale, TOLERANCE + room)
    compare_copper(task, x, name, tally, scale)


def compare_copper(task, x, name, tally, scale):
    """The copper that clarabel needs for the same mean and ripple. Where that is steep, so that it does not tell, what
    multipliers at the project's own currents prove."""
    ours, mean, worst = 1.5 * float(x @ x), task.mean(x), task.worst(x) + 1e-12 * scale
    limit_A, line_V = task.limit_A, task.line_V
    task.limit_A, task.line_V = limit_A and limit_A * (1 - TIGHTER), line_V and line_V * (1 - TIGHTER)
    proven, worth, nearest = proof_of_copper(task, x, mean, worst)
    copper, why = solve(task, "copper", mean, worst, nearest, ours)
    if abs(ours - copper) > TOLERANCE * copper:
        tally.note_steep(name, (ours - copper) / copper, (ours - proven) / copper, worth / copper)
        tally.row("copper", ours, copper, copper, f"steep: {abs(ours - proven) / copper:.2g} by multipliers")
        copper, why = max(copper, proven) - (worth if ours < copper else 0.0), ""
    tally.judge(name, "copper", ours, copper, why, copper)
    task.limit_A, task.line_V = limit_A, line_V


def proof_of_copper(task, x, mean, worst):
    """The copper that multipliers prove to be the least, without a solver: Newton's method for the conditions of Karush,
    Kuhn and Tucker of what acts at the currents x, each peak with the bend that it has since its angle moves. Any
    multipliers that are not negative prove a bound. Returned too: what STEEP of the limits and of the ripple is worth, and
    the currents."""
    unit_A, best, worth, nearest = task.limit_A or 10.0, -math.inf, 0.0, x
    for _ in range(NEWTON):
        y = x / unit_A
        places = task.peaks(x, 1 - ACTS)[0]
        rows, constants = task.limited(places.kind, places.angle)
        rows, constants = rows * places.sign[:, None] * unit_A, constants * places.sign
        error = (task.u @ x - task.h) / task.scale
        size = np.hypot(error[:, 0], error[:, 1])
        acts = size > (1 - ACTS) * worst / task.scale
        u, h, error, size = task.u[acts] * unit_A / task.scale, task.h[acts] / task.scale, error[acts], size[acts]
        to = error / size[:, None]
        columns = np.vstack([rows, np.einsum("kc,kcj->kj", to, u), task.mean_u * unit_A / task.scale])
        beyond = np.concatenate([rows @ y + constants - 1, size - worst / task.scale, [(task.mean(x) - mean) / task.scale]])
        weight = multipliers(columns, -y)
        sides = np.concatenate([1 - constants, worst / task.scale + np.einsum("kc,kc->k", to, h), [mean / task.scale]])
        bound = 3 * unit_A ** 2 * least_copper(columns, sides, weight)
        if bound > best:
            best, worth, nearest = bound, 3 * unit_A ** 2 * STEEP * float(weight[:-1].sum()), x
        bend = np.eye(len(y)) + bend_of(task, places, x, weight[:len(rows)], unit_A)
        for w, of, t, length in zip(weight[len(rows):-1], u, to, size):
            along = of.T @ t
            bend += w / length * (of.T @ of - np.outer(along, along))
        columns, beyond = columns[weight != 0.0], beyond[weight != 0.0]
        system = np.block([[bend, columns.T], [columns, np.zeros((len(beyond), len(beyond)))]])
        x = x + unit_A * np.linalg.solve(system, -np.concatenate([y, beyond]))[:len(y)]
    return best, worth, nearest


def multipliers(columns, side):
    """The weights of the columns that come nearest to a side, none but the last negative, and none of columns that repeat others."""
    both = np.vstack([columns, -columns[-1]])
    length = np.linalg.norm(both, axis=1)
    weight = nnls((both / length[:, None]).T, side, maxiter=100 * len(both))[0] / length
    return np.append(weight[:-2], weight[-2] - weight[-1])


def bend_of(task, places, x, weight, unit_A, step=1e-3):
    """Σ weight · g' g'ᵀ/|g''|, of rows g of peaks by differences of sixth and second order over the angle."""
    rows = [task.limited(places.kind, places.angle + k * step) for k in range(-3, 4)]
    first = sum(c * (rows[3 + k][0] - rows[3 - k][0]) for k, c in ((1, 0.75), (2, -0.15), (3, 1 / 60))) / step * unit_A
    value = [places.sign * (r @ x + c) for r, c in rows[2:5]]
    second = (value[0] - 2 * value[1] + value[2]) / step ** 2
    return (first * (weight / np.maximum(-second, 1e-9))[:, None]).T @ first


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


def controls(program, source, tally, work):
    """Whether wrong answers are told from right ones: currents within a tighter limit, which ripple more by 1e-5 of the
    mean torque or take more copper than they need, and currents that are beyond the limit by 1e-6 of it."""
    machine = machine_a(source)
    target = [(float(r[0]), float(r[1]), float(r[2])) for r in read_csv(f"{source}/data/scenarios/02/target.csv")]
    components = [(1.0, 1)] + [(float(n), 1 if n % 3 == 1 else -1) for n in (5, 7, 11, 13, 17, 19, 23, 25, 29, 31, 35, 37, 41, 43)]
    for limit_A, what in ((21.0, "ripple"), (18.0, "ripple"), (24.2, "copper")):
        limits = {"components": components, "limit_A": limit_A}
        told = compare(program, machine, target, f"control {limit_A:g} right", tally, work, limits)
        unit = target[0][1] if told["cost"] == "ripple" else 281.0  # A² of copper, about
        less = 1e-5 * unit / (told["limit"][0]["gain"] * limit_A)
        for name, factor, where in ((f"worse {what}", 1 - less, what), ("beyond", 1 + 1e-6, "peak")):
            found = Tally()
            compare(program, machine, target, f"control {limit_A:g} {name}", found, work, limits, factor)
            if not any(f": {where} off" in line for line in found.bad + found.open):
                tally.bad.append(f"control {limit_A:g} {name}: not found")
            print(f"control {limit_A:g} {name}:", *found.bad, *found.open)


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


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=os.path.abspath)
    parser.add_argument("source", type=os.path.abspath)
    parser.add_argument("which", choices=["few", "scenarios", "random"])
    parser.add_argument("number", type=int, nargs="*", help="of scenarios, or how many random machines")
    parser.add_argument("--table", help="file for a row of each wish of each case")
    return parser.parse_args()


def main():
    told, tally = arguments(), Tally()
    with tempfile.TemporaryDirectory() as work:
        if told.which == "few":
            controls(told.program, told.source, tally, work)
            scenarios(told.program, told.source, tally, work, (2, 8))
            random_machines(told.program, tally, work, 6)
        elif told.which == "scenarios":
            scenarios(told.program, told.source, tally, work, told.number or range(1, 13))
        else:
            random_machines(told.program, tally, work, *told.number or [200])
    if told.table:
        tally.write(told.table)
    print(f"{tally.cases} cases, {tally.limited} in which a limit acts; largest deviations: "
          + ", ".join(f"{k} {v:.2g}" for k, v in tally.most.items()) + f"; steep copper in {len(tally.steep)}")
    for line in [f"steep: {line}" for line in tally.steep] + [f"open: {line}" for line in tally.open] + [f"wrong: {line}" for line in tally.bad]:
        print(line)
    sys.exit(1 if tally.bad or tally.open else 0)


if __name__ == "__main__":
    main()
