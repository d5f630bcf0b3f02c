# gimbal motor, 7 pole pairs 12 slots, SimpleFOC voltage mode: no current sensing, monitor prints target, Uq, velocity, angle
from sim import *
rng=np.random.default_rng(3)
K=0.082; R=5.6
def motor():
    return Motor(7,K,{1:(1,0),5:(.02,.2),7:(.01,1)},{84:(.0022,.5),12:(.0011,-.7),14:(.0006,1.1)},zero_e=0,coul=.0016,visc=2e-5,J=2.5e-5)
def sense(th): return th+math.radians(.6)*np.sin(th+.4)
if __name__=='__main__':
    m=motor(); w=1.0
    wref=lambda t: w if t<15 else -w
    t,th,ws,iq=free_run(m,wref,30,1/5000,kp=.15,ki=6,kpos=10)
    print('ripple speed',ws[(t>3)&(t<14)].std()/w,'turns',th.max()/TP)
    s=slice(None,None,50) # 100 Hz
    t,th,ws,iq=t[s],th[s],ws[s],iq[s]
    thm=th+math.radians(.6)*np.sin(th+.4)     # AS5600 eccentric
    thm=np.round(thm/TP*4096)/4096*TP
    U=R*iq+K/1.5*ws
    vel=np.gradient(thm,t); 
    for i in range(1,len(vel)): vel[i]=.7*vel[i-1]+.3*vel[i]
    with open('c_gimbal/putty.log','w') as f:
        f.write('=~=~=~=~=~= PuTTY log 2026.03.02 19:11:45 =~=~=~=~=~=\nMOT: Monitor enabled!\nMOT: Init\nMOT: Enable driver.\nMOT: Align sensor.\nMOT: sensor_direction==CW\nMOT: PP check: OK!\nMOT: Zero elec. angle: 3.92\nMOT: No current sense.\nMOT: Ready.\n')
        for a,b,c,d in zip(t,th,ws,U): pass
        for k in range(len(t)): f.write(f'{wref(t[k]):.4f}\t{U[k]:.4f}\t0.0000\t{vel[k]:.4f}\t{thm[k]:.4f}\n')
