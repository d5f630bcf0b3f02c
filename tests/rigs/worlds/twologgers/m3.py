import numpy as np
from motors import *
def run(name,I,ang,rpm,dur=4):
    d,q=-I*np.sin(ang),I*np.cos(ang); w=rpm*2*np.pi/60; t=np.arange(0,dur,1/2000); thm=1.+w*t
    thenc=S3.angle(thm); th=4*thm
    tr=S3.true(dq2abc(d+0*t,q+0*t,4*thenc)) if I else [0*t]*3
    D,Q=abc2dq(*tr,th); T=ipm.torque_em(th,D,Q)+.02*np.sin(thm+1)*0+.05*np.sin(24/4*thm*0+0)*0
    T=T-.06*np.sign(w)-.002*w
    Tl=1.005*T+.02+.012*rng.standard_normal(t.size)
    m=S3.meas(tr,.02); cnt=np.floor(thenc/2/np.pi*16384)
    with open(f'm3/{name}.csv','w') as f:
        f.write('time_s;theta_m_deg;Ia [A];Ib [A];Ic [A];n [rpm];M [Nm]\n')
        for i in range(t.size): f.write((f'{t[i]:.4f};{cnt[i]*360/16384%360:.3f};{m[0][i]:.3f};{m[1][i]:.3f};{m[2][i]:.3f};{rpm:.1f};{Tl[i]:.4f}\n').replace('.',','))
import sys
for a in sys.argv[1:]:
    n,I,ang,rpm=a.split(':'); run(n,float(I),float(ang),float(rpm))
