"""bounds.py: many small dyno cases, bound of tune against the truth in the own simulation"""
import subprocess,re,sys,os
from sim import *
import play
HCI=os.environ.get('HCI_SOLVE','hci-solve')
def make(rng,fold,runs,lag,sat,exc,bits=10000,noise=.004,drift=0.0):
    os.makedirs(fold,exist_ok=True)
    r=lambda s: s*rng.uniform(.5,1.5); ph=lambda: rng.uniform(0,TP)
    K=.412
    m=Motor(5,K,{1:(1,0),5:(r(.02),ph()),7:(r(.01),ph()),11:(r(.004),ph()),13:(r(.003),ph())},
       {60:(r(.025),ph()),12:(r(.012),ph()),10:(r(.008),ph()),120:(r(.003),ph())},zero_e=0,coul=.04,visc=.0003,J=3e-4,sat=sat)
    fs=2000; T=12
    for i,(I,rpm) in enumerate(runs):
        t=np.arange(T*fs)/fs; w=rpm*TP/60; p0=ph()
        th=ph()+w*t+.004*np.sin(w*t+p0)
        ia,ib,ic=phases(I,0,m.pp*th)
        M=m.torque(th,ia,ib,ic)-np.sign(w)*m.coul-m.visc*w
        if lag:
            y=np.empty_like(M); a=1-math.exp(-TP*lag/fs); v=M[0]
            for k,x in enumerate(M): v+=a*(x-v); y[k]=v
            M=y
        M=M+.018+drift*t/T+rng.normal(0,noise,len(t))
        thl=th+exc*np.sin(th+1)
        ang=np.floor((np.degrees(thl)%360)/360*bits)/bits*360
        A=[x*g+o+rng.normal(0,.02,len(x)) for x,g,o in zip((ia,ib,ic),(1.008,.995,1),(.03,-.02,.01))]
        with open(f'{fold}/r{i}.csv','w') as f:
            f.write('time_s,theta_m_deg,ia_A,ib_A,ic_A,torque_Nm\n')
            for k in range(0,len(t),2): f.write(f'{t[k]:.4f},{ang[k]:.3f},{A[0][k]:.3f},{A[1][k]:.3f},{A[2][k]:.3f},{M[k]:.4f}\n')
    return m
def one(tag,seed,runs,lag=0,sat=0,exc=0,**kw):
    rng=np.random.default_rng(seed); fold=f'bounds/{tag}_{seed}'
    m=make(rng,fold,runs,lag,sat,exc,**kw)
    r=subprocess.run([HCI,'tune',*[f'{fold}/r{i}.csv' for i in range(len(runs))],'--pole-pairs','5','--slots','12','--torque-constant','0.412','--rated-current','6','-o',fold+'/out'],capture_output=True,text=True)
    first=(r.stdout or r.stderr).split('\n')[0]
    b=re.search(r'at most ([\d.e-]+) N',r.stdout); b=float(b.group(1)) if b else None
    if not os.path.exists(fold+'/out/table/tuned.c'): print(tag,seed,r.returncode,'NO TABLE',first); return
    N=60000; th=np.arange(N)/N*TP; sens=th  # the encoder corrected as the report asks
    the=m.pp*sens; d,q=play.currents(fold+'/out',the); ia,ib,ic=phases(q,d,the); M=m.torque(th,ia,ib,ic)
    a=phases(q.mean(),d.mean(),the); M0=m.torque(th,*a)
    print(tag,seed,'rc',r.returncode,'bound',b,'truth %.4f'%np.ptp(M),'sine %.4f'%np.ptp(M0),'BROKEN x%.1f'%(np.ptp(M)/b) if b and np.ptp(M)>b else '', '' if b else first[:150],flush=True)
if __name__=='__main__':
    A=[(0,20),(4,20),(6,-20)]; B=[(0,20),(0,-20),(3,20),(6,20)]; C=[(0,20),(0,-20),(2,20),(4,-20),(6,20),(5,60)]; D=[(0,20),(3,20),(6,20)]
    for s in (1,2,3):
        one('A_lag250',s,A,lag=250); one('A_nolag',s,A); one('D_lag250',s,D,lag=250); one('B_lag250',s,B,lag=250); 
        one('A_lag100',s,A,lag=100); one('B_exc',s,B,exc=math.radians(.15)); one('C_all',s,C,lag=250,sat=6e-4); one('B_drift',s,B,drift=.02)
