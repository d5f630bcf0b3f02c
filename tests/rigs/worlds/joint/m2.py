# Motor 2: servo PMSM 4 pole pairs 24 slots (lcm(24,8)=24 -> electrical order 6), dyno with transducer. Speed prescribed by load machine.
import math, os
import numpy as np
P=4
SHEET_VKRPM=52.0            # line rms per 1000 rpm -> phase peak = 52*sqrt2/sqrt3
KEp=SHEET_VKRPM*math.sqrt(2/3)/(1000*2*math.pi/60)*0.985   # V s/rad mech
EMF=[(1,1.0,0.0),(3,0.03,0.2),(5,0.021,0.3),(7,-0.013,0.1),(11,0.007,-0.4),(13,0.004,1.0)]
COG=[(24,0.075,0.5),(48,0.022,-1.2),(8,0.012,0.4),(12,0.006,2.0),(72,0.004,0.1)]  # mech orders
RES=[(1,math.radians(0.10),0.4),(2*0+4,math.radians(0.06),1.0)]  # resolver error, mech rad (4 = once an elec. period)
GAIN=(1.015,0.994,1.0); OFF=(0.035,-0.02,0.01)
TC=0.055; TV=3.5e-4
JR=4.2e-4                    # rotor before the transducer
FT=130.0                     # transducer low pass, Hz, first order
GT=1.006                     # transducer gain
SAT=0.0012                   # T = k i (1 - SAT*|i|^2...) mild
ANG=math.radians(33.0)       # resolver zero, electrical, to be found: th_log = th + ANG/P
def emf(te): return np.array([sum(a*np.sin(n*(te-2*math.pi/3*s)+p) for n,a,p in EMF) for s in range(3)])
def cog(th): return sum(a*np.sin(n*th+p) for n,a,p in COG)
def res(th): return th+sum(a*np.sin(n*th+p) for n,a,p in RES)+ANG/P
def torque(th,iabc):
    e=emf(P*th); m=math.sqrt(2/3)*np.sqrt((iabc**2).sum(0))
    return KEp*(e*iabc).sum(0)*(1-SAT*m**2/1.0*0.5)+cog(th)
def drive_currents(ref,):  # sensors' readings = ref -> real
    r=np.array([(ref[s]-OFF[s])/GAIN[s] for s in range(3)])
    return r-r.mean(0)
def record(path,iq,rpm,secs,fs=5000,zero=0.04,seed=0,idd=0.0,stop=None,drop=False,openc=False,dec=1,comm=0.0):
    rng=np.random.default_rng(seed)
    n=int((secs+0.3)*fs); t=np.arange(n)/fs
    w0=rpm*2*math.pi/60
    swing=0.006*w0
    ph0=rng.uniform(0,6.28)
    th=w0*t+ph0; th=th+0.006*np.sin(th+0.3)   # load machine swings once a turn
    w=np.gradient(th,t); acc=np.gradient(w,t)
    thr=res(th)
    te=P*(thr)-ANG+comm   # drive is calibrated: zero known to it up to comm
    if openc: i=np.zeros((3,n))
    else:
        ref=np.array([iq*np.sin(te-2*math.pi/3*s)-idd*np.cos(te-2*math.pi/3*s) for s in range(3)])
        # current loop lag small
        i=drive_currents(ref)
    T=torque(th,i)-np.sign(w)*TC-TV*w-JR*acc
    y=np.zeros(n); a=1-math.exp(-2*math.pi*FT/fs); s=T[0]
    for k in range(n):
        s+=a*(T[k]-s); y[k]=s
    y=GT*y+zero+rng.normal(0,0.012,n)
    im=np.array([GAIN[k]*i[k]+OFF[k] for k in range(3)])+rng.normal(0,0.015,(3,n))
    if openc: im=np.array([[OFF[k]] for k in range(3)])+rng.normal(0,0.015,(3,n))
    sp=w*60/2/math.pi+rng.normal(0,0.05,n)
    k0=int(0.3*fs); sl=slice(k0,n,dec)
    t=t[sl]-t[k0]
    rows=list(zip(t,np.degrees(thr[sl])%360,*[im[k][sl] for k in range(3)],y[sl],sp[sl]))
    if stop: rows=rows[:int(len(rows)*stop)]
    with open(path,'w',encoding='latin-1') as f:
        f.write('Zeit;Resolverwinkel;Strom L1;Strom L2;Strom L3;Drehmoment;Drehzahl\n')
        f.write('s;°;A;A;A;Nm;1/min\n')
        for j,r in enumerate(rows):
            c=['%.4f'%r[0],'%.3f'%r[1],'%.3f'%r[2],'%.3f'%r[3],'%.3f'%r[4],'%.4f'%r[5],'%.2f'%r[6]]
            if drop and 0.41<j/len(rows)<0.43: c[5]='0.0000' if drop=='zero' else ''
            f.write(';'.join(c).replace('.',',')+'\n')
        if stop: f.write(';'.join(c[:3]).replace('.',','))
def truth(iabc_fun,n=9600,ideal=True):
    """iabc_fun(th_log mech) -> wanted abc by the drive. ideal: flow as wanted (sensors corrected), else sensors bend them."""
    th=np.arange(n)*2*math.pi/n
    ref=iabc_fun(res(th))
    i=ref-ref.mean(0) if ideal else drive_currents(ref)
    return th,torque(th,i)
if __name__=='__main__':
    os.makedirs('../m2',exist_ok=True); D='../m2/'
    record(D+'idle_f.csv',0,40,6,seed=1,dec=2)
    record(D+'idle_b.csv',0,-40,6,seed=2,dec=2)
    record(D+'third.csv',3,40,6,seed=3,dec=2)
    record(D+'twothird_b.csv',6,-40,6,seed=4,dec=2,drop='zero')
    record(D+'full.csv',9,40,6,seed=5,dec=2)
    record(D+'full_stop.csv',9,-40,6,seed=6,dec=2,stop=0.38)
    record(D+'fast.csv',5,200,2.4,seed=7,zero=0.075,dec=1)
