#!/usr/bin/env python3
"""Worlds of a hobby / robotics bench. python3 world.py KIND SEED OUT | --list | --selftest
Own physics, standard library only, deterministic by (kind, seed). See README.md."""
import json, math, os, random, shutil, sys
PI = math.pi; TAU = 2 * PI; S3 = math.sqrt(3.0); D3 = TAU / 3
sin, cos = math.sin, math.cos

# ---------------------------------------------------------------- machines: name, p, slots, kt (N.m per A of i_q), rated A, J, fric Tc/T_rated, B*1000rpm/T_rated, R, L
MOTORS = {
 "gm2804":   (7, 12, 0.078, 1.2, 6.5e-6, .020, .010, 5.1, 1.4e-3),
 "gbm5208":  (7, 12, 0.30, 1.5, 4.2e-5, .018, .008, 8.0, 3.5e-3),
 "mn4004":   (12, 18, 0.0318, 9.0, 1.6e-5, .015, .010, .118, 35e-6),
 "mj5208":   (7, 12, 0.0255, 20.0, 2.4e-5, .012, .012, .047, 28e-6),
 "u8lite":   (21, 36, 0.0955, 18.0, 1.2e-4, .012, .008, .09, 60e-6),
 "d6374":    (7, 12, 0.0551, 45.0, 2.9e-4, .010, .015, .039, 15.7e-6),
 "hub15":    (15, 27, 0.52, 15.0, 3.8e-3, .012, .006, .16, 280e-6),
 "eagle28":  (14, 24, 0.115, 10.0, 6.0e-5, .015, .010, .22, 120e-6),
}
IPM = (4, 24, 0.30, 60.0, 2.6e-3, .008, .006, .012, 120e-6)

class World: pass

def motor(rng, names=None, ipm=False):
    m = World()
    m.name = "scooter_ipm" if ipm else rng.choice(names or sorted(MOTORS))
    p, z, kt, ir, J, fc, fb, R, L = IPM if ipm else MOTORS[m.name]
    v = lambda: rng.uniform(.92, 1.08)
    m.p, m.slots, m.ir, m.R, m.L = p, z, ir, R * v(), L * v()
    m.kt = kt * v(); m.K = m.kt / 1.5; m.J = J * v(); m.tr = m.kt * ir
    m.emf = [(1, m.K, 0.0)]                   # true: order, N.m/A, phase
    m.cog = []                                # true: (events per mechanical turn, N.m, phase)
    m.Tc, m.B, m.Q = m.tr * fc * v(), m.tr * fb * v() / 104.7, 0.0
    m.weak = [0.0, 0.0, 0.0]; m.Ld = m.Lq = m.L
    m.isat = 0.0                              # 0: linear iron
    m.log_speed = rng.random() < .5           # half of the home-made logs have a column of speed
    m.declared_kt = m.kt
    m.extra = None                            # extra(theta_m, omega) N.m on the shaft
    m.temp_alpha = 0.0; m.temp = 20.0
    return m

def lcm(a, b): return a * b // math.gcd(a, b)

def true_cogging(m, rng, scale=1.0, uneven=True):
    """order lcm(slots, poles), and where magnets / slots are uneven the slot and pole orders"""
    n = lcm(m.slots, 2 * m.p)
    m.cog = [(n, scale * m.tr * rng.uniform(.02, .04), rng.uniform(0, TAU))]
    if uneven:
        m.cog.append((m.slots, scale * m.tr * rng.uniform(.012, .03), rng.uniform(0, TAU)))
        if rng.random() < .6: m.cog.append((2 * m.slots, scale * m.tr * rng.uniform(.006, .015), rng.uniform(0, TAU)))
        if rng.random() < .6: m.cog.append((2 * m.p, scale * m.tr * rng.uniform(.008, .02), rng.uniform(0, TAU)))

class Bench:
    """what stands between the truth and the log; the drive regulates what it READS"""
    def __init__(self, delta_e=0.0, ecc=(), gain=(0, 0, 0), off=(0, 0, 0), shunts=3):
        self.delta_e, self.ecc, self.gain, self.off, self.shunts = delta_e, ecc, gain, off, shunts
        g, o = [1 + x for x in gain], off
        # readings r_s = g_s i_s + o_s, i = (x, -x/2 + S3/2 y, -x/2 - S3/2 y); the drive's Clarke of them = M (x, y) + c
        rows = [(g[0], 0.0, o[0]), (-g[1] / 2, S3 / 2 * g[1], o[1]), (-g[2] / 2, -S3 / 2 * g[2], o[2])]
        if shunts == 2: rows[2] = tuple(-rows[0][k] - rows[1][k] for k in range(3))
        al = [(2 * rows[0][k] - rows[1][k] - rows[2][k]) / 3 for k in range(3)]
        be = [(rows[1][k] - rows[2][k]) / S3 for k in range(3)]
        det = al[0] * be[1] - al[1] * be[0]
        self.inv = (be[1] / det, -al[1] / det, -be[0] / det, al[0] / det); self.c = (al[2], be[2]); self.rows = rows
    def read_angle(self, th, p):
        e = 0.0
        for k, S, C in self.ecc: e += S * sin(k * th) + C * cos(k * th)
        return th + e + self.delta_e / p
    def true_current(self, thr_e, idr, iqr):
        """phase currents (x, y of the stator plane) that flow when the drive reads exactly idr, iqr at its own angle"""
        a = iqr * sin(thr_e) - idr * cos(thr_e) - self.c[0]
        b = -iqr * cos(thr_e) - idr * sin(thr_e) - self.c[1]
        i = self.inv
        return i[0] * a + i[1] * b, i[2] * a + i[3] * b
    def readings(self, x, y):
        return [r[0] * x + r[1] * y + r[2] for r in self.rows]

def dq(x, y, the):                # i_q sin - i_d cos = x ; -i_q cos - i_d sin = y
    s, c = sin(the), cos(the)
    return -x * c - y * s, x * s - y * c      # id, iq

def cogging(m, th):
    t = 0.0
    for k, A, ph in m.cog: t += A * sin(k * th + ph)
    return t

def em_torque(m, th, x, y):
    """electromagnetic torque of phase currents at the true angle (cogging not included)"""
    the = m.p * th; t = 0.0
    ph = (x, -x / 2 + S3 / 2 * y, -x / 2 - S3 / 2 * y)
    if len(m.emf) == 1 and m.weak == [0.0, 0.0, 0.0]:
        i_d, i_q = dq(x, y, the); t = 1.5 * m.emf[0][1] * i_q
    else:
        for s in range(3):
            e = 0.0
            for n, A, g in m.emf: e += A * sin(n * (the - D3 * s) + g)
            t += (1 + m.weak[s]) * e * ph[s]
    if m.temp_alpha: t *= 1 + m.temp_alpha * (m.temp - 20)
    if m.Ld != m.Lq or m.isat:
        i_d, i_q = dq(x, y, the)
        t += 1.5 * m.p * (m.Ld - m.Lq) * i_d * i_q
        if m.isat:                # co-energy W' = 1.5 K/p i_d (g(i_q) - 1), g = 1/(1 + (i_q/I)^2)
            u = (i_q / m.isat) ** 2; g = 1 / (1 + u)
            t += 1.5 * m.K * (i_q * (g - 1) + i_d * i_d * 2 * i_q / m.isat ** 2 * g * g)
    return t

def drag(m, w):                   # braking torque at |w| > 0, with the sign of w
    return m.Tc * (1 if w > 0 else -1 if w < 0 else 0) + m.B * w + m.Q * w * abs(w)

def spin(m, b, T, dt, every, ctrl, th0=0.0, w0=0.0, fric=None):
    """J dw/dt = T_em + T_cog - drag; Karnopp stick at rest. ctrl(t, theta_read, omega) -> (id, iq) that the drive will read.
    every: log each n-th step. -> rows (t, theta, omega, id, iq, x, y, shaft torque without friction)"""
    th, w, rows, n = th0, w0, [], int(round(T / dt)); p = m.p
    for k in range(n):
        t = k * dt; thr = b.read_angle(th, p) if (b.ecc or b.delta_e) else th
        idr, iqr = ctrl(t, thr, w)
        x, y = b.true_current(p * thr, idr, iqr)
        tq = em_torque(m, th, x, y) + cogging(m, th)
        if m.extra: tq += m.extra(th, w)
        if k % every == 0: rows.append((t, th, w, idr, iqr, x, y, tq))
        f = fric(w) if fric else None
        if w == 0.0:
            tc = abs(fric(1e-9)) if fric else m.Tc
            if abs(tq) <= tc: continue
            wn = dt / m.J * (tq - math.copysign(tc, tq))
        else:
            wn = w + dt / m.J * (tq - (f if fric else drag(m, w)))
            if wn * w < 0 and abs(tq) <= m.Tc: wn = 0.0
        th += dt * (w + wn) / 2; w = wn
    return rows

def pid(m, ref, kp, kd, ki, lim):
    st = [0.0, 0.0]
    def c(t, thr, w):
        r, v = ref(t); e = r - thr
        st[0] = max(-lim, min(lim, st[0] + ki * e * (t - st[1]))); st[1] = t
        return 0.0, max(-lim, min(lim, kp * e + kd * (v - w) + st[0]))
    return c

def hold(m, b, th, torque, idr=0.0):
    """i_q (as the drive reads it) that makes `torque` at the standing rotor: secant, the torque is nearly linear"""
    thr = b.read_angle(th, m.p)
    f = lambda q: em_torque(m, th, *b.true_current(m.p * thr, idr, q)) + cogging(m, th) + (m.extra(th, 0) if m.extra else 0) - torque
    q0, q1 = 0.0, m.ir * .1
    f0, f1 = f(q0), f(q1)
    for _ in range(8):
        if f1 == f0: break
        q0, q1, f0 = q1, q1 - f1 * (q1 - q0) / (f1 - f0), f1; f1 = f(q1)
    return thr, q1

# ---------------------------------------------------------------- files
def num(v, d=7):
    if v is None: return ""
    if isinstance(v, str): return v
    s = "%.*g" % (d, v)
    return s

def write(out, m, decl, runs, truth):
    for d in ("/machine", "/runs", "/out"): shutil.rmtree(out + d, ignore_errors=True)
    os.makedirs(out + "/machine", exist_ok=True); os.makedirs(out + "/runs", exist_ok=True)
    def put(name, text):
        with open(out + "/" + name, "w", newline="") as f: f.write(text)
    rows = ["name,value,unit,source", "pole_pairs,%d,1,counted" % decl.get("pole_pairs", m.p)]
    if decl.get("slots", True): rows.append("slots,%d,1,counted" % m.slots)
    J = decl.get("J", m.J)
    if J: rows.append("inertia,%s,g*cm^2,CAD" % num(J * 1e7))
    rows.append("resistance,%s,ohm,multimeter" % num(m.R, 4))
    Ld, Lq = decl.get("Ldq", (m.Ld, m.Lq))
    rows += ["inductance_d,%s,uH,LCR" % num(Ld * 1e6, 4), "inductance_q,%s,uH,LCR" % num(Lq * 1e6, 4)]
    if decl.get("rated", True): rows.append("rated_current,%s,A,data sheet" % num(m.ir, 4))
    emf = decl.get("emf", m.emf)
    if decl.get("volts"):
        rows.append("emf_frequency,100,Hz,drill")
        k = TAU * 100 / decl.get("pole_pairs", m.p); head = "order,amplitude_V,phase_rad"
    else: k = 1.0; head = "order,amplitude_Nm_per_A,phase_rad"
    put("machine/machine.csv", "\n".join(rows) + "\n")
    put("machine/back_emf.csv", "\n".join([head] + ["%d,%s,%s" % (n, num(a * k), num(g)) for n, a, g in emf]) + "\n")
    cg = decl.get("cog", [])
    if cg: put("machine/cogging.csv", "\n".join(["order,amplitude_Nm,phase_rad"] + ["%.12g,%s,%s" % (n / m.p, num(a), num(g)) for n, a, g in cg]) + "\n")
    ef = decl.get("effects", [])
    if ef: put("machine/effects.csv", "\n".join(["effect,parameter,value,unit,std_error"] + ["%s,%s,%s,%s," % (e, q, num(v), u) for e, q, v, u in ef]) + "\n")
    lst = ["file,role"]
    for name, role, cols, sep in runs:
        n = len(cols[0][1]); L = [sep.join(c[0] for c in cols)]
        for i in range(n): L.append(sep.join(num(c[1][i]) for c in cols))
        put("runs/" + name + ".csv", "\n".join(L) + "\n"); lst.append("runs/%s.csv,%s" % (name, role))
    put("runs.csv", "\n".join(lst) + "\n")
    put("truth.json", json.dumps(truth, indent=1) + "\n")

def fric_known(m):
    L = [("friction", "coulomb", m.Tc, "Nm"), ("friction", "viscous", m.B, "Nms_per_rad")]
    if m.Q: L.append(("friction", "quadratic", m.Q, "Nms2_per_rad2"))
    return L

def quant(v, q): return round(v / q) * q

class Log:
    """turns rows of spin() into columns of a tool. Noise of the current per sample, encoder counts, stamps."""
    def __init__(self, rng, m, b, sig_i, counts=16384, enc_noise=0.0, stamp=0.0, zero=0.0):
        self.rng, self.m, self.b, self.sig, self.counts, self.en, self.stamp, self.zero = rng, m, b, sig_i, counts, enc_noise, stamp, zero
        self.speed = m.log_speed
    def angle(self, th):
        r = self.b.read_angle(th, self.m.p) + self.zero
        if self.en: r += self.rng.gauss(0, self.en)
        return quant(r, TAU / self.counts) if self.counts else r
    def cols(self, rows, style, temp=None, torque=None, abc=False, shift=None):
        g, m = self.rng.gauss, self.m
        t = [r[0] for r in rows]; th = [self.angle(r[1]) for r in rows]
        w, v = [], 0.0                         # the drive's own speed: slope of the angle as read, with the slow noise of a PLL
        for r in rows:
            v = .9 * v + g(0, .0004 * abs(r[2]) + .004); e = 1.0
            for k, S, C in self.b.ecc: e += k * (S * cos(k * r[1]) - C * sin(k * r[1]))
            w.append(r[2] * e + v)
        i_d = [quant(r[3] + g(0, self.sig), m.ir * 2e-4) for r in rows]; i_q = [quant(r[4] + g(0, self.sig), m.ir * 2e-4) for r in rows]
        ts = [quant(x, self.stamp) if self.stamp else x for x in t]
        if style == "moteus":
            c = [("timestamp", ["%.6f" % (1700000 + x) for x in ts]), ("position", [x / TAU for x in th]), ("velocity", [x / TAU for x in w]),
                 ("torque", [m.declared_kt * x for x in i_q]), ("q_current", i_q), ("d_current", i_d)]
            if temp is not None: c.append(("motor_temperature", [quant(x, .1) for x in temp]))
            return c, ","
        if style == "odrive":
            c = [("time (s)", ts), ("axis0.pos_estimate", [x / TAU for x in th]), ("axis0.vel_estimate", [x / TAU for x in w]),
                 ("axis0.motor.foc.Iq_measured", i_q), ("axis0.motor.foc.Id_measured", i_d)]
            return c, ","
        if style == "vesc":
            c = [("ms_today", [round(36e6 + 1e3 * x) for x in ts]), ("temp_motor", [quant(x, .1) for x in temp] if temp is not None else [31.0] * len(t)),
                 ("d_axis_current", [quant(x, .01) for x in i_d]), ("q_axis_current", [quant(x, .01) for x in i_q]), ("erpm", [round(x * m.p * 60 / TAU) for x in w]),
                 ("encoder_position", [quant(math.degrees(x) % 360, .01) for x in th])]
            c[0] = ("ms_today", ["%d" % x for x in c[0][1]])
            return c, ";"
        if style == "simplefoc":
            c = [("t_ms", ["%d" % round(1e3 * x) for x in ts]), ("shaft_angle", ["%.4f" % x for x in th]), ("shaft_velocity", ["%.3f" % x for x in w]),
                 ("current_q_mA", ["%.1f" % (1e3 * x) for x in i_q]), ("current_d_mA", ["%.1f" % (1e3 * x) for x in i_d])]
            return [("time_ms", c[0][1]), ("shaft_angle", c[1][1]), ("shaft_velocity", c[2][1]), ("iq_mA", c[3][1]), ("id_mA", c[4][1])], "\t"
        c = [("time_s", ["%.6f" % x for x in ts]), ("theta_m_rad", th)]
        if self.speed: c.append(("speed_rad_per_s", w))
        if abc:
            R = [self.b.readings(r[5], r[6]) for r in rows]
            for s in range(2 if self.b.shunts == 2 and abc != 3 else 3):
                c.append(("i%s_A" % "abc"[s], [quant(q[s] + g(0, self.sig), m.ir * 2e-4) for q in R]))
        else: c += [("iq_A", i_q), ("id_A", i_d)]
        if torque is not None: c.append(("torque_Nm", torque))
        if temp is not None: c.append(("temperature_C", [quant(x, .1) for x in temp]))
        return c, ","

# ---------------------------------------------------------------- recipes
def hold_map(m, b, rng, n, way, sig, start=0.0, turns=1.0, time=True, creep=.15, counts=16384, dwell=.05, scale_kt=1.0):
    """n steps a turn, way +1/-1: the rotor stands, friction holds against the last move (a little less where it crept)"""
    T, A, Q = [], [], []
    for k in range(int(n * turns)):
        th = start + way * TAU * k / n + rng.gauss(0, 2e-4)
        thr, q = hold(m, b, th, way * m.Tc * (1 - creep * rng.random()))
        T.append((k + 1) * dwell + rng.uniform(0, .003)); A.append(quant(thr, TAU / counts)); Q.append(quant(q + rng.gauss(0, sig), m.ir * 1e-4))
    c = [("theta_m_rad", A), ("iq_A", Q), ("torque_Nm", [0] * len(A))]
    if time: c.insert(0, ("time_s", T))
    return c

def slow(m, b, rng, rev_s, turns, rate, style, sig, counts=16384, stamp=0.0, bw=9.0, start=0.0, jitter=0.0, zero=0.0, fric=None, torque0=False):
    """position control at a crawl: theta_ref = start + w t, PID of bandwidth bw Hz; the log begins after it has settled"""
    w = TAU * rev_s; wn = TAU * bw; dt = 2.5e-4
    kp, kd = m.J * wn * wn / m.kt * 3, m.J * wn * 3 / m.kt; ki = kp * wn * .3
    ctrl = pid(m, lambda t: (start + w * t, w), kp, kd, ki, m.ir)
    T = turns / abs(rev_s) + .6
    if jitter:
        rows = spin(m, b, T, dt, 1, ctrl, start, w, fric); step = 1 / rate; r2 = []; t = .6
        while t < T - .05:
            r = rows[int((t + jitter * rng.random()) / dt)]; r2.append((t,) + r[1:]); t += step
        rows = r2
    else:
        every = max(1, int(round(1 / rate / dt))); rows = [r for r in spin(m, b, T, dt, every, ctrl, start, w, fric) if r[0] >= .6]
    L = Log(rng, m, b, sig, counts, 0.0, stamp, zero)
    return L.cols(rows, style, torque=[0] * len(rows) if torque0 else None)

def truth(kind, hidden, also=(), outside=False, answerable=True, **k):
    d = {"kind": kind, "hidden": sorted(hidden), "outside": outside, "also_right": [sorted(a) for a in also], "answerable": answerable}
    d.update(k); return d

KINDS = {}
def kind(f): KINDS[f.__name__] = f; return f

COG = lambda *more: [["cogging", "mechanical_order"] + list(more)]   # uneven magnets: slots orders may be called either

@kind
def hold_plain(rng, K):
    """holding map forward and back, cogging and friction hidden"""
    m = motor(rng); true_cogging(m, rng); b = Bench(); sig = .004 * m.ir
    n = max(720, 5 * lcm(m.slots, 2 * m.p)); t = rng.random() < .6
    R = [("forward", "fit", hold_map(m, b, rng, n, 1, sig, time=t), ","), ("backward", "fit", hold_map(m, b, rng, n, -1, sig, TAU, time=t), ","),
         ("again_forward", "holdout", hold_map(m, b, rng, n, 1, sig, 1.0, time=t), ",")]
    return m, {"J": 0 if rng.random() < .5 else m.J, "rated": rng.random() < .5}, R, truth(K, ["cogging", "friction"], COG("friction"))

@kind
def hold_known(rng, K):
    """the same, everything declared: nothing is missing"""
    m = motor(rng); true_cogging(m, rng); b = Bench(); sig = .006 * m.ir
    n = max(720, 5 * lcm(m.slots, 2 * m.p))
    R = [("forward", "fit", hold_map(m, b, rng, n, 1, sig, creep=0), ","), ("backward", "fit", hold_map(m, b, rng, n, -1, sig, TAU, creep=0), ","),
         ("again", "holdout", hold_map(m, b, rng, n, 1, sig, 1.0, creep=0), ",")]
    return m, {"cog": m.cog, "effects": fric_known(m)}, R, truth(K, [])

@kind
def hold_eccentric(rng, K):
    """magnet of the encoder glued off-centre; cogging and friction are declared"""
    m = motor(rng); true_cogging(m, rng); a = rng.uniform(.004, .010); ph = rng.uniform(0, TAU)
    b = Bench(ecc=[(1, a * cos(ph), a * sin(ph))]); sig = .004 * m.ir; n = max(720, 5 * lcm(m.slots, 2 * m.p))
    R = [("forward", "fit", hold_map(m, b, rng, n, 1, sig, creep=.02), ","), ("backward", "fit", hold_map(m, b, rng, n, -1, sig, TAU, creep=.02), ","),
         ("again", "holdout", hold_map(m, b, rng, n, 1, sig, 1.0, creep=.02), ",")]
    return m, {"cog": m.cog, "effects": fric_known(m)}, R, truth(K, ["position_eccentricity"])

@kind
def hold_triple(rng, K):
    """cogging, friction and an off-centre encoder at once, two maps each way"""
    m = motor(rng); true_cogging(m, rng); a = rng.uniform(.004, .010); ph = rng.uniform(0, TAU)
    b = Bench(ecc=[(1, a * cos(ph), a * sin(ph))]); sig = .003 * m.ir; n = max(720, 6 * lcm(m.slots, 2 * m.p))
    R = [("f1", "fit", hold_map(m, b, rng, n, 1, sig, creep=.05), ","), ("b1", "fit", hold_map(m, b, rng, n, -1, sig, TAU, creep=.05), ","),
         ("f2", "fit", hold_map(m, b, rng, n, 1, sig, .3, creep=.05), ","), ("b2", "holdout", hold_map(m, b, rng, n, -1, sig, 5.0, creep=.05), ",")]
    return m, {}, R, truth(K, ["cogging", "friction", "position_eccentricity"], COG("friction", "position_eccentricity") + [["cogging", "friction"], ["cogging", "friction", "mechanical_order"]],
                           note="cogging of slots and poles is one order; its sidebands at one mechanical order are the encoder's, but a table of more orders fits as well")

@kind
def hold_index_moved(rng, K):
    """maps after reboots: the index is found anew (another turn angle); cogging hidden, friction declared; the drive finds its electrical zero each time"""
    m = motor(rng); true_cogging(m, rng); b = Bench(); sig = .004 * m.ir; n = max(720, 5 * lcm(m.slots, 2 * m.p)); R = []
    for k, (nm, way, role) in enumerate([("monday", 1, "fit"), ("tuesday", -1, "fit"), ("wednesday", 1, "fit"), ("thursday", -1, "holdout")]):
        c = hold_map(m, b, rng, n, way, sig, 0 if way > 0 else TAU, creep=.03)
        z = 0 if k == 0 else rng.randrange(2 * m.p) * PI / m.p + 0.0 if rng.random() < .4 else rng.uniform(0, TAU)
        c[1] = (c[1][0], [x + z for x in c[1][1]]); R.append((nm, role, c, ","))
    return m, {"effects": fric_known(m)}, R, truth(K, ["cogging"], COG())

@kind
def moteus_crawl(rng, K):
    """moteus: position loop crawls forward and back, `torque` is k_t times its own q current; inertia declared"""
    m = motor(rng, ["mj5208", "u8lite", "eagle28", "gbm5208"]); true_cogging(m, rng); b = Bench(); sig = .004 * m.ir; m.declared_kt = m.kt
    R = []
    for k, (v, role) in enumerate([(.25, "fit"), (-.25, "fit"), (.4, "fit"), (-.33, "holdout")]):
        c, s = slow(m, b, rng, v, 3.2, 500, "moteus", sig, zero=.7); R.append(("log_%d" % k, role, c, s))
    return m, {}, R, truth(K, ["cogging", "friction"], COG("friction"))

@kind
def simplefoc_50hz(rng, K):
    """serial monitor at 50 Hz, ms stamps, AS5600 (12 bit), angle sampled up to 8 ms after its stamp; column of zeros made by hand or not"""
    m = motor(rng, ["gm2804", "gbm5208"]); true_cogging(m, rng, 1.2); b = Bench(); sig = .008 * m.ir; R = []; hand = rng.random() < .5
    for k, (v, role) in enumerate([(.1, "fit"), (-.1, "fit"), (.06, "fit"), (-.08, "holdout")]):
        c, s = slow(m, b, rng, v, 1.6, 50, "simplefoc", sig, 4096, 1e-3, jitter=8e-3, zero=2.1, bw=8)
        if hand: c.append(("torque_Nm", [0] * len(c[0][1])))
        R.append(("serial_%d" % k, role, c, s))
    return m, {"slots": rng.random() < .6}, R, truth(K, ["cogging", "friction"], COG("friction"))

@kind
def crawl_known(rng, K):
    """the crawl with everything declared: nothing hidden (moteus, ODrive or home-made log)"""
    st = rng.choice(["moteus", "odrive", "own"])
    m = motor(rng, ["mj5208", "u8lite", "eagle28"]); true_cogging(m, rng); b = Bench(); sig = .006 * m.ir; m.declared_kt = m.kt; R = []
    for k, (v, role) in enumerate([(.25, "fit"), (-.25, "fit"), (.4, "fit"), (-.33, "holdout")]):
        c, s = slow(m, b, rng, v, 3.2, 500, st, sig, torque0=False); R.append(("log_%d" % k, role, c, s))
    return m, {"cog": m.cog, "effects": fric_known(m)}, R, truth(K, [])

@kind
def holes(rng, K):
    """the crawl logged by hand-written python: micros() overflows in the middle, repeated lines, nan, empty cells, a line cut short"""
    m = motor(rng, ["mj5208", "eagle28", "gbm5208", "mn4004"]); true_cogging(m, rng); b = Bench(); sig = .004 * m.ir; R = []
    for k, (v, role) in enumerate([(.25, "fit"), (-.25, "fit"), (.35, "fit"), (-.3, "holdout")]):
        c, s = slow(m, b, rng, v, 3.2, 400, "own", sig, torque0=True)
        t = [int(4294967296 - 3e6 + float(x) * 1e6) for x in c[0][1]]
        if k == 2: t = [x % 4294967296 for x in t]
        elif k != 2: t = [x - 4290000000 for x in t]
        c[0] = ("time_us", ["%d" % x for x in t])
        for i in range(len(t)):
            u = rng.random()
            if u < .004: c[2][1][i] = "nan"
            elif u < .007: c[2][1][i] = ""
            elif u < .010 and i: 
                for col in c: col[1][i] = col[1][i - 1]
        R.append(("run%d" % k, role, c, s))
    return m, {}, R, truth(K, ["cogging", "friction"], COG("friction"))

@kind
def coast(rng, K):
    """ODrive: spun up, released; coasts down from several speeds both ways; friction hidden, inertia known. The log holds i_q, which is noise about 0."""
    m = motor(rng, ["d6374", "mj5208", "u8lite", "hub15"]); b = Bench(); R = []
    if rng.random() < .5: m.Q = m.B / 400
    for k, (f, role) in enumerate([(1, "fit"), (-1, "fit"), (.5, "fit"), (-.6, "holdout")]):
        w0 = f * wtop(m); T = min(3.0, .8 * m.J * abs(w0) / (m.Tc + m.B * abs(w0)))
        rows = spin(m, b, T, 5e-4, 4 if T < 1 else 10, lambda t, a, w: (0.0, 0.0), .3, w0)
        c, s = Log(rng, m, b, .002 * m.ir, 8192, 0, 0, .4).cols(rows, "odrive"); R.append(("coast%d" % k, role, c, s))
    return m, {}, R, truth(K, ["friction"])

def spinups(m, b, rng, style, levels, T, dt, every, sig, counts=16384, stamp=0.0, temps=None, abc=False, zero=0.0, filt=0.0):
    R = []
    for k, (q, d, role) in enumerate(levels):
        if temps: m.temp = temps[k]
        def c(t, a, w): 
            ph = t / T
            return (d * m.ir, (q if ph < .45 else -q * .8 if ph < .75 else .35 * q) * m.ir)
        rows = spin(m, b, T, dt, every, c, rng.uniform(0, 6), 0.0)
        if filt:
            y, z, h = rows[0][4], [], dt * every
            for r in rows: y += h / filt * (r[4] - y); z.append(r[:4] + (y,) + r[5:])
            rows = z
        tm = [temps[k] + rng.gauss(0, .1) for _ in rows] if temps else None
        cc, s = Log(rng, m, b, sig, counts, 0.0, stamp, zero).cols(rows, style, temp=tm, abc=abc)
        R.append(("spin%d" % k, role, cc, s))
    return R

def wtop(m): return min(400., 30 / m.kt)      # a 6-cell battery
def length(m, q, wmax):
    wmax = .8 * wtop(m); return min(1.5, wmax * m.J / (abs(q) * m.tr) / .45)

UPDOWN = [(.30, 0, "fit"), (-.30, 0, "fit"), (.15, 0, "fit"), (-.22, 0, "holdout")]

@kind
def spin_kt(rng, K):
    """free shaft, current steps up, braking and idle; the data sheet's Kv is 9..18 % off. Inertia and friction known"""
    m = motor(rng, ["d6374", "hub15", "u8lite", "mj5208"]); b = Bench(); m.declared_kt = m.kt; T = length(m, .3, 250)
    f = rng.choice([-1, 1]) * rng.uniform(.09, .18); dt = T / 6000
    m.declared_kt = m.kt * (1 + f)               # the drive computes its torque with the same sheet
    R = spinups(m, b, rng, rng.choice(["moteus", "odrive"]), UPDOWN, T, dt, 6, .004 * m.ir)
    return m, {"emf": [(1, m.K * (1 + f), 0)], "effects": fric_known(m)}, R, truth(K, ["back_emf"],
        [["magnet_temperature"], ["phase_imbalance"], ["current_gain"]], note="i_q alone: one factor on the torque, whoever makes it")

@kind
def spin_known(rng, K):
    """free shaft, all is declared: nothing hidden"""
    m = motor(rng, ["d6374", "hub15", "u8lite", "mj5208"]); b = Bench(); m.declared_kt = m.kt; T = length(m, .3, 250)
    R = spinups(m, b, rng, rng.choice(["moteus", "odrive", "vesc"]), UPDOWN, T, T / 6000, 6, .006 * m.ir, stamp=rng.choice([0, 1e-3]))
    return m, {"effects": fric_known(m)}, R, truth(K, [])

@kind
def spin_hot(rng, K):
    """free shaft, the same spin-ups cold, warm and hot; magnets lose 0.11..0.2 % a kelvin"""
    m = motor(rng, ["d6374", "hub15", "u8lite", "mj5208"]); b = Bench(); m.declared_kt = m.kt; T = length(m, .3, 250); m.temp_alpha = -rng.uniform(.0011, .002)
    R = spinups(m, b, rng, rng.choice(["moteus", "own"]), [(.3, 0, "fit"), (-.3, 0, "fit"), (.3, 0, "fit"), (-.2, 0, "fit"), (.2, 0, "holdout")], T, T / 5000, 5, .004 * m.ir, temps=[22., 55., 96., 78., 70.])
    return m, {"effects": fric_known(m)}, R, truth(K, ["magnet_temperature"])

@kind
def spin_angle(rng, K):
    """the drive's electrical zero is off; field current of both signs in the spin-ups"""
    m = motor(rng, ["d6374", "hub15", "u8lite", "mj5208"]); d = rng.choice([-1, 1]) * rng.uniform(.15, .4); b = Bench(delta_e=d); m.declared_kt = m.kt; T = length(m, .3, 250)
    R = spinups(m, b, rng, rng.choice(["moteus", "odrive"]), [(.3, 0, "fit"), (-.3, 0, "fit"), (.25, .3, "fit"), (.25, -.3, "fit"), (-.2, .2, "holdout")], T, T / 5000, 5, .004 * m.ir)
    return m, {"effects": fric_known(m)}, R, truth(K, ["position_offset"], [["back_emf"]], note="a back-EMF of another phase against the encoder is the same")

@kind
def spin_filtered(rng, K):
    """VESC-like: the logged current passed a first-order filter of 20..40 ms; nothing else is wrong (outside; a delay is near)"""
    m = motor(rng, ["d6374", "hub15"]); b = Bench(); T = 1.5
    q = min(.3, .8 * wtop(m) * m.J / m.tr / .45 / T)
    R = spinups(m, b, rng, "own", [(q, 0, "fit"), (-q, 0, "fit"), (.6 * q, 0, "fit"), (-.8 * q, 0, "holdout")], T, 2.5e-4, 8, .002 * m.ir, filt=rng.uniform(.02, .04))
    return m, {"effects": fric_known(m)}, R, truth(K, [], [["channel_delay"]], outside=True)

@kind
def one_spin(rng, K):
    """a single log: spin up, brake, coast on a little current; friction of bearings and a fan hidden"""
    m = motor(rng, ["d6374", "hub15", "u8lite", "mj5208"]); m.Tc *= 2.5; m.B *= 3; b = Bench(); m.declared_kt = m.kt; T = length(m, .25, 250)
    R = spinups(m, b, rng, rng.choice(["moteus", "odrive"]), [(.25, 0, "fit")], T, T / 8000, 5, .003 * m.ir)
    return m, {}, R, truth(K, ["friction"])

@kind
def inertia_scope(rng, K):
    """declared inertia leaves out the coupling (25..45 % low), spin-ups AND open-circuit voltages: the voltages prove k_t, so no back-EMF may be blamed"""
    m = motor(rng, ["d6374", "hub15", "u8lite"]); b = Bench(); m.declared_kt = m.kt; T = length(m, .3, 250)
    R = spinups(m, b, rng, "odrive", UPDOWN, T, T / 5000, 5, .003 * m.ir)
    for k, w in enumerate([60., -35.]):
        n = 3000; fs = 40 * m.p * abs(w) / TAU * 2; t = [i / fs for i in range(n)]; th = [w * (x + .01 / 3 * sin(3 * x)) for x in t]
        V = [[m.K * w * (1 + .01 * cos(3 * y)) * sin(m.p * x - D3 * s) + rng.gauss(0, .004 * m.K * abs(w)) for x, y in zip(th, t)] for s in range(3)]
        R.append(("open%d" % k, "fit", [("time_s", ["%.7f" % x for x in t]), ("theta_m_rad", [quant(x, TAU / 16384) for x in th])] +
                  [("v%s_V" % "abc"[s], V[s]) for s in range(3)], ","))
    return m, {"J": m.J / rng.uniform(1.25, 1.45), "effects": fric_known(m)}, R, truth(K, [], [["friction"]], outside=True,
        note="inertia too small: all torques scaled alike, the voltages say that it is not the back-EMF")

@kind
def gimbal_arm(rng, K):
    """camera arm out of balance on a gimbal: m g r sin(theta_m + phi); crawl both ways, cogging and friction known"""
    m = motor(rng, ["gm2804", "gbm5208"]); true_cogging(m, rng, .8, False); A, ph = m.tr * rng.uniform(.05, .15), rng.uniform(0, TAU)
    m.extra = lambda th, w: A * sin(th + ph); b = Bench(); R = []
    m.J *= 6
    for k, (v, role) in enumerate([(.2, "fit"), (-.2, "fit"), (.3, "fit"), (-.25, "holdout")]):
        c, s = slow(m, b, rng, v, 3.2, 250, "own", .005 * m.ir, torque0=False); R.append(("turn%d" % k, role, c, s))
    return m, {"cog": m.cog, "effects": fric_known(m)}, R, truth(K, ["mechanical_order"])

@kind
def cable(rng, K):
    """robot joint with a cable that winds up: a spring over two and a half turns, one turn is unlike the next (outside)"""
    m = motor(rng, ["mj5208", "eagle28", "gbm5208"]); k0 = m.tr * rng.uniform(.012, .025); c0 = rng.uniform(6, 9)
    m.extra = lambda th, w: -k0 * (th - c0); b = Bench(); R = []; m.J *= 4
    for k, (v, role) in enumerate([(.3, "fit"), (-.3, "fit"), (.2, "fit"), (-.25, "holdout")]):
        c, s = slow(m, b, rng, v, 2.5, 250, "own", .004 * m.ir, torque0=True, start=0 if v > 0 else 2.6 * TAU); R.append(("wind%d" % k, role, c, s))
    return m, {"cog": m.cog, "effects": fric_known(m)}, R, truth(K, [], outside=True)

@kind
def belt(rng, K):
    """belt to a pulley of another size: a torque that repeats with the pulley, 0.27..0.45 of a motor turn, not with the motor (outside: no k/p)"""
    m = motor(rng, ["d6374", "mj5208", "eagle28"]); r = rng.choice([16 / 60, 20 / 44, 18 / 62]); A, ph = m.tr * rng.uniform(.03, .06), rng.uniform(0, TAU)
    m.extra = lambda th, w: A * (sin(r * th + ph) + .4 * sin(2 * r * th + 1)); b = Bench(); R = []
    for k, (v, role) in enumerate([(.8, "fit"), (-.8, "fit"), (.6, "fit"), (-.7, "holdout")]):
        c, s = slow(m, b, rng, v, 9.3, 200, "own", .004 * m.ir, torque0=True, start=rng.uniform(0, 20)); R.append(("belt%d" % k, role, c, s))
    return m, {"cog": m.cog, "effects": fric_known(m)}, R, truth(K, [], [["mechanical_order"]], outside=True)

@kind
def stribeck(rng, K):
    """grease: friction falls from rest to 2 rad/s and rises again (outside; calling it friction is right in part)"""
    m = motor(rng, ["mj5208", "eagle28", "gbm5208", "u8lite"]); b = Bench(); R = []
    s0 = rng.uniform(1.6, 2.4); ws = rng.uniform(.8, 1.6); T0 = m.Tc * 2
    f = lambda w: math.copysign(T0 * (1 + s0 * math.exp(-(w / ws) ** 2)), w) + m.B * 3 * w
    m.Tc = T0
    for k, (v, role) in enumerate([(.1, "fit"), (-.1, "fit"), (.25, "fit"), (-.25, "fit"), (.6, "fit"), (-.6, "fit"), (1.2, "fit"), (-1.2, "fit"), (.4, "holdout"), (-.4, "holdout")]):
        c, s = slow(m, b, rng, v, 1.3, 250, "own", .003 * m.ir, torque0=True, fric=f); R.append(("speed%d" % k, role, c, s))
    return m, {"cog": m.cog}, R, truth(K, ["friction"], outside=True)

def bench_runs(m, b, rng, plan, rate, turns, sig, tsig, abc, currents=None, temps=None, lag=None, counts=16384, fric=True, zero=0.0):
    """a torque transducer and another motor that turns the shaft at a set speed with a few parts in a thousand of wow.
    plan: (omega, id, iq, role). currents(theta_e, k) -> read id, iq where the drive does not hold them constant. lag: seconds"""
    R = []
    for k, (w, d, q, role) in enumerate(plan):
        T = turns * TAU / abs(w); n = int(T * rate); rows, tq = [], []; y = None; wow = rng.uniform(0, 6); sub = 1 if not lag else 4
        for i in range(n * sub):
            t = i / (rate * sub); th = w * t + .003 * sin(2.3 * t + wow); thr = b.read_angle(th, m.p)
            idr, iqr = (d, q) if not currents else currents(m.p * thr, k)
            x, yy = b.true_current(m.p * thr, idr, iqr)
            s = em_torque(m, th, x, yy) + cogging(m, th) - (drag(m, w) if fric else 0)
            if lag:
                y = s if y is None else y + ((s + s0) / 2 - y) * (1 - math.exp(-1 / (rate * sub * lag)))
                s0 = s
            if i % sub == 0:
                rows.append((t, th, w, idr, iqr, x, yy, s)); tq.append(quant((y if lag else s) + rng.gauss(0, tsig), m.tr * 1e-4))
        if lag: cut = int(8 * lag * rate) + 1; rows, tq = rows[cut:], tq[cut:]
        c, s = Log(rng, m, b, sig, counts, 0, 0, zero).cols(rows, "own", torque=tq, abc=abc, temp=temps and [temps[k]] * len(rows))
        R.append(("p%d" % k, role, c, s))
    return R

PLAN = lambda i: [(6., 0, i, "fit"), (-6., 0, i, "fit"), (15., 0, -.5 * i, "fit"), (10., -.3 * i, .6 * i, "fit"), (-12., .3 * i, .8 * i, "fit"), (-8., 0, .7 * i, "holdout")]

@kind
def unequal_r(rng, K):
    """voltage mode: one phase has 15..30 % more resistance, dead time adds 5th and 7th; the CURRENTS are ugly, but they are measured. Nothing is missing"""
    m = motor(rng, ["gm2804", "gbm5208", "eagle28"]); true_cogging(m, rng, .6, False); b = Bench(); u = rng.uniform(.05, .12); v = rng.uniform(.02, .05); ph = rng.uniform(0, TAU)
    plan = PLAN(.7 * m.ir)
    def cur(te, k):
        d, q = plan[k][1], plan[k][2]; a = .7 * m.ir
        return d + a * (u * sin(2 * te + ph) + v * sin(6 * te)), q + a * (u * cos(2 * te + ph) + v * cos(6 * te + 1))
    R = bench_runs(m, b, rng, plan, 500, 6, .004 * m.ir, .004 * m.tr, 3, cur)
    return m, {"cog": m.cog, "effects": fric_known(m)}, R, truth(K, [])

@kind
def weak_phase(rng, K):
    """turns short in one phase; three current sensors that agree (their sum is zero)"""
    m = motor(rng, ["d6374", "mj5208", "eagle28", "mn4004"]); true_cogging(m, rng, .6, False); b = Bench(); m.weak[rng.randrange(3)] = -rng.uniform(.04, .09)
    R = bench_runs(m, b, rng, PLAN(.7 * m.ir), 600, 6, .003 * m.ir, .004 * m.tr, 3)
    return m, {"cog": m.cog, "effects": fric_known(m)}, R, truth(K, ["phase_imbalance"], [["back_emf"]], note="the same thing with a sinusoidal back-EMF")

@kind
def two_shunts(rng, K):
    """drive with two shunts, one 3..7 % off: readings of a and b, c is their negative sum. A weak phase makes nearly the same torque"""
    m = motor(rng, ["d6374", "mj5208", "mn4004"]); true_cogging(m, rng, .6, False); g = [0, 0, 0]; g[rng.randrange(2)] = rng.choice([-1, 1]) * rng.uniform(.03, .07)
    b = Bench(gain=g, shunts=2); R = bench_runs(m, b, rng, PLAN(.7 * m.ir), 600, 6, .003 * m.ir, .004 * m.tr, 2)
    return m, {"cog": m.cog, "effects": fric_known(m)}, R, truth(K, ["current_gain"], [["phase_imbalance"], ["back_emf"]])

@kind
def sensor_zero(rng, K):
    """three current sensors, offsets of 1..3 % of the rating that do not cancel; torque sensor, phase currents logged"""
    m = motor(rng, ["d6374", "mj5208", "u8lite"]); true_cogging(m, rng, .6, False); o = [rng.choice([-1, 1]) * rng.uniform(.01, .03) * m.ir for _ in range(3)]
    b = Bench(off=o); R = bench_runs(m, b, rng, PLAN(.5 * m.ir), 600, 6, .003 * m.ir, .004 * m.tr, 3)
    return m, {"cog": m.cog, "effects": fric_known(m)}, R, truth(K, ["current_offset"])

@kind
def faint_cog(rng, K):
    """a cogging torque of a tenth of the noise of one sample, 12 000 samples a run: eight standard errors a run and more"""
    m = motor(rng, ["mj5208", "eagle28", "gbm5208"]); n = lcm(m.slots, 2 * m.p); s = .02 * m.ir; m.cog = [(n, .1 * s * m.kt, rng.uniform(0, TAU))]; b = Bench(); R = []
    for k, (way, role) in enumerate([(1, "fit"), (-1, "fit"), (1, "holdout")]):
        c = hold_map(m, b, rng, 1201, way, s, 0 if way > 0 else 10 * TAU, 10, counts=65536, creep=0); R.append(("m%d" % k, role, c, ","))
    return m, {"effects": fric_known(m), "J": 0}, R, truth(K, ["cogging"])

@kind
def stall_lever(rng, K):
    """lever on a load cell: rotor locked at a few angles, current ramps to 2.5 times the rating; the iron saturates"""
    m = motor(rng, ["d6374", "mj5208", "u8lite", "eagle28"]); m.isat = m.ir * rng.uniform(4, 6); b = Bench(); R = []
    for k in range(7):
        th = rng.uniform(0, TAU); n = 160; T, A, Q, F = [], [], [], []
        for i in range(n):
            q = m.ir * 2.5 * sin(TAU * i / n); x, y = b.true_current(m.p * th, 0, q)
            T.append(i * .0125); A.append(quant(th + 2e-4 * q / m.ir, TAU / 16384)); Q.append(q + rng.gauss(0, .004 * m.ir)); F.append(em_torque(m, th, x, y) + rng.gauss(0, .008 * m.tr))
        R.append(("lock%d" % k, "holdout" if k == 6 else "fit", [("time_s", T), ("theta_m_rad", A), ("iq_A", Q), ("id_A", [0] * n), ("torque_Nm", F)], ","))
    return m, {}, R, truth(K, ["saturation"])

@kind
def scooter_ipm(rng, K):
    """interior magnets, inductances declared equal; plateaus over i_d and i_q on a torque sensor"""
    m = motor(rng, ipm=True); m.Lq = m.L * rng.uniform(1.6, 2.2); m.Ld = m.L; b = Bench(); i = m.ir; true_cogging(m, rng, .5, False)
    plan = [(10., 0, i, "fit"), (-10., -.6 * i, i, "fit"), (20., -i, .6 * i, "fit"), (15., -.4 * i, -.8 * i, "fit"), (12., .4 * i, .5 * i, "fit"), (-14., -.7 * i, .7 * i, "holdout")]
    R = bench_runs(m, b, rng, plan, 400, 6, .003 * i, .004 * m.tr, rng.choice([0, 3]))
    return m, {"cog": m.cog, "effects": fric_known(m), "Ldq": (m.L, m.L)}, R, truth(K, ["reluctance"])

@kind
def loadcell_lag(rng, K):
    """reaction torque on a load cell with a first-order filter of 3..8 ms, cogging of one order known: speeds 1.5 : 5"""
    m = motor(rng, ["d6374", "eagle28", "mn4004"]); true_cogging(m, rng, 1.5, False); b = Bench(); tau = rng.uniform(.003, .008); n = m.cog[0][0]
    i = .5 * m.ir; w = 1.0 / tau / n / 3
    plan = [(1.5 * w, 0, 0, "fit"), (-1.5 * w, 0, i, "fit"), (4 * w, 0, i, "fit"), (-5 * w, 0, .5 * i, "fit"), (2.5 * w, 0, .7 * i, "holdout")]
    R = bench_runs(m, b, rng, plan, 500, 3, .003 * m.ir, .003 * m.tr, 0, lag=tau)
    return m, {"cog": m.cog, "effects": fric_known(m)}, R, truth(K, ["torque_sensor"])

@kind
def drill_emf(rng, K):
    """turned by a drill, three scope channels and the encoder, nothing else: 5th and 7th of the back-EMF are not declared"""
    m = motor(rng, ["d6374", "hub15", "mn4004", "eagle28"]); m.emf = [(1, m.K, 0), (5, m.K * rng.uniform(.02, .05), PI * rng.randrange(2)), (7, m.K * rng.uniform(.01, .03), PI * rng.randrange(2))]; R = []
    for k, (w, role) in enumerate([(40., "fit"), (80., "fit"), (-50., "fit"), (60., "holdout")]):
        n = 5000; fs = 40 * m.p * abs(w) / TAU * 1.31; t = [i / fs for i in range(n)]; th, a = [], 0.0
        for x in t: th.append(a); a += w * (1 + .02 * sin(5 * x)) / fs
        V = []
        for s in range(3):
            V.append([quant(w * (1 + .02 * sin(5 * t[i])) * sum(A * sin(o * (m.p * th[i] - D3 * s) + g) for o, A, g in m.emf) + rng.gauss(0, .005 * m.K * abs(w)), m.K * abs(w) / 100) for i in range(n)])
        R.append(("scope%d" % k, role, [("time_s", ["%.7f" % x for x in t]), ("theta_m_rad", [quant(x, TAU / 16384) for x in th])] + [("v%s_V" % "abc"[s], V[s]) for s in range(3)], ","))
    return m, {"emf": [(1, m.K, 0)], "volts": rng.random() < .5}, R, truth(K, ["back_emf"])

@kind
def prop_stand(rng, K):
    """propeller: plateaus of speed, i_q logged, no torque sensor: the drag goes with the square of the speed. A load, but in the recordings a friction"""
    st = rng.choice(["moteus", "odrive"]); m = motor(rng, ["mn4004", "u8lite"]); m.declared_kt = m.kt; b = Bench(); R = []; J0 = m.J; m.J *= 3
    wmax = 300.; m.Q = .5 * m.tr / wmax ** 2
    for k, (f, role) in enumerate([(.3, "fit"), (.5, "fit"), (.75, "fit"), (1., "fit"), (.65, "holdout")]):
        w = f * wmax; q0 = drag(m, w) / m.kt
        ctrl = lambda t, a, ww: (0.0, q0 + (w - ww) * .02 * m.ir / 10 + .04 * m.ir * sin(8 * t))
        rows = spin(m, b, 2.0, 5e-4, 4, ctrl, 0, w); c, s = Log(rng, m, b, .004 * m.ir).cols(rows, st); R.append(("throttle%d" % k, role, c, s))
    return m, {}, R, truth(K, ["friction"], [[]], outside=False, note="as load it is not the motor's: saying that the load is unknown is fair as well")

@kind
def ten_alike(rng, K):
    """ten forward crawls at one speed and nothing else: cogging plain; the mean is friction, zero of a sensor or a load, nobody can say"""
    m = motor(rng, ["mj5208", "eagle28", "gbm5208"]); true_cogging(m, rng, 1.0, False); b = Bench(); R = []
    for k in range(10):
        c, s = slow(m, b, rng, .3, 1.7, 300, "own", .004 * m.ir, torque0=True, start=rng.uniform(0, 6)); R.append(("t%d" % k, "holdout" if k == 9 else "fit", c, s))
    return m, {}, R, truth(K, ["cogging", "friction"], [["cogging"], ["cogging", "torque_sensor"]])

@kind
def wrong_poles(rng, K):
    """poles written for pole pairs; phase currents and mechanical angle of a loaded bench (outside: nothing of the catalogue)"""
    m = motor(rng, ["d6374", "mj5208", "mn4004"]); true_cogging(m, rng, .6, False); b = Bench()
    R = bench_runs(m, b, rng, PLAN(.7 * m.ir), 600, 6, .003 * m.ir, .004 * m.tr, 3)
    return m, {"pole_pairs": 2 * m.p}, R, truth(K, [], outside=True)

@kind
def direction_flip(rng, K):
    """the encoder counts against the phase order: angle and speed have the wrong sign, i_q and torque are the drive's (outside)"""
    m = motor(rng, ["d6374", "hub15", "u8lite", "mj5208"]); b = Bench(); m.declared_kt = m.kt; T = length(m, .3, 250)
    R = spinups(m, b, rng, "own", UPDOWN, T, T / 5000, 5, .004 * m.ir)
    for r in R:
        for j, c in enumerate(r[2]):
            if c[0] in ("theta_m_rad", "speed_rad_per_s"): r[2][j] = (c[0], [-x for x in c[1]])
    return m, {"effects": fric_known(m)}, R, truth(K, [], outside=True)

@kind
def spin_ecc(rng, K):
    """free shaft at steady speeds and in spin-ups, encoder off-centre: the angle itself wobbles once a turn (speed ripple ~ w), the torque hardly"""
    m = motor(rng, ["d6374", "mj5208", "u8lite"]); a = rng.uniform(.006, .015); ph = rng.uniform(0, TAU); b = Bench(ecc=[(1, a * cos(ph), a * sin(ph))]); m.declared_kt = m.kt; T = 1.0
    q = min(.3, .8 * wtop(m) * m.J / m.tr / .45)
    R = spinups(m, b, rng, "own", [(q, 0, "fit"), (-q, 0, "fit"), (.6 * q, 0, "fit"), (-.75 * q, 0, "holdout")], T, 1e-4, 10, .004 * m.ir)
    return m, {"effects": fric_known(m)}, R, truth(K, ["position_eccentricity"])

# ---------------------------------------------------------------- self test
def selftest():
    rng = random.Random(1); m = motor(rng, ["d6374"]); b = Bench(); ok = True
    def say(n, v, lim):
        nonlocal ok; good = abs(v) < lim; ok &= good; print("%-58s %.3g %s" % (n, v, "ok" if good else "BAD (limit %g)" % lim))
    x, y = b.true_current(m.p * .3, 0, 10.); say("T = 1.5 K iq", em_torque(m, .3, x, y) / (15 * m.K) - 1, 1e-12)
    i_d, i_q = dq(*b.true_current(1.1, 3., -4.), 1.1); say("dq round trip", abs(i_d - 3) + abs(i_q + 4), 1e-12)
    # phase sum against rotor form
    m2 = motor(rng, ["d6374"]); m2.weak = [1e-15, 0, 0]; x, y = b.true_current(2.2, 3., 7.); say("phase sum = rotor form", em_torque(m2, 2.2 / m2.p, x, y) / (1.5 * m2.K * 7) - 1, 1e-12)
    # gain / offset: the drive reads what it regulates
    bb = Bench(gain=(.05, -.02, .01), off=(.3, -.1, .2)); x, y = bb.true_current(.9, 2., 5.); r = bb.readings(x, y)
    al, be = (2 * r[0] - r[1] - r[2]) / 3, (r[1] - r[2]) / S3; i_d, i_q = dq(al, be, .9); say("readings are what the drive holds", abs(i_d - 2) + abs(i_q - 5), 1e-12)
    # co-energy: torque = dW'/dtheta at fixed phase currents (reluctance + saturation + mutual)
    m3 = motor(rng, ipm=True); m3.Lq = 2 * m3.Ld; m3.isat = 90.
    def W(th, x, y):
        d, q = dq(x, y, m3.p * th); g = 1 / (1 + (q / m3.isat) ** 2)
        return .75 * (m3.Ld * d * d + m3.Lq * q * q) + 1.5 * m3.K / m3.p * d * g
    x, y, th, h = 20., -31., .77, 1e-6; num_ = (W(th + h, x, y) - W(th - h, x, y)) / (2 * h); say("torque = slope of co-energy", em_torque(m3, th, x, y) / num_ - 1, 1e-6)
    # coast-down closed form
    m.cog = []; w0 = 150.; T = .2; rows = spin(m, b, T, 5e-4, 1, lambda t, a, w: (0, 0), 0, w0); tq = m.Tc / m.B; t = rows[-1][0]
    say("coast-down closed form", rows[-1][2] / ((w0 + tq) * math.exp(-m.B * t / m.J) - tq) - 1, 3e-4)
    # energy: cogging potential + kinetic, no friction
    m.Tc = m.B = 0; m.cog = [(84, .02 * m.tr, .4), (12, .01 * m.tr, 1)]; rows = spin(m, b, .5, 1e-4, 1, lambda t, a, w: (0, 0), .1, 12.)
    E = lambda r: .5 * m.J * r[2] ** 2 + sum(A / k * cos(k * r[1] + p) for k, A, p in m.cog)
    say("energy of a free rotor on cogging", (max(map(E, rows)) - min(map(E, rows))) / E(rows[0]), .02)
    # work of the current
    m.cog = []; m.Tc = .01; m.B = 1e-5; rows = spin(m, b, .3, 1e-4, 1, lambda t, a, w: (0, 5.), 0, 1.)
    work = sum(r[7] * r[2] - drag(m, r[2]) * r[2] for r in rows[:-1]) * 1e-4; say("work of the torque = kinetic energy", work / (.5 * m.J * (rows[-1][2] ** 2 - 1)) - 1, 5e-3)
    # holding current cancels cogging
    m.cog = [(84, .02 * m.tr, .4)]; m.extra = None; _, q = hold(m, Bench(), .5, .01); say("holding current balances", (1.5 * m.K * q + cogging(m, .5) - .01) / m.tr, 1e-9)
    return 0 if ok else 1

def main(a):
    if a == ["--list"]: print("\n".join(sorted(KINDS))); return 0
    if a == ["--selftest"]: return selftest()
    if len(a) != 3 or a[0] not in KINDS: sys.stderr.write(__doc__ + "\n"); return 2
    rng = random.Random("hobby/%s/%d" % (a[0], int(a[1])))
    m, decl, runs, tr = KINDS[a[0]](rng, a[0]); tr["motor"] = m.name
    write(a[2], m, decl, runs, tr); return 0

if __name__ == "__main__": sys.exit(main(sys.argv[1:]))
