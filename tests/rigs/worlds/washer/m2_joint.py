# Motor 2: robot joint, frameless motor p=10, 24 slots, strain-wave gear 1:100, torque sensor BEHIND the gear; moteus-like CSV, 500 Hz
# torque read as joint torque/100; gear: friction (load dependent), 2/turn and 4/turn of the wave generator (load dependent), sensor cross talk
from lib import *
import sys
p=10
m=Motor(p,[(1,0.08*1.03,0),(5,.0022,0.5),(7,.0016,2.8),(11,.0006,1),(13,.0005,-1)],[(120,.018,.9),(240,.003,-.4),(24,.006,.3),(20,.004,2.2)])
def drive(): return Drive((1.,.985,1.01),(.05,-.04,.0))
ZERO=0.8 # encoder's own zero not used: electrical zero calibrated
def log(name,iq,rpm=30,turns=12,seed=0,direction=1,col_i=True):
    r=np.random.default_rng(seed); dt=.002; t=np.arange(0,turns*60/rpm,dt); thm=.3+direction*t*rpm*tau/60
    th=p*thm; dr=drive(); meas=ipark(0*th,iq+0*th,th); tru=dr.true(meas) if iq else 0*meas
    Tm=m.torque(thm,tru)
    mesh=(.025*abs(Tm)+.012)*np.sin(2*thm+.4)+.006*np.sin(4*thm-1)
    fr=(.05+.08*abs(Tm.mean()))*np.sign(direction)
    out=100*(Tm-fr-mesh)+2.0*np.sin(thm/100+.3)  # sensor's own once per output turn
    # stiffness low pass 60 Hz
    a=1-np.exp(-dt*tau*60); y=np.empty_like(out); s=out[0]
    for k in range(len(out)): s+=a*(out[k]-s); y[k]=s
    y+=r.normal(0,.35,len(y))+1.1
    with open(name,'w') as o:
        o.write('timestamp_us,motor_position_rev,motor_velocity_rev_s,d_A,q_A,joint_torque_Nm,fet_temp_C\n')
        for k in range(len(t)):
            o.write('%d,%.5f,%.4f,%.3f,%.3f,%.2f,%.1f\n'%(5e6+t[k]*1e6,thm[k]/tau,direction*rpm/60+r.normal(0,.002),r.normal(0,.03) if iq else 0,iq+r.normal(0,.03) if iq else 0,y[k],31.2))
def play(folder):
    f,per,txt=load_table(folder); thm=np.linspace(0,tau,96000,endpoint=False); d,q=f(thm)
    for nm,dr in (('sensors as they are',drive()),('perfect sensors',Drive())):
        tru=dr.true(ipark(d,q,p*thm)); T=m.torque(thm,tru); Tp=m.torque(thm,dr.true(ipark(0*thm,T.mean()/(.12*1.03)+0*thm,p*thm)))
        print('%-22s mean %.4f ripple pp %.5f | plain sine mean %.4f pp %.5f | peak A %.2f'%(nm,T.mean(),pp(T),Tp.mean(),pp(Tp),abs(tru).max()))
if __name__=='__main__':
    if sys.argv[1]=='make':
        for n,i,dd in (('f0',0,1),('b0',0,-1),('f4',4,1),('f8',8,1),('f12',12,1),('b8',8,-1)): log('m2/%s.csv'%n,i,seed=abs(hash(n))%1000 if 0 else sum(map(ord,n)),direction=dd)
        log('m2/f8fast.csv',8,rpm=120,turns=24,seed=77)
    else: play(sys.argv[2])
