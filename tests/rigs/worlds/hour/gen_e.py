# same motor as d, spun by a cordless drill, three line voltages on a Rigol, no angle; speed wavers
from sim import *
from gen_d import motor
rng=np.random.default_rng(9)
m=motor(); fs=50000; t=np.arange(-.06,.06,1/fs)
w=900*TP/60*(1+.02*np.sin(TP*9*t)); th=np.cumsum(w)/fs; the=m.pp*th+.4
e=[m.shape(the-k*TP/3)*w for k in range(3)]
L=[e[0]-e[1],e[1]-e[2],e[2]-e[0]]
q=20/200
L=[np.round((x+rng.normal(0,.03,len(t)))/q)*q for x in L]
with open('e_scope/RigolDS0.csv','w') as f:
    f.write('X,CH1,CH2,CH3,Start,Increment,\nSequence,Volt,Volt,Volt,-6.000000e-02,2.000000e-05\n')
    for k in range(len(t)): f.write(f'{k},{L[0][k]:.2e},{L[1][k]:.2e},{L[2][k]:.2e},,\n')
with open('e_scope/siglent.csv','w') as f:
    f.write('Record Length,Analog:6000\nSample Interval,Analog:0.00002\nModel Number,SDS1104X-E\nSource,CH1,CH2,CH3\nSecond,Volt,Volt,Volt\n')
    for k in range(len(t)): f.write(f'{t[k]:.8f},{L[0][k]:.4f},{L[1][k]:.4f},{L[2][k]:.4f}\n')
