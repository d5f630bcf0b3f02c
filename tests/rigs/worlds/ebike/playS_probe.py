# S: the drive has the sensors of the logs (the probes), corrected as the header of the table says
import sys,re; from playS import *
for fo in sys.argv[1:]:
    t=open(fo+'/table/tuned.h').read(); m={k:float(v) for k,v in re.findall(r'#define tuned_(\w+) (-?[\d.e+-]+)f',t)}
    off=-149.198; c=cur(fo,off); thm=np.linspace(0,2*np.pi,20000,endpoint=False); rd=thm+s.zero; d,q=c(rd); a=abc(s.p*rd+np.radians(off),d,q)
    r=[a[k]/m.get('I%s_GAIN'%'AB'[k],1)+m.get('I%s_ZERO_A'%'AB'[k],0) for k in range(2)]
    tr=[(r[k]-s.poff[k])/s.probe[k] for k in range(2)]; tr.append(-tr[0]-tr[1])
    T=s.torque(thm,*dq(s.p*thm,*tr)); print(fo,'mean %.3f pp %.3f'%(T.mean(),np.ptp(T)))
