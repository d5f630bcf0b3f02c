import numpy as np
from motors import *
G=Gimbal(); SG=Sensors(11,(.013,-.009,0),(.018,-.025,.007),ecc=[(1,np.radians(.55),.8),(2,np.radians(.12),2.)],counts=4096,off=0.0)
S=Servo();  SS=Sensors(3,(.006,-.004,.003),(.06,-.04,.02),ecc=[(1,np.radians(.05),1.)],counts=20000,off=np.radians(2.5))
Wm=Wheel(); SW=Sensors(10,(.01,.004,-.008),(.25,-.15,.1),ecc=[(1,np.radians(.12),.3)],counts=2048,off=0.0)  # 512 lines x4
def de(x,n): return (f'%.{n}f'%x).replace('.',',')
def sweep(m,s,iq,idd,rpm,turns,fs,seed,tau=0,tzero=0,tgain=1,tdrift=0,tn=0,inoise=0,wob=.01,start=0.3,pos=0.,id_sign=1):
    """prescribed speed"""
    rng=np.random.default_rng(seed); w=rpm*np.pi/30; T=abs(turns*2*np.pi/w); n=int(T*fs); os=4
    t=np.arange(n*os)/fs/os
    ph=w*t+start; thm=ph+wob*np.sin(ph*1.0+.5)*.3+ .002*np.sin(2*ph)
    ws=np.gradient(thm,t); thr=s.angle(thm); el=s.p*thr
    iq_=iq*np.ones_like(t); id_=idd*np.ones_like(t)
    i=s.true_currents(el,id_,iq_,inoise,rng)
    tq=m.shaft(thm,ws,i)
    if tau:
        from scipy.signal import lfilter
        a=np.exp(-1/fs/os/tau); y0=tq[0]; tq=lfilter([1-a],[1,-a],tq-y0)+y0
    sl=slice(0,None,os); r=s.read(i)[:,sl]
    tr=tgain*tq[sl]+tzero+tdrift*t[sl]+rng.normal(0,tn,n) if tn else tgain*tq[sl]+tzero+tdrift*t[sl]
    r=r+rng.normal(0,inoise if inoise else 1e-9,r.shape)
    return t[sl],thr[sl],thm[sl],ws[sl],r,tr
