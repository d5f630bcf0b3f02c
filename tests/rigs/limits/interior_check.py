"""`hci-solve solve` within limits on an interior-magnet machine against many starts of SciPy's SLSQP.

    python3 interior_check.py HCI_SOLVE SOURCE_DIR [--starts N] [--table FILE]

With L(θ) torque is a quadratic function of the currents, so that the task is not convex and an answer may be one of several local
ones. Machine C is built anew here from its files: torque e·i + p/2 iᵀL'(θ)i and cogging torque, voltage R i + p Ω d(L i)/dθ + Ω e, on
samples of the angle; nothing of the project's matrices is used. At each operating point

    mean     the mean torque nearest to the wanted one, currents and line voltages below their limits at every angle
    ripple   at that of the project the smallest worst order, where the limits leave any mean to choose from

are looked for from N beginnings (sines of many sizes and angles, with and without random harmonics) and from the project's
currents. At each point of the envelope

    torque   the largest mean torque whose swing is at most a share of it

from as many beginnings, half of them at the currents of the smallest swing that was found without that share; what `sweep --envelope` found
is not told to it. A line a point tells both. Exit code 1: the project is worse than the best of them by more than 1 % of the wanted torque
(of the envelope, of the largest), or its currents are beyond a limit, or this physics makes another torque of its currents than the
project. 77: numpy or scipy is missing.
"""
import argparse
import csv
import json
import math
import os
import subprocess
import sys
import tempfile

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

try:
    import numpy as np
    from scipy.optimize import minimize
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)

TURN = 2.0 * math.pi
WORSE = 0.01  # share of the wanted torque by which the project may be worse
SAME = 1e-4  # share of the wanted torque, and of a limit, to which both physics agree
TOP_TORQUE = 240  # highest order of the torque that is looked at
SAMPLES = 48  # of a limit in half a turn at first; peaks between them are added
POINTS = [  # components, wanted torque in N·m, phase current in A, line voltage in V, speed in rpm
    (13, 8.0, 6.0, 311.0, 300), (13, 8.0, 5.6, 311.0, 300), (13, 8.0, 8.0, 311.0, 1000), (13, 12.0, 8.0, 311.0, 800),
    (13, 20.0, 8.0, 311.0, 800), (13, 20.0, 8.0, 311.0, 1200), (13, 20.0, 6.0, 311.0, 1600), (13, 5.0, 6.0, 311.0, 1500),
    (25, 8.0, 5.7, 311.0, 500), (25, 20.0, 8.0, 311.0, 1200), (25, 5.0, 8.0, 311.0, 1500), (25, 10.0, 8.0, 250.0, 700),
]
ENVELOPE = [  # components, largest swing in %, phase current in A, line voltage in V, speed in rpm
    (13, 10.0, 8.0, 311.0, 800), (13, 10.0, 8.0, 311.0, 1200), (13, 20.0, 8.0, 311.0, 1600), (25, 2.0, 8.0, 311.0, 800),
    (25, 5.0, 8.0, 311.0, 1200),
]


def table(path):
    with open(path) as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    return rows[0], rows[1:]


class Machine:
    def __init__(self, folder):
        value = {row[0]: row[1] for row in table(f"{folder}/machine.csv")[1]}
        self.pole_pairs, self.resistance = int(value["pole_pairs"]), float(value["resistance"])
        self.emf = np.array(table(f"{folder}/back_emf.csv")[1], dtype=float)
        self.cogging = np.array(table(f"{folder}/cogging.csv")[1], dtype=float)
        rows = np.array(table(f"{folder}/inductance.csv")[1], dtype=float)
        aa, bb, cc, ab, bc, ca = rows[:, 1:].T
        self.spectrum = np.fft.rfft(np.array([[aa, ab, ca], [ab, bb, bc], [ca, bc, cc]]), axis=2) / len(rows)

    def e(self, theta):
        """Phases × angles, N·m/A."""
        phase = TURN / 3.0 * np.arange(3)[:, None, None]
        return (self.emf[:, 1] * np.sin(self.emf[:, 0] * (theta[None, :, None] - phase) + self.emf[:, 2])).sum(2)

    def cogging_torque(self, theta):
        return (self.cogging[:, 1] * np.sin(self.cogging[:, 0] * theta[:, None] + self.cogging[:, 2])).sum(1)

    def inductance(self, theta):
        """L and dL/dθ: angles × 3 × 3."""
        n = np.arange(self.spectrum.shape[2])
        wave = np.exp(1j * np.multiply.outer(theta, n)) * np.where(n > 0, 2.0, 1.0)
        both = [np.einsum("km,abm->kab", wave * factor, self.spectrum).real for factor in (np.ones(len(n)), 1j * n)]
        return both


def basis(components, theta):
    """Currents and their slopes for S = 1 and C = 1 of each component: angles × 3 × 2·components."""
    n, sigma = np.array(components, dtype=float).T
    u = theta[:, None, None] * n - TURN / 3.0 * np.arange(3)[None, :, None] * sigma
    i = np.empty((len(theta), 3, 2 * len(components)))
    slope = np.empty_like(i)
    i[:, :, 0::2], i[:, :, 1::2] = np.sin(u), np.cos(u)
    slope[:, :, 0::2], slope[:, :, 1::2] = n * np.cos(u), -n * np.sin(u)
    return i, slope


class Task:
    def __init__(self, machine, components, current_A, line_V, speed_rpm):
        self.machine, self.components, self.current_A, self.line_V = machine, components, current_A, line_V
        self.speed = speed_rpm * TURN / 60.0
        self.make_torque()
        theta = math.pi / SAMPLES * np.arange(SAMPLES)
        self.at = [theta, theta]  # of the currents, of the voltages; half a turn tells of the other half

    def make_torque(self):
        """Torque of each order as a quadratic function; a sixth of a turn tells all."""
        count = TOP_TORQUE // 3
        theta = TURN / 6.0 / count * np.arange(count)
        i, _ = basis(self.components, theta)
        _, slope = self.machine.inductance(theta)
        bend = 0.5 * self.machine.pole_pairs * np.einsum("kaj,kab,kbl->kjl", i, slope, i)
        steady = np.einsum("ak,kaj->kj", self.machine.e(theta), i)
        transform = [np.fft.rfft(part, axis=0)[: count // 2] / count * 2.0 for part in (self.machine.cogging_torque(theta), steady, bend)]
        for part in transform:
            part[0] /= 2.0
        self.constant, self.linear, self.quadratic = transform
        count = 2 * TOP_TORQUE // 3  # twice as many angles as orders need, for the swing
        turn = 1j * TURN / count * np.outer(np.arange(count), np.arange(len(self.constant)))
        self.wave = np.exp(turn)

    def torque(self, x):
        """Complex amplitude of orders 0, 6, …, and its derivative."""
        along = self.quadratic @ x
        return self.constant + self.linear @ x + along @ x, self.linear + 2.0 * along

    def over_angle(self, x):
        """Torque at evenly spaced angles, and its derivative."""
        torque, slope = self.torque(x)
        return (self.wave @ torque).real, (self.wave @ slope).real

    def swing(self, x):
        torque = self.over_angle(x)[0]
        return (torque.max() - torque.min()) / abs(self.torque(x)[0][0].real)

    def rows(self, kind, theta):
        """Of phase a, or line a to b, over the limit: rows and constants."""
        i, slope = basis(self.components, theta)
        if kind == 0:
            return i[:, 0] / self.current_A, np.zeros(len(theta))
        inductance, bend = self.machine.inductance(theta)
        flux = np.einsum("kab,kbj->kaj", bend, i) + np.einsum("kab,kbj->kaj", inductance, slope)
        volts = self.machine.resistance * i + self.machine.pole_pairs * self.speed * flux
        e = self.speed * self.machine.e(theta)
        return (volts[:, 0] - volts[:, 1]) / self.line_V, (e[0] - e[1]) / self.line_V

    def peaks(self, x):
        """Largest share of both limits, with angles of all local peaks near them."""
        theta = math.pi / 2048 * np.arange(2048)
        largest, where = [], []
        for kind in range(2):
            row, constant = self.rows(kind, theta)
            share = np.abs(row @ x + constant)
            top = (share >= np.roll(share, 1)) & (share > np.roll(share, -1)) & (share > 0.99)
            largest.append(share.max())
            where.append(theta[top])
        return largest, where

    def limits(self):
        both = [self.rows(kind, self.at[kind]) for kind in range(2)]
        row, constant = np.concatenate([b[0] for b in both]), np.concatenate([b[1] for b in both])
        return np.concatenate([-row, row]), np.concatenate([1.0 - constant, 1.0 + constant])

    def solve(self, begin, wanted_Nm=None, mean_Nm=None):
        """The mean nearest to wanted_Nm, or the smallest worst order at mean_Nm, from one beginning; None without one."""
        n = len(begin)
        scale = max(abs(wanted_Nm or mean_Nm), 1e-3)
        x = np.append(begin, 0.1)
        for _ in range(6):  # peaks between the samples become samples
            row, room = self.limits()
            wide = np.column_stack([row, np.zeros(len(row))])
            constraints = [{"type": "ineq", "fun": lambda y: room + wide @ y, "jac": lambda y: wide}]
            if mean_Nm is None:
                def away(y):
                    torque, slope = self.torque(y[:n])
                    return (torque[0].real - wanted_Nm) / scale, np.append(slope[0].real, 0.0) / scale
                goal = {"fun": lambda y: away(y)[0] ** 2, "jac": lambda y: 2.0 * away(y)[0] * away(y)[1]}
            else:
                goal = {"fun": lambda y: y[n], "jac": lambda y: np.append(np.zeros(n), 1.0)}

                def orders(y):
                    torque, slope = self.torque(y[:n])
                    torque, slope = torque[1:] / scale, slope[1:] / scale
                    return (y[n] ** 2 - np.abs(torque) ** 2,
                            np.column_stack([-2.0 * (torque.real[:, None] * slope.real + torque.imag[:, None] * slope.imag),
                                             2.0 * y[n] * np.ones(len(torque))]))

                def mean(y):
                    torque, slope = self.torque(y[:n])
                    return (torque[0].real - mean_Nm) / scale, np.append(slope[0].real, 0.0) / scale
                constraints += [{"type": "ineq", "fun": lambda y: orders(y)[0], "jac": lambda y: orders(y)[1]},
                                {"type": "eq", "fun": lambda y: mean(y)[0], "jac": lambda y: mean(y)[1]}]
            found = minimize(goal["fun"], x, jac=goal["jac"], method="SLSQP", constraints=constraints,
                             options={"maxiter": 300, "ftol": 1e-12})
            x = found.x
            largest, where = self.peaks(x[:n])
            if max(largest) < 1.0 + 1e-6:
                break
            self.at = [np.unique(np.concatenate([a, b])) for a, b in zip(self.at, where)]
        torque = self.torque(x[:n])[0]
        if max(largest) > 1.0 + SAME or (mean_Nm is not None and abs(torque[0].real - mean_Nm) > SAME * scale):
            return None
        return x[:n]


    def envelope(self, begin, swing):
        """The largest mean with at most a share of swing, from one beginning; None without one."""
        n, x = len(begin), np.concatenate([begin, [self.over_angle(begin)[0].max(), self.over_angle(begin)[0].min()]])
        for _ in range(6):
            row, room = self.limits()
            wide = np.column_stack([row, np.zeros((len(row), 2))])

            def mean(y):
                torque, slope = self.torque(y[:n])
                return torque[0].real, np.append(slope[0].real, [0.0, 0.0])

            def between(y):
                torque, slope = self.over_angle(y[:n])
                above = np.column_stack([-slope, np.ones(len(torque)), np.zeros(len(torque))])
                below = np.column_stack([slope, np.zeros(len(torque)), -np.ones(len(torque))])
                last = swing * mean(y)[1] - np.append(np.zeros(n), [1.0, -1.0])
                return (np.concatenate([y[n] - torque, torque - y[n + 1], [swing * mean(y)[0] - y[n] + y[n + 1]]]),
                        np.vstack([above, below, last]))
            found = minimize(lambda y: -mean(y)[0], x, jac=lambda y: -mean(y)[1], method="SLSQP", options={"maxiter": 400, "ftol": 1e-10},
                             constraints=[{"type": "ineq", "fun": lambda y: room + wide @ y, "jac": lambda y: wide},
                                          {"type": "ineq", "fun": lambda y: between(y)[0], "jac": lambda y: between(y)[1]}])
            x = found.x
            largest, where = self.peaks(x[:n])
            if max(largest) < 1.0 + 1e-6:
                break
            self.at = [np.unique(np.concatenate([a, b])) for a, b in zip(self.at, where)]
        good = max(largest) < 1.0 + SAME and self.torque(x[:n])[0][0].real > 0.0 and self.swing(x[:n]) < swing + SAME
        return x[:n] if good else None


def components_up_to(top):
    return [(1, 1)] + [(n, -1 if n % 6 == 5 else 1) for n in range(5, top + 1) if n % 6 in (1, 5)]


def run(program, source, folder, point):
    """The project's currents as coordinates, and its summary."""
    top, torque, current, volts, speed = point
    components = components_up_to(top)
    with open(f"{folder}/target.csv", "w") as out:
        out.write(f"order,amplitude_Nm,phase_rad\n0,{torque},{math.pi / 2}\n")
    write_set(f"{folder}/set.csv", components)
    done = subprocess.run([program, "solve", f"{source}/data/machine_c", "--target", f"{folder}/target.csv", "--harmonics",
                           f"{folder}/set.csv", "--compare", "all", "--limit-current", str(current), "--limit-voltage", str(volts), "--speed",
                           str(speed), "-o", f"{folder}/out"], capture_output=True, text=True)
    if done.returncode not in (0, 1):
        sys.exit(f"{point}: {done.stderr}")
    x = np.zeros(2 * len(components))
    for order, name, amplitude, phase in table(f"{folder}/out/currents.csv")[1]:
        k = components.index((int(float(order)), 1 if name == "pos" else -1))
        x[2 * k] += float(amplitude) * math.cos(float(phase))
        x[2 * k + 1] += float(amplitude) * math.sin(float(phase))
    with open(f"{folder}/out/summary.json") as file:
        return components, x, json.load(file)


def beginnings(task, random, count):
    for k in range(count):
        x = np.zeros(2 * len(task.components))
        size, angle = task.current_A * random.uniform(0.3, 1.1), random.uniform(-0.3, 1.8)
        x[0], x[1] = size * math.cos(angle), size * math.sin(angle)
        if k % 2:
            x[2:] = random.normal(size=len(x) - 2) * 0.1 * task.current_A / np.repeat([n for n, _ in task.components[1:]], 2) ** 0.5
        yield x


def check(program, source, point, starts, random):
    with tempfile.TemporaryDirectory() as folder:
        components, x, summary = run(program, source, folder, point)
    _, wanted, current, volts, speed = point
    task = Task(Machine(f"{source}/data/machine_c"), components, current, volts, speed)
    torque, largest = task.torque(x)[0], task.peaks(x)[0]
    mean, worst = torque[0].real, np.abs(torque[1:]).max()
    bad = []
    if abs(mean - summary["torque"]["mean_Nm"]) > SAME * wanted or abs(worst - summary["torque"]["worst_error_Nm"]) > SAME * wanted and \
            summary["torque"]["worst_order"] > 0:
        bad.append("another torque")
    if max(largest) > 1.0 + SAME:
        bad.append(f"a limit by {max(largest) - 1.0:.1e}")
    list_of = [x] + list(beginnings(task, random, starts))
    found = [y for y in (task.solve(begin, wanted_Nm=wanted) for begin in list_of) if y is not None]
    nearest = min((task.torque(y)[0][0].real for y in found), key=lambda m: abs(m - wanted))
    line = [mean, nearest, (abs(mean - wanted) - abs(nearest - wanted)) / wanted, worst, math.nan, math.nan]
    if abs(mean - wanted) < SAME * wanted:
        found = [y for y in (task.solve(begin, mean_Nm=mean) for begin in list_of) if y is not None]
        least = min(np.abs(task.torque(y)[0][1:]).max() for y in found) if found else math.nan
        line[4:] = [least, (worst - least) / wanted]
    if line[2] > WORSE or line[5] > WORSE:
        bad.append("not the best")
    return line, bad


def write_set(path, components):
    with open(path, "w") as out:
        out.write("order,set\n" + "".join(f"{n},{'pos' if s > 0 else 'neg'}\n" for n, s in components))


def check_envelope(program, source, point, starts, random):
    """Torque of the project (0: none) and of SLSQP, and the share by which the project has less."""
    top, percent, current, volts, speed = point
    components = components_up_to(top)
    with tempfile.TemporaryDirectory() as folder:
        write_set(f"{folder}/set.csv", components)
        subprocess.run([program, "sweep", f"{source}/data/machine_c", "--envelope", "--ripple", str(percent), "--speeds", str(speed),
                        "--limit-current", str(current), "--limit-voltage", str(volts), "--harmonics", f"{folder}/set.csv", "--jobs", "1",
                        "--quiet", "-o", f"{folder}/out"], capture_output=True, check=False)
        with open(f"{folder}/out/envelope.csv") as file:
            own = next(csv.DictReader(file))["mean_Nm"]
    own = float(own) if own else 0.0
    task = Task(Machine(f"{source}/data/machine_c"), components, current, volts, speed)
    begin = list(beginnings(task, random, starts))
    for k in range(0, len(begin), 2):  # those next to a small ripple
        mean = random.uniform(0.2, 0.9) * task.torque(begin[k])[0][0].real
        smooth = task.solve(begin[k], mean_Nm=max(abs(mean), 1.0))
        begin[k] = begin[k] if smooth is None else smooth
    found = [x for x in (task.envelope(x, percent / 100.0) for x in begin) if x is not None]
    most = max((task.torque(x)[0][0].real for x in found), default=0.0)
    return own, most, (most - own) / max(most, own, 1e-9)


def main():
    arguments = argparse.ArgumentParser(description="solve within limits on machine C against SLSQP")
    arguments.add_argument("program")
    arguments.add_argument("source")
    arguments.add_argument("--starts", type=int, default=12)
    arguments.add_argument("--points", type=int, default=len(POINTS))
    arguments.add_argument("--envelope", type=int, default=len(ENVELOPE), help="points of the envelope")
    arguments.add_argument("--table")
    a = arguments.parse_args()
    random, rows, failed = np.random.default_rng(1), [], False
    print("top  wanted   limits            mean N·m: project, SLSQP (share worse)    worst order N·m: project, SLSQP (share worse)")
    for point in POINTS[: a.points]:
        line, bad = check(a.program, a.source, point, a.starts, random)
        failed = failed or bool(bad)
        print("%3d  %5.1f  %4.1f A %5.0f V %5d rpm   %9.5f %9.5f (%+.1e)   %9.5f %9.5f (%+.1e) %s" % (*point, *line, "; ".join(bad)), flush=True)
        rows.append([*point, *line])
    print("top  swing   limits            largest torque N·m: project, SLSQP (share less)")
    for point in ENVELOPE[: a.envelope]:
        line = check_envelope(a.program, a.source, point, a.starts, random)
        failed = failed or line[2] > WORSE
        print("%3d  %4.1f %%  %4.1f A %5.0f V %5d rpm   %9.5f %9.5f (%+.1e) %s" % (*point, *line, "not the best" if line[2] > WORSE else ""),
              flush=True)
    if a.table:
        with open(a.table, "w", newline="") as out:
            writer = csv.writer(out)
            writer.writerow(["top_order", "wanted_Nm", "current_A", "line_V", "speed_rpm", "mean_Nm", "slsqp_mean_Nm", "mean_worse", "worst_Nm",
                             "slsqp_worst_Nm", "worst_worse"])
            writer.writerows(rows)
    sys.exit(1 if failed else 0)


main()
