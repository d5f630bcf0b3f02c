import numpy as np,sys,os,json,zlib
from motors import *
def make(name,mot,mode,runs,noise=1.,fs=2000,turns=5,gain=0.,zero=0.,lag=0.,enc=1.0,warm=0.,form="abc",bench=0.,seed=0):
    """runs: list of (name, amp [signed: sign of iq], rpm). gain: rms of gain errors; zero: A; enc: el. degrees of zero of the angle"""
    m=M[mot](); folder=f'lists/{name}'; os.makedirs(folder,exist_ok=True)
    rng=np.random.default_rng(zlib.crc32(name.encode())+seed)
    rng0=np.random.default_rng(7)
    g=gain*np.array([1,-.6,.4]); z=zero*np.array([1,-.7,.3]); gT=gain; 
    Tr=abs(m.T(*[np.array([x]) for x in direction(m,mode,m.Ir)],np.linspace(0,6.28,360)).mean())
    zT=.002*Tr
    info=dict(mot=mot,mode=mode,enc=enc,Tr=Tr,runs=runs,noise=noise,gain=gain,zero=zero,lag=lag,warm=warm,fs=fs,turns=turns,bench=bench)
    for k,(rn,amp,rpm) in enumerate(runs):
        w=rpm*2*np.pi/60; n=int(turns*2*np.pi/abs(w)*fs); n=min(n,60000); t=np.arange(n)/fs
        th0=rng.uniform(0,6.28)
        tm=th0+w*t+.003*np.sin(w*t+1)        # mechanical, speed swings by 0.3 %
        wm=w*(1+.003*np.cos(w*t+1))
        te=m.p*tm; tl=te+np.radians(enc)      # the drive's angle
        m.flux=1-.0011*warm*k
        d,q=direction(m,mode,amp,np.sign(amp) if amp else 1) if amp else (0,0)
        rip=.003*abs(amp)
        dd=d+rip*np.sin(6*te+1); qq=q+rip*np.sin(6*te+.3)
        if not amp: dd=0*te; qq=0*te
        i=ph(dd,qq,tl); D,Q=dq(i,te)          # true d, q
        T=m.T(D,Q,te)-m.fric*np.sign(w)-m.visc*wm
        T=T+bench*Tr*(np.sin(tm+.5)+.5*np.sin(2*tm+1.))   # coupling
        if lag>0:
            a=1-np.exp(-1/fs/lag); y=np.empty_like(T); s=T[0]
            for j in range(n): s+=a*(T[j]-s); y[j]=s
            T=y
        Tm=(1+gT)*T+zT+noise*.004*Tr*rng.standard_normal(n)
        Tm=np.round(Tm/(Tr*2/32768))*(Tr*2/32768)
        im=[(1+g[s])*i[s]+z[s]+noise*.003*m.Ir*rng.standard_normal(n) for s in range(3)]
        cnt=16384; ang=np.floor((tl/m.p)/(2*np.pi)*cnt)/cnt*2*np.pi
        with open(f'{folder}/{rn}.csv','w') as f:
            if form=='abc': cols=[t,ang,*im,Tm]; f.write('time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm\n')
            else:
                md,mq=dq(im,tl); cols=[t,ang,md,mq,Tm]; f.write('time_s,theta_m_rad,id_A,iq_A,torque_Nm\n')
            np.savetxt(f,np.array(cols).T,fmt='%.6g',delimiter=',')
    json.dump(info,open(f'{folder}/info.json','w'))
    files=[f'{folder}/{r[0]}.csv' for r in runs]
    fl=m.psi*1.015
    c=['hci-solve','tune',*files,'--pole-pairs',str(m.p),'--flux',f'{fl:.4g}','--slots',str(m.slots),'--rated-current',f'{m.Ir:g}','--resistance',f'{m.R:g}']
    open(f'{folder}/cmd','w').write(' '.join(c))
    return c
