"""`hci-solve solve` within limits against clarabel, an independent solver of conic programs.

    python3 clarabel_check.py HCI_SOLVE SOURCE_DIR {few,scenarios [NUMBER...],random [COUNT]}

The task is built anew from the physics: torque of each component by sampling e·i over the turn and a Fourier
transform, voltages by R i + ω L di/dθ + ω_m e, peaks on a dense grid with refinement. Nothing of the project's
matrices is used, only the files that it writes. Each wish is solved with what the project got for the wishes before:

    mean     |mean − wanted| cannot be smaller
    ripple   at the project's mean torque the worst order cannot be smaller
    copper   at the project's mean torque and worst order the copper cannot be smaller

Next to the smallest ripple the copper is steep: 1e-9 of a limit or of the mean torque can be worth 3e-5 of it, and no
solver keeps a limit closer. Where the copper is off by more than 1e-6 it is held against that of limits and of a ripple
which are 1e-9 tighter, where it is less against wider ones, and these cases are listed with what it is off by at most.

Exit code 77: numpy, scipy or clarabel is not installed.
"""
import csv
import functools
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
ENOUGH = 1e-7  # share of the optimum to which a bound and currents that reach it need not be told apart
ROUNDS = 60
KEPT = 0.9  # share of a limit below which an angle is left out in the next round
APART = 5e-4  # steps of the dense grid: a peak between angles so near is 3e-10 of a limit, and nearer rows are alike
PULL = 1e-5  # to the currents of the round before, where many have next to the same torque
STEEP = 1e-9  # share to which a solver keeps limits and torque
STRONGEST = 1e-2  # to which the pull grows where clarabel does not come to an end
AT_REST = 1e-8  # share of the torque that the pull may still be worth
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

    def across(self, unit_A):
        """The largest distance of two currents within the limits, over unit_A."""
        root = self.root(not self.limit_A)[:, :-1] * unit_A / (self.limit_A or self.line_V)
        return 2 / np.linalg.svd(root, compute_uv=False)[-1]

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


def is_solved(answer):
    """Whether an answer is one to 1e-7 where clarabel does not reach its own 1e-8."""
    near = max(abs(answer.obj_val - answer.obj_val_dual), answer.r_prim, answer.r_dual) < 5e-8
    return str(answer.status) == "Solved" or str(answer.status) == "AlmostSolved" and near


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
    refined, no peak is beyond a limit: the optimum of all angles. Each round is of fewer rows than the task, and bounds it
    from below: where a current within the limits is known to reach that bound, that is the end.

    Torques are of many currents: there the current is pulled to that of the round before, first to near, and what the
    pull can be worth across all that the limits allow is taken off.

    near: currents whose peaks are among the first angles, which saves rounds; rows of any angles are rows of the task.
    known: what currents within the limits reach. Returned: the optimum, infinite where nothing is within the limits, and
    why it is a bound only."""
    n = 2 * len(task.components)
    unit_A, of_torque = task.limit_A or 10.0, wish != "copper"
    task.on_grid(np.zeros(n))
    fixed, right, cones = (u + v for u, v in zip(wish_rows(task, wish, mean, worst, unit_A), mean_squares(task, unit_A, int(of_torque))))
    pull = PULL if of_torque else 1.0
    places, best, most = first_places(task, near), -math.inf, math.inf
    centre = near / unit_A if of_torque and near is not None else np.zeros(n)
    for _ in range(ROUNDS):
        rows, constants = task.limited(places.kind, places.angle)
        rows, constants = rows * places.sign[:, None], constants * places.sign
        a = np.vstack([np.hstack([rows * unit_A, np.zeros((len(rows), int(of_torque)))]), *fixed])
        p, q = sparse.diags([pull] * n + [0.0] * of_torque, format="csc"), np.hstack([-pull * centre, [1.0] * of_torque])
        answer = conic(p, q, a, np.concatenate([1 - constants, *right]), [clarabel.NonnegativeConeT(len(rows)), *cones])
        if str(answer.status) == "PrimalInfeasible":
            return math.inf, ""
        if not is_solved(answer) and of_torque and pull < STRONGEST:
            pull *= 10
            continue
        if not is_solved(answer):
            return best, f"clarabel says {answer.status} with {len(rows)} angles; the round before is {most} of a limit"
        at = np.array(answer.x[:n])
        x = unit_A * at
        pulled = pull * float(np.linalg.norm(at - centre)) * task.across(unit_A) if of_torque else 0.0
        best = max(best, task.scale * (float(answer.x[n]) - pulled) if of_torque else 1.5 * float(x @ x))
        found, most = task.peaks(x)
        if known - best <= ENOUGH * (task.scale if of_torque else best) or most < 1 + 1e-9 and pulled < AT_REST:
            return best, ""
        moved = of_torque and most < 1 + 1e-6 and pulled >= AT_REST
        centre = at if moved else centre
        kept = places.where(rows @ x + constants > KEPT)
        places = kept.with_new(found, APART * task.angles[1])
        if len(places.angle) == len(kept.angle) and not moved:
            break
    return best, f"a peak is {most} of a limit, and clarabel keeps it no closer"


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
        self.cases = self.limited = 0
        self.steep = []
        self.most = {"mean": 0.0, "ripple": 0.0, "copper": 0.0, "peak": 0.0}
        self.bad, self.open = [], []

    def note(self, name, what, deviation, allowed):
        self.most[what] = max(self.most[what], deviation)
        if not deviation <= allowed:
            self.bad.append(f"{name}: {what} off by {deviation:.3g} (allowed {allowed:.3g})")

    def note_steep(self, name, deviation):
        self.steep.append(f"{name}: {deviation:.2g}")

    def judge(self, name, what, ours, theirs, why, scale, room=0.0):
        """Where clarabel stops between, theirs is of fewer rows than the task and so a lower bound: a current that
        keeps all limits and comes as near to it is the best; one that does not leaves it open."""
        deviation = (ours - theirs) / scale
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
    rows, summary = run(program, folder, arguments, f"{folder}/out")
    task = Task(machine, limits["components"], target, limits.get("limit_A"), limits.get("line_V"), limits.get("speed", 0.0))
    x = coordinates(limits["components"], rows)
    scale = task.scale
    tally.cases += 1
    tally.limited += summary["limits"]["cost"] != "none"
    if summary["limits"]["cost"] == "limits":
        answer, why = solve(task, "mean")
        tally.note(name, "mean", 0.0 if answer == math.inf else 1.0, TOLERANCE)
        return summary["limits"]
    tally.note(name, "peak", max(0.0, task.peaks(x)[1] - 1.0), 1e-9)
    room = TIGHTER * sum(limit["gain"] * limit["limit"] for limit in summary["limits"]["limit"]) / scale
    missed = abs(task.mean(x) - task.mean_h)
    least, why = (0.0, "") if missed <= ENOUGH * scale else solve(task, "mean", near=x, known=missed)
    tally.judge(name, "mean", missed, least, why, scale, room)
    if summary["limits"]["cost"] == "torque":  # next to the largest torque a wish for ripple has next to no room
        return summary["limits"]
    smallest, why = solve(task, "ripple", task.mean(x), near=x, known=task.worst(x))
    tally.judge(name, "ripple", task.worst(x), smallest, why, scale, room)
    compare_copper(task, x, name, tally, scale)
    return summary["limits"]


def compare_copper(task, x, name, tally, scale):
    """The copper that clarabel needs for the same mean and ripple, or where that is steep whether it is outside of what it
    needs with limits and ripple 1e-9 wider and tighter."""
    ours, mean, worst = 1.5 * float(x @ x), task.mean(x), task.worst(x) + 1e-12 * scale
    limit_A, line_V = task.limit_A, task.line_V

    def theirs(tighter, less=0.0):
        task.limit_A = limit_A and limit_A * (1 - tighter)
        task.line_V = line_V and line_V * (1 - tighter)
        return solve(task, "copper", mean, worst - less * scale, x, ours)

    copper, why = theirs(TIGHTER)
    if abs(ours - copper) <= TOLERANCE * copper:
        tally.judge(name, "copper", ours, copper, why, copper)
        return
    side = STEEP if ours > copper else -STEEP
    beyond, why_beyond = theirs(TIGHTER + side, side)
    tally.note_steep(name, (ours - copper) / copper)
    tally.judge(name, "copper", ours, max(ours, beyond) if side < 0 else min(ours, beyond), why_beyond, copper)


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


def main():
    program, source, which = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), sys.argv[3]
    tally = Tally()
    with tempfile.TemporaryDirectory() as work:
        if which == "few":
            controls(program, source, tally, work)
            scenarios(program, source, tally, work, (2, 8))
            random_machines(program, tally, work, 6)
        elif which == "scenarios":
            scenarios(program, source, tally, work, [int(k) for k in sys.argv[4:]] or range(1, 13))
        else:
            random_machines(program, tally, work, int(sys.argv[4]) if len(sys.argv) > 4 else 200)
    print(f"{tally.cases} cases, {tally.limited} in which a limit acts; largest deviations: "
          + ", ".join(f"{k} {v:.2g}" for k, v in tally.most.items()) + f"; steep copper in {len(tally.steep)}")
    for line in [f"steep: {line}" for line in tally.steep] + [f"open: {line}" for line in tally.open] + [f"wrong: {line}" for line in tally.bad]:
        print(line)
    sys.exit(1 if tally.bad or tally.open else 0)


if __name__ == "__main__":
    main()
