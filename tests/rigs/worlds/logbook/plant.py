"""Machines, benches and loggers of the recordings in world.py. Own equations in numpy, from the documented conventions alone.

    T_em  = mu(temp) sum_s (1 + g_s) e_s(theta) i_s (1 + M(theta_m)) + 3/2 p (Ld - Lq) id iq + iron + sum_c e_c i_s (a weak magnet)
    iron  = 3/2 E1 iq (sqrt((1 + f^2) / (1 + ((id + If)^2 + iq^2) / Is^2)) - 1),  f = If / Is: the co-energy of iron that saturates
            alike in all directions, W' = 3/2 L Is^2 sqrt(1 + |i + If|^2 / Is^2), If the magnet as a current
    shaft = T_em + T_cog(theta_m) - friction(omega) - J domega/dt
"""
import copy, csv, math, os

import numpy as np

TAU = 2 * np.pi


def to_abc(theta, d, q):
    """i_a = q sin theta - d cos theta, b and c a third of a turn later; rows a, b, c."""
    return np.array([q * np.sin(theta - s * TAU / 3) - d * np.cos(theta - s * TAU / 3) for s in range(3)])


def to_dq(theta, abc):
    """Amplitude-invariant Park of to_abc."""
    q = 2 / 3 * sum(abc[s] * np.sin(theta - s * TAU / 3) for s in range(3))
    d = -2 / 3 * sum(abc[s] * np.cos(theta - s * TAU / 3) for s in range(3))
    return d, q


class Machine:
    """A machine; declare() writes what of it the folder knows."""

    def __init__(self, p, slots, emf, cog, rated):
        self.p, self.slots, self.rated = p, slots, rated
        self.emf = dict(emf)                # electrical order: (N.m/A, rad)
        self.cog = dict(cog)                # order of the mechanical turn: (N.m, rad)
        self.gain = np.zeros(3)             # of the back-EMF of each phase
        self.ld = self.lq = 0.0             # H
        self.iron = None                    # (If, Is) in A
        self.alpha = 0.0                    # 1/K from 20 C
        self.wobble = []                    # (order of the mechanical turn, share, rad): of the back-EMF
        self.weak = 0.0                     # share of its strength that one magnet has lost
        self.friction = (0.0, 0.0, 0.0)     # Coulomb, viscous, quadratic
        self.inertia = None
        self.mech = {}                      # order of the mechanical turn: (N.m, rad), not of the machine itself
        self.triplen = None                 # (E3 N.m/A, R0 ohm, L0 H): a closed delta

    def e(self, theta):
        """Back-EMF of the three phases over the electrical angle, N.m/A."""
        out = np.zeros((3,) + np.shape(theta))
        for s in range(3):
            for n, (amplitude, phase) in self.emf.items():
                out[s] += amplitude * np.sin(n * (theta - s * TAU / 3) + phase)
        return out * (1 + self.gain.reshape((3,) + (1,) * np.ndim(theta)))

    def weak_coils(self, theta_m):
        """What the phases lose by one weak magnet, N.m/A: each coil on its tooth sees it once a turn."""
        return sum_of_coils(self.p, self.slots, theta_m, -self.weak, True) * self.emf[1][0]

    def torque(self, theta_m, abc, temp=20.0):
        """Air-gap torque without cogging, N.m."""
        theta = self.p * theta_m
        share = 1 + sum(m * np.cos(k * theta_m + f) for k, m, f in self.wobble)
        mutual = (self.e(theta) * abc).sum(0) * (1 + self.alpha * (temp - 20)) * share
        d, q = to_dq(theta, abc)
        mutual = mutual + 1.5 * self.p * (self.ld - self.lq) * d * q
        if self.iron:
            i_f, i_s = self.iron
            mutual = mutual + 1.5 * self.emf[1][0] * q * (
                np.sqrt((1 + (i_f / i_s) ** 2) / (1 + ((d + i_f) ** 2 + q ** 2) / i_s ** 2)) - 1)
        if self.weak:
            mutual = mutual + (self.weak_coils(theta_m) * abc).sum(0)
        return mutual

    def cogging(self, theta_m):
        total = np.zeros(np.shape(theta_m))
        for k, (amplitude, phase) in list(self.cog.items()) + list(self.mech.items()):
            total = total + amplitude * np.sin(k * theta_m + phase)
        return total

    def drag(self, omega):
        c, b, q = self.friction
        return c * np.sign(omega) + b * omega + q * omega * abs(omega)

    def circulating(self, theta, omega):
        """Torque of the current that an order 3 drives around a closed delta: 3 e3 i0, a brake with a ripple of order 6."""
        if not self.triplen:
            return 0 * theta
        e3, r, l = self.triplen
        w = 3 * self.p * omega
        return -3 * e3 ** 2 * omega / np.hypot(r, w * l) * np.sin(3 * theta) * np.sin(3 * theta - np.arctan2(w * l, r))

    def copy(self):
        return copy.deepcopy(self)


def sum_of_coils(p, slots, theta_m, change, lost):
    """Of single-tooth coils: with lost, the part of the phases' back-EMF that changes as magnet 0 changes by `change` (of 1);
    without, all of it. The fundamental of a sound rotor is 1. A magnet's wave is (1 + cos p u)/2 over its two pole pitches."""
    places = [TAU * c / slots for c in range(slots)]
    seat = [[(0, 1), (2, -1), (1, 1), (0, -1), (2, 1), (1, -1)][int(np.floor((p * x + np.pi / 6 + 1e-9) / (np.pi / 3))) % 6] for x in places]
    norm = sum(sign * np.exp(-1j * p * x) for x, (phase, sign) in zip(places, seat) if phase == 0)
    theta_m = np.asarray(theta_m, float) - np.angle(norm) / p       # phase a rises at 0
    out = np.zeros((3,) + theta_m.shape)
    for x, (phase, sign) in zip(places, seat):
        u = theta_m - x - np.pi / (2 * p)
        if lost:
            v = (u + np.pi) % TAU - np.pi
            wave = change * (np.where(abs(v) < np.pi / p, (1 + np.cos(p * v)) / 2, 0) - 1 / (2 * p))
        else:
            wave = np.cos(p * u)
        out[phase] += sign * wave
    return out / abs(norm)


# ------------------------------------------------------------------ folders and files
def write(path, names, columns, sep=",", dec=".", units=None, head=()):
    """A CSV; numbers of six to nine digits, empty where not finite."""
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", newline="\n") as f:
        for line in head:
            f.write(line + "\n")
        f.write(sep.join(names) + "\n")
        if units:
            f.write(sep.join(units) + "\n")
        for row in zip(*columns):
            cells = [v if isinstance(v, str) else "" if not np.isfinite(v) else "%.9g" % v for v in row]
            f.write(sep.join(c.replace(".", dec) if dec != "." and c[:1] in "-.0123456789" else c for c in cells) + "\n")


def write_machine(folder, m, extra=()):
    """The machine folder that declares everything of m but its iron, its weak magnet, its wobble and its closed delta."""
    os.makedirs(folder, exist_ok=True)
    rows = [("pole_pairs", m.p, "1"), ("slots", m.slots, "1"), ("rated_current", m.rated["i"], "A"),
            ("rated_torque", round(1.5 * m.emf[1][0] * m.rated["i"], 6), "Nm"), ("rated_speed", m.rated["rpm"], "rpm")]
    if m.inertia:
        rows.append(("inertia", m.inertia, "kgm2"))
    rows += list(extra)
    write(folder + "/machine.csv", ["name", "value", "unit"], list(zip(*[(a, "%.9g" % b, c) for a, b, c in rows])))
    write(folder + "/back_emf.csv", ["order", "amplitude_Nm_per_A", "phase_rad"],
          list(zip(*[(float(n), a, f) for n, (a, f) in sorted(m.emf.items())])))
    if m.cog:
        write(folder + "/cogging.csv", ["order", "amplitude_Nm", "phase_rad"],
              list(zip(*[(k / m.p, a, f) for k, (a, f) in sorted(m.cog.items())])))
    if m.ld != m.lq:
        t = np.arange(96) * TAU / 96
        a, b = (m.ld + m.lq) / 3, (m.ld - m.lq) / 3
        cols = [a + b * np.cos(2 * t - x) for x in (0, 2 * TAU / 3, 4 * TAU / 3)]
        cols += [-a / 2 + b * np.cos(2 * t - x) for x in (TAU / 3, 0, 2 * TAU / 3)]
        write(folder + "/inductance.csv", ["theta_e_rad", "La_H", "Lb_H", "Lc_H", "Mab_H", "Mbc_H", "Mca_H"], [t] + cols)
    effects = [("friction", n, v, u) for n, v, u in zip(("coulomb", "viscous", "quadratic"), m.friction,
                                                       ("Nm", "Nms_per_rad", "Nms2_per_rad2")) if v]
    if m.alpha:
        effects.append(("magnet_temperature", "emf_per_kelvin", m.alpha, "1/K"))
    if effects:
        write(folder + "/effects.csv", ["effect", "parameter", "value", "unit"], list(zip(*effects)))


# ------------------------------------------------------------------ a bench at (nearly) steady speed
class Sensors:
    """What the channels do to the truth; all zero is a perfect bench."""

    def __init__(self, m, rng):
        rated = 1.5 * m.emf[1][0] * m.rated["i"]
        self.gain, self.offset = np.zeros(3), np.zeros(3)
        self.current_late = 0.0         # s
        self.clip = None                # A
        self.current_noise = 0.001 * m.rated["i"]
        self.current_step = 0.0
        self.angle_offset = 0.0         # electrical rad
        self.angle_mech = []            # (order of the mechanical turn, mechanical rad, rad)
        self.angle_map = None           # electrical angle to its reading
        self.angle_step = TAU / 2 ** 16
        self.windup = 0.0               # mechanical rad per N.m between encoder and rotor
        self.lost = 0.0                 # share of the counts that is lost while turning
        self.torque_noise = 0.003 * rated
        self.torque_step = 0.0
        self.torque_gain, self.torque_offset = 0.0, 0.0
        self.torque_tau = 0.0           # s
        self.ripple = (0.004, rng.uniform(0, TAU))   # of the drive: share of i_q at order 6, measured like all else


def point(i_d=0.0, i_q=0.0, rpm=100.0, n=2400, turns=6, temp=20.0, role="fit", **more):
    return dict(i_d=i_d, i_q=i_q, rpm=rpm, n=n, turns=turns, temp=temp, role=role, **more)


def record(m, s, pt, rng):
    """Columns of one run: dict of arrays in SI."""
    w = pt["rpm"] * TAU / 60
    n = pt["n"]
    span = pt["turns"] * TAU / abs(w)
    t = np.arange(n) * span / n
    start = pt.get("start", rng.uniform(0, TAU))
    swing = pt.get("swing", [])             # (times a turn, rad, rad) of the shaft's angle
    follows = pt.get("follows", lambda time: 1.0)   # i_q over time, of the set point

    def shaft(time):
        a, v, acc = start + w * time, w + 0 * time, 0 * time
        for k, size, phase in swing:
            a = a + size * np.sin(k * w * time + phase)
            v = v + size * k * w * np.cos(k * w * time + phase)
            acc = acc - size * (k * w) ** 2 * np.sin(k * w * time + phase)
        return a, v, acc

    def currents(time):
        a = shaft(time)[0]
        th = m.p * a
        if "fixed" in pt:
            return np.array([x + 0 * time for x in pt["fixed"]])
        scale = follows(time)
        q = pt["i_q"] * scale * (1 + s.ripple[0] * np.sin(6 * th + s.ripple[1]))
        return to_abc(th, pt["i_d"] * scale + 0 * time, q)

    def torque(time):
        a, v, acc = shaft(time)
        temp = pt["magnet"](time) if "magnet" in pt else pt["temp"]
        out = m.torque(a, currents(time), temp) + m.cogging(a) - m.drag(v) + m.circulating(m.p * a, v)
        return out - pt.get("j", 0.0) * acc + pt.get("extra", lambda *_: 0.0)(time, a, v)

    if s.torque_tau:
        over = 16
        step = span / n / over
        lead = int(10 * s.torque_tau / step) + 1
        grid = (np.arange(n * over + lead) - lead) * step
        from scipy.signal import lfilter
        k = math.exp(-step / s.torque_tau)
        x = torque(grid)                    # exact for torque that is a straight line between the fine samples
        b1 = 1 - (1 - k) * s.torque_tau / step
        b0 = (1 - k) * s.torque_tau / step - k
        y, _ = lfilter([b1, b0], [1, -k], x, zi=np.array([x[0] - b1 * x[0]]))
        read = y[lead::over][:n]
    else:
        read = torque(t)
    read = (1 + s.torque_gain) * read + s.torque_offset + pt.get("zero", 0.0)
    read = read + s.torque_noise * rng.standard_normal(n)
    if s.torque_step:
        read = np.round(read / s.torque_step) * s.torque_step
    a, v, _ = shaft(t)
    abc = currents(t - s.current_late)
    abc = np.array([(1 + s.gain[i]) * abc[i] + s.offset[i] for i in range(3)]) + s.current_noise * rng.standard_normal((3, n))
    if s.current_step:
        abc = np.round(abc / s.current_step) * s.current_step
    if s.clip:
        abc = np.clip(abc, -s.clip, s.clip)
    angle = a + s.angle_offset / m.p + sum(size * np.sin(k * a + f) for k, size, f in s.angle_mech)
    if s.windup:
        angle = angle + s.windup * m.torque(a, currents(t), 20.0)
    if s.lost:
        angle = angle - s.lost * (a - a[0])
    if s.angle_map:
        angle = (s.angle_map(m.p * a % TAU) + TAU * np.floor(m.p * a / TAU)) / m.p
    if s.angle_step:
        angle = np.round(angle / s.angle_step) * s.angle_step
    d, q = to_dq(m.p * angle, abc)
    return dict(t=t, angle=angle, speed=v, a=abc[0], b=abc[1], c=abc[2], d=d, q=q, torque=read,
                temp=np.full(n, float(pt["temp"])), true_angle=a)


def run_free(m, J, current, seconds, dt, rng, start=0.0, speed=0.0, extra=None, every=1):
    """A free shaft: J domega/dt = T - friction + extra; current(t, angle, speed) gives (i_d, i_q), held over a step. Midpoint rule;
    at rest friction holds up to its Coulomb part. Rows t, angle, speed, i_d, i_q."""
    steps = int(seconds / dt)
    out = np.zeros((steps // every + 1, 5))
    x, v, c = start, speed, m.friction[0]
    e1 = 1.5 * m.emf[1][0]
    cog = [(k, a, f) for k, (a, f) in list(m.cog.items()) + list(m.mech.items())]
    six = [(n, a, f) for n, (a, f) in m.emf.items() if n > 1]

    def force(t, x, v, d, q):
        th = m.p * x
        T = e1 * q + 1.5 * m.p * (m.ld - m.lq) * d * q
        for n, a, f in six:                 # e_n with i_q alone: orders n - 1 or n + 1 by its sequence
            if n % 3 == 1:
                T += 1.5 * a * (q * math.cos((n - 1) * th + f) - d * math.sin((n - 1) * th + f))
            elif n % 3 == 2:
                T += -1.5 * a * (q * math.cos((n + 1) * th + f) + d * math.sin((n + 1) * th + f))
        for k, a, f in cog:
            T += a * math.sin(k * x + f)
        if extra:
            T += extra(t, x, v)
        return T

    for i in range(steps):
        t = i * dt
        d, q = current(t, x, v)
        if i % every == 0:
            out[i // every] = t, x, v, d, q
        T = force(t, x, v, d, q)
        if v == 0 and abs(T) <= c:
            continue
        sign = math.copysign(1.0, v if v else T)

        def acc(x, v, t):
            return (force(t, x, v, d, q) - sign * c - m.friction[1] * v - m.friction[2] * v * abs(v)) / J
        xm, vm = x + dt / 2 * v, v + dt / 2 * acc(x, v, t)
        a2 = acc(xm, vm, t + dt / 2)
        x, v2 = x + dt * vm, v + dt * a2
        v = 0.0 if v2 * v < 0 and abs(T) <= c else v2
    return out[:(steps - 1) // every + 1].T
