import sys, re, numpy as np
from motors import *; from table import load
s=S()
def cur(folder, off_deg):
    f,per,_=load(folder+'/table')
    def c(read):  # read: encoder mechanical
        return f(read+np.radians(off_deg)/s.p,per)
    return c
def truth(c, off_deg, drive=True):
    thm=np.linspace(0,2*np.pi,20000,endpoint=False); rd=thm+s.zero
    d,q=c(rd); thr=s.p*rd+np.radians(off_deg); m=abc(thr,d,q)
    if drive: m=[m[0]-.04,m[1]/1.01,m[2]]; z=sum(m)/3; m=[x-z for x in m]
    T=s.torque(thm,*dq(s.p*thm,*m)); F=2*abs(np.fft.rfft(T))/T.size; o=np.argsort(-F[1:])[:7]+1
    return T.mean(),np.ptp(T),[(float(k/s.p),round(float(F[k]),4)) for k in o]
if __name__=='__main__':
    off=float(sys.argv[2]); c=cur(sys.argv[1],off)
    print('ideal loop',truth(c,off,False)); print('drive sensors',truth(c,off,True))
    th=np.linspace(0,2*np.pi,4000); d,q=c(th); I=np.hypot(d.mean(),q.mean()); print('mean dq',d.mean(),q.mean())
    print('sine',truth(lambda r:(np.full_like(r,d.mean()),np.full_like(r,q.mean())),off,False))
