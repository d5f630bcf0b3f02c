import subprocess,os
from gen_servo import *
import gen_servo
from play import *
old=gen_servo.sweep
H='hci-solve'
def go(tag,tau,seed,L,extra):
    def f(*a,**k): k['tau']=tau; return old(*a,**k)
    gen_servo.sweep=f
    d='s/st/%s'%tag; os.makedirs(d,exist_ok=True)
    spec=dict(leer_vor=(0,0,30,1,0),leer_rueck=(0,0,-30,2,60),last07=(7,0,30,3,120),last14=(14,0,30,4,180),last20=(20,0,30,5,240),feld14=(14,-9,30,7,360),last14r=(14,0,-30,8,420))
    fs=[]
    for n in extra:
        iq,idd,rpm,sd,t0=spec[n]; rec(f'{d}/{n}.csv',iq,idd,rpm,6,seed+sd,t0); fs.append(f'{d}/{n}.csv')
    o='out/st_'+tag
    a='--pole-pairs 3 --volt-per-krpm 95 --slots 36 --rated-current 20 --resistance .9'.split()+('--inductance-d 0.005 --inductance-q 0.012'.split() if L else [])
    r=subprocess.run(['nice',H,'tune']+fs+a+['-o',o],capture_output=True,text=True); line=r.stdout.split('\n')[0][:175]
    try:
        t=table(o); cor=corrections(o); th,T,i=run(S,SS,lambda e:look(t,e),cor,w=3.14); print(tag,'rc',r.returncode,'TRUE sensor N.m %.3f'%(pp(T)*1.012),line,flush=True)
    except Exception as e: print(tag,'rc',r.returncode,'no table',line,flush=True)
five=['leer_vor','leer_rueck','last07','last14','last20']
for tau in (.0005,.0012,.0017):
    for seed in (100,200,300): go('A%d_%d'%(tau*1e4,seed),tau,seed,True,five)
for seed in (100,200): go('C_%d'%seed,.0012,seed,True,['leer_vor','last07','last14','last20','feld14'])
for seed in (100,200): go('D_%d'%seed,.0012,seed,True,five+['feld14','last14r'])
