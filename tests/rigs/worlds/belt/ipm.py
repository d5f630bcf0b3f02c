#!/usr/bin/env python
"""Interior magnets, 3 pole pairs, 36 slots, saturating q axis, static magnetic co-energy W(id,iq,theta_e), eccentric rotor.
 logs: oscilloscope export (long header, units row, comma), three current probes, that of phase b 2 % too high, torque transducer 500 Hz, encoder ramp.
 usage: ipm.py log OUT ID IQ RPM TURNS [seed] [--table waveform.csv] | open OUT RPM TURNS | play waveform.csv | sine ID IQ"""
import numpy as np, sys
P=3; LM=0.118; LD=4.1e-3; LQ0=13.5e-3; ISQ=14.0
# W per pole pair in SI (amplitude invariant: factor 1.5), fluxes from derivatives; theta electrical
def parts(id,iq,th):
    u=id/10; v=iq/10
    # base: magnets, d linear, q saturating with cross saturation by id
    s=ISQ*(1-0.02*u)                                    # id<0 unsaturates the bridge: later knee
    g=np.log(np.cosh(iq/s)); 
    W0=LM*id+.5*LD*id**2+ (LQ0-4.4e-3)*s**2*g+.5*4.4e-3*iq**2
    h=np.tanh
    a6= 6.0e-3*u-3.4e-3*v**2/np.sqrt(1+.6*v**2)-1.3e-3*u*v**2/(1+.4*v**2)
    b6= 9.0e-3*h(.8*v)+3.0e-3*u*h(.9*v)
    a12=3.2e-3*u+2.1e-3*v**2/np.sqrt(1+.5*v**2)
    b12=-2.6e-3*h(.7*v)-1.2e-3*u*v/(1+.3*v**2)
    a18=-0.5e-3*u; b18=0.6e-3*v/(1+.2*v**2)
    return W0,a6,b6,a12,b12,a18,b18
def W(id,iq,th):
    W0,a6,b6,a12,b12,a18,b18=parts(id,iq,th)
    cg=0.0105*np.cos(12*th+.7)+0.0009*np.cos(24*th)-0.002*np.cos(6*th+.3)   # no load
    ecc=1+0.012*np.cos(th/3+.9)                         # static+dynamic eccentricity: the air gap of the turn
    return W0*(1+0.004*np.cos(th/3+.9))+ecc*(a6*np.cos(6*th)+b6*np.sin(6*th)+a12*np.cos(12*th)+b12*np.sin(12*th)+a18*np.cos(18*th)+b18*np.sin(18*th))+ecc*cg+0.004*np.cos(th/3+2.2)*0.5
def torque(id,iq,th):
    e=1e-4
    pd=(W(id+e,iq,th)-W(id-e,iq,th))/(2*e); pq=(W(id,iq+e,th)-W(id,iq-e,th))/(2*e); pt=(W(id,iq,th+e)-W(id,iq,th-e))/(2*e)
    return 1.5*P*(pd*iq-pq*id)+1.5*P*pt
def flux(id,iq,th):
    e=1e-4
    return (W(id+e,iq,th)-W(id-e,iq,th))/(2*e),(W(id,iq+e,th)-W(id,iq-e,th))/(2*e)
def abc(d,q,th): return [q*np.sin(th-k*2*np.pi/3)-d*np.cos(th-k*2*np.pi/3) for k in range(3)]
N=7200; TH=np.arange(N)*2*np.pi*P/N
OFF=np.deg2rad(0.8)  # electrical
def table(f):
    d=np.genfromtxt(f,delimiter=',',names=True); th=d['theta_e_rad']; per=2*np.pi*max(1,round((th[-1]+th[1])/(2*np.pi)))
    return lambda the:tuple(np.interp(the%per,np.r_[th,per],np.r_[d[c],d[c][0]]) for c in ('ia_A','ib_A','ic_A'))
def dq(i,th):
    d=-2/3*sum(i[k]*np.cos(th-k*2*np.pi/3) for k in range(3)); q=2/3*sum(i[k]*np.sin(th-k*2*np.pi/3) for k in range(3)); return d,q
def ripple(T,label):
    f=np.fft.rfft(T)/len(T); big=np.argsort(-np.abs(f[1:]))[:6]+1; h=f.copy(); h[P*60+1:]=0
    print(f"{label}: mean {T.mean():.4f} ripple ptp {np.ptp(T):.4f} (<=60 {np.ptp(np.fft.irfft(h*len(T),len(T))):.4f}) Nm; ",[(round(k/P,3),round(2*abs(f[k]),4)) for k in big])
if __name__=='__main__':
    a=sys.argv
    if a[1]=='play':
        th=TH; ao=np.deg2rad(float(a[3])) if len(a)>3 else 0.; i=table(a[2])(th+OFF+ao); d,q=dq(i,th); ripple(torque(d,q,th),'table'); print('  id',d.mean(),'iq',q.mean(),'peak',np.max(np.abs(i)))
    elif a[1]=='sine': ripple(torque(float(a[2])+0*TH,float(a[3])+0*TH,TH),'sine')
    else:
        if a[1]=='open': out,ID,IQ,RPM,TURNS=a[2],0,0,float(a[3]),float(a[4]); rest=a[5:]
        else: out,ID,IQ,RPM,TURNS=a[2],*map(float,a[3:7]); rest=a[7:]
        seed=int(rest[0]) if rest and rest[0].isdigit() else 3; r=np.random.default_rng(seed)
        g=table(rest[rest.index('--table')+1]) if '--table' in rest else None
        om=RPM*2*np.pi/60; sg=np.sign(RPM); fs=10000.; n=int(TURNS*2*np.pi/abs(om)*fs); t=np.arange(n)/fs
        thm=om*t+.002*np.sin(2*np.pi*1.7*t)+r.uniform(0,6); th=P*thm; w=np.gradient(thm,t)
        if g: i=g(th+OFF); d,q=dq(i,th)
        else: d,q=ID+0*t,IQ+0*t
        i=abc(d,q,th)
        T=torque(d,q,th)-sg*0.09-0.0011*w-sg*0.002*np.hypot(ID,IQ)
        k=1-np.exp(-2*np.pi*500/fs); y=[]; v=float(T[0])
        for x in T.tolist(): v+=k*(x-v); y.append(v)
        y=np.array(y)+r.normal(0,.03,n)-0.04+0.02*np.sin(2*np.pi*50*t)     # mains hum
        adc=lambda x,fsr:np.round(x/(fsr/256/16))*(fsr/256/16)              # 12 bit high res
        ip=[adc((1,1.02,1)[j]*i[j]+(.05,-.03,.02)[j]+r.normal(0,.06,n),50) for j in range(3)]
        ang=np.rad2deg(thm+OFF/P)%360; ang=np.round(ang/360*5000)*360/5000
        with open(out,'w') as f:
            f.write('"Model","DLM5038"\n"BlockNumber",1\n"TraceName","CH1","CH2","CH3","CH4"\n"SampleRate",10000\n"TriggerLevel",0.5\n"Date","2024/05/17"\n"Time","14:03:22.18"\n"Comment","IPM prototype 2, torque transducer T22 20Nm"\n\n')
            if a[1]=='open':
                # phase voltages to the star point, terminals open
                e=1e-4
                la=lambda x:np.array(abc(*[(lambda dq_:(dq_[1],-dq_[0]))(flux(0*x,0*x,x))][0],x))
                ld=lambda x:flux(0*x,0*x,x)
                def lab(x):
                    D,Qf=ld(x); return np.array([Qf*np.sin(x-k*2*np.pi/3)-D*np.cos(x-k*2*np.pi/3) for k in range(3)])
                v3=(lab(th+e)-lab(th-e))/(2*e)*P*w
                f.write('Time,U_1,U_2,U_3,Torque,Angle\ns,V,V,V,N·m,deg\n')
                for j in range(0,n): f.write(f"{t[j]:.6f},{v3[0][j]+r.normal(0,.05):.3f},{v3[1][j]+r.normal(0,.05):.3f},{v3[2][j]+r.normal(0,.05):.3f},{y[j]:.3f},{ang[j]:.3f}\n")
            else:
                f.write('Time,I_1,I_2,I_3,Torque,Angle\ns,A,A,A,N·m,deg\n')
                for j in range(n): f.write(f"{t[j]:.6f},{ip[0][j]:.3f},{ip[1][j]:.3f},{ip[2][j]:.3f},{y[j]:.3f},{ang[j]:.3f}\n")
        print(out,n)
