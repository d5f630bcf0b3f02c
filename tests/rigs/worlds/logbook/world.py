#!/usr/bin/env python3
"""world.py KIND SEED FOLDER | --list | --selftest: recordings as people keep them in public data sets, spreadsheets, trend exports and
notebooks, of machines, loads and sensors of plant.py. FOLDER gets machine/, runs.csv, the recordings, and truth.json."""
import json, math, os, sys

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from plant import TAU, Machine, Sensors, point, record, run_free, sum_of_coils, to_abc, to_dq, write, write_machine

FAMILIES = [  # pole pairs, slots, N.m/A from .. to, A, rpm
    (4, 12, 0.25, 0.6, 8, 1500), (5, 12, 0.06, 0.15, 15, 2000), (3, 9, 0.3, 0.9, 12, 1500), (7, 12, 0.02, 0.05, 20, 1200),
    (4, 18, 0.8, 1.6, 20, 900), (2, 24, 0.7, 1.2, 6, 900), (5, 15, 0.1, 0.2, 10, 3000), (8, 18, 0.5, 0.9, 25, 400)]
KINDS = {}


def kind(f):
    KINDS[f.__name__] = f
    return f


def machine(rng, family=None, cog=0.02):
    """A machine with orders 1, 5, 7 of the back-EMF and two of cogging torque."""
    p, slots, low, high, amps, rpm = family or FAMILIES[rng.integers(len(FAMILIES))]
    e1 = np.exp(rng.uniform(np.log(low), np.log(high)))
    emf = {1: (e1, 0.0), 5: (e1 * rng.uniform(0.01, 0.04), rng.uniform(0, TAU)), 7: (e1 * rng.uniform(0.005, 0.02), rng.uniform(0, TAU))}
    rated = 1.5 * e1 * amps
    k = math.lcm(slots, 2 * p)
    cogs = {k: (cog * rated * rng.uniform(0.6, 1.4), rng.uniform(0, TAU)), 2 * k: (0.2 * cog * rated, rng.uniform(0, TAU))} if cog else {}
    return Machine(p, slots, emf, cogs, dict(i=amps, rpm=rpm, torque=rated))


class Case:
    """A list being written."""

    def __init__(self, rng, folder, true, declared=None):
        self.rng, self.folder, self.m = rng, folder, true
        self.declared = declared or true.copy()
        self.s = Sensors(true, rng)
        self.list, self.args, self.columns = [], [], None
        self.truth = dict(truth=[], alts=[], also=[], may=[], outside=False, values={}, refuse=False, both=True)

    def says(self, *truth, **more):
        self.truth["truth"] = list(truth)
        self.truth.update(more)
        return self

    def add(self, names, columns, role="fit", test="", **style):
        name = "run%02d.csv" % (len(self.list) + 1)
        write(os.path.join(self.folder, name), names, columns, **style)
        self.list.append((name, role, test))

    def bench(self, points, style="plain"):
        for pt in points:
            r = record(self.m, self.s, pt, self.rng)
            STYLES[style](self, r, pt["role"])
        return self

    def close(self, extra=()):
        write_machine(os.path.join(self.folder, "machine"), self.declared, extra)
        has = any(t for _, _, t in self.list)
        names = ["file", "role"] + (["test"] if has else [])
        write(os.path.join(self.folder, "runs.csv"), names, [list(c) for c in zip(*[x[:len(names)] for x in self.list])])
        if self.columns:
            write(os.path.join(self.folder, "columns.csv"), ["name", "column"], [list(c) for c in zip(*self.columns)])
        self.truth["args"] = self.args
        with open(os.path.join(self.folder, "truth.json"), "w") as f:
            json.dump(self.truth, f, indent=1)
        return self


def plain(case, r, role):
    case.add(["time_s", "theta_m_rad", "speed_rad_per_s", "ia_A", "ib_A", "ic_A", "torque_Nm"],
             [r["t"], r["angle"] % TAU, r["speed"], r["a"], r["b"], r["c"], r["torque"]], role)


def servo(case, r, role):
    case.add(["time_ms", "theta_m_deg", "speed_rpm", "id_A", "iq_A", "torque_Nm"],
             [r["t"] * 1e3, np.degrees(r["angle"]) % 360, r["speed"] * 60 / TAU, r["d"], r["q"], r["torque"]], role)


def german(case, r, role):
    case.add(["Zeit", "Winkel mech", "Drehzahl", "Strom L1", "Strom L2", "Drehmoment Messwelle"],
             [r["t"] * 1e3, np.degrees(r["angle"]) % 360, r["speed"] * 60 / TAU, r["a"], r["b"], r["torque"]], role,
             sep=";", dec=",", units=["ms", "°", "U/min", "A", "A", "Nm"])


def hot(case, r, role):
    case.add(["time_s", "theta_m_rad", "speed_rpm", "ia_A", "ib_A", "ic_A", "torque_Nm", "temperature_C"],
             [r["t"], r["angle"] % TAU, r["speed"] * 60 / TAU, r["a"], r["b"], r["c"], r["torque"], r["temp"]], role)


STYLES = dict(plain=plain, servo=servo, german=german, hot=hot)


def loads(m, rng, count=7, both=True, id_share=0.0, n=2400, turns=6):
    """A list as one would plan it: no load, part loads, both directions, the last held out."""
    points = []
    for i in range(count):
        q = m.rated["i"] * (0 if i in (0, 4) else rng.uniform(0.25, 1.0)) * (1 if i % 3 else -1 if both else 1)
        rpm = m.rated["rpm"] * rng.uniform(0.15, 0.5) * (-1 if both and i % 2 else 1)
        d = id_share * m.rated["i"] * rng.uniform(-1, 0.3) if q else 0.0
        points.append(point(d, q, rpm, n, turns, role="holdout" if i == count - 1 else "fit"))
    return points


def start(rng, folder, family=None, cog=0.02):
    m = machine(rng, family, cog)
    return Case(rng, folder, m)


# ------------------------------------------------------------------ public data sets: means without an angle
def testbench_rows(c, rng, rows, d_share=0.5, temps=(20, 20)):
    """Two samples a second of drive cycles: columns as in a public data set of a traction machine."""
    m = c.m
    i_q = m.rated["i"] * np.clip(np.cumsum(rng.normal(0, 0.05, rows)) + 0.8 * np.sin(np.arange(rows) / rows * 29 + rng.uniform(0, 6)), -1, 1)
    i_d = -m.rated["i"] * d_share * abs(np.sin(np.arange(rows) / rows * 17))
    rpm = m.rated["rpm"] * (0.5 + 0.45 * np.sin(np.arange(rows) / rows * 11 + rng.uniform(0, 6)))
    temp = np.linspace(temps[0], temps[1], rows) + 3 * np.sin(np.arange(rows) / 40)
    grid = np.arange(48) / 48 * TAU
    torque = np.array([m.torque(grid / m.p, to_abc(grid, d + 0 * grid, q + 0 * grid), T).mean() for d, q, T in zip(i_d, i_q, temp)])
    torque -= np.array([m.drag(v * TAU / 60) for v in rpm])
    torque += 0.004 * m.rated["torque"] * rng.standard_normal(rows)
    return i_d, i_q, rpm, temp, torque


def testbench(c, rng, files=3, **more):
    for k in range(files):
        i_d, i_q, rpm, temp, torque = testbench_rows(c, rng, 260, **more)
        v = c.m.emf[1][0] * rpm * TAU / 60
        c.add(["u_q", "coolant", "stator_winding", "u_d", "stator_tooth", "motor_speed", "i_d", "i_q", "pm", "stator_yoke", "ambient", "torque",
               "profile_id"], [v, 19 + 0 * v, temp + 8, -v * 0.2, temp + 4, rpm, i_d, i_q, temp, temp - 3, 21 + 0 * v, torque, 17 + k + 0 * v],
              "holdout" if k == files - 1 else "fit")


EV = (4, 48, 0.25, 0.4, 200, 3000)


def ev(rng):
    m = machine(rng, EV, 0.005)
    m.ld, m.lq = 0.25e-3, 0.55e-3
    return m


@kind
def dataset_sound(rng, folder):
    """Public traction data, 2 Hz, no angle; the declared machine is right."""
    c = Case(rng, folder, ev(rng))
    testbench(c, rng)
    return c.says()


@kind
def dataset_reluctance(rng, folder):
    m = ev(rng)
    c = Case(rng, folder, m)
    c.declared.ld = c.declared.lq = 0
    testbench(c, rng)
    return c.says("reluctance")


@kind
def dataset_warm(rng, folder):
    """pm is the magnets' temperature, by columns.csv."""
    m = ev(rng)
    m.alpha = -0.0012
    c = Case(rng, folder, m)
    c.declared.alpha = 0
    c.columns = [("temperature_C", "pm")]
    testbench(c, rng, temps=(25, 105))
    return c.says("magnet_temperature", values={"magnet_temperature emf_per_kelvin": [m.alpha, 0.1]})


@kind
def ev_maps_three_temperatures(rng, folder):
    """Mean torque over i_d, i_q at 20, 60 and 100 C, a file each; iron saturates, magnets get weak, nothing of it declared but L."""
    m = machine(rng, EV, 0.005)
    m.iron = (m.rated["i"] * 1.2, m.rated["i"] * 1.6)
    m.alpha = -0.0011
    c = Case(rng, folder, m)
    c.declared.iron, c.declared.alpha = None, 0
    g = np.arange(48) / 48 * TAU
    for T in (20, 60, 100):
        d, q = [x.ravel() for x in np.meshgrid(np.linspace(-1, 0, 6) * m.rated["i"], np.linspace(-1, 1, 9) * m.rated["i"])]
        tq = np.array([m.torque(g / m.p, to_abc(g, a + 0 * g, b + 0 * g), T).mean() for a, b in zip(d, q)])
        tq = tq + 0.002 * m.rated["torque"] * rng.standard_normal(len(d))
        c.add(["id_A", "iq_A", "torque_Nm", "temperature_C"], [d, q, tq, T + 0 * d], "holdout" if T == 60 else "fit")
    return c.says("saturation", "magnet_temperature", also=["reluctance"], values={"magnet_temperature emf_per_kelvin": [m.alpha, 0.15]})


@kind
def drive_cycle_drag(rng, folder):
    """10 Hz of a drive cycle in both directions, no angle: friction is not declared."""
    m = ev(rng)
    m.friction = (0.01 * m.rated["torque"], 0.03 * m.rated["torque"] / 300, 0)
    c = Case(rng, folder, m)
    c.declared.friction = (0, 0, 0)
    for k in range(4):
        i_d, i_q, rpm, _, tq = testbench_rows(c, rng, 200)
        sign = -1 if k % 2 else 1
        tq = tq + (np.array([m.drag(v * TAU / 60) for v in rpm]) - np.array([m.drag(v * sign * TAU / 60) for v in rpm]))
        c.add(["id_A", "iq_A", "speed_rpm", "torque_Nm"], [i_d, i_q, sign * rpm, tq], "holdout" if k == 3 else "fit")
    return c.says("friction", values={"friction coulomb": [m.friction[0], 0.2]})


# ------------------------------------------------------------------ robots
def fourier(rng, seconds, amplitude, base):
    w = TAU / seconds
    a = rng.normal(0, 1, (4, 2)) / np.arange(1, 5)[:, None]
    a *= amplitude / abs(a).sum()
    def q(t):
        return base + sum(a[k, 0] * np.sin((k + 1) * w * t) + a[k, 1] * np.cos((k + 1) * w * t) for k in range(4))
    def v(t):
        return sum((k + 1) * w * (a[k, 0] * np.cos((k + 1) * w * t) - a[k, 1] * np.sin((k + 1) * w * t)) for k in range(4))
    def acc(t):
        return -sum(((k + 1) * w) ** 2 * (a[k, 0] * np.sin((k + 1) * w * t) + a[k, 1] * np.cos((k + 1) * w * t)) for k in range(4))
    return q, v, acc


@kind
def robot_excitation(rng, folder):
    """Excitation by a Fourier series, 1 kHz, a torque sensor behind the rotor: its inertia and friction are not declared."""
    m = machine(rng, FAMILIES[0])
    J = 0.3 * m.rated["torque"] / 150.0
    m.friction = (0.03 * m.rated["torque"], 0.02 * m.rated["torque"] / 60, 0)
    c = Case(rng, folder, m)
    c.declared.friction = (0, 0, 0)
    for k in range(5):
        q, v, acc = fourier(rng, 5.0, rng.uniform(25, 45), rng.uniform(0, 6))
        t = np.arange(5000) / 1000.0
        load = 0.5 * m.rated["i"] * np.sin(TAU * t / 3.7 + k)
        a, w = q(t), v(t)
        th = m.p * a
        T = m.torque(a, to_abc(th, 0 * t, load)) + m.cogging(a) - m.drag(w) - J * acc(t) + 0.003 * m.rated["torque"] * rng.standard_normal(5000)
        c.add(["time_s", "theta_m_rad", "speed_rad_per_s", "id_A", "iq_A", "torque_Nm"],
              [t, a, w, 0.002 * m.rated["i"] * rng.standard_normal(5000), load + 0.002 * m.rated["i"] * rng.standard_normal(5000), T],
              "holdout" if k == 4 else "fit")
    return c.says("rotor_inertia", "friction", values={"rotor_inertia inertia": [J, 0.05], "friction coulomb": [m.friction[0], 0.1]})


def crawl(c, rng, current_noise, arc=None, rpm=6.0, turns=2, gravity=None, load=0.0, rows=6000):
    """A joint that position control moves slowly there and back: i_q is what holds it. Rows t, angle, speed, i_q."""
    m = c.m
    w = rpm * TAU / 60
    span = arc or turns * TAU
    t = np.arange(rows) * (2 * span / w) / rows
    s, v = w * t, w + 0 * t
    for f in rng.uniform(0.3, 3, 3):            # what the control lets the speed wander
        phase = rng.uniform(0, TAU)
        s, v = s + 0.05 * w / (TAU * f) * np.sin(TAU * f * t + phase), v + 0.05 * w * np.cos(TAU * f * t + phase)
    a = np.where(s < span, s, 2 * span - s) + rng.uniform(0, TAU)
    v = np.where(s < span, v, -v)
    T = m.cogging(a) - m.drag(v) + load
    if gravity:
        T = T + gravity[0] * np.sin(a + gravity[1])
    th = m.p * a
    k = m.torque(a, to_abc(th, 0 * a, 1.0 + 0 * a))
    return t, a, v, -T / k + current_noise * rng.standard_normal(rows)


@kind
def robot_gravity_arc(rng, folder):
    """A link of a robot, 100 degrees there and back at 1 rad/s, no torque sensor: its weight, friction, cogging that is declared."""
    m = machine(rng, FAMILIES[7])
    m.friction = (0.02 * m.rated["torque"], 0, 0)
    c = Case(rng, folder, m)
    c.declared.friction = (0, 0, 0)
    g = (0.15 * m.rated["torque"], rng.uniform(0, TAU))
    for k in range(4):
        t, a, v, i = crawl(c, rng, 0.003 * m.rated["i"], arc=1.75, rpm=6 + 2 * k, gravity=g)
        c.add(["time_s", "theta_m_rad", "speed_rad_per_s", "id_A", "iq_A"], [t, a, v, 0 * t, i], "holdout" if k == 3 else "fit")
    return c.says("friction", "mechanical_order", outside=True, also=[])


@kind
def dynamixel_counts(rng, folder):
    """A smart servo: position in counts, current in steps of 2.69 mA, speed in steps of 0.229 rpm; slowly there and back."""
    m = machine(rng, (7, 12, 0.25, 0.35, 2, 60), 0.0)
    m.friction = (0.03 * m.rated["torque"], 0, 0)
    m.cog = {84: (0.03 * m.rated["torque"], rng.uniform(0, TAU))}
    c = Case(rng, folder, m)
    c.declared.friction, c.declared.cog = (0, 0, 0), {}
    c.columns = [("theta_m_rad", "Present_Position/4096"), ("iq_mA", "Present_Current_mA")]
    for k in range(4):
        t, a, v, i = crawl(c, rng, 0.004, rpm=1.5 + k)
        i = np.round(i / 0.00269) * 2.69
        c.add(["Timestamp_ms", "Present_Position", "Present_Velocity_raw", "Present_Current_mA", "Present_Temperature"],
              [np.round(t * 1e3), np.round(a / TAU * 4096), np.round(v * 60 / TAU / 0.229), i, 41 + 0 * t], "holdout" if k == 3 else "fit", test="holding")
    return c.says("cogging", "friction", values={"friction coulomb": [m.friction[0], 0.1]})


@kind
def knob_by_hand(rng, folder):
    """A haptic knob turned by hand against a torque cell, no current: uneven, both ways; 84 detents a turn are cogging."""
    m = machine(rng, FAMILIES[3], 0.0)
    m.cog = {84: (0.02 * m.rated["torque"], rng.uniform(0, TAU))}
    m.friction = (0.015 * m.rated["torque"], 0, 0)
    c = Case(rng, folder, m)
    c.declared.cog, c.declared.friction = {}, (0, 0, 0)
    for k in range(4):
        q, v, _ = fourier(rng, 20.0, 7.0, rng.uniform(0, 6))
        t = np.arange(4000) / 200.0
        a, w = q(t), v(t)
        T = m.cogging(a) - m.drag(w) + 0.002 * m.rated["torque"] * rng.standard_normal(4000)
        c.add(["time_s", "theta_m_deg", "torque_mNm"], [t, np.round(np.degrees(a) / 0.02) * 0.02, T * 1e3], "holdout" if k == 3 else "fit")
    return c.says("cogging", "friction", values={"friction coulomb": [m.friction[0], 0.1]})


# ------------------------------------------------------------------ hobby
@kind
def vesc_downhill(rng, folder):
    """A scooter's log at 10 Hz down and up a hill: the road is the load, nothing is wrong with the machine."""
    m = machine(rng, (15, 27, 0.4, 0.7, 40, 500), 0.004)
    m.inertia = 3.0
    c = Case(rng, folder, m)
    for k in range(3):
        t = np.arange(900) / 10.0
        slope = m.rated["torque"] * 0.4 * np.sin(t / 23 + rng.uniform(0, 6))
        v, a, rows = 20.0, rng.uniform(0, 6), []
        for i, x in enumerate(t):
            q = np.clip(m.rated["i"] * (0.3 * (25 + 6 * np.sin(x / 9) - v)), -0.6 * m.rated["i"], m.rated["i"])
            rows.append((a, v, q))
            acc = (1.5 * m.emf[1][0] * q + slope[i] - 0.02 * v * v) / m.inertia
            a, v = a + 0.1 * v + 0.005 * acc, v + 0.1 * acc
        a, v, q = np.array(rows).T
        c.add(["ms_today", "input_voltage", "current_motor", "current_in", "d_axis_current", "q_axis_current", "erpm", "duty_cycle", "encoder_position"],
              [np.round(4e7 + t * 1e3), 51 - 0.02 * q, abs(q), q * 0.4, 0.2 * rng.standard_normal(900), np.round(q + 0.3 * rng.standard_normal(900), 2),
               np.round(v * 60 / TAU * m.p), np.round(v / 52, 3), np.round(np.degrees(a) % 360, 2)], "holdout" if k == 2 else "fit", sep=";")
    return c.says(also=["friction"])


@kind
def odrive_unbalanced_disc(rng, folder):
    """A free shaft with a bolt through the disc's rim, axis level: torque steps, acceleration by the encoder."""
    m = machine(rng, FAMILIES[3], 0.0)
    m.inertia = m.rated["torque"] / 120.0
    m.friction = (0.01 * m.rated["torque"], 0, 0)
    m.mech = {1: (0.06 * m.rated["torque"], rng.uniform(0, TAU))}
    c = Case(rng, folder, m)
    c.declared.mech = {}
    for k in range(4):
        step = m.rated["i"] * 0.2 * (1 if k % 2 else -1)
        def cur(t, x, v):
            return 0.0, step * (1 if (t / 1.3) % 2 < 1 else -0.9)
        t, a, v, d, q = run_free(m, m.inertia, cur, 6.0, 5e-4, rng, start=rng.uniform(0, 6), every=4)
        n = len(t)
        a = np.round(a / TAU * 16384) / 16384
        c.add(["time_s", "pos_estimate", "vel_estimate", "Iq_measured", "Id_measured"],
              [t, a, v / TAU + 0.002 * rng.standard_normal(n), q + 0.002 * m.rated["i"] * rng.standard_normal(n), 0.002 * m.rated["i"] * rng.standard_normal(n)],
              "holdout" if k == 3 else "fit")
    return c.says("mechanical_order")


@kind
def thrust_stand(rng, folder):
    """A thrust stand's log: torque, electrical speed, battery current, no phase current. Nothing can be said of the motor."""
    m = machine(rng, FAMILIES[3], 0.01)
    c = Case(rng, folder, m)
    for k in range(3):
        t = np.arange(300) / 40.0
        rpm = 2000 + 700 * np.floor(t) * (1 + 0.1 * k)
        T = 1.2e-8 * rpm ** 2 * (1 + 0.003 * rng.standard_normal(300))
        c.add(["Time (s)", "ESC signal (µs)", "Torque (N·m)", "Thrust (kgf)", "Voltage (V)", "Current (A)", "Motor Electrical Speed (RPM)",
               "Motor Optical Speed (RPM)"], [t, 1000 + 100 * np.floor(t), T, T * 4, 15.8 + 0 * t, T * rpm / 120, rpm * m.p, rpm],
              "holdout" if k == 2 else "fit")
    return c.says(refuse=True)


# ------------------------------------------------------------------ by hand
@kind
def spring_balance_map(rng, folder):
    """A lever and a spring balance: torque typed at 72 angles and a few currents, to half a per cent; cogging is not declared."""
    m = machine(rng, FAMILIES[5], 0.05)
    c = Case(rng, folder, m)
    c.declared.cog = {}
    step = 0.005 * m.rated["torque"]
    for k, share in enumerate((0, 0.3, 0.6, 0.9, -0.6, 0.45)):
        a = np.radians(np.arange(72) * 2.5)
        i = to_abc(m.p * a, 0 * a, share * m.rated["i"] + 0 * a)
        T = m.torque(a, i) + m.cogging(a)
        T = np.round((T + 0.5 * step * rng.standard_normal(72)) / step) * step
        c.add(["theta_m_deg", "ia_A", "ib_A", "ic_A", "torque_Nm"], [np.degrees(a), *np.round(i, 3), T], "holdout" if k == 5 else "fit")
    return c.says("cogging")


@kind
def hanging_weight(rng, folder):
    """A weight on a drum, held at each of 90 angles: the torque column is the weight, the current answers cogging (not declared)."""
    m = machine(rng, FAMILIES[4], 0.03)
    c = Case(rng, folder, m)
    c.declared.cog = {}
    for k, share in enumerate((0.2, 0.4, 0.6, -0.4, 0.5)):
        a = np.radians(np.arange(180) * 2.0)
        w = share * m.rated["torque"]
        unit = m.torque(a, to_abc(m.p * a, 0 * a, 1.0 + 0 * a))
        q = (w - m.cogging(a)) / unit + 0.002 * m.rated["i"] * rng.standard_normal(180)
        c.add(["theta_m_deg", "id_A", "iq_A", "torque_Nm"], [np.degrees(a), 0 * a, q, w + 0 * a], "holdout" if k == 4 else "fit")
    return c.says("cogging")


@kind
def pendulum(rng, folder):
    """An arm with a mass swings out without a current: angle over time, inertia with the arm declared; weight and friction act."""
    m = machine(rng, FAMILIES[7], 0.0)
    m.inertia = 0.05
    g = 0.05 * 30
    m.mech = {1: (-g, 0.0)}
    m.friction = (0.02 * g, 0.0, 0)
    c = Case(rng, folder, m)
    c.declared.mech, c.declared.friction = {}, (0, 0, 0)
    for k in range(4):
        t, a, v, d, q = run_free(m, m.inertia, lambda *_: (0.0, 0.0), 8.0, 1e-3, rng, start=0.6 + 0.5 * k, every=2)
        a = np.round(a / TAU * 65536) * TAU / 65536
        c.add(["time_s", "theta_m_rad"], [t, a], "holdout" if k == 3 else "fit")
    return c.says("mechanical_order", "friction", outside=True)


# ------------------------------------------------------------------ oscilloscopes
@kind
def scope_two_phases(rng, folder):
    """Two phases and torque at 1 MS/s, 8 bits, 2 electrical turns a capture; the 5th of the back-EMF is larger than declared."""
    m = machine(rng, FAMILIES[0])
    c = Case(rng, folder, m)
    a5, f5 = m.emf[5]
    m.emf[5] = (a5 + 0.03 * m.emf[1][0], f5)
    step = 2.4 * m.rated["i"] / 256
    c.s.current_noise, c.s.current_step, c.s.angle_step = 0.4 * step, step, 0.0
    for k, share in enumerate((0.3, 0.6, 0.9, 0.75)):
        rpm = 0.4 * m.rated["rpm"]
        turns = 2.0 / m.p
        n = int(turns * 60 / rpm * 1e6)
        r = record(m, c.s, point(-0.3 * share * m.rated["i"] * (k % 2), share * m.rated["i"], rpm, n, turns), rng)
        c.add(["Time (s)", "theta_e (deg)", "Current phase a (A)", "Current phase b (A)", "Torque (Nm)"],
              [r["t"], np.degrees(m.p * r["angle"]) % 360, r["a"], r["b"], np.round(r["torque"] / m.rated["torque"] * 100) / 100 * m.rated["torque"]],
              "holdout" if k == 3 else "fit")
    return c.says("back_emf")


@kind
def scope_open_voltages(rng, folder):
    """An open generator, three voltages at two speeds, and two loaded runs with torque: the declared back-EMF is 6 % too large."""
    m = machine(rng, FAMILIES[2])
    c = Case(rng, folder, m)
    for n in c.declared.emf:
        c.declared.emf[n] = (m.emf[n][0] * 1.06, m.emf[n][1])
    for rpm in (300, 900):
        t = np.arange(3000) * (8 * 60 / rpm / 3000)
        a = rpm * TAU / 60 * t + 1.0
        v = m.e(m.p * a) * rpm * TAU / 60 + 0.05 * rng.standard_normal((3, 3000))
        c.add(["time_s", "theta_m_rad", "va_V", "vb_V", "vc_V"], [t, a % TAU, *v])
    for share in (0.5, 0.9, 0.7):
        r = record(m, c.s, point(0, share * m.rated["i"], 500), rng)
        plain(c, r, "holdout" if share == 0.7 else "fit")
    return c.says("back_emf", alts=[["torque_gain"], ["current_gain"], ["magnet_temperature"]], values={"back_emf sine_1": [-0.06 * m.emf[1][0], 0.2]})


# ------------------------------------------------------------------ generators, odd machines
def rectifier(th, amps):
    """120-degree blocks with slopes of commutation, braking; three phases of zero sum."""
    def block(x):
        return np.clip(np.sin(x) / 0.5, -1, 1) * np.clip((abs(np.sin(x)) - 0.35) / 0.25, 0, 1)
    i = np.array([-amps * block(th - s * TAU / 3) for s in range(3)])
    return i - i.mean(0)


def wind(rng, folder, hidden):
    m = machine(rng, (14, 84, 4.0, 8.0, 12, 150), 0.01)
    c = Case(rng, folder, m)
    if hidden:
        c.declared.cog = {}
    for k, (share, rpm) in enumerate(((0, 60), (0.3, 80), (0.6, 120), (0.9, 150), (0.5, 100))):
        n = 6000
        t = np.arange(n) * (3 * 60 / rpm / n)
        a = rpm * TAU / 60 * t + rng.uniform(0, TAU)
        i = rectifier(m.p * a - 0.2, share * m.rated["i"])
        T = m.torque(a, i) + m.cogging(a) + 0.002 * m.rated["torque"] * rng.standard_normal(n)
        i = i + 0.001 * m.rated["i"] * rng.standard_normal((3, n))
        c.add(["time_s", "theta_m_rad", "speed_rpm", "ia_A", "ib_A", "ic_A", "torque_Nm"], [t, a % TAU, rpm + 0 * t, *i, T], "holdout" if k == 4 else "fit")
    return c


@kind
def wind_rectifier_sound(rng, folder):
    """A generator of 28 poles on a diode bridge: blocks of current that brake; nothing is hidden."""
    return wind(rng, folder, False).says()


@kind
def wind_rectifier_cogging(rng, folder):
    return wind(rng, folder, True).says("cogging")


@kind
def axial_wobble(rng, folder):
    """An axial-flux machine whose disc wobbles: back-EMF and cogging vary once a turn."""
    m = machine(rng, FAMILIES[7], 0.02)
    c = Case(rng, folder, m)
    share, phase = 0.03, rng.uniform(0, TAU)
    m.wobble = [(1, share, phase)]
    for k, (a, f) in list(m.cog.items()):
        for s in (-1, 1):
            m.cog[k + s] = (a * share, f + s * phase)
    c.bench(loads(m, rng, 8, n=4000))
    return c.says("mechanical_order", alts=[["unequal_magnets"], ["mechanical_order", "cogging"]], also=["cogging", "unequal_magnets"])


@kind
def eccentric_both(rng, folder):
    """Static and dynamic eccentricity without a current: cogging twice an electrical turn and as often as there are slots."""
    m = machine(rng, FAMILIES[0], 0.01)
    m.cog[2 * m.p] = (0.012 * m.rated["torque"], rng.uniform(0, TAU))
    m.cog[m.slots] = (0.015 * m.rated["torque"], rng.uniform(0, TAU))
    c = Case(rng, folder, m)
    for k in (2 * m.p, m.slots):
        del c.declared.cog[k]
    c.bench(loads(m, rng, 7), "german")
    return c.says("cogging", alts=[["mechanical_order"], ["mechanical_order", "cogging"]])


@kind
def one_weak_magnet(rng, folder):
    """One magnet of a machine with coils on teeth has lost a part of its strength."""
    m = machine(rng, FAMILIES[1], 0.0)
    m.weak = rng.uniform(0.15, 0.35)
    q = m.slots
    m.cog = {math.lcm(q, 2 * m.p): (0.01 * m.rated["torque"], 1.0), q: (0.02 * m.rated["torque"] * m.weak, 2.0), 2 * q: (0.01 * m.rated["torque"] * m.weak, 0.4)}
    c = Case(rng, folder, m)
    c.declared.cog = {math.lcm(q, 2 * m.p): m.cog[math.lcm(q, 2 * m.p)]}
    c.bench(loads(m, rng, 9, id_share=0.4, n=4000))
    return c.says("mechanical_order", alts=[["unequal_magnets"]], also=["cogging", "back_emf", "unequal_magnets", "phase_imbalance"])


@kind
def skewed_in_truth(rng, folder):
    """The folder is of finite elements without the skew: harmonics and cogging are smaller in truth."""
    m = machine(rng, FAMILIES[4], 0.05)
    m.emf[5], m.emf[7] = (0.05 * m.emf[1][0], 0.0), (0.03 * m.emf[1][0], math.pi)
    c = Case(rng, folder, m)
    skew = TAU / 18 * m.p
    for n in list(m.emf):
        a, f = m.emf[n]
        m.emf[n] = (a * np.sinc(n * skew / TAU) / np.sinc(skew / TAU), f)
    for k in list(m.cog):
        a, f = m.cog[k]
        m.cog[k] = (a * abs(np.sinc(k * (skew / m.p) / TAU)), f)
    c.bench(loads(m, rng, 8, id_share=0.5), "servo")
    return c.says("back_emf", "cogging")


@kind
def outrunner_27_30_sound(rng, folder):
    """27 teeth, 30 poles, cogging 270 times a turn, an encoder of 2000 counts; nothing is hidden."""
    c = start(rng, folder, (15, 27, 0.3, 0.6, 10, 200), 0.01)
    c.s.angle_step = TAU / 2000
    c.bench(loads(c.m, rng, 7, n=6000, turns=4))
    return c.says()


@kind
def dental_two_pole(rng, folder):
    """A motor of two poles and three slots, 40 000 rpm, N.mm: the current channel is 40 us late."""
    c = start(rng, folder, (1, 3, 0.002, 0.004, 4, 40000), 0.03)
    m = c.m
    c.s.current_late = 40e-6
    for i, pt in enumerate(loads(m, rng, 8, n=3000, turns=30)):
        r = record(m, c.s, dict(pt, rpm=pt["rpm"] * 2), rng)
        c.add(["time_us", "theta_m_deg", "ia_mA", "ib_mA", "ic_mA", "torque_uNm"], [r["t"] * 1e6, np.degrees(r["angle"]) % 360, r["a"] * 1e3, r["b"] * 1e3,
              r["c"] * 1e3, r["torque"] * 1e6], "holdout" if i == 7 else "fit")
    return c.says("channel_delay", values={"channel_delay current": [40e-6, 0.1]})


@kind
def telescope_120_poles(rng, folder):
    """A direct drive of 120 poles and 126 slots in kN.m: cogging of the stator's segments, 6 a turn, is not declared."""
    c = start(rng, folder, (60, 126, 60, 90, 30, 6), 0.004)
    m = c.m
    m.cog[6] = (0.01 * m.rated["torque"], rng.uniform(0, TAU))
    for i, pt in enumerate(loads(m, rng, 6, n=12000, turns=2)):
        r = record(m, c.s, pt, rng)
        c.add(["time_s", "theta_m_deg", "speed_rpm", "id_A", "iq_A", "torque_kNm"], [r["t"], np.degrees(r["angle"]) % 360, r["speed"] * 60 / TAU, r["d"], r["q"],
              r["torque"] / 1e3], "holdout" if i == 5 else "fit")
    return c.says("cogging", alts=[["mechanical_order"]])


@kind
def closed_delta(rng, folder):
    """A delta winding whose third harmonic drives a current around it: a brake, with a ripple of order 6, that grow with the speed."""
    c = start(rng, folder, FAMILIES[2], 0.01)
    m = c.m
    e3 = 0.10 * m.emf[1][0]
    m.triplen = (e3, 2.0 * e3 ** 2 * m.rated["rpm"] / 9.55 / (0.08 * m.rated["torque"]), 1e-5)
    points = loads(m, rng, 8)
    for k, pt in enumerate(points):
        pt["rpm"] = math.copysign(m.rated["rpm"] * (0.15 + 0.12 * k), pt["rpm"])
    points[-1]["rpm"] *= 0.6
    c.bench(points)
    return c.says("friction", outside=True)


# ------------------------------------------------------------------ loads
def swinging(m, rng, points, share, k, J):
    for pt in points:
        w = abs(pt["rpm"]) * TAU / 60
        pt["swing"] = [(k, share / k, rng.uniform(0, TAU))]
        pt["j"] = J
    return points


@kind
def compressor(rng, folder):
    """A piston compressor behind a torque flange: the speed swings once and twice a turn; the rotor's inertia is before the flange."""
    c = start(rng, folder, FAMILIES[4], 0.01)
    m = c.m
    J = 0.03 * m.rated["torque"] / (0.03 * (m.rated["rpm"] * 0.3 * TAU / 60) ** 2)
    points = [point(0, m.rated["i"] * s, m.rated["rpm"] * r, 3600, 6, role=h) for s, r, h in
              ((0.3, 0.2, "fit"), (0.5, 0.35, "fit"), (0.7, 0.35, "fit"), (0.6, 0.5, "fit"), (0.9, 0.25, "fit"), (0.5, 0.45, "holdout"))]
    swinging(m, rng, points, 0.03, 1, J)
    for pt in points:
        pt["swing"].append((2, 0.01, rng.uniform(0, TAU)))
    c.bench(points)
    return c.says("rotor_inertia", values={"rotor_inertia inertia": [J, 0.05]})


@kind
def compressor_sound(rng, folder):
    """The same with the flange at the rotor, and a current that follows the load; nothing is hidden."""
    c = start(rng, folder, FAMILIES[4], 0.01)
    m = c.m
    points = [point(0, m.rated["i"] * s, m.rated["rpm"] * r, 3600, 6, role=h) for s, r, h in
              ((0.3, 0.2, "fit"), (0.5, 0.35, "fit"), (0.7, 0.35, "fit"), (0.6, 0.5, "fit"), (0.5, 0.45, "holdout"))]
    swinging(m, rng, points, 0.03, 1, 0.0)
    for pt in points:
        w = pt["rpm"] * TAU / 60
        pt["follows"] = lambda t, w=w: 1 + 0.4 * np.sin(w * t + 0.3) + 0.15 * np.sin(2 * w * t)
    c.bench(points)
    return c.says()


@kind
def washing_tumble(rng, folder):
    """A drum with wet laundry on one side, no torque sensor: 50 Hz, 25 to 60 rpm, i_q and speed; the weight acts once a turn."""
    m = machine(rng, (12, 36, 1.5, 2.5, 6, 60), 0.005)
    m.inertia = 0.5
    m.friction = (0.03 * m.rated["torque"], 0, 0)
    m.mech = {1: (0.12 * m.rated["torque"], rng.uniform(0, TAU))}
    c = Case(rng, folder, m)
    c.declared.mech = {}
    for k, rpm in enumerate((30, 45, 60, 50)):
        target = rpm * TAU / 60 * (-1 if k == 1 else 1)
        def cur(t, x, v):
            return 0.0, float(np.clip(0.8 * m.inertia * 6 * (target - v) / m.emf[1][0] / 1.5 + math.copysign(m.friction[0], target) / 1.5 / m.emf[1][0],
                                      -m.rated["i"], m.rated["i"]))
        t, a, v, d, q = run_free(m, m.inertia, cur, 24.0, 1e-3, rng, speed=target, every=20)
        n = len(t)
        keep = t > 4
        c.add(["time_s", "theta_m_rad", "speed_rpm", "id_A", "iq_A"], [x[keep] for x in (t, a % TAU, v * 60 / TAU + 0.02 * rng.standard_normal(n),
              0.01 * rng.standard_normal(n), q + 0.003 * m.rated["i"] * rng.standard_normal(n))], "holdout" if k == 3 else "fit")
    return c.says("mechanical_order")


@kind
def lift_up_and_down(rng, folder):
    """A gearless lift, no torque sensor: the car's weight up and down at 8 and 15 rpm by i_q; friction of the ropes is not declared."""
    m = machine(rng, (10, 24, 6, 10, 40, 150), 0.005)
    m.friction = (0.03 * m.rated["torque"], 0, 0)
    c = Case(rng, folder, m)
    c.declared.friction = (0, 0, 0)
    for k, rpm in enumerate((8, 15, 8, 12)):
        t, a, v, i = crawl(c, rng, 0.003 * m.rated["i"], rpm=rpm, turns=4, load=-0.25 * m.rated["torque"])
        c.add(["time_s", "theta_m_rad", "speed_rpm", "id_A", "iq_A"], [t, a % TAU, v * 60 / TAU, 0 * t, i], "holdout" if k == 3 else "fit", test="holding")
    return c.says("friction", outside=True, may=["cogging", "current_offset"], values={"friction coulomb": [m.friction[0], 0.15]})


# ------------------------------------------------------------------ sensors and loggers
@kind
def counts_lost(rng, folder):
    """An encoder with a dirty disc loses 0.4 % of its counts: the angle falls behind as it turns."""
    c = start(rng, folder)
    c.s.lost = 0.004
    c.bench(loads(c.m, rng, 7, n=3600, turns=8))
    return c.says(outside=True, may=["position_offset"])


@kind
def halls_interpolated(rng, folder):
    """An angle interpolated between six Hall sensors of which one is 4 degrees off."""
    c = start(rng, folder, FAMILIES[0])
    off = np.radians(4.0)
    true = np.array([0, 1, 2, 3, 4, 5, 6]) * TAU / 6
    moved = true.copy()
    moved[2] += off
    moved[5] += off
    c.s.angle_map = lambda x: np.interp(x, moved, true)     # the edges come late, the interpolation takes them at their places
    c.bench(loads(c.m, rng, 8, n=3000))
    return c.says("position_harmonics", also=["position_offset"])


@kind
def a_and_b_swapped(rng, folder):
    """Clamps a and b are swapped in all recordings."""
    c = start(rng, folder)
    for pt in loads(c.m, rng, 6):
        r = record(c.m, c.s, pt, rng)
        r["a"], r["b"] = r["b"], r["a"]
        plain(c, r, pt["role"])
    return c.says(outside=True)


@kind
def mixed_units_sound(rng, folder):
    """Each file by somebody else: N.mm and degrees, German, microseconds and turns; nothing is hidden."""
    c = start(rng, folder, FAMILIES[0])
    for k, pt in enumerate(loads(c.m, rng, 8)):
        r = record(c.m, c.s, pt, rng)
        if k % 4 == 3:
            c.add(["t [us]", "theta_m [rev]", "omega_m [rpm]", "i_d [mA]", "i_q [mA]", "torque [mNm]"], [r["t"] * 1e6, r["angle"] / TAU, r["speed"] * 60 / TAU,
                  r["d"] * 1e3, r["q"] * 1e3, r["torque"] * 1e3], pt["role"])
        else:
            (plain, servo, german)[k % 4](c, r, pt["role"])
    return c.says()


@kind
def list_of_everything(rng, folder):
    """Bench runs, slow turns without a torque sensor, a map of means, a run out: cogging and friction are not declared."""
    m = machine(rng, FAMILIES[0], 0.03)
    m.friction = (0.02 * m.rated["torque"], 0.01 * m.rated["torque"] / 50, 0)
    m.inertia = m.rated["torque"] / 500
    c = Case(rng, folder, m)
    c.declared.cog, c.declared.friction = {}, (0, 0, 0)
    c.bench(loads(m, rng, 5))
    for rpm in (4, 6):
        t, a, v, i = crawl(c, rng, 0.003 * m.rated["i"], rpm=rpm)
        c.add(["time_s", "theta_m_rad", "speed_rpm", "id_A", "iq_A"], [t, a, v * 60 / TAU, 0 * t, i], test="holding")
    t, a, v, d, q = run_free(m, m.inertia, lambda *_: (0.0, 0.0), 1.5, 2.5e-4, rng, speed=60.0, every=2)
    keep = v > 5
    c.add(["time_s", "theta_m_rad"], [t[keep], np.round(a[keep] * 65536 / TAU) * TAU / 65536])
    return c.says("cogging", "friction", values={"friction coulomb": [m.friction[0], 0.1]})


@kind
def sessions_concatenated(rng, folder):
    """Each file is three sessions after one another, the clock begins anew, a third of the rows is lost; a current sensor has a zero."""
    c = start(rng, folder, FAMILIES[0])
    c.s.offset = np.array([0.02 * c.m.rated["i"], 0, 0])
    for k in range(5):
        parts = []
        for pt in loads(c.m, rng, 4, n=1500)[1:4]:
            r = record(c.m, c.s, pt, rng)
            keep = rng.random(1500) > 0.33
            parts.append([x[keep] for x in (r["t"], r["angle"] % TAU, r["speed"], r["a"], r["b"], r["c"], r["torque"])])
        c.add(["time_s", "theta_m_rad", "speed_rad_per_s", "ia_A", "ib_A", "ic_A", "torque_Nm"], [np.concatenate(x) for x in zip(*parts)],
              "holdout" if k == 4 else "fit")
    return c.says("current_offset", values={"current_offset a": [c.s.offset[0], 0.15]})


@kind
def torque_range_4_percent(rng, folder):
    """The torque amplifier is 4 % too high, cogging is declared and large."""
    c = start(rng, folder, FAMILIES[5], 0.08)
    c.s.torque_gain = 0.04
    c.bench(loads(c.m, rng, 7))
    return c.says("torque_gain", alts=[["back_emf", "cogging"], ["magnet_temperature", "cogging"]], values={"torque_gain gain": [0.04, 0.15]})


@kind
def clamps_clip(rng, folder):
    """The current probes end at 70 % of the rated current; two runs go beyond."""
    c = start(rng, folder, FAMILIES[2])
    m = c.m
    c.s.clip = 0.7 * m.rated["i"]
    points = loads(m, rng, 8)
    for k, share in enumerate((0, 0.4, 0.6, -0.5, 0, 0.9, 1.0, 0.55)):
        points[k]["i_q"] = share * m.rated["i"]
    c.bench(points)
    return c.says(outside=True)


@kind
def plc_trend(rng, folder):
    """A PLC's trend: 10 ms, angle up to a cycle late, i_q in steps of 1 %: plateaus both ways, friction is not declared."""
    m = machine(rng, FAMILIES[4], 0.003)
    m.friction = (0.02 * m.rated["torque"], 0.03 * m.rated["torque"] / 40, 0)
    c = Case(rng, folder, m)
    c.declared.friction = (0, 0, 0)
    for k, (rpm, share) in enumerate(((120, 0.2), (250, 0.5), (-120, 0.3), (-400, -0.4), (400, 0.7), (300, 0.4))):
        n = 1500
        t = np.arange(n) * 0.01
        w = rpm * TAU / 60
        wander = rng.uniform(0.3, 0.6)         # of the shaft about its set speed, so that no ripple stands still at the samples
        a = w * t + wander * np.sin(TAU * t / 7 + k) + 1
        q = share * m.rated["i"] * np.ones(n)
        T = m.torque(a, to_abc(m.p * a, 0 * a, q)) + m.cogging(a) - m.drag(w + 0 * a) + 0.004 * m.rated["torque"] * rng.standard_normal(n)
        late = a - w * rng.uniform(0, 0.01, n)
        step = 0.01 * m.rated["i"]
        c.add(["Time", "Axis1.ActPos", "Axis1.ActVel", "Iq_act", "Torque_sensor"], [np.round(t * 1e3), np.degrees(late) % 360, rpm + 0.3 * rng.standard_normal(n),
              np.round(q / step + 0.4 * rng.standard_normal(n)) * step, T], "holdout" if k == 5 else "fit", sep=";", dec=",")
    c.columns = [("time_ms", "Time"), ("theta_m_deg", "Axis1.ActPos"), ("speed_rpm", "Axis1.ActVel"), ("iq_A", "Iq_act"), ("torque_Nm", "Torque_sensor")]
    return c.says("friction", values={"friction viscous": [m.friction[1], 0.25]}, may=["channel_delay"])


@kind
def locked_steps(rng, folder):
    """Steps of torque with a locked rotor: the reaction torque goes through a lag of 3 ms, 10 kHz."""
    c = start(rng, folder, FAMILIES[0], 0.0)
    m = c.m
    tau = 3e-3
    for k in range(5):
        n = 4000
        t = np.arange(n) / 1e4
        a = np.full(n, rng.uniform(0, TAU))
        level = rng.uniform(-1, 1, 4)
        q = m.rated["i"] * level[np.minimum((t / 0.1).astype(int), 3)]
        i = to_abc(m.p * a, 0 * q, q)
        T = m.torque(a, i)
        y, x = np.zeros(n), T[0]
        kk = math.exp(-1e-4 / tau)
        for j in range(n):
            y[j] = x
            x = kk * x + (1 - kk) * T[j]
        i = i + 0.001 * m.rated["i"] * rng.standard_normal((3, n))
        c.add(["time_s", "theta_m_rad", "speed_rad_per_s", "ia_A", "ib_A", "ic_A", "torque_Nm"],
              [t, a, 0 * t, *i, y + 0.003 * m.rated["torque"] * rng.standard_normal(n)], "holdout" if k == 4 else "fit")
    return c.says("torque_sensor", alts=[["channel_delay"]], may=["channel_delay"])


@kind
def trio_of_a_traction_motor(rng, folder):
    """With an angle and a thermometer: reluctance, weak hot magnets and friction at once."""
    m = ev(rng)
    m.alpha = -0.0011
    m.friction = (0.008 * m.rated["torque"], 0, 0)
    c = Case(rng, folder, m)
    c.declared.ld = c.declared.lq = c.declared.alpha = 0
    c.declared.friction = (0, 0, 0)
    points = loads(m, rng, 10, id_share=0.7)
    for k, pt in enumerate(points):
        pt["temp"] = 20 + 9 * ((k * 4) % 10)
    c.bench(points, "hot")
    return c.says("reluctance", "magnet_temperature", "friction", values={"magnet_temperature emf_per_kelvin": [m.alpha, 0.1]})


@kind
def two_runs_two_effects(rng, folder):
    """Two runs only, one without a current: cogging is not declared, a current sensor has a zero."""
    c = start(rng, folder, FAMILIES[0], 0.03)
    c.declared.cog = {}
    c.s.offset = np.array([0, 0.02 * c.m.rated["i"], 0])
    c.bench([point(0, 0, 200, 4000, 10), point(0, 0.7 * c.m.rated["i"], 300, 4000, 10)])
    return c.says("cogging", "current_offset", both=False)


@kind
def sixty_short_runs(rng, folder):
    """Sixty snapshots of 1.2 turns and 200 samples; the sensor of phase b reads 2 % too much."""
    c = start(rng, folder, FAMILIES[0], 0.01)
    c.s.gain = np.array([0, 0.02, 0])
    points = []
    for k in range(60):
        points.append(point(0, rng.uniform(-1, 1) * c.m.rated["i"], rng.choice([-1, 1]) * rng.uniform(60, 600), 200, 1.2, role="holdout" if k % 10 == 9 else "fit"))
    c.bench(points)
    return c.says("current_gain", values={"current_gain b": [0.02, 0.15]})


@kind
def sixty_sound(rng, folder):
    c = start(rng, folder, FAMILIES[1], 0.01)
    c.bench([point(0, rng.uniform(-1, 1) * c.m.rated["i"], rng.choice([-1, 1]) * rng.uniform(60, 600), 200, 1.2, role="holdout" if k % 10 == 9 else "fit") for k in range(60)])
    return c.says()


@kind
def winding_thermometer(rng, folder):
    """The thermometer is in the winding; the magnets follow it slowly and half as far."""
    m = machine(rng, FAMILIES[4])
    m.alpha = -0.0015
    c = Case(rng, folder, m)
    c.declared.alpha = 0
    points = loads(m, rng, 9)
    magnet, winding = 22.0, 22.0
    for k, pt in enumerate(points):
        winding = 22 + 90 * (pt["i_q"] / m.rated["i"]) ** 2 * 0.8 + 0.2 * (winding - 22)
        magnet += 0.25 * (0.7 * (winding - 22) + 22 - magnet)
        pt["temp"] = winding
        pt["magnet"] = lambda t, T=magnet: T
    c.bench(points, "hot")
    return c.says(outside=True, may=["magnet_temperature", "back_emf", "torque_gain"])


@kind
def one_mtpa_path(rng, folder):
    """All runs on the drive's path of most torque per ampere: saliency that is not declared, i_d follows i_q."""
    m = ev(rng)
    c = Case(rng, folder, m)
    c.declared.ld = c.declared.lq = 0
    points = []
    for k, s in enumerate((0.1, 0.3, 0.5, -0.7, 0.9, -0.4, 0.6)):
        points.append(point(-0.5 * abs(s) ** 1.3 * m.rated["i"], s * m.rated["i"], 400 + 100 * k, role="holdout" if k == 6 else "fit"))
    c.bench(points)
    return c.says("reluctance", alts=[["saturation"]], may=["saturation"])


@kind
def encoder_windup(rng, folder):
    """The encoder is at the load's end of a soft shaft: its angle is ahead by the torque over the stiffness."""
    c = start(rng, folder, FAMILIES[2])
    m = c.m
    c.s.windup = 0.12 / m.p / m.rated["torque"]
    c.bench(loads(m, rng, 9))
    return c.says("position_load", values={"position_load per_ampere": [0.12 / m.rated["i"], 0.1]})


@kind
def one_phase_open_sound(rng, folder):
    """Two of eight runs were made with phase c open, a and b as a single phase; currents are measured, nothing is hidden."""
    c = start(rng, folder, FAMILIES[0])
    m = c.m
    c.bench(loads(m, rng, 6))
    for share in (0.5, -0.3):
        n, rpm = 2400, 200
        t = np.arange(n) * (6 * 60 / rpm / n)
        a = rpm * TAU / 60 * t + 0.4
        single = share * m.rated["i"] * np.sin(m.p * a + TAU / 12)
        i = np.array([single, -single, 0 * single])
        T = m.torque(a, i) + m.cogging(a) + c.s.torque_noise * rng.standard_normal(n)
        i = i + c.s.current_noise * rng.standard_normal((3, n))
        c.add(["time_s", "theta_m_rad", "speed_rad_per_s", "ia_A", "ib_A", "ic_A", "torque_Nm"], [t, a % TAU, rpm * TAU / 60 + 0 * t, *i, T])
    return c.says()


@kind
def direct_current_turned(rng, folder):
    """Direct current in two phases at a time, the shaft turned at 3 rpm both ways: torque over angle. Phase b has 4 % fewer turns."""
    c = start(rng, folder, FAMILIES[5], 0.01)
    m = c.m
    m.gain = np.array([0, -0.04, 0])
    points = []
    for k, pair in enumerate(((1, -1, 0), (0, 1, -1), (-1, 0, 1), (0.5, 0.5, -1), (1, -0.5, -0.5))):
        fixed = [x * 0.5 * m.rated["i"] for x in pair]
        points.append(point(0, 0, 3 if k % 2 else -3, 2400, 2, fixed=fixed, role="holdout" if k == 4 else "fit"))
    c.bench(points)
    return c.says("phase_imbalance", alts=[["back_emf"], ["current_gain"]], values={"phase_imbalance b": [-0.04, 0.15]})


@kind
def magnets_hurt_midway(rng, folder):
    """An overload in the middle of the list has taken 6 % of the magnets for good."""
    c = start(rng, folder)
    m = c.m
    for k, pt in enumerate(loads(m, rng, 9)):
        if k == 4:
            for n in m.emf:
                m.emf[n] = (m.emf[n][0] * 0.94, m.emf[n][1])
        plain(c, record(m, c.s, pt, rng), pt["role"])
    return c.says(outside=True, may=["back_emf", "torque_gain"])


@kind
def observer_angle(rng, folder):
    """A drive without an encoder: the observer's angle lags by 1/speed and by the load."""
    c = start(rng, folder, FAMILIES[0])
    m = c.m
    for pt in loads(m, rng, 8):
        w = pt["rpm"] * TAU / 60
        c.s.angle_offset = -0.08 * pt["i_q"] / m.rated["i"] - 0.06 * math.copysign(1, w) * 20.0 / abs(w)
        c.bench([pt])
    return c.says(outside=True, may=["position_load", "position_offset", "channel_delay"])


@kind
def unsigned_display(rng, folder):
    """The bench shows the size of torque and speed; the drive's angle and current have signs."""
    c = start(rng, folder, FAMILIES[4], 0.003)
    for pt in loads(c.m, rng, 7):
        r = record(c.m, c.s, pt, rng)
        r["torque"], r["speed"] = abs(r["torque"]), abs(r["speed"])
        plain(c, r, pt["role"])
    return c.says(outside=True)


@kind
def percent_of_rated(rng, folder):
    """The drive's trace has current and torque in per cent of the rated ones."""
    c = start(rng, folder)
    m = c.m
    for pt in loads(m, rng, 4):
        r = record(m, c.s, pt, rng)
        c.add(["time [s]", "theta_m [deg]", "iq [%]", "torque [%]"], [r["t"], np.degrees(r["angle"]) % 360, r["q"] / m.rated["i"] * 100,
              r["torque"] / m.rated["torque"] * 100], pt["role"])
    return c.says(refuse=True)


def build(name, seed, folder):
    """Writes one case; returns its Case with the true machine."""
    rng = np.random.default_rng([seed, sum(ord(x) * (i + 1) for i, x in enumerate(name))])
    os.makedirs(folder, exist_ok=True)
    return KINDS[name](rng, folder).close()


# ------------------------------------------------------------------ the equations against themselves
def selftest():
    """Each line: a relation in closed form and how far it is off."""
    rng = np.random.default_rng(1)
    worst = []

    def check(words, error, most):
        worst.append(error <= most)
        print("%-72s %.2e %s" % (words, error, "ok" if error <= most else "WRONG"))

    m = machine(rng, FAMILIES[0], 0.0)
    m.emf = {1: (0.5, 0.0)}
    th = np.linspace(0, TAU, 97)[:-1]
    a = th / m.p
    d, q = to_dq(th, to_abc(th, 1.3 + 0 * th, -2.1 + 0 * th))
    check("Park there and back", max(abs(d - 1.3).max(), abs(q + 2.1).max()), 1e-12)
    check("torque of a sine: 3/2 E i_q", abs(m.torque(a, to_abc(th, 0 * th, 2 + 0 * th)) - 1.5).max(), 1e-12)
    m.emf[5] = (0.02, 0.7)
    want = 1.5 - 1.5 * 0.02 * 2 * np.cos(6 * th + 0.7)
    got = m.torque(a, to_abc(th, 0 * th, 2 + 0 * th))
    check("order 6 of a 5th of the back-EMF: -3/2 i E5 cos(6 th + phase)", abs(got - want).max(), 1e-12)
    m.emf = {1: (0.5, 0.0)}
    m.ld, m.lq = 1e-3, 3e-3
    check("saliency: 3/2 p (Ld - Lq) id iq", abs(m.torque(a, to_abc(th, 1 + 0 * th, 2 + 0 * th)) - 1.5 - 1.5 * m.p * -2e-3 * 2).max(), 1e-12)
    A, B = (m.ld + m.lq) / 3, (m.ld - m.lq) / 3

    def table(x):
        L = np.zeros((3, 3))
        for i, k in enumerate((0, 2, 4)):
            L[i, i] = A + B * math.cos(2 * x - k * TAU / 3)
        for (i, j), k in zip(((0, 1), (1, 2), (2, 0)), (1, 0, 2)):
            L[i, j] = L[j, i] = -A / 2 + B * math.cos(2 * x - k * TAU / 3)
        return L
    i = to_abc(np.array([0.4]), 1.0, 2.0)[:, 0]
    slope = m.p * (table(0.4 + 1e-5) - table(0.4 - 1e-5)) / 2e-5
    check("the table of inductances makes that saliency", abs(0.5 * i @ slope @ i - 1.5 * m.p * -2e-3 * 2), 1e-8)
    lam = table(0.4) @ i
    d2, q2 = to_dq(0.4, lam)
    check("and that flux: Ld id, Lq iq", max(abs(d2 - m.ld), abs(q2 - 2 * m.lq)), 1e-12)
    m.ld = m.lq = 0
    m.iron = (8.0, 12.0)
    i_f, i_s = m.iron
    L = 0.5 * math.sqrt(1 + (i_f / i_s) ** 2) / (m.p * i_f)

    def coenergy(x, i):
        d, q = to_dq(x, i)
        return 1.5 * L * i_s ** 2 * (math.sqrt(1 + ((d + i_f) ** 2 + q ** 2) / i_s ** 2) - 1)
    i = to_abc(np.array([0.9]), -3.0, 7.0)[:, 0]
    slope = m.p * (coenergy(0.9 + 1e-5, i) - coenergy(0.9 - 1e-5, i)) / 2e-5
    check("torque of the iron is the slope of its co-energy", abs(slope - m.torque(np.array([0.9 / m.p]), i[:, None])[0]), 1e-7)
    m.iron = None
    coils = sum_of_coils(5, 12, a, 1.0, False)
    th5 = 5 * a
    check("coils of a sound rotor: a sine a phase, a third apart",
          max(abs(coils[s] - np.sin(th5 - s * TAU / 3)).max() for s in range(3)), 1e-9)
    lost = sum(sum_of_coils(5, 12, a - TAU * j / 10, 1.0, True) * (-1) ** j for j in range(10))
    check("all magnets lost: all of the back-EMF", abs(lost - coils).max(), 1e-9)
    s = Sensors(m, rng)
    s.torque_noise, s.current_noise, s.angle_step, s.ripple = 0, 0, 0, (0.0, 0.0)
    s.torque_tau = 2e-3
    m.cog = {24: (0.1, 0.3)}
    r = record(m, s, point(0, 2, 300, 2000, 4), rng)
    w = 24 * 300 * TAU / 60
    g = 1 / (1 + 1j * w * s.torque_tau)
    want = 1.5 + 0.1 * abs(g) * np.sin(24 * r["true_angle"] + 0.3 + np.angle(g))
    check("a lag against its gain and phase", abs(r["torque"] - want).max(), 2e-5)
    m.cog, m.friction = {}, (0.05, 0.01, 0.0)
    t, x, v, _, _ = run_free(m, 0.02, lambda *_: (0.0, 0.0), 0.5, 1e-3, rng, speed=40.0)
    want = (40 + 5) * np.exp(-t * 0.5) - 5
    check("running out: (w0 + c/B) exp(-B t/J) - c/B", abs(v - want).max(), 1e-4)
    m.friction, m.mech = (0, 0, 0), {1: (-0.4, 0.0)}
    t, x, v, _, _ = run_free(m, 0.05, lambda *_: (0.0, 0.0), 4.0, 1e-3, rng, start=1.0)
    check("a pendulum keeps its energy", abs(0.025 * v ** 2 - 0.4 * np.cos(x) + 0.4 * math.cos(1.0)).max(), 2e-5)
    m.mech = {}
    m.cog, m.friction = {24: (0.05, 0.4)}, (0.02, 0.0, 0.0)
    c = Case(rng, "", m)
    t, x, v, q = crawl(c, rng, 0.0)
    left = m.torque(x, to_abc(m.p * x, 0 * x, q)) + m.cogging(x) - m.drag(v)
    check("a crawling shaft is in equilibrium", abs(left).max(), 1e-12)
    m.triplen = (0.05, 1.0, 1e-3)
    power = m.circulating(th, 20.0).mean() * 20
    i0 = 0.05 * 20 / math.hypot(1.0, 3 * m.p * 20 * 1e-3)
    check("a closed delta: braking power is 3 R i0^2 / 2", abs(power + 1.5 * i0 ** 2), 1e-9)
    i = rectifier(th, 3.0)
    check("currents of the bridge sum to nothing", abs(i.sum(0)).max(), 1e-12)
    check("and brake: their mean torque has the sign", max(0.0, (np.array([np.sin(th - s * TAU / 3) for s in range(3)]) * i).sum(0).mean()), 0.0)
    print("all well" if all(worst) else "WRONG")
    return 0 if all(worst) else 1


def main():
    if sys.argv[1:] == ["--list"]:
        for name, f in KINDS.items():
            print("%-28s %s" % (name, " ".join((f.__doc__ or "").split())))
    elif sys.argv[1:] in (["--selftest"], ["--verify"]):
        return selftest()
    elif len(sys.argv) == 4:
        build(sys.argv[1], int(sys.argv[2]), sys.argv[3])
    else:
        print(__doc__)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
