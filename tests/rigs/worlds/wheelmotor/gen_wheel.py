"""ODrive-like logger + load cell on a lever 0.2 m, 80 Hz hold; 512-line encoder x4; i_d,i_q of the drive; brake = other motor prescribes the speed"""
import sys
from gen import *
def rec(name,iq,idd,rpm,turns,seed,t0=0.,fs=160,lever=.2,cell=True,noise=.15):
    t,thr,thm,ws,r,tr=sweep(Wm,SW,iq,idd,rpm,turns,fs,seed,tau=.02,tzero=0.35+.0006*t0,tgain=.985,tdrift=.0002,tn=noise*lever,inoise=.12,wob=.004)
    el=10*thr; 
    idr,iqr=park(el,*(r-r.mean(0)))
    hold=np.arange(len(t))//2*2; F=tr[hold]/lever
    # coarse speed of the encoder
    v=np.gradient(thr,t)/2/np.pi
    with open(name,'w') as f:
        f.write('timestamp_us\tencoder.pos_estimate [turn]\tencoder.vel_estimate [turn/s]\tIq_measured [A]\tId_measured [A]\tcell_N\n')
        for k in range(len(t)):
            f.write('%d\t%.6f\t%.4f\t%.3f\t%.3f\t%.2f\n'%(t[k]*1e6+12345,thr[k]/2/np.pi,v[k],iqr[k],idr[k],F[k]))
def volt(name,rpm,seed):
    rng=np.random.default_rng(seed); n=20000; t=np.arange(n)/10000; w=rpm*np.pi/30; th=w*t+1.; h=1e-6
    e=[(b-a)/(2*h)*w+rng.normal(0,.08,n) for a,b in zip(Wm.lam(th-h),Wm.lam(th+h))]
    thr=SW.angle(th)
    with open(name,'w') as f:
        f.write('time_s,theta_m_rad,va_V,vb_V,vc_V\n')
        for k in range(n): f.write('%.4f,%.5f,%.3f,%.3f,%.3f\n'%(t[k],thr[k],e[0][k],e[1][k],e[2][k]))
if __name__=='__main__':
    rec('w/free_f.tsv',0,0,3,3,1); rec('w/free_b.tsv',0,0,-3,3,2,100)
    rec('w/load20.tsv',20,0,3,3,3,200); rec('w/load40.tsv',40,0,3,3,4,300); rec('w/brake40.tsv',-40,0,3,3,5,400); rec('w/load30b.tsv',-30,0,-3,3,6,500)
    volt('w/open.csv',120,7)
    rec('w/load10.tsv',10,0,3,3,8,600); rec('w/load40_f2.tsv',40,0,1.5,2,9,700);  rec('w/load20_seed.tsv',20,0,3,3,33,200); rec('w/load40_seed.tsv',40,0,3,3,44,300)
