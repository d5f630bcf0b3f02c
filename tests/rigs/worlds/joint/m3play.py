import sys; sys.path.insert(0,'py')
import m3smooth as m3,play,numpy as np,math
a=0.167; f='o/m3_fe_bench'; rng=np.random.default_rng(4)
fs=2000; rpm=60; n=8*fs; t=np.arange(n)/fs; thm=rpm*math.pi/30*t+.9
te,d,q,_,_=play.table(f,thm,3,True)   # table read at the corrected angle
y=m3.T(d,q,3*thm,1.0)-.25+.15+rng.normal(0,.06,n)
print('true mean air gap',m3.T(d,q,3*thm,1.0).mean())
with open('m3sm/played.csv','w') as o:
    o.write('time_s,theta_m_deg,id_A,iq_A,torque_Nm,speed_rpm\n')
    for k in range(n): o.write('%.5f,%.3f,%.3f,%.3f,%.4f,%.2f\n'%(t[k],np.degrees(thm[k])%360,d[k]+rng.normal(0,.1),q[k]+rng.normal(0,.1),y[k],rpm))
open('m3sm/pl.csv','w').write('file,role\nplayed.csv,fit\n')
