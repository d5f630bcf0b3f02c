#!/usr/bin/env python
"""Air spindle, 2 pole pairs, 12 slots, slotted; free run-down from 900 rpm, no current, log of a 10000-line index encoder: time stamp + speed + angle.
 one weak magnet and an eccentric rotor. usage: spindle.py log OUT [seed] [--back] | play waveform.csv [inertia-factor]"""
import numpy as np, sys, math
P=2; KE=0.0477; J=1.9e-4
COG=[(12,.0065,.9),(24,.0012,-1.1),(2,.0009,.2),(14,.0007,2.),(10,.0006,.4),(36,.0003,0.)]   # mechanical orders; 2/turn: one pole pair weaker
cog=lambda m:sum(a*np.sin(k*m+p) for k,a,p in COG)
em=lambda th,k:(lambda x:KE*(np.sin(x)+.018*np.sin(5*x)+.009*np.sin(7*x+1)))(th-k*2*np.pi/3)
N=7200; TH=np.arange(N)*2*np.pi/N
def tab(f):
    d=np.genfromtxt(f,delimiter=',',names=True); th=d['theta_e_rad']; per=2*np.pi*max(1,round((th[-1]+th[1])/(2*np.pi)))
    return lambda the:tuple(np.interp(the%per,np.r_[th,per],np.r_[d[c],d[c][0]]) for c in ('id_A','iq_A'))
def ripple(T,l):
    f=np.fft.rfft(T)/len(T); big=np.argsort(-np.abs(f[1:]))[:6]+1
    print(f"{l}: mean {T.mean():.5f} ripple ptp {np.ptp(T):.5f}",[(round(k/P,3),round(2*abs(f[k]),5)) for k in big])
def T(id,iq): 
    th=P*TH; return sum(em(th,k)*(iq*np.sin(th-k*2*np.pi/3)-id*np.cos(th-k*2*np.pi/3)) for k in range(3))+cog(TH)
a=sys.argv
if a[1]=='play': id,iq=tab(a[2])(P*(TH)); ripple(T(id,iq),'table')
elif a[1]=='sine': ripple(T(0,float(a[2])),'sine')
else:
    r=np.random.default_rng(int(a[3]) if len(a)>3 else 1); s=-1 if '--back' in a else 1
    w=s*94.; m=.4; dt=2e-5; rows=[]; t=0; k=0
    while abs(w)>4 and t<30:
        tq=-(0.0011*math.tanh(w/.05)+6e-6*w)
        for kk,aa,pp in COG: tq+=aa*math.sin(kk*m+pp)
        w+=tq/J*dt; m+=w*dt; t+=dt; k+=1
        if k%50==0: rows.append(f"{t:.4f}\t{math.floor(m/(2*math.pi)*40000)%40000}\t{(w+r.normal(0,.02))*60/2/math.pi:.2f}")
    open(a[2],'w').write('Time [s]\tPosCounts\tn [1/min]\n'+'\n'.join(rows)+'\n'); print(a[2],len(rows))
