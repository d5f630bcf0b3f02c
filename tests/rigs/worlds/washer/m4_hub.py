# Motor 4: e-bike direct-drive hub, p=23, 51 slots? -> 46 magnets/36.. here p=23, 51 slots; pushed by hand through a luggage scale? no:
# VESC Tool log (;), no torque sensor, 50 Hz, shaft turned slowly by position control forward and back 4 rpm; motor has hysteresis-like friction,
# cogging by stator eccentricity 51/turn, 46/turn, magnet spread 1..3/turn, seal friction that varies once a turn, and a wheel imbalance (1/turn, weight)
from lib import *
import sys
p=23
m=Motor(p,[(1,.80,0),(5,.02,1),(7,.012,2)],[(51,.12,.5),(46,.18,-1),(102,.04,2),(92,.05,.1)])
WEIGHT=(.25,.9) # tyre valve: load once a turn, not of the motor
KT=1.5*.80
def log(name,rpm=4,turns=1.2,seed=0,step=.02):
    r=np.random.default_rng(seed); t1=np.arange(0,turns*60/rpm,step); out=[]; t0=0.
    rows=[]
    for d in (1,-1):
        thm=(t1 if d>0 else t1[::-1])*rpm*tau/60+.2
        Tc=m.cogging(thm); fr=.35*d*(1+.15*np.sin(thm+1)); W=WEIGHT[0]*np.sin(thm+WEIGHT[1])
        em=m.e(thm); sn=np.array([np.sin(p*thm-k*tau/3) for k in range(3)]); kq=(em*sn).sum(0)
        iq=(fr+W-Tc)/kq
        iqm=iq*1.0+.04+r.normal(0,.05,len(t1))
        for k in range(len(t1)): rows.append((t0+t1[k],thm[k],iqm[k],d*rpm*p))
        t0+=t1[-1]+step
    with open(name,'w') as o:
        o.write('ms_today;input_voltage;temp_mos_max;temp_motor;current_motor;current_in;d_axis_current;q_axis_current;erpm;duty_cycle;fault_code;encoder_position;tacho_meters\n')
        for t,a,i,w in rows: o.write('%d;48.1;31.0;27.4;%.2f;0.3;%.3f;%.3f;%.1f;%.4f;0;%.3f;0.0\n'%(36000000+t*1000,i,r.normal(0,.05),i,w+r.normal(0,6),.01,np.degrees(a)%360))
def play(folder):
    f,per,txt=load_table(folder); thm=np.linspace(0,tau,200000,endpoint=False); d,q=f(thm); T=m.torque(thm,ipark(d,q,p*thm)); Tp=m.torque(thm,ipark(0*thm,T.mean()/KT+0*thm,p*thm))
    print(folder,'TRUE mean %.4f ripple %.4f; plain sine of that mean %.4f'%(T.mean(),pp(T),pp(Tp)))
if __name__=='__main__':
    if sys.argv[1]=='make': log('m4/slow.csv'); log('m4/slow1.csv',rpm=1,turns=2.2,seed=5)
    else: play(sys.argv[2])
