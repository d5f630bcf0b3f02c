"""own motor simulation: no part of hci-solve"""
import numpy as np, math
TP=2*math.pi
class Motor:
    def __init__(s,pp,K,emf,cog,zero_e=0.0,coul=0,visc=0,J=1e-4,sat=0.0,seed=1):
        # emf: {n:(rel,phase)}, cog: {mech order:(Nm,phase)}; zero_e: el. angle of the rotor where encoder=0
        s.pp,s.K,s.emf,s.cog,s.z,s.coul,s.visc,s.J,s.sat=pp,K,emf,cog,zero_e,coul,visc,J,sat
        s.N=65536; th=np.arange(s.N)/s.N*TP
        s.e=sum(K/1.5*a*np.sin(n*th+p) for n,(a,p) in emf.items())
        s.c=sum(a*np.sin(n*th+p) for n,(a,p) in cog.items())+0*th
    def shape(s,the): return s.e[np.asarray(np.floor(the/TP*s.N),dtype=int)%s.N]
    def cogg(s,thm): return s.c[np.asarray(np.floor(thm/TP*s.N),dtype=int)%s.N]
    def torque(s,thm,ia,ib,ic):
        """electromagnetic + cogging; thm is what the encoder shows"""
        the=s.pp*thm+s.z
        I2=(2/3)*(ia*ia+ib*ib+ic*ic)
        return (s.shape(the)*ia+s.shape(the-TP/3)*ib+s.shape(the+TP/3)*ic)*(1-s.sat*I2)+s.cogg(thm)
def phases(iq,id_,the):
    a=lambda x: iq*np.sin(x)-id_*np.cos(x)
    return a(the),a(the-TP/3),a(the+TP/3)
def free_run(m,wref,T,dt,kp,ki,load=0.0,kpos=0.0,th0=0.0,delay=0):
    """speed + position loop with sine i_q, integrates the shaft. wref: function of t. returns t,thm,w,iq"""
    n=int(T/dt); th,w,I=th0,0.0,0.0; ref=th0
    out=np.empty((n,4)); e,c,N,pp,z=m.e.tolist(),m.c.tolist(),m.N,m.pp,m.z
    s3=TP/3; k=N/TP; fl=math.floor; sin=math.sin
    for j in range(n):
        t=j*dt; r=wref(t); ref+=r*dt
        err=r-w+kpos*(ref-th); I+=ki*err*dt; iq=kp*err+I
        the=pp*th+z
        T_e=sum(e[fl((the-q)*k)%N]*sin(the-q) for q in (0,s3,-s3))*iq*(1-m.sat*iq*iq)+c[fl(th*k)%N]
        fr=m.coul*math.tanh(w/0.02)+m.visc*w + load*math.tanh(w/0.02)
        out[j]=(t,th,w,iq)
        w+=(T_e-fr)/m.J*dt; th+=w*dt
    return out.T
def pp_ripple(x): return float(x.max()-x.min())
def spectrum(x,orders_mech,turns_samples=None):
    f=np.fft.rfft(x)/len(x)*2; return {o:abs(f[o]) for o in orders_mech}
