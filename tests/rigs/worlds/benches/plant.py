"""The plant: motors, sensors, recordings and what can be hidden in them. All equations are this file's own.

Conventions: theta = p theta_m; e_s = sum S sin n(theta - s 2pi/3) + C cos n(theta - s 2pi/3); i_a = i_q sin theta - i_d cos theta.
"""
import os
from types import SimpleNamespace as NS
import numpy as np

PI = np.pi
LAG = (np.arange(3) * 2 * PI / 3)[:, None]


def phases(i_d, i_q, th):
    """Phase currents of a vector in the rotor's frame."""
    return i_q * np.sin(th - LAG) - i_d * np.cos(th - LAG)


def park(i, th):
    """The vector in the rotor's frame of three phase currents."""
    return -(2 / 3) * (i * np.cos(th - LAG)).sum(0), (2 / 3) * (i * np.sin(th - LAG)).sum(0)


def wave(orders, th):
    """sum S sin n th + C cos n th."""
    return sum((s * np.sin(n * th) + c * np.cos(n * th) for n, (s, c) in orders.items()), 0 * th)


class Motor:
    """A machine: `torque` in the air gap and `shaft` at the sensor, for a state of arrays."""

    def __init__(self, p, slots, k, amps, emf, cog):
        self.p, self.slots, self.k, self.amps = p, slots, k, amps
        self.emf, self.cog = {1: (k, 0.0), **emf}, dict(cog)
        self.rated, self.ld, self.lq, self.inertia = 1.5 * k * amps, 0.0, 0.0, None
        self.air, self.drag, self.phase, self.alpha, self.magnet, self.tref = [], [], np.zeros((3, 1)), 0.0, {}, 20.0
        self.neutral, self.declares_l, self.speed = False, False, 100.0

    def copy(self):
        other = Motor(self.p, self.slots, self.k, self.amps, {}, {})
        other.__dict__.update({key: (v.copy() if hasattr(v, "copy") else v) for key, v in self.__dict__.items()})
        return other

    def e(self, th):
        return (1 + self.phase) * wave(self.emf, th - LAG)

    def torque(self, s):
        """Air-gap torque; flux of magnets scales e by 1 + M and cogging by its square."""
        flux = 1 + wave(self.magnet, s.th) + self.alpha * (s.temp - self.tref)
        t = (self.e(s.th) * s.i).sum(0) * flux + wave(self.cog, s.th) * (1 + wave(self.magnet, s.th)) ** 2
        t = t + 1.5 * self.p * (self.ld - self.lq) * s.id * s.iq
        return t + sum((f(s) for f in self.air), 0 * t)

    def shaft(self, s):
        return self.torque(s) - sum((f(s) for f in self.drag), 0 * s.th)

    def state(self, q, t):
        """What is true at the instants t of the run q."""
        w0, a, sw, kk = q["w"], q.get("ramp", 0.0), q.get("swing", 0.0), max(q.get("swing_k", 1), 1)
        x = w0 * t
        thm = q.get("th0", 0.3) + x + a * t * t / 2 + sw / kk * np.sin(kk * x)
        w = w0 + a * t + sw * w0 * np.cos(kk * x)
        acc = a - sw * kk * w0 ** 2 * np.sin(kk * x) + 0 * t
        if "motion" in q:
            thm, w, acc = q["motion"](t)
        if "steps" in q:  # a rotor that is moved to one place after another
            thm, w, acc = q["steps"](t), 0 * t, 0 * t
        th, scale = self.p * thm, q["amp"](t) if "amp" in q else 1.0
        dc = q.get("dc", 0.0) * np.sin(2 * PI * 300 * t + 0.4)
        i_d, i_q = q.get("id", 0.0) * scale + 0.6 * dc, q.get("iq", 0.0) * scale + dc
        i = q["abc"](t, th) if "abc" in q else phases(i_d, i_q, th)
        for n, seq, amp in q.get("inject", []):
            i = i + amp * np.sin(n * th - seq * LAG + 0.5)
        i_d, i_q = park(i, th)
        temp = q.get("temp", 20.0) + q.get("heat", 0.0) * t / q["T"]
        return NS(t=t, thm=thm, th=th, w=w, acc=acc, id=i_d, iq=i_q, i=i, temp=temp + 0 * t)


def bench(r, m, noise=1.0):
    """Sensors that err in nothing but noise."""
    return NS(sT=noise * m.rated * r.uniform(.003, .006), si=noise * m.amps * r.uniform(.001, .003), counts=int(r.choice([0, 8192, 16384, 131072])), off=0.0, load=0.0,
              ecc={}, harm={}, d_ang=0.0, d_cur=0.0, d_T=0.0, gain=np.zeros((3, 1)), ofs=np.zeros((3, 1)), tau_i=0.0, tau=0.0, fn=0.0,
              zeta=.05, gT=0.0, oT=0.0, drift=0.0, hum=0.0, bend=0.0, cubic=0.0, belt=(0.0, 0.0), backlash=0.0, lost=0.0, clock=0.0, two_sided=0.0, hum_phase=lambda: 1.0)


def through(fun, t, response, pre):
    """fun(t) through a linear filter, by Fourier on a grid eight times as fine that begins long before."""
    h = (t[1] - t[0]) / 8
    a, z = int(pre / h / 8 + 1) * 8, int(pre / h / 8 / 4 + 1) * 8
    y = fun(t[0] + h * np.arange(-a, 8 * (len(t) - 1) + 1 + z))
    w = 2 * PI * np.fft.rfftfreq(y.shape[-1], h)
    return np.fft.irfft(np.fft.rfft(y) * response(1j * w), y.shape[-1])[..., a:a + 8 * (len(t) - 1) + 1:8]


def record(m, b, q, r):
    """The readings of one run: a dict of arrays."""
    n = q["n"]
    t = q.get("t", (np.arange(n) + r.uniform()) * q["T"] / n)
    at = lambda d: m.state(q, t - d)
    s = at(0)
    a = at(b.d_ang)
    thm = a.thm + wave(b.ecc, a.thm) + (b.off + wave(b.harm, a.th) + b.load * a.iq + b.backlash * np.sign(m.torque(a)) - b.lost * (a.thm - a.thm[0])) / m.p
    thm = np.round(thm * b.counts / (2 * PI)) * 2 * PI / b.counts if b.counts else thm
    i = at(b.d_cur).i
    if b.tau_i:
        i = through(lambda x: m.state(q, x - b.d_cur).i, t, lambda p: 1 / (1 + b.tau_i * p), 12 * b.tau_i)
    i = (1 + b.gain) * (i - b.cubic * i ** 3) + b.ofs + r.normal(0, 1, i.shape) * b.si
    T = m.shaft(m.state(q, t - b.d_T + b.clock * (t - t[0])))
    if b.tau or b.fn:
        wn = 2 * PI * b.fn
        g = lambda p: 1 / (1 + b.tau * p) / ((1 + 2 * b.zeta * p / wn + (p / wn) ** 2) if b.fn else 1)
        T = through(lambda x: m.shaft(m.state(q, x - b.d_T)), t, g, 12 * b.tau + (8 / (b.zeta * wn) if b.fn else 0))
    T = (1 + b.gT) * T + b.bend * T ** 2 + b.oT + q.get("zero", 0.0) + b.drift * (t - t[0])
    T = T * (1 + b.two_sided * (T > 0)) + b.hum * np.sin(2 * PI * 50 * t + b.hum_phase()) + b.belt[0] * np.sin(b.belt[1] * s.thm + 1) + r.normal(0, b.sT, n)
    i_d, i_q = park(i, m.p * thm)
    v = s.w * m.e(s.th) + r.normal(0, .002 * m.k * m.speed, (3, n))
    rpm = s.w * 30 / PI + r.normal(0, 2e-4 * m.speed * 30 / PI, n)
    return dict(t=t, thm=thm, the=m.p * thm, wrapped=m.p * thm % (2 * PI), rpm=rpm, ia=i[0], ib=i[1], ic=i[2], id=i_d, iq=i_q, T=T, temp=s.temp + r.normal(0, .2, n),
                vab=v[0] - v[1], vbc=v[1] - v[2], true=s)


FULL = [("time_s", "t"), ("theta_m_rad", "thm"), ("speed_rpm", "rpm"), ("ia_A", "ia"), ("ib_A", "ib"), ("ic_A", "ic"), ("torque_Nm", "T")]
HEAT = FULL + [("temperature_C", "temp")]
DQ = [("time_s", "t"), ("theta_m_rad", "thm"), ("id_A", "id"), ("iq_A", "iq"), ("torque_Nm", "T")]


def text(d, cols, sep=",", comma=False, head=()):
    """The file of a run. A column is (name, key) or (name, key, factor)."""
    x = np.column_stack([d[c[1]] * (c[2] if len(c) > 2 else 1) for c in cols])
    body = "\n".join(sep.join("%.8g" % v for v in row) for row in x)
    return "\n".join(list(head) + [sep.join(c[0] for c in cols)]) + "\n" + (body.replace(".", ",") if comma else body) + "\n"


class World:
    """What is written, and what is true of it. `hidden`: effect -> parameter -> value (None: not compared). `also`: other true
    names of it. `same`: effects that make the same in these data; then only an ambiguous or open answer is fair. `outside`:
    something is hidden that no effect is. `slip`: words that a fair answer may hold. `disagrees`: the one bad
    file. `innocent`: words that would accuse what is in order."""

    def __init__(self, declared, plant, hidden=None, **k):
        self.d, self.m, self.hidden, self.runs, self.args = declared, plant, hidden or {}, [], []
        self.also, self.same, self.outside, self.slip, self.disagrees, self.effects, self.innocent = set(), set(), False, "", "", "", ""
        self.refusal, self.bound, self.top, self.fast, self.off = False, True, 0.0, 0.1, 0.0
        self.__dict__.update(k)

    def add(self, name, data, cols=FULL, role="fit", **k):
        if not isinstance(data, str) and "rpm" in data:
            self.fast = max(self.fast, np.max(np.abs(data["rpm"])) * PI / 30)
        self.runs.append((name + ".csv", role, data if isinstance(data, str) else text(data, cols, **k)))
        if not isinstance(data, str) and "true" in data:
            self.top = max(self.top, abs(np.mean(self.m.torque(data["true"]))))
        return self

    def write(self, folder):
        d, put = self.d, lambda n, s: open(os.path.join(folder, n), "w", encoding="utf-8").write(s)
        os.makedirs(os.path.join(folder, "machine"), exist_ok=True)
        rows = [("pole_pairs", d.p, 1), ("slots", d.slots, 1), ("rated_current", d.amps, "A"), ("rated_torque", 1.5 * d.k * d.amps, "Nm"),
                ("rated_speed", d.speed, "rad_per_s"), ("connection", "star-neutral" if d.neutral else "star", "")]
        rows += [("inertia", d.inertia, "kgm2")] if d.inertia else []
        put("machine/machine.csv", "name,value,unit\n" + "".join(f"{a},{b},{c}\n" for a, b, c in rows))
        for f, unit, tab in (("back_emf", "Nm_per_A", d.emf), ("cogging", "Nm", d.cog)):
            put(f"machine/{f}.csv", f"order,amplitude_{unit},phase_rad\n" + "".join(
                f"{n:g},{np.hypot(s, c):.9g},{np.arctan2(c, s):.9g}\n" for n, (s, c) in sorted(tab.items())))
        if d.declares_l:
            th = np.arange(72) * 2 * PI / 72
            l = inductance(d, th)
            put("machine/inductance.csv", "theta_e_rad,La_H,Lb_H,Lc_H,Mab_H,Mbc_H,Mca_H\n" + "".join(
                "%.9g," % x + ",".join("%.9g" % y for y in (a[0, 0], a[1, 1], a[2, 2], a[0, 1], a[1, 2], a[2, 0])) + "\n" for x, a in zip(th, l)))
        if self.effects:
            put("machine/effects.csv", "effect,parameter,value,unit\n" + self.effects)
        for name, _, s in self.runs:
            put(name, s)
        put("runs.csv", "file,role\n" + "".join(f"{n},{role}\n" for n, role, _ in self.runs))
        put("target.csv", f"order,amplitude_Nm,phase_rad\n0,{0.55 * (self.top if self.top > .1 * self.m.rated else self.m.rated):.6g},0\n")


def inductance(m, th):
    """Phase inductances over the angle, with which half i L i is 3/2 (Ld id^2 + Lq iq^2)/2 in star."""
    c, s = -np.cos(th - LAG).T, np.sin(th - LAG).T
    return 2 / 3 * (m.ld * c[:, :, None] * c[:, None] + m.lq * s[:, :, None] * s[:, None]) + .1 * m.ld


# Motors.

def motor(r, p=None, big=False):
    """A motor that could be bought; cogging and harmonics as usual."""
    p = p or int(r.choice([2, 3, 4, 5, 7]))
    slots = {2: 24, 3: 18, 4: 12, 5: 12, 7: 12, 10: 24, 15: 27}[p]
    k, amps = (r.uniform(.3, .6), r.uniform(60, 150)) if big else (r.uniform(.08, .8), r.uniform(3, 12))
    c = np.lcm(slots, 2 * p) // p
    ph = lambda a: (lambda g: (a * np.cos(g), a * np.sin(g)))(r.uniform(-PI, PI))
    emf = {n: ((-1) ** j * k * r.uniform(.3, 1) * a, 0.0) for j, (n, a) in enumerate([(5, .03), (7, .02), (11, .008), (13, .005)])}
    m = Motor(p, slots, k, amps, emf, {c: ph(1.5 * k * amps * r.uniform(.01, .03)), 2 * c: ph(1.5 * k * amps * r.uniform(.003, .008))})
    m.speed = r.uniform(60, 200) / (1 + (p > 5))
    m.c = c
    return m


def salient(r, m):
    """Inductances of an interior magnet: at rated current a third to a half of the magnets' torque."""
    m.lq = r.uniform(1.2, 2) * m.k / m.p / m.amps * .6
    m.ld = m.lq * r.uniform(.45, .65)
    return m


def iron(r, m):
    """Saturation as iron does it: one co-energy W(id, iq, theta), its torque by derivatives written out."""
    p, i1, lm, c, a6, g6 = m.p, m.amps * r.uniform(1.2, 2), m.k / m.p, r.uniform(.15, .3), r.uniform(.01, .02), r.uniform(-PI, PI)

    def w(i_d, i_q, th):
        u = i_q ** 2 / (i_q ** 2 + i1 ** 2)
        return 1.5 * (-lm * i_d * c * u + m.lq * i1 ** 2 * (np.log(np.cosh(i_q / i1)) - .5 * (i_q / i1) ** 2)
                      + lm * m.amps * a6 * np.cos(6 * th + g6) * u * (1 - .4 * np.tanh(i_d / i1)))

    def torque(s):
        h, t = 1e-4 * m.amps, 1e-4
        dw = lambda a, b, x: w(s.id + a, s.iq + b, s.th + x) - w(s.id - a, s.iq - b, s.th - x)
        return p * (dw(0, 0, t) / (2 * t) + s.iq * dw(h, 0, 0) / (2 * h) - s.id * dw(0, h, 0) / (2 * h))
    m.co_energy = w
    m.air.append(torque)
    return m


# What can be hidden. Each changes plant or bench and returns the truth in the catalogue's terms.

def sgn(r):
    return float(r.choice([-1, 1]))


def add_to(tab, n, s, c):
    tab[n] = (tab.get(n, (0, 0))[0] + s, tab.get(n, (0, 0))[1] + c)


def h_friction(r, m, b, z):
    tc, bv = m.rated * r.uniform(.02, .05) * z, m.rated * r.uniform(.01, .03) * z / m.speed
    m.drag.append(lambda s: tc * np.sign(s.w) + bv * s.w)
    return {"friction": {"coulomb": tc, "viscous": bv}}


def h_stribeck(r, m, b, z):
    ts, ws = m.rated * r.uniform(.03, .05) * z, m.speed * r.uniform(.05, .09)
    m.drag.append(lambda s: ts * np.exp(-(s.w / ws) ** 2) * np.sign(s.w))
    return {"stribeck_friction": {"excess": ts, "speed": ws}}


def h_iron_drag(r, m, b, z):
    h, e = m.rated / m.amps ** 2 * r.uniform(.02, .04) * z, m.rated / m.amps ** 2 * r.uniform(.01, .03) * z / m.speed
    m.drag.append(lambda s: (h * np.sign(s.w) + e * s.w) * (s.id ** 2 + s.iq ** 2))
    return {"iron_drag": {"hysteresis": h, "eddy": e}}


def h_cogging(r, m, b, z):
    n, a, g = m.c * int(r.choice([1, 2, 18 // m.c])), m.rated * r.uniform(.01, .03) * z, r.uniform(-PI, PI)
    add_to(m.cog, n, a * np.cos(g), a * np.sin(g))
    return {"cogging": {f"sine_{n}": a * np.cos(g), f"cosine_{n}": a * np.sin(g)}}


def h_back_emf(r, m, b, z, n=None):
    n = n or int(r.choice([5, 7, 11, 13]))
    a = m.k * r.uniform(.02, .04) * z * sgn(r)
    add_to(m.emf, n, a, 0.0)
    return {"back_emf": {f"sine_{n}": a}}


def h_reluctance(r, m, b, z):
    salient(r, m)
    return {"reluctance": {"Ld-Lq": m.ld - m.lq}}


def h_imbalance(r, m, b, z):
    j = int(r.integers(3))
    m.phase[j] = -r.uniform(.02, .05) * z
    return {"phase_imbalance": {"abc"[j]: float(m.phase[j, 0])}}


def h_temperature(r, m, b, z):
    m.alpha = float(r.choice([-.0011, -.002])) * z
    return {"magnet_temperature": {"emf_per_kelvin": m.alpha}}


def h_order(r, m, b, z, k=None, loaded=False):
    k = k or int(r.choice([1, 2, 9, 17]))
    n, a, g = k / m.p, m.rated * r.uniform(.02, .04) * z, r.uniform(-PI, PI)
    m.air.append(lambda s: a * np.sin(k * s.thm + g) * (s.iq / m.amps if loaded else 1))
    pre, u = ("iq_", m.amps) if loaded else ("", 1)
    return {"cogging" if k % m.p == 0 and not loaded else "mechanical_order": {f"{pre}sine_{n:g}": a * np.cos(g) / u, f"{pre}cosine_{n:g}": a * np.sin(g) / u}}


def h_magnet(r, m, b, z):
    a, g = r.uniform(.02, .04) * z, r.uniform(-PI, PI)
    m.magnet[1 / m.p] = (a * np.cos(g), a * np.sin(g))
    return {"unequal_magnets": {f"sine_{1 / m.p:g}": a * np.cos(g), f"cosine_{1 / m.p:g}": a * np.sin(g)}}


def h_offset_angle(r, m, b, z):
    b.off = sgn(r) * r.uniform(.05, .15) * z
    return {"position_offset": {"angle": b.off}}


def h_eccentric(r, m, b, z):
    a, g = r.uniform(.01, .03) * z / m.p, r.uniform(-PI, PI)
    b.ecc[1] = (a * np.cos(g), a * np.sin(g))
    return {"position_eccentricity": {"mech_sine_1": b.ecc[1][0], "mech_cosine_1": b.ecc[1][1]}}


def h_resolver(r, m, b, z):
    a, g = r.uniform(.01, .03) * z, r.uniform(-PI, PI)
    b.harm[2] = (a * np.cos(g), a * np.sin(g))
    return {"position_harmonics": {"sine_2": b.harm[2][0], "cosine_2": b.harm[2][1]}}


def h_load(r, m, b, z):
    b.load = r.uniform(.05, .12) * z / m.amps
    return {"position_load": {"per_ampere": b.load}}


def h_gain(r, m, b, z):
    j = int(r.integers(3))
    b.gain[j] = sgn(r) * r.uniform(.02, .05) * z
    return {"current_gain": {"abc"[j]: float(b.gain[j, 0])}}


def h_offset(r, m, b, z):
    j = int(r.integers(3))
    b.ofs[j] = sgn(r) * r.uniform(.01, .03) * m.amps * z
    return {"current_offset": {"abc"[j]: float(b.ofs[j, 0])}}


def h_filter(r, m, b, z):
    b.tau_i = r.uniform(.5, .8) / (m.p * m.speed)
    return {"current_filter": {"time_constant": b.tau_i}}


def h_delay(r, m, b, z):
    b.d_cur = r.uniform(.05, .12) / (m.p * m.speed)
    return {"channel_delay": {"current": b.d_cur}}


def h_torque_gain(r, m, b, z):
    b.gT = sgn(r) * r.uniform(.05, .1)
    return {"torque_gain": {"gain": b.gT}}


def h_lag(r, m, b, z):
    b.tau = r.uniform(.5, 1.5) / (m.c * m.p * m.speed)
    return {"torque_sensor": {"time_constant": b.tau}}


def h_resonance(r, m, b, z):
    b.fn, b.zeta = r.uniform(1.2, 1.6) * m.c * m.p * m.speed / 2 / PI / 2, r.uniform(.03, .08)
    return {"torque_sensor": {"natural_frequency": b.fn}}


def h_zero(r, m, b, z):
    b.oT = sgn(r) * r.uniform(.02, .04) * m.rated
    return {"torque_sensor": {"offset": b.oT}}


def hide(r, m, b, *what, z=1.0):
    """Hides several; returns hidden of all."""
    out = {}
    for w in what:
        for e, v in globals()["h_" + w](r, m, b, z).items():
            out.setdefault(e, {}).update(v)
    return out


# Plans: what is run on the bench. (current share, current angle, speed share, role)

EIGHT = [(0, 0, .2, "fit"), (0, 0, -.2, "fit"), (1, 0, .2, "fit"), (.5, .6, -.9, "fit"), (1, -.4, .8, "fit"), (1, PI, -.25, "fit"),
         (.25, 0, .9, "fit"), (.75, .3, -.5, "holdout")]
TWELVE = EIGHT + [(.6, -.5, -.07, "fit"), (.9, .5, .05, "fit"), (.4, PI, .4, "fit"), (0, 0, .95, "fit"), (.8, PI - .4, .6, "holdout")]
MANY = EIGHT + [(.3, .9, .3, "fit"), (.6, .9, -.3, "fit"), (1, 1, .3, "fit"), (.85, -.3, .4, "fit"), (.4, -.8, -.3, "fit"), (.7, PI, .3, "fit"),
                (.7, PI - .7, -.4, "fit"), (.9, .2, .5, "fit"), (.55, .5, .4, "holdout")]


def run(m, r, share, angle, speed, n=0, turns=12.3, **k):
    """One steady run."""
    n = n or max(4000, 1200 * m.p)
    amp, w = share * m.amps, speed * m.speed
    return dict(id=-amp * np.sin(angle), iq=amp * np.cos(angle), w=w, n=n, T=2 * PI * turns / abs(w), th0=r.uniform(0, 2 * PI), **k)


def fill(world, b, r, plan=EIGHT, cols=FULL, vary=lambda j: {}, **k):
    """Records a plan into the world."""
    for j, (share, angle, speed, role) in enumerate(plan):
        q = run(world.m, r, share, angle, speed, **{**{a: v for a, v in k.items() if a in ("n", "turns")}, **vary(j)})
        world.add(f"run{j}", record(world.m, b, q, r), cols, role, **{a: v for a, v in k.items() if a not in ("n", "turns")})
    return world


KINDS = {}


def kind(f):
    KINDS[f.__name__] = f
    return f


def single(name, *what, plan=EIGHT, cols=FULL, also=(), same=(), vary=None, prep=None, z=1.0, p=None, noise=1.0, **k):
    """A kind that hides `what` on a usual bench."""
    def f(r):
        d = motor(r, p)
        if prep:
            prep(r, d)
        m, b = d.copy(), bench(r, d, noise)
        w = World(d, m, hide(r, m, b, *what, z=z), also=set(also), same=set(same))
        w.off = b.off
        return fill(w, b, r, plan, cols, vary=(lambda j: vary(r, m, j)) if vary else (lambda j: {}), **k)
    f.__name__ = name
    return kind(f)
