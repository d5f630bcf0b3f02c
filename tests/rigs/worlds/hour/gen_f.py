# robot joint motor 14 pole pairs 24 slots; ODrive python logger, key=value; and TwinCAT scope csv with two sample times; and STM32 motor pilot like
from sim import *
rng=np.random.default_rng(21)
K=.115
def motor():
    return Motor(14,K,{1:(1,0),5:(.015,.4),7:(.008,2)},{168:(.012,.3),24:(.007,1.),28:(.006,-2.)},zero_e=math.radians(0),coul=.02,visc=1e-3,J=4e-4)
if __name__=='__main__':
    import os; os.makedirs('f_joint',exist_ok=True)
    m=motor(); w=10*TP/60
    def wref(t): return w if t<14 else -w
    t,th,ws,iq=free_run(m,wref,28,1/5000,kp=.6,ki=8,kpos=12)
    print('ripple',ws[(t>3)&(t<13)].std()/w)
    s=slice(None,None,25); t,th,ws,iq=t[s],th[s],ws[s],iq[s]
    p=np.round(th/TP*16384)/16384; q=iq+rng.normal(0,.03,len(t)); v=ws/TP+rng.normal(0,.01,len(t))
    with open('f_joint/odrive_kv.txt','w') as f:
        for k in range(len(t)): f.write(f'[{1740000000+t[k]:.3f}] axis0 pos={p[k]:.5f} vel={v[k]:.4f} Iq={q[k]:.3f} vbus=24.1\n')
    with open('f_joint/odrive.csv','w') as f:
        f.write('unix,axis0.encoder.pos_estimate,axis0.encoder.vel_estimate,axis0.motor.current_control.Iq_setpoint,axis0.motor.current_control.Iq_measured,vbus_voltage\n')
        for k in range(len(t)): f.write(f'{1740000000+t[k]:.3f},{p[k]:.5f},{v[k]:.4f},{iq[k]:.3f},{q[k]:.3f},24.1\n')
    # ST Motor Pilot: timestamp; int16 digits
    with open('f_joint/motorpilot.csv','w') as f:
        f.write('Timestamp;Mechanical Angle (s16degree);I_Q (s16A);I_D (s16A);SPEED_MEAS (u/min)\n')
        for k in range(len(t)): f.write(f'{t[k]*1000:.1f};{((int(th[k]/TP*65536)+32768)%65536)-32768};{int(q[k]/20*32767)};{int(rng.normal(0,40))};{ws[k]*60/TP:.0f}\n')
    # firmware fixed point: mA, angle in 0.1 deg, csv with decimal comma & quotes (LibreOffice German)
    with open('f_joint/libre.csv','w') as f:
        f.write('"Zeit (ms)";"Rotorlage mechanisch (0,1°)";"Iq (mA)"\n')
        for k in range(len(t)): f.write(f'"{t[k]*1000:.1f}";{int((th[k]/TP*3600)%3600)};{q[k]*1000:.0f}\n'.replace('.',','))
