import gen3; from gen3 import *; import math
D=.0003
log3('m3d/idle_f.csv',0,20,drift=D); log3('m3d/idle_r.csv',0,-20,drift=D)
for I in (2,4,6): log3(f'm3d/load{I}.csv',I,20,drift=D)
log3('m3d/n_idle_r5.csv',0,-5,T=120.,drift=D); log3('m3d/n_idle_r20.csv',0,-20,T=30.,drift=D)
log3('m3d/n_lead.csv',math.hypot(3.95,5.77),5,T=120.,ang=math.atan2(3.95,5.77),drift=D)
