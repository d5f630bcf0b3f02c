from cv import *
from player import load
def rec(tag,rpm,lag,turns=4,fs=80,folder='cv_lag/table',gains=(1,1.015,1),offs=(.05,-.03,0),idd=None,I=None,seed=7,both=True):
    r=R(seed); f=load(folder); out=[];t0=0.;th0=.1
    for s in ((1,-1) if both else (1,)):
        n=int(turns/rpm*60*fs); t=np.arange(n)/fs; th=th0+s*t*rpm*np.pi/30; te=5*th
        if I is None: c=f(te/(2*np.pi)/f.period); i3=ph(c[0],c[1],te)
        else: i3=ph(idd+0*t,I+0*t,te)
        T=C.air(th,i3); sh=T-s*C.fric-C.visc*s*rpm*np.pi/30
        a=1-np.exp(-1/(fs*lag)); sh=lfilter([a],[1,-(1-a)],sh,zi=[sh[0]*(1-a)])[0]
        F=np.round((sh/0.12+.35+r.normal(0,.08,n))/.01)*.01
        ii=[np.round((g*x+o+r.normal(0,.01,n))/.005)*.005 for g,o,x in zip(gains,offs,i3)]
        out.append(np.c_[t0+t,np.degrees(th),np.full(n,s*rpm),*ii,F*.12]); t0+=n/fs+1; th0=th[-1]
    with open(tag,'w') as g: g.write('time_s,theta_m_deg,speed_rpm,ia_A,ib_A,ic_A,torque_Nm\n'); np.savetxt(g,np.vstack(out),fmt='%.4f',delimiter=',')
rec('lagp6.csv',6,.03); rec('lagp15.csv',1.5,.03); rec('lagn.csv',1.5,.03,turns=10,I=4.12,idd=-2.82,both=False)
