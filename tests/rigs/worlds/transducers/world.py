"""Recordings of permanent-magnet motors on benches with transducers, encoders and files of several tools, from equations of their own.

Machine: e_s(theta) = sum_mu E_mu sin(mu(theta - 2 pi s/3) + phi_mu), phases a, b, c, times the strength of the magnets that
phase sees; co-energy W(i_d, i_q, theta) for the iron, T = p (dW/dtheta + i_q dW/di_d - i_d dW/di_q); cogging.
Shaft: imposed speed with the ripple of a load machine, or integrated (RK4), with a coupling where there is one.
"""
import math
import os
import zlib
import numpy as np

TAU = 2 * math.pi
PH = np.array([0, TAU / 3, 2 * TAU / 3])


class World:
    def __init__(w, kind, seed):
        w.kind, w.seed = kind, seed
        w.rng = np.random.default_rng([zlib.crc32(kind.encode()), seed])
        r = w.rng
        w.p = int(r.choice([3, 4, 5, 7]))
        w.I0 = r.uniform(6, 20)
        w.K = r.uniform(.1, .35)
        w.T0 = 1.5 * w.K * w.I0
        s = lambda: r.choice([0., math.pi])
        w.emf = {1: (w.K, 0.), 5: (w.K * r.uniform(.02, .05), s()), 7: (w.K * r.uniform(.01, .03), s()),
                 11: (w.K * r.uniform(.004, .012), s()), 13: (w.K * r.uniform(.003, .008), s())}
        w.cog = {6.: (w.T0 * r.uniform(.012, .03), s()), 12.: (w.T0 * r.uniform(.006, .015), s()),
                 18.: (w.T0 * r.uniform(.002, .006), s())}
        w.demf = None   # declared, where it isn't the truth
        w.dcog = None
        w.flux = None   # f(thm, s): relative strength of the magnets that phase s sees
        w.cogmod = None  # f(thm)
        w.mech = []     # (order of the turn, amplitude, phase, per i_q?)
        w.iron = None   # dict
        w.alpha, w.tref = 0., 20.
        w.fric = lambda om, T: 0. * om
        w.J = 0.
        w.bench = []
        w.sigma = .004 * w.T0
        w.isig = .002 * w.I0
        w.adc = w.I0 * 3 / 4096
        w.counts = 16384
        w.quant = w.T0 * 4 / 65536
        w.extra_machine = []
        w.declared_effects = []
        w.declare_ind = False
        w.cols = None
        w.slow = r.uniform(60, 130)
        w.fast = w.slow * r.uniform(5, 7)
        w.n = 5000
        w.shaft = None
        w.speedripple = 3e-4
        w.opts = {}
        w.files = []
        w.flags = []
        w.truth = dict(hidden=[], may=[], values=[], clean=False)
        w.points = w.base()

    def base(w):
        a, b = w.slow, w.fast
        return [('rest_fwd', 'fit', 0, 0, a), ('rest_bwd', 'fit', 0, 0, -a), ('rest_quick', 'fit', 0, 0, b),
                ('full', 'fit', 1, 0, a), ('half_lead', 'fit', .5, .6, -b), ('full_lag', 'fit', 1, -.4, b),
                ('brake', 'fit', 1, math.pi, -a * 1.5), ('quarter', 'fit', .25, 0, b), ('brake_quick', 'fit', .7, math.pi - .3, b * .8),
                ('test1', 'holdout', .75, .3, -b * .6), ('test2', 'holdout', .6, -.2, a * 2)]

    # ---- the machine
    def e(w, thm):
        th = w.p * np.asarray(thm)
        out = []
        for s in range(3):
            v = sum(a * np.sin(m * (th - PH[s]) + f) for m, (a, f) in w.emf.items())
            if w.flux: v = v * w.flux(thm, s)
            out.append(v)
        return np.array(out)

    def W(w, d, q, th):
        """co-energy of the iron, without the magnets' linear part"""
        k = w.iron
        g = k['Iq'] ** 2 * (np.sqrt(1 + (q / k['Iq']) ** 2) - 1) if k.get('Iq') else q * q / 2
        lam = w.K / w.p
        v = .5 * k['Ld'] * d * d + k['Lq'] * g + .5 * k.get('q6', 0) * np.cos(6 * th) * q * q + .5 * k.get('d6', 0) * np.cos(6 * th) * d * d \
            + k.get('dq6', 0) * np.sin(6 * th) * d * q
        if k.get('Ic'): v = v - lam * d * (1 - 1 / (1 + (q / k['Ic']) ** 2))
        return 1.5 * v

    def T(w, thm, ia, ib, ic, temp=20.):
        thm = np.asarray(thm, float)
        th = w.p * thm
        e = w.e(thm) * (1 + w.alpha * (np.asarray(temp) - w.tref))
        T = e[0] * ia + e[1] * ib + e[2] * ic
        d, q = park(th, ia, ib, ic)
        if w.iron:
            h = 1e-4 * w.I0; u = 1e-5
            T = T + w.p * ((w.W(d, q, th + u) - w.W(d, q, th - u)) / (2 * u) + q * (w.W(d + h, q, th) - w.W(d - h, q, th)) / (2 * h)
                           - d * (w.W(d, q + h, th) - w.W(d, q - h, th)) / (2 * h))
        c = sum(a * np.sin(n * th + f) for n, (a, f) in w.cog.items())
        if w.cogmod: c = c * w.cogmod(thm)
        for k, a, f, per in w.mech:
            c = c + a * np.sin(k * thm + f) * (q if per else 1)
        return T + c

    # ---- a steady run, speed imposed by the load machine
    def steady(w, k, rel, gam, rpm, temp=20.):
        r = w.rng
        om = rpm * TAU / 60
        fs = abs(rpm) / 60 * r.uniform(380, 460)
        n = w.n
        t = (np.arange(n) + r.uniform(-.05, .05, n)) / fs
        x0 = r.uniform(0, TAU); ph = r.uniform(0, TAU); a = w.speedripple
        thm = x0 + om * t + a * (np.sin(om * t + ph) - math.sin(ph))
        w_ = om * (1 + a * np.cos(om * t + ph))
        al = -om * om * a * np.sin(om * t + ph)
        th = w.p * thm
        I = rel * w.I0
        rip = w.opts.get('dead', 0) * w.I0 * .02
        i = [I * np.sin(th - PH[s] + gam) + (rip * np.sin(5 * th + PH[s] + .3) + .6 * rip * np.sin(7 * th - PH[s] - .5) if rel else 0) for s in range(3)]
        tp = np.full(n, float(temp)) if np.ndim(temp) == 0 else np.interp(t, [t[0], t[-1]], temp)
        return w.finish(dict(k=k, t=t, thm=thm, om=w_, al=al, i=i, temp=tp))

    def finish(w, c):
        T = w.T(c['thm'], *c['i'], c['temp'])
        c['Tem'] = T
        c['T'] = T - w.J * c['al'] - w.fric(c['om'], T)
        return c

    def read(w, c):
        r = w.rng
        c = dict(c); c['i'] = [x.copy() for x in c['i']]
        n = len(c['t'])
        c['torque'] = c['T'].copy(); c['ang'] = c['thm'].copy(); c['time'] = c['t'].copy()
        for f in w.bench: f(c)
        sg = w.sigma * c.get('nf', 1.)
        wn = r.normal(0, 1, n)
        if w.opts.get('ar'):
            for j in range(1, n): wn[j] += w.opts['ar'] * wn[j - 1]
            wn *= math.sqrt(1 - w.opts['ar'] ** 2)
        c['torque'] = np.round((c['torque'] + sg * wn) / w.quant) * w.quant
        c['i'] = [np.round((x + w.isig * r.normal(0, 1, n)) / w.adc) * w.adc for x in c['i']]
        st = TAU / w.counts
        c['ang'] = np.round(c['ang'] / st) * st
        return c

    def record(w):
        for k, (name, role, rel, gam, rpm) in enumerate(w.points):
            temp = w.opts['temps'][k] if 'temps' in w.opts else 20.
            w.add(name, role, w.read(w.steady(k, rel, gam, rpm, temp)))

    def add(w, name, role, c):
        w.files.append((name, role, c))

    # ---- files
    def write(w, out):
        os.makedirs(out + '/machine', exist_ok=True); os.makedirs(out + '/runs', exist_ok=True)
        with open(out + '/machine/machine.csv', 'w') as f:
            f.write('name,value,unit,source\npole_pairs,%d,1,\nrated_current,%.5g,A,\nrated_torque,%.5g,Nm,\nrated_speed,%.5g,rpm,\n' % (w.p, w.I0, w.T0, w.fast * 1.2))
            for l in w.extra_machine: f.write(l + '\n')
        with open(out + '/machine/back_emf.csv', 'w') as f:
            f.write('order,amplitude_Nm_per_A,phase_rad\n')
            for m, (a, ph) in (w.demf or w.emf).items(): f.write('%d,%.9g,%.9g\n' % (m, a, ph))
        dc = w.cog if w.dcog is None else w.dcog
        if dc:
            with open(out + '/machine/cogging.csv', 'w') as f:
                f.write('order,amplitude_Nm,phase_rad\n')
                for m, (a, ph) in dc.items(): f.write('%.9g,%.9g,%.9g\n' % (m, a, ph))
        if w.declare_ind:
            k = w.iron
            with open(out + '/machine/inductance.csv', 'w') as f:
                f.write('theta_e_rad,La_H,Lb_H,Lc_H,Mab_H,Mbc_H,Mca_H\n')
                for x in np.arange(180) * TAU / 180:
                    # i_a = q sin - d cos: rows of Park; L_abc = (3/2) (2/3)^2 P^T L_dq P  with star (no zero sequence)
                    P = np.array([[-math.cos(x - s) for s in PH], [math.sin(x - s) for s in PH]])
                    ld = k['Ld'] + k.get('d6', 0) * math.cos(6 * x); lq = k['Lq'] + k.get('q6', 0) * math.cos(6 * x); m = k.get('dq6', 0) * math.sin(6 * x)
                    L = 1.5 * (2 / 3) ** 2 * P.T @ np.array([[ld, m], [m, lq]]) @ P
                    f.write(','.join('%.12g' % v for v in (x, L[0, 0], L[1, 1], L[2, 2], L[0, 1], L[1, 2], L[2, 0])) + '\n')
        if w.declared_effects:
            with open(out + '/machine/effects.csv', 'w') as f:
                f.write('effect,parameter,value,unit,std_error\n' + ''.join(l + '\n' for l in w.declared_effects))
        with open(out + '/runs.csv', 'w') as f:
            f.write('file,role\n' + ''.join('runs/%s.csv,%s\n' % (n, r) for n, r, _ in w.files))
        for n, r, c in w.files:
            cols = c.get('cols') or w.cols or ('time_s', 'theta_m_rad', 'ia_A', 'ib_A', 'ic_A', 'torque_Nm')
            src = {'time_s': ('time', '%.6f'), 'theta_m_rad': ('ang', '%.6f'), 'torque_Nm': ('torque', '%.6g'), 'temperature_C': ('temp', '%.2f'),
                   'speed_rpm': ('rpm', '%.3f'), 'id_A': ('id', '%.5g'), 'iq_A': ('iq', '%.5g')}
            D = []; F = []
            for q in cols:
                if q in ('ia_A', 'ib_A', 'ic_A'): D.append(c['i']['abc'.index(q[1])]); F.append('%.6g')
                else: D.append(np.asarray(c[src[q][0]], float)); F.append(src[q][1])
            sep = ','; txt = None
            if w.opts.get('german'):
                sep = ';'
            with open(out + '/runs/%s.csv' % n, 'w') as f:
                f.write(sep.join(cols) + '\n')
                for row in zip(*D):
                    l = sep.join(a % v for a, v in zip(F, row))
                    f.write((l.replace('.', ',') if w.opts.get('german') else l) + '\n')

    # ---- expectations
    def hides(w, eff, vals=(), alt=()):
        w.truth['hidden'].append([eff, *alt]); w.truth['values'] += [(eff, *v) for v in vals]

    def may(w, *e): w.truth['may'] += e


def park(th, ia, ib, ic):
    i = (ia, ib, ic)
    return (-2 / 3 * sum(i[s] * np.cos(th - PH[s]) for s in range(3)), 2 / 3 * sum(i[s] * np.sin(th - PH[s]) for s in range(3)))


def unpark(th, d, q):
    return [q * np.sin(th - s) - d * np.cos(th - s) for s in PH]


def fine(w, c, tt):
    """the torque of a steady run at any time (also before the first sample), from the machine itself"""
    t = c['t']; om = float(np.mean(c['om']))
    thm = np.where(tt < t[0], c['thm'][0] + om * (tt - t[0]), np.interp(tt, t, c['thm']))
    d, q = park(w.p * c['thm'], *c['i'])
    return w.T(thm, *unpark(w.p * thm, float(np.mean(d)), float(np.mean(q))))


def lag2(w, c, fn, z):
    """second order low pass, exact for an input that is linear between points 8 times as close as the samples"""
    t = c['t']; h = float(np.median(np.diff(t))) / 8; wn = TAU * fn
    g = np.arange(t[0] - 12 / wn / z, t[-1] + h, h); y = fine(w, c, g)
    A = np.array([[0, 1, 0, 0], [-wn * wn, -2 * z * wn, wn * wn, 0], [0, 0, 0, 1], [0, 0, 0, 0]], float) * h
    A[2, 3] = 1.  # slope is per step
    A[2, :3] = 0
    E = np.eye(4); X = np.eye(4)
    for k in range(1, 30): X = X @ A / k; E = E + X
    a, v = float(y[:1][0]), 0.; o = np.empty_like(y); o[0] = a
    for j in range(len(y) - 1):
        u, s = y[j], y[j + 1] - y[j]
        a, v = E[0, 0] * a + E[0, 1] * v + E[0, 2] * u + E[0, 3] * s, E[1, 0] * a + E[1, 1] * v + E[1, 2] * u + E[1, 3] * s
        o[j + 1] = a
    return np.interp(t, g, o)


def lag1(t, x, tau):
    h = np.diff(t, prepend=t[0] - (t[1] - t[0]))
    o = np.empty_like(x); a = x[0]
    # exact for piecewise linear input; settled by running the first part twice
    for rep in (0, 1):
        for j in range(len(x) if rep else min(len(x), 600)):
            k = math.exp(-h[j] / tau); x0 = x[j - 1] if j else x[0]; s = (x[j] - x0) / h[j]
            a = x[j] - s * tau + (a - x0 + s * tau) * k; o[j] = a
    return o


K = {}


def kind(f):
    K[f.__name__] = f
    return f


# =============================== nothing hidden ===============================
@kind
def clean_noise_differs(w):
    f = [1, 3, .6, 2, 1, 1.5, .7, 4, 1, 1, 1]
    w.bench.append(lambda c: c.update(nf=f[c['k']])); w.opts['ar'] = .6; w.record()


@kind
def clean_pwm_alias(w):
    def b(c):  # triangular ripple of the PWM, sampled asynchronously; the transducer's amplifier doesn't pass it
        for s in range(3):
            x = c['t'] * 9973.; tri = 2 * np.abs(2 * (x + s * .31 - np.floor(x + s * .31 + .5))) - 1
            if np.any(c['i'][0]): c['i'][s] = c['i'][s] + .03 * w.I0 * tri * np.sin(w.p * c['thm'] - PH[s]) ** 2
        m = sum(c['i']) / 3
        for s in range(3): c['i'][s] -= m
    w.bench.append(b); w.record()


@kind
def clean_can(w):
    w.n = 9000; w.points = [(a, b, c_, d, np.sign(e) * min(abs(e), w.slow * 2)) for a, b, c_, d, e in w.points]
    def b(c):  # torque 1/5 of the rate of the rest, held
        c['hold'] = 5
    w.bench.append(b)
    w.record()
    for n, r, c in w.files:
        j = (np.arange(len(c['t'])) // 5) * 5
        c['torque'] = c['torque'][j]
        c['time'] = np.round(c['time'], 3 if w.seed == 2 else 4)


@kind
def clean_spreadsheet(w):
    w.opts['german'] = True; w.record()
    for n, r, c in w.files:   # resampled linearly onto an even grid with another step; abc -> i_d,i_q by the user's macro
        d, q = park(w.p * c['thm'], *c['i'])
        g = np.linspace(c['t'][2], c['t'][-3], int(len(c['t']) * 1.7))
        c['id'], c['iq'] = np.interp(g, c['t'], d), np.interp(g, c['t'], q)
        c['ang'] = np.interp(g, c['t'], c['ang']); c['torque'] = np.interp(g, c['t'], c['torque']); c['time'] = g
        c['cols'] = ('time_s', 'theta_m_rad', 'id_A', 'iq_A', 'torque_Nm')


@kind
def clean_skewed(w):
    w.emf = {1: (w.K, 0.)}; w.cog = {6.: (w.T0 * 3e-4, 0.)}; w.sigma *= 3; w.record()


@kind
def clean_regen_ipm(w):
    ipm(w, False); w.declare_ind = True
    w.points = [(a, b, c_, math.pi - d if c_ else 0, e) for a, b, c_, d, e in w.points]; w.record()


@kind
def clean_ipm_many_id(w):
    ipm(w, False); w.declare_ind = True
    w.points = [('rest', 'fit', 0, 0, w.slow)] + [('p%d%d' % (i, j), 'fit', I, g, (w.slow if (i + j) % 2 else -w.fast)) for i, I in enumerate((.3, .65, 1)) for j, g in enumerate((-.5, 0, .5, 1))] + \
        [('test', 'holdout', .8, .3, w.slow * 2)]
    w.n = 3500; w.record()


@kind
def clean_start(w):   # currents and speed rise within the file; rotor is light, so nothing but e i
    for k, (rel, gam, r0, r1) in enumerate(((0, 0, 20, w.fast), (1, 0, 20, w.fast), (.6, .4, -20, -w.fast), (1, math.pi, 30, w.fast), (.5, -.5, w.fast, 30), (.8, .2, -30, -w.fast))):
        n = 8000; T = 6.; t = (np.arange(n) + .5) * T / n
        om = (r0 + (r1 - r0) * (t / T)) * TAU / 60; thm = 1.1 * k + np.cumsum(om) * T / n
        I = rel * w.I0 * (1 - np.exp(-t / .8))
        i = [I * np.sin(w.p * thm - s + gam) for s in PH]
        c = w.finish(dict(k=k, t=t, thm=thm, om=om, al=0 * t, i=i, temp=20 + 0 * t))
        w.add('start%d' % k, 'fit' if k < 5 else 'holdout', w.read(c))


@kind
def clean_deadtime(w):
    w.opts['dead'] = 1; w.record()


@kind
def clean_coarse_adc(w):   # 8 bits of current, 10 bits of torque, 1024 counts
    w.adc = w.I0 * 2.5 / 256; w.quant = w.T0 * 2.6 / 1024; w.counts = 4096; w.sigma *= .5; w.record()


@kind
def clean_temp_declared(w):
    w.alpha = -.0012; w.declared_effects = ['magnet_temperature,emf_per_kelvin,-0.0012,1/K,', 'magnet_temperature,reference,20,C,']
    w.opts['temps'] = [(22 + 6 * k, 27 + 6 * k) for k in range(11)]
    w.cols = ('time_s', 'theta_m_rad', 'ia_A', 'ib_A', 'ic_A', 'torque_Nm', 'temperature_C'); w.record()


@kind
def clean_indexing_head(w):  # locked in a dividing head, 0.5 deg, each held 3 s, mean of it
    for k, (rel, gam) in enumerate(((0, 0), (1, 0), (.5, .5), (1, -.5), (.7, math.pi), (.8, .2))):
        step = math.radians(.5 if w.p < 5 else .3); thm = np.arange(0, TAU, step) + .013
        i = [rel * w.I0 * np.sin(w.p * thm - s + gam) for s in PH]
        c = w.finish(dict(k=k, t=3. * np.arange(len(thm)), thm=thm, om=0 * thm, al=0 * thm, i=i, temp=20 + 0 * thm))
        c['cols'] = ('theta_m_rad', 'ia_A', 'ib_A', 'ic_A', 'torque_Nm')
        w.add('head%d' % k, 'fit' if k < 5 else 'holdout', w.read(c))


@kind
def clean_belt_load(w):  # load behind a belt: the torque really swings at the belt's frequency (light rotor, stiff shaft: speed hardly)
    def b(c):
        f = abs(np.mean(c['om'])) / TAU * .3719
        amp = .02 * w.T0
        # the drive's speed loop answers with i_q: machine torque swings, sensor sees it: consistent, so nothing is hidden
    def mk(k, rel, gam, rpm):
        c = w.steady(k, rel, gam, rpm)
        f = abs(rpm) / 60 * .3719
        sw = 1 + (.08 * np.sin(TAU * f * c['t'] + 1) + .03 * np.sin(2 * TAU * f * c['t']))
        c['i'] = [x * sw for x in c['i']]
        return w.finish(c)
    for k, (name, role, rel, gam, rpm) in enumerate(w.points): w.add(name, role, w.read(mk(k, rel, gam, rpm)))


# =============================== one thing hidden ===============================
def ipm(w, sat=True):
    L = w.K / w.p / w.I0   # flux/current: 1 p.u.
    w.iron = dict(Ld=.25 * L, Lq=.6 * L, q6=.02 * L, d6=.012 * L, dq6=.01 * L)
    if sat: w.iron.update(Iq=1.1 * w.I0, Ic=3.5 * w.I0)


@kind
def ts_hysteresis(w):   # play of the strain-gauge body: +-0.5 % of full scale, history along the run
    h = .006 * w.T0
    def b(c):
        y = 0.; o = np.empty_like(c['torque'])
        for j, u in enumerate(c['torque']):
            y = min(max(y, u - h), u + h); o[j] = y
        c['torque'] = o
    w.bench.append(b); w.record(); w.truth['none_named'] = True


@kind
def spline_backlash(w):  # rotor J, spline with play 0.4 deg, sensor stiff behind; load speed imposed; contact damping
    w.points = [q for q in w.points]
    J = 8e-5 * w.T0; kc = 600 * w.T0; play = math.radians(.25); z = 2 * .15 * math.sqrt(kc * J)
    for k, (name, role, rel, gam, rpm) in enumerate(w.points):
        om = rpm * TAU / 60; fs = abs(rpm) / 60 * 420; n = 4200; sub = max(4, int(1.2 * math.sqrt(kc / J) / fs * 3) + 1)
        h = 1 / fs / sub; th = om * 0.; x = .3 * k; v = om
        P = 4096; g = np.arange(P + 1) / P * TAU
        tab = w.T(g, *unpark(w.p * g, -rel * w.I0 * math.sin(gam), rel * w.I0 * math.cos(gam)))
        xs = np.empty(n); T = np.empty(n); vs = np.empty(n); l = x
        for j in range(-600, n):
            for _ in range(sub):
                d = x - l
                tc = kc * (d - play) + z * (v - om) if d > play else (kc * (d + play) + z * (v - om) if d < -play else 0.)
                u = (x % TAU) / TAU * P; a = int(u); te = tab[a] + (tab[a + 1] - tab[a]) * (u - a)
                v += h * (te - tc) / J; x += h * v; l += h * om
            if j >= 0: xs[j] = x; T[j] = tc; vs[j] = v
        i = unpark(w.p * xs, -rel * w.I0 * math.sin(gam), rel * w.I0 * math.cos(gam))
        c = dict(k=k, t=np.arange(n) / fs, thm=xs, om=vs, i=i, temp=20 + 0 * xs, T=T)
        w.add(name, role, w.read(c))
    w.may('rotor_inertia', 'torque_sensor'); w.truth['none_named'] = True


@kind
def temp_rise_logged(w):
    w.alpha = -.0011; w.opts['temps'] = [(22 + 6 * k, 27 + 6 * k) for k in range(11)]
    w.cols = ('time_s', 'theta_m_rad', 'ia_A', 'ib_A', 'ic_A', 'torque_Nm', 'temperature_C'); w.record()
    w.hides('magnet_temperature', [('emf_per_kelvin', -.0011)])


@kind
def temp_rise_unlogged(w):
    w.alpha = -.0011; w.opts['temps'] = [(22 + 6 * k, 27 + 6 * k) for k in range(11)]; w.record()
    w.may('back_emf'); w.truth['none_named'] = True


@kind
def gain_by_sign(w):
    def b(c): c['i'][0] = c['i'][0] * np.where(c['i'][0] > 0, 1.03, 1.)
    w.bench.append(b); w.record(); w.may('current_gain', 'current_offset'); w.truth['none_named'] = True


@kind
def encoder_interp(w):  # sine encoder of 4 periods an electrical... lines = 4 p periods a turn; errors twice and 4 times a line period
    L = 4 * w.p
    def b(c): c['ang'] = c['ang'] + math.radians(.25) / w.p * 4 * (np.sin(2 * L * c['thm'] + .4) + .5 * np.sin(4 * L * c['thm'] + 1)) / 1
    w.cog[24.] = (w.T0 * .01, 0.)
    w.bench.append(b); w.record(); a = math.radians(1.)
    w.hides('position_harmonics', [('sine_8', a * math.cos(.4)), ('cosine_8', a * math.sin(.4)), ('sine_16', .5 * a * math.cos(1)), ('cosine_16', .5 * a * math.sin(1))])


@kind
def brake_stick(w):  # friction brake sticks and slips at the end of a soft shaft; rotor between air gap and sensor has J
    J = .004 * w.T0 / 2; ks = 25 * w.T0; Jb = .003 * w.T0
    for k, (rel, gam, role) in enumerate(((.5, 0, 'fit'), (1, 0, 'fit'), (.7, .4, 'fit'), (.8, -.4, 'fit'), (.3, 0, 'fit'), (.6, .2, 'holdout'))):
        fs = 2000.; sub = 4; h = 1 / fs / sub; n = 12000
        P = 4096; g = np.arange(P + 1) / P * TAU; sgn = -1 if k in (2, 4) else 1
        q, d = sgn * rel * w.I0 * math.cos(gam), -rel * w.I0 * math.sin(gam)
        tab = w.T(g, *unpark(w.p * g, d, q))
        Tb = 1.5 * w.K * abs(q); x = .2; v = 0.; y = .2; u = 0.
        X = np.empty(n); V = np.empty(n); S = np.empty(n); A = np.empty(n)
        for j in range(n):
            for _ in range(sub):
                a_ = (x % TAU) / TAU * P; m = int(a_); te = tab[m] + (tab[m + 1] - tab[m]) * (a_ - m)
                ts = ks * (x - y) + .03 * w.T0 * (v - u)
                al = (te - ts) / J; v += h * al; x += h * v
                f = Tb * (.80 + .25 * math.exp(-(u / 1.5) ** 2)) + .012 * w.T0 * abs(u)
                if u == 0. and abs(ts) < f: pass
                else:
                    un = u + h * (ts - f * (math.copysign(1, u) if u else math.copysign(1, ts))) / Jb
                    u = 0. if u * un < 0 else un
                y += h * u
            X[j] = x; V[j] = v; S[j] = ts; A[j] = al
        c = dict(k=k, t=np.arange(n) / fs, thm=X, om=V, i=unpark(w.p * X, d, q), temp=20 + 0 * X, T=S, al=A)
        w.add('brake%d' % k, role, w.read(c))
    w.truth['J'] = J; w.hides('rotor_inertia', [('inertia', J)]); w.may('friction')


@kind
def gearbox(w):  # torque behind a gear 1:6 (divided by it), loss in proportion to |T|, mesh once per pinion tooth (17) in proportion to T
    w.bench.append(lambda c: c.update(torque=c['torque'] * (1 + .006 * np.sin(17 * c['thm'] + .5)) - .03 * np.abs(c['torque']) * np.sign(c['om']) - .01 * w.T0 * np.sign(c['om'])))
    w.record(); w.hides('mechanical_order', alt=('back_emf', 'unknown')); w.may('friction', 'unequal_magnets', 'back_emf'); w.truth['load_friction'] = True


@kind
def indexing_slot_order(w):
    clean_indexing_head(w)
    n = w.p * 2; w.files = []
    w.mech = [(9 if w.p != 3 else 8, .006 * w.T0, .7, False)]
    clean_indexing_head(w); k = w.mech[0][0] / w.p
    w.hides('cogging', alt=('mechanical_order',)); w.may('mechanical_order')


@kind
def offset_creeps(w):  # zero of the clamp on phase b creeps with the warming electronics, run by run
    def b(c): c['i'][1] = c['i'][1] + w.I0 * (.004 + .004 * c['k'])
    w.bench.append(b); w.record(); w.may('current_offset'); w.truth['none_named'] = True


@kind
def torque_zero_wanders(w):
    z = w.rng.normal(0, .01 * w.T0, 11)
    w.bench.append(lambda c: c.update(torque=c['torque'] + z[c['k']])); w.record(); w.truth['none_named'] = True


@kind
def magnets_uneven(w):  # phases in sectors of a third: each sees its own magnets; one magnet pair weak
    m = .03
    w.flux = lambda thm, s: 1 + m * np.cos(thm - PH[s] + .4)
    w.cogmod = lambda thm: 1 + .5 * m * np.cos(thm + .4)
    w.record(); w.hides('mechanical_order', alt=('unequal_magnets',)); w.may('unequal_magnets', 'mechanical_order', 'back_emf', 'cogging')


@kind
def ipm_hidden(w):
    ipm(w, True)
    w.points = [('rest', 'fit', 0, 0, w.slow)] + [('p%d%d' % (i, j), 'fit', I, g, (w.slow if (i + j) % 2 else -w.slow * 3)) for i, I in enumerate((.25, .5, .75, 1)) for j, g in enumerate((-.5, 0, .6))] + \
        [('test', 'holdout', .85, .3, w.slow * 2), ('test2', 'holdout', .6, .5, -w.slow * 2)]
    w.n = 3500; w.record(); w.hides('reluctance'); w.hides('saturation'); w.may('back_emf', 'cogging')


@kind
def one_load(w):  # a single load, no idle run; declared EMF lacks 5, 7: 6th order may be cogging or back-EMF
    w.demf = {k: v for k, v in w.emf.items() if k in (1, 11, 13)}
    w.points = [('a', 'fit', .8, 0, w.slow), ('b', 'fit', .8, 0, w.slow * 2), ('c', 'fit', .8, 0, w.slow * 4), ('t', 'holdout', .8, 0, w.slow * 3)]
    w.record(); w.hides('back_emf'); w.may('cogging', 'reluctance', 'saturation'); w.truth['ambiguous'] = True


def one_file(w, f, k=5):
    w.bench.append(lambda c: f(c) if c['k'] == k else None); w.record(); w.truth['one_file'] = w.points[k][0]; w.truth['none_named'] = True


@kind
def file_swapped_bc(w): one_file(w, lambda c: c.update(i=[c['i'][0], c['i'][2], c['i'][1]]))


@kind
def file_ncm(w): one_file(w, lambda c: c.update(torque=c['torque'] * 100))


@kind
def file_sign(w): one_file(w, lambda c: c.update(torque=-c['torque']))


@kind
def file_rms(w): one_file(w, lambda c: c.update(i=[x / math.sqrt(2) for x in c['i']]))


@kind
def file_index(w): one_file(w, lambda c: c.update(ang=c['ang'] + math.radians(9) / w.p))


@kind
def iron_drag(w):
    H, E = .012 * w.T0 / w.I0 ** 2, .012 * w.T0 / w.I0 ** 2 / (w.fast * TAU / 60)
    def fin(c):
        c['T'] = c['T'] - (H * np.sign(c['om']) + E * c['om']) * 2 / 3 * sum(x * x for x in c['i']); return c
    for k, (name, role, rel, gam, rpm) in enumerate(w.points): w.add(name, role, w.read(fin(w.steady(k, rel, gam, rpm))))
    w.hides('iron_drag', [('hysteresis', H), ('eddy', E)])


@kind
def skew_not_declared(w):  # tables are of the unskewed field solution; the rotor is skewed by 2/3 of 60 deg electrical
    a = math.radians(20.)
    sk = lambda n: math.sin(n * a / 2) / (n * a / 2)
    w.demf = dict(w.emf); w.dcog = dict(w.cog)
    w.emf = {n: (v[0] * sk(n), v[1]) for n, v in w.emf.items()}; w.cog = {n: (v[0] * sk(n), v[1]) for n, v in w.cog.items()}
    w.record(); w.hides('back_emf', [('sine_5', w.emf[5][0] * math.cos(w.emf[5][1]) - w.demf[5][0] * math.cos(w.demf[5][1]))])
    w.hides('cogging', [('sine_6', w.cog[6.][0] * math.cos(w.cog[6.][1]) - w.dcog[6.][0] * math.cos(w.dcog[6.][1]))])


@kind
def parallel_paths(w):  # circulating currents of an eccentric rotor in parallel paths brake: B(theta) w, 1 + .5 cos 2 thm
    B = .02 * w.T0 / (w.fast * TAU / 60)
    for k, (name, role, rel, gam, rpm) in enumerate(w.points):
        c = w.steady(k, rel, gam, rpm); c['T'] = c['T'] - B * c['om'] * (1 + .4 * np.cos(2 * c['thm'] + .3)); w.add(name, role, w.read(c))
    w.hides('friction', [('viscous', B)]); w.may('unknown'); w.truth['partly'] = True


@kind
def torque_butterworth(w):  # amplifier: 2nd order Butterworth; sits in the band of the fast runs
    fn = 9 * w.p * w.fast / 60
    w.bench.append(lambda c: c.update(torque=lag2(w, c, fn, .7071))); w.n = 4000; w.record()
    w.hides('torque_sensor', [('natural_frequency', fn), ('damping', .7071)])


@kind
def torque_moving_mean(w):  # display unit shows the mean of the last 5 ms
    def b(c): c['torque'] = sum(fine(w, c, c['t'] - .005 * (j + .5) / 40) for j in range(40)) / 40
    w.bench.append(b); w.record(); w.hides('channel_delay', alt=('torque_sensor',)); w.may('torque_sensor', 'channel_delay')


@kind
def can_torque_late(w):
    tau = .0031
    w.bench.append(lambda c: c.update(torque=fine(w, c, c['t'] - tau))); w.record()
    for n, r, c in w.files:
        for q in ('torque', 'ang', 'time', 't'): c[q] = c[q][60:]
        c['i'] = [x[60:] for x in c['i']]
        c['time'] = c['time'] + w.rng.uniform(0, 5e-5, len(c['time'])); c['time'] = np.maximum.accumulate(c['time'])
    w.hides('channel_delay', [('torque', tau)])


@kind
def tenth_cogging(w):
    a = .1 * w.sigma
    w.dcog = dict(w.cog); w.cog = dict(w.cog); w.cog[24.] = (a, .6)
    w.record(); w.hides('cogging', [('sine_24', a * math.cos(.6)), ('cosine_24', a * math.sin(.6))]); w.truth['small'] = True


@kind
def tenth_offset(w):
    o = .1 * w.isig / w.I0 * w.I0
    o = .1 * w.sigma / w.K / 1.
    w.bench.append(lambda c: c['i'].__setitem__(0, c['i'][0] + o)); w.record(); w.hides('current_offset', [('a', o)]); w.truth['small'] = True


@kind
def three_together(w):  # angle zero, friction, EMF
    w.demf = dict(w.emf); w.emf = dict(w.emf); w.emf[5] = (w.emf[5][0] * 1.5, w.emf[5][1])
    d = math.radians(2.); Tc, B = .015 * w.T0, .01 * w.T0 / (w.fast * TAU / 60)
    w.fric = lambda om, T: Tc * np.sign(om) + B * om
    w.bench.append(lambda c: c.update(ang=c['ang'] + d / w.p)); w.record()
    w.hides('position_offset', [('angle', d)]); w.hides('friction', [('coulomb', Tc), ('viscous', B)])
    w.hides('back_emf', [('sine_5', .5 / 1.5 * w.emf[5][0] * math.cos(w.emf[5][1]))])


@kind
def temp_zero_cogging(w):  # magnets warm (logged), zero of the torque sensor, a cogging order not declared
    w.alpha = -.0018; w.opts['temps'] = [(22 + 6 * k, 27 + 6 * k) for k in range(11)]
    w.dcog = {k: v for k, v in w.cog.items() if k != 12.}; z = .012 * w.T0
    w.cols = ('time_s', 'theta_m_rad', 'ia_A', 'ib_A', 'ic_A', 'torque_Nm', 'temperature_C')
    w.bench.append(lambda c: c.update(torque=c['torque'] + z)); w.record()
    w.hides('magnet_temperature', [('emf_per_kelvin', -.0018)]); w.hides('torque_sensor', [('offset', z)]); w.hides('cogging', [('sine_12', w.cog[12.][0] * math.cos(w.cog[12.][1]))])


@kind
def eccentric_and_mesh(w):
    a = math.radians(.35)
    w.bench.append(lambda c: c.update(ang=c['ang'] + a * np.sin(c['thm'] + .8)))
    w.mech = [(11, .008 * w.T0, .3, False)]
    w.record(); w.hides('position_eccentricity', [('mech_sine_1', a * math.cos(.8)), ('mech_cosine_1', a * math.sin(.8))]); w.hides('mechanical_order', alt=('cogging',)); w.may('cogging')


@kind
def start_with_inertia(w):  # ramps by the load machine; J and friction before the sensor
    J = .03 * w.T0 / (w.fast * TAU / 60 / 3); Tc = .015 * w.T0
    w.fric = lambda om, T: Tc * np.sign(om); w.J = J
    for k, (rel, gam, r0, r1) in enumerate(((0, 0, 20, w.fast), (1, 0, 20, w.fast), (.6, .4, -20, -w.fast), (1, math.pi, 30, w.fast), (.5, -.5, w.fast, 30), (.8, .2, -30, -w.fast))):
        n = 8000; T = 3.; t = (np.arange(n) + .5) * T / n
        om = (r0 + (r1 - r0) * (t / T)) * TAU / 60; al = 0 * t + (r1 - r0) / T * TAU / 60
        thm = 1.1 * k + r0 * TAU / 60 * t + al * t * t / 2
        I = rel * w.I0 * (1 - np.exp(-t / .5))
        w.add('start%d' % k, 'fit' if k < 5 else 'holdout', w.read(w.finish(dict(k=k, t=t, thm=thm, om=om, al=al, i=[I * np.sin(w.p * thm - s + gam) for s in PH], temp=20 + 0 * t))))
    w.hides('rotor_inertia', [('inertia', J)]); w.hides('friction', [('coulomb', Tc)])


@kind
def free_shaft(w):  # no torque sensor; drive accelerates and brakes the bare rotor, i_q steps; hidden cogging 12 larger, friction
    J = w.T0 / 400.; Tc, B = .02 * w.T0, .01 * w.T0 / 60
    w.extra_machine = ['inertia,%.9g,kgm2,' % J]
    w.dcog = dict(w.cog); w.cog = dict(w.cog); w.cog[12.] = (w.cog[12.][0] + .03 * w.T0, w.cog[12.][1])
    P = 8192; g = np.arange(P + 1) / P * TAU; tq = w.T(g, *unpark(w.p * g, 0, 1.)); tc = w.T(g, 0 * g, 0 * g, 0 * g); tq = tq - tc
    w.balance = []
    for k, (rel, per, role) in enumerate(((.25, .5, 'fit'), (.4, .35, 'fit'), (.15, .8, 'fit'), (.3, .45, 'fit'), (.2, .6, 'holdout'))):
        fs = 4000.; sub = 2; h = 1 / fs / sub; n = 12000; x = .4 * k; v = 0.; X = np.empty(n); V = np.empty(n); Q = np.empty(n); work = loss = 0.; iq = 0.
        for j in range(n):
            for _ in range(sub):
                t = (j + _ / sub) / fs; ref = rel * w.I0 * (1 if (t / per) % 2 < 1 else -1); iq += h * (ref - iq) / .002
                def f(x, v):
                    u = (x % TAU) / TAU * P; m = int(u); return iq * (tq[m] + (tq[m + 1] - tq[m]) * (u - m)) + tc[m] + (tc[m + 1] - tc[m]) * (u - m) - B * v - Tc * math.tanh(v / .02)
                a1 = f(x, v); a2 = f(x + h / 2 * v, v + h / 2 * a1 / J)
                vn = v + h * a2 / J; vm = (v + vn) / 2
                work += a2 * vm * h; x += h * vm; v = vn
            X[j] = x; V[j] = v; Q[j] = iq
        w.balance.append((work, .5 * J * v * v))
        c = dict(k=k, t=np.arange(1, n + 1) / fs, thm=X, om=V, i=unpark(w.p * X, 0 * Q, Q), temp=20 + 0 * X, T=0 * X)
        c['cols'] = ('time_s', 'theta_m_rad', 'ia_A', 'ib_A', 'ic_A'); w.add('free%d' % k, role, w.read(c))
    w.hides('cogging', [('sine_12', .03 * w.T0 * math.cos(w.cog[12.][1]))]); w.hides('friction', [('coulomb', Tc)])


@kind
def slow_hold(w):  # position control turns at 3 rpm, current answers cogging and friction; no torque column
    w.extra_machine = ['inertia,%.6g,kgm2,' % (w.T0 / 4000)]
    w.dcog = dict(w.cog); w.cog = dict(w.cog); w.cog[12.] = (w.cog[12.][0] + .02 * w.T0, w.cog[12.][1]); Tc = .02 * w.T0
    for k, (rpm, role) in enumerate(((3, 'fit'), (-3, 'fit'), (4, 'fit'), (-4, 'holdout'))):
        fs = 200.; n = 8000; t = np.arange(n) / fs; om = rpm * TAU / 60; thm = .3 + om * t
        e = w.e(thm); den = sum(e[s] * np.sin(w.p * thm - PH[s]) for s in range(3))
        q = (-w.T(thm, 0 * t, 0 * t, 0 * t) + Tc * math.copysign(1, rpm)) / den
        c = dict(k=k, t=t, thm=thm, om=om + 0 * t, i=unpark(w.p * thm, 0 * q, q), temp=20 + 0 * t, T=0 * t)
        c['cols'] = ('time_s', 'theta_m_rad', 'ia_A', 'ib_A', 'ic_A'); w.add('hold%d' % k, role, w.read(c))
    w.flags = ['--holding']
    w.hides('cogging', [('sine_12', .02 * w.T0 * math.cos(w.cog[12.][1]))]); w.hides('friction', [('coulomb', Tc)])


@kind
def turn_short(w):
    w.flux = lambda thm, s: .96 if s == 1 else 1.
    w.record(); w.hides('phase_imbalance', [('b', -.04)], alt=('back_emf',)); w.may('back_emf')


@kind
def crosstalk(w):  # conductor of phase b passes the clamp of a: +1.5 % of i_b
    def b(c): c['i'][0] = c['i'][0] + .02 * c['i'][1]
    w.bench.append(b); w.record(); w.may('current_gain', 'position_offset'); w.truth['none_named'] = True


@kind
def torque_not_linear(w):  # transducer: 1.5 % of full scale quadratic
    w.bench.append(lambda c: c.update(torque=c['torque'] + .02 * c['torque'] ** 2 / w.T0)); w.record(); w.truth['none_named'] = True


@kind
def transducer_turns(w):  # rotating transducer reads a bending moment: once a turn, whatever the load; and centrifugal w^2 zero
    z = .01 * w.T0 / (w.fast * TAU / 60) ** 2
    w.bench.append(lambda c: c.update(torque=c['torque'] + .01 * w.T0 * np.sin(c['thm'] + .9) + z * c['om'] ** 2)); w.record()
    w.hides('mechanical_order', [('sine_%.6g' % (1 / w.p), .01 * w.T0 * math.cos(.9)), ('cosine_%.6g' % (1 / w.p), .01 * w.T0 * math.sin(.9))]); w.may('unknown'); w.truth['partly'] = True


@kind
def kt_droops(w):
    w.iron = dict(Ld=0, Lq=0, Ic=3 * w.I0); w.record(); w.hides('saturation'); w.may('back_emf')


@kind
def friction_warms(w):  # grease: drag falls from run to run (exp), and with speed
    for k, (name, role, rel, gam, rpm) in enumerate(w.points):
        c = w.steady(k, rel, gam, rpm); f = .03 * w.T0 * (.4 + .6 * math.exp(-k / 3)); c['T'] = c['T'] - f * np.sign(c['om']); w.add(name, role, w.read(c))
    w.may('friction'); w.truth['none_named'] = True


@kind
def drive_estimate(w):  # torque column is the drive's estimate: k_t i_q behind a filter, rounded; no transducer
    def b(c):  # the drive computes it from the currents that it reads, so their noise is in it; its filter is 2 ms
        c['i'] = [x + w.isig * w.rng.normal(0, 1, len(x)) for x in c['i']]
        c['torque'] = lag1(c['t'], 1.5 * w.K * park(w.p * c['thm'], *c['i'])[1], .002)
    w.isig0 = w.isig
    w.bench.append(b); w.bench.append(lambda c: c.update(nf=1e-6)); w.quant = w.T0 / 2000
    w.bench.append(lambda c: setattr(w, 'isig', 0)); w.bench.insert(0, lambda c: setattr(w, 'isig', w.isig0))
    w.record(); w.truth['none_named'] = True


@kind
def theta_e_ecc(w):  # drive logs only the wrapped electrical angle; encoder eccentric
    a = math.radians(.5)
    w.bench.append(lambda c: c.update(ang=c['ang'] + a * np.sin(c['thm'] + .8))); w.record()
    for n, r, c in w.files: c['ang'] = np.mod(c['ang'], TAU)
    w.hides('position_eccentricity', [('mech_sine_1', a * math.cos(.8)), ('mech_cosine_1', a * math.sin(.8))])


@kind
def pwm_and_delay(w):  # currents late by 120 us, PWM ripple aliased in them
    tau = 1.2e-4 * 600 / w.fast
    def b(c):
        d = [np.interp(c['t'] - tau, c['t'], x) for x in c['i']]
        I = park(w.p * c['thm'], *c['i'])
        c['i'] = unpark(w.p * (c['thm'] - c['om'] * tau), *I)
        for s in range(3):
            x = c['t'] * 9973.; tri = 2 * np.abs(2 * (x + s * .31 - np.floor(x + s * .31 + .5))) - 1
            if np.any(c['i'][0]): c['i'][s] = c['i'][s] + .03 * w.I0 * tri * np.sin(w.p * c['thm'] - PH[s]) ** 2
        m = sum(c['i']) / 3; c['i'] = [x - m for x in c['i']]
    w.bench.append(b); w.record(); w.hides('channel_delay', [('current', tau)])


@kind
def demag_and_gain(w):  # one sensor gain, one weak magnet
    w.flux = lambda thm, s: 1 - .02 - .03 * np.cos(thm - PH[s])
    def b(c): c['i'][2] = c['i'][2] * 1.02
    w.cogmod = lambda thm: (1 - .02) ** 2 + 0 * thm
    w.bench.append(b); w.record(); w.hides('current_gain', [('c', .02)]); w.hides('mechanical_order', alt=('unequal_magnets',)); w.may('back_emf', 'cogging', 'unequal_magnets', 'torque_gain')


def make(kind_, seed, out):
    w = World(kind_, seed); K[kind_](w); w.write(out)
    w.truth['clean'] = kind_.startswith('clean')
    return w


if __name__ == '__main__':
    w = World('x', 1)
    th = np.linspace(0, TAU, 20001)[:-1]
    i = unpark(w.p * th, 0, w.I0)
    print('mean torque', w.T(th, *i).mean() / w.T0 - 1)
    k5 = w.emf[5]; k7 = w.emf[7]; F = np.fft.rfft(w.T(th, *i) - w.T(th, 0, 0, 0)) / len(th) * 2
    # order 6: -3/2 I E5 cos(6th+f5) + 3/2 I E7 cos(6 th + f7)
    print('order 6', abs(F[6 * w.p]), 1.5 * w.I0 * abs(-k5[0] * math.cos(k5[1]) + k7[0] * math.cos(k7[1])))
    ipm(w, True)
    d, q = -.3 * w.I0, .8 * w.I0
    ia = unpark(w.p * th, d, q); j = 777; u = 1e-6
    def Wabc(x): dd, qq = park(w.p * x, *[c[j] for c in ia]); return w.W(dd, qq, w.p * x)
    num = (Wabc(th[j] + u) - Wabc(th[j] - u)) / 2 / u
    ir = w.iron; w.iron = None; T0 = w.T(th[j], *[c[j] for c in ia]); w.iron = ir
    print('co-energy', num, w.T(th[j], *[c[j] for c in ia]) - T0)
    # energy over a turn at fixed phase currents: zero net work
    print('work over a turn, fixed currents', w.T(th, 3., -1., -2.).mean() / w.T0)
    v = World('free_shaft', 1); K['free_shaft'](v); print('energy balance', v.balance)
    # low pass against its transfer function: order 6 of an idle run
    v = World('lp', 1); v.cog = {6.: (1., 0.)}; c = v.steady(0, 0, 0, v.fast); fn = 9 * v.p * v.fast / 60; y = lag2(v, c, fn, .7071)
    f = 6 * v.p * v.fast / 60; G = 1 / (1 + 2j * .7071 * f / fn - (f / fn) ** 2); X = np.exp(1j * 6 * v.p * c['thm'])
    print('low pass', np.linalg.lstsq(np.array([X.imag, X.real]).T, y, rcond=None)[0], G.real, G.imag)
    # reading of a belt-free, effect-free run equals the declared model: residual is the noise
    v = World('clean_deadtime', 1); v.record(); print('noise', [round(float(np.std(c['torque'] - v.T(c['thm'], *c['i'])) / v.sigma), 2) for n, r, c in v.files])
