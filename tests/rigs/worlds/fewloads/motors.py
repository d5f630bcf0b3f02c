"""Own motors. theta electrical, docs convention (i_a = iq sin - id cos), T by co-energy with complex-step derivatives."""
import numpy as np
class Motor:
    p=1; slots=0; Ir=1.; psi=0.; R=.1; fric=0.; visc=0.; warm=0.
    cog=()      # (electrical order, Nm, phase)
    emf=()      # (order, Nm/A of a phase, phase) beyond W
    flux=1.0    # magnets, 1 = nominal
    def W(s,d,q,t): return 0*d
    def T(s,d,q,t):
        h=1e-20; j=1j*h
        d=np.asarray(d,float)+0*t; q=np.asarray(q,float)+0*t
        Wd=s.W(d+j,q+0j,t+0j).imag/h; Wq=s.W(d+0j,q+j,t+0j).imag/h; Wt=s.W(d+0j,q+0j,t+j).imag/h
        T=s.p*(Wd*q-Wq*d+Wt)
        for n,a,f in s.cog: T=T+a*s.flux**2*np.sin(n*t+f)
        if s.emf:
            ia,ib,ic=ph(d,q,t)
            for k,i in enumerate((ia,ib,ic)):
                for n,a,f in s.emf: T=T+s.flux*a*np.sin(n*(t-2*np.pi*k/3)+f)*i
        return T
def ph(d,q,t):
    return [q*np.sin(t-k*2*np.pi/3)-d*np.cos(t-k*2*np.pi/3) for k in range(3)]
def dq(i,t):
    q=sum(i[k]*np.sin(t-k*2*np.pi/3) for k in range(3))*2/3
    d=-sum(i[k]*np.cos(t-k*2*np.pi/3) for k in range(3))*2/3
    return d,q
class Ipm(Motor):
    p=4; slots=48; Ir=200.; psi=.080; R=.012; Ldn=.25e-3; Lqn=.60e-3; fric=.35; visc=.002
    cog=((12,.45,.7),(24,.12,2.),(2,.05,1.),(.25,.04,.4))
    m=((6,.004,.2),(12,.006,.0),(18,.002,.3)); b=((6,.007,.1),(12,.004,-.1),(24,.0005,.2)); qo=((6,.5,.2),(12,.3,.1)); w2=((6,.9,.4),(12,.5,2.2)); i2=150.
    def W(s,d,q,t):
        im=244*s.flux*(1+sum(a*np.cos(n*t+f) for n,a,f in s.m))
        bb=235*(1+sum(a*np.cos(n*t+f) for n,a,f in s.b))
        qq=q+sum(a*np.sin(n*t+f) for n,a,f in s.qo)
        u=(d+im)/305; v=qq/bb
        w=1.5*(.05e-3/2*(d*d+q*q)+39*np.sqrt(1+u*u+v*v))
        w-=1.5*39*np.sqrt(1+(im/305)**2+((qq-q)/bb)**2)  # cogging stands in cog alone
        r=(d*d+q*q)/s.i2**2
        return w+sum(a*np.cos(n*t+f) for n,a,f in s.w2)*r*r/(1+r)**2*.12
class Ipm2(Ipm):  # sharper saturation, mirror symmetric, larger ripple
    m=((6,.01,0),(12,.006,0),(18,.003,0)); b=((6,.009,0),(12,.005,0),(18,.0015,0)); qo=((6,.8,0),(12,.2,0)); w2=((6,3.,0),(12,1.5,0),(18,.6,0)); i2=110.
    cog=((12,.9,0),(24,.2,0))
class Spm(Motor):
    p=5; slots=12; Ir=5.; psi=.133/5; R=1.1; fric=.012; visc=2e-4
    emf=((1,.133,0),(5,.0021,.3),(7,.0013,2.6),(11,.0006,1.),(13,.0004,0),(17,.0002,1.))
    cog=((12,.014,.4),(24,.003,1.),(2,.004,.3),(2.4,.005,2.),(.2,.002,1.))
    def W(s,d,q,t):
        r=(d*d+q*q)/7.**2
        u=(d+18)/25; v=q/25
        return 1.5*(1.5e-3/2*(d*d+q*q))+1.5*.9*(np.sqrt(1+u*u+v*v)-18/25*d/25/np.sqrt(1+(18/25)**2)-np.sqrt(1+(18/25)**2))+.0006*np.cos(6*t+.5)*r/(1+r)
class Syr(Motor):
    p=2; slots=36; Ir=20.; psi=.15; R=.5; Ldn=10e-3; Lqn=50e-3; fric=.12; visc=.002
    cog=((18,.05,.2),(6,.03,1.1),(36,.01,0),(.5,.015,.3))
    b=((6,.010,.05),(12,.004,.1),(18,.006,0)); pm=((6,.01,.1),(18,.003,0)); dl=((6,.01,0),(18,.006,.2))
    def W(s,d,q,t):
        bb=12*(1+sum(a*np.cos(n*t+f) for n,a,f in s.b))
        v=q/bb*(1+.12*np.tanh(d/15))
        return 1.5*(10e-3*(1+sum(a*np.cos(n*t+f) for n,a,f in s.dl))/2*d*d+2e-3*q*q+s.psi*s.flux*(1+sum(a*np.cos(n*t+f) for n,a,f in s.pm))*d+6.5*(np.sqrt(1+v*v)-1))
M=dict(ipm=Ipm,ipm2=Ipm2,spm=Spm,syr=Syr)
def mtpa(m,I,sgn=1):
    dl=m.Lqn-m.Ldn; k=m.psi/(4*dl)
    d=k-np.sqrt(k*k+I*I/2); return d,sgn*np.sqrt(max(I*I-d*d,0))
def direction(m,mode,I,sgn=1):
    I=abs(I)
    return mtpa(m,I,sgn) if mode=='mtpa' else (0.,sgn*I)
class Syw(Syr):  # stronger magnets: reluctance share a third
    psi=.36
M['syw']=Syw
