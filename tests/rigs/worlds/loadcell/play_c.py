import sys,re
from sim import *; from player import load
def play(folder,z0=0.,corr=False):
    f=load(folder); th=np.linspace(0,2*np.pi,40000,endpoint=False)
    c=f(th*5/(2*np.pi)/f.period); T=C.air(th,ph(c[0],c[1],5*th)); m=T.mean()
    lo,hi=.1,9
    for _ in range(50):
        q=(lo+hi)/2
        if C.air(th,ph(0*th,0*th+q,5*th)).mean()<m: lo=q
        else: hi=q
    T0=C.air(th,ph(0*th,0*th+q,5*th))
    print(folder,'check',f.ok,'period',f.period,'mean %.4f pp %.5f | plain %.3f A pp %.4f'%(m,np.ptp(T),q,np.ptp(T0)))
    F=np.abs(np.fft.rfft(T))/len(T)*2
    print('   ',{'%.2f'%(k/5):round(float(F[k]),5) for k in np.argsort(-F[1:])[:6]+1})
    # drive with the sensors of the logs, uncorrected: sensor reads g*i+o ; loop makes reading=wanted => true i=(wanted-o)/g ; ic true=-(ia+ib)
    g=(1,1.015); o=(.05,-.03); i3=ph(c[0],c[1],5*th); a=(i3[0]-o[0])/g[0]; b=(i3[1]-o[1])/g[1]
    T=C.air(th,[a,b,-a-b]); print('    uncorrected sensors: pp',np.ptp(T),'mean',T.mean())
    M=dict(re.findall(r'#define tuned_(\w+) \(?(-?[\d.e-]+)f',open(folder+'/tuned.h').read()))
    M={k:float(v) for k,v in M.items()}; print('    macros',M)
    oa,ob=M.get('IA_ZERO_A',0),M.get('IB_ZERO_A',0); ga,gb=1+M.get('IA_GAIN',0),1+M.get('IB_GAIN',0)
    ga=M.get('IA_GAIN',1.0) if abs(M.get('IA_GAIN',1)-1)<.3 else ga; gb=M.get('IB_GAIN',1.0) if abs(M.get('IB_GAIN',1)-1)<.3 else gb
    # true_est=(read-oa)/ga == wanted  => read= wanted*ga+oa
    a=(i3[0]/ga+oa-o[0])/g[0]; b=(i3[1]/gb+ob-o[1])/g[1]; T=C.air(th,[a,b,-a-b]); print('    corrected sensors: pp',np.ptp(T),'mean',T.mean())
play(sys.argv[1])
