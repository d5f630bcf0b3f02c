# e-bike hub: 23 pole pairs, 51 slots, direct drive. bench, free wheel (no tyre), position control slow, own python logger of a VESC
from sim import *
import sys
rng=np.random.default_rng(11)
K=1.02  # Nm/A peak i_q (Kv ~ 9.36 rpm/V line-line? defined below)
def motor():
    return Motor(23,K,{1:(1,0),3:(.05,0.2),5:(.03,math.pi+.3),7:(.012,.5),11:(.004,0)},
      {46:(.12,.7),51:(.16,-1.1),102:(.05,.4),1:(.02,.3)},zero_e=0.0,coul=.35,visc=.02,J=.06)
if __name__=='__main__':
    m=motor(); dt=1/4000
    T=40
    rpm=6
    w=rpm*TP/60
    def wref(t):
        if t<18: return w*min(1,t/1.0)
        if t<20: return w*(1-(t-18))
        if t<38: return -w
        return -w
    t,th,ws,iq=free_run(m,wref,T,dt,kp=8.0,ki=60.0,kpos=8)
    s=slice(None,None,20) # 200 Hz
    t,th,ws,iq=t[s],th[s],ws[s],iq[s]
    print('speed ripple',ws[(t>3)&(t<17)].std()/w,'turns',th.max()/TP)
    pos=np.round(((th/TP*360)%360)/360*16384)/16384*360
    iqn=iq+rng.normal(0,.03,len(iq))
    erpm=ws*60/TP*23+rng.normal(0,1.5,len(t))
    with open('a_hub/log.txt','w') as f:
        f.write('connected to /dev/ttyACM0, fw 6.02\n')
        f.write('# e-bike hub bench, spin_slow.py\n')
        f.write('tick10ms\tpos_deg\tmotor_current\terpm\tvin\ttemp_mos\n')
        for a,b,c,d in zip(t,pos,iqn,erpm): f.write(f'{int(a*100)}\t{b:.2f}\t{c:.2f}\t{d:.0f}\t47.{int(a)%3+1}\t31.5\n')
