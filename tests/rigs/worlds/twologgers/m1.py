# servo on dyno. drive log 1 kHz and torque log 200 Hz by two loggers, brought to the drive grid: linear (lin) or forward fill (held)
import numpy as np,os,sys
from motors import *
def run(name,iq,rpm,dur,how):
    w0=rpm*2*np.pi/60
    fs=20000; t=np.arange(0,dur+.1,1/fs); thm=.3+w0*t+.002*np.sin(2*np.pi*.7*t)
    thenc=S1.angle(thm); ref=dq2abc(0*t,iq+0*t,5*thenc)
    tr=S1.true(ref) if iq else [0*t]*3
    T=servo.shaft(thm,tr,w0)
    a=1-np.exp(-2*np.pi*400/fs); y=np.empty_like(T); s=T[0]   # sensor low-pass 400 Hz
    for i,x in enumerate(T): s+=a*(x-s); y[i]=s
    tt=np.arange(.0023,dur+.1,1/200.); Tl=1.004*np.interp(tt,t,y)+.0015+.0006*rng.standard_normal(tt.size)
    Tl=np.round(Tl,5)
    tg=np.arange(0.02,dur,1e-3); k=np.searchsorted(t,tg)
    m=S1.meas([np.interp(tg,t,x) for x in tr],.01)
    cnt=np.floor(np.interp(tg,t,thenc)/(2*np.pi)*65536)
    if how=='lin': Tg=np.interp(tg,tt,Tl)
    else: Tg=Tl[np.searchsorted(tt,tg,side='right')-1]
    os.makedirs(f'm1/{how}',exist_ok=True)
    with open(f'm1/{how}/{name}.csv','w') as f:
        f.write('Time [s],Motor angle mech [deg],I_U [A],I_V [A],I_W [A],Speed [rpm],Torque [Nm]\n')
        for i in range(tg.size): f.write(f'{tg[i]:.4f},{cnt[i]*360/65536:.4f},{m[0][i]:.3f},{m[1][i]:.3f},{m[2][i]:.3f},{rpm:.2f},{Tg[i]:.6f}\n')
for how in ('lin','held'):
    run('idle',0,30,12,how); run('load2',2,30,12,how); run('load4',4,30,12,how); 
    run('back3',3,-30,12,how); run('idle_back',0,-30,12,how); run('load4_90',4,90,8,how); run('load5_back60',5,-60,8,how); run('load1_10',1,10,20,how)
