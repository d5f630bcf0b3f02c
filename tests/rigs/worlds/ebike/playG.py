import sys, re, numpy as np
from motors import *; from table import load
from playH import corr, corrected
g=G()
def cur(folder):
    f,per,_=load(folder+'/table'); m=corr(folder+'/table')
    return (lambda read: f(corrected(read,m),per)), m
def truth(c,m):
    thm=np.linspace(0,2*np.pi,28000,endpoint=False); rd=g.angle_read(thm); d,q=c(rd)
    the=g.p*thm+g.czero; a=abc(the,d,q); t=[(a[0]-g.off[0])/g.gain[0],(a[1]-g.off[1])/g.gain[1]]; t.append(-t[0]-t[1])
    T=g.torque(thm,*dq(g.p*thm,*t)); F=2*abs(np.fft.rfft(T))/T.size; o=np.argsort(-F[1:])[:8]+1
    return round(T.mean(),4),round(np.ptp(T),4),[(int(k),round(float(F[k]),5)) for k in o]
if __name__=='__main__':
    c,m=cur(sys.argv[1]); print(m); print('table (mech. orders)',truth(c,m))
    q0=c(np.linspace(0,2*np.pi,9999))[1].mean(); print('sine',q0,truth(lambda r:(0*r,0*r+q0),{}))
