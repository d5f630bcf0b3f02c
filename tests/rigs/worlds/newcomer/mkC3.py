from mkC import *
for n,r in (('id0','rpm=30 iq=4 id=0 seed=4'),('idm1','rpm=30 iq=4 id=-1 seed=4')): de(f'C/w_{n}.csv',[sync(sim('T=13 '+r))])
