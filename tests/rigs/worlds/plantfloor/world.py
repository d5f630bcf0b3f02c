#!/usr/bin/env python3
"""Recordings of permanent-magnet motors as benches and plants deliver them, with hidden physics.

    world.py --selftest               closed forms and energy balance of the equations below
    world.py --list                   the kinds
    world.py KIND SEED FOLDER         one case: machine/, recordings, runs.csv, truth.json

Equations and conventions (electrical angle theta = p theta_m, zero where the fundamental of phase a's
back-EMF crosses zero upward; i_a = i_q sin theta - i_d cos theta; torque positive along positive rotation):

    T = (1 + heat)(e + de)(theta) . i + dW'/dtheta_m |_i + T_cog + what goes with the mechanical turn
    e_s = sum E_n sin(n (theta - 2 pi s/3) + phi_n)

W' is the co-energy of the saliency and of saturating iron; see `coenergy`.
"""
import argparse
import dataclasses
import json
import math
import os
import sys

import numpy as np

TAU = 2 * math.pi

# What this generator calls an effect, and the names under which a diagnosis may know it.
NAMES = {
    "cogging": ["cogging"],
    "emf": ["back_emf"],
    "phase": ["phase_imbalance"],
    "saliency": ["reluctance"],
    "saturation": ["saturation"],
    "temperature": ["magnet_temperature"],
    "mech": ["mechanical_order"],
    "mech_iq": ["mechanical_order"],
    "magnets": ["unequal_magnets", "mechanical_order"],
    "friction": ["friction"],
    "stribeck": ["stribeck_friction", "friction"],
    "iron": ["iron_drag"],
    "gain": ["current_gain"],
    "offset": ["current_offset"],
    "angle_offset": ["position_offset"],
    "angle_ecc": ["position_eccentricity"],
    "angle_harm": ["position_harmonics"],
    "delay": ["channel_delay", "current_filter"],
    "bell": ["torque_sensor"],
    "drift": ["torque_drift", "torque_sensor"],
    "hum": [],
    "belt": [],
    "fade": ["magnet_temperature"],
    "spikes": [],
}


# ---------------------------------------------------------------- machine

@dataclasses.dataclass
class Motor:
    """A machine as its folder may declare it."""
    p: int
    slots: int
    emf: dict          # electrical order -> (amplitude in N m/A, phase)
    cog: dict          # electrical order -> (amplitude in N m, phase)
    current: float     # rated peak current
    speed: float       # rated mechanical speed, rad/s
    inertia: float
    resistance: float
    inductance: float

    @property
    def kt(self):
        return 1.5 * self.emf[1][0]

    @property
    def torque(self):
        return self.kt * self.current

    @property
    def cog_order(self):
        """Lowest electrical order of slots and poles together."""
        return math.lcm(self.slots, 2 * self.p) // self.p


def random_motor(rng, cogging=True):
    p, slots = [(3, 18), (4, 12), (4, 24), (5, 12), (7, 12), (10, 24), (2, 24)][rng.integers(7)]
    e1 = 10 ** rng.uniform(-1.6, 0.3)
    emf = {1: (e1, 0.0)}
    for n, size in ((5, 0.03), (7, 0.02), (11, 0.01), (13, 0.006)):
        emf[n] = (e1 * size * rng.uniform(0.5, 1.6), rng.uniform(0, TAU))
    current = 10 ** rng.uniform(0.4, 2.0)
    m = Motor(p, slots, emf, {}, current, TAU * rng.uniform(15, 60), 0, 0, 0)
    if cogging:
        for k in (1, 2):
            m.cog[k * m.cog_order] = (m.torque * 0.02 / k ** 2 * rng.uniform(0.5, 1.5), rng.uniform(0, TAU))
    m.inertia = m.torque / rng.uniform(800, 3000)
    volts = e1 * m.speed
    m.resistance = 0.06 * volts / current
    m.inductance = 0.25 * volts / current / (p * m.speed)
    return m


def series(table, x):
    total = np.zeros_like(x, dtype=float)
    for n, (a, phase) in table.items():
        total = total + a * np.sin(n * x + phase)
    return total


def emf_of(table, theta):
    """e_s(theta), three rows."""
    return np.stack([series({n: (a, f - n * TAU * s / 3) for n, (a, f) in table.items()}, theta) for s in range(3)])


def to_dq(i, theta):
    """i_d, i_q of three phase currents (rows)."""
    alpha = (2 * i[0] - i[1] - i[2]) / 3
    beta = (i[1] - i[2]) / math.sqrt(3)
    return -(alpha * np.cos(theta) + beta * np.sin(theta)), alpha * np.sin(theta) - beta * np.cos(theta)


def to_abc(d, q, theta):
    return np.stack([q * np.sin(theta - TAU * s / 3) - d * np.cos(theta - TAU * s / 3) for s in range(3)])


def coenergy(fx, d, q, theta):
    """Co-energy beyond the linear magnet term: saliency, and a d flux that the q current takes away."""
    w = np.zeros_like(theta, dtype=float)
    if "saliency" in fx:
        s = fx["saliency"]
        ripple = s["ripple"] * np.sin(6 * theta + s["phase"])
        w = w + 0.75 * (s["dl"] * d ** 2 + ripple * q ** 2)
    if "saturation" in fx:
        s = fx["saturation"]
        flux = -s["flux"] * (q / s["knee"]) ** 2 / (1 + (q / s["knee"]) ** 2)
        w = w + 1.5 * d * flux * (1 + s["ripple"] * np.cos(6 * theta + s["phase"]))
    return w


def coenergy_torque(fx, d, q, theta, p):
    """dW'/dtheta_m at constant phase currents: di_d/dtheta = i_q, di_q/dtheta = -i_d."""
    t = np.zeros_like(theta, dtype=float)
    if "saliency" in fx:
        s = fx["saliency"]
        r, dr = s["ripple"] * np.sin(6 * theta + s["phase"]), 6 * s["ripple"] * np.cos(6 * theta + s["phase"])
        t = t + 0.75 * p * (2 * s["dl"] * d * q + dr * q ** 2 - 2 * r * q * d)
    if "saturation" in fx:
        s = fx["saturation"]
        u = (q / s["knee"]) ** 2
        flux = -s["flux"] * u / (1 + u)
        slope = -s["flux"] * 2 * q / s["knee"] ** 2 / (1 + u) ** 2
        shape = 1 + s["ripple"] * np.cos(6 * theta + s["phase"])
        dshape = -6 * s["ripple"] * np.sin(6 * theta + s["phase"])
        t = t + 1.5 * p * (q * flux * shape + d * slope * -d * shape + d * flux * dshape)
    return t


def machine_torque(m, fx, theta_m, i, temperature=20.0, t=0.0):
    theta = m.p * theta_m
    d, q = to_dq(i, theta)
    e = emf_of(m.emf, theta)
    if "emf" in fx:
        e = e + emf_of(fx["emf"], theta)
    if "phase" in fx:
        e = e * (1 + np.array(fx["phase"]))[:, None]
    mutual = (e * i).sum(axis=0)
    if "temperature" in fx:
        mutual = mutual * (1 + fx["temperature"] * (temperature - 20))
    if "fade" in fx:
        mutual = mutual * (1 - fx["fade"] * t)
    cog = series(m.cog, theta) + series(fx.get("cogging", {}), theta)
    total = mutual + cog + coenergy_torque(fx, d, q, theta, m.p)
    total = total + series(fx.get("mech", {}), theta_m) + q * series(fx.get("mech_iq", {}), theta_m)
    return total + (mutual + 2 * cog) * series(fx.get("magnets", {}), theta_m)


def drag(fx, w, i2):
    """Torque that brakes, as a positive number times the sign of the speed."""
    c, b, q = fx.get("friction", (0, 0, 0))
    t = c * np.sign(w) + b * w + q * w * abs(w)
    if "stribeck" in fx:
        excess, speed = fx["stribeck"]
        t = t + excess * np.exp(-(w / speed) ** 2) * np.sign(w)
    if "iron" in fx:
        h, e = fx["iron"]
        t = t + (h * np.sign(w) + e * w) * i2
    return t


# ---------------------------------------------------------------- bench

def read_angle(fx, p, theta_m):
    """Mechanical reading of an encoder."""
    shown = theta_m + series(fx.get("angle_ecc", {}), theta_m) + series(fx.get("angle_harm", {}), p * theta_m) / p
    return shown + fx.get("angle_offset", 0.0) / p


def transducer(u, h, tau=0.0, f=0.0, zeta=0.05):
    """Low pass and resonance of a torque sensor; trapezoidal rule with step h."""
    y = u
    if tau:
        a = (2 * tau / h - 1) / (2 * tau / h + 1)
        b = 1 / (2 * tau / h + 1)
        y = recursion(u, [b, b], [a])
    if f:
        k, w = 2 / h, TAU * f
        n = k * k + 2 * zeta * w * k + w * w
        y = recursion(y, [w * w / n, 2 * w * w / n, w * w / n],
                      [2 * (k * k - w * w) / n, -(k * k - 2 * zeta * w * k + w * w) / n])
    return y


def recursion(u, b, a):
    u = [float(v) for v in u]
    out = [u[0]] * len(a)
    for k in range(len(a), len(u)):
        out.append(sum(c * u[k - j] for j, c in enumerate(b)) + sum(c * out[k - 1 - j] for j, c in enumerate(a)))
    return np.array(out)


@dataclasses.dataclass
class Run:
    """One recording at a bench that turns the shaft."""
    name: str
    id: float = 0.0
    iq: float = 0.0
    speed: float = 10.0       # mechanical, signed
    n: int = 3000
    turns: float = 8.0
    temperature: float = 20.0
    wobble: float = 0.003     # relative, once a turn and a bit
    start: float = 0.0        # angle at which it starts
    fifth: float = 0.0        # injected negative-sequence order 5, A
    role: str = "fit"
    warm: float = 0.0         # by how much the magnets get warmer during the run


def turn(m, fx, run):
    """The shaft is turned by a second machine. Readings without noise, by channel."""
    duration = run.turns * TAU / abs(run.speed)
    h = duration / run.n
    t = h * np.arange(run.n)

    def angle(t):
        slow = run.wobble * abs(run.speed) / 1.13
        return run.start + run.speed * t + slow / abs(run.speed) * np.sin(1.13 * run.speed * t)

    def speed(t):
        return run.speed * (1 + run.wobble * np.cos(1.13 * run.speed * t))

    def current(t):
        shown = m.p * read_angle(fx, m.p, angle(t))
        i = to_abc(run.id, run.iq, shown)
        if run.fifth:
            i = i + np.stack([run.fifth * np.sin(5 * (shown - TAU * s / 3)) for s in range(3)])
        return i

    def heat(t):
        return run.temperature + run.warm * t / duration

    def shaft(t):
        i = current(t)
        return machine_torque(m, fx, angle(t), i, heat(t), t) - drag(fx, speed(t), 1.5 ** -1 * (i ** 2).sum(axis=0))

    late = fx.get("delay", {})
    bell = fx.get("bell", {})
    if bell.get("tau") or bell.get("f"):
        fine, lead = 8, 0
        slowest = max(bell.get("tau", 0), 1 / (TAU * bell["f"] * bell.get("zeta", 0.05)) if bell.get("f") else 0)
        lead = int(math.ceil(12 * slowest / h)) + 1
        grid = h / fine * np.arange(-lead * fine, run.n * fine)
        torque = transducer(shaft(grid), h / fine, bell.get("tau", 0), bell.get("f", 0),
                            bell.get("zeta", 0.05))[lead * fine::fine][:run.n]
    else:
        torque = shaft(t - late.get("torque", 0.0))
    torque = torque + bell.get("offset", 0.0) + fx.get("drift", 0.0) * t
    if "hum" in fx:
        torque = torque + fx["hum"][0] * np.sin(TAU * fx["hum"][1] * t + 0.4)
    if "belt" in fx:
        torque = torque + fx["belt"][0] * np.sin(fx["belt"][1] * angle(t) + 1.0)
    i = current(t - late.get("current", 0.0))
    i = i * (1 + np.array(fx.get("gain", (0, 0, 0))))[:, None] + np.array(fx.get("offset", (0, 0, 0)))[:, None]
    shown = read_angle(fx, m.p, angle(t - late.get("angle", 0.0)))
    e = emf_of(m.emf, m.p * angle(t)) + (emf_of(fx["emf"], m.p * angle(t)) if "emf" in fx else 0)
    return {"t": t, "theta": shown, "w": speed(t), "ia": i[0], "ib": i[1], "ic": i[2], "torque": torque,
            "temperature": heat(t), "va": e[0] * speed(t), "vb": e[1] * speed(t), "vc": e[2] * speed(t)}


def declared_residual(m, data):
    """Reading of the torque less what the declared machine says of the readings."""
    i = np.stack([data["ia"], data["ib"], data["ic"]])
    return data["torque"] - machine_torque(m, {}, data["theta"], i)


def torque_tables(m, fx, points=7200):
    """T(theta_m) = t0 + k i_q over a turn, i_d = 0 (without saliency and iron), as lists."""
    x = TAU * np.arange(points) / points
    zero = machine_torque(m, fx, x, np.zeros((3, points)))
    one = machine_torque(m, fx, x, to_abc(np.zeros(points), np.ones(points), m.p * x))
    return zero, one - zero


def hold(m, fx, x, direction, kp_error=0.0):
    """i_q that position control needs at angles x, moving slowly in a direction."""
    zero = machine_torque(m, fx, x, np.zeros((3, len(x))))
    k = machine_torque(m, fx, x, to_abc(np.zeros(len(x)), np.ones(len(x)), m.p * x)) - zero
    c = fx.get("friction", (0, 0, 0))[0]
    return (c * direction - zero) / k


def free_shaft(m, fx, iq_of, w0, h, n, sub=4, load=0.0, x0=0.0):
    """J dw/dt = T(theta, i_q) - drag - load; Runge-Kutta. iq_of(t, w) is the drive."""
    zero, k = torque_tables(m, fx)
    points = len(zero)
    zero, k = zero.tolist() + [float(zero[0])], k.tolist() + [float(k[0])]
    inertia = float(m.inertia)
    c, b, q2 = fx.get("friction", (0, 0, 0))

    def acceleration(x, w, iq):
        u = (x / TAU) % 1.0 * points
        j = int(u)
        f = u - j
        t = zero[j] + f * (zero[j + 1] - zero[j]) + iq * (k[j] + f * (k[j + 1] - k[j]))
        sign = 1.0 if w > 0 else -1.0 if w < 0 else 0.0
        return (t - c * sign - b * w - q2 * w * abs(w) - load) / inertia

    x, w, out = float(x0), float(w0), []
    g = h / sub
    for step in range(n):
        iq = float(iq_of(step * h, w))
        out.append((step * h, x, w, iq))
        for _ in range(sub):
            a1 = acceleration(x, w, iq)
            a2 = acceleration(x + g / 2 * w, w + g / 2 * a1, iq)
            a3 = acceleration(x + g / 2 * (w + g / 2 * a1), w + g / 2 * a2, iq)
            a4 = acceleration(x + g * (w + g / 2 * a2), w + g * a3, iq)
            x, w = x + g * (w + g / 6 * (a1 + a2 + a3)), w + g / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
    t, x, w, iq = np.array(out).T
    return {"t": t, "theta": x, "w": w, "iq": iq, "id": np.zeros(n)}


# ---------------------------------------------------------------- files

# channel -> heading and factor, by the habits of who recorded
DIALECTS = {
    "plain": dict(sep=",", names={
        "t": ("time_s", 1), "theta": ("theta_m_rad", 1), "w": ("speed_rad_per_s", 1), "ia": ("ia_A", 1), "ib": ("ib_A", 1),
        "ic": ("ic_A", 1), "id": ("id_A", 1), "iq": ("iq_A", 1), "torque": ("torque_Nm", 1),
        "temperature": ("temperature_C", 1), "va": ("va_V", 1), "vb": ("vb_V", 1), "vc": ("vc_V", 1)}),
    "german": dict(sep=";", comma=True, units=True, bom=True, crlf=True, names={
        "t": ("t", 1e3, "ms"), "theta": ("theta_mech", 180 / math.pi, "deg"), "w": ("motor_speed", 60 / TAU, "1/min"),
        "ia": ("i_u", 1, "A"), "ib": ("i_v", 1, "A"), "ic": ("i_w", 1, "A"), "id": ("i_d", 1, "A"), "iq": ("i_q", 1, "A"),
        "torque": ("shaft_torque", 1, "Nm"), "temperature": ("temperature", 1, "°C"), "va": ("va", 1, "V"),
        "vb": ("vb", 1, "V"), "vc": ("vc", 1, "V")}),
    "dyno": dict(sep="\t", head="# bench 3, run as found\n", wrap=True, names={
        "t": ("time (ms)", 1e3), "theta": ("theta_m [deg]", 180 / math.pi), "w": ("speed [rpm]", 60 / TAU),
        "ia": ("i_a (mA)", 1e3), "ib": ("i_b (mA)", 1e3), "ic": ("i_c (mA)", 1e3), "id": ("id_A", 1), "iq": ("iq_A", 1),
        "torque": ("torque (mNm)", 1e3), "temperature": ("temperature_C", 1), "va": ("va (mV)", 1e3),
        "vb": ("vb (mV)", 1e3), "vc": ("vc (mV)", 1e3)}),
    "logger": dict(sep=",", mapped=True, names={
        "t": ("Sec", 1, "time_s"), "theta": ("ENC", 1 / TAU, "theta_m_rev"), "w": ("TACHO", 60 / TAU, "speed_rpm"),
        "ia": ("AI0", 1, "ia_A"), "ib": ("AI1", 1, "ib_A"), "ic": ("AI2", 1, "ic_A"), "id": ("D", 1, "id_A"),
        "iq": ("Q", 1, "iq_A"), "torque": ("AI3", 1, "torque_Nm"), "temperature": ("PT100", 1, "temperature_C"),
        "va": ("AI4", 1, "va_V"), "vb": ("AI5", 1, "vb_V"), "vc": ("AI6", 1, "vc_V")}),
    "moteus": dict(sep=",", names={
        "t": ("timestamp", 1), "theta": ("position", 1 / TAU), "w": ("velocity", 1 / TAU), "iq": ("q_current", 1),
        "id": ("d_current", 1), "torque": ("torque", 1)}),
    "odrive": dict(sep=",", names={
        "t": ("t", 1), "theta": ("axis0.pos_estimate", 1 / TAU), "w": ("axis0.vel_estimate", 1 / TAU),
        "iq": ("axis0.Iq_measured", 1), "id": ("axis0.Id_measured", 1), "torque": ("axis0.torque_estimate", 1)}),
}


def write_run(path, data, dialect, holes=None):
    style = DIALECTS[dialect]
    columns = []
    for key, value in data.items():
        name = style["names"][key]
        value = np.asarray(value, dtype=float) * name[1]
        if key == "theta" and style.get("wrap"):
            value = np.mod(value, 360.0)
        columns.append((name, value))
    sep = style["sep"]
    lines = []
    if style.get("head"):
        lines.append(style["head"].rstrip("\n"))
    lines.append(sep.join(name[0] for name, _ in columns))
    if style.get("units"):
        lines.append(sep.join(name[2] for name, _ in columns))
    texts = [["%.9g" % v for v in value] for _, value in columns]
    rows = [list(row) for row in zip(*texts)]
    if holes:
        holes(rows)
    for row in rows:
        line = sep.join(row)
        lines.append(line.replace(".", ",") if style.get("comma") else line)
    end = "\r\n" if style.get("crlf") else "\n"
    with open(path, "w", encoding="utf-8-sig" if style.get("bom") else "utf-8", newline="") as f:
        f.write(end.join(lines) + end)
    if style.get("mapped"):
        with open(os.path.join(os.path.dirname(path), "columns.csv"), "w", encoding="utf-8") as f:
            f.write("name,column\n")
            for name, _ in columns:
                f.write(f"{name[2]},{name[0]}\n")


def write_machine(folder, m, ratings=True, extra=()):
    os.makedirs(folder, exist_ok=True)
    rows = [("pole_pairs", m.p, "1"), ("slots", m.slots, "1")]
    if ratings:
        rows += [("rated_current", m.current, "A"), ("rated_torque", m.torque, "Nm"), ("rated_speed", m.speed, "rad/s"),
                 ("resistance", m.resistance, "ohm"), ("inductance_d", m.inductance, "H"),
                 ("inductance_q", m.inductance, "H")]
    rows += list(extra)
    with open(os.path.join(folder, "machine.csv"), "w") as f:
        f.write("name,value,unit,source\n" + "".join(f"{n},{v:.9g},{u},sheet\n" for n, v, u in rows))
    with open(os.path.join(folder, "back_emf.csv"), "w") as f:
        f.write("order,amplitude_Nm_per_A,phase_rad\n" + "".join(f"{n},{a:.9g},{q:.9g}\n" for n, (a, q) in m.emf.items()))
    if m.cog:
        with open(os.path.join(folder, "cogging.csv"), "w") as f:
            f.write("order,amplitude_Nm,phase_rad\n" + "".join(f"{n},{a:.9g},{q:.9g}\n" for n, (a, q) in m.cog.items()))


# ---------------------------------------------------------------- cases

@dataclasses.dataclass
class Case:
    """What a kind makes. `files` is name -> (role, channels, options)."""
    expert: str
    motor: Motor
    fx: dict = dataclasses.field(default_factory=dict)
    declared: Motor = None
    files: dict = dataclasses.field(default_factory=dict)
    dialect: str = "plain"
    ratings: bool = True
    machine_extra: tuple = ()
    list_extra: dict = dataclasses.field(default_factory=dict)   # column -> value in runs.csv
    sigma: float = 0.0
    hidden: list = None          # names; else from fx
    alternatives: dict = dataclasses.field(default_factory=dict)  # hidden name -> names that no one could tell from it
    also: list = dataclasses.field(default_factory=list)          # may be named besides, and is not false
    outside: bool = False        # something that no name of the catalogue covers is hidden
    must_doubt: bool = False     # an answer "explained" is wrong whatever it names
    values: list = dataclasses.field(default_factory=list)       # effect, parameter, value, tolerance
    refusal_ok: bool = False     # there is nothing to compare: an error that says so is an answer
    strict: bool = False         # the alternatives are the same in these recordings to the last digit
    noise_only: bool = False     # noise and nothing else: saying that something is left is wrong
    strength: dict = dataclasses.field(default_factory=dict)     # name -> chi square and rms over noise
    secret: dict = None


KINDS = {}


def kind(f):
    KINDS[f.__name__] = f
    return f


def pick(rng, low, high):
    """A size with a sign."""
    return float(rng.choice([-1, 1]) * rng.uniform(low, high))


def fast_enough(m, n, most=12):
    """Turns of a run of n samples that show the second cogging order."""
    return float(np.clip(n / (2.3 * 2 * m.cog_order * m.p), 2.6, most)) + 0.137


def plan(rng, m, n=2600, what="full"):
    """Operating points as a bench would take them."""
    c, w, turns = m.current, m.speed, fast_enough(m, n)
    fast, slow = 0.8 * w, 0.12 * w
    points = {
        "full": [("idle", 0, 0, slow), ("idle_back", 0, 0, -slow), ("load", 0, c, slow), ("lead", -0.45 * c, 0.6 * c, -fast),
                 ("lag", 0.3 * c, 0.8 * c, fast), ("brake", 0, -c, -slow), ("part", 0, 0.3 * c, fast)],
        "small": [("idle", 0, 0, slow), ("load", 0, c, slow), ("back", 0, 0.5 * c, -fast), ("brake", -0.3 * c, -0.7 * c, fast)],
        "forward": [("p25", 0, 0.25 * c, slow), ("p50", 0, 0.5 * c, fast), ("p100", 0, c, slow)],
        "one_speed": [("p0", 0, 0, slow), ("p30", 0, 0.3 * c, slow), ("p60", -0.2 * c, 0.6 * c, slow), ("p100", 0, c, slow)],
    }[what]
    held = {"full": ("held", -0.2 * c, 0.7 * c, 0.5 * w), "small": ("held", -0.1 * c, 0.7 * c, -0.4 * w),
            "forward": ("held", 0, 0.75 * c, 0.4 * w), "one_speed": ("held", -0.1 * c, 0.8 * c, slow)}[what]
    runs = [Run(name, d, q, s, n, turns, start=rng.uniform(0, TAU)) for name, d, q, s in points]
    name, d, q, s = held
    return runs + [Run(name, d, q, s, n, turns, start=rng.uniform(0, TAU), role="holdout")]


CHANNELS = ("t", "theta", "w", "ia", "ib", "ic", "torque")


def bench(rng, m, fx, runs, noise=0.004, channels=CHANNELS, dialect=None, expert="", current_noise=0.001, counts=20000,
          declared=None, **more):
    """A case on a bench with a torque sensor. Noise is relative to the rated torque."""
    sigma = noise * m.torque
    case = Case(expert, m, fx, declared=declared, sigma=sigma, **more)
    case.dialect = dialect or str(rng.choice(["plain", "german", "dyno", "logger"]))
    clean = {}
    for run in runs:
        data = turn(m, fx, run)
        clean[run.name] = (run, data)
        shown = dict(data)
        n = run.n
        shown["torque"] = data["torque"] + sigma * rng.standard_normal(n)
        for s in ("ia", "ib", "ic"):
            shown[s] = data[s] + current_noise * m.current * rng.standard_normal(n)
        if counts:
            shown["theta"] = np.round(data["theta"] / TAU * counts) / counts * TAU
        shown["w"] = data["w"] * (1 + 1e-4 * rng.standard_normal(n))
        shown["temperature"] = data["temperature"] + 0.1 * rng.standard_normal(n)
        case.files[run.name + ".csv"] = (run.role, {c: shown[c] for c in channels}, {})
    case.strength = strengths(m, fx, runs, sigma)
    middle = next((r for r in runs if r.role == "holdout"), runs[-1])
    secret = dataclasses.replace(middle, id=0.9 * middle.id, iq=0.93 * middle.iq, start=1.0, fifth=0.0)
    case.secret = {c: v for c, v in turn(m, fx, secret).items() if c in channels}
    return case


def strengths(m, fx, runs, sigma):
    """How loud each hidden effect is: what it changes in residuals, against the noise."""
    out = {}
    fitted = [r for r in runs if r.role == "fit"]
    whole = [declared_residual(m, turn(m, fx, r)) for r in fitted]
    for key in fx:
        less = {k: v for k, v in fx.items() if k != key}
        change = [a - declared_residual(m, turn(m, less, r)) for a, r in zip(whole, fitted)]
        square = sum(float((c ** 2).sum()) for c in change)
        count = sum(len(c) for c in change)
        chi = square / sigma ** 2 if sigma else 1e9
        rms = math.sqrt(square / count) / sigma if sigma else 1e9
        for name in NAMES[key][:1]:
            out[name] = [round(chi, 1), round(rms, 4)]
    return out


# ---- nothing hidden

@kind
def nothing(rng):
    m = random_motor(rng)
    return bench(rng, m, {}, plan(rng, m), noise_only=True, expert="Nothing is missing.")


@kind
def nothing_same_runs(rng):
    m = random_motor(rng)
    turns = fast_enough(m, 2500)
    runs = [Run(f"r{k}", 0, 0.6 * m.current, 0.3 * m.speed, 2500, turns, role="fit" if k < 3 else "holdout") for k in range(4)]
    return bench(rng, m, {}, runs, noise_only=True, expert="Nothing is missing; the runs differ in nothing.")


@kind
def nothing_computed(rng):
    m = random_motor(rng)
    return bench(rng, m, {}, plan(rng, m, 1500, "small"), noise=1e-7, current_noise=0, counts=0,
                 noise_only=True, expert="Computed data without noise; the model describes it.")


@kind
def nothing_one_run(rng):
    m = random_motor(rng)
    run = Run("only", 0, m.current, 0.2 * m.speed, 3500, fast_enough(m, 3500))
    return bench(rng, m, {}, [run], noise_only=True, expert="One loaded run and nothing missing.")


# ---- in the machine

def missing_cogging(rng, m, size=0.02):
    n = m.cog_order
    return {n: (size * m.torque * rng.uniform(0.7, 1.3), rng.uniform(0, TAU)),
            2 * n: (0.3 * size * m.torque, rng.uniform(0, TAU))}


def amplitudes(fx, tolerance=0.12):
    """The strongest order of cogging has to be right in its amplitude."""
    n, (a, _) = max(fx["cogging"].items(), key=lambda item: item[1][0])
    return [("cogging", f"amplitude_{n}", a, tolerance * a)]


@kind
def cogging_left_out(rng):
    m = random_motor(rng, cogging=False)
    missing = missing_cogging(rng, m)
    return bench(rng, m, {"cogging": missing}, plan(rng, m), values=amplitudes({"cogging": missing}),
                 expert="Cogging torque is not declared.")


@kind
def cogging_of_stator_notch(rng):
    """An order of one slot pitch per turn: tolerances of the stator, k = 2p."""
    m = random_motor(rng)
    return bench(rng, m, {"cogging": {2: (0.015 * m.torque, rng.uniform(0, TAU))}}, plan(rng, m, what="small"),
                 expert="Cogging of twice an electrical turn (oval stator), with and without current.",
                 alternatives={"cogging": ["mechanical_order"]})


@kind
def one_loaded_run(rng):
    m = random_motor(rng, cogging=False)
    n = m.cog_order
    run = Run("only", 0, 0.8 * m.current, 0.15 * m.speed, 4000, fast_enough(m, 4000))
    return bench(rng, m, {"cogging": {n: (0.03 * m.torque, rng.uniform(0, TAU))}}, [run],
                 strict=True, expert="One current: cogging, back-EMF, reluctance, saturation of this order cannot be told apart.",
                 alternatives={"cogging": ["back_emf", "reluctance", "saturation"]})


@kind
def emf_harmonics(rng):
    m = random_motor(rng)
    e1 = m.emf[1][0]
    fx = {"emf": {5: (pick(rng, 0.02, 0.05) * e1, rng.uniform(0, TAU)), 7: (pick(rng, 0.01, 0.03) * e1, rng.uniform(0, TAU))}}
    return bench(rng, m, fx, plan(rng, m), expert="Fifth and seventh of the back-EMF differ.")


@kind
def emf_fundamental(rng):
    m = random_motor(rng)
    x = pick(rng, 0.04, 0.1)
    e1 = m.emf[1][0]
    return bench(rng, m, {"emf": {1: (x * e1, 0.0)}}, plan(rng, m, what="small"),
                 expert="Torque per ampere is off by some per cent: magnets, turns or all current sensors.",
                 alternatives={"back_emf": ["current_gain", "phase_imbalance", "magnet_temperature"]})


@kind
def shorted_turns(rng):
    m = random_motor(rng)
    g = [0.0, 0.0, 0.0]
    g[rng.integers(3)] = -rng.uniform(0.02, 0.06)
    return bench(rng, m, {"phase": g}, plan(rng, m), expert="One phase has fewer turns.",
                 alternatives={"phase_imbalance": ["back_emf"]})


@kind
def salient(rng):
    m = random_motor(rng)
    dl = -rng.uniform(0.3, 0.8) * m.kt / (1.5 * m.p * m.current)
    fx = {"saliency": {"dl": dl, "ripple": pick(rng, 0.02, 0.05) * dl, "phase": rng.uniform(0, TAU)}}
    return bench(rng, m, fx, plan(rng, m), expert="An interior-magnet machine declared without saliency.",
                 values=[("reluctance", "dd_cosine_0-qq_cosine_0", dl, 0.15 * abs(dl))])


def iron(rng, m, droop=None, ripple=None):
    droop = droop or rng.uniform(0.1, 0.25)
    knee = rng.uniform(1.0, 1.8) * m.current
    u = (m.current / knee) ** 2
    flux = droop * m.kt / (1.5 * m.p) * (1 + u) / u
    return {"flux": flux, "knee": knee, "ripple": rng.uniform(0.05, 0.15) if ripple is None else ripple,
            "phase": rng.uniform(0, TAU)}


@kind
def press_overload(rng):
    """Servo press: torque droops at load."""
    m = random_motor(rng)
    c, w = m.current, m.speed
    turns = fast_enough(m, 2200)
    runs = [Run(f"q{int(100 * q):+d}d{int(100 * d):+d}", d * c, q * c, s * w, 2200, turns, start=rng.uniform(0, TAU))
            for q, d, s in ((0, 0, .1), (.25, 0, .1), (.5, 0, -.1), (.75, 0, .1), (1, 0, .1), (-1, 0, -.1), (.5, -.4, .3), (.9, .3, .3))]
    runs.append(Run("held", -0.1 * c, 0.85 * c, 0.2 * w, 2200, turns, role="holdout"))
    return bench(rng, m, {"saturation": iron(rng, m)}, runs, expert="Saturation: torque falls off with load.",
                 also=["reluctance"])


@kind
def hot_magnets(rng):
    m = random_motor(rng)
    runs = plan(rng, m)
    for k, run in enumerate(runs):
        run.temperature = [22, 25, 30, 55, 80, 95, 110, 70][k]
        run.warm = 3.0
    alpha = -rng.uniform(0.0009, 0.002)
    return bench(rng, m, {"temperature": alpha}, runs, channels=CHANNELS + ("temperature",),
                 expert="Magnets lose flux with the logged temperature.",
                 values=[("magnet_temperature", "emf_per_kelvin", alpha, 0.25 * abs(alpha))])


@kind
def gear_mesh(rng):
    m = random_motor(rng)
    k = int(rng.choice([x for x in range(11, 48) if x % m.p]))
    fx = {"mech": {k: (0.02 * m.torque, rng.uniform(0, TAU)), 1: (0.01 * m.torque, rng.uniform(0, TAU))}}
    return bench(rng, m, fx, plan(rng, m, what="small"), expert="Gear mesh and an unbalance: orders of the mechanical turn.",
                 alternatives={"mechanical_order": ["cogging"]})


@kind
def rotor_eccentric(rng):
    m = random_motor(rng)
    fx = {"mech_iq": {1: (0.03 * m.kt, rng.uniform(0, TAU))}, "mech": {1: (0.008 * m.torque, rng.uniform(0, TAU))}}
    return bench(rng, m, fx, plan(rng, m), expert="An eccentric rotor: once a turn, with and in proportion to the load.")


@kind
def weak_pole(rng):
    m = random_motor(rng)
    fx = {"magnets": {1: (0.02, rng.uniform(0, TAU)), 3: (0.01, rng.uniform(0, TAU))}}
    return bench(rng, m, fx, plan(rng, m), expert="A weak magnet: fractional orders with load, sidebands of cogging.",
                 hidden=["unequal_magnets"], alternatives={"unequal_magnets": ["mechanical_order"]}, also=["cogging", "mechanical_order"])


# ---- on the bench

@kind
def clamp_gain(rng):
    m = random_motor(rng)
    g = [0.0, 0.0, 0.0]
    k = rng.integers(3)
    g[k] = pick(rng, 0.02, 0.05)
    return bench(rng, m, {"gain": g}, plan(rng, m), expert="One current clamp reads too much; the sum of the currents shows which.",
                 values=[("current_gain", "abc"[k], g[k], 0.35 * abs(g[k]))])


@kind
def clamp_zero(rng):
    m = random_motor(rng)
    o = [0.0, 0.0, 0.0]
    k = rng.integers(3)
    o[k] = pick(rng, 0.01, 0.03) * m.current
    return bench(rng, m, {"offset": o}, plan(rng, m), expert="One current clamp has an offset.",
                 values=[("current_offset", "abc"[k], o[k], 0.35 * abs(o[k]))])


@kind
def two_shunts(rng):
    m = random_motor(rng)
    g = [pick(rng, 0.03, 0.06), 0.0, 0.0]
    return bench(rng, m, {"gain": g}, plan(rng, m), channels=("t", "theta", "w", "ia", "ib", "torque"),
                 expert="Two currents logged: the gain of a sensor cannot be told from unequal phases.",
                 alternatives={"current_gain": ["phase_imbalance", "back_emf"]})


@kind
def index_moved(rng):
    m = random_motor(rng)
    d = pick(rng, 0.03, 0.1)
    return bench(rng, m, {"angle_offset": d}, plan(rng, m), expert="The angle zero is off.",
                 values=[("position_offset", "angle", d, 0.25 * abs(d))])


@kind
def late_or_turned(rng):
    """Angle offset seen at one speed in one direction: a delay does the same."""
    m = random_motor(rng)
    d = pick(rng, 0.04, 0.1)
    return bench(rng, m, {"angle_offset": d}, plan(rng, m, what="one_speed"), strict=True, expert="Offset of the angle or a delay: one speed.",
                 alternatives={"position_offset": ["channel_delay", "current_filter"]})


@kind
def encoder_coupling(rng):
    m = random_motor(rng)
    fx = {"angle_ecc": {1: (pick(rng, 0.02, 0.06) / m.p, rng.uniform(0, TAU))}}
    return bench(rng, m, fx, plan(rng, m), expert="The encoder sits out of centre.")


@kind
def resolver_errors(rng):
    m = random_motor(rng)
    fx = {"angle_harm": {2: (pick(rng, 0.02, 0.05), rng.uniform(0, TAU)), 4: (0.01, rng.uniform(0, TAU))}}
    return bench(rng, m, fx, plan(rng, m), expert="A resolver with errors twice and four times an electrical turn.")


@kind
def late_currents(rng):
    m = random_motor(rng)
    tau = rng.uniform(0.06, 0.12) / (m.p * 0.8 * m.speed)
    return bench(rng, m, {"delay": {"current": tau}}, plan(rng, m), expert="The current channels are late.",
                 values=[("channel_delay", "current", tau, 0.3 * tau)])


@kind
def late_torque(rng):
    """Torque over a slow bus: a millisecond or two behind."""
    m = random_motor(rng)
    tau = rng.uniform(0.0008, 0.0025)
    return bench(rng, m, {"delay": {"torque": tau}}, plan(rng, m), expert="The torque channel is late by a bus cycle or more.",
                 values=[("channel_delay", "torque", tau, 0.3 * tau)])


@kind
def torque_low_pass(rng):
    m = random_motor(rng)
    tau = rng.uniform(0.5, 1.2) / (m.cog_order * m.p * 0.4 * m.speed)
    runs = plan(rng, m, n=4000)
    for r in runs:
        r.turns = min(r.turns, 4000 / (4.5 * 2 * m.cog_order * m.p))   # samples enough for the second order of cogging
    return bench(rng, m, {"bell": {"tau": tau}}, runs, expert="The torque sensor's amplifier has a low pass.",
                 alternatives={"torque_sensor": []}, values=[("torque_sensor", "time_constant", tau, 0.35 * tau)])


@kind
def torsion(rng):
    m = random_motor(rng)
    f = m.cog_order * m.p * m.speed * rng.uniform(0.5, 0.75) / TAU
    runs = plan(rng, m, n=4000)
    for r in runs:
        r.turns = min(r.turns, 4000 / 13 * 0.8 * m.speed / TAU / f)   # thirteen samples a period of the resonance
    return bench(rng, m, {"bell": {"f": f, "zeta": 0.05}}, runs, expert="Shaft and torque sensor resonate.",
                 values=[("torque_sensor", "natural_frequency", f, 0.1 * f)])


@kind
def torque_zero(rng):
    m = random_motor(rng)
    x = pick(rng, 0.01, 0.03) * m.torque
    return bench(rng, m, {"bell": {"offset": x}}, plan(rng, m, what="small"), expert="Zero of the torque sensor.",
                 values=[("torque_sensor", "offset", x, 0.2 * abs(x))])


@kind
def torque_zero_creeps(rng):
    m = random_motor(rng)
    runs = plan(rng, m, what="small")
    longest = max(r.turns * TAU / abs(r.speed) for r in runs)
    return bench(rng, m, {"drift": pick(rng, 0.02, 0.04) * m.torque / longest}, runs,
                 expert="The zero creeps during each run; a diagnosis that knows no drift says that something does not repeat.")


@kind
def mains_hum(rng):
    m = random_motor(rng)
    return bench(rng, m, {"hum": (0.015 * m.torque, 50.0)}, plan(rng, m, what="small"), outside=True,
                 expert="50 Hz on the torque channel: follows time and no angle. Nothing of the machine.")


# ---- friction and drag

@kind
def bearing(rng):
    m = random_motor(rng)
    c, b = 0.02 * m.torque * rng.uniform(0.6, 1.4), 0.02 * m.torque / m.speed * rng.uniform(0.6, 1.4)
    return bench(rng, m, {"friction": (c, b, 0)}, plan(rng, m), expert="Friction before the torque sensor.",
                 values=[("friction", "coulomb", c, 0.25 * c), ("friction", "viscous", b, 0.25 * b)])


@kind
def bearing_one_way(rng):
    m = random_motor(rng)
    c = 0.02 * m.torque * rng.uniform(0.6, 1.4)
    return bench(rng, m, {"friction": (c, 0, 0)}, plan(rng, m, what="one_speed"),
                 strict=True, expert="One direction and speed: friction or the zero of the sensor.",
                 alternatives={"friction": ["torque_sensor"]})


@kind
def stick_slip(rng):
    m = random_motor(rng)
    c, w, turns = m.current, m.speed, fast_enough(m, 2000)
    runs = [Run(f"s{k}", 0, 0.4 * c, s * w, 2000, turns, start=k) for k, s in
            enumerate((.01, -.01, .03, -.03, .08, -.08, .3, -.3, .8, -.8))]
    runs.append(Run("held", 0, 0.4 * c, 0.15 * w, 2000, turns, role="holdout"))
    fx = {"friction": (0.012 * m.torque, 0.01 * m.torque / w, 0), "stribeck": (0.02 * m.torque, 0.06 * w)}
    return bench(rng, m, fx, runs, expert="Friction with Stribeck's excess at low speed.", hidden=["friction", "stribeck_friction"])


@kind
def iron_losses(rng):
    m = random_motor(rng)
    h = 0.02 * m.torque / m.current ** 2 * rng.uniform(0.7, 1.3)
    return bench(rng, m, {"iron": (h, 0.5 * h / m.speed)}, plan(rng, m), expert="A drag that grows with the load and turns with the direction.")


# ---- several at once

@kind
def three_effects(rng):
    m = random_motor(rng, cogging=False)
    c = 0.015 * m.torque
    o = [0.0, 0.0, 0.0]
    o[rng.integers(3)] = pick(rng, 0.015, 0.03) * m.current
    fx = {"cogging": missing_cogging(rng, m, 0.015), "friction": (c, 0, 0), "offset": o}
    return bench(rng, m, fx, plan(rng, m), expert="Cogging, friction and an offset of a clamp.")


@kind
def three_of_the_machine(rng):
    m = random_motor(rng)
    dl = -rng.uniform(0.2, 0.5) * m.kt / (1.5 * m.p * m.current)
    e1 = m.emf[1][0]
    fx = {"saliency": {"dl": dl, "ripple": 0.0, "phase": 0.0}, "emf": {5: (0.03 * e1, rng.uniform(0, TAU))},
          "mech": {1: (0.012 * m.torque, rng.uniform(0, TAU))}}
    return bench(rng, m, fx, plan(rng, m), expert="Saliency, a fifth harmonic of the back-EMF and once a turn.")


@kind
def bench_and_machine(rng):
    m = random_motor(rng)
    tau = rng.uniform(0.06, 0.1) / (m.p * 0.8 * m.speed)
    fx = {"delay": {"current": tau}, "angle_offset": pick(rng, 0.03, 0.06), "friction": (0.02 * m.torque, 0, 0)}
    return bench(rng, m, fx, plan(rng, m), expert="Late currents, a moved index and friction.")


@kind
def tenth_of_noise(rng):
    m = random_motor(rng, cogging=False)
    noise = 0.01
    fx = {"cogging": {m.cog_order: (0.15 * noise * m.torque, rng.uniform(0, TAU))}}
    return bench(rng, m, fx, plan(rng, m, n=4000), noise=noise, expert="Cogging of a tenth of the noise: found by its repeating, or too small to matter.")


@kind
def tenth_of_noise_friction(rng):
    m = random_motor(rng)
    noise = 0.01
    return bench(rng, m, {"friction": (0.12 * noise * m.torque, 0, 0)}, plan(rng, m, n=4000), noise=noise,
                 expert="Friction of a tenth of the noise.")


@kind
def loud_noise_only(rng):
    m = random_motor(rng)
    return bench(rng, m, {}, plan(rng, m, n=1200, what="small"), noise=0.15, current_noise=0.02, counts=500,
                 noise_only=True, expert="Loud noise, a coarse encoder, nothing missing.")


# ---- poor files

@kind
def dirty_file(rng):
    m = random_motor(rng, cogging=False)
    case = bench(rng, m, {"cogging": missing_cogging(rng, m, 0.03)}, plan(rng, m, what="small"), expert="Cogging, in files with holes and a coarse clock.")
    for name, (role, data, options) in case.files.items():
        step = 10 * float(np.median(np.diff(data["t"])))
        data["t"] = np.round(data["t"] / step) * step

        def holes(rows, rng=np.random.default_rng(rng.integers(1 << 30))):
            for r in rng.choice(len(rows), len(rows) // 100, replace=False):
                rows[r][rng.integers(1, len(rows[r]))] = str(rng.choice(["", "nan"]))
            rows[-1] = rows[-1][:2]
        options["holes"] = holes
    return case


@kind
def jittered_clock(rng):
    m = random_motor(rng)
    case = bench(rng, m, {}, plan(rng, m, what="small"), expert="Stamps wander against the samples; nothing missing.")
    for role, data, options in case.files.values():
        step = float(np.median(np.diff(data["t"])))
        data["t"] = np.sort(data["t"] + 0.8 * step * rng.uniform(-1, 1, len(data["t"])))
    return case


@kind
def spikes(rng):
    m = random_motor(rng)
    case = bench(rng, m, {}, plan(rng, m, what="small"), outside=True, expert="A loose plug: half a per cent of the torque samples are wild. Nothing of the machine.")
    for role, data, options in case.files.values():
        hit = rng.random(len(data["torque"])) < 0.005
        data["torque"] = np.where(hit, data["torque"] + 0.5 * m.torque * rng.standard_normal(len(hit)), data["torque"])
    return case


@kind
def coarse_adc(rng):
    m = random_motor(rng)
    case = bench(rng, m, {"friction": (0.02 * m.torque, 0, 0)}, plan(rng, m, what="small"), noise=0.002, expert="Friction, through a torque channel of eight bits.")
    lsb = 3.0 * m.torque / 256
    for role, data, options in case.files.values():
        data["torque"] = lsb * np.round(data["torque"] / lsb)
    return case


@kind
def oscilloscope(rng):
    """Time, speed, torque, no angle, no current."""
    m = random_motor(rng, cogging=False)
    turns = fast_enough(m, 4000)
    runs = [Run("a", 0, 0, 0.1 * m.speed, 4000, turns, wobble=0.0), Run("b", 0, 0, 0.1 * m.speed, 4000, turns, wobble=0.0, start=1)]
    return bench(rng, m, {"cogging": missing_cogging(rng, m)}, runs, channels=("t", "w", "torque"), counts=0,
                 expert="Cogging over time at a steady speed; its phase against the index is not known.",
                 alternatives={"cogging": ["mechanical_order"]})


@kind
def idle_only(rng):
    """No current columns at all."""
    m = random_motor(rng, cogging=False)
    turns = fast_enough(m, 4000)
    runs = [Run("cw", 0, 0, 0.1 * m.speed, 4000, turns), Run("ccw", 0, 0, -0.1 * m.speed, 4000, turns),
            Run("fast", 0, 0, 0.3 * m.speed, 4000, turns, role="holdout")]
    fx = {"cogging": missing_cogging(rng, m), "friction": (0.015 * m.torque, 0, 0)}
    return bench(rng, m, fx, runs, channels=("theta", "torque", "w"), ratings=False, expert="Cogging and friction; forward and back.")


@kind
def emf_spin(rng):
    """Open terminals, voltages logged: the fifth harmonic is not as declared."""
    m = random_motor(rng)
    e1 = m.emf[1][0]
    turns = fast_enough(m, 3500)
    runs = [Run("spin", 0, 0, 0.5 * m.speed, 3500, turns), Run("spin2", 0, 0, -0.25 * m.speed, 3500, turns)]
    case = bench(rng, m, {"emf": {5: (0.06 * e1, rng.uniform(0, TAU))}}, runs, channels=("t", "theta", "w", "va", "vb", "vc", "torque"),
                 expert="The voltages show a fifth harmonic that is not declared; the torque shows nothing.")
    case.strength = {"back_emf": [1e6, 10]}
    case.secret = None
    return case


# ---- without a torque sensor

def hold_case(rng, m, fx, dialect, channels, slow_log=False, **more):
    case = Case(motor=m, fx=fx, dialect=dialect, sigma=0.002 * m.torque, **more)
    n = 3000
    turns = 1.0 if not slow_log else 3.0
    for name, direction, role in (("fwd", 1, "fit"), ("bwd", -1, "fit"), ("fwd2", 1, "holdout")):
        x = rng.uniform(0, 1) + direction * TAU * turns * np.arange(n) / n
        iq = hold(m, fx, x, direction) + 0.002 * m.current * rng.standard_normal(n)
        w = 0.6
        data = {"t": np.arange(n) * TAU * turns / n / w, "theta": x, "w": w * direction * (1 + 0.01 * rng.standard_normal(n)),
                "id": 0.002 * m.current * rng.standard_normal(n), "iq": iq, "torque": m.kt * iq}
        case.files[name + ".csv"] = (role, {c: data[c] for c in channels}, {})
    case.strength = {name: [1e5, 5] for name in case.hidden or names_of(fx)}
    return case


def names_of(fx):
    out = []
    for key in fx:
        out += NAMES[key][:1]
    return out


@kind
def holding_map(rng):
    m = random_motor(rng, cogging=False)
    fx = {"cogging": missing_cogging(rng, m, 0.04), "friction": (0.02 * m.torque, 0, 0)}
    return hold_case(rng, m, fx, "plain", ("theta", "id", "iq"), list_extra={"test": "holding"},
                     values=amplitudes(fx), expert="A holding map there and back: cogging, and friction by the difference.")


@kind
def holding_gravity(rng):
    """A robot joint with its arm on: once a turn, and cogging."""
    m = random_motor(rng, cogging=False)
    fx = {"cogging": missing_cogging(rng, m, 0.04), "mech": {1: (0.1 * m.torque, rng.uniform(0, TAU))}, "friction": (0.03 * m.torque, 0, 0)}
    return hold_case(rng, m, fx, "plain", ("theta", "id", "iq"), list_extra={"test": "holding"},
                     expert="Arm's weight once a turn, cogging and friction.",
                     alternatives={"mechanical_order": ["cogging"]})


@kind
def moteus_slow_turn(rng):
    """Slow position ramp in a drive's log; its torque is computed from the current."""
    m = random_motor(rng, cogging=False)
    fx = {"cogging": missing_cogging(rng, m, 0.05), "friction": (0.02 * m.torque, 0, 0)}
    return hold_case(rng, m, fx, "moteus", ("t", "theta", "w", "id", "iq", "torque"), True,
                     machine_extra=(("inertia", m.inertia, "kgm2"),),
                     values=amplitudes(fx), expert="The current answers cogging and friction; the logged torque is the drive's.")


@kind
def holding_nothing(rng):
    m = random_motor(rng)
    return hold_case(rng, m, {}, "odrive", ("t", "theta", "w", "id", "iq", "torque"), True,
                     machine_extra=(("inertia", m.inertia, "kgm2"),), list_extra={"test": "holding"},
                     expert="A holding map of a machine whose cogging is declared: nothing is missing.")


def spin_case(rng, m, fx, drives, dialect="odrive", h=None, n=4000, load=0.0, counts=65536, **more):
    case = Case(motor=m, fx=fx, dialect=dialect, sigma=0.0, machine_extra=(("inertia", m.inertia, "kgm2"),), **more)
    for name, (iq_of, w0, role) in drives.items():
        step = h or 1.0 / (5.0 * 2 * m.cog_order * m.p * abs(w0) / TAU)
        data = free_shaft(m, fx, iq_of, w0, step, n, load=load, x0=rng.uniform(0, TAU))
        data["theta"] = np.round(data["theta"] / TAU * counts + rng.uniform(-.5, .5, n)) / counts * TAU
        data["iq"] = data["iq"] + 0.002 * m.current * rng.standard_normal(n)
        data["id"] = 0.002 * m.current * rng.standard_normal(n)
        data["w"] = data["w"] + 0.001 * abs(w0) * rng.standard_normal(n)
        case.files[name + ".csv"] = (role, {c: data[c] for c in ("t", "theta", "w", "id", "iq")}, {})
    case.strength = {x: [1e5, 5] for x in case.hidden or names_of(fx)}
    return case


def loop(m, target, stiff=4.0):
    """A speed controller of low gain."""
    k = stiff * m.inertia / m.kt
    limit = m.current

    def iq_of(t, w):
        return max(-limit, min(limit, k * (target - w)))
    return iq_of


@kind
def free_speed_ripple(rng):
    """No load, soft speed loop: the speed's own ripple shows the cogging."""
    m = random_motor(rng, cogging=False)
    w = 0.1 * m.speed
    fx = {"cogging": missing_cogging(rng, m, 0.05)}
    drives = {"up": (loop(m, w), w, "fit"), "down": (loop(m, -w), -w, "fit"), "up2": (loop(m, 1.3 * w), 1.3 * w, "holdout")}
    return spin_case(rng, m, fx, drives, values=amplitudes(fx), expert="Cogging, from the speed ripple of a free shaft.")


@kind
def free_nothing(rng):
    """The same bench, and the cogging is declared as it is."""
    m = random_motor(rng)
    w = 0.1 * m.speed
    drives = {"up": (loop(m, w), w, "fit"), "down": (loop(m, -w), -w, "fit"), "up2": (loop(m, 1.3 * w), 1.3 * w, "holdout")}
    return spin_case(rng, m, {}, drives, noise_only=True, expert="The speed ripple is that of the declared cogging: nothing is missing.")


@kind
def coast_down(rng):
    m = random_motor(rng, cogging=False)
    w = 0.6 * m.speed
    c, b = 0.03 * m.torque, 0.03 * m.torque / m.speed

    def off(t, w):
        return 0.0
    drives = {"cw": (off, w, "fit"), "ccw": (off, -w, "fit"), "half": (off, 0.7 * w, "holdout")}
    # stop recording before the shaft stands
    time = 0.7 * 0.6 * m.speed * m.inertia / (c + b * w) * 0.7
    return spin_case(rng, m, {"friction": (c, b, 0)}, drives, h=time / 3000, n=3000,
                     expert="Coasting: Coulomb's and viscous friction.",
                     values=[("friction", "coulomb", c, 0.25 * c), ("friction", "viscous", b, 0.35 * b)])


@kind
def unknown_load(rng):
    """An e-bike log under load: current against the hill; nothing is missing."""
    m = random_motor(rng)
    w = 0.3 * m.speed
    drives = {}
    case = None
    for name, role, part in (("ride1", "fit", 0.5), ("ride2", "fit", 0.3), ("ride3", "holdout", 0.4)):
        load = part * m.torque

        def drive(t, v, w=w, load=load, k=4.0 * m.inertia / m.kt):
            return load / m.kt + k * (w - v)
        one = spin_case(rng, m, {}, {name: (drive, w, role)}, load=load, expert="")
        if case is None:
            case = one
        case.files.update(one.files)
    case.expert = "The load is not known, and nothing is missing: no effect may be made of it."
    case.also = []
    return case


@kind
def unknown_load_cogging(rng):
    m = random_motor(rng, cogging=False)
    w = 0.1 * m.speed
    fx = {"cogging": missing_cogging(rng, m, 0.05)}
    case = None
    for name, role, part in (("ride1", "fit", 0.5), ("ride2", "fit", 0.3), ("ride3", "holdout", 0.4)):
        load = part * m.torque

        def drive(t, v, w=w, load=load, k=4.0 * m.inertia / m.kt):
            return load / m.kt + k * (w - v)
        one = spin_case(rng, m, fx, {name: (drive, w, role)}, load=load, expert="")
        if case is None:
            case = one
        case.files.update(one.files)
    case.values = amplitudes(fx)
    case.expert = "Cogging in the ripple of the speed; the load says nothing. At loads of 0.3 and 0.5 it could hardly be back-EMF."
    return case


@kind
def wrong_inertia(rng):
    """Declared inertia is off: in acceleration it looks like the torque constant."""
    m = random_motor(rng, cogging=False)
    factor = float(rng.choice([0.6, 1.5]))

    def square(t, w, c=0.5 * m.current, period=None):
        return c if (t / (0.3 * m.speed * m.inertia / (0.5 * m.torque))) % 2 < 1 else -c
    time = 0.3 * m.speed * m.inertia / (0.5 * m.torque)
    drives = {"a": (square, 0.2 * m.speed, "fit"), "b": (square, 0.3 * m.speed, "fit"), "c": (square, 0.25 * m.speed, "holdout")}
    case = spin_case(rng, m, {}, drives, h=6 * time / 4000, expert="The declared inertia is wrong. Acceleration alone cannot tell inertia from torque per ampere.",
                     must_doubt=True, outside=True, also=["back_emf", "current_gain", "phase_imbalance", "magnet_temperature"])
    case.machine_extra = (("inertia", factor * m.inertia, "kgm2"),)
    return case


# ---- maps and locked rotors

def map_case(rng, m, fx, expert, **more):
    c = m.current
    case = Case(expert, m, fx, sigma=0.003 * m.torque, **more)
    x = TAU * np.arange(720) / 720 / m.p
    for name, role, grid in (("map", "fit", [(d, q) for d in np.linspace(-1, 0.4, 8) for q in np.linspace(-1, 1, 11)]),
                             ("check", "holdout", [(d, q) for d in (-0.7, -0.1, 0.2) for q in (-0.7, 0.3, 0.9)])):
        rows = []
        for d, q in grid:
            t = machine_torque(m, fx, x, to_abc(np.full(720, d * c), np.full(720, q * c), m.p * x)).mean()
            rows.append((d * c, q * c, t + case.sigma * rng.standard_normal()))
        d, q, t = np.array(rows).T
        case.files[name + ".csv"] = (role, {"id": d, "iq": q, "torque": t}, {})
    case.strength = {x: [1e5, 5] for x in case.hidden or names_of(fx)}
    return case


@kind
def map_salient(rng):
    m = random_motor(rng, cogging=False)
    dl = -rng.uniform(0.4, 0.9) * m.kt / (1.5 * m.p * m.current)
    return map_case(rng, m, {"saliency": {"dl": dl, "ripple": 0.0, "phase": 0.0}}, "A torque map of a salient machine.",
                    values=[("reluctance", "dd_cosine_0-qq_cosine_0", dl, 0.15 * abs(dl))])


@kind
def map_saturated(rng):
    m = random_motor(rng, cogging=False)
    return map_case(rng, m, {"saturation": iron(rng, m, ripple=0.0)}, "A torque map that droops with load.", also=["reluctance"])


@kind
def map_nothing(rng):
    m = random_motor(rng, cogging=False)
    return map_case(rng, m, {}, "A torque map as declared.", noise_only=True)


@kind
def locked_rotor(rng):
    """Currents stand in the stator, the rotor is turned by hand to a few angles: torque of a salient machine."""
    m = random_motor(rng, cogging=False)
    dl = -rng.uniform(0.4, 0.9) * m.kt / (1.5 * m.p * m.current)
    fx = {"saliency": {"dl": dl, "ripple": 0.0, "phase": 0.0}}
    case = Case("Locked rotor at standing currents: saliency goes as the square of the current.", m, fx, sigma=0.004 * m.torque)
    case.dialect = str(rng.choice(["plain", "german"]))
    angles = np.repeat(np.arange(0, 360, 7.5), 4) * TAU / 360 / m.p
    for name, role, part in (("i40", "fit", 0.4), ("i70", "fit", 0.7), ("i100", "fit", 1.0), ("i85", "holdout", 0.85)):
        i = np.outer([1, -0.5, -0.5], np.full(len(angles), part * m.current))
        t = machine_torque(m, fx, angles, i) + case.sigma * rng.standard_normal(len(angles))
        i = i + 0.001 * m.current * rng.standard_normal(i.shape)
        case.files[name + ".csv"] = (role, {"theta": angles, "ia": i[0], "ib": i[1], "ic": i[2], "torque": t}, {})
    case.strength = {"reluctance": [1e5, 5]}
    return case


# ---- a machine that is declared wrongly

@kind
def declared_rms(rng):
    """Back-EMF declared as rms: all amplitudes are 0.707 of the peak."""
    m = random_motor(rng)
    declared = dataclasses.replace(m, emf={n: (a / math.sqrt(2), f) for n, (a, f) in m.emf.items()})
    case = bench(rng, m, {}, plan(rng, m), declared=declared, hidden=["back_emf"], alternatives={"back_emf": []},
                 expert="Torque per ampere is 1.41 of what is declared: a convention, or another machine.")
    case.strength = {"back_emf": [1e6, 50]}
    return case


@kind
def declared_poles(rng):
    m = random_motor(rng)
    declared = dataclasses.replace(m, p=m.p + 1)
    return bench(rng, m, {}, plan(rng, m), declared=declared, must_doubt=True, outside=True,
                 expert="Pole pairs are wrong: no effect explains that.")


@kind
def swapped_phases(rng):
    m = random_motor(rng)
    case = bench(rng, m, {}, plan(rng, m), must_doubt=True, outside=True, expert="Clamps b and c are swapped: no effect explains that.")
    for role, data, options in case.files.values():
        data["ib"], data["ic"] = data["ic"], data["ib"]
    case.secret = None
    return case


@kind
def reversed_clamps(rng):
    m = random_motor(rng)
    case = bench(rng, m, {}, plan(rng, m), must_doubt=True, outside=True, expert="All clamps are on backward: the sign of the current.")
    for role, data, options in case.files.values():
        for s in ("ia", "ib", "ic"):
            data[s] = -data[s]
    case.secret = None
    return case


@kind
def fading(rng):
    """Magnets warm up within each run, nobody logs the temperature."""
    m = random_motor(rng)
    runs = plan(rng, m, what="small")
    for r in runs:
        r.speed *= 0.5
    longest = max(r.turns * TAU / abs(r.speed) for r in runs)
    return bench(rng, m, {"fade": 0.05 / longest}, runs, outside=True, also=["back_emf", "magnet_temperature", "current_gain", "phase_imbalance"],
                 expert="Torque per ampere falls during loaded runs; without a temperature it does not repeat.")


# ---- as they really are

@kind
def nothing_dead_time(rng):
    """The inverter's dead time distorts the currents; they are measured, so nothing is missing."""
    m = random_motor(rng)
    runs = plan(rng, m, what="small")
    for r in runs:
        r.fifth = pick(rng, 0.02, 0.05) * m.current if r.iq else 0.0
    return bench(rng, m, {}, runs, noise_only=True, expert="Distorted currents, all measured: nothing is missing.")


@kind
def nothing_wander(rng):
    """Slow wander of the torque sensor's zero, a random walk that forgets."""
    m = random_motor(rng)
    case = bench(rng, m, {}, plan(rng, m, what="small"), expert="Coloured noise of the sensor; nothing of the machine.")
    for role, data, options in case.files.values():
        n = len(data["torque"])
        walk = recursion(rng.standard_normal(n), [1.0, 0.0], [0.995])
        data["torque"] = data["torque"] + 0.006 * m.torque * walk / walk.std()
    return case


@kind
def nothing_warm(rng):
    m = random_motor(rng)
    runs = plan(rng, m)
    for k, run in enumerate(runs):
        run.temperature = [22, 25, 30, 55, 80, 95, 110, 70][k]
    return bench(rng, m, {}, runs, channels=CHANNELS + ("temperature",), noise_only=True,
                 expert="The housing's temperature varies, the magnets do not mind.")


@kind
def same_runs_ripple(rng):
    """Four runs that differ in nothing, and an order of the slots that is not declared."""
    m = random_motor(rng, cogging=False)
    turns = fast_enough(m, 2500)
    n = m.cog_order
    runs = [Run(f"r{k}", 0, 0.7 * m.current, 0.2 * m.speed, 2500, turns, start=k, role="fit" if k < 3 else "holdout") for k in range(4)]
    return bench(rng, m, {"cogging": {n: (0.025 * m.torque, rng.uniform(0, TAU))}}, runs, strict=True,
                 expert="One operating point four times: cogging, back-EMF, reluctance or saturation.",
                 alternatives={"cogging": ["back_emf", "reluctance", "saturation"]})


@kind
def inverted_cogging(rng):
    """The declared cogging table has its sign turned."""
    m = random_motor(rng)
    declared = dataclasses.replace(m, cog={n: (a, (f + math.pi) % TAU) for n, (a, f) in m.cog.items()})
    case = bench(rng, m, {}, plan(rng, m, what="small"), declared=declared, hidden=["cogging"],
                 expert="Cogging is declared with the wrong sign: a correction of twice its size.")
    case.strength = {"cogging": [1e6, 5]}
    return case


@kind
def run_up(rng):
    """One recording of each load from slow to fast, pieced together; late currents."""
    m = random_motor(rng)
    tau = rng.uniform(0.08, 0.12) / (m.p * 0.8 * m.speed)
    c, w = m.current, m.speed
    case = None
    for name, q, role in (("no_load", 0, "fit"), ("load", c, "fit"), ("half", 0.5 * c, "fit"), ("held", 0.75 * c, "holdout")):
        parts = [Run(name, 0, q, s * w, 500, fast_enough(m, 500, 3), start=5.0) for s in (0.1, 0.2, 0.4, 0.6, 0.8)]
        data, at, x = {}, 0.0, 0.0
        for k, part in enumerate(parts):
            part.start = 5.0 + x
            one = turn(m, {"delay": {"current": tau}}, part)
            one["t"] = one["t"] + at
            at, x = at + part.turns * TAU / part.speed + 0.5, x + part.turns * TAU
            data = {key: np.concatenate([data[key], one[key]]) if data else one[key] for key in one}
            if not k:
                data = one
        data["torque"] = data["torque"] + 0.004 * m.torque * rng.standard_normal(len(data["t"]))
        if case is None:
            case = Case("Currents late by a constant time, seen at five speeds in each file.", m, {"delay": {"current": tau}},
                        sigma=0.004 * m.torque, values=[("channel_delay", "current", tau, 0.3 * tau)])
        case.files[name + ".csv"] = (role, {key: data[key] for key in CHANNELS}, {})
    case.strength = {"channel_delay": [1e5, 4]}
    return case


@kind
def to_and_fro(rng):
    """A robot joint swings over less than half a turn, with a torque sensor."""
    m = random_motor(rng, cogging=False)
    fx = {"cogging": {m.cog_order: (0.03 * m.torque, rng.uniform(0, TAU))}, "friction": (0.02 * m.torque, 0.0, 0)}
    case = Case("A swing over part of a turn: cogging and friction; nothing finer than the arc.", m, fx, sigma=0.004 * m.torque,
                also=[], alternatives={"cogging": ["mechanical_order"]})
    n = 4000
    for name, q, amplitude, role in (("a", 0, 1.1, "fit"), ("b", 0.5, 0.9, "fit"), ("c", -0.8, 1.1, "fit"), ("d", 0.3, 1.0, "holdout")):
        t = np.arange(n) * 0.005
        x = 0.7 + amplitude * np.sin(0.7 * t)
        w = 0.7 * amplitude * np.cos(0.7 * t)
        i = to_abc(np.zeros(n), np.full(n, q * m.current), m.p * x)
        torque = machine_torque(m, fx, x, i) - fx["friction"][0] * np.sign(w) + case.sigma * rng.standard_normal(n)
        i = i + 0.001 * m.current * rng.standard_normal(i.shape)
        case.files[name + ".csv"] = (role, {"t": t, "theta": x + 1e-4 * rng.standard_normal(n), "w": w + 1e-3 * rng.standard_normal(n),
                                            "ia": i[0], "ib": i[1], "ic": i[2], "torque": torque}, {})
    case.strength = {"cogging": [1e5, 5], "friction": [1e5, 5]}
    return case


@kind
def drag_curve(rng):
    """Plateaus of speed without load, a fan on the shaft."""
    m = random_motor(rng, cogging=False)
    c, b, q = 0.012 * m.torque, 0.012 * m.torque / m.speed, 0.03 * m.torque / m.speed ** 2
    runs = [Run(f"n{int(100 * s):+d}", 0, 0, s * m.speed, 1200, 5.13, start=k) for k, s in
            enumerate((.1, -.1, .3, -.3, .5, -.5, .7, -.7, 1, -1))]
    runs.append(Run("held", 0, 0, 0.6 * m.speed, 1200, 5.13, role="holdout"))
    return bench(rng, m, {"friction": (c, b, q)}, runs, expert="Friction and a fan: sign, slope and square of the speed.",
                 values=[("friction", "coulomb", c, 0.3 * c), ("friction", "quadratic", q, 0.3 * q)])


@kind
def field_solver(rng):
    """One electrical period at each point, 73 angles, no noise: a salient machine that saturates."""
    m = random_motor(rng, cogging=False)
    dl = -rng.uniform(0.3, 0.6) * m.kt / (1.5 * m.p * m.current)
    fx = {"saliency": {"dl": dl, "ripple": 0.03 * dl, "phase": rng.uniform(0, TAU)}}
    case = Case("Computed points of a salient machine.", m, fx, sigma=0.0)
    x = TAU * np.arange(73) / 72 / m.p
    for k, (d, q, role) in enumerate(((0, 0, "fit"), (0, .5, "fit"), (0, 1, "fit"), (-.5, .5, "fit"), (-.5, 1, "fit"), (-1, .7, "fit"),
                                      (-.3, .8, "holdout"))):
        i = to_abc(np.full(73, d * m.current), np.full(73, q * m.current), m.p * x)
        case.files[f"point{k}.csv"] = (role, {"theta": x, "ia": i[0], "ib": i[1], "ic": i[2], "torque": machine_torque(m, fx, x, i)}, {})
    case.strength = {"reluctance": [1e6, 10]}
    case.values = [("reluctance", "dd_cosine_0-qq_cosine_0", dl, 0.1 * abs(dl))]
    return case


@kind
def one_clamp_late(rng):
    """Phase a is sampled later than b and c: a multiplexed converter. No name of the catalogue."""
    m = random_motor(rng)
    tau = rng.uniform(0.06, 0.1) / (m.p * 0.8 * m.speed)
    runs = plan(rng, m)
    case = bench(rng, m, {}, runs, outside=True, also=["channel_delay"], expert="One phase is sampled later than the others.")
    for run in runs:
        late = turn(m, {"delay": {"current": tau}}, run)
        role, data, options = case.files[run.name + ".csv"]
        data["ia"] = late["ia"] + 0.001 * m.current * rng.standard_normal(run.n)
    case.secret = None
    return case


@kind
def dq_only_gain(rng):
    """A drive logs i_d and i_q of clamps of which one reads too much."""
    m = random_motor(rng)
    g = [0.0, 0.0, 0.0]
    g[rng.integers(3)] = pick(rng, 0.02, 0.05)
    runs = plan(rng, m)
    case = bench(rng, m, {"gain": g}, runs, alternatives={"current_gain": ["phase_imbalance", "back_emf"]},
                 expert="i_d and i_q only: a clamp's gain or a weak phase.")
    for run in runs:
        role, data, options = case.files[run.name + ".csv"]
        d, q = to_dq(np.stack([data["ia"], data["ib"], data["ic"]]), m.p * data["theta"])
        case.files[run.name + ".csv"] = (role, {"t": data["t"], "theta": data["theta"], "w": data["w"], "id": d, "iq": q,
                                                "torque": data["torque"]}, options)
    case.secret = None
    return case


@kind
def index_lost_once(rng):
    """The drive was restarted before one of the runs: its angle zero is elsewhere."""
    m = random_motor(rng)
    runs = plan(rng, m)
    case = bench(rng, m, {}, runs, outside=True, also=["position_offset"], expert="One run has its angle zero elsewhere.")
    role, data, options = case.files["lag.csv"]
    data["theta"] = data["theta"] + 0.15 / m.p
    return case


@kind
def drive_log_under_load(rng):
    """A drive's own log at a load: its torque is its current, no inertia is known. Nothing can be learned."""
    m = random_motor(rng, cogging=False)
    case = Case("The torque is computed from the current: nothing can be said of the machine.", m, {}, dialect="moteus", refusal_ok=True)
    n = 3000
    for name, part, w, role in (("a", 0.3, 0.2, "fit"), ("b", 0.7, 0.4, "fit"), ("c", 0.5, 0.3, "holdout")):
        w = w * m.speed
        t = np.arange(n) * 0.002
        x = w * t
        iq = m.current * (part + 0.02 * np.sin(m.cog_order * m.p * x + 1) + 0.003 * rng.standard_normal(n))
        case.files[name + ".csv"] = (role, {"t": t, "theta": x, "w": w * (1 + 0.002 * rng.standard_normal(n)),
                                            "id": 0.003 * m.current * rng.standard_normal(n), "iq": iq, "torque": m.kt * iq}, {})
    return case


@kind
def scaled_everything(rng):
    """Torque per ampere, iron and bearings all differ from the sheet."""
    m = random_motor(rng)
    e1 = m.emf[1][0]
    fx = {"emf": {1: (-rng.uniform(0.04, 0.08) * e1, 0.0)}, "friction": (0.015 * m.torque, 0.01 * m.torque / m.speed, 0),
          "saliency": {"dl": -0.25 * m.kt / (1.5 * m.p * m.current), "ripple": 0.0, "phase": 0.0}}
    return bench(rng, m, fx, plan(rng, m), expert="Weaker magnets, friction and saliency.",
                 alternatives={"back_emf": ["current_gain", "phase_imbalance", "magnet_temperature"]})


# ---------------------------------------------------------------- writing a case

def write_case(name, seed, folder):
    rng = np.random.default_rng([seed, sum(ord(c) * 31 ** (k % 7) for k, c in enumerate(name))])
    case = KINDS[name](rng)
    os.makedirs(folder, exist_ok=True)
    declared = case.declared or case.motor
    write_machine(os.path.join(folder, "machine"), declared, case.ratings, case.machine_extra)
    os.makedirs(os.path.join(folder, "rec"), exist_ok=True)
    with open(os.path.join(folder, "runs.csv"), "w") as f:
        f.write(",".join(["file", "role"] + list(case.list_extra)) + "\n")
        for file, (role, data, options) in case.files.items():
            write_run(os.path.join(folder, "rec", file), data, case.dialect, options.get("holes"))
            f.write(",".join([f"rec/{file}", role] + list(case.list_extra.values())) + "\n")
    if case.secret:
        os.makedirs(os.path.join(folder, "secret"), exist_ok=True)
        write_run(os.path.join(folder, "secret", "secret.csv"), case.secret, case.dialect)
    hidden = case.hidden if case.hidden is not None else sorted(set(names_of(case.fx)))
    truth = {"kind": name, "seed": seed, "hidden": hidden, "effects": case.fx, "expert": case.expert,
             "alternatives": case.alternatives, "also": case.also, "outside": case.outside, "must_doubt": case.must_doubt,
             "strength": case.strength, "values": case.values, "strict": case.strict, "refusal_ok": case.refusal_ok,
             "noise_only": case.noise_only, "sigma_Nm": case.sigma,
             "synonyms": {n[0]: n[1:] for n in NAMES.values() if len(n) > 1}}
    with open(os.path.join(folder, "truth.json"), "w") as f:
        json.dump(truth, f, indent=1, default=lambda v: v.tolist() if hasattr(v, "tolist") else str(v))
    return truth


# ---------------------------------------------------------------- selftest

def selftest():
    rng = np.random.default_rng(7)
    bad = []

    def near(what, a, b, tolerance):
        worst = float(np.max(np.abs(np.asarray(a) - np.asarray(b))))
        if not worst <= tolerance:
            bad.append(f"{what}: {worst:g} > {tolerance:g}")
        print(f"{'ok ' if worst <= tolerance else 'BAD'} {what}: {worst:.2e}")

    m = random_motor(rng)
    x = np.linspace(0, TAU, 400, endpoint=False)
    d, q = rng.standard_normal(400), rng.standard_normal(400)
    back = to_dq(to_abc(d, q, x), x)
    near("dq there and back", back, (d, q), 1e-12)
    sine = dataclasses.replace(m, emf={1: m.emf[1]}, cog={})
    near("sine machine: T = 3/2 E i_q", machine_torque(sine, {}, x / m.p, to_abc(d, q, x)), m.kt * q, 1e-9 * m.torque)
    e = emf_of({5: (1.0, 0.3)}, x)
    i = to_abc(0 * x, 0 * x + 2.0, x)
    near("order 5 with a sine: -3/2 E I cos(6 theta + phi)", (e * i).sum(0), -3 * np.cos(6 * x + 0.3), 1e-9)
    e = emf_of({7: (1.0, 0.3)}, x)
    near("order 7 with a sine: 3/2 E I cos(6 theta + phi)", (e * i).sum(0), 3 * np.cos(6 * x + 0.3), 1e-9)
    fx = {"saliency": {"dl": -0.003, "ripple": 0.0004, "phase": 0.7}, "saturation": iron(rng, m)}
    i = to_abc(d * m.current, q * m.current, x)

    def energy(th):
        return coenergy(fx, *to_dq(i, th), th)
    h = 1e-5
    slope = m.p * (energy(x + h) - energy(x - h)) / (2 * h)
    t = coenergy_torque(fx, *to_dq(i, x), x, m.p)
    near("dW'/dtheta_m by differences", slope, t, 1e-6 * np.abs(t).max())
    near("saliency: 3/2 p dL i_d i_q", coenergy_torque({"saliency": {"dl": 0.002, "ripple": 0, "phase": 0}}, d, q, x, 4), 12e-3 * d * q, 1e-12)
    # work over a closed path of the rotor at standing currents is nothing: co-energy returns
    i = to_abc(np.full(4000, 3.0), np.full(4000, 5.0), np.full(4000, 0.4))
    y = TAU * np.arange(4000) / 4000
    work = (machine_torque(m, fx, y, i)).mean()
    near("no work over a turn at standing currents", work, 0, 1e-9 * m.torque)
    # electrical power into the back-EMF is the mechanical one
    run = Run("x", 0, m.current, 20.0, 500, 2.0)
    data = turn(dataclasses.replace(m, cog={}), {}, run)
    power = sum(data["v" + s] * data["i" + s] for s in "abc")
    near("e.i = T w", power, data["torque"] * data["w"], 1e-9 * np.abs(power).max())
    # torque sensor: gain of a sine
    h, f, tau, zeta = 1e-5, 180.0, 1.3e-3, 0.05
    tt = h * np.arange(40000)
    for what, g, y in (("low pass", 1 / (1 + 1j * TAU * 90 * tau), transducer(np.sin(TAU * 90 * tt), h, tau)),
                       ("resonance", 1 / (1 + 2 * zeta * 1j * 90 / f - (90 / f) ** 2), transducer(np.sin(TAU * 90 * tt), h, 0, f, zeta))):
        near("torque sensor, " + what, y[-5000:], np.imag(g * np.exp(1j * TAU * 90 * tt[-5000:])), 2e-4)
    # free shaft: work of the torque is kinetic energy, with cogging and a current
    fx = {"cogging": missing_cogging(rng, m, 0.05)}
    data = free_shaft(m, fx, lambda t, w: 0.2 * m.current, 5.0, 2e-4, 3000)
    t = machine_torque(m, fx, data["theta"], to_abc(np.zeros(3000), data["iq"], m.p * data["theta"]))
    work = np.concatenate([[0], np.cumsum((t[1:] + t[:-1]) / 2 * np.diff(data["theta"]))])
    kinetic = m.inertia / 2 * (data["w"] ** 2 - 25.0)
    near("free shaft: work = kinetic energy", work, kinetic, 2e-3 * np.abs(kinetic).max())
    c, b, w0 = 0.03 * m.torque, 0.03 * m.torque / m.speed, 0.5 * m.speed
    data = free_shaft(dataclasses.replace(m, cog={}), {"friction": (c, b, 0)}, lambda t, w: 0.0, w0, 1e-3, 500)
    exact = (w0 + c / b) * np.exp(-b * data["t"] / m.inertia) - c / b
    near("coasting in closed form", data["w"], exact, 1e-9 * w0)
    fx = {"cogging": missing_cogging(rng, m, 0.05), "friction": (0.02 * m.torque, 0, 0)}
    iq = hold(m, fx, x, 1)
    rest = machine_torque(m, fx, x, to_abc(0 * x, iq, m.p * x)) - 0.02 * m.torque
    near("held shaft is in balance", rest, 0, 1e-9 * m.torque)
    # a delayed current at a steady speed is an angle: i_q turns into i_d by p w tau
    run = Run("x", 0, 1.0, 30.0, 300, 1.0, wobble=0.0)
    data = turn(m, {"delay": {"current": 1e-3}}, run)
    dd, qq = to_dq(np.stack([data[k] for k in ("ia", "ib", "ic")]), m.p * data["theta"])
    near("delay as an angle", qq, math.cos(m.p * 0.03), 1e-9)
    near("delay as an angle, d", dd, math.sin(m.p * 0.03), 1e-9)
    print("FAILED" if bad else "all equations agree")
    return 1 if bad else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--selftest", action="store_true")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("args", nargs="*")
    a = parser.parse_args()
    if a.selftest:
        return selftest()
    if a.list:
        for name in KINDS:
            print(name)
        return 0
    if len(a.args) != 3:
        parser.error("KIND SEED FOLDER")
    write_case(a.args[0], int(a.args[1]), a.args[2])
    return 0


if __name__ == "__main__":
    sys.exit(main())
