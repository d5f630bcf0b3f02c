#!/usr/bin/env python
"""Gimbal / robot joint 24N22P, no torque sensor. Position-controlled slow turns, i_q only, 12-bit magnetic encoder with eccentricity
 (which commutates too), phase current offsets of the drive, Coulomb+Stribeck friction, cable-free shaft.
 usage: gimbal.py log OUT RPM TURNS(forward and back each) [seed] [--oneway] | play waveform.csv | sine IQ"""
import numpy as np, sys
P=11; KV=42.; ke=1/(KV*2*np.pi/60)/np.sqrt(3); KT=1.5*ke; J=4.2e-5
# cogging by mechanical orders: 264 (lcm), 24 (teeth), 22 (magnets), 48, 2 (ovality), 528
COG=[(264,0.0052,.4),(24,0.0021,1.9),(22,0.0026,-.8),(48,0.0007,.2),(44,0.0011,2.5),(528,0.0006,-1.)]
cog=lambda m:sum(a*np.sin(k*m+p) for k,a,p in COG)
def kt(th,ph): # back emf of phase over electrical angle
    x=th-ph*2*np.pi/3
    return ke*(np.sin(x)+0.022*np.sin(5*x+.9)-0.013*np.sin(7*x+.5))
ENC=lambda m: m+np.deg2rad(0.45)*np.sin(m+.7)+np.deg2rad(0.12)*np.sin(2*m-.4)     # true -> read
OA,OB=0.018,-0.011                                                             # A, offsets of the sensors of phases a and b (c = -a-b)
def real_currents(id,iq,the): # the drive makes what it READS equal to the command: real = wanted - offset
    i=[iq*np.sin(the-k*2*np.pi/3)-id*np.cos(the-k*2*np.pi/3) for k in range(3)]
    return [i[0]-OA,i[1]-OB,i[2]+OA+OB]
def motor(i,m): return sum(kt(P*m,k)*i[k] for k in range(3))+cog(m)
N=52800; TH=np.arange(N)*2*np.pi/N
def table(f):
    d=np.genfromtxt(f,delimiter=',',names=True); th=d['theta_e_rad']; per=2*np.pi*max(1,round((th[-1]+th[1])/(2*np.pi)))
    return lambda the:tuple(np.interp(the%per,np.r_[th,per],np.r_[d[c],d[c][0]]) for c in ('id_A','iq_A'))
def ripple(T,l):
    f=np.fft.rfft(T)/len(T); big=np.argsort(-np.abs(f[1:]))[:7]+1; h=f.copy(); h[P*60+1:]=0
    print(f"{l}: mean {T.mean():.5f} ripple ptp {np.ptp(T):.5f} (<=60 {np.ptp(np.fft.irfft(h*len(T),len(T))):.5f}) Nm; ",[(round(k/P,3),round(2*abs(f[k]),5)) for k in big])
if __name__=='__main__':
    a=sys.argv
    q=lambda m:np.floor((ENC(m)+0.31)/(2*np.pi)*4096)/4096*2*np.pi             # counts as angle; encoder zero 0.31 rad
    if a[1]=='play':   # --corr "s1,c1,s2,c2": what the tool says is subtracted from the mechanical angle as read
        rd=ENC(TH)+0.31
        if '--corr' in a:
            c=[float(x) for x in a[a.index('--corr')+1].split(',')]; rd=rd-(c[0]*np.sin(rd)+c[1]*np.cos(rd)+c[2]*np.sin(2*rd)+c[3]*np.cos(2*rd))
        el=P*(rd-0.31); lg=P*rd; id,iq=table(a[2])(lg); ripple(motor(real_currents(id,iq,el),TH),'table'); print('  iq',iq.mean(),'peak',np.hypot(id,iq).max())
    elif a[1]=='sine': ripple(motor(real_currents(0*TH,float(a[2])+0*TH,P*ENC(TH)),TH),'sine')
    elif a[1]=='info': print('KT',KT); ripple(cog(TH),'cog')
    else:
        out,RPM,TURNS=a[2],float(a[3]),float(a[4]); seed=int(a[5]) if len(a)>5 and a[5].isdigit() else 1
        one='--oneway' in a; BR=float(a[a.index('--brake')+1]) if '--brake' in a else 0.; tf=None
        if '--table' in a:
            tg=table(a[a.index('--table')+1]); XX=np.arange(65536)/65536*2*np.pi; tf=tg(P*XX)[1]-float(a[a.index('--mean')+1] if '--mean' in a else tg(P*XX)[1].mean()); tf=tf.tolist()
        r=np.random.default_rng(seed); w0=RPM*2*np.pi/60; dt=1e-4; fs=250; sub=40
        T1=TURNS*2*np.pi/w0; n=int((T1*(1 if one else 2)+1.0)/dt); 
        m=0.2;w=0.;rows=[];I=0.; iq=0.; wf=0; 
        import math
        sin=math.sin
        el=lambda m:m+0.007853981633974483*sin(m+.7)+0.0020943951023931954*sin(2*m-.4)
        ref=0.; start=el(m); t=0; noise=r.normal(0,.006,n//sub+2); fr=0
        for k in range(n):
            t=k*dt
            # trapezoid reference
            if t<0.3: ref=0
            elif t<0.3+T1: ref=w0*(t-.3)
            elif t<0.5+T1: ref=w0*T1
            elif not one: ref=max(0,w0*T1-w0*(t-.5-T1))
            if k%10==0:    # 1 kHz position loop on the quantised encoder
                enc=math.floor((el(m)+0.31)/6.283185307179586*4096)/4096*6.283185307179586-0.31
                e=ref+start-enc
                I+=e*.001*14.; I=max(-.5,min(.5,I)); d=(enc-(prev if k else enc))/.001; prev=enc; wf+=.06*(d-wf)
                wr=(w0 if .3<t<.3+T1 else (-w0 if (t>.5+T1 and ref>0) else 0))
                iq=ctl=max(-1.2,min(1.2,2.6*e+I+.11*(wr-wf)))
            if tf: iq=ctl+tf[int((el(m)+0.31)/6.283185307179586*65536)%65536]
            x=11*el(m); ii=[iq*sin(x)-OA,iq*sin(x-2.0943951)-OB]; ii.append(-ii[0]-ii[1])
            th=11*m
            T=0
            for p in (0,1,2):
                y=th-p*2.0943951023931953; T+=ke*(sin(y)+.022*sin(5*y+.9)-.013*sin(7*y+.5))*ii[p]
            for kk,aa,pp in COG: T+=aa*sin(kk*m+pp)
            fc=0.0042+0.0016*math.exp(-(w/.25)**2)
            T-=BR*math.tanh(w/.004); T-=fc*math.tanh(w/.004)+2e-4*w
            w+=T/J*dt; m+=w*dt
            if k%sub==0:
                cnt=int(math.floor((el(m)+0.31)/6.283185307179586*4096))%4096
                rows.append(f"{round(t*1000)};{cnt};{((ctl if '--ctl' in a else iq)+noise[k//sub])*1000:.0f};{math.degrees(ref):.2f}")
        open(out,'w').write('tick_ms;enc_raw;i_torque_mA;setpoint_deg\n'+'\n'.join(rows)+'\n'); print(out,len(rows))
