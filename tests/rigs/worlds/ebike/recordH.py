import numpy as np, sys
from motors import *
h=H()
def run(name, q, rpm, dur, seed, cur=None, gainT=1.012, offT=-.25, tau=.003, out='H'):
    r=np.random.default_rng(seed); fs=2000; n=int(dur*fs); t=np.arange(n)/fs
    w=rpm*2*np.pi/60*(1+.012*sin(2*pi*.31*t+r.uniform(0,6))+.004*sin(2*pi*1.7*t))
    thm=r.uniform(0,6.28)+np.cumsum(w)/fs
    if cur is None: dm,qm=np.zeros(n),np.full(n,q)+.05*np.sin(2*pi*.2*t)*(q!=0)
    else: dm,qm=cur(h.angle_read(thm))
    if q==0 and cur is None: d,qq=np.zeros(n),np.zeros(n)   # gate off
    else: d,qq=sensors_H(h,thm,dm,qm)
    T=h.torque(thm,d,qq); Ts=T-h.Tc*np.sign(w)-h.B*w
    y=np.empty(n); a=1/(fs*tau); y0=Ts[0]
    for k in range(n): y0+=min(1,a)*(Ts[k]-y0); y[k]=y0
    # CAN: torque id 100 Hz, drive position/speed 100 Hz, currents 50 Hz, all with their own phase and jitter
    def msg(per,ph,vals):
        tt=np.arange(ph,dur-.01,per)+r.normal(0,.0003,len(np.arange(ph,dur-.01,per))); tt=np.abs(tt); k=(tt*fs).astype(int)
        return tt,[v[k] for v in vals]
    pos=np.degrees(h.angle_read(thm))%360
    t1,(y1,)=msg(.01,.0021,[np.round((y*gainT+offT+r.normal(0,.06,n))/.02)*.02])
    t2,(p2,w2)=msg(.01,.0063,[np.floor(pos/.1)*.1,np.round(w*60/2/pi/.1)*.1])
    t3,(i3,d3)=msg(.02,.0008,[np.round((qm+r.normal(0,.15,n)*(q!=0 or cur is not None))/.1)*.1,np.round((dm+r.normal(0,.15,n)*(q!=0 or cur is not None))/.1)*.1])
    rows=[(a,'T',f'{b:.2f}') for a,b in zip(t1,y1)]+[(a,'P',f'{b:.1f}',f'{c:.1f}') for a,b,c in zip(t2,p2,w2)]+[(a,'I',f'{b:.1f}',f'{c:.1f}') for a,b,c in zip(t3,i3,d3)]
    rows.sort(key=lambda x:x[0]); C=lambda s:s.replace('.',',')
    head='Zeit [s];Drehmoment [Nm];Rotorlage [°];Drehzahl [1/min];Iq [A];Id [A]\n'
    last=['','','','','']
    with open(f'{out}/{name}_async.csv','w') as f, open(f'{out}/{name}.csv','w') as g:
        f.write(head); g.write(head)
        for x in rows:
            c=['']*5
            if x[1]=='T': c[0]=C(x[2])
            if x[1]=='P': c[1],c[2]=C(x[2]),C(x[3])
            if x[1]=='I': c[3],c[4]=C(x[2]),C(x[3])
            f.write(C(f'{x[0]:.4f}')+';'+';'.join(c)+'\n')
            last=[b or a for a,b in zip(last,c)]
            if x[1]=='P' and all(last): g.write(C(f'{x[0]:.4f}')+';'+';'.join(last)+'\n')   # "hold last value" export at the raster of the drive
if __name__=='__main__':
    run('leer_vor',0,6,45,1); run('leer_rueck',0,-6,45,2)
    run('last10',10,6,45,3); run('last20',20,6,45,4); run('last30',30,6,45,5)
    run('last20_12rpm',20,12,30,6)
