from a1 import *
# ODrive-like tool log; position in turns; 2 logs at brake; sign of iq right; wrapped? no
def w(fn,a,e,q,d):
    with open(fn,'w') as f:
        f.write('timestamp,axis0.pos_vel_mapper.pos_rel,axis0.pos_vel_mapper.vel,axis0.motor.foc.Id_measured,axis0.motor.foc.Iq_measured,axis0.motor.torque_estimate\n')
        un=np.unwrap(np.radians(e))/(2*np.pi)
        for k in range(len(a)): f.write('%.3f,%.6f,%.5f,%.4f,%.4f,%.5f\n'%(1700000000+a[k,0],un[k],a[k,2]/6.28318,d[k],q[k],q[k]*.0435))
w('od1.csv',*run(6,2.2,kp=1.2,ki=60)); w('od2.csv',*run(6,2.2,load=.05,kp=1.2,ki=60,seed=8)); w('od3.csv',*run(3,2.2,load=.05,kp=1.2,ki=60,seed=9))
