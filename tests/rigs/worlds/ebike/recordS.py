import numpy as np, sys, os
from motors import *
s=S(); os.makedirs('S/volt',exist_ok=True); os.makedirs('S/load',exist_ok=True)
fs0=40000
def res(T, rpm): # torque chain: shaft resonance 160 Hz zeta .05, 500 Hz amplifier -- in frequency domain over the periodic part
    n=T.size; F=np.fft.rfft(T); f=np.fft.rfftfreq(n,1/fs0); w=1j*f
    Hh=1/(1+2*.05*w/160+(w/160)**2)/(1+w/500); return np.fft.irfft(F*Hh,n)
def adc(v, rng, r, noise): return np.round((v+r.normal(0,noise,v.size))/(rng/4096))*(rng/4096)
def run(name, I, gam, rpm, dur, seed, N=10000, cur=None, volts=False, out='S'):
    r=np.random.default_rng(seed); n=int(dur*fs0); t=np.arange(n)/fs0; w0=rpm*2*pi/60
    thm=r.uniform(0,6.28)+w0*t+ .002*np.sin(2*pi*.7*t)
    th=s.p*thm
    if cur is not None: d,q=cur(thm+s.zero)
    else: d,q=np.full(n,-I*np.sin(gam)),np.full(n,I*np.cos(gam))
    # the drive's own loop: its sensors have 0.04 A zero on a, 1 % on b
    m=abc(th,d,q); tr=[m[0]-.04*(I!=0 or cur is not None), m[1]/1.01, m[2]]; z=sum(tr)/3; tr=[x-z for x in tr]
    dd,qq=dq(th,*tr)
    T=s.torque(thm,dd,qq)-s.Tc*np.sign(w0)-s.B*w0
    Tm=res(np.concatenate([T,T,T]),rpm)[n:2*n]
    k=np.linspace(0,n-1,N).astype(int); dt=dur/N
    ang=((thm+s.zero)%(2*pi))/(2*pi)*10
    if volts:
        e=[sum(phases(th,nn,E,g)[j] for nn,E,g in s.emf)*w0 for j in range(3)]
        ch=[adc(x[k],80,r,.05) for x in e]+[adc(ang[k],16,r,.006)]
        ch=[ch[0]/10,ch[1]/10,ch[2]/10,ch[3]]; head='CH1,CH2,CH3,CH4'; o='volt'
    else:
        ia=(tr[0]*s.probe[0]+s.poff[0])*.1; ib=(tr[1]*s.probe[1]+s.poff[1])*.1
        ch=[adc(ia[k],4,r,.004),adc(ib[k],4,r,.004),adc((Tm[k]*.5)+.015,10,r,.006),adc(ang[k],16,r,.006)]; head='CH1,CH2,CH3,CH4'; o='load'
    with open(f'{out}/{o}/{name}.csv','w') as f:
        f.write(f'Model,MSO5104\nFirmware Version,00.01.03.03\n\nWaveform Type,ANALOG,,,\nSample Interval,{dt:.6e}\nRecord Length,{N}\n\nTIME,{head}\ns,V,V,V,V\n' if False else
                f'Model,MSO5104,,,\nSample Interval,{dt:.6e},s,,\nRecord Length,{N},Points,,\nVertical Units,V,V,V,V\nHorizontal Units,s,,,\nLabel,,,,\nTIME,{head}\n')
        for j in range(N): f.write(f'{j*dt-dur/2:.6e},'+','.join(f'{c[j]:.5f}' for c in ch)+'\n')
if __name__=='__main__':
    run('emk_400rpm',0,0,400,1.0,11,volts=True)
    run('slow_fwd',0,0,30,8,12); run('slow_back',0,0,-30,8,13)
    run('4A',4,.25,60,4,14); run('8A',8,.4,60,4,15); run('12A',12,.52,60,4,16); run('8A_150rpm',8,.4,150,2,17); run('8A_id0',8,0.,60,4,18)
