"""What must hold in a folder as it stands, with the widest honest bounds. It finds no slip; it tells the self-test that one shows.

off(files) lists the relations that do not hold. Correct folders have none, seeded ones at least one.
"""

import cmath
import math

from bench import CURRENTS, PHASE, VOLTAGES
from motor import TURN, wrap

SPACE = [2 / 3 * cmath.exp(1j * s) for s in PHASE]


class Declared:
    """The machine as its files say."""

    def __init__(self, files):
        self.machine, self.emf = files["machine/machine.csv"], files["machine/back_emf.csv"]
        self.cogging, self.inductance = files.get("machine/cogging.csv"), files.get("machine/inductance.csv")
        self.p, amplitude = self.get("pole_pairs"), list(self.emf.columns.values())[1][0]
        self.k_e = amplitude * self.p / (TURN * self.get("emf_frequency")) if "amplitude_V" in self.emf else amplitude
        self.saliency_H = self.get("inductance_d", 0) - self.get("inductance_q", 0)

    def get(self, name, default=None):
        return self.machine.value(name) if self.machine.has(name) else default

    def torque_Nm(self, i_d, i_q):
        return 1.5 * (self.k_e * i_q + self.p * self.saliency_H * i_d * i_q)


def mean(values):
    values = list(values)
    return sum(values) / len(values)


def within(name, value, low, high):
    return [] if low <= value <= high else ["%s %.4g not in %g ... %g" % (name, value, low, high)]


def off(files):
    machine = Declared(files)
    found = tables_off(machine) + ratings_off(machine)
    for path, run in files.items():
        if path.startswith("runs/"):
            found += ["%s: %s" % (path, x) for x in run_off(machine, run, path)]
    return found


def tables_off(machine):
    orders, amplitudes, phases = machine.emf.columns.values()
    found = within("first EMF order", orders[0], 1, 1) + within("EMF amplitude", amplitudes[0], 0, math.inf)
    found += within("EMF phase", wrap(phases[0]), -0.06, 0.06) + within("largest phase", max(map(abs, phases)), 0, TURN)
    if machine.cogging:
        found += within("largest cogging phase", max(map(abs, machine.cogging["phase_rad"])), 0, TURN)
    if machine.cogging and machine.get("slots"):
        first = math.lcm(int(machine.get("slots")), int(2 * machine.p)) // machine.p
        found += within("first cogging order by slots", min(machine.cogging["order"]) / first, 0, 1.01)
    if machine.inductance and "dLa_H_per_rad" in machine.inductance:
        table = machine.inductance
        second = 2 * abs(mean(x * cmath.exp(2j * t) for x, t in zip(table["dLa_H_per_rad"], table["theta_e_rad"])))
        found += within("slope of the inductance by saliency", second / (2 / 3 * machine.p * abs(machine.saliency_H)), 0.9, 1.1)
    return found


def ratings_off(machine):
    found, current = [], machine.get("rated_current")
    if current:
        best = max(machine.torque_Nm(-current * math.sin(k / 100), current * math.cos(k / 100)) for k in range(120))
        found += within("rated torque by current", machine.get("rated_torque") / best, 0.82, 1.15)
        if machine.get("dc_link_voltage"):
            back_V = math.sqrt(3) * machine.k_e * machine.get("rated_speed") * TURN / 60
            found += within("dc link by back-EMF", machine.get("dc_link_voltage") / back_V, 1.0, 3.0)
    return found


def electrical_angle(machine, run):
    """Of every sample, or None without an angle column."""
    for name, values in run.columns.items():
        if name.startswith("theta_"):
            scale = (machine.p if "_m_" in name else 1) * (math.pi / 180 if name.endswith("deg") else 1)
            return [scale * x for x in values], TURN * (machine.p if "_m_" in name else 1)
    return None, None


def speed_of(machine, run, theta, turn):
    """Mean mechanical speed by angle and time, and by its column; either may be None."""
    column = next((mean(run[name]) * (TURN / 60 if name.endswith("rpm") else 1) for name in run.columns if name.startswith("speed")), None)
    rate = None
    if theta and "time_s" in run:
        steps = [(b - a + turn / 2) % turn - turn / 2 for a, b in zip(theta, theta[1:])]
        rate = sum(steps) / machine.p / (run["time_s"][-1] - run["time_s"][0])
    return rate, column


def fundamental(run, names, theta):
    """Space vector in the frame of the angle, and its share of the whole."""
    vectors = [sum(c * x for c, x in zip(SPACE, row)) for row in zip(*(run[n] for n in names))]
    turned = mean(v * cmath.exp(-1j * t) for v, t in zip(vectors, theta))
    return 1j * turned, abs(turned) ** 2 / mean(abs(v) ** 2 for v in vectors)  # sin(theta) is 1 on the q axis


def run_off(machine, run, path):
    theta, turn = electrical_angle(machine, run)
    rate, column = speed_of(machine, run, theta, turn)
    omega = column if column is not None else rate
    found = within("speed by angle and time", rate / column, 0.97, 1.03) if rate and column else []
    back, slow = path.startswith("runs/back"), path.startswith("runs/slow")
    if theta and back:
        found += back_off(machine, run, theta, omega)
    if theta and slow and machine.cogging:
        found += cogging_off(machine, run, theta)
    if theta and not back and not slow:
        found += load_off(machine, run, theta, omega)
    return found


def back_off(machine, run, theta, omega):
    vector, share = fundamental(run, VOLTAGES, theta)
    found = within("share of order 1 in the voltages", share, 0.5, 1.01)
    if omega:
        k = vector / omega
        found += within("k_e of the bench by the table", abs(k) / abs(machine.k_e), 0.92, 1.08)
        found += within("phase of the voltages", wrap(cmath.phase(k) - machine.emf["phase_rad"][0]), -0.12, 0.12)
    return found


def load_off(machine, run, theta, omega):
    found = []
    if "iq_A" in run:
        i_d, i_q = mean(run["id_A"]), mean(run["iq_A"])
        copper = 1.5 * mean(d * d + q * q for d, q in zip(run["id_A"], run["iq_A"]))
        currents = [[q * math.sin(t - s) - d * math.cos(t - s) for s in PHASE] for d, q, t in zip(run["id_A"], run["iq_A"], theta)]
    else:
        vector, share = fundamental(run, CURRENTS, theta)
        found += within("share of order 1 in the currents", share, 0.8, 1.01)
        i_d, i_q = -vector.imag, vector.real
        currents = list(zip(*(run[n] for n in CURRENTS)))
        copper = mean(sum(x * x for x in row) for row in currents)
    torque = mean(run["torque_Nm"])
    found += within("torque by currents", torque / (machine.torque_Nm(i_d, i_q) or 1e-30), 0.82, 1.18)
    if VOLTAGES[0] in run and omega and machine.get("resistance"):
        electric = mean(sum(a * b for a, b in zip(u, i)) for u, i in zip(zip(*(run[n] for n in VOLTAGES)), currents))
        heat, shaft = machine.get("resistance") * copper, torque * omega
        found += within("power balance", (electric - heat - shaft) / (abs(heat) + abs(shaft)), -0.18, 0.18)
    return found


def cogging_off(machine, run, theta):
    """The largest order of the table in a slow run."""
    orders, amplitudes, _ = machine.cogging.columns.values()
    largest, order = max(zip(map(abs, amplitudes), orders))
    steady = mean(run["torque_Nm"])
    seen = 2 * abs(mean((T - steady) * cmath.exp(-1j * order * t) for T, t in zip(run["torque_Nm"], theta)))
    return within("cogging of the bench by the table", seen / largest, 0.5, 1.6)
