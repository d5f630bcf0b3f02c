import numpy as np
from motors import *
# turntable, 21 pole pairs, position control slow both ways; drive prints ms,counts,iq at ~100 Hz with integer ms
def run(name,rpm,turns,load=0,seed=0,J=4e-3,per=5,iqload=0):
    r=np.random.default_rng(seed); dt=1/4000; n=int((turns/(rpm/60)*2+1.5)/dt)
    p=21; th=.5; w=0.; integ=0; target=th; iq=0; out=[]; s3=2*np.pi/3
    t=0; half=turns/(rpm/60); ww=rpm*2*np.pi/60; wf=0; lastc=None
    acc=3.
    wref=0; nextp=.0
    for i in range(n):
        t=i*dt
        want=ww if t<half+.5 and t>.5 else (-ww if t>half+1. else 0.)
        if t>2*half+1: want=0
        wref+=np.clip(want-wref,-acc*dt,acc*dt); target+=wref*dt
        cnt=np.floor(th/(2*np.pi)*32768); pos=(cnt+.5)*2*np.pi/32768
        # pos loop with velocity filter
        if lastc is None: lastc=pos
        v=(pos-lastc)/dt; lastc=pos; wf+=(v-wf)*dt/.004
        e=target-pos; integ+=e*dt
        iq=np.clip(40*e/.331*1.+ (.6/.331)*(wref-wf)+ 500*integ/.331*1.,-6,6)
        im=iq
        te=p*th
        T=sum((iq*np.sin(te-k*s3))*sum(a*np.sin(o*(te-k*s3)+g) for o,a,g in hub.emf) for k in range(3))
        T+=sum(a*np.sin(o*th+g) for o,a,g in hub.cog)
        T-=hub.fr*np.tanh(w/.004)+hub.visc*w+load*np.tanh(w/.004)
        w+=T/J*dt; th+=w*dt
        if t>=nextp:
            out.append((int(t*1000),int(cnt),round(im+.008*r.standard_normal(),3)))
            nextp+=per/1000+(0.0007*r.random()-.00035)
    with open(f'm2/{name}.csv','w') as f:
        f.write('ms,encoder_counts,iq\n'); [f.write('%d,%d,%g\n'%x) for x in out]
    a=np.array(out,float); print(name,len(a),a[:,2].min(),a[:,2].max(),(a[:,1].max()-a[:,1].min())/32768)
import sys
for a in sys.argv[1:]:
    if a=='slow2': run('slow2',2,1.15,0,1)
    if a=='slow4': run('slow4',4,1.3,0,2)
    if a=='brake1': run('brake1',2,1.15,.35,3)
    if a=='brake2': run('brake2',2,1.15,.8,4)
