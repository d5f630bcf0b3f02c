"""Own truth: coenergy w(id,iq,te) per 1.5; T = 1.5 p (w_id*iq - w_iq*id + w_te) + cogging(theta_m). Saturation: tanh/logcosh, arctan, sqrt - no polynomials."""
import numpy as np
class Motor:
    def __init__(s, **k): s.__dict__.update(k)
    def elec(s, d, q, te):
        # magnet harmonics seen in dq: hd[k]=(amp, phase) on id, hq on iq; saturating slot leakage: harmonic shrinks with |i|
        p=s.p; i2=np.sqrt(1+(q/s.Is)**2)
        # cross saturation of the magnet flux: -kx*psi*id*(1-1/i2)
        wd=s.psi - s.kx*s.psi*(1-1/i2) + s.Ld*s.Isd*np.tanh(d/s.Isd)
        wq=s.Lq*s.Is*np.tanh(q/s.Is) - s.kx*s.psi*d*(q/s.Is**2)/i2**3
        wt=0*te
        for (n,a,ph) in s.hd: wd=wd+a*np.cos(n*te+ph); wt=wt-n*a*d*np.sin(n*te+ph)
        for (n,a,ph) in s.hq: wq=wq+a*np.sin(n*te+ph); wt=wt+n*a*q*np.cos(n*te+ph)
        for (n,a,ph) in s.hs: # slot-saturation: a*Is^2*(i2-1)*cos
            wt=wt-n*a*s.Is**2*(i2-1)*np.sin(n*te+ph); wq=wq+a*q/i2*np.cos(n*te+ph)
        # unequal phases (weak phase a by ua): order 2 in dq
        wd=wd+s.ua*s.psi*(1+np.cos(2*te))/3*-1; 
        wt=wt+s.ua*s.psi/3*2*np.sin(2*te)*d
        wq=wq+s.ua*s.psi/3*np.sin(2*te); wt=wt+s.ua*s.psi/3*2*np.cos(2*te)*q
        # eccentric/uneven magnets: share of psi once a turn
        e=1+s.ecc*np.cos(te/p+0.4)
        return 1.5*p*(wd*e*q-wq*d+wt) - 1.5*s.ecc*s.psi*d*np.sin(te/p+0.4)
    def cog(s, tm):
        return sum(a*np.sin(n*tm+ph) for n,a,ph in s.cogm)
    def T(s,d,q,tm): return s.elec(d,q,s.p*tm)+s.cog(tm)
def abc(d,q,te):
    f=lambda x: q*np.sin(x)-d*np.cos(x)
    return f(te),f(te-2*np.pi/3),f(te+2*np.pi/3)
def dq(a,b,c,te):
    s=lambda x:np.sin(x); k=2*np.pi/3
    q=2/3*(a*np.sin(te)+b*np.sin(te-k)+c*np.sin(te+k)); d=-2/3*(a*np.cos(te)+b*np.cos(te-k)+c*np.cos(te+k))
    return d,q
def ripple(m, dqf, name, n=20000):
    tm=np.arange(n)*2*np.pi/n
    d,q=dqf(tm); t=m.T(d,q,tm)
    F=2*np.abs(np.fft.rfft(t))/n; top=np.argsort(F[1:])[::-1][:6]+1
    print(f"{name}: mean {t.mean():.5g}  pk-pk {np.ptp(t):.4g}  rms {t.std():.4g} peakI {np.max(np.hypot(d,q)):.4g}  top e-orders "+", ".join(f"{k/m.p:.3f}:{F[k]:.3g}" for k in top))
    return t
# 1: traction 18/16 IPM
M1=Motor(p=8,psi=0.090,Ld=180e-6,Lq=330e-6,Is=110.,Isd=260.,kx=0.22,
  hd=[(6,0.0009,0.3),(12,0.0003,-1.0),(18,0.00012,.5)], hq=[(6,0.0007,0.1),(12,0.0002,0.8)], hs=[(6,1.8e-6,0.7),(12,5e-7,-.4)],
  ua=0.004, ecc=0.004, cogm=[(144,0.9,0.6),(18,0.35,1.1),(16,0.25,-.4),(288,0.15,.3),(36,.12,.2)])
# 2: gimbal 12N14P
M2=Motor(p=7,psi=0.0459/7*0.97,Ld=1.1e-3,Lq=1.15e-3,Is=2.5,Isd=5.,kx=0.1,
  hd=[(6,0.00006,.3),(12,0.00002,1.)],hq=[(6,0.00008,0.2)],hs=[(6,3e-7,.4)],ua=0.003,ecc=0.004,
  cogm=[(84,0.0032,.8),(168,.0005,-.5),(12,.0009,.3),(14,.0006,1.7),(24,.0003,.9)])
# 3: servo p=4, 24 slots, 40 V/krpm line rms nominal -> ke=.3119
M3=Motor(p=4,psi=0.3119/4*0.97,Ld=4e-3,Lq=4.3e-3,Is=9.,Isd=25.,kx=0.12,
  hd=[(6,0.0009,.2),(12,0.0004,2.)],hq=[(6,0.0011,0.1),(12,.0003,.6)],hs=[(6,3e-6,.9)],ua=0.004,ecc=0.003,
  cogm=[(24,0.055,.8),(48,.013,-.5),(8,.012,.3),(1,.006,.2),(12,.004,1.)])
