# VESC-tool-like log: slow speed loop forward and back
from sim import *
def run(rpm,turns,load=0,seed=1,table=None,fs=5000,log=100,kp=0.12,ki=1.6,ecc=np.deg2rad(0.12),off=np.deg2rad(137.3),bothways=True,loads=None):
    r=R(seed); m=A; p=m.p; dt=1/fs; rows=[]; th=0.3; w=0.; I=0.; t=0.; k=0
    segs=[(rpm,turns),(-rpm,turns)] if bothways else [(rpm,turns)]
    s3=2*np.pi/3
    import math
    sn=math.sin
    iqm=0
    for wr,n in segs:
        wr=wr*math.pi/30; th0=th; T=n*2*math.pi/abs(wr); kk=int(T*fs)
        for j in range(kk):
            e=wr-w; I+=ki*e*dt; I=max(-20,min(20,I)); iq=kp*e+I; iq=max(-20,min(20,iq)); idd=0.
            te=p*th
            if table is not None:
                a=((th+ecc*sn(th+0.5)+off)%(2*math.pi)); ti,td=table(a); iq+=ti; idd+=td
            ia=iq*sn(te)-idd*math.cos(te); ib=iq*sn(te-s3)-idd*math.cos(te-s3); ic=-ia-ib
            Te=0
            for x,i in ((te,ia),(te-s3,ib),(te+s3,ic)):
                v=sn(x)
                for nn,AA,g in m.emf: v+=AA*sn(nn*x+g)
                Te+=m.ke*v*i
            for nn,AA,g in m.cog: Te+=AA*sn(nn*th+g)
            ext=load*math.copysign(1,wr)
            fr=m.fric*math.tanh(w/0.02)+m.visc*w
            acc=(Te-fr-ext)/m.J; w+=acc*dt; th+=w*dt; t+=dt
            if k%(fs//log)==0:
                rows.append((t,th,w,iq,idd))
            k+=1
    a=np.array(rows)
    encm=(a[:,1]+ecc*np.sin(a[:,1]+0.5)+off)
    enc=np.floor(np.mod(np.degrees(encm),360)/360*16384)*360/16384
    iqn=a[:,3]+r.normal(0,0.04,len(a)); idn=a[:,4]+r.normal(0,.04,len(a))
    return a,enc,iqn,idn
def write(fn,a,enc,iqn,idn,t0=40000000):
    with open(fn,'w') as f:
        f.write('ms_today;input_voltage;temp_mos_max;temp_motor;current_motor;current_in;d_axis_current;q_axis_current;erpm;duty_cycle;amp_hours_used;encoder_position;fault;vq;vd\n')
        for k in range(len(a)):
            f.write('%d;24.1;29.8;31.2;%.4f;%.4f;%.4f;%.4f;%.2f;%.4f;0.0;%.4f;0;0;0\n'%(t0+round(a[k,0]*1000),np.hypot(iqn[k],idn[k]),.05,idn[k],iqn[k],a[k,2]*30/np.pi*7,.02,enc[k]))
if __name__=='__main__':
    a,e,q,d=run(6,2.2); print('speed std',a[500:,2].std(), 'min max iq',q.min(),q.max()); write('a_log.csv',a,e,q,d)
