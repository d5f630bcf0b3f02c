import sys,numpy as np,math
import m2,play
n=9600; th=np.arange(n)*2*math.pi/n; r=m2.res(th)
def abc(te,d,q): return np.array([q*np.sin(te-2*math.pi/3*s)-d*np.cos(te-2*math.pi/3*s) for s in range(3)])
def drive(w,offs,gain):
    i=np.array([(w[k]*gain[k]+offs[k]-m2.OFF[k])/m2.GAIN[k] for k in range(3)]); return i-i.mean(0)
for f in sys.argv[1:]:
    te,d,q,offs,gain=play.table(f,r,m2.P,False); w=abc(te,d,q)
    T=m2.torque(th,drive(w,(0,0,0),(1,1,1))); Ti=m2.torque(th,abc(m2.P*th+te.mean()*0+(math.radians(play.info(f)[1]) +m2.ANG),d,q))
    te0=m2.P*th
    S=m2.torque(th,abc(te0,0*q,0*q+q.mean()))
    tec,dc,qc,offs,gain=play.table(f,r,m2.P,True)
    T2=m2.torque(th,drive(abc(tec,dc,qc),offs,gain))
    print(f,'as is pp %.4f mean %.4f | corrected pp %.4f mean %.4f | sine(ideal) pp %.4f mean %.4f | shaft mean less friction %.3f'%(play.pp(T),T.mean(),play.pp(T2),T2.mean(),play.pp(S),S.mean(),T2.mean()-m2.TC))
