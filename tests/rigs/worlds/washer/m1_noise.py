# which property makes the false saturation: i_q noise in a steady log. m1 two logs with current noise 0.02 (as is), 0.002
import m1_washer as w, numpy as np, sys, re
src=open('m1_washer.py').read()
for n in ('.002','.005'):
    s=src.replace('r.normal(0,.02,len(t))','r.normal(0,%s,len(t))'%n)
    g={'__name__':'x'}; exec(s,g); g['log']('m1/i4_n%s.csv'%n[1:],4,seed=3)
