"""A permanent-magnet machine with what real ones have beyond their tables, and what people record of it.

    flux   psi_d = s (psi + L_d i_d), psi_q = s L_q i_q        s = (1 + (|i|/I_s)^4)^(-1/4): the iron yields
    v_d = R i_d - w psi_q,  v_q = R i_q + w psi_d              and the back-EMF's harmonics, phase by phase
    T = 3/2 p (psi_d i_q - psi_q i_d) + sum of e_n i + cogging - friction - iron - J dw/dt

i_a = i_q sin(theta) - i_d cos(theta), b and c a third of a turn later; k_e = p psi. Nothing here is the program's.
"""

import math

TURN = 2 * math.pi
THIRD = [0.0, TURN / 3, 2 * TURN / 3]


class Machine:
    def __init__(self, rng, **wish):
        kind = wish.pop("kind", None) or rng.choice(["gimbal", "drone", "servo"])
        pick = {"gimbal": dict(layouts=[(12, 7), (24, 11), (12, 5), (36, 21)], k_e=(0.04, 0.4), I=(0.4, 3), speed=(15, 60), copper=0.4, reactance=0.1),
                "drone": dict(layouts=[(12, 7), (18, 12), (24, 14), (9, 6), (24, 20)], k_e=(0.004, 0.04), I=(8, 60), speed=(200, 900), copper=0.12, reactance=0.2),
                "servo": dict(layouts=[(24, 2), (18, 3), (12, 4), (12, 5), (9, 4)], k_e=(0.1, 1.0), I=(2, 30), speed=(80, 350), copper=0.07, reactance=0.25),
                "ipm": dict(layouts=[(36, 3), (48, 4), (24, 2), (72, 6)], k_e=(0.15, 1.2), I=(5, 250), speed=(100, 350), copper=0.05, reactance=0.5)}[kind]
        self.kind = kind
        self.slots, self.p = wish.pop("layout", None) or rng.choice(pick["layouts"])
        log = lambda low, high: math.exp(rng.uniform(math.log(low), math.log(high)))
        self.k_e, self.I, self.speed = log(*pick["k_e"]), log(*pick["I"]), log(*pick["speed"])
        self.torque = 1.5 * self.k_e * self.I
        omega = self.p * self.speed
        self.R = pick["copper"] * rng.uniform(0.7, 1.4) * self.k_e * self.speed / self.I
        x = pick["reactance"] * rng.uniform(0.7, 1.4) * self.k_e * self.speed / self.I / omega
        saliency = wish.pop("saliency", rng.uniform(1.8, 3.5) if kind == "ipm" else 1.0)
        self.L_d, self.L_q = x / math.sqrt(saliency), x * math.sqrt(saliency)
        self.harmonics = [(5, rng.uniform(0, 0.04), rng.uniform(0, TURN)), (7, rng.uniform(0, 0.02), rng.uniform(0, TURN))]
        first = math.lcm(self.slots, 2 * self.p)
        cogging = wish.pop("cogging", rng.uniform(0.02, 0.08)) * self.torque
        self.cogging = [(first, cogging, rng.uniform(-3, 3)), (2 * first, 0.3 * cogging, rng.uniform(-3, 3))]
        uneven = wish.pop("uneven", 0.0) * cogging  # magnets unlike: orders of the slots; teeth unlike: of the poles
        if uneven:
            self.cogging += [(self.slots, uneven, rng.uniform(-3, 3)), (2 * self.slots, 0.5 * uneven, rng.uniform(-3, 3)),
                             (2 * self.p, 0.7 * uneven, rng.uniform(-3, 3))]
        self.coulomb = wish.pop("coulomb", 0.01) * self.torque
        self.viscous = wish.pop("viscous", 0.01) * self.torque / self.speed
        self.iron = wish.pop("iron", 0.0) * self.torque  # drag that grows with the square root of the speed
        self.magnets, self.copper = wish.pop("magnets", rng.uniform(0.98, 1.02)), wish.pop("copper", rng.uniform(0.98, 1.1))
        self.I_s = wish.pop("saturates_at", 1e9) * self.I
        self.phase_gain = wish.pop("phase_gain", [1.0, 1.0, 1.0])
        self.third = wish.pop("third", 0.0)  # order 3 of the back-EMF
        if wish:
            raise ValueError("unknown wish: %s" % sorted(wish))

    def yields(self, d, q):
        return (1 + (math.hypot(d, q) / self.I_s) ** 4) ** -0.25

    def mean_torque(self, d, q):
        return 1.5 * self.yields(d, q) * (self.magnets * self.k_e * q + self.p * (self.L_d - self.L_q) * d * q)

    def best(self, amplitude):
        """i_d, i_q of an amplitude with most torque."""
        angle = max((k * 0.02 for k in range(60)), key=lambda a: self.mean_torque(-amplitude * math.sin(a), amplitude * math.cos(a)))
        return -amplitude * math.sin(angle), amplitude * math.cos(angle)

    def emf_ripple(self, theta, s):
        waves = self.harmonics + ([(3, self.third, 0.3)] if self.third else [])
        return self.magnets * self.k_e * sum(a * math.sin(n * (theta - THIRD[s]) + g) for n, a, g in waves)

    def cogging_torque(self, theta_m):
        return sum(a * math.sin(n * theta_m + g) for n, a, g in self.cogging)

    def drag(self, w):
        sign = (w > 0) - (w < 0)
        return sign * (self.coulomb + self.iron * math.sqrt(abs(w) / self.speed)) + self.viscous * w

    def voltages_dq(self, w, d, q):
        s, omega, R = self.yields(d, q), self.p * w, self.copper * self.R
        return R * d - omega * s * self.L_q * q, R * q + omega * s * (self.magnets * self.k_e / self.p + self.L_d * d)

    def at(self, t, theta_m, w, d, q, alpha=0.0, inertia=0.0):
        """A sample: all that could be recorded, as it is."""
        theta = self.p * theta_m
        i = [q * math.sin(theta - a) - d * math.cos(theta - a) for a in THIRD]
        v_d, v_q = self.voltages_dq(w, d, q)
        ripple = [self.emf_ripple(theta, s) for s in range(3)]
        weak = [(self.phase_gain[s] - 1) * self.magnets * self.k_e * math.sin(theta - THIRD[s]) for s in range(3)]
        v = [v_q * math.sin(theta - THIRD[s]) - v_d * math.cos(theta - THIRD[s]) + w * (ripple[s] + weak[s]) for s in range(3)]
        air_gap = self.mean_torque(d, q) + sum(i[s] * (ripple[s] + weak[s]) for s in range(3)) + self.cogging_torque(theta_m)
        return dict(t=t, theta_m=theta_m, theta_e=theta, w=w, d=d, q=q, i=i, v=v, v_d=v_d, v_q=v_q,
                    torque=air_gap - self.drag(w) - inertia * alpha)

    def folder(self, **shows):
        """What the engineer has typed: {file: columns}. inductances, slots, cogging, ratings: True or False."""
        rows = [("pole_pairs", self.p, "1"), ("resistance", self.R, "ohm")]
        if shows.get("slots", True):
            rows.append(("slots", self.slots, "1"))
        if shows.get("inductances", True):
            rows += [("inductance_d", self.L_d, "H"), ("inductance_q", self.L_q, "H")]
        if shows.get("ratings", True):
            rows += [("rated_current", self.I, "A"), ("rated_torque", shows.get("rated", 0.97) * self.torque, "Nm"), ("rated_speed", self.speed, "rad_per_s"),
                     ("dc_link_voltage", 1.6 * math.sqrt(3) * self.k_e * self.speed, "V")]
        if shows.get("friction", False):
            rows += [("coulomb_friction", self.coulomb, "Nm"), ("viscous_friction", self.viscous, "Nms_per_rad")]
        files = {"machine/machine.csv": {"name": [r[0] for r in rows], "value": [r[1] for r in rows], "unit": [r[2] for r in rows]},
                 "machine/back_emf.csv": {"order": [1] + [n for n, _, _ in self.harmonics], "amplitude_Nm_per_A": [self.k_e] + [a * self.k_e for _, a, _ in self.harmonics],
                                          "phase_rad": [0.0] + [g for _, _, g in self.harmonics]}}
        if shows.get("cogging", True):
            files["machine/cogging.csv"] = {"order": [n / self.p for n, _, _ in self.cogging], "amplitude_Nm": [a for _, a, _ in self.cogging],
                                            "phase_rad": [g for _, _, g in self.cogging]}
        return files


# Runs: lists of samples.

def steady(m, w, d, q, turns=3.0, per_period=40, start=0.4, swing=0.004):
    """Constant speed with a little ripple."""
    count = max(300, int(per_period * m.p * turns))
    step = turns * TURN / abs(w) / count
    samples = []
    for k in range(count):
        t = k * step
        samples.append(m.at(t, start + w * t + swing * math.sin(w * t), w * (1 + swing * math.cos(w * t)), d, q))
    return samples


def there_and_back(m, w, d, q, turns=2.0, per_period=40, brake=1.0, reverse=None):
    """Forward at w, then backward: the shaft is where it began, and the mean speed is 0. i_q changes its sign with the load."""
    count, reverse = max(300, int(per_period * m.p * turns)), brake if reverse is None else reverse
    step = turns * TURN / abs(w) / count
    out = [m.at(k * step, 0.2 + w * k * step, w, d, q) for k in range(count)]
    last = out[-1]
    return out + [m.at(last["t"] + (k + 1) * step, last["theta_m"] - w * (k + 1) * step, -w, d, -reverse * q) for k in range(count)]


def slow(m, rng, rpm=6.0, turns=1.0, per_turn=3000):
    """Held or turned slowly by its own current, forward and back: 3/2 k_e i_q + cogging = friction."""
    w, count, samples = rpm * TURN / 60, int(per_turn * turns), []
    for direction in (1, -1):
        for k in range(count):
            at = k if direction > 0 else count - 1 - k
            theta_m = turns * TURN * at / count + 0.1
            q = (direction * m.coulomb - m.cogging_torque(theta_m)) / (1.5 * m.magnets * m.k_e) + rng.gauss(0, 0.002 * m.I)
            samples.append(m.at((k + (count if direction < 0 else 0)) * turns * TURN / w / count, theta_m, direction * w, 0.0, q))
            samples[-1]["torque"] = 0.0
    return samples


def plateaus(m, points, each=40, step_s=None, start=0.4):
    """A log at (speed, i_d, i_q): few samples each, at a steady clock."""
    samples, theta_m, t = [], start, 0.0
    for w, d, q in points:
        h = step_s or 5.3 * TURN / (m.p * max(abs(w), 1e-3)) / each
        for _ in range(each):
            samples.append(m.at(t, theta_m, w, d, q))
            t, theta_m = t + h, theta_m + w * h
    return samples


def free_shaft(m, inertia, drive, seconds, step_s, start_w=0.0):
    """The shaft is free: J dw/dt = T - drag; drive(t, w) gives i_q."""
    samples, theta_m, w, t = [], 0.1, start_w, 0.0
    while t < seconds:
        q = drive(t, w)
        x = m.at(t, theta_m, w, 0.0, q)
        samples.append(x)
        for _ in range(4):
            x = m.at(t, theta_m, w, 0.0, q)
            w += x["torque"] / inertia * step_s / 4
            theta_m += w * step_s / 4
        t += step_s
    return samples


# Columns.

class Columns:
    """Writes the columns that are asked for, each through its sensor."""

    def __init__(self, rng, m):
        self.rng, self.m = rng, m
        self.gain = {x: 1 + rng.uniform(-0.015, 0.015) for x in ("i", "v", "torque")}
        self.zero = rng.uniform(-0.03, 0.03)  # of the encoder, electrical
        self.torque_zero = 0.0

    def noisy(self, values, size):
        return [x + self.rng.gauss(0, size) for x in values]

    def write(self, samples, names):
        m, table, get = self.m, {}, lambda key: [x[key] for x in samples]
        for name in names.split():
            if name == "time_s":
                table[name] = get("t")
            elif name.startswith("theta"):
                table.update(self.angle(samples, name))
            elif name in ("speed_rad_per_s", "speed_rpm", "speed_e_rad_per_s"):
                scale = {"speed_rpm": 60 / TURN, "speed_e_rad_per_s": m.p}.get(name, 1.0)
                table[name] = [scale * x for x in self.noisy(get("w"), 0.002 * m.speed)]
            elif name == "abc":
                for s in range(3):
                    table["i%s_A" % "abc"[s]] = self.noisy([self.gain["i"] * x["i"][s] for x in samples], 0.003 * m.I)
            elif name == "vabc":
                for s in range(3):
                    table["v%s_V" % "abc"[s]] = self.noisy([self.gain["v"] * x["v"][s] for x in samples], 0.002 * m.k_e * m.speed)
            elif name in ("id_A", "iq_A"):
                table[name] = self.noisy([self.gain["i"] * x[name[1]] for x in samples], 0.003 * m.I)
            elif name in ("vd_V", "vq_V"):
                table[name] = self.noisy([x["v_" + name[1]] for x in samples], 0.004 * m.k_e * m.speed)
            elif name == "torque_Nm":
                table[name] = [self.gain["torque"] * x + self.torque_zero for x in self.noisy(get("torque"), 0.003 * m.torque)]
            elif name == "held_Nm":
                table["torque_Nm"] = [0.0] * len(samples)
            else:
                raise ValueError(name)
        return table

    def angle(self, samples, name):
        """theta_m, theta_e; with _wrapped, _deg."""
        electrical, p = "theta_e" in name, self.m.p
        x = [(y["theta_m"] + self.zero / p) * (p if electrical else 1) for y in samples]
        count = TURN / 16384 * (p if electrical else 1)
        x = [count * round(y / count) for y in x]
        if "wrapped" in name:
            x = [y % TURN for y in x]
        column = "theta_e" if electrical else "theta_m"
        return {column + "_deg": [math.degrees(y) for y in x]} if "deg" in name else {column + "_rad": x}


def text(table):
    rows = zip(*table.values())
    return "\n".join([",".join(table)] + [",".join(x if isinstance(x, str) else "%.7g" % x for x in row) for row in rows]) + "\n"
