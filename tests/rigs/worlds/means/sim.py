import numpy as np
p=7
class S:            # surface magnet, 42 slots, q=2
    slots=42; kt=0.150
    def __init__(s,lam=0.0143):
        s.h={1:(lam*p,0),5:(0.04*lam*p,np.pi*0.97),7:(0.025*lam*p,0.05),11:(.012*lam*p,np.pi),13:(.008*lam*p,.1)}
        s.c={6:(.06,.3),12:(.02,2.),18:(.008,-1.)}
        s.kt=1.5*lam*p
    def T(s,thm,ia,ib,ic):
        th=p*thm; t=0*th
        for k,i in enumerate((ia,ib,ic)):
            x=th-2*np.pi*k/3
            for n,(A,f) in s.h.items(): t=t+A*np.sin(n*x+f)*i
        for n,(A,f) in s.c.items(): t=t+A*np.sin(n*th+f)
        return t
class W:            # 12 slots / 14 magnets, one magnet weak: field built from magnets, coils, slots
    slots=12
    def __init__(s,weak=.9):
        N=1<<15; ph=np.arange(N)*2*np.pi/N; B=0*ph
        for m in range(14):
            d=(ph-m*np.pi/7+np.pi)%(2*np.pi)-np.pi
            g=weak if m==4 else 1+0.003*np.sin(5*m+1)
            B+=(-1)**m*g*.5*(np.tanh((d+.41*np.pi/7)/.04)-np.tanh((d-.41*np.pi/7)/.04))
        F=np.fft.rfft(B); k=np.arange(len(F)); k0=np.where(k==0,1,k)
        w=2*np.pi/12
        def shift(G,a): return np.fft.irfft(G*np.exp(1j*k*a),N)
        Phi=F*np.sinc(k*w/2/np.pi)*w; Phi[0]=0
        lam=np.zeros((3,N))
        for j in range(12):
            el=(210*j)%360
            for si,(c,sg,f) in enumerate(((0,1,15),(2,-1,75),(1,1,135),(0,-1,195),(2,1,255),(1,-1,315))):
                if abs((el-f+180)%360-180)<=20: lam[c]+=sg*shift(np.conj(Phi),-j*w)  # rotor at +th sees Phi(j w - th)
        # tooth j flux as function of th: Phi(jw - th)
        L=np.fft.rfft(lam,axis=1)
        # align so lam_a = -|lam| cos(p th)
        a=L[0,p]; a0=(np.pi-np.angle(a))/p   # want angle pi
        L=L*np.exp(1j*k*a0)
        b=np.angle(L[1,p]/L[0,p])
        if b>0: L[[1,2]]=L[[2,1]]
        sc=0.0143/(2*abs(L[0,p])/N)
        s.e=np.fft.irfft(L*1j*k*sc,N,axis=1)
        Q=np.fft.rfft(B*B)*np.exp(-(k*.03)**2/2)
        en=0
        for j in range(12): en=en+np.fft.irfft(np.conj(Q)*np.exp(-1j*k*j*w),N)
        C=np.fft.rfft(en)*np.exp(1j*k*a0)*1j*k; cg=np.fft.irfft(C,N)
        s.cog=cg*(.09/np.ptp(cg)); s.N=N; s.kt=1.5*.0143*p
    def T(s,thm,*i):
        x=(thm%(2*np.pi))*s.N/(2*np.pi); a=np.arange(s.N+1)
        f=lambda y: np.interp(x,a,np.append(y,y[0]))
        return sum(f(s.e[k])*i[k] for k in range(3))+f(s.cog)
class X:            # mildly salient, iron saturates a little: one co-energy
    slots=42
    def __init__(s,sat=1.): s.sat=sat; s.kt=1.5*.0143*p
    def w(s,d,q,th):
        l=.0143; Iq=45/np.sqrt(max(s.sat,1e-6)); Ld,Lq=.0006,.0009
        W=1.5*(l*d*(1-.05*s.sat*q*q/(35**2+q*q))+.5*Ld*d*d+.5*Lq*Iq**2*np.log1p(q*q/Iq**2))
        W=W+np.cos(6*th)*(.0012+1.5*l*.02*d-1.5*Lq*.5*.02*q*q/(1+(q/40)**2)*s.sat**.5)+np.sin(6*th)*(1.5*l*.022*q*(1-.1*s.sat*q*q/(900+q*q))+1.5*Lq*.03*d*q+.0004)
        W=W+np.cos(12*th)*(.00012+1.5*l*.004*d-1.5*Lq*.004*q*q)+np.sin(12*th)*(1.5*l*.006*q)
        return W
    def T(s,thm,ia,ib,ic):
        th=p*thm
        al=(2*ia-ib-ic)/3; be=(ib-ic)/np.sqrt(3)
        q=al*np.sin(th)-be*np.cos(th); d=-al*np.cos(th)-be*np.sin(th)
        h=1e-4; w=s.w
        return p*((w(d+h,q,th)-w(d-h,q,th))*q-(w(d,q+h,th)-w(d,q-h,th))*d+(w(d,q,th+h)-w(d,q,th-h)))/(2*h)
def iabc(th,d,q):
    return [q*np.sin(th-2*np.pi*k/3)-d*np.cos(th-2*np.pi*k/3) for k in range(3)]
def log(fn,m,iq,id,rpm,zero,rng,turns=4,n=4000,Tc=.06,Bv=.002,gear=0.,geari=0.,drag2=0.,gain=0.,noise=.01,tau=3e-4,inoise=.03):
    wm=rpm*2*np.pi/60; Ttot=turns*2*np.pi/abs(wm); os=4; t=np.arange(n*os)*Ttot/(n*os); dt=t[1]
    thm=rng.uniform(0,6)+wm*t+.004*np.sin(wm*t)*np.sign(wm)
    i=iabc(p*thm,id,iq)
    Ta=m.T(thm,*i)
    Ts=Ta-np.sign(wm)*(Tc+gear*np.abs(Ta.mean())+geari*np.abs(Ta)+drag2*iq**2)-Bv*wm
    y=np.empty_like(Ts); y0=Ts[:200].mean(); a=1-np.exp(-dt/tau)
    for k in range(len(Ts)): y0+=a*(Ts[k]-y0); y[k]=y0
    sl=slice(8,None,os)
    r=y[sl]*(1+gain)+zero+noise*rng.standard_normal(y[sl].shape)
    c=[x[sl]+inoise*rng.standard_normal(r.shape) for x in i]
    np.savetxt(fn,np.c_[t[sl],thm[sl],c[0],c[1],c[2],r],delimiter=',',header='time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm',comments='',fmt='%.6f')
def play(m,wf):
    with open(wf) as f: hd=f.readline().strip().split(',')
    d=np.loadtxt(wf,delimiter=',',skiprows=1); d=d[:,:4] if hd[0]=='theta_e_rad' else None
    step=d[1,0]-d[0,0]; P=round((d[-1,0]+step)/(2*np.pi))*2*np.pi
    thm=np.arange(40000)*2*np.pi/40000; te=(p*thm)%P
    xs=np.append(d[:,0],d[0,0]+P); cur=[np.interp(te,xs,np.append(d[:,k],d[0,k])) for k in (1,2,3)]
    T=m.T(thm,*cur); return np.ptp(T),T.mean()
