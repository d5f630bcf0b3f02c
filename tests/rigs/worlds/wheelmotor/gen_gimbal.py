"""gen_gimbal.py NAME rpm turns fs seed mode ; hobby drive: position ramp with PI-D, log of t_ms;angle_deg;vel;Iq_mA"""
import sys,numpy as np
from gen import *
def log(name,segs,fs,seed,wait=1.0,load=0.,brake=0.,scale=1.0,hdr=True,idc=0.0):
    rng=np.random.default_rng(seed); m,s=G,SG
    M=40000; g=np.arange(M)*2*np.pi/M
    cogt=m.cog(g); e0=[0*g,0*g]; 
    coul=m.coul+brake
    kq=(m.em(g,inv(m.p*g,0*g,0*g+1.))-cogt); kd=(m.em(g,inv(m.p*g,0*g+1.,0*g))-cogt)
    dt=2e-4; th=0.37; w=0.; ref=th; integ=0.; out=[]; t=0.; k=0; every=int(round(1/fs/dt)); sub=5; vf=0.; lastm=None
    Kp,Ki,Kd=6.0,30.,.06
    prog=[(0,wait)]
    for rpm,turns in segs: prog+=[(rpm*np.pi/30,abs(turns*60/rpm)),(0,.8)]
    A=np.diag(1+s.g); S_=np.array([[1,0],[-.5,3**.5/2],[-.5,-3**.5/2]]); T_=np.array([[2/3,-1/3,-1/3],[0,1/3**.5,-1/3**.5]])
    Ai=np.linalg.inv(T_@A@S_); b=T_@s.o
    iq=0.
    from math import floor,sin,cos,pi
    for wr,dur in prog:
        for _ in range(int(dur/dt)):
            t+=dt; k+=1; ref+=wr*dt
            if k%sub==1:
                a=th
                for o,am,p_ in s.ecc: a+=am*sin(o*th+p_)
                a=floor((a+rng.normal(0,2e-4))/(2*pi/4096))*(2*pi/4096)
                if lastm is None: lastm=a
                v=(a-lastm)/(sub*dt); lastm=a; vf+=.08*(v-vf)
                er=ref-a; integ=max(-1.5,min(1.5,integ+Ki*er*sub*dt))
                iq=max(-1.8,min(1.8,Kp*er+integ+Kd*(wr-vf)))
                el=m.p*a
            # reference in measured frame -> true
            ra=iq*sin(el)-0*cos(el); rb=iq*sin(el-C); rc=iq*sin(el-2*C)
            al=2/3*(ra-.5*rb-.5*rc)-b[0]; be=(rb-rc)/3**.5-b[1]
            x0=Ai[0,0]*al+Ai[0,1]*be; x1=Ai[1,0]*al+Ai[1,1]*be
            pe=m.p*th; # true dq: ia=iq sin-id cos -> alpha= iq sin - id cos ; beta=-(iq cos+ id sin)  (ib leads -120)
            se,ce=sin(pe),cos(pe)
            iqt=x0*se-x1*ce; idt=-x0*ce-x1*se
            j=int(th/(2*pi)*M)%M
            Te=cogt[j]+kq[j]*iqt+kd[j]*idt
            # friction with sticking
            F=coul*(1 if w>0 else -1 if w<0 else 0)+m.visc*w
            net=Te-load
            if w==0. and abs(net)<coul*1.03: pass
            else:
                if w==0.: F=coul*(1 if net>0 else -1)
                w2=w+(net-F)/m.J*dt
                if w!=0. and w2*w<0 and abs(net)<coul*1.03: w2=0.
                w=w2; th+=w*dt
            if k%every==0: out.append((t,a,vf,iq+rng.normal(0,.012),0+rng.normal(0,.012)))
    o=np.array(out)
    with open(name,'w') as f:
        f.write('# SmartFOC v2.1 monitor\nt [ms];angle [deg];vel [deg/s];Iq [mA];Id [mA]\n')
        for r in o: f.write('%d;%.2f;%.1f;%.0f;%.0f\n'%(r[0]*1e3,np.degrees(r[1]),np.degrees(r[2]),r[3]*1e3,r[4]*1e3))
    return o
if __name__=='__main__':
    o=log('g/slow6_100hz.csv',[(6,2.2)],100,1)
    print(len(o),o[:,3].std(),o[:,3].mean(),o[200:,2].std())
    log('g/slow2_both.csv',[(2,1.2),(-2,1.2)],200,2)
    log('g/slow1_both.csv',[(1,1.2),(-1,1.2)],200,3)
