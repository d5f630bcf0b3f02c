import sys, recordG, numpy as np
from recordG import *
from table import load
fo,name=sys.argv[1],sys.argv[2]
# position loop adds its own i_q to the table for no torque (emit --per-torque at 0 is B(theta)): table as lookup
import ctypes,re
f,per,_=load(fo)
x=np.linspace(0,2*np.pi,16384,endpoint=False); d,q=f(x,per); q=q-float(sys.argv[3]) if len(sys.argv)>3 else q
D=d.tolist(); Q=q.tolist()
def tab(xm):
    j=int(round(xm/(2*pi)*16384))%16384; return D[j],Q[j]
kw=dict(kp=30,ki=80) if 'stiff' in name else {}
rpm=5; p,Du=trapez(rpm*2*pi/60,2.2); rows=run(name,p,Du,31,table=tab,**kw)
t=np.array([r[0] for r in rows]); mv=np.abs(np.gradient(np.array([r[5] for r in rows]),t)); m=(t>2)&(t<Du/2-2); print('true speed sd with table',np.std(mv[m])/(rpm*2*np.pi/60))
# second file: iq less the table, as the report says
L=open('G/'+name+'.csv').read().split('\n')
with open('G/'+name+'_less.csv','w') as o:
    o.write(L[0]+'\n')
    for l in L[1:]:
        if not l: continue
        c=l.split(','); dd,qq=tab(float(c[1])*2*pi); c[3]='%.4f'%(float(c[3])-qq); c[4]='%.4f'%(float(c[4])-dd); o.write(','.join(c)+'\n')
