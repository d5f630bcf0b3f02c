#!/usr/bin/env python
"""e-bike hub, 40 magnets / 36 teeth, concentrated coils; one weak magnet, uneven slot openings, pole errors.
 logs: drive at constant i_q, dyno holds speed, torque sensor on a second shaft behind a 44:66 belt (x1.5, 97 %), 30 Hz low pass.
 usage: hub.py log OUT.csv IQ RPM TURNS [seed] [--table waveform.csv --angle0 DEG] [--no-belt] | hub.py play waveform.csv | sine IQ"""
import numpy as np, sys
P,Q,N=20,36,14400
TH=np.arange(N)*2*np.pi/N
rng=np.random.default_rng(777)
amp=1+rng.normal(0,0.004,40); amp[11]*=0.93          # one weak magnet, 7 %
pos=(np.arange(40)+rng.normal(0,0.012,40))*2*np.pi/40
slotw=1+rng.normal(0,0.02,Q); slotpos=(np.arange(Q)+.5)*2*np.pi/Q+rng.normal(0,0.0006,Q)
def shape(x): # x in pole pitches from the magnet centre; flat 0.62 wide with soft edges
    return 0.5*(np.tanh((x+.41)/.10)-np.tanh((x-.41)/.10))
B=np.zeros(N)
for k in range(40):
    d=(TH-pos[k]+np.pi)%(2*np.pi)-np.pi
    B+=(-1)**k*amp[k]*shape(d/(2*np.pi/40))
F=np.fft.fft(B); n=np.fft.fftfreq(N,1/N)
# coil flux(theta)= int over tooth of B(phi-theta) -> convolution with the tooth (90 % of slot pitch)
w=2*np.pi/Q*0.92
def coil(c): # flux of tooth centred at c for every rotor angle
    s=np.sinc(n*w/2/np.pi)*w
    return np.fft.ifft(F*s*np.exp(1j*n*c)).real[::1]
lam=np.zeros((3,N))
for k in range(Q):
    c=k*2*np.pi/Q
    f=np.interp((c-TH)%(2*np.pi),np.r_[TH,2*np.pi],np.r_[0,0]) if 0 else None
    # B at tooth coordinates for rotor angle th: B(phi-th): flux(th)=conv evaluated at c-th
    conv=np.fft.ifft(F*np.sinc(n*w/2/np.pi)*w).real
    idx=(c-TH)%(2*np.pi)
    f=np.interp(idx,np.r_[TH,2*np.pi],np.r_[conv,conv[0]])
    e=np.rad2deg(k*P*2*np.pi/Q)%360
    for ph,a0 in ((0,0),(1,120),(2,240)):
        d=(e-a0+180)%360-180
        if abs(d)<=29: lam[ph]+=f
        elif abs(abs(d)-180)<=29: lam[ph]-=f
def deriv(x): return np.fft.ifft(np.fft.fft(x)*1j*n).real
em=np.array([deriv(l) for l in lam])            # dlambda/dtheta_m
# fundamental electrical component of phase a; make theta=0 its rising zero crossing and a-b-c positive
c1=np.fft.fft(em[0])[P]/N*2; 
cb=np.fft.fft(em[1])[P]; 
ph=np.angle(c1)+np.pi/2                          # e_a = A sin(P th + ph)
if ((np.angle(cb)-np.angle(c1)+np.pi)%(2*np.pi)-np.pi)>0: em=em[[0,2,1]]
ke=1/(9.2*2*np.pi/60)/np.sqrt(3)
em*=ke/abs(c1)
for k in range(3):
    x=P*TH+ph-k*2*np.pi/3; em[k]+=ke*(0.028*np.sin(5*x+.4)+0.015*np.sin(7*x+2.6)+0.006*np.sin(11*x))
# cogging: energy ~ sum of slots B^2 smoothed by the opening
B2=np.fft.fft(B**2); conv=np.fft.ifft(B2*np.sinc(n*0.03/2/np.pi)*np.exp(-(n*0.0035)**2)).real
W=sum(slotw[k]*np.interp((slotpos[k]-TH)%(2*np.pi),np.r_[TH,2*np.pi],np.r_[conv,conv[0]]) for k in range(Q))
cog=deriv(W-W.mean()); 
H=np.fft.fft(cog); H[np.abs(n)>20*64]=0; cog=np.fft.ifft(H).real
cog*=0.42/np.ptp(cog)*2
KT=1.5*ke
sh=-ph/P                                          # rotor angle of the model where electrical zero stands
def at(tab,thm): return np.interp((thm+sh)%(2*np.pi),np.r_[TH,2*np.pi],np.r_[tab,tab[0]])
def phases(id,iq,the): return [iq*np.sin(the-k*2*np.pi/3)-id*np.cos(the-k*2*np.pi/3) for k in range(3)]
def torque(id,iq,thm):
    the=P*thm; i=phases(id,iq,the); I=np.hypot(id,iq)
    sat=1-0.06*(I/35)**2
    return sat*sum(at(em[k],thm)*i[k] for k in range(3))+at(cog,thm)
OFF=np.deg2rad(3.7)                               # index of the hub encoder (mechanical), unknown to the user
def readwave(f):
    d=np.genfromtxt(f,delimiter=',',names=True); return d
def table(f):
    d=readwave(f); th=d['theta_e_rad']; per=2*np.pi*max(1,round((th[-1]+th[1])/(2*np.pi)))
    return lambda the:(np.interp(the%per,np.r_[th,per],np.r_[d['id_A'],d['id_A'][0]]),np.interp(the%per,np.r_[th,per],np.r_[d['iq_A'],d['iq_A'][0]]))
def ripple(T,label):
    f=np.fft.rfft(T)/len(T); h=f.copy(); h[P*60+1:]=0
    T60=np.fft.irfft(h*len(T),len(T))
    big=np.argsort(-np.abs(f[1:]))[:6]+1
    print(f"{label}: mean {T.mean():.4f} ripple ptp {np.ptp(T):.4f} (orders<=60: {np.ptp(T60):.4f}) Nm; largest e-orders",[(round(k/P,3),round(2*abs(f[k]),4)) for k in big])
if __name__=='__main__':
    a=sys.argv
    if a[1]=='play':
        g=table(a[2]); thl=TH        # logged mechanical angle, true = logged - OFF ; the drive plays i_d,i_q at the logged angle
        id,iq=g(P*thl); ripple(torque(id,iq,thl-OFF),'table'); print('  peak i',np.hypot(id,iq).max())
    elif a[1]=='sine':
        ripple(torque(0*TH,float(a[2])+0*TH,TH-OFF),'sine %s A'%a[2])
    elif a[1]=='info':
        f=np.fft.fft(em[0])/N*2
        print('KT',KT,'emf rel',[(k,round(abs(f[P*k]/f[P]),4)) for k in (1,3,5,7,9,11,13)]); ripple(cog,'cogging')
    else:
        out,IQ,RPM,TURNS=a[2],float(a[3]),float(a[4]),float(a[5]); seed=int(a[6]) if len(a)>6 and a[6].isdigit() else 1
        g=table(a[a.index('--table')+1]) if '--table' in a else None
        r=np.random.default_rng(seed); sgn=np.sign(RPM); fs=500.; sub=8; om=RPM*2*np.pi/60
        n_=int(abs(TURNS*2*np.pi/om)*fs*sub); t=np.arange(n_)/(fs*sub)
        thm=om*t+0.02*sgn*np.cos(2*np.pi*0.37*t)/10+r.uniform(0,6.28)     # dyno speed wanders a little
        w=np.gradient(thm,t)
        if g: id,iq=g(P*(thm+OFF)); 
        else: id,iq=0*t,IQ+0*t
        T=torque(id,iq,thm)-sgn*0.35-0.004*w
        T2=1.5*T if '--no-belt' in a else 1.5*(0.97 if IQ*sgn>0 else 1/0.97)*T-sgn*0.12+0.10*np.sin(44*thm+.3)+0.06*np.sin(44/66*thm+1)     # belt: ratio, loss, mesh, big pulley eccentric
        k=1-np.exp(-2*np.pi*30/(fs*sub)); y=[]; v=float(T2[0])
        for x in T2.tolist():
            v+=k*(x-v); y.append(v)
        y=np.array(y)
        s=slice(int(fs*sub*0.3),None,sub); t,thm,y,id,iq=t[s],thm[s],y[s],id[s],iq[s]
        y=np.round((y+r.normal(0,.08,len(y))+0.15+0.10*t/60)/0.02)*0.02
        pos=np.rad2deg(thm+OFF)%360; pos=np.floor(pos/360*16384)*360/16384
        with open(out,'w') as f:
            f.write('t_ms,pos_deg,speed_rpm,Iq_A,Id_A,Torque_Dyno_Nm\n')
            for j in range(len(t)): f.write(f"{(t[j]-t[0])*1e3:.1f},{pos[j]:.3f},{RPM+r.normal(0,.3):.2f},{iq[j]+r.normal(0,.08):.3f},{id[j]+r.normal(0,.08):.3f},{y[j]:.3f}\n")
        print(out,len(t),'rows')
