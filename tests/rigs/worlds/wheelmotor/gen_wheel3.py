from gen_wheel import *
import os
os.makedirs('w/slow',exist_ok=True)
for n,iq,r,s,t0 in (('free_f',0,.5,1,0),('free_b',0,-.5,2,300),('load20',20,.5,3,600),('load40',40,.5,4,900),('brake40',-40,.5,5,1200),('load30b',-30,-.5,6,1500)): rec('w/slow/%s.tsv'%n,iq,0,r,2.2,s,t0,fs=80)
