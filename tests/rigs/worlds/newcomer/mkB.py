import subprocess,numpy as np,io,os
B="motor=1 free=1 rpm=8 T=24 turns=1.2 inoise=0.04 counts=16384 velkp=0.015 velki=2 poskp=10 velbw=600 bw=1000 e1=0.006 e2=0.002 ga=0.01 gb=-0.01 oa=0.05 ob=-0.03 "
def sim(args,exe='./sim'):
    o=subprocess.run([exe]+B.split()+args.split(),capture_output=True,text=True,check=True).stdout
    n=o[:o.index('\n')].split(',');a=np.loadtxt(io.StringIO(o),delimiter=',',skiprows=1)
    return {k:a[:,i] for i,k in enumerate(n)}
rng=np.random.default_rng(1)
def odrive(f,a,rate=500,sign=1):
    # host script polling over USB: ~rate, jitter, stamps from time.time() rounded to ms
    t=a['t'];n=int(t[-1]*rate);ti=np.sort(np.arange(n)/rate+rng.uniform(0,0.4/rate,n));k=np.searchsorted(t,ti).clip(0,len(t)-1)
    lag=np.searchsorted(t,(ti-0.0005).clip(0)).clip(0,len(t)-1)
    with open(f,'w') as g:
        g.write('timestamp,axis0.encoder.pos_estimate,axis0.encoder.vel_estimate,axis0.motor.current_control.Iq_measured\n')
        for x,i,j in zip(ti,k,lag): g.write('%.3f,%.6f,%.4f,%.4f\n'%(1764400000+x,a['menc'][i]/2/np.pi,a['vest'][i]/2/np.pi if 'vest' in a else a['rpm'][i]/60,sign*a['iq'][j]))
def simplefoc(f,a,rate=1000,header=False,wrap=False):
    t=a['t'];k=np.arange(0,len(t),int(round(1/(t[1]-t[0])/rate)))
    with open(f,'w') as g:
        if header: g.write('t_ms\ttarget\tvoltage_q\tcurrent_q\tcurrent_d\tvelocity\tangle\n')
        for i in k: 
            r=['%d'%(t[i]*1000)] if header else []
            g.write('\t'.join(r+['%.4f'%0,'%.4f'%0.1,'%.4f'%(a['iq'][i]*1000),'%.4f'%(a['id'][i]*1000),'%.4f'%(a['rpm'][i]*np.pi/30),'%.4f'%a['menc'][i]])+'\n')
if __name__=='__main__':
    a=sim('seed=1');odrive('B/slow.csv',a);odrive('B/slow_neg.csv',a,sign=-1)
    simplefoc('B/sf_nohead.txt',a);simplefoc('B/sf_head.txt',a,header=True)
    b=sim('seed=2');odrive('B/slow2.csv',b)
    k=a['t']<11.2;odrive('B/oneway.csv',{x:y[k] for x,y in a.items()})
    odrive('B/hobby.csv',sim('velkp=0.008 velki=0.8 poskp=10 velbw=400 seed=3'))
    odrive('B/bad.csv',sim('velkp=0.004 velki=0.08 poskp=12 velbw=160 seed=3'))
    odrive('B/fast.csv',sim('rpm=60 T=8 turns=3 acc=20 seed=4'))
    odrive('B/zero20.csv',sim('zero=20 seed=5'))
    odrive('B/weight.csv',sim('weight=0.003 seed=6'))
    odrive('B/r100.csv',a,rate=100)
