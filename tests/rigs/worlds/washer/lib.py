import numpy as np, re, os, subprocess, ctypes, glob
tau=2*np.pi
def har(x,rows): # rows (order, amp, phase)
    return sum(a*np.sin(n*x+g) for n,a,g in rows)
class Motor:
    """e(theta): phase V/(rad/s mech); worn: callable gain over (thm, phase shift) ; saturation: torque factor"""
    def __init__(s,p,emf,cog,worn=None,zero=0.,ph_gain=(1,1,1),sat=0.,rel=None):
        s.p,s.emf,s.cog,s.worn,s.zero,s.ph_gain,s.sat,s.rel=p,emf,cog,worn,zero,ph_gain,sat,rel
    def e(s,thm):
        th=s.p*thm; out=[]
        for k in range(3):
            w=1. if s.worn is None else s.worn(thm)
            out.append(s.ph_gain[k]*w*har(th-k*tau/3,s.emf))
        return np.array(out)
    def cogging(s,thm): return har(thm,s.cog) # mechanical orders
    def torque(s,thm,iabc,temp=1.):
        i=np.array(iabc); t=temp*(s.e(thm)*i).sum(0)
        a=np.sqrt((i**2).sum(0)*2/3)
        if s.sat: t=t*(1-s.sat*a**2)
        if s.rel is not None:
            d,q=park(i,s.p*thm); t=t+1.5*s.p*s.rel*d*q
        return t+s.cogging(thm)
def park(i,th):
    c=lambda k:np.sin(th-k*tau/3)
    q=2/3*sum(i[k]*c(k) for k in range(3)); d=-2/3*sum(i[k]*np.cos(th-k*tau/3) for k in range(3))
    return d,q
def ipark(d,q,th): return np.array([q*np.sin(th-k*tau/3)-d*np.cos(th-k*tau/3) for k in range(3)])
class Drive:
    def __init__(s,gain=(1,1,1),off=(0,0,0),ang=lambda t:0*t): s.g=np.array(gain)[:,None];s.o=np.array(off)[:,None];s.ang=ang
    def true(s,meas): # currents that flow where the drive reads meas
        i=(meas-s.o)/s.g; i=i-i.mean(0); return i
def load_table(folder):
    h=[f for f in glob.glob(folder+'/table/*.h')][0]; b=os.path.basename(h)[:-2]
    txt=open(h).read()
    per=int(re.search(r'_PERIODS\s+(\d+)',txt).group(1)); 
    i16='table_i16' in txt or 'hci_table_i16' in txt
    typ='i16' if i16 else 'f32'
    dq='frame dq' in txt.lower() or True
    open(folder+'/play.c','w').write(f'''#include "{b}.h"
void play(unsigned n,const unsigned*a,float*o){{for(unsigned k=0;k<n;k++){{hci_currents_dq i=hci_table_{typ}_dq(&{b},a[k]);o[2*k]=i.id_A;o[2*k+1]=i.iq_A;}}}}
''')
    so=folder+'/play.so'
    subprocess.check_call(['gcc','-O1','-shared','-fPIC','-I'+os.environ['HCI_INCLUDE'],'-I'+folder+'/table',folder+'/play.c']+glob.glob(folder+'/table/*.c')+['-o',so])
    L=ctypes.CDLL(os.path.abspath(so))
    def f(thm):
        a=(np.floor((np.asarray(thm)*per/tau%1)*2**32)).astype(np.uint64).astype(np.uint32)
        o=np.zeros(2*len(a),np.float32)
        L.play(len(a),a.ctypes.data_as(ctypes.c_void_p),o.ctypes.data_as(ctypes.c_void_p)); o=o.astype(float).reshape(-1,2)
        return o[:,0],o[:,1]
    return f,per,txt
def pp(x): return x.max()-x.min()
