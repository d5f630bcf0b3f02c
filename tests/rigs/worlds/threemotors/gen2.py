"""motor 2: own time-step simulation of gimbal motor under slow speed control; hobby log"""
from mot import *
import os,math
R=np.random.default_rng(22)
J=1.2e-5; 
def run2(fn,rpm_seq,turns,brake=0.0,fs=250,Iset=None,table=None,quiet=False):
    """rpm_seq list of rpm segments; returns log. brake: Nm coulomb of an external brake"""
    dt=1e-4; m=M2; Kt=1.5*7*m.psi
    rows=[]; tm=R.uniform(0,6); w=0.; integ=0.; t=0.; iq=0.; k=0
    p=m.p
    def tq(q,tm):
        te=p*tm; i2=math.sqrt(1+(q/m.Is)**2)
        wd=m.psi*(1-m.kx*(1-1/i2)); wt=0
        for (n,a,ph) in m.hd: wd+=a*math.cos(n*te+ph)
        for (n,a,ph) in m.hq: wt+=n*a*q*math.cos(n*te+ph)
        for (n,a,ph) in m.hs: wt-=n*a*m.Is**2*(i2-1)*math.sin(n*te+ph)
        wd-=m.ua*m.psi*(1+math.cos(2*te))/3; wt+=m.ua*m.psi/3*2*math.cos(2*te)*q
        return 1.5*p*(wd*(1+m.ecc*math.cos(tm+.4))*q+wt)+sum(a*math.sin(n*tm+ph) for n,a,ph in m.cogm)
    step=int(1/fs/dt)
    for rpm in rpm_seq:
        wr=rpm*2*math.pi/60; end=tm+math.copysign(2*math.pi*turns,rpm); tl=0
        while (tm<end) if rpm>0 else (tm>end):
            ref=wr*min(1,tl/.3); e=ref-w; integ+=9*e*dt; q=.35*e+integ+ (0)
            q=max(-4,min(4,q)); iq+= (q-iq)*dt/4e-4
            # true current differs from reading: sensor zero 12 mA, gain +0.9 %
            it=(iq-.012)/1.009
            fr=(.0016+.0007*math.exp(-(w/.6)**2)+brake)*math.tanh(w/.03)+2e-5*w
            a=(tq(it,tm)-fr)/J; w+=a*dt; tm+=w*dt; t+=dt; tl+=dt; k+=1
            if k%step==0: rows.append((t,tm,w,iq))
    x=np.array(rows); x=x[R.random(len(x))>.03]   # 3 % of the rows lost
    n=len(x)
    enc=(np.floor(((x[:,1]+0.0)/(2*np.pi)%1)*16384)/16384*360)
    erpm=x[:,2]*60/2/np.pi*7+R.standard_normal(n)*4
    iq=np.round((x[:,3]+.008*R.standard_normal(n))*1000)
    with open(fn,'w') as f:
        f.write('ms_today;encoder_deg;erpm;current_q_mA;input_voltage\n')
        for i in range(n): f.write('%d;%.2f;%.0f;%d;%.1f\n'%(1000*x[i,0]+43200000,enc[i],erpm[i],iq[i],12.1))
    if not quiet: print(fn,n,'rows, iq mean',x[:,3].mean(),'w std/mean',x[:,2].std())
if __name__=='__main__':
    os.makedirs('m2',exist_ok=True)
    run2('m2/slow.csv',[12,-12],2.1)
