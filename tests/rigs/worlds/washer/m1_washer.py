# Motor 1: washing-machine direct drive, 36 slots, 48 ferrite poles, ONE magnet worn (70 %): drum braked by a particle brake,
# stator on a 300 mm lever with a load cell (kg), PLC trend export in German (semicolon, decimal comma, clock times), 100 Hz
# sheet: p=24, Kv 1.84 rpm/V, 36 slots, rated 6 A peak
from lib import *
import sys
rng=np.random.default_rng(1)
p=24
class Washer(Motor):
    def e(s,thm):
        th=p*thm; out=[]
        for k in range(3):
            # 12 coils of phase k every 1/12 turn, beginning at slot k: weak magnet passes each
            x=((thm*12/tau - k*12/36)%1); w=np.exp(-((x-0.4)/0.12)**2)  # window 1/48 turn wide
            out.append(har(th-k*tau/3,s.emf)*(1-0.30/12*w))
        return np.array(out)
m=Washer(p,[(1,3.0*0.97,0),(5,0.045,0.3),(7,0.03,2.6),(11,.012,1.)],[(144,0.35,0.7),(288,0.06,-1),(36,0.11,0.4),(72,0.05,2.),(108,0.03,-.6),(1,0.02,1.)])
ZERO=0.0
def drive(): return Drive((1.0,1.012,0.991),(0.03,-0.02,0.0))
def log(name,iq,rpm=2.,turns=2.2,seed=0,both=True,drift=0.01,id_=0.):
    r=np.random.default_rng(seed); dt=0.01; T=turns*60/rpm; t=np.arange(0,T,dt)
    thm=1.1+t*rpm*tau/60
    if both: thm=np.concatenate([thm,thm[::-1]]); t=np.arange(len(thm))*dt
    d=drive(); th=p*thm
    meas=ipark(id_+0*th,iq+0*th,th)
    if iq==0: tru=0*meas
    else: tru=d.true(meas)
    tq=m.torque(thm,tru)
    kg=tq/0.3/9.80665+0.15/9.80665/0.3+drift*t/t[-1]+r.normal(0,.01,len(t)) # 0.15 Nm tare + drift
    kg=np.round(kg/0.002)*0.002
    im,dm=iq+r.normal(0,.02,len(t)),id_+r.normal(0,.02,len(t))
    if iq==0: im,dm=0*t,0*t
    ang=np.degrees(thm)%360
    w=np.gradient(thm,dt)*60/tau
    f=lambda v,n:('%.*f'%(n,v)).replace('.',',')
    with open(name,'w',encoding='cp1252') as o:
        o.write('Trend-Export;Anlage WM07\nZeit;Winkel [Grad];Drehzahl [U/min];Id [A];Iq [A];Last [kg]\n')
        for k in range(len(t)):
            s=36000+t[k]; o.write('%02d:%02d:%s;%s;%s;%s;%s;%s\n'%(s//3600,s%3600//60,f(s%60,2).zfill(5),f(ang[k],2),f(w[k],2),f(dm[k],3),f(im[k],3),f(kg[k],3)))
def play(folder,off=(0,0,0),gain=(1,1,1)):
    """corrected: dict off,gain removed by the drive"""
    f,per,txt=load_table(folder)
    thm=np.linspace(0,tau,96000,endpoint=False); d,q=f(thm)
    g,o=np.array((1.0,1.012,0.991)),np.array((0.03,-0.02,0.0))
    cor=Drive(g/np.array(gain),(o-np.array(off))/np.array(gain))
    for nm,dr in (('sensors as they are',drive()),('corrected as asked',cor),('perfect sensors',Drive())):
        tru=dr.true(ipark(d,q,p*thm)); T=m.torque(thm,tru); 
        iq=(T.mean()/4.5/0.97); Tp=m.torque(thm,dr.true(ipark(0*thm,iq+0*thm,p*thm)))
        print('%-22s mean %.3f ripple pp %.4f | plain sine mean %.3f pp %.4f | peak A %.2f'%(nm,T.mean(),pp(T),Tp.mean(),pp(Tp),abs(tru).max()))
if __name__=='__main__':
    if sys.argv[1]=='make':
        log('m1/leer.csv',0,seed=1); log('m1/i2.csv',2,seed=2); log('m1/i4.csv',4,seed=3); log('m1/i6.csv',6,seed=4); log('m1/i4r.csv',-4,seed=5)
    else: play(sys.argv[2],*[tuple(float(v) for v in a.split(',')) for a in sys.argv[3:]])
