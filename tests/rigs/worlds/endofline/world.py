#!/usr/bin/env python3
"""Machines and recordings of a bench. Deterministic by (kind, seed). `world.py` alone checks its physics.
world.make(kind, seed, folder) writes machine/, runs/*.csv, runs.csv and returns what is hidden."""
import os, sys, zlib
import numpy as np
from scipy.signal import lfilter
PI = np.pi; RPM = PI/30; S3 = 2*PI/3*np.arange(3)

# ---------------------------------------------------------------- machine
class M:
    """true machine; K: list (n, amp, phase) of e_s; cog: (n, amp, phase); W: list of co-energy terms"""
    def __init__(s, p=4, K=((1, .1, 0), (5, .004, .4), (7, .002, -.7)), cog=((12, .03, .5), (24, .01, 1.1)), slots=None, **kw):
        s.p, s.K, s.cog, s.slots = p, list(K), list(cog), slots
        s.Ld = s.Lq = 0.; s.L6 = 0.; s.sat = None       # sat = (Is, kappa, Lq_sat)
        s.g = np.zeros(3); s.M = []; s.mech = []; s.alpha = 0.; s.tref = 20.
        s.__dict__.update(kw)
    def e(s, th):
        return np.array([sum(A*np.sin(n*(th-b)+f) for n, A, f in s.K) for b in S3])
    def torque(s, thm, i, temp=20.):
        th = s.p*thm; e = s.e(th)*(1+s.g)[:, None]
        id_ = -2/3*sum(i[k]*np.cos(th-S3[k]) for k in range(3)); iq = 2/3*sum(i[k]*np.sin(th-S3[k]) for k in range(3))
        Tm = (e*i).sum(0)*(1+s.alpha*(np.asarray(temp)-s.tref))
        Tc = sum((A*np.sin(n*th+f) for n, A, f in s.cog), 0*th)
        mod = sum((a*np.sin(n*th+f) for n, a, f in s.M), 0*th)          # n in electrical orders
        T = Tm*(1+mod)+Tc*(1+2*mod)
        Wd, Wq, Wt = 1.5*s.Ld*id_, 1.5*s.Lq*iq, 0*th
        if s.L6:
            Wq = Wq+1.5*s.L6*np.cos(6*th)*iq; Wt = Wt-1.5*3*s.L6*np.sin(6*th)*iq**2
        if s.sat:
            Is, kap, Ls = s.sat
            Wd = Wd-1.5*kap*Is**2*np.log1p((iq/Is)**2)
            Wq = Wq-1.5*kap*id_*2*iq/(1+(iq/Is)**2)+1.5*Ls*(Is*np.tanh(iq/Is)-iq)
        T = T+s.p*(Wt+Wd*iq-Wq*id_)
        for n, a, f, b, g in s.mech:
            T = T+(a*np.sin(n*th+f)+b*iq*np.sin(n*th+g))
        return T, id_, iq
    def scaled(s, **kw):
        c = M(); c.__dict__.update({k: (list(v) if isinstance(v, list) else v) for k, v in s.__dict__.items()}); c.__dict__.update(kw); return c

BENCH = dict(sT=.01, sI=.02, qT=0., counts=0, lag=0., fn=0., zeta=.05, off=0., drift=0., gain=0., crossabs=0., clip=0.,
             Tc=0., B=0., Q=0., Ts=0., ws=1., Hy=0., Ed=0., J=0., Ttemp=0., io=np.zeros(3), ig=np.zeros(3), pos=0., ecc=[], ph=[],
             dT=0., dI=0., hum=[], spikes=0., block=1, resample=0., hyst=0., tjit=0., floor=0)

def run(name, w, T, iq=0., id=0., fs=None, role='fit', temp=20., cur=None, theta0=None, **kw):
    """w: mechanical rad/s, number or function(t)"""
    return dict(name=name, w=w, T=T, iq=iq, id=id, fs=fs, role=role, temp=temp, cur=cur, theta0=theta0, **kw)

def simulate(m, b, r, rng, os_=8):
    fs = r['fs']; nb = b['block']; dt = 1/(fs*nb*os_)
    warm = max(20*b['lag'], 5*b['dT'] if b['dT'] > 0 else 0, .02)
    if b['fn']: warm = max(warm, 6/(b['zeta']*2*PI*b['fn']))
    nw = int(np.ceil(warm/dt)); n = int(r['T']*fs)*nb*os_
    ahead = int(np.ceil(max(0., -min(b['dT'], b['dI']))/dt))+nb*os_+2
    t = (np.arange(-nw, n+ahead))*dt
    w = r['w'](t) if callable(r['w']) else np.full(t.shape, float(r['w']))
    th0 = r['theta0'] if r['theta0'] is not None else rng.uniform(0, 2*PI)
    thm = np.concatenate([[0], np.cumsum((w[1:]+w[:-1])/2*dt)]); thm = th0+thm-thm[nw]
    thr = thm+b['pos']/m.p
    for k, a, f in b['ecc']: thr = thr+a*np.sin(k*thm+f)
    for k, a, f in b['ph']: thr = thr+a/m.p*np.sin(k*m.p*thm+f)
    ths = m.p*thr
    if r['cur'] is not None: cmd = r['cur'](t, ths)
    else:
        ev = lambda x: x(t) if callable(x) else x
        cmd = np.array([ev(r['iq'])*np.sin(ths-k)-ev(r['id'])*np.cos(ths-k) for k in S3])
    i = (cmd-b['io'][:, None]*(1 if np.any(cmd) else 0))/(1+b['ig'])[:, None]; i = i-i.mean(0)   # the loop keeps the readings
    temp = r['temp'](t) if callable(r['temp']) else np.full(t.shape, float(r['temp']))
    T, id_, iq = m.torque(thm, i, temp)
    sg = np.sign(w); fr = (b['Tc']*(1+b['Ttemp']*(temp-20)))*sg+b['B']*(1+b['Ttemp']*(temp-20))*w+b['Q']*w*abs(w)+b['Ts']*np.exp(-(w/b['ws'])**2)*sg+(b['Hy']*sg+b['Ed']*w)*(id_**2+iq**2)
    T = T-fr-b['J']*np.gradient(w, dt)
    Tr = (1+b['gain'])*T+b['crossabs']*abs(T)
    for f, a in b['hum']: Tr = Tr+a*np.sin(2*PI*f*t+rng.uniform(0, 6))
    if b['hyst']:
        h = np.empty_like(Tr); z = Tr[0]
        for k, x in enumerate(Tr):                       # play operator (backlash) of half width hyst
            z = min(max(z, x-b['hyst']), x+b['hyst']); h[k] = z
        Tr = h
    if b['lag']:
        a = np.exp(-dt/b['lag']); Tr = lfilter([1-(b['lag']/dt)*(1-a), (b['lag']/dt)*(1-a)-a], [1, -a], Tr, zi=[Tr[0]*a-0*Tr[0]+Tr[0]*((b['lag']/dt)*(1-a)-a)])[0]
    if b['fn']:
        wn = 2*PI*b['fn']; z = b['zeta']; c = 2/dt; d0 = c*c+2*z*wn*c+wn*wn
        Tr = lfilter(np.array([wn*wn, 2*wn*wn, wn*wn])/d0, [1, (2*wn*wn-2*c*c)/d0, (c*c-2*z*wn*c+wn*wn)/d0], Tr)
    if b['clip']: Tr = np.clip(Tr, -b['clip'], b['clip'])
    off = r.get('off', b['off'])
    Tr = Tr+off+b['drift']*np.maximum(t, 0)
    ir = (1+b['ig'])[:, None]*i+b['io'][:, None]
    if nb > 1:          # block means of nb raw samples, each raw with noise
        idx = nw+np.arange(n//os_)*os_
        f = lambda x: x[idx].reshape(-1, nb).mean(1)
        ts = f(t); sam = lambda x: f(x); sc = 1/np.sqrt(nb)
    else:
        idx = nw+np.arange(n//os_)*os_; ts = t[idx]; sc = 1.
        sam = lambda x: x[idx]
    def at(x, tau): return np.interp(t-tau, t, x) if tau else x
    Ts_ = sam(at(Tr, b['dT']))+rng.normal(0, b['sT']*sc, ts.size)
    Is_ = np.array([sam(at(x, b['dI'])) for x in ir])+rng.normal(0, b['sI']*sc, (3, ts.size))
    a = sam(thr); tp = sam(temp); ww = sam(w)
    if b['counts']: a = (np.floor if b['floor'] else np.round)(a*b['counts']/(2*PI))*2*PI/b['counts']
    if b['qT']: Ts_ = np.round(Ts_/b['qT'])*b['qT']
    if b['spikes']:
        k = rng.random(ts.size) < b['spikes']; Ts_ = Ts_+k*rng.normal(0, 1, ts.size)*40*b['sT']
    if b['resample']:
        tn = np.arange(ts[0], ts[-1], 1/(fs*b['resample'])); g = lambda x: np.interp(tn, ts, x)
        Ts_, a, tp, ww, Is_, ts = g(Ts_), g(a), g(tp), g(ww), np.array([g(x) for x in Is_]), tn
    if b['tjit']: ts = ts+rng.normal(0, b['tjit'], ts.size)
    return dict(time_s=ts-ts[0], theta_m_rad=a, ia_A=Is_[0], ib_A=Is_[1], ic_A=Is_[2], torque_Nm=Ts_, temperature_C=tp, _w=ww)

def write(folder, decl, b, runs, rng, cols=None, swap=False, sign=1, mach=None, os_=8):
    os.makedirs(folder+'/machine', exist_ok=True); os.makedirs(folder+'/runs', exist_ok=True)
    rows = [('pole_pairs', decl.p, '')]+([('slots', decl.slots, '')] if decl.slots else [])+list(mach or [])
    open(folder+'/machine/machine.csv', 'w').write('name,value,unit\n'+''.join(f'{a},{v},{u}\n' for a, v, u in rows))
    open(folder+'/machine/back_emf.csv', 'w').write('order,amplitude_Nm_per_A,phase_rad\n'+''.join(f'{n},{A!r},{f!r}\n' for n, A, f in decl.K))
    if decl.cog: open(folder+'/machine/cogging.csv', 'w').write('order,amplitude_Nm,phase_rad\n'+''.join(f'{n!r},{A!r},{f!r}\n' for n, A, f in decl.cog))
    if decl.Ld or decl.Lq or decl.L6:
        th = np.arange(360)*PI/180; out = []
        for x in th:           # L_abc of W = 3/2(1/2 Ld id^2 + 1/2 (Lq+L6 cos6th) iq^2)
            d = -2/3*np.cos(x-S3); q = 2/3*np.sin(x-S3); L = 1.5*(decl.Ld*np.outer(d, d)+(decl.Lq+decl.L6*np.cos(6*x))*np.outer(q, q))
            out.append((x, L[0, 0], L[1, 1], L[2, 2], L[0, 1], L[1, 2], L[2, 0]))
        open(folder+'/machine/inductance.csv', 'w').write('theta_e_rad,La_H,Lb_H,Lc_H,Mab_H,Mbc_H,Mca_H\n'+''.join(','.join(repr(float(v)) for v in o)+'\n' for o in out))
    lst = 'file,role\n'
    return rows, lst

# ---------------------------------------------------------------- plans
def plan(p, I, w, fs_turn=420, turns=14, lead=True, back=True, temps=None):
    """a decent bench plan: 7 fit, 1 holdout; w: slow mechanical speed, fast = 5 w"""
    ws = [w, -w, w, -5*w, 5*w, -w, 5*w, -2.3*w] if back else [w, 1.7*w, w, 5*w, 5*w, w, 5*w, 2.3*w]
    iq = [0, 0, I, .5*I*np.cos(.6), I*np.cos(.4), -I, .25*I, .75*I*np.cos(.3)]
    idd = [0, 0, 0, -.5*I*np.sin(.6), I*np.sin(.4), 0, 0, -.75*I*np.sin(.3)] if lead else [0]*8
    tm = temps or [20]*8
    return [run(f'r{k}', ws[k], turns*2*PI/abs(ws[k]), iq[k], idd[k], fs_turn*abs(ws[k])/(2*PI), 'holdout' if k == 7 else 'fit', tm[k]) for k in range(8)]

KINDS = {}
def kind(cls):
    def deco(f): KINDS[f.__name__] = (cls, f); return f
    return deco
def base(r, **kw):
    p = int(r.choice([3, 4, 5, 7])); k = r.uniform(.06, .15)
    sl = {3: 9, 4: 12, 5: 12, 7: 12}[p]; lc = int(np.lcm(sl, 2*p)//p)
    return M(p=p, K=[(1, k, 0.), (5, .04*k*r.uniform(.5, 1.3), r.uniform(-3, 3)), (7, .02*k*r.uniform(.5, 1.3), r.uniform(-3, 3))],
             cog=[(lc, r.uniform(.02, .05), r.uniform(-3, 3)), (2*lc, r.uniform(.005, .012), r.uniform(-3, 3))], slots=sl, **kw)
def B(**kw):
    d = dict(BENCH); d.update(kw); return d
def sc(a, f): return (a*np.cos(f), a*np.sin(f))
def W(true, decl, bench, runs, truth=None, **kw):
    return dict(true=true, decl=decl, bench=bench, runs=runs, truth=truth or {}, **kw)
def ft(p, top=24, per=4.3): return int(p*top*per)+1
def std(r, m, I=None, **kw): return plan(m.p, I or r.uniform(10, 20), r.uniform(8, 20), kw.pop('fs_turn', ft(m.p, max(n for n, _, _ in m.cog))), **kw)

# ------------------------------------------------- sound
@kind('sound')
def eol_short_ramps(r):
    m = base(r); I = 12; R = []
    for k, s in enumerate([1, -1]):
        R += [run(f'ramp{k}', lambda t, s=s: s*(5+60*np.clip(t, 0, 1)), 1., 0, 0, 8000), run(f'load{k}', s*60, .5, s*I, 0, 8000), run(f'loadb{k}', s*60, .5, -s*I*.4, -3, 8000)]
    R.append(run('hold', 60, .4, 8, 1, 8000, 'holdout')); return W(m, m, B(), R)
@kind('sound')
def ebike_roller(r):
    m = M(p=20, K=[(1, .7, 0), (5, .02, .3), (7, .012, 2.)], cog=[(12, .12, 1.), (24, .03, -1)], slots=48)
    return W(m, m, B(sT=.08), plan(20, 15, 3., ft(20, 24, 3.3), 6))
@kind('sound')
def eps_reversal(r):
    m = base(r); f = r.uniform(.4, .9); R = []
    for k, (A, wo) in enumerate([(8, 2.), (14, 3.5), (4, 3.5), (11, 2.6)]):
        R.append(run(f's{k}', lambda t, wo=wo, f=f: wo*np.cos(2*PI*f*.13*t), 24/wo, lambda t, A=A: A*np.sin(2*PI*f*t), (0, -2, 1.5, 0)[k], 900*wo/2, 'holdout' if k == 3 else 'fit'))
    return W(m, m, B(counts=8192), R)
@kind('sound')
def gimbal_stall(r):
    m = M(p=11, K=[(1, .05, 0), (5, .001, 1)], cog=[(12*2, .004, .3)], slots=12); R = []
    for k, I in enumerate([0, 2, 4, 6, 3]):
        R.append(run(f's{k}', lambda t: .35*2*PI*.5*np.cos(2*PI*.5*t), 12, I, 0, 400, 'holdout' if k == 4 else 'fit'))
    return W(m, m, B(sT=.001, sI=.01), R)
@kind('sound')
def flywheel_brake_sound(r):
    m = base(r); R = [run(f'c{k}', lambda t, s=s: s*90*np.exp(-t/2.5), 5, i, d, 5000, ro) for k, (s, i, d, ro) in enumerate([(1, 0, 0, 'fit'), (-1, 0, 0, 'fit'), (1, -9, 0, 'fit'), (-1, 9, -4, 'fit'), (1, -5, 2, 'holdout')])]
    return W(m, m, B(), R)
@kind('sound')
def drive_log_averages(r):
    m = base(r); return W(m, m, B(block=8, sT=.03), std(r, m, fs_turn=ft(m.p, 24, 22), turns=5))
@kind('sound')
def dead_time_currents(r):
    m = base(r); R = std(r, m)
    for x in R:
        A, d = x['iq'], x['id']
        if A: x['cur'] = lambda t, th, A=A, d=d: np.array([A*np.sin(th-k)-d*np.cos(th-k)-.25*np.sign(A)*(4/PI)*(np.sin(5*(th-k))/5+np.sin(7*(th-k))/7+np.sin(11*(th-k))/11+np.sin(13*(th-k))/13) for k in S3])
    return W(m, m, B(), R)
@kind('sound')
def six_step(r):
    m = M(p=4, K=[(1, .1, 0), (5, .012, 0), (7, .004, PI), (11, .0015, 0)], cog=[(6, .02, .3), (12, .01, 1)], slots=12); R = []
    def blk(A):
        def c(t, th):
            s = np.array([np.sin(th-k) for k in S3]); lim = .5; q = np.clip(s/lim, -1, 1)  # trapezoid-like blocks with edges of commutation
            q = np.where(abs(s) < .5, np.tanh(8*(abs(s)-.5)+0)*0+0*s, np.sign(s)); w = .06
            q = np.sign(s)*.5*(1+np.tanh((abs(s)-.5)/w)); q = q-q.mean(0); return A*q
        return c
    for k, (A, w) in enumerate([(0, 10), (0, -10), (10, 10), (5, -50), (10, 50), (-10, -10), (2.5, 50), (7, -20)]):
        R.append(run(f'r{k}', w, 14*2*PI/abs(w), 0, 0, 900*abs(w)/2/PI, 'holdout' if k == 7 else 'fit', cur=(blk(A) if A else None)))
    return W(m, m, B(), R)
@kind('sound')
def injected_harmonics(r):
    m = base(r); R = std(r, m)
    for j, x in enumerate(R):
        A, d = x['iq'], x['id']
        x['cur'] = (lambda t, th, A=A, d=d, j=j: np.array([A*np.sin(th-k)-d*np.cos(th-k)+A*.06*np.sin(5*(th-k)+j)+A*.05*np.sin(7*(th-k)-j) for k in S3])) if A else None
    return W(m, m, B(), R)
@kind('sound')
def ten_alike(r):
    m = base(r); return W(m, m, B(), [run(f'r{k}', 15, 10*2*PI/15, 10, 0, ft(m.p)*15/2/PI, 'holdout' if k > 8 else 'fit') for k in range(10)])
@kind('sound')
def one_run(r):
    m = base(r); return W(m, m, B(), [run('r0', 15, 20*2*PI/15, 10, -2, ft(m.p)*15/2/PI)])
@kind('sound')
def belt_load(r):
    m = base(r); R = std(r, m)
    for x in R:
        w0, A, f = x['w'], x['iq'], r.uniform(3, 8)
        x['w'] = lambda t, w0=w0, f=f: w0*(1+.04*np.sin(2*PI*f*t)); x['iq'] = lambda t, A=A, f=f: A*(1+.1*np.cos(2*PI*f*t))
    return W(m, m, B(), R)
@kind('sound')
def belt_swing_in_sensor(r):
    m = base(r); return W(m, m, B(hum=[(r.uniform(6, 15), .06)]), std(r, m))
@kind('sound')
def mains_hum(r):
    m = base(r); return W(m, m, B(hum=[(50., .03), (100., .02)]), std(r, m))
@kind('sound')
def resampled_log(r):
    m = base(r); return W(m, m, B(resample=2.31, sT=.02), std(r, m, fs_turn=ft(m.p, 24, 14), turns=4))
@kind('sound')
def coarse_bits(r):
    m = base(r); return W(m, m, B(qT=.02, sT=.005, counts=2000), std(r, m))
@kind('sound')
def ipm_declared(r):
    m = base(r); m.Ld, m.Lq, m.L6 = .3e-3, .8e-3, 3e-5; return W(m, m, B(), std(r, m, I=15))
@kind('sound')
def warm_but_flat(r):
    m = base(r); return W(m, m, B(), std(r, m, temps=[22, 30, 45, 60, 71, 88, 93, 66]))
@kind('sound')
def coarse_no_lag(r):
    m = base(r); n = m.cog[0][0]; m.cog = m.cog[:1]; return W(m, m, B(), std(r, m, fs_turn=m.p*n*r.uniform(2.6, 3.8), turns=24))
@kind('sound')
def spikes_torque(r):
    m = base(r); return W(m, m, B(spikes=.002), std(r, m))
@kind('sound')
def hundredth_of_noise(r):
    m = base(r); t = m.scaled(cog=m.cog+[(6, .0004, 1.)]); return W(t, m, B(sT=.04), std(r, m))

# ------------------------------------------------- of the catalogue
@kind('known')
def lag_coarse(r):
    m = base(r); n = m.cog[0][0]; m.cog = [(n, .08, m.cog[0][2])]; R = std(r, m, fs_turn=m.p*n*r.uniform(2.5, 6), turns=24)
    tau = .8/(m.p*n*abs(R[3]['w'])); return W(m, m, B(lag=tau), R, {'torque_sensor': {'time_constant': tau}})
@kind('known')
def friction_two(r):
    m = base(r); return W(m, m, B(Tc=.05, B=.001), std(r, m), {'friction': {'coulomb': .05, 'viscous': .001}})
@kind('known')
def ipm_undeclared(r):
    m = base(r); t = m.scaled(Ld=.3e-3, Lq=.8e-3); return W(t, m, B(), std(r, m, I=15), {'reluctance': {'dd_cosine_0-qq_cosine_0': -.5e-3}})
@kind('known')
def ipm_saturated(r):
    m = base(r); t = m.scaled(Ld=.3e-3, Lq=.8e-3, L6=2e-5, sat=(14., 6e-6, .8e-3))
    R = []; 
    for k, (I, g, w) in enumerate([(0, 0, 12), (0, 0, -12), (20, 0, 12), (20, .5, -50), (20, 1., 12), (20, -.5, 50), (13, 0, -12), (13, .7, 12), (13, -.4, 50), (6, .4, 12), (6, -.3, -12), (16, .3, 20)]):
        R.append(run(f'r{k}', w, 10*2*PI/abs(w), I*np.cos(g), -I*np.sin(g), ft(m.p)*abs(w)/2/PI, 'holdout' if k == 11 else 'fit'))
    return W(t, m, B(), R, {'reluctance': {}, 'saturation': {}})
@kind('known')
def magnets_unequal(r):
    m = base(r); a, f = .03, r.uniform(-3, 3); s, c = sc(a, f); n = 1/m.p; t = m.scaled(M=[(n, a, f)])
    return W(t, m, B(), std(r, m), {'unequal_magnets': {f'sine_{n}': s, f'cosine_{n}': c}})
@kind('known')
def eccentric_static_dynamic(r):
    m = base(r); n = 1/m.p; f, g = r.uniform(-3, 3, 2); s, c = sc(.003, f); t = m.scaled(cog=m.cog+[(2, .012, g)], mech=[(n, 0, 0, .003, f)])
    s2, c2 = sc(.012, g); return W(t, m, B(), std(r, m), {'mechanical_order': {f'iq_sine_{n}': s, f'iq_cosine_{n}': c}, 'cogging': {'sine_2': s2, 'cosine_2': c2}})
@kind('known')
def encoder_eccentric(r):
    m = base(r); a, f = .006, r.uniform(-3, 3); s, c = sc(a, f); return W(m, m, B(ecc=[(1, a, f)]), std(r, m), {'position_eccentricity': {'mech_sine_1': s, 'mech_cosine_1': c}})
@kind('known')
def current_offset_one(r):
    m = base(r); return W(m, m, B(io=np.array([0, .3, 0.])), std(r, m), {'current_offset': {'b': .3}})
@kind('known')
def current_gain_one(r):
    m = base(r); return W(m, m, B(ig=np.array([0, 0, .03])), std(r, m), {'current_gain': {'c': .03}})
@kind('known')
def zero_angle(r):
    m = base(r); return W(m, m, B(pos=.06), std(r, m), {'position_offset': {'angle': .06}})
@kind('known')
def torque_late(r):
    m = base(r); return W(m, m, B(dT=3e-4), std(r, m), {'channel_delay': {'torque-current': 3e-4}}, alias={'torque_sensor'})
@kind('known')
def ke_ten_percent(r):
    m = base(r); k = m.K[0][1]; d = m.scaled(K=[(1, k/1.1, 0.)]+m.K[1:]); return W(m, d, B(), std(r, m), {'back_emf': {'sine_1': k-k/1.1}}, alias={'magnet_temperature', 'current_gain', 'phase_imbalance', 'torque_gain'}, words='back-EMF|torque per ampere|scale|10|9')
@kind('known')
def magnets_warm(r):
    m = base(r); t = m.scaled(alpha=-.0012); return W(t, m, B(), std(r, m, temps=[22, 30, 45, 60, 71, 88, 93, 66]), {'magnet_temperature': {'emf_per_kelvin': -.0012}})
@kind('known')
def stribeck(r):
    m = base(r); w = 2.; R = plan(m.p, 12, w, ft(m.p), 8)
    R += [run(f'x{k}', s*v, 8*2*PI/v, 0, 0, ft(m.p)*v/2/PI) for k, (s, v) in enumerate([(1, 5), (-1, 5), (1, 12), (-1, 25)])]
    return W(m, m, B(Tc=.03, Ts=.05, ws=5.), R, {'friction': {'coulomb': .03}, 'stribeck_friction': {'excess': .05, 'speed': 5.}})
@kind('known')
def iron_load_drag(r):
    m = base(r); R = std(r, m, I=15); return W(m, m, B(Hy=3e-4), R, {'iron_drag': {'hysteresis': 3e-4}})
@kind('known')
def eol_rotor_inertia(r):
    m = base(r); R = []
    for k, s in enumerate([1, -1]):
        R += [run(f'up{k}', lambda t, s=s: s*(5+80*np.clip(t, 0, 1)), 1., s*8, 0, 8000), run(f'dn{k}', lambda t, s=s: s*(85-80*np.clip(t, 0, 1)), 1., 0, 0, 8000), run(f'load{k}', s*60, .6, s*12, 0, 8000)]
    R.append(run('hold', lambda t: 70-50*np.clip(t, 0, 1), .9, 5, 1, 8000, 'holdout')); return W(m, m, B(J=4e-4), R, {'rotor_inertia': {'inertia': 4e-4}})
@kind('known')
def sensor_drift(r):
    m = base(r); R = std(r, m); return W(m, m, B(drift=.006), R, {'torque_drift': {'rate': .006}})
@kind('known')
def resolver_second(r):
    m = base(r); a, f = .02, r.uniform(-3, 3); s, c = sc(a, f); return W(m, m, B(ph=[(2, a, f)]), std(r, m), {'position_harmonics': {'sine_2': s, 'cosine_2': c}})
@kind('known')
def short_turns_phase(r):
    m = base(r); t = m.scaled(g=np.array([0, -.04, 0])); return W(t, m, B(), std(r, m), {'phase_imbalance': {'b': -.04}}, alias={'back_emf'})
@kind('known')
def tenth_of_noise_cogging(r):
    m = base(r); f = r.uniform(-3, 3); s, c = sc(.004, f); t = m.scaled(cog=m.cog+[(6, .004, f)]); return W(t, m, B(sT=.04), std(r, m, turns=18), {'cogging': {'sine_6': s, 'cosine_6': c}})
@kind('known')
def two_friction_offset(r):
    m = base(r); return W(m, m, B(Tc=.04, io=np.array([.25, 0, 0])), std(r, m), {'friction': {'coulomb': .04}, 'current_offset': {'a': .25}})
@kind('known')
def three_lag_cogging_zero(r):
    m = base(r); tau = 4e-4; f = r.uniform(-3, 3); s, c = sc(.02, f); t = m.scaled(cog=m.cog+[(6, .02, f)])
    return W(t, m, B(lag=tau, pos=.04), std(r, m), {'torque_sensor': {'time_constant': tau}, 'cogging': {'sine_6': s, 'cosine_6': c}, 'position_offset': {'angle': .04}})
@kind('known')
def three_hub(r):
    m = M(p=20, K=[(1, .7, 0), (5, .02, .3), (7, .012, 2.)], cog=[(12, .12, 1.), (24, .03, -1)], slots=48); t = m.scaled(alpha=-.0011, g=np.array([.03, 0, 0]))
    return W(t, m, B(sT=.05, Tc=.2), plan(20, 15, 3., ft(20, 24, 3.3), 6, temps=[20, 25, 30, 45, 60, 70, 80, 50]), {'friction': {'coulomb': .2}, 'magnet_temperature': {'emf_per_kelvin': -.0011}, 'phase_imbalance': {'a': .03}}, alias={'back_emf'})
@kind('known')
def six_step_emf5(r):
    x = six_step(r); t = x['true']; x['decl'] = t.scaled(K=[k for k in t.K if k[0] != 5]); x['truth'] = {'back_emf': {'sine_5': .012, 'cosine_5': 0.}}; return x
@kind('known')
def lag_averages(r):
    m = base(r); m.cog = [(m.cog[0][0], .06, 1.)]; R = std(r, m, fs_turn=ft(m.p, m.cog[0][0], 16), turns=10); tau = .8/(m.p*m.cog[0][0]*abs(R[3]['w']))
    return W(m, m, B(lag=tau, block=4), R, {'torque_sensor': {'time_constant': tau}})
@kind('known')
def coast_free_shaft(r):
    m = base(r); J = 2e-2; Tc, Bv = .08, .0012; R = []
    for k, (s, w0) in enumerate([(1, 120), (-1, 120), (1, 70), (-1, 90)]):
        tau = J/Bv; R.append(run(f'c{k}', lambda t, s=s, w0=w0: s*((w0+Tc/Bv)*np.exp(-t/tau)-Tc/Bv), 6, 0, 0, 3000, 'holdout' if k == 3 else 'fit', notorque=True))
    mm = m.scaled(cog=[]); return W(mm, mm, B(sI=.005), R, {'friction': {'coulomb': Tc, 'viscous': Bv}}, mach=[('inertia', J, 'kgm2')])

# ------------------------------------------------- not of the catalogue, or slips
@kind('unknown')
def friction_of_temperature(r):
    m = base(r); return W(m, m, B(Tc=.08, B=.001, Ttemp=-.008), std(r, m, temps=[22, 30, 45, 60, 71, 88, 93, 66]), allowed={'friction'})
@kind('unknown')
def zeros_differ(r):
    m = base(r); R = std(r, m)
    for x in R: x['off'] = r.normal(0, .08)
    return W(m, m, B(), R, allowed={'torque_sensor'})
@kind('unknown')
def thrust_crosstalk(r):
    m = base(r); return W(m, m, B(crossabs=.03), std(r, m))
@kind('unknown')
def sensor_clipped(r):
    m = base(r); R = std(r, m, I=14); return W(m, m, B(clip=1.5*m.K[0][1]*14*.93), R)
@kind('unknown')
def sensor_backlash(r):
    m = base(r); return W(m, m, B(hyst=.02), std(r, m, turns=6))
@kind('unknown')
def averages_coarse(r):
    m = base(r); R = plan(m.p, 12, 12, 10, 24); n = m.cog[0][0]; m.cog = [(n, .08, 1.)]
    for x in R: x['fs'] = m.p*n*60/2/PI*3.1        # one rate at all speeds, each the mean of eight
    return W(m, m, B(block=8), R)
@kind('slip')
def pole_pairs_wrong(r):
    m = base(r); d = m.scaled(p={3: 4, 4: 5, 5: 4, 7: 5}[m.p], slots=None); return W(m, d, B(), std(r, m), words='pole.pairs|pole_pairs')
@kind('slip')
def torque_sign(r):
    m = base(r); return W(m, m, B(), std(r, m), sign=-1, words='sign|opposite')
@kind('slip')
def phases_swapped(r):
    m = base(r); return W(m, m, B(), std(r, m), swap=True, words='swap|exchang|order of the phases')

# ------------------------------------------------- more
@kind('known')
def encoder_counts_down(r):      # a counter that rounds down is half a count late in both directions
    m = base(r); return W(m, m, B(counts=1000, floor=1, sT=.004), std(r, m), {'position_offset': {'angle': -PI/1000*m.p}})
@kind('known')
def eps_friction(r):
    x = eps_reversal(r); x['bench'] = B(Tc=.06); x['truth'] = {'friction': {'coulomb': .06}}; return x
@kind('known')
def stall_offset(r):
    x = gimbal_stall(r); x['bench'] = B(sT=.001, sI=.01, io=np.array([0, 0, .12])); x['truth'] = {'current_offset': {'c': .12}}; return x
@kind('known')
def eol_ke_and_friction(r):
    x = eol_short_ramps(r); m = x['true']; k = m.K[0][1]; x['decl'] = m.scaled(K=[(1, k/1.1, 0.)]+m.K[1:]); x['bench'] = B(Tc=.04)
    x['truth'] = {'back_emf': {'sine_1': k-k/1.1}, 'friction': {'coulomb': .04}}; x['alias'] = {'current_gain', 'phase_imbalance', 'torque_gain', 'magnet_temperature'}; return x
@kind('known')
def one_run_cogging(r):
    x = one_run(r); m = x['true']; x['true'] = m.scaled(cog=m.cog+[(2, .02, .7)]); s, c = sc(.02, .7); x['truth'] = {'cogging': {'sine_2': s, 'cosine_2': c}}
    x['alias'] = {'back_emf', 'reluctance', 'saturation', 'phase_imbalance', 'current_gain', 'position_harmonics', 'unequal_magnets', 'mechanical_order'}; x['loose'] = 1; return x
@kind('known')
def ten_alike_zero(r):
    x = ten_alike(r); x['bench'] = B(off=.05); x['truth'] = {'torque_sensor': {'offset': .05}}; x['alias'] = {'friction', 'back_emf', 'reluctance', 'iron_drag', 'saturation', 'magnet_temperature', 'position_offset', 'current_gain', 'phase_imbalance', 'torque_gain', 'channel_delay', 'current_filter'}; x['loose'] = 1; return x
@kind('known')
def transducer_rings(r):
    m = base(r); n = m.cog[0][0]; R = std(r, m, fs_turn=m.p*n*14, turns=10); f = 1.25*m.p*n*abs(R[3]['w'])/2/PI
    return W(m, m, B(fn=f, zeta=.06), R, {'torque_sensor': {'natural_frequency': f}}, units=1)
@kind('known')
def warm_friction_lag(r):
    x = lag_coarse(r); x['bench'].update(Tc=.05); x['true'] = x['true'].scaled(alpha=-.0011)
    for q, T in zip(x['runs'], [20, 25, 40, 60, 75, 35, 85, 50]): q['temp'] = T
    x['truth'].update({'friction': {'coulomb': .05}, 'magnet_temperature': {'emf_per_kelvin': -.0011}}); return x
@kind('known')
def belt_with_friction(r):
    x = belt_load(r); x['bench'] = B(Tc=.05, B=.001); x['truth'] = {'friction': {'coulomb': .05, 'viscous': .001}}; return x
@kind('known')
def hum_with_cogging(r):
    x = mains_hum(r); m = x['true']; x['true'] = m.scaled(cog=m.cog+[(2, .02, .7)]); s, c = sc(.02, .7); x['truth'] = {'cogging': {'sine_2': s, 'cosine_2': c}}; return x
@kind('known')
def angle_late(r):
    m = base(r); R = std(r, m); x = W(m, m, B(dT=-2e-4, dI=-2e-4), R, {'channel_delay': {'angle': 2e-4}}); return x
@kind('known')
def three_tenth_of_noise(r):
    m = base(r); f = r.uniform(-3, 3); s, c = sc(.006, f); t = m.scaled(cog=m.cog+[(2, .006, f)])
    return W(t, m, B(sT=.06, Tc=.006, pos=.006*0+.004), std(r, m, turns=24), {'cogging': {'sine_2': s, 'cosine_2': c}, 'friction': {'coulomb': .006}, 'position_offset': {'angle': .004}}, loose=1)
@kind('sound')
def clock_jitter(r):
    m = base(r); R = std(r, m); return W(m, m, B(tjit=2e-5), R)
@kind('sound')
def weld_robot_moves(r):         # accelerates and brakes all the time, load of the same rhythm, temperature creeps
    m = base(r); R = [run(f'r{k}', lambda t, k=k: 30*np.sin(2*PI*(.5+.1*k)*t), 6, lambda t, k=k: (4+3*k)*np.cos(2*PI*(.5+.1*k)*t), 0, 2500, 'holdout' if k == 3 else 'fit', temp=lambda t: 30+2*t) for k in range(4)]
    return W(m, m, B(), R)
@kind('sound')
def holding_map(r): 
    m = M(p=7, K=[(1, .06, 0)], cog=[(12, .015, .7), (24, .004, 2)], slots=12)
    return W(m, m, B(sI=.004), [hold_run(m, 'f', .3), hold_run(m, 'b', -.3), hold_run(m, 'f2', .3, 'holdout')], hold=1)
@kind('known')
def holding_map_cogging(r):
    x = holding_map(r); t = x['true'].scaled(cog=x['true'].cog+[(12/7, .006, 1.)]); s, c = sc(.006, 1.)
    x['true'] = t; x['runs'] = [hold_run(t, 'f', .3, Tc=.008), hold_run(t, 'b', -.3, Tc=.008), hold_run(t, 'f2', .3, 'holdout', Tc=.008)]; n = 12/7
    x['truth'] = {'cogging': {f'sine_{n}': s, f'cosine_{n}': c}, 'friction': {'coulomb': .008}}; x['alias'] = {'mechanical_order'}; x['hold'] = 1; return x
def hold_run(m, name, w, role='fit', Tc=0.):
    def cur(t, th):
        iq = (Tc*np.sign(w)-sum(A*np.sin(n*th+f) for n, A, f in m.cog))/(1.5*m.K[0][1]); return np.array([iq*np.sin(th-k) for k in S3])
    return run(name, w, 2*PI/abs(w)*1.5, 0, 0, 120, role, cur=cur)

def build(kind_, seed):
    rng = np.random.default_rng([zlib.crc32(kind_.encode()), seed]); cls, f = KINDS[kind_]; x = f(rng); x['cls'] = cls
    x['data'] = [simulate(x['true'], x['bench'], q, rng) for q in x['runs']]; return x

def make(kind_, seed, folder):
    x = build(kind_, seed); rows, lst = write(folder, x['decl'], x['bench'], x['runs'], None, mach=x.get('mach'))
    for q, d in zip(x['runs'], x['data']):
        d = {k: v for k, v in d.items() if k[0] != '_'}
        if q.get('notorque'): del d['torque_Nm']
        elif x.get('hold'): d['torque_Nm'] = 0*d['torque_Nm']
        elif x.get('sign', 1) < 0: d['torque_Nm'] = -d['torque_Nm']
        if x.get('swap'): d['ib_A'], d['ic_A'] = d['ic_A'], d['ib_A']
        np.savetxt(f"{folder}/runs/{q['name']}.csv", np.array(list(d.values())).T, fmt='%.9g', delimiter=',', header=','.join(d), comments='')
        lst += f"runs/{q['name']}.csv,{q['role']}\n"
    open(folder+'/runs.csv', 'w').write(lst); return x

def check():
    th = np.arange(0, 2*PI, 2*PI/7200); ok = []
    def dq(I, d, th, p=4): return np.array([I*np.sin(th-k)-d*np.cos(th-k) for k in S3])
    def near(name, a, b, tol): ok.append((name, float(abs(a-b)), tol)); assert abs(a-b) <= tol, (name, a, b)
    m = M(p=4, K=[(1, .1, 0), (5, .02, .3), (7, .01, -.4)], cog=[]); T, d, q = m.torque(th/4, dq(10, -3, th))
    near('dq', abs(q-10).max()+abs(d+3).max(), 0, 1e-9); near('mean 3/2 K iq', T.mean(), 1.5, 1e-9)
    T, _, _ = m.torque(th/4, dq(10, 0, th)); z = 2*np.mean(T*np.exp(-6j*th))       # theory section 4
    want = 1.5*10*(.01*np.exp(-.4j)-.02*np.exp(.3j)); near('order 6 of emf 5, 7', abs(z-want), 0, 1e-9)
    m = M(p=4, K=[(1, .1, 0)], cog=[], Ld=3e-4, Lq=8e-4); T, _, _ = m.torque(th/4, dq(10, -5, th)); near('reluctance', T.mean(), 1.5+1.5*4*(-5e-4)*-50, 1e-9)
    m = M(p=4, K=[(1, 0., 0)], cog=[], Ld=3e-4, Lq=8e-4, L6=5e-5, sat=(14., 6e-6, 8e-4))       # torque as the slope of the co-energy, by differences at fixed phase currents
    def Wn(thm, i):
        x = 4*thm; d = -2/3*sum(i[k]*np.cos(x-S3[k]) for k in range(3)); q = 2/3*sum(i[k]*np.sin(x-S3[k]) for k in range(3)); Is, kap, Ls = m.sat
        return 1.5*(.5*m.Ld*d*d+.5*(m.Lq+m.L6*np.cos(6*x))*q*q)-1.5*kap*d*Is**2*np.log1p((q/Is)**2)+1.5*Ls*(Is**2*np.log(np.cosh(q/Is))-q*q/2)
    i = dq(11, -6, th); h = 1e-5; near('co-energy', abs((Wn(th/4+h, i)-Wn(th/4-h, i))/2/h-m.torque(th/4, i)[0]).max(), 0, 1e-6)
    rng = np.random.default_rng(0); m = M(p=1, K=[(1, .1, 0)], cog=[(10, 1., 0)]); tau = .002; r = run('x', 30., 2*PI/3, 0, 0, 4000, theta0=0.)
    o = simulate(m, B(lag=tau, sT=0, sI=0), r, rng); z = 2*np.mean(o['torque_Nm'][:8376]*np.exp(-1j*(10*o['theta_m_rad'][:8376]-PI/2))); near('lag', abs(z-1/(1+1j*300*tau)), 0, 3e-4)
    o = simulate(m, B(dT=.001, sT=0, sI=0), r, rng); near('delay', abs(o['torque_Nm']-np.sin(10*(o['theta_m_rad']-.03))).max(), 0, 1e-4)
    o = simulate(m, B(block=8, sT=0, sI=0), dict(r, fs=300.), rng); x = 300*(1/2400); g = np.sin(8*x/2)/8/np.sin(x/2); near('block mean', abs(o['torque_Nm']-g*np.sin(10*o['theta_m_rad'])).max(), 0, 1e-6)
    o = simulate(m, B(fn=80., zeta=.1, sT=0, sI=0), r, rng, 16); s = 300/(2*PI*80); z = 2*np.mean(o['torque_Nm'][:8376]*np.exp(-1j*(10*o['theta_m_rad'][:8376]-PI/2))); near('resonance', abs(z-1/(1-s*s+.2j*s)), 0, 3e-3)
    m.cog = []; o = simulate(m, B(Tc=.1, B=.002, Hy=1e-3, sT=0, sI=0), dict(r, iq=6., id=2.), rng); near('drag', o['torque_Nm'].mean(), 1.5*.6-.1-.06-.04, 1e-9)
    o = simulate(m, B(sT=.01, sI=0), r, rng); near('noise', o['torque_Nm'].std(), .01, 4e-4)
    x = coast_free_shaft(rng); rr = x['runs'][0]; tt = np.array([0, .001]); w = rr['w'](tt); near('coast', (w[1]-w[0])/.001*2e-2, -(.08+.0012*120), 1e-4)
    b = B(io=np.array([0, .3, 0]), ig=np.array([0, 0, .03]), sT=0, sI=0); o = simulate(m, b, dict(r, iq=6.), rng)
    near('sum of true currents', abs((o['ia_A'])+(o['ib_A']-.3)+o['ic_A']/1.03).max(), 0, 1e-9)
    for n, e, tol in ok: print(f'{n:24s} {e:.2e} (<= {tol:g})')
    print(len(KINDS), 'kinds,', sum(c == 'sound' for c, _ in KINDS.values()), 'sound')
if __name__ == '__main__': check()
