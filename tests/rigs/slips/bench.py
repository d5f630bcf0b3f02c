"""Recordings of a motor on a bench, in the time domain: v = R i + d(lambda)/dt, T = e.i + 1/2 i'L'i + cogging - friction.

The shaft turns at a prescribed speed with a little ripple and the currents are prescribed in the true rotor frame, so that every
quantity is an analytic function of time. What is written down has passed through sensors with errors of their own.
"""

import math

from motor import PHASE, TURN, Table

VOLTAGES = ("va_V", "vb_V", "vc_V")
CURRENTS = ("ia_A", "ib_A", "ic_A")
CURRENTS_DQ = ("id_A", "iq_A")


class Shaft:
    """A speed that rises or falls along a line (by ramp a second, of itself), with a ripple of at most one per cent."""

    def __init__(self, rng, omega_m, ramp=0.0):
        self.omega_m, self.ramp = omega_m, ramp
        self.start, self.order, self.phase = rng.uniform(0, TURN), rng.choice([1, 2]), rng.uniform(0, TURN)
        self.swing = rng.uniform(0, 0.01) / self.order

    def at(self, t):
        angle = self.order * self.omega_m * t + self.phase
        theta_m = self.start + self.omega_m * t * (1 + self.ramp * t / 2) + self.swing * math.sin(angle)
        return theta_m, self.omega_m * (1 + self.ramp * t + self.swing * self.order * math.cos(angle))


class Currents:
    """i_d and i_q held by a drive, with what its controller lets through of orders 5 and 7."""

    def __init__(self, rng, i_d, i_q):
        level = math.hypot(i_d, i_q)
        self.waves = [(1, i_q, 0.0), (1, -i_d, math.pi / 2)]
        self.waves += [(n, level * rng.uniform(0, 0.02), rng.uniform(0, TURN)) for n in (5, 7)] if level else []

    def at(self, theta):
        """i and di/dtheta of the three phases. Order 5 has the negative sequence by itself."""
        i = [sum(A * math.sin(n * (theta - s) + g) for n, A, g in self.waves) for s in PHASE]
        return i, [sum(n * A * math.cos(n * (theta - s) + g) for n, A, g in self.waves) for s in PHASE]


def truth_at(motor, shaft, currents, t):
    """(theta_m, omega_m, i, v, shaft torque) at a time, without any error of a sensor."""
    theta_m, omega_m = shaft.at(t)
    theta = motor.pole_pairs * theta_m
    i, slope = currents.at(theta)
    i_dot = [motor.pole_pairs * omega_m * x for x in slope]
    e, L_i_dot, L_slope_i = motor.emf_Nm_per_A(theta), motor.times_inductance(theta, i_dot), motor.times_inductance_slope(theta, i)
    R = motor.resistance_scale * motor.resistance
    v = [R * i[k] + L_i_dot[k] + omega_m * (L_slope_i[k] + e[k]) for k in range(3)]
    torque = motor.torque_Nm(theta, i) - motor.friction_Nm(omega_m)
    return theta_m, omega_m, i, v, torque


class Sensors:
    """Errors that stay the same over all runs of a motor."""

    def __init__(self, rng, motor):
        self.gain = {name: 1 + rng.uniform(-0.02, 0.02) for name in VOLTAGES + CURRENTS + ("torque",)}
        common = rng.uniform(-0.015, 0.015)
        for name in CURRENTS:
            self.gain[name] = 1 + common + rng.uniform(-0.005, 0.005)
        self.offset_A = [rng.uniform(-0.01, 0.01) * motor.rated_current_A for _ in range(3)]
        self.offset_theta = rng.uniform(-0.05, 0.05)  # electrical
        self.offset_Nm = rng.uniform(-0.002, 0.002) * motor.ideal_torque_Nm
        self.speed_gain = 1 + rng.uniform(-0.005, 0.005)
        self.noise_A = 0.002 * motor.rated_current_A
        self.noise_Nm = 0.003 * motor.ideal_torque_Nm
        self.counts = rng.choice([4096, 8192, 16384, 65536])


# What the columns of a run are. A form is drawn once for all runs of a case.
def draw_form(rng, wish):
    form = dict(theta=rng.choice(["m", "m", "e"]), degrees=rng.random() < 0.15, wrapped=rng.random() < 0.5, time=rng.random() < 0.8,
                speed=rng.choice([None, "speed_rad_per_s", "speed_rpm", "speed_rpm"]), currents=rng.choice(["abc", "abc", "dq"]),
                load_voltages=rng.random() < 0.5, back_torque=rng.random() < 0.4, zero_currents=rng.random() < 0.4,
                jitter=rng.random() < 0.3, scope=False)
    form.update(wish)
    if not form["time"] and not form["speed"]:
        form["time"] = True
    return form


def conditions(motor, rng, kind):
    """(speed by rated speed, i_d, i_q) of a kind of run."""
    d, q, _ = motor.current_dq(rng.uniform(0.4, 1.0) * motor.rated_current_A)
    if motor.saliency == "none":
        d = rng.choice([0.0, 0.0, -0.3, 0.2]) * q
    fast = rng.uniform(0.3, 0.9)
    return {
        "back": (fast, 0, 0),
        "back_reverse": (-fast, 0, 0),
        "load": (fast, d, q),
        "brake": (fast, d, -q),
        "reverse": (-fast, d, -q),
        "crawl": (rng.uniform(0.02, 0.05), d, q),
        "slow": (rng.uniform(0.01, 0.04), 0, 0),
    }[kind]


def record(motor, sensors, form, rng, kind):
    """A run as the table that the engineer has."""
    share, i_d, i_q = conditions(motor, rng, kind)
    omega_m = share * motor.rated_speed_rpm * TURN / 60
    periods = max(5.3, motor.pole_pairs * rng.choice([1.0, 1.0, rng.uniform(0.6, 1.3)]))
    per_period = 46 if kind != "slow" else max(46, 4.3 * motor.cogging[-1][0])
    step_s = 1 / (per_period * motor.pole_pairs * abs(omega_m) / TURN)
    jitter = 0.2 * step_s if form["jitter"] else 0.0
    times = [k * step_s + rng.uniform(-jitter, jitter) for k in range(int(periods * per_period))]
    change = rng.uniform(-0.5, 0.2) if rng.random() < 0.25 else 0.0  # left to run out, for instance
    shaft, currents = Shaft(rng, omega_m, change / times[-1]), Currents(rng, i_d, i_q)
    truth = [(t,) + truth_at(motor, shaft, currents, t) for t in times]
    return read(motor, sensors, form, rng, kind, truth)


def read(motor, sensors, form, rng, kind, truth):
    loaded = kind not in ("back", "back_reverse", "slow")
    columns = {}
    if form["time"] or form["scope"]:
        columns["time_s"] = [row[0] for row in truth]
    angles = read_angles(motor, sensors, form, columns, [row[1] for row in truth])
    if form["scope"] and kind.startswith("back"):  # three voltages against time, and no encoder
        for name in list(columns)[1:]:
            del columns[name]
        loaded = False
    elif form["speed"]:
        scale = sensors.speed_gain * (60 / TURN if form["speed"] == "speed_rpm" else 1.0)
        columns[form["speed"]] = [scale * row[2] * (1 + rng.gauss(0, 0.002)) for row in truth]
    if loaded or form["zero_currents"] and not form["scope"]:
        read_currents(sensors, form, rng, columns, angles, [row[3] for row in truth])
    if kind.startswith("back") or (loaded and form["load_voltages"]):
        noise = 0.003 * max(abs(row[4][0]) for row in truth)
        for k, name in enumerate(VOLTAGES):
            columns[name] = [sensors.gain[name] * row[4][k] + rng.gauss(0, noise) for row in truth]
    if loaded or kind == "slow" or form["back_torque"]:
        columns["torque_Nm"] = [sensors.gain["torque"] * row[5] + sensors.offset_Nm + rng.gauss(0, sensors.noise_Nm) for row in truth]
    return Table(columns, "bench, %s" % kind)


def read_angles(motor, sensors, form, columns, theta_m):
    """Writes the angle column; gives the electrical angle as read."""
    p, count = motor.pole_pairs, TURN / sensors.counts
    read_m = [count * round((x + sensors.offset_theta / p) / count) for x in theta_m]
    written = read_m if form["theta"] == "m" else [p * x for x in read_m]
    if form["wrapped"]:
        written = [x % TURN for x in written]
    if form["degrees"]:
        written = [math.degrees(x) for x in written]
    columns["theta_%s_%s" % (form["theta"], "deg" if form["degrees"] else "rad")] = written
    return [p * x for x in read_m]


def read_currents(sensors, form, rng, columns, angles, currents):
    rows = [[sensors.gain[CURRENTS[k]] * i[k] + sensors.offset_A[k] + rng.gauss(0, sensors.noise_A) for k in range(3)] for i in currents]
    if form["currents"] == "abc":
        columns.update({name: [row[k] for row in rows] for k, name in enumerate(CURRENTS)})
        return
    columns["id_A"] = [-2 / 3 * sum(x * math.cos(theta - s) for x, s in zip(row, PHASE)) for row, theta in zip(rows, angles)]
    columns["iq_A"] = [2 / 3 * sum(x * math.sin(theta - s) for x, s in zip(row, PHASE)) for row, theta in zip(rows, angles)]
