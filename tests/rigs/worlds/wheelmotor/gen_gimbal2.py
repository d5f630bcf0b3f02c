from gen_gimbal import *
log('g/brake12_both.csv',[(2,1.2),(-2,1.2)],200,11,brake=.12)
log('g/brake25_both.csv',[(2,1.2),(-2,1.2)],200,12,brake=.25)
log('g/brake25_fw.csv',[(2,1.2)],200,13,brake=.25)
log('g/slow2_seed.csv',[(2,1.2),(-2,1.2)],200,22)
# scope: lines voltages of the open machine at 200 rpm, no angle
import numpy as np
rng=np.random.default_rng(4); n=8000; t=np.arange(n)/20000; w=200*np.pi/30; th=w*t+.003*np.sin(w*t)
h=1e-6
e=[(b-a)/(2*h)*w for a,b in zip(G.lam(th-h),G.lam(th+h))]
ab,bc=e[0]-e[1],e[1]-e[2]
with open('g/scope.csv','w') as f:
    f.write('Model,XDS\nTime,CH1,CH2\ns,V,V\n')
    for k in range(n): f.write('%.5f,%.3f,%.3f\n'%(t[k],ab[k]+rng.normal(0,.05),bc[k]+rng.normal(0,.05)))
