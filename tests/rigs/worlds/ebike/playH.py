import sys, re, numpy as np
from motors import *; from table import load
import recordH
h=H(); sys.argv
def corr(folder):
    t=open(folder+'/tuned.h').read(); m={k:float(v) for k,v in re.findall(r'#define tuned_(\w+) (-?[\d.e+-]+)f',t)}
    return m
def corrected(read,m):   # in the order of the lines: each of what came before
    th=read-m.get('THETA_M_ZERO_RAD',0)
    for k in ('SIN1','SIN2','COS1','COS2'):
        if 'THETA_M_'+k+'_RAD' in m: n=int(k[3]); th=th-m['THETA_M_'+k+'_RAD']*(np.sin(n*th) if k[:3]=='SIN' else np.cos(n*th))
    return th
def cur(folder,scale=1):
    f,per,turns=load(folder+'/table'); m=corr(folder+'/table'); P=per
    def c(read):
        d,q=f(corrected(read,m),P); return d*scale,q*scale
    return c,m
def truth(folder,curf,m,commut=True):
    thm=np.linspace(0,2*np.pi,20000,endpoint=False); rd=h.angle_read(thm)
    dm,qm=curf(rd); thr=h.p*(corrected(rd,m) if commut else rd)
    mabc=abc(thr,dm,qm)
    # the drive: measured currents follow; sensors false (offset, gain)
    t=[(mabc[k]-h.off[k])/h.gain[k] for k in range(3)]
    # if the header gives current corrections, they are applied on reading
    if 'IA_ZERO_A' in m or 'IA_GAIN' in m:
        t=[(mabc[k]/m.get('I%s_GAIN'%'ABC'[k],1)+m.get('I%s_ZERO_A'%'ABC'[k],0)-h.off[k])/h.gain[k] for k in range(3)]
    z=sum(t)/3; t=[x-z for x in t]
    T=h.torque(thm,*dq(h.p*thm,*t)); 
    F=np.fft.rfft(T)/T.size; A=2*abs(F); o=np.argsort(-A[1:])[:8]+1
    return T,[(k/h.p,round(A[k],4)) for k in o]
if __name__=='__main__':
    fo=sys.argv[1]; c,m=cur(fo); print(m)
    for cm in (True,False):
        T,o=truth(fo,c,m,cm); print('table, commutation',('corrected' if cm else 'raw'),'mean',T.mean(),'pp',np.ptp(T),o)
    q0=float(sys.argv[2]) if len(sys.argv)>2 else 19.4
    T,o=truth(fo,lambda r:(np.zeros_like(r),np.full_like(r,q0)),{}); print('sine',q0,'mean',T.mean(),'pp',np.ptp(T),o)
