# through the drive's own sensors: reading r = g*i+o ; drive makes corrected reading (r-oc)/gc = table  -> i = (table*gc+oc-o)/g
# ev2.py motor tab turns off "g a b [c]" "o.." "gc.." "oc.."   (2 entries: c=-a-b)
import sys; from mot import *
m={'1':M1,'2':M2,'3':M3}[sys.argv[1]]; tab=np.loadtxt(sys.argv[2],skiprows=1); turns=int(sys.argv[3]); off=float(sys.argv[4])
g,o,gc,oc=[np.array([float(v) for v in s.split()]) for s in sys.argv[5:9]]
n=len(tab)
def interp(tm):
    tmq=np.floor((tm)*2048/2/np.pi)*2*np.pi/2048; x=((tmq+off)*m.p/(2*np.pi)/turns)%1*n; i=np.floor(x).astype(int)%n; u=x-np.floor(x); j=(i+1)%n
    return (tab[i,0]*(1-u)+tab[j,0]*u),(tab[i,1]*(1-u)+tab[j,1]*u)
tm=np.arange(20000)*2*np.pi/20000
te_t=m.p*(np.floor(tm*2048/2/np.pi)*2*np.pi/2048+off)     # the tool's electrical angle; table is in that frame
te=m.p*tm
def sens(d,q):
    x=list(abc(d,q,te_t)); k=len(g)
    y=[(x[i]*gc[i]+oc[i]-o[i])/g[i] for i in range(k)]
    if k==2: y.append(-y[0]-y[1])
    else:
        s=sum(y)/3; y=[v-s for v in y]
    return dq(*y,te)
d,q=interp(tm); dd,qq=sens(d,q); T=ripple(m,lambda t:(dd,qq),'table through the drive')
D,Q=d.mean(),q.mean(); k=1.
for _ in range(30):
    d1,q1=sens(k*D+0*tm,k*Q+0*tm); k*=T.mean()/m.T(d1,q1,tm).mean()
d1,q1=sens(k*D+0*tm,k*Q+0*tm); ripple(m,lambda t:(d1,q1),'sine through the drive, same mean')
