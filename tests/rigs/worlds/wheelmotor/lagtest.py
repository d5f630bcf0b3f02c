import subprocess,json,re
from gen_servo import *
import gen_servo
from play import *
old=gen_servo.sweep
for tau in (.0008,.0012,.0017):
  for seed in (0,50,90):
    def f(*a,**k): k['tau']=tau; return old(*a,**k)
    gen_servo.sweep=f
    d='s/lt/%d_%d'%(tau*1e4,seed)
    import os; os.makedirs(d,exist_ok=True)
    rec(d+'/leer_rueck.csv',0,0,-30,6,seed+2,60)
    for n,iq,s_,t0 in (('last07',7,3,120),('last14',14,4,180),('last20',20,5,240)): rec(d+'/%s.csv'%n,iq,0,30,6,seed+s_,t0)
    o='out/lt_%d_%d'%(tau*1e4,seed)
    r=subprocess.run(['hci-solve','tune',d+'/leer_rueck.csv',d+'/last07.csv',d+'/last14.csv',d+'/last20.csv']+'--pole-pairs 3 --volt-per-krpm 95 --slots 36 --rated-current 20 --resistance .9 -o'.split()+[o],capture_output=True,text=True)
    line=r.stdout.split('\n')[0][:230]
    try:
        t=table(o); cor=corrections(o); th,T,i=run(S,SS,lambda e:look(t,e),cor,w=3.14)
        print(tau,seed,'rc',r.returncode,'TRUE %.3f (x1.012 %.3f)'%(pp(T),pp(T)*1.012),line,flush=True)
    except Exception as e: print(tau,seed,'rc',r.returncode,'no table',line,flush=True)
