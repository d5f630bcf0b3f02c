"""motor 3: servo, cheap torque sensor (12 Hz low pass, drift), encoder 2048 counts unknown zero, Excel export, two currents"""
from mot import *
from scipy.signal import lfilter
import os
R=np.random.default_rng(33)
ZERO=777  # counts at theta_m=0
GA=dict(off=(.03,-.02),gain=(1.008,.994))
def log3(fn,I,rpm,T=15.,fs=1000.,fc=12.,drift=.002,ang=0.0,mot=M3,perfect=False):
    n=int(T*fs); t=np.arange(n)/fs; w=rpm*2*np.pi/60*(1+.004*np.sin(2*np.pi*.5*t+1))
    tm=R.uniform(0,6)+np.cumsum(w)/fs; te=mot.p*tm
    a,b,c=abc(-I*np.sin(ang),I*np.cos(ang),te)
    if I:
        ta,tb=(a-GA['off'][0])/GA['gain'][0],(b-GA['off'][1])/GA['gain'][1]; tc=-ta-tb
        d,q=dq(ta,tb,tc,te)
    else: ta=tb=0*te; d=q=0*te
    Tq=mot.T(d,q,tm)-np.sign(rpm)*.05-.002*w
    k=np.exp(-2*np.pi*fc/fs); y=lfilter([1-k],[1,-k],Tq,zi=[k*Tq[0]])[0]
    y=y*1.01+.02+drift*t+.008*R.standard_normal(n)
    ia=ta*GA['gain'][0]+GA['off'][0]+.02*R.standard_normal(n); ib=tb*GA['gain'][1]+GA['off'][1]+.02*R.standard_normal(n)
    cnt=(np.floor(tm/(2*np.pi)*2048).astype(int)+ZERO)%2048
    with open(fn,'w',encoding='utf-8-sig') as f:
        f.write('Time;Encoder (counts);Phase A (A);Phase B (A);Torque (Nm)\r\n')
        for i in range(n): f.write(f'00:{int(t[i]//60):02d}:{t[i]%60:06.3f};{cnt[i]};{ia[i]:.3f};{ib[i]:.3f};{y[i]:.3f}\r\n'.replace('.',','))
if __name__=='__main__':
    os.makedirs('m3',exist_ok=True)
    log3('m3/idle_f.csv',0,20); log3('m3/idle_r.csv',0,-20)
    for I in (2,4,6): log3(f'm3/load{I}.csv',I,20)
