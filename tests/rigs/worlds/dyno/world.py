#!/usr/bin/env python3
"""Worlds of a dynamometer lab. python3 world.py KIND SEED OUT | --list | --verify. Standard library only."""
import cmath, json, math, os, random, sys

PI = math.pi
TAU = 2 * PI
SH = TAU / 3


# ------------------------------------------------------------------ the machine: one co-energy W'(theta, i)
class Motor:
    def __init__(s):
        s.p = 4; s.slots = 24
        s.emf = {1: (1.0, 0.0)}       # order: (Nm/A, phase)
        s.cog = {}                    # electrical order: (Nm, phase)
        s.g = [0.0, 0.0, 0.0]         # relative change of the magnets' flux through each phase
        s.Ld = 0.0; s.Lq = 0.0        # H
        s.L6 = (0.0, 0.0)             # H, phase: part of L_qq that goes with 6 theta
        s.Isat = None; s.Lsat = 0.0   # q axis iron: L_sat (I^2 ln cosh(iq/I) - iq^2/2), <= 0
        s.kx = 0.0                    # cross: the share of the magnets' flux lost at iq >> Isat
        s.magnet = 1.0
        s.uneven = {}                 # mechanical order: (Nm, phase) of the motor itself

    def copy(s):
        n = Motor(); n.__dict__.update(s.__dict__)
        n.emf = dict(s.emf); n.cog = dict(s.cog); n.g = list(s.g); n.uneven = dict(s.uneven)
        return n

    @staticmethod
    def dq(th, i):
        q = d = 0.0
        for k in range(3):
            q += i[k] * math.sin(th - k * SH); d -= i[k] * math.cos(th - k * SH)
        return d * 2 / 3, q * 2 / 3

    @staticmethod
    def abc(th, d, q):
        return [q * math.sin(th - k * SH) - d * math.cos(th - k * SH) for k in range(3)]

    def coenergy(s, thm, i):          # slow and plain: the reference for torque()
        th = s.p * thm; W = 0.0
        for k in range(3):
            lam = -sum(E / (n * s.p) * math.cos(n * (th - k * SH) + f) for n, (E, f) in s.emf.items())
            W += s.magnet * (1 + s.g[k]) * lam * i[k]
        d, q = s.dq(th, i)
        W += 1.5 * (0.5 * s.Ld * d * d + 0.5 * (s.Lq + s.L6[0] * math.cos(6 * th + s.L6[1])) * q * q)
        if s.Isat:
            x = q / s.Isat
            W += 1.5 * s.Lsat * s.Isat ** 2 * (math.log(math.cosh(x)) - x * x / 2)
            lam1 = s.emf[1][0] / s.p
            W -= 1.5 * s.magnet * lam1 * s.kx * d * x * x / (1 + x * x)
        for n, (A, f) in s.cog.items(): W -= A / (n * s.p) * math.cos(n * th + f)
        for m, (A, f) in s.uneven.items(): W -= A / m * math.cos(m * thm + f)
        return W

    def torque(s, thm, i):
        th = s.p * thm; T = 0.0; sin = math.sin; cos = math.cos
        for n, (E, f) in s.emf.items():
            for k in range(3):
                T += s.magnet * (1 + s.g[k]) * i[k] * E * sin(n * (th - k * SH) + f)
        d, q = s.dq(th, i)
        # at fixed phase currents dd/dth = q, dq/dth = -d
        if s.Ld != s.Lq or s.L6[0]:
            Lq = s.Lq + s.L6[0] * cos(6 * th + s.L6[1])
            T += 1.5 * s.p * ((s.Ld - Lq) * d * q - 3 * s.L6[0] * sin(6 * th + s.L6[1]) * q * q)
        if s.Isat:
            x = q / s.Isat
            T += 1.5 * s.p * s.Lsat * (s.Isat * math.tanh(x) - q) * (-d)
            lam1 = s.emf[1][0] / s.p; u = 1 + x * x
            T -= 1.5 * s.p * s.magnet * lam1 * s.kx * (q * x * x / u + d * 2 * x / (u * u) / s.Isat * (-d))
        for n, (A, f) in s.cog.items(): T += A * sin(n * th + f)
        for m, (A, f) in s.uneven.items(): T += A * sin(m * thm + f)
        return T


def lcm(a, b): return a * b // math.gcd(a, b)


FAMILIES = ('gimbal', 'servo', 'servo', 'torque', 'spindle', 'traction', 'servo_ipm')


def make_motor(rng, family=None):
    """a motor, its rated current, slow and fast speed"""
    family = family or rng.choice(FAMILIES)
    m = Motor()
    if family == 'gimbal': (m.p, m.slots), E, I, w = rng.choice([(7, 12), (11, 12)]), rng.uniform(.03, .09), rng.uniform(1, 3), (3, 25)
    if family == 'servo': (m.p, m.slots), E, I, w = rng.choice([(4, 18), (5, 12), (4, 24), (3, 18), (5, 15)]), rng.uniform(.3, .9), rng.uniform(5, 20), (12, 110)
    if family == 'torque': (m.p, m.slots), E, I, w = rng.choice([(10, 24), (8, 18), (10, 30)]), rng.uniform(4, 12), rng.uniform(6, 15), (2, 14)
    if family == 'spindle': (m.p, m.slots), E, I, w = rng.choice([(2, 36), (2, 24), (3, 36)]), rng.uniform(.2, .4), rng.uniform(20, 60), (40, 400)
    if family == 'traction': (m.p, m.slots), E, I, w = rng.choice([(4, 48), (3, 54), (5, 60)]), rng.uniform(.2, .4), rng.uniform(200, 400), (30, 260)
    if family == 'servo_ipm': (m.p, m.slots), E, I, w = rng.choice([(3, 36), (4, 36), (5, 18)]), rng.uniform(.4, .8), rng.uniform(8, 18), (15, 120)
    m.emf = {1: (E, 0.0), 5: (E * rng.uniform(.005, .04), rng.choice([0, PI]) + rng.uniform(-.1, .1)),
             7: (E * rng.uniform(.003, .025), rng.choice([0, PI]) + rng.uniform(-.1, .1)),
             11: (E * rng.uniform(.002, .01), rng.choice([0, PI])), 13: (E * rng.uniform(.001, .008), 0.0)}
    if rng.random() < .6: m.emf[3] = (E * rng.uniform(.02, .15), rng.choice([0, PI]))
    Tr = 1.5 * E * I
    n = lcm(2 * m.p, m.slots) / m.p
    m.cog = {n: (Tr * rng.uniform(.004, .025), rng.uniform(-PI, PI)), 2 * n: (Tr * rng.uniform(.001, .004), rng.uniform(-PI, PI))}
    if family in ('traction', 'servo_ipm'):
        lam = E / m.p
        m.Ld = lam / I * rng.uniform(.3, .6); m.Lq = m.Ld * rng.uniform(1.6, 2.8)
    return m, I, w, family


# ------------------------------------------------------------------ what lies between the rotor and the file
class Bench:
    def __init__(s):
        s.fric = (0.0, 0.0, 0.0)              # coulomb, viscous, quadratic
        s.goff = [0.0] * 3; s.ggain = [0.0] * 3
        s.pos = 0.0                           # electrical rad
        s.ecc = {}                            # mechanical order: (rad mech, phase)
        s.lat = dict(cur=0.0, ang=0.0, tq=0.0)
        s.toff = 0.0; s.tgain = 1.0
        s.G = None                            # transfer function of the torque channel, of jw
        s.extra = {}                          # mechanical order: (Nm, phase) added at the transducer
        s.alpha = 0.0                         # magnets, per kelvin
        s.drag = None                         # function(omega, d, q) -> Nm that brakes
        s.tnl = 0.0                           # transducer: quadratic part at full scale
        s.noise_t = 0.0; s.noise_i = 0.0; s.bits = 0; s.ar = 0.0; s.qt = 0.0


class Run:
    def __init__(s, name, w, d, q, N=2600, fs=None, turns=None, temp=20.0, role='fit', **kw):
        s.name, s.w, s.d, s.q, s.N, s.temp, s.role = name, w, d, q, N, temp, role
        s.turns = turns or 12.37
        s.fs = fs
        s.th0 = 0.0
        s.h6 = (0.0, 0.0)                     # drive's own ripple of the current vector
        s.accel = 0.0                         # rad/s2
        s.profile = None                      # function(u in 0..1) -> (scale of d, of q)
        s.tempf = None                        # function(u) -> temperature
        s.drift = None                        # function(t, u) -> Nm
        s.times = None
        s.slip = 0.0                          # mechanical rad, index
        s.hunt = (0.0, 1.0)                   # share of speed, rad/s
        s.toff = 0.0; s.tscale = 1.0
        s.J = 0.0
        s.magnet = 1.0
        s.__dict__.update(kw)


def fft(x):
    n = len(x)
    if n == 1: return list(x)
    a, b = fft(x[0::2]), fft(x[1::2]); o = [0] * n
    for k in range(n // 2):
        t = cmath.exp(-2j * PI * k / n) * b[k]; o[k] = a[k] + t; o[k + n // 2] = a[k] - t
    return o


def record(rng, m, b, r):
    """the columns of one run, in SI"""
    p = m.p; N = r.N
    span = abs(r.turns * TAU / r.w) if r.w else 1.0
    if r.fs: span = N / r.fs
    ts = r.times or [k * span / N for k in range(N)]
    T_end = ts[-1] or 1.0
    hs, hw = r.hunt

    def th_of(t): return r.th0 + r.w * t + r.accel * t * t / 2 + r.w * hs / hw * (1 - math.cos(hw * t))
    def w_of(t): return r.w + r.accel * t + r.w * hs * math.sin(hw * t)

    def cur(t):
        u = t / T_end; d, q = r.d, r.q
        if r.profile: a, c = r.profile(u); d *= a; q *= c
        th = p * th_of(t)
        if r.h6[0]:
            q += r.h6[0] * math.sin(6 * th + r.h6[1]); d += .6 * r.h6[0] * math.cos(6 * th + r.h6[1])
        return th, d, q

    mm = m.copy()

    def shaft(t):
        u = t / T_end
        th, d, q = cur(t); w = w_of(t)
        temp = r.tempf(u) if r.tempf else r.temp
        mm.magnet = m.magnet * r.magnet * (1 + b.alpha * (temp - 20.0))
        T = mm.torque(th_of(t), Motor.abc(th, d, q))
        sg = (w > 0) - (w < 0)
        c, v, k2 = b.fric
        T -= c * sg + v * w + k2 * w * abs(w)
        if b.drag: T -= sg * b.drag(abs(w), d, q)
        if r.J: T -= r.J * (r.accel + r.w * hs * hw * math.cos(hw * t))
        for k, (A, f) in b.extra.items(): T += A * math.sin(k * th_of(t) + f)
        return T

    if b.G and r.w and not r.accel and not r.profile:
        assert not hs and not r.tempf
        M = 2048 if p * 48 < 700 else 4096
        tt = [TAU * k / M / r.w for k in range(M)]
        save = r.th0; r.th0 = 0.0
        X = fft([shaft(t) for t in tt]); r.th0 = save
        big = max(abs(x) for x in X[1:])
        parts = [(k, 2 * X[k] / M * (b.G(1j * k * r.w) if r.w > 0 else b.G(1j * k * -r.w).conjugate()))
                 for k in range(1, M // 2) if abs(X[k]) > 1e-5 * big]
        c0 = X[0].real / M * b.G(0).real

        def shaft_read(t):
            th = th_of(t)
            return c0 + sum((z * cmath.exp(1j * k * th)).real for k, z in parts)
    else:
        shaft_read = shaft

    o = dict(t=[], th=[], w=[], ia=[], ib=[], ic=[], T=[], temp=[], d=[], q=[])
    e = 0.0; step = TAU / 2 ** b.bits if b.bits else 0
    for t in ts:
        ta = t - b.lat['ang']; th = th_of(ta)
        thr = th + b.pos / p + sum(A * math.sin(k * th + f) for k, (A, f) in b.ecc.items()) + r.slip
        if step: thr = math.floor(thr / step + .5) * step
        te, d, q = cur(t - b.lat['cur'])
        i = Motor.abc(te, d, q)
        i = [(1 + b.ggain[k]) * i[k] + b.goff[k] + rng.gauss(0, b.noise_i) for k in range(3)]
        T = shaft_read(t - b.lat['tq'])
        T = b.tgain * r.tscale * (T + b.tnl * T * abs(T)) + b.toff + r.toff
        if r.drift: T += r.drift(t, t / T_end)
        e = b.ar * e + rng.gauss(0, b.noise_t * math.sqrt(1 - b.ar ** 2))
        T += e
        if b.qt: T = round(T / b.qt) * b.qt
        o['t'].append(t); o['th'].append(thr); o['w'].append(w_of(t)); o['T'].append(T)
        o['ia'].append(i[0]); o['ib'].append(i[1]); o['ic'].append(i[2])
        o['temp'].append(round((r.tempf(t / T_end) if r.tempf else r.temp) + (rng.gauss(0, .2)), 1))
        dr, qr = Motor.dq(p * thr, i); o['d'].append(dr); o['q'].append(qr)
    return o


# ------------------------------------------------------------------ the files as benches write them
def num(x, digits=7): return f'{x:.{digits}g}'


def write_run(path, o, style, rng, temp=True, tdigits=10):
    N = len(o['t']); deg = 180 / PI
    rpm = 60 / TAU
    if style == 'plain':
        head = ['time_s', 'theta_m_rad', 'ia_A', 'ib_A', 'ic_A', 'torque_Nm']
        cols = [o['t'], o['th'], o['ia'], o['ib'], o['ic'], o['T']]
        if temp: head.append('temperature_C'); cols.append(o['temp'])
        pre, sep, units, comma = [], ',', None, False
    elif style == 'german':                   # a spreadsheet saved by the technician
        head = ['t', 'theta_m', 'n', 'i_u', 'i_v', 'i_w', 'M'] + (['T'] if temp else []) + ['Bemerkung_Kanal7']
        cols = [[1000 * t for t in o['t']], [(x * deg) % 360 for x in o['th']], [round(w * rpm, 1) for w in o['w']],
                o['ia'], o['ib'], o['ic'], o['T']] + ([o['temp']] if temp else []) + [[0.0] * N]
        units = ['ms', '°', '1/min', 'A', 'A', 'A', 'Nm'] + (['°C'] if temp else []) + ['-']
        pre, sep, comma = ['# Pruefstand 3, Motor 0815', '# Messung; Filter: 1 kHz'], ';', True
    elif style == 'dyno':                     # names, units in brackets; wrapped degrees; whole rpm; milli
        head = ['Time (ms)', 'theta_mech (deg)', 'shaft_speed (rpm)', 'i_a (A)', 'i_b (A)', 'i_c (A)', 'shaft_torque (mNm)'] + (['motor_temperature (°C)'] if temp else [])
        head[0] = 't (ms)'
        cols = [[1000 * t for t in o['t']], [(x * deg) % 360 for x in o['th']], [round(w * rpm) for w in o['w']],
                o['ia'], o['ib'], o['ic'], [1000 * x for x in o['T']]] + ([o['temp']] if temp else [])
        pre, sep, units, comma = [], ',', None, False
    elif style == 'two':                      # two clamps only
        head = ['time_s', 'theta_m_rad', 'speed_rpm', 'ia_A', 'ib_A', 'torque_Nm'] + (['temperature_C'] if temp else [])
        cols = [o['t'], [x % TAU for x in o['th']], [w * rpm for w in o['w']], o['ia'], o['ib'], o['T']] + ([o['temp']] if temp else [])
        pre, sep, units, comma = [], '\t', None, False
    elif style == 'dq':
        head = ['time_s', 'theta_m_rad', 'speed_rad_per_s', 'id_A', 'iq_A', 'torque_Nm'] + (['temperature_C'] if temp else [])
        cols = [o['t'], o['th'], o['w'], o['d'], o['q'], o['T']] + ([o['temp']] if temp else [])
        pre, sep, units, comma = [], ',', None, False
    lines = list(pre) + [sep.join(head)] + ([sep.join(units)] if units else [])
    for k in range(N):
        s = sep.join(num(c[k], tdigits if j == 0 else 7) for j, c in enumerate(cols))
        lines.append(s.replace('.', ',') if comma else s)
    return lines


def put(path, lines, eol='\n'):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, 'w', encoding='utf-8', newline='') as f: f.write(eol.join(lines) + eol)


def write_machine(out, m, I, rng, J=None, rated=True):
    L = ['name,value,unit', f'pole_pairs,{m.p},1', f'slots,{m.slots},1']
    if rated: L.append(f'rated_current,{num(I, 4)},A')
    if J: L.append(f'inertia,{num(J)},kgm2')
    put(f'{out}/machine/machine.csv', L)
    put(f'{out}/machine/back_emf.csv', ['order,amplitude_Nm_per_A,phase_rad'] + [f'{n},{E!r},{f!r}' for n, (E, f) in sorted(m.emf.items())])
    if m.cog: put(f'{out}/machine/cogging.csv', ['order,amplitude_Nm,phase_rad'] + [f'{n!r},{A!r},{f!r}' for n, (A, f) in sorted(m.cog.items())])
    if m.Lq:
        rows = ['theta_e_rad,La_H,Lb_H,Lc_H,Mab_H,Mbc_H,Mca_H']
        for k in range(72):
            th = TAU * k / 72; c = [math.cos(th - s * SH) for s in range(3)]; n = [math.sin(th - s * SH) for s in range(3)]
            f = lambda x, y: 2 / 3 * (m.Ld * c[x] * c[y] + m.Lq * n[x] * n[y])
            rows.append(','.join(repr(v) for v in (th, f(0, 0), f(1, 1), f(2, 2), f(0, 1), f(1, 2), f(2, 0))))
        put(f'{out}/machine/inductance.csv', rows)


# ------------------------------------------------------------------ hidden things of the catalogue
def pol(I, a): return (-I * math.sin(a), I * math.cos(a))     # (d, q): current angle a, lead is d < 0


def hide(name, rng, c, size=1.0):
    """change the true motor or the bench; c: context. Returns other sets that say the same."""
    m, b, I, E = c.true, c.b, c.I, c.decl.emf[1][0]; Tr = 1.5 * E * I; p = m.p; w1 = c.w[1]
    sg = rng.choice([-1, 1])
    if name == 'cogging':
        n = rng.choice([6.0, 2 * m.slots / p if (2 * m.slots) % p else 6.0, m.slots / p if m.slots / p > 1.5 else 6.0])
        if n in m.cog: n = 6.0 if 6.0 not in m.cog else 18.0 if 18.0 not in m.cog else 30.0
        m.cog[n] = (Tr * .012 * size * rng.uniform(.7, 1.5), rng.uniform(-PI, PI))
    elif name == 'back_emf':
        n = rng.choice([5, 7, 11]); A, f = m.emf[n]; z = A * cmath.exp(1j * f) + E * .022 * size * rng.uniform(.8, 1.6) * cmath.exp(1j * rng.uniform(-PI, PI))
        m.emf[n] = (abs(z), cmath.phase(z))
    elif name == 'phase_imbalance': m.g[rng.randrange(3)] = -.035 * size * rng.uniform(.7, 1.4)
    elif name == 'reluctance':
        dL = -E / p / I * .12 * size * rng.uniform(.7, 1.5); m.Lq -= dL
    elif name == 'saturation':
        m.Isat = I * rng.uniform(.45, .7); m.kx = .10 * size * rng.uniform(.7, 1.4); m.Lsat = (m.Lq or E / p / I * .3) * .5 * size
    elif name == 'magnet_temperature': b.alpha = -.0011 * size * rng.uniform(.9, 1.9)
    elif name == 'current_offset':
        k = rng.randrange(3); b.goff[k] = sg * .014 * size * I * rng.uniform(.8, 1.6); b.goff[(k + 1) % 3] = -.3 * b.goff[k]
    elif name == 'current_gain': b.ggain[rng.randrange(3)] = sg * .022 * size * rng.uniform(.8, 1.5)
    elif name == 'position_offset': b.pos = sg * .06 * size * rng.uniform(.8, 1.8)
    elif name == 'position_eccentricity':
        b.ecc = {1: (.035 * size * rng.uniform(.8, 1.8) / p, rng.uniform(-PI, PI))}
        if rng.random() < .4: b.ecc[2] = (.012 * size / p, rng.uniform(-PI, PI))
    elif name == 'channel_delay':
        ch = rng.choice(['cur', 'ang', 'tq']); b.lat[ch] = .18 * size * rng.uniform(.7, 1.6) / (p * w1)
    elif name == 'friction': b.fric = (Tr * .012 * size * rng.uniform(.6, 1.6), Tr * .01 * size * rng.uniform(.4, 1.5) / w1, 0.0)
    elif name == 'torque_sensor': b.toff = sg * Tr * .012 * size * rng.uniform(.7, 1.6)
    elif name == 'torque_lag':
        n = min(x for x in m.cog); tau = rng.uniform(.7, 1.4) * size / (n * p * w1); b.G = lambda s: 1 / (1 + s * tau)
        return 'torque_sensor'
    elif name == 'mechanical_order':
        k = rng.choice([1, 2, 1]); k = k if k % p else 1
        b.extra = {k: (Tr * .012 * size * rng.uniform(.8, 1.6), rng.uniform(-PI, PI))}
    return name


SINGLES = ('cogging', 'back_emf', 'phase_imbalance', 'reluctance', 'saturation', 'magnet_temperature', 'current_offset', 'current_gain', 'position_offset',
           'position_eccentricity', 'channel_delay', 'friction', 'torque_sensor', 'torque_lag', 'mechanical_order')


class C: pass


def context(rng, family=None):
    c = C(); c.decl, c.I, c.w, c.family = make_motor(rng, family)
    c.true = c.decl.copy(); c.b = Bench(); b = c.b
    c.Tr = 1.5 * c.decl.emf[1][0] * c.I
    b.noise_t = c.Tr * rng.uniform(.002, .006); b.noise_i = c.I * rng.uniform(.0008, .003)
    b.bits = rng.choice([13, 14, 16, 17, 20, 0]); b.ar = rng.choice([0, 0, .35])
    c.h6 = (c.I * rng.uniform(0, .01), rng.uniform(-PI, PI))
    c.style = rng.choice(['plain', 'plain', 'german', 'dyno']); c.temp = True
    c.truth = dict(hidden=[], outside=False, also_right=[], answerable=True, plain=None)
    c.tdigits = 10; c.J = None; c.rated = True; c.decl_write = None; c.post = None
    return c


def plan_good(rng, c, N=1600):
    c.top = min(c.decl.cog) * c.decl.p; turns = max(3.3, min(13.0, N / (2.6 * c.top)))     # 2.6 samples a period of the first slot order, and of its torque
    I, (ws, wf) = c.I, c.w
    rows = [('zero_f', ws, 0, 0, 20), ('zero_b', -ws * 1.1, 0, 0, 20), ('full_slow', ws, I, 0, 22), ('half_lead', -wf, .5 * I, .6, 31),
            ('full_lag', wf, I, -.4, 48), ('brake', -ws * 1.3, I, PI, 71), ('quarter', wf * .8, .25 * I, 0, 66), ('lead_slow', ws * 1.5, .8 * I, .8, 60), ('hold', -.45 * wf, .75 * I, .3, 52)]
    runs = []
    for name, w, i, a, temp in rows:
        d, q = pol(i, a)
        runs.append(Run(name, w, d, q, N=N, turns=turns * rng.uniform(.85, 1.1), temp=temp + rng.uniform(-2, 2), role='holdout' if name == 'hold' else 'fit',
                        th0=rng.uniform(0, TAU), h6=(c.h6[0] * i / I, c.h6[1])))
    return runs


def catalogue(rng, c, names, size=1.0):
    out = []
    for n in names: out.append(hide(n, rng, c, size))
    c.truth['hidden'] = sorted(set(out))
    acc = []
    if 'phase_imbalance' in out: acc.append([x if x != 'phase_imbalance' else 'back_emf' for x in out])   # weak phase = EMF of the wrong sequence
    if 'saturation' in out and 'reluctance' not in out: acc.append(out + ['reluctance'])
    c.truth['also_right'] = [sorted(set(a)) for a in acc]


# ------------------------------------------------------------------ the kinds
KINDS = {}
def kind(f): KINDS[f.__name__] = f; return f


@kind
def nothing(rng):
    c = context(rng); c.runs = plan_good(rng, c); return c
@kind
def sparse(rng):
    """nothing hidden; many poles and a slow logger: fewer than two samples a period of the declared slot order (each turn sees other angles)"""
    c = context(rng, rng.choice(['torque', 'gimbal'])); c.runs = plan_good(rng, c)
    for r in c.runs: r.turns = r.N / (1.3 * c.top)
    return c
@kind
def single(rng):
    c = context(rng); c.runs = plan_good(rng, c); catalogue(rng, c, [SINGLES[(rng.seed_no * 4 + 1) % len(SINGLES)]]); return c
@kind
def single_b(rng):
    c = context(rng); c.runs = plan_good(rng, c); catalogue(rng, c, [SINGLES[(rng.seed_no * 7 + 3) % len(SINGLES)]]); return c
@kind
def two(rng):
    c = context(rng); c.runs = plan_good(rng, c)
    catalogue(rng, c, rng.sample([s for s in SINGLES if s not in ('phase_imbalance',)], 2)); return c
@kind
def three(rng):
    c = context(rng); c.runs = plan_good(rng, c)
    catalogue(rng, c, rng.choice([('friction', 'current_offset', 'cogging'), ('magnet_temperature', 'torque_sensor', 'back_emf'), ('position_offset', 'friction', 'mechanical_order'),
                                  ('channel_delay', 'current_gain', 'friction'), ('position_eccentricity', 'cogging', 'magnet_temperature')])); return c
@kind
def tenth_of_noise(rng):
    c = context(rng); c.b.ar = 0; c.runs = plan_good(rng, c)
    what = rng.choice(['cogging', 'back_emf', 'friction', 'current_offset'])
    c.b.noise_t = c.Tr * .02
    catalogue(rng, c, [what], .2); c.truth['plain'] = []; return c
@kind
def load_ramp(rng):
    """plateaus of speed, on each a ramp 0 -> 100 % -> 0; the whole ramp is one file"""
    c = context(rng, rng.choice(['servo', 'servo_ipm', 'traction'])); I = c.I; c.runs = []
    for k, (w, a) in enumerate([(c.w[0], 0.), (c.w[1] * .5, .5), (-c.w[0], -.35), (c.w[1], .9), (-c.w[1] * .7, .2)]):
        d, q = pol(I, a)
        c.runs.append(Run(f'ramp{k}', w, d, q, N=2000, turns=7.3, temp=25, profile=lambda u: ((1 - abs(2 * u - 1)),) * 2, role='holdout' if k == 4 else 'fit', h6=c.h6))
    catalogue(rng, c, [rng.choice(['saturation', 'reluctance', 'back_emf', 'cogging', 'current_gain'])]); return c
@kind
def drag_plateaus(rng):
    """driven without current through speed plateaus, both ways: friction; no loaded run at all"""
    c = context(rng); c.runs = []
    for k, s in enumerate([.1, .3, .6, 1., -.1, -.3, -.6, -1., .45]):
        c.runs.append(Run(f'n{k}', c.w[1] * s, 0, 0, N=1500, turns=11.3, role='holdout' if k == 8 else 'fit', temp=30))
    hide('friction', rng, c, 1.5); q = c.b.fric; c.b.fric = (q[0], q[1], c.Tr * .012 / c.w[1] ** 2); c.truth['hidden'] = ['friction']
    c.h6 = (0, 0); return c
@kind
def drag_one_way(rng):
    """the same, one direction, one speed: a drag or a zero of the transducer"""
    c = context(rng); c.runs = [Run(f'n{k}', c.w[1] * .5, 0, 0, N=2000, turns=13, temp=25, th0=k) for k in range(3)]
    c.b.fric = (c.Tr * .03, 0, 0); c.truth.update(hidden=['friction'], also_right=[['torque_sensor']]); return c
@kind
def bessel(rng):
    """torque channel through a 4th-order Bessel of the amplifier, the others straight: a lag, or a delay"""
    c = context(rng, rng.choice(['servo', 'spindle', 'servo_ipm'])); c.runs = plan_good(rng, c)
    n = min(c.true.cog); A, f = c.true.cog[n]; c.true.cog[n] = c.decl.cog[n] = (max(A, .02 * c.Tr), f)
    wc = n * c.true.p * c.w[1] * rng.uniform(1.0, 2.0) / 2.114
    def G(s):
        x = s / wc; return 105 / (x ** 4 + 10 * x ** 3 + 45 * x * x + 105 * x + 105)
    c.b.G = G; c.truth.update(hidden=['torque_sensor'], also_right=[['channel_delay'], ['channel_delay', 'torque_sensor']]); return c
@kind
def torsion(rng):
    """shaft string between rotor and flange: a resonance that plateaus of speed pass through"""
    c = context(rng, 'servo'); c.runs = plan_good(rng, c, 2000)
    n = min(c.true.cog); A, f = c.true.cog[n]; c.true.cog[n] = c.decl.cog[n] = (max(A, .02 * c.Tr), f)
    wn = n * c.true.p * c.w[1] * rng.uniform(.5, .9); z = rng.uniform(.03, .1)
    for r in c.runs: r.turns = r.N / (c.true.p * n * 6.3)
    c.b.G = lambda s: 1 / (1 + 2 * z * s / wn + (s / wn) ** 2); c.truth['hidden'] = ['torque_sensor']; return c
@kind
def latencies(rng):
    """currents over the drive's fieldbus, torque over another, angle direct: milliseconds apart"""
    c = context(rng); c.runs = plan_good(rng, c)
    k = 1 / (c.true.p * c.w[1])
    c.b.lat.update(cur=rng.uniform(.6, 2.2) * k, tq=rng.uniform(.4, 2.5) * k); c.truth['hidden'] = ['channel_delay']; return c
@kind
def load_machine(rng):
    """the load machine's own slots and coupling: 1, 2 and 19 a turn at the flange"""
    c = context(rng); c.runs = plan_good(rng, c)
    c.b.extra = {k: (c.Tr * a * rng.uniform(.7, 1.4), rng.uniform(-PI, PI)) for k, a in ((1, .015), (2, .006), (19, .008))}; c.truth['hidden'] = ['mechanical_order']; return c
@kind
def no_index(rng):
    """incremental encoder: each file finds the electrical angle anew, the turn is another one each time; coupling once a turn"""
    c = context(rng, rng.choice(['servo', 'torque'])); c.runs = plan_good(rng, c); p = c.true.p
    c.b.extra = {1: (c.Tr * .02, 1.0)}
    for r in c.runs: r.slip = TAU / p * rng.randrange(p)
    c.truth.update(hidden=['mechanical_order'], outside=True); return c
@kind
def zero_drift(rng):
    """zero of the transducer creeps as it warms: 3 to 6 times the noise within a run"""
    c = context(rng); c.runs = plan_good(rng, c)
    for r in c.runs:
        A = c.b.noise_t * rng.uniform(3, 6) * rng.choice([-1, 1]); tc = rng.uniform(.2, 1)
        r.drift = lambda t, u, A=A, tc=tc: A * (1 - math.exp(-u / tc))
    c.truth.update(outside=True, tolerated=['torque_sensor']); return c
@kind
def rezeroed(rng):
    """zeroed anew before every run, never at true zero: another offset each"""
    c = context(rng); c.runs = plan_good(rng, c)
    for r in c.runs: r.toff = c.Tr * rng.gauss(0, .015)
    c.truth.update(hidden=[], outside=True, tolerated=['torque_sensor']); return c
@kind
def shunt_cal(rng):
    """transducer calibrated with the wrong shunt: all torque by one factor, cogging included"""
    c = context(rng, rng.choice(['servo', 'gimbal', 'servo_ipm'])); c.runs = plan_good(rng, c)
    n = min(c.true.cog); c.true.cog[n] = c.decl.cog[n] = (.06 * c.Tr, c.true.cog[n][1])
    c.b.tgain = rng.choice([.9, 1.08, 1.12]); c.b.noise_t *= .6
    rest = ['cogging'] + (['reluctance'] if c.decl.Lq else [])
    c.truth.update(outside=True, also_right=[['torque_gain']] + [[x] + rest for x in ('back_emf', 'magnet_temperature', 'current_gain')]); return c
@kind
def thermal_log(rng):
    """heat run: one line a second for twenty minutes, angle wrapped and hence by chance; two short runs beside it"""
    c = context(rng, rng.choice(['servo', 'traction', 'servo_ipm'])); I = c.I; c.style = rng.choice(['plain', 'dyno'])
    d, q = pol(.8 * I, .2)
    long = Run('heat', c.w[1] * .6, d, q, N=1200, temp=20, tempf=lambda u: 22 + 78 * (1 - math.exp(-3 * u)), h6=c.h6)
    long.times = [k * 1.0 + rng.uniform(-.02, .02) * (k > 0) for k in range(1200)]; long.wrap = True
    c.runs = [long, Run('zero', c.w[0], 0, 0, N=2400, turns=14, temp=22), Run('load', c.w[0], *pol(I, 0), N=2400, turns=14, temp=24, h6=c.h6),
              Run('hold', -c.w[1] * .5, *pol(.6 * I, .3), N=2400, turns=14, temp=80, role='holdout', h6=c.h6)]
    catalogue(rng, c, ['magnet_temperature']); return c
@kind
def thermal_ms(rng):
    """the heat run once more, its clock of seven digits as the sheet shows them: up to a millisecond from the angle"""
    c = thermal_log(rng); c.style = 'dyno'; c.tdigits = 7; return c
@kind
def hot_only(rng):
    """every run at one temperature, far from the declared one: a weaker magnet, nothing else can be said"""
    c = context(rng, rng.choice(['servo', 'spindle', 'gimbal'])); c.runs = plan_good(rng, c)
    for r in c.runs: r.temp = 95.0
    hide('magnet_temperature', rng, c); c.truth.update(hidden=['magnet_temperature'], also_right=[['back_emf'], ['current_gain'], ['phase_imbalance']]); return c
@kind
def warming_unlogged(rng):
    """magnets warm from run to run, no thermometer: the torque per ampere goes its own way"""
    c = context(rng, rng.choice(['servo', 'spindle'])); c.runs = plan_good(rng, c); c.temp = False
    order = list(range(len(c.runs))); rng.shuffle(order)
    for k, r in zip(order, c.runs): r.magnet = 1 - .09 * k / (len(order) - 1)
    c.truth.update(outside=True, tolerated=['magnet_temperature', 'back_emf']); return c
@kind
def resolver(rng):
    """resolver: sine and cosine unequal and offset: once and twice a turn of its own period, one pole pair or as many as the motor"""
    c = context(rng); c.runs = plan_good(rng, c); p = c.true.p; K = rng.choice([1, p])
    c.b.ecc = {K: (.02 * rng.uniform(.7, 1.4) / p, rng.uniform(-PI, PI)), 2 * K: (.04 * rng.uniform(.7, 1.4) / p, rng.uniform(-PI, PI))}
    c.truth.update(hidden=['position_eccentricity' if K == 1 else 'position_harmonics']); return c
@kind
def clamps_swapped(rng):
    """clamps of b and c changed places at the power analyser"""
    c = context(rng); c.runs = plan_good(rng, c)
    def post(o): o['ib'], o['ic'] = o['ic'], o['ib']
    c.post = post; c.truth.update(outside=True); return c
@kind
def clamp_turned(rng):
    """one clamp the wrong way round in all runs; the three readings do not add up to 0"""
    c = context(rng); c.runs = plan_good(rng, c); k = rng.choice(['ia', 'ib', 'ic'])
    def post(o): o[k] = [-x for x in o[k]]
    c.post = post; c.truth.update(outside=True, tolerated=['current_gain']); return c
@kind
def load_sign(rng):
    """torque as the load machine counts it: the sign of the whole column"""
    c = context(rng); c.runs = plan_good(rng, c)
    def post(o): o['T'] = [-x for x in o['T']]
    c.post = post; c.truth.update(outside=True); return c
@kind
def wrong_poles(rng):
    """the number plate is of the sister type: other pole pairs than recorded"""
    c = context(rng, rng.choice(['servo', 'gimbal', 'spindle'])); c.runs = plan_good(rng, c)
    w = c.decl.copy(); w.p = rng.choice([x for x in (c.decl.p - 1, c.decl.p + 1, 2 * c.decl.p) if x > 0]); c.decl_write = w; c.truth.update(outside=True); return c
@kind
def sister_motor(rng):
    """same frame, other winding: all of the torque per ampere 15 to 35 % more and another slot number"""
    c = context(rng, 'servo'); c.runs = plan_good(rng, c)
    k = rng.uniform(1.15, 1.35); c.true.emf = {n: (E * k * (1 if n == 1 else rng.uniform(.3, 2.5)), f) for n, (E, f) in c.true.emf.items()}
    n = min(c.true.cog); c.true.cog = {(6.0 if n != 6 else 18.0): (.02 * c.Tr, .4)}
    c.truth.update(hidden=['back_emf', 'cogging'], also_right=[['back_emf', 'cogging', 'magnet_temperature']]); return c
@kind
def same_ten(rng):
    """ten runs that differ in nothing: one point, one speed"""
    c = context(rng, rng.choice(['servo', 'spindle'])); c.h6 = (0, 0)
    c.runs = [Run(f'r{k}', c.w[0] * 2, *pol(.7 * c.I, 0), N=1500, turns=12.3, temp=40, th0=rng.uniform(0, TAU)) for k in range(10)]
    A = c.true.emf[5][0]; c.true.emf[5] = (A + .03 * c.true.emf[1][0], c.true.emf[5][1]); c.true.emf[7] = c.decl.emf[7]
    c.truth.update(hidden=['back_emf'], also_right=[['cogging'], ['reluctance'], ['saturation']]); return c
@kind
def one_run(rng):
    """one loaded run, three currents, one turn dozen"""
    c = context(rng); what = rng.choice(['cogging', 'current_offset', 'current_gain', 'position_eccentricity'])
    c.runs = [Run('only', c.w[0] * 2, *pol(.8 * c.I, .2), N=3000, turns=14.7, temp=40, h6=c.h6)]
    catalogue(rng, c, [what])
    if what == 'cogging': c.truth['also_right'] = [['back_emf'], ['reluctance'], ['saturation'], ['mechanical_order']]
    if what == 'current_gain': c.truth['also_right'] = [['phase_imbalance'], ['back_emf']]
    if what == 'position_eccentricity': c.truth['also_right'] = [['mechanical_order'], ['cogging', 'mechanical_order']]
    if what == 'current_offset': c.truth['also_right'] = [['back_emf'], ['cogging']]
    return c
@kind
def holes(rng):
    """1 line in 150 with an empty cell, NaN, or cut short; one effect that is plain"""
    c = context(rng); c.style = rng.choice(['plain', 'dyno']); c.runs = plan_good(rng, c); catalogue(rng, c, [rng.choice(['cogging', 'friction', 'current_offset', 'position_offset'])])
    def lines(L, rng):
        for k in range(3, len(L)):
            if rng.random() < 1 / 150:
                f = L[k].split(','); j = rng.randrange(1, len(f)); h = rng.randrange(3)
                if h == 0: f[j] = ''
                if h == 1: f[j] = 'NaN'
                L[k] = ','.join(f) if h < 2 else ','.join(f[:j])
        return L
    c.lines = lines; return c
@kind
def midnight(rng):
    """clock of the day in whole milliseconds, and one run that passes midnight; angle and speed are fine"""
    c = context(rng); c.style = 'plain'; c.runs = plan_good(rng, c); catalogue(rng, c, [rng.choice(['cogging', 'friction', 'back_emf', 'reluctance'])])
    day = 86400.0
    c.clock = lambda r, t: round((86399.0 + t if r.name == 'brake' else 3600 * 7 + t) % day, 3); return c
@kind
def spin_up(rng):
    """speed ramps up and down without current, rotor inertia inside the flange: torque of acceleration (an effect since; the author had it outside)"""
    c = context(rng, 'servo'); wf = c.w[1]; c.runs = []; c.J = c.Tr * .08 / (wf / 2.0)
    for k, s in enumerate([1, -1, 1, -1]):
        up = k < 2; c.runs.append(Run(f'{"up" if up else "down"}{k}', s * (wf * .05 if up else wf), 0, 0, N=3000, fs=1500, accel=s * (1 if up else -1) * wf * .45, J=c.J, temp=25))
    for k, s in enumerate([.4, -.4]): c.runs.append(Run(f'steady{k}', s * wf, 0, 0, N=2400, turns=14, J=c.J, temp=25, role='fit'))
    c.truth.update(hidden=['rotor_inertia']); c.h6 = (0, 0); return c
@kind
def iron_drag(rng):
    """hysteresis and eddy drag of the iron that grows with load and speed, beyond friction (an effect since; the author had it outside)"""
    c = context(rng, rng.choice(['traction', 'spindle'])); c.runs = plan_good(rng, c); I, Tr, wf = c.I, c.Tr, c.w[1]
    c.b.drag = lambda w, d, q: Tr * (.01 + .03 * (d * d + q * q) / I ** 2 * (w / wf) ** .5 + .01 * w / wf)
    c.truth.update(hidden=['friction', 'iron_drag']); return c
@kind
def mean_map(rng):
    """spreadsheet: one line an operating point, means over ten seconds: speed, id, iq, torque, temperature; no angle"""
    c = context(rng, rng.choice(['servo_ipm', 'traction', 'servo'])); c.style = 'map'; c.b.noise_t *= .3
    catalogue(rng, c, [rng.choice(['reluctance', 'friction'])]); c.runs = []
    return c
@kind
def drive_estimate(rng):
    """"torque" is what the drive computes: k_t i_q; the machine declares a cogging that such a column cannot hold"""
    c = context(rng, rng.choice(['gimbal', 'servo'])); c.runs = plan_good(rng, c); c.style = 'drive'
    n = min(c.true.cog); c.true.cog[n] = c.decl.cog[n] = (.03 * c.Tr, c.true.cog[n][1])
    def post(o): o['T'] = [1.5 * c.decl.emf[1][0] * q for q in o['q']]
    c.post = post; c.truth.update(outside=True, answerable=False); return c
@kind
def range_switch(rng):
    """two runs taken on the transducer's other range, one factor of 5 left in the sheet"""
    c = context(rng, 'servo'); c.runs = plan_good(rng, c); hide('friction', rng, c); c.truth['hidden'] = ['friction']
    for r in c.runs:
        if r.name in ('half_lead', 'quarter'): r.tscale = .2
    c.truth.update(outside=True); return c
@kind
def two_clamps(rng):
    """two clamps, encoder wrapped, one of the current sensors with a wrong gain: not to be told from a weak phase"""
    c = context(rng); c.style = 'two'; c.runs = plan_good(rng, c)
    c.b.ggain[rng.choice([0, 1])] = rng.choice([-1, 1]) * .03
    c.truth.update(hidden=['current_gain'], also_right=[['phase_imbalance'], ['back_emf']]); return c


# ------------------------------------------------------------------
def generate(kind_name, seed, out):
    rng = random.Random(f'{kind_name}/{seed}'); rng.seed_no = seed
    c = KINDS[kind_name](rng); b = c.b
    os.makedirs(f'{out}/runs', exist_ok=True)
    write_machine(out, c.decl_write or c.decl, c.I, rng, c.J, c.rated)
    rl = ['file,role']
    if c.style == 'map':
        lines = ['speed_rpm;id_A;iq_A;torque_Nm;temperature_C']
        for wi in (-1, -.5, -.15, .15, .5, 1):
            for i in (0, .25, .5, .75, 1.):
                for a in ((0,) if i == 0 else (-.5, 0, .5, 1.0)):
                    d, q = pol(i * c.I, a); w = wi * c.w[1]; T = 0
                    for k in range(72): th = TAU * k / 72 / c.true.p; T += c.true.torque(th, Motor.abc(c.true.p * th, d, q)) / 72
                    f = b.fric; T -= f[0] * (1 if w > 0 else -1) + f[1] * w + f[2] * w * abs(w)
                    lines.append(';'.join(num(x, 5) for x in (w * 60 / TAU, d, q, T + rng.gauss(0, b.noise_t), 25.0)))
        put(f'{out}/runs/map.csv', lines); rl.append('runs/map.csv,fit')
    for r in c.runs:
        o = record(rng, c.true, b, r)
        if c.post: c.post(o)
        if hasattr(c, "clock"): o["t"] = [c.clock(r, t) for t in o['t']]
        if getattr(r, 'wrap', False): o['th'] = [x % TAU for x in o['th']]
        if c.style == 'drive':
            n = len(o['t'])
            L = ['time,position,velocity,q_current,d_current,torque'] if False else ['time_s,position,velocity,q_current,d_current,torque']
            L += [','.join(num(x) for x in (o['t'][k], o['th'][k] / TAU, o['w'][k] / TAU, o['q'][k], o['d'][k], o['T'][k])) for k in range(n)]
        elif hasattr(c, 'clock'):
            L = ['time_s,theta_m_rad,speed_rpm,ia_A,ib_A,ic_A,torque_Nm'] + [f"{o['t'][k]:.3f}," + ','.join(num(x) for x in (o['th'][k], o['w'][k] * 60 / TAU, o['ia'][k], o['ib'][k], o['ic'][k], o['T'][k])) for k in range(len(o['t']))]
        else: L = write_run(None, o, c.style, rng, c.temp, c.tdigits)
        if hasattr(c, 'lines'): L = c.lines(L, rng)
        put(f'{out}/runs/{r.name}.csv', L, '\r\n' if c.style == 'german' else '\n')
        rl.append(f'runs/{r.name}.csv,{r.role}')
    put(f'{out}/runs.csv', rl)
    t = dict(kind=kind_name, seed=seed, **c.truth); t.setdefault('tolerated', [])
    if t['plain'] is None: t['plain'] = t['hidden']
    t['machine'] = c.family
    with open(f'{out}/truth.json', 'w') as f: json.dump(t, f, indent=1)


def verify():
    """dW'/dtheta against torque(); electrical energy in = heat-free field energy + shaft work; closed form of the mean; LTI against a brute-force ODE"""
    rng = random.Random(1); worst = 0
    for fam in sorted(set(FAMILIES)):
        m, I, w, _ = make_motor(rng, fam); m.g = [.03, -.02, 0]; m.Isat = .6 * I; m.kx = .1; m.Lsat = .3 * m.emf[1][0] / m.p / I; m.L6 = (.1 * m.Lsat, .4); m.uneven = {1: (.01, .3)}
        for k in range(40):
            th = rng.uniform(0, TAU); i = Motor.abc(m.p * th, rng.uniform(-I, I), rng.uniform(-I, I)); h = 1e-5
            T = m.torque(th, i); D = (m.coenergy(th + h, i) - m.coenergy(th - h, i)) / 2 / h
            worst = max(worst, abs(T - D) / (1.5 * m.emf[1][0] * I))
    print('torque against dW\'/dtheta, share of rated:', worst); assert worst < 1e-6
    # energy over one turn: integral of sum(i dlambda) = integral of T dtheta + change of field energy (0 over the turn)
    m, I, w, _ = make_motor(rng, 'servo_ipm'); m.Isat = .6 * I; m.kx = .1; m.Lsat = .2 * m.Lq; m.cog = {12.0: (.1, 0)}
    def lam(th, i):
        h = 1e-4 * I; o = []
        for k in range(3):
            a = list(i); a[k] += h; c2 = list(i); c2[k] -= h; o.append((m.coenergy(th, a) - m.coenergy(th, c2)) / 2 / h)
        return o
    Nn = 2400; el = me = 0; cur = lambda th: Motor.abc(m.p * th, -.4 * I + .1 * I * math.cos(6 * m.p * th), .8 * I + .1 * I * math.sin(6 * m.p * th))
    for k in range(Nn):
        a, c2 = TAU * k / Nn, TAU * (k + 1) / Nn; mid = (a + c2) / 2; i = cur(mid)
        el += sum(x * (y - z) for x, y, z in zip(i, lam(c2, cur(c2)), lam(a, cur(a)))); me += m.torque(mid, i) * (c2 - a)
    print('electrical, mechanical work of a turn:', el, me); assert abs(el - me) < 2e-4 * abs(me)
    m, I, w, _ = make_motor(rng, 'traction'); d, q = pol(I, .5)
    mean = sum(m.torque(TAU * k / 720 / m.p, Motor.abc(TAU * k / 720, d, q)) for k in range(720)) / 720
    print('mean torque, 3/2 (E iq + p (Ld-Lq) id iq):', mean, 1.5 * (m.emf[1][0] * q + m.p * (m.Ld - m.Lq) * d * q)); assert abs(mean - 1.5 * (m.emf[1][0] * q + m.p * (m.Ld - m.Lq) * d * q)) < 1e-9 * abs(mean)
    # LTI: first-order lag by ODE, both directions
    m, I, w, _ = make_motor(rng, 'servo')
    for sg in (1, -1):
        b = Bench(); tau = 1 / (12 * m.p * w[1]); b.G = lambda s: 1 / (1 + s * tau); r = Run('x', sg * w[1], *pol(I, .2), N=400, turns=.3)
        o = record(rng, m, b, r); b2 = Bench(); r2 = Run('y', sg * w[1], *pol(I, .2), N=40000, turns=.3); o2 = record(rng, m, b2, r2)
        y = o2['T'][0]; dt = o2['t'][1]; e = 0
        for k in range(1, 40000):
            a = math.exp(-dt / tau); y = a * y + (1 - a) * (o2['T'][k] + o2['T'][k - 1]) / 2
            if k % 100 == 0 and k > 20000: e = max(e, abs(y - o['T'][k // 100]))
        print('lag by spectrum against ODE, share of rated:', e / (1.5 * m.emf[1][0] * I)); assert e < 1e-3 * 1.5 * m.emf[1][0] * I
    print('ok')


if __name__ == '__main__':
    if sys.argv[1:2] == ['--list']: print('\n'.join(KINDS))
    elif sys.argv[1:2] == ['--verify']: verify()
    elif len(sys.argv) == 4: generate(sys.argv[1], int(sys.argv[2]), sys.argv[3])
    else: sys.exit(__doc__)
