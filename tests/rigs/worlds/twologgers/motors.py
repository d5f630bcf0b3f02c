import numpy as np
rng=np.random.default_rng(13)
def series(c,x):  # list of (order, amp, phase): A sin(n x + g)
    return sum(a*np.sin(n*x+g) for n,a,g in c)
def dq2abc(d,q,th):
    f=lambda s: q*np.sin(th-s)-d*np.cos(th-s)
    return [f(0),f(2*np.pi/3),f(-2*np.pi/3)]
def abc2dq(a,b,c,th):
    s=2*np.pi/3
    q=2/3*(a*np.sin(th)+b*np.sin(th-s)+c*np.sin(th+s)); d=-2/3*(a*np.cos(th)+b*np.cos(th-s)+c*np.cos(th+s))
    return d,q
class Spm:
    def __init__(s,p,emf,cog,fr,visc): s.p,s.emf,s.cog,s.fr,s.visc=p,emf,cog,fr,visc
    def torque_em(s,thm,abc):
        th=s.p*thm; T=0
        for k,i in enumerate(abc): T=T+i*series(s.emf,th-k*2*np.pi/3)
        return T+series(s.cog,thm)       # cog in mechanical orders
    def shaft(s,thm,abc,w): return s.torque_em(thm,abc)-s.fr*np.sign(w)-s.visc*w
servo=Spm(5,[(1,.060,0),(5,.0013,.4),(7,.0009,2.6),(11,.0004,.3),(13,.0003,1)],
  [(60,.008,.7),(120,.0015,-1.),(12,.003,2.1),(10,.002,.5)],.005,2e-4)
hub=Spm(21,[(1,.2205,0),(5,.004,.2),(7,.003,2.8),(11,.001,1)],
  [(252,.020,.9),(42,.012,-.6),(36,.008,1.9),(504,.003,.3)],.045,.01)
class Ipm:
    p=4; psi=.12; Ld=3.2e-3; Lq=7.5e-3; Is=12.; k=.0012
    def g(s,q): return q*q/(1+(q/20)**2)
    def dg(s,q): return 2*q/(1+(q/20)**2)**2
    cog=[(6,.12,.5),(12,.03,-1)]   # electrical
    def fluxes(s,d,q,th):
        h=.0022*np.sin(6*th+.4)+.0008*np.sin(12*th+1.); hq=.0018*np.cos(6*th+.4)
        r=.00009*np.sin(6*th+1.3)
        fd=s.psi*(1-s.k*s.g(q))+s.Ld*d+h
        fq=s.Lq*q/np.sqrt(1+(q/s.Is)**2)-s.psi*s.k*d*s.dg(q)+hq+r*q/(1+(q/15)**2)**2*2
        return fd,fq
    def torque_em(s,th,d,q):
        fd,fq=s.fluxes(d,q,th)
        dh=.0022*6*np.cos(6*th+.4)+.0008*12*np.cos(12*th+1.); dhq=-.0018*6*np.sin(6*th+.4)
        dr=.00009*6*np.cos(6*th+1.3)
        gq=q*q/(1+(q/15)**2)
        return 1.5*s.p*(fd*q-fq*d)+1.5*s.p*(dh*d+dhq*q+dr*gq)+series(s.cog,th)
ipm=Ipm()
class Sens:  # drive's own sensors: measured = gain*true+offset
    def __init__(s,ga=1,gb=1,gc=1,oa=0,ob=0,oc=0,ecc=0,eph=0): s.g=[ga,gb,gc];s.o=[oa,ob,oc];s.ecc=ecc;s.eph=eph
    def angle(s,thm): return thm+s.ecc*np.sin(thm+s.eph)
    def true(s,ref):  # what flows when the drive makes its own measured d,q of three sensors equal ref: a,b sensors closed loop, c=-a-b
        a=(ref[0]-s.o[0])/s.g[0]; b=(ref[1]-s.o[1])/s.g[1]; return [a,b,-a-b]
    def meas(s,t,n): return [s.g[k]*t[k]+s.o[k]+n*rng.standard_normal(t[k].shape) for k in range(3)]
S1=Sens(1.006,.994,1.002,.015,-.02,.01,ecc=.0006,eph=.8)
S3=Sens(1.004,.997,1.0,.02,-.03,.01,ecc=.0004,eph=2)
