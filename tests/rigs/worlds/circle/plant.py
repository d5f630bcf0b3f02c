"""Own plant + drive. Physics: phase back-EMF series -> dq; PI current loop with delay, dead time, voltage limit, ADC errors;
LuGre/Stribeck friction; torque sensor with lag, drift, gain; encoder with eccentricity, resolution, zero."""
import numpy as np, ctypes, subprocess, os, re
here=os.path.dirname(os.path.abspath(__file__))
so=here+'/libpl.so'
if not os.path.exists(so) or os.path.getmtime(so)<os.path.getmtime(here+'/plant.c'):
    subprocess.check_call(['gcc','-O2','-shared','-fPIC','-o',so,here+'/plant.c','-lm'])
L=ctypes.CDLL(so)
names=re.sub(r'\s','',re.search(r'enum \{(.*?)\};',open(here+'/plant.c').read(),re.S).group(1)).replace('P_','',1)
names=[x[2:] if x.startswith('P_') else x for x in re.sub(r'\s','',re.search(r'enum \{(.*?)\};',open(here+'/plant.c').read(),re.S).group(1)).split(',')]
IX={n:i for i,n in enumerate(names)}
dp=ctypes.POINTER(ctypes.c_double)
def ptr(a): return a.ctypes.data_as(dp)
L.sim.restype=ctypes.c_int
L.sim.argtypes=[ctypes.c_int,dp,dp,dp,dp,ctypes.c_int,dp,dp,ctypes.c_int]
L.torque.restype=ctypes.c_double
L.torque.argtypes=[dp,dp,dp,dp,ctypes.c_int]+[ctypes.c_double]*4
# lam: flux linkage peak; bemf [(order, share, phase)]; cog [(mechanical order, Nm, phase)]; uneven: [(mech order, share, phase)] modulates the magnets
M={}
M['outrunner']=dict(p=7,slots=12,kv=270,R=.12,Ld=60e-6,Lq=66e-6,J=4e-5,Tc=.006,Ts=.0075,ws=.6,B=2e-6,rated=12,
  bemf=[(5,.03,.4),(7,.016,2.8),(11,.008,1.0),(13,.004,.2)],cog=[(84,.0045,.8),(168,.0012,-.4),(12,.0028,2.),(14,.0016,1.1),(24,.0011,.2)],uneven=[(1,.006,.3)],
  satm=2e-5,satq=2e-3,c3=0,l6=1e-7,fs=20000,bw=1000,vlim=13,dead=.08,anoise=.08,aq=.02,counts=8192*2,ecc=.0007,alias=.02,tnoise=.001)
M['servo']=dict(p=5,slots=12,kt=.368,R=2.1,Ld=6.0e-3,Lq=6.3e-3,J=2.8e-5,Tc=.02,Ts=.026,ws=1.5,B=5e-5,rated=3.7,
  bemf=[(5,.012,3.0),(7,.007,.5),(11,.004,1.9),(13,.003,.1)],cog=[(60,.017,.5),(120,.003,2.),(12,.006,-1),(10,.004,.6)],uneven=[(1,.003,1.)],
  satm=1e-3,satq=1e-2,c3=1e-6,l6=4e-6,fs=10000,bw=800,vlim=160,dead=1.5,anoise=.008,aq=.004,counts=131072,ecc=.0002,alias=.004,tnoise=.008,tsl=.0004)
M['ipm']=dict(p=4,slots=48,lam=.075,R=.012,Ld=.2e-3,Lq=.5e-3,J=.03,Tc=.6,Ts=.7,ws=3,B=.002,rated=250,
  bemf=[(5,.02,.6),(7,.025,2.9),(11,.035,.3),(13,.02,-2.2)],cog=[(48,.5,1.2),(96,.12,.3)],uneven=[],
  satm=1.2e-6,satq=1.2e-3,c3=4e-11*1,c3ph=.5,l6=1.6e-6,l6ph=.9,fs=10000,bw=500,vlim=190,dead=2.,anoise=.5,aq=.15,counts=4096,ecc=.0008,alias=.3,tnoise=.35,tsl=.0008)
M['ring']=dict(p=22,slots=48,kt=3.4,R=1.6,Ld=9e-3,Lq=9.6e-3,J=.022,Tc=.7,Ts=.95,ws=.25,B=.05,rated=8,
  bemf=[(5,.015,.2),(7,.011,2.5),(11,.006,.9)],cog=[(528,.12,.7),(48,.16,.2),(44,.09,1.9),(96,.05,2.2)],uneven=[(1,.004,.2),(2,.003,1.)],
  satm=2e-4,satq=4e-3,c3=0,l6=8e-6,fs=10000,bw=300,vlim=26,dead=.5,anoise=.02,aq=.01,counts=2**20,ecc=.00008,alias=.01,tnoise=.05,tsl=.001)
M['cobot']=dict(p=10,slots=24,kt=.11,R=.35,Ld=.25e-3,Lq=.27e-3,J=6e-5,Tc=.03,Ts=.038,ws=2.,B=1e-4,rated=9,
  bemf=[(5,.02,.2),(7,.014,2.7),(11,.006,1.4)],cog=[(120,.006,.6),(24,.004,.1),(20,.002,1.7)],uneven=[],
  satm=1e-4,satq=4e-3,c3=0,l6=5e-7,fs=20000,bw=1200,vlim=26,dead=.15,anoise=.03,aq=.01,counts=2**17,ecc=.0001,alias=.01,mesh=.004,meshratio=2.02,tnoise=.004)
DEF=dict(c3ph=0,l6ph=0,sig0=None,fang=.05,aoffa=0,aoffb=0,again_a=1,again_b=1,offe=0,eccph=.4,ecc2=0,zlog=0,mode=0,w0=0,hunt=.002,fhunt=1.3,hunt1=.001,iq=0,id=0,
  tsl=0,tgain=1,toff=0,tdrift=0,Trise=0,Ttau=0,brake=0,turns=2,speedbw=12,usetab=0,period=1,nrow=0,ideal=0,th0=.13,skip=.3,mesh=0,meshratio=0,meshph=0,seed=1,dec=1,open=0,iqsign=1,dwell=.3,oneway=0,elag=0)
class Plant:
    def __init__(s,name,**kw):
        m=dict(DEF);m.update(M[name]);m.update(kw);s.name=name;s.m=m;p=m['p']
        if 'lam' not in m: m['lam']= m['kt']/(1.5*p) if 'kt' in m else 60/(2*np.pi*np.sqrt(3)*p*m['kv'])
        s.Kt=m['Kt']=1.5*p*m['lam'];s.kv=60/(2*np.pi*np.sqrt(3)*p*m['lam'])
        if m['sig0'] is None: m['sig0']=m['Tc']/.004
        ng=s.ng=p*2048;x=np.arange(ng)/ng*2*np.pi;te=p*x
        mod=1+sum(a*np.sin(n*x+f) for n,a,f in m['uneven'])
        k=[m['lam']*mod*(np.sin(te-d)+sum(a*np.sin(n*(te-d)+f) for n,a,f in m['bemf'])) for d in (0,2*np.pi/3,4*np.pi/3)]
        k0=sum(k)/3;k=[q-k0 for q in k]
        ds=(0,2*np.pi/3,4*np.pi/3)
        s.kq=np.ascontiguousarray(2/3*sum(q*np.sin(te-d) for q,d in zip(k,ds)));s.kd=np.ascontiguousarray(-2/3*sum(q*np.cos(te-d) for q,d in zip(k,ds)))
        s.cog=np.ascontiguousarray(sum(a*np.sin(n*x+f) for n,a,f in m['cog'])+0*x)
        # mesh acts only under 'mesh'
    def vec(s,**kw):
        d=dict(s.m);d.update(kw);v=np.zeros(len(names))
        for n in names:
            if n=='N':continue
            v[IX[n]]=d[n]
        return v
    def run(s,T,tab=None,period=1,**kw):
        d=dict(s.m);d.update(kw);n=int(T*d['fs'])
        if tab is not None: kw.update(usetab=1,period=period,nrow=len(tab));tb=np.ascontiguousarray(tab,float)
        else: tb=np.zeros((2,2))
        mx=n//int(d['dec'])+2;out=np.zeros((mx,16))
        k=L.sim(n,ptr(s.vec(**kw)),ptr(s.kd),ptr(s.kq),ptr(s.cog),s.ng,ptr(tb),ptr(out),mx)
        return out[:k]
    def torque(s,th,id,iq,km=1.):
        v=s.vec();return np.array([L.torque(ptr(v),ptr(s.kd),ptr(s.kq),ptr(s.cog),s.ng,float(a),float(b),float(c),km) for a,b,c in zip(th,id,iq)])
    def static(s,tab=None,period=1,iq=0,id=0,n=None,km=1.):
        """ideal loop, slow: torque over one mechanical turn; the drive's own angle errors are in (they are not the loop's)"""
        m=s.m;n=n or m['p']*360;th=np.arange(n)/n*2*np.pi
        enc=th+m['ecc']*np.sin(th+m['eccph'])+m['ecc2']*np.sin(2*th+1);e=m['p']*(enc-th)+m['offe']
        if tab is None: rd=id+0*th;rq=iq+0*th
        else:
            x=np.mod(m['p']*(enc+m['zlog'])/2/np.pi/period,1)*len(tab);i=np.floor(x).astype(int)%len(tab);f=x-np.floor(x);j=(i+1)%len(tab)
            rd=tab[i,0]+(tab[j,0]-tab[i,0])*f;rq=tab[i,1]+(tab[j,1]-tab[i,1])*f
        d=rd*np.cos(e)-rq*np.sin(e);q=rd*np.sin(e)+rq*np.cos(e)
        T=s.torque(th,d,q,km)
        if m['mesh']: T=T+m['mesh']*np.sin(m['meshratio']*th)
        return T
    def binned(s,o):
        """true torque of a run, mean over turns by angle"""
        n=s.m['p']*240;i=(np.mod(o[:,1]/2/np.pi,1)*n).astype(int)%n
        c=np.bincount(i,minlength=n);b=np.bincount(i,o[:,10],n);g=c>0
        y=b[g]/c[g];return y
def pp(y): return float(np.max(y)-np.min(y))
def read_table(folder):
    import glob
    c=[f for f in glob.glob(folder+'/*.c')][0];t=open(c).read();h=open(c[:-1]+'h').read()
    r=re.search(r'_rows\[\d+\] = \{(.*?)\}',t,re.S).group(1)
    v=np.array([float(x.strip().rstrip('f')) for x in r.replace('\n',' ').split(',') if x.strip()])
    per=int(re.search(r'2\^32 = (\d+) electrical turn',h).group(1)) if re.search(r'2\^32 = (\d+) electrical turn',h) else None
    rows=v.reshape(-1,2)[:-1] # guard row
    return rows,per,h
