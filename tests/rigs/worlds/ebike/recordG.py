import numpy as np, math, sys
from motors import *
g=G()
def lut(n=28000):  # torque without current and torque per iq, id over a mechanical turn
    x=np.arange(n)*2*pi/n
    T0=g.torque(x,0*x,0*x); return T0,g.torque(x,0*x,0*x+1)-T0,g.torque(x,0*x+1,0*x)-T0
T0,TQ,TD=(a.tolist() for a in lut())
def run(name, profile, dur, seed, table=None, head='odrive', logrps=100, kp=6., ki=20., kpos=14., torque_mode=None, ext=0.0):
    """profile(t)->position setpoint in rad (mechanical, of the encoder). Position P + velocity PI, 4 kHz; encoder 14 bit with its errors."""
    r=np.random.default_rng(seed); fs=4000; n=int(dur*fs); dt=1/fs; N=len(T0); K=N/(2*pi)
    x=r.uniform(0,6.28); v=0.; integ=0.; rows=[]; lsb=2*pi/16384; vf=0.; nz=r.normal(0,.02,n).tolist(); kt=1.5*g.ke
    off=g.angle_read(x)-profile(0); last=None; nxt=.003; rr=r.normal(0,.0006,n).tolist(); xm_p=None
    czero=g.czero; iq=0.
    for k in range(n):
        t=k*dt
        xm=math.floor((x+math.radians(.25)*math.sin(x+2)+math.radians(.08)*math.sin(2*x))/lsb)*lsb
        if xm_p is None: xm_p=xm
        vf+=.15*((xm-xm_p)/dt-vf); xm_p=xm
        if torque_mode is None:
            vs=kpos*(profile(t)+off-xm)+(profile(t+dt)-profile(t))/dt; e=vs-vf; integ+=ki*e*dt; 
            iqc=kp*e*.1+integ
            idc=0.
            if table: da,qa=table(xm); idc+=da; iqc+=qa
        else:
            idc,iqc=torque_mode(xm,t)
        iqc=max(-8,min(8,iqc))
        # true currents: offsets of phase sensors, zero of commutation
        the=g.p*x+czero; m0=iqc*math.sin(the)-idc*math.cos(the); m1=iqc*math.sin(the-2.0944)-idc*math.cos(the-2.0944)
        a=(m0-g.off[0])/g.gain[0]; b=(m1-g.off[1])/g.gain[1]; c=-a-b
        th=g.p*x; al=a; be=(b-c)/1.7320508; d=-al*math.cos(th)-be*math.sin(th); q=al*math.sin(th)-be*math.cos(th)
        j=int((x*K)%N); T=T0[j]+TQ[j]*q+TD[j]*d+ext
        F=(g.Tc+g.Ts*math.exp(-(v/g.ws)**2))*math.tanh(v/.004)+g.B*v
        v+=dt*(T-F)/g.J; x+=dt*v
        if t>=nxt:
            rows.append((t,xm,vf,iqc+nz[k],idc+nz[k-1],x)); nxt+=1/logrps+rr[k]
    with open('G/'+name+'.csv','w') as f:
        f.write('time,axis0.encoder.pos_estimate,axis0.encoder.vel_estimate,axis0.motor.current_control.Iq_measured,axis0.motor.current_control.Id_measured\n')
        for t,xm,w,q,d,_ in rows: f.write(f'{t+12.7:.4f},{xm/2/pi:.6f},{w/2/pi:.5f},{q:.4f},{d:.4f}\n')
    return rows
def trapez(w, turns, hold=1.5):
    T=turns*2*pi/w
    def p(t):
        if t<hold: return 0.
        if t<hold+T: return w*(t-hold)
        if t<2*hold+T: return w*T
        if t<2*hold+2*T: return w*T-w*(t-2*hold-T)
        return 0.
    return p,2*T+3*hold
if __name__=='__main__':
    for nm,rpm,turns in (('slow2',2,2.2),('slow5',5,2.2),('stiff5',5,2.2),('stiff10',10,2.2)):
        p,D=trapez(rpm*2*pi/60,turns); rows=run(nm,p,D,7,**({} if nm[0]=='s' and nm[1]=='l' else dict(kp=30,ki=80)))
        v=np.array([x[2] for x in rows]); q=np.array([x[3] for x in rows]); w=rpm*2*np.pi/60; mv=np.abs(np.gradient(np.array([x[5] for x in rows]),np.array([x[0] for x in rows]))); m=(np.array([x[0] for x in rows])>2)&(np.array([x[0] for x in rows])<D/2-2); print(nm,len(rows),D,'true speed sd',np.std(mv[m])/w,'iq',q.min(),q.max())
