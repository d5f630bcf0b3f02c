"""Correct permanent-magnet motors, drawn by seed: what only their maker knows, and the folder that an engineer would type.

Angles are electrical unless the name says otherwise. e_s(theta) is the back-EMF of phase s by mechanical speed, in V*s/rad = N*m/A.
"""

import math

TURN = 2 * math.pi
PHASE = (0.0, TURN / 3, 2 * TURN / 3)

# layouts: (slots, pole pairs). k_e in V*s/rad, peak of the line-to-line back-EMF at rated speed in V, peak current in A,
# copper loss at the rating as a share of the mechanical power, reactance at rated current by back-EMF.
KINDS = {
    "gimbal": dict(layouts=[(12, 7), (24, 11), (12, 5), (36, 21)], k_e=(0.03, 0.4), line_V=(4, 20), current_A=(0.3, 3),
                   copper=(0.2, 1.0), reactance=(0.02, 0.2), saliency=["none"]),
    "drone": dict(layouts=[(12, 7), (9, 6), (18, 12), (24, 14), (36, 20), (36, 21), (24, 20), (12, 4)], k_e=(0.003, 0.05),
                  line_V=(8, 40), current_A=(10, 90), copper=(0.05, 0.25), reactance=(0.05, 0.3), saliency=["none"]),
    "servo": dict(layouts=[(6, 1), (24, 1), (6, 2), (24, 2), (9, 3), (18, 3), (27, 3), (12, 4), (9, 4), (12, 5)], k_e=(0.08, 1.2),
                  line_V=(40, 350), current_A=(2, 30), copper=(0.03, 0.15), reactance=(0.1, 0.5), saliency=["none", "none", "interior"]),
    "traction": dict(layouts=[(36, 3), (54, 3), (48, 4), (72, 6), (24, 2)], k_e=(0.1, 0.6), line_V=(120, 450), current_A=(100, 600),
                     copper=(0.02, 0.08), reactance=(0.4, 0.8), saliency=["interior", "interior", "high"]),
    "direct": dict(layouts=[(24, 10), (36, 15), (45, 20), (63, 21), (48, 20), (36, 16)], k_e=(1.5, 20), line_V=(40, 350),
                   current_A=(3, 40), copper=(0.1, 0.4), reactance=(0.2, 0.7), saliency=["none", "interior"]),
}


class Table:
    """A CSV file: named columns of numbers or words, and remarks above."""

    def __init__(self, columns, remark=""):
        self.columns = columns
        self.remark = remark

    def __getitem__(self, name):
        return self.columns[name]

    def __setitem__(self, name, values):
        self.columns[name] = values

    def __contains__(self, name):
        return name in self.columns

    def text(self, separator=","):
        """With a semicolon the decimal comma, as a spreadsheet writes it."""
        rows = zip(*self.columns.values())
        lines = ["# " + self.remark] if self.remark else []
        lines.append(separator.join(self.columns))
        lines += [separator.join(x if isinstance(x, str) else "%.7g" % x for x in row).replace(".", "," if separator == ";" else ".") for row in rows]
        return "\n".join(lines) + "\n"

    def value(self, name):
        """The number beside a name of machine.csv."""
        return float(self["value"][self["name"].index(name)])

    def set_value(self, name, value):
        self["value"][self["name"].index(name)] = "%.7g" % value

    def has(self, name):
        return name in self["name"]


def log_uniform(rng, low, high):
    return math.exp(rng.uniform(math.log(low), math.log(high)))


def wrap(angle):
    """To [-pi, pi)."""
    return (angle + math.pi) % TURN - math.pi


class Motor:
    """The true motor. draw() makes one that honours the wishes; the bench asks for emf, inductance, torque; folder() writes it down."""

    def __init__(self):
        self.emf = []         # (order, amplitude in N*m/A, phase)
        self.cogging = []     # (order, amplitude in N*m, phase)
        self.magnet_scale = 1.0      # the true back-EMF by that of the table: tolerance and temperature
        self.resistance_scale = 1.0  # the same of the resistance
        self.inductance_6 = 0.0  # of L_d and, with the other sign, of L_q, in H: cos(6 theta)
        self.inductance_0 = 0.0  # of the zero sequence, in H

    # Physics.

    def emf_Nm_per_A(self, theta):
        return [self.magnet_scale * sum(E * math.sin(mu * (theta - s) + phase) for mu, E, phase in self.emf) for s in PHASE]

    def cogging_Nm(self, theta):
        return sum(A * math.sin(n * theta + phase) for n, A, phase in self.cogging)

    def axes(self, theta):
        """d and q axis as phase vectors of square 3/2: i = i_d d + i_q q."""
        return [-math.cos(theta - s) for s in PHASE], [math.sin(theta - s) for s in PHASE]

    def inductances_dq(self, theta):
        """L_d, L_q and their slopes by the electrical angle."""
        c, s = self.inductance_6 * math.cos(6 * theta), -6 * self.inductance_6 * math.sin(6 * theta)
        return self.L_d + c, self.L_q - c, s, -s

    def times_inductance(self, theta, x):
        """L x, in Wb for currents."""
        d, q = self.axes(theta)
        L_d, L_q, _, _ = self.inductances_dq(theta)
        x_d, x_q, x_0 = 2 / 3 * dot(d, x), 2 / 3 * dot(q, x), sum(x) / 3
        return [L_d * x_d * d[k] + L_q * x_q * q[k] + self.inductance_0 * x_0 for k in range(3)]

    def times_inductance_slope(self, theta, x):
        """L' x with L' by the mechanical angle, in Wb/rad for currents."""
        d, q = self.axes(theta)
        L_d, L_q, slope_d, slope_q = self.inductances_dq(theta)
        x_d, x_q, p = 2 / 3 * dot(d, x), 2 / 3 * dot(q, x), self.pole_pairs
        return [p * ((L_d - L_q) * (x_d * q[k] + x_q * d[k]) + slope_d * x_d * d[k] + slope_q * x_q * q[k]) for k in range(3)]

    def torque_Nm(self, theta, i):
        """Air-gap torque."""
        return dot(self.emf_Nm_per_A(theta), i) + 0.5 * dot(i, self.times_inductance_slope(theta, i)) + self.cogging_Nm(theta)

    def friction_Nm(self, omega_m):
        return math.copysign(self.coulomb_Nm, omega_m) + self.viscous * omega_m

    # Ratings.

    @property
    def k_e(self):
        return self.emf[0][1]

    @property
    def slot_order(self):
        """The first electrical order of the cogging torque."""
        return math.lcm(self.slots, 2 * self.pole_pairs) // self.pole_pairs

    @property
    def crookedness(self):
        """The smallest over the tables of the largest phase, in degrees."""
        return min(max(abs(math.degrees(row[2])) for row in rows) for rows in (self.emf, self.cogging))

    def current_dq(self, amplitude_A):
        """The (i_d, i_q) of an amplitude that makes most torque."""
        def mean_torque(angle):
            d, q = -amplitude_A * math.sin(angle), amplitude_A * math.cos(angle)
            return 1.5 * (self.k_e * q + self.pole_pairs * (self.L_d - self.L_q) * d * q)
        angle = max((k * 0.01 for k in range(120)), key=mean_torque)
        return -amplitude_A * math.sin(angle), amplitude_A * math.cos(angle), mean_torque(angle)

    def rated_voltage_share(self):
        """Voltage at rated speed and current by the back-EMF: the dc link has to carry it."""
        i_d, i_q, _ = self.current_dq(self.rated_current_A)
        omega_m = self.rated_speed_rpm * TURN / 60
        omega, flux_Wb = self.pole_pairs * omega_m, self.k_e / self.pole_pairs
        v_d, v_q = self.resistance * i_d - omega * self.L_q * i_q, self.resistance * i_q + omega * (flux_Wb + self.L_d * i_d)
        return math.hypot(v_d, v_q) / (self.k_e * omega_m)

    # The folder.

    def folder(self):
        files = {"machine/machine.csv": self.machine_table(), "machine/back_emf.csv": self.emf_table()}
        if self.shows_cogging:
            files["machine/cogging.csv"] = Table({"order": [c[0] for c in self.cogging], "amplitude_Nm": [c[1] for c in self.cogging],
                                                  "phase_rad": [c[2] for c in self.cogging]}, "cogging torque")
        if self.inductance_form:
            files["machine/inductance.csv"] = self.inductance_table(self.inductance_form)
        return files

    def machine_table(self):
        rows = [("pole_pairs", self.pole_pairs, "1", "data sheet"), ("connection", "star", "", "")]
        if self.shows_slots:
            rows.append(("slots", self.slots, "1", "teeth counted"))
        if self.emf_in_volts:
            rows.append(("emf_frequency", self.emf_frequency_Hz, "Hz", "at which back_emf.csv was taken"))
        if self.shows_resistance:
            rows.append(("resistance", self.resistance, "ohm", "measured"))
        if self.shows_inductance:
            rows += [("inductance_d", self.L_d, "H", ""), ("inductance_q", self.L_q, "H", "")]
        if self.shows_ratings:
            rows += [("rated_current", self.rated_current_A, "A", "data sheet"), ("rated_torque", self.rated_torque_Nm, "Nm", "data sheet"),
                     ("rated_speed", self.rated_speed_rpm, "rpm", "data sheet")]
        if self.shows_dc_link:
            rows.append(("dc_link_voltage", self.dc_link_V, "V", ""))
        rows = [(name, value if isinstance(value, str) else "%.5g" % value, unit, source) for name, value, unit, source in rows]
        return Table(dict(zip(("name", "value", "unit", "source"), map(list, zip(*rows)))), "a %s motor" % self.kind)

    def emf_table(self):
        """Peak of a phase; in volts at emf_frequency, or by mechanical speed."""
        scale = TURN * self.emf_frequency_Hz / self.pole_pairs if self.emf_in_volts else 1.0
        name = "amplitude_V" if self.emf_in_volts else "amplitude_Nm_per_A"
        orders, amplitudes, phases = zip(*self.emf)
        return Table({"order": list(orders), name: [scale * E for E in amplitudes], "phase_rad": list(phases)}, "phase peak, line to star point")

    def inductance_table(self, form):
        """La ... Mca over one period, or their slopes by the mechanical angle."""
        product = self.times_inductance if form == "value" else self.times_inductance_slope
        names = "La_H Lb_H Lc_H Mab_H Mbc_H Mca_H".split()
        if form == "slope":
            names = ["d" + name + "_per_rad" for name in names]
        angles = [TURN * k / 90 for k in range(90)]
        columns = {"theta_e_rad": angles, **{name: [] for name in names}}
        for theta in angles:
            L = [product(theta, unit) for unit in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
            for name, x in zip(names, (L[0][0], L[1][1], L[2][2], L[1][0], L[2][1], L[0][2])):
                columns[name].append(x)
        return Table(columns, "inductances of the phases")


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def draw(rng, wish):
    """A motor for which every wish holds: wish maps an attribute of Motor to a value or to a condition on the value."""
    for _ in range(5000):
        motor = draw_any(rng, wish.get("kind"), wish.get("saliency"))
        if all(w(getattr(motor, name)) if callable(w) else getattr(motor, name) == w for name, w in wish.items() if name not in ("kind", "saliency")):
            return motor
    raise ValueError("no motor fulfils " + str(wish))


def draw_any(rng, kind=None, saliency=None):
    motor = Motor()
    motor.kind = kind or rng.choice(sorted(KINDS))
    if saliency in ("interior", "high") and not kind:
        motor.kind = rng.choice(["traction", "direct"])
    k = KINDS[motor.kind]
    motor.slots, motor.pole_pairs = rng.choice(k["layouts"])
    motor.saliency = saliency or rng.choice(k["saliency"])
    draw_magnets(motor, rng, log_uniform(rng, *k["k_e"]))
    draw_windings(motor, rng, k)
    draw_ratings(motor, rng)
    draw_cogging(motor, rng)
    draw_form(motor, rng)
    return motor


def draw_magnets(motor, rng, k_e):
    shape = rng.choice(["sine"] * 4 + ["measured"] * 4 + ["trapeze"] * 2 + ["crooked"])
    typical = {"sine": 0.004, "measured": 0.03, "trapeze": 0.08, "crooked": 0.2}[shape]
    orders = [5, 7, 11, 13][: rng.choice([2, 2, 3, 4])] if rng.random() < 0.9 else []
    if rng.random() < 0.35 or shape == "trapeze":
        orders = [3] + orders
    motor.first_phase = rng.choice([0.0] * 7 + [0.05, -0.04, 0.02])
    motor.emf = [(1, round_to(k_e, 4), motor.first_phase)]
    for order in orders:
        share = typical * rng.uniform(0.3, 1.5) * ((5 / order) ** 0.7 if shape != "crooked" else 1.0)
        scatter = rng.choice([0.0, 0.0, rng.gauss(0, 0.05), rng.gauss(0, 0.8)]) if shape != "trapeze" else 0.0
        upside_down = rng.random() < 0.5
        if upside_down and rng.random() < 0.3:
            motor.emf.append((order, -round_to(share * k_e, 4), scatter))
        else:
            motor.emf.append((order, round_to(share * k_e, 4), wrap(scatter + math.pi * upside_down)))


def draw_windings(motor, rng, k):
    motor.rated_current_A = round_to(log_uniform(rng, *k["current_A"]), 2)
    flux_Wb = motor.k_e / motor.pole_pairs
    ratio = {"none": 1.0, "interior": rng.uniform(1.3, 2.5), "high": rng.uniform(2.8, 4.5)}[motor.saliency]
    reactance_q = rng.uniform(*k["reactance"]) * {"none": 1.0, "interior": 1.5, "high": 2.0}[motor.saliency]
    motor.L_q = round_to(reactance_q * flux_Wb / motor.rated_current_A, 3)
    motor.L_d = round_to(motor.L_q / ratio, 3)
    motor.inductance_0 = rng.uniform(0.1, 0.5) * motor.L_d
    omega_m = min(rng.uniform(*k["line_V"]) / (math.sqrt(3) * motor.k_e), TURN * 2000 / motor.pole_pairs)
    motor.rated_speed_rpm = round_to(omega_m * 60 / TURN, 2)
    motor.copper_share = rng.uniform(*k["copper"])


def draw_ratings(motor, rng):
    omega_m = motor.rated_speed_rpm * TURN / 60
    motor.ideal_torque_Nm = motor.current_dq(motor.rated_current_A)[2]
    motor.rating_ratio = rng.uniform(0.85, 1.1)
    motor.rated_torque_Nm = round_to(motor.rating_ratio * motor.ideal_torque_Nm, 3)
    motor.resistance = round_to(motor.copper_share * motor.ideal_torque_Nm * omega_m / (1.5 * motor.rated_current_A ** 2), 3)
    motor.dc_link_ratio = max(rng.uniform(1.1, 2.5), rng.uniform(1.02, 1.2) * motor.rated_voltage_share())
    motor.dc_link_V = round_to(motor.dc_link_ratio * math.sqrt(3) * motor.k_e * omega_m, 3)
    motor.magnet_scale, motor.resistance_scale = rng.uniform(0.97, 1.03), rng.uniform(0.97, 1.15)
    motor.coulomb_Nm = rng.uniform(0.002, 0.02) * motor.ideal_torque_Nm
    motor.viscous = rng.uniform(0.002, 0.015) * motor.ideal_torque_Nm / omega_m


def draw_cogging(motor, rng):
    """Multiples of the slot order; a few motors also have what uneven magnets or teeth add."""
    multiples = [1, 2, 3][: 3 if motor.slot_order <= 12 else 2]
    first = rng.uniform(0.005, 0.04) * motor.ideal_torque_Nm
    motor.cogging = [(motor.slot_order * m, round_to(first * rng.uniform(0.2, 1.0) / m, 3), any_phase(rng)) for m in multiples]
    order = rng.choice([2, round_to(motor.slots / motor.pole_pairs, 7)])
    motor.uneven = rng.random() < 0.06 and order < motor.slot_order
    if motor.uneven:
        motor.cogging.insert(0, (order, round_to(0.3 * first, 3), any_phase(rng)))


def any_phase(rng):
    return round(rng.uniform(-math.pi, math.pi), 3)


def draw_form(motor, rng):
    """What the engineer happened to write down."""
    # Without L_d and L_q nothing tells of reluctance torque, and the torque of such a motor could not be checked.
    bare = motor.saliency == "none" and rng.random() < 0.1
    motor.emf_in_volts = rng.random() < 0.5
    rated_Hz = motor.pole_pairs * motor.rated_speed_rpm / 60
    motor.emf_frequency_Hz = rng.choice([50, round_to(rated_Hz, 3), round_to(motor.pole_pairs * 1000 / 60, 5)])
    motor.shows_slots = not bare and rng.random() < 0.5
    motor.shows_cogging = not bare and rng.random() < 0.7
    motor.shows_ratings = not bare and rng.random() < 0.85
    motor.shows_dc_link = not bare and rng.random() < 0.7
    motor.shows_resistance = not bare and rng.random() < 0.8
    motor.shows_inductance = not bare and (motor.saliency != "none" or rng.random() < 0.6)
    motor.inductance_form = rng.choice([None, "value", "value", "slope"]) if motor.saliency != "none" else None
    if motor.inductance_form:
        motor.inductance_6 = rng.choice([0.0, rng.uniform(0.005, 0.03)]) * motor.L_d


def round_to(x, digits):
    return float("%.*g" % (digits, x))
