# minimal: p=4, e=0.1 V·s (0.15 N·m/A, as declared exactly), cogging order 6 50 mN·m, back-EMF 5th 2 %; torque noise 2 mN·m. Logs: off (no current columns),
# load5 = i_q 5 A steady, 3 turns at 20 rpm, 1 kHz. Phase current reading noise as argument (A). All sensors perfect but noise.
from lib import *
import sys
p=4; m=Motor(p,[(1,.1,0),(5,.002,.3)],[(24,.05,.7)])
def log(name,iq,noise,seed,tn=.002):
    r=np.random.default_rng(seed); t=np.arange(0,9,.002); th_m=t*20*tau/60; i=ipark(0*t,iq+0*t,p*th_m); T=m.torque(th_m,i)+r.normal(0,tn,len(t))
    c=i+r.normal(0,noise,i.shape)
    with open(name,'w') as o:
        o.write('time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm\n' if iq else 'time_s,theta_m_rad,torque_Nm\n')
        for k in range(len(t)): o.write('%.4f,%.6f,'%(t[k],th_m[k])+('%.4f,%.4f,%.4f,'%tuple(c[:,k]) if iq else '')+'%.5f\n'%T[k])
def play(folder):
    f,per,txt=load_table(folder); thm=np.linspace(0,tau,48000,endpoint=False); d,q=f(thm); T=m.torque(thm,ipark(d,q,p*thm)); Tp=m.torque(thm,ipark(0*thm,T.mean()/.15+0*thm,p*thm))
    print(folder,'TRUE mean %.4f ripple %.4f; plain sine of that mean %.4f'%(T.mean(),pp(T),pp(Tp)))
if __name__=='__main__':
    if sys.argv[1]=='make':
        log('mn/off.csv',0,0,1)
        for n in (0,.005,.01,.02,.05,.1): log('mn/l5_%g.csv'%n,5,n,2); log('mn/l2_%g.csv'%n,2.5,n,3)
    else: play(sys.argv[2])
