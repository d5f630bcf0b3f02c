from sim import *; from simb import B2
def rec(fn,segs,fs=2000,seed=1,off=0.0,k=0.96,tab=None,head='Time [s],Rotor angle [deg],Speed [rpm],Id [A],Iq [A],Shaft torque [Nm]'):
    r=R(seed); t0=0; th0=0.2; out=[]
    for idd,iq,rpm,turns in segs:
        n=int(abs(turns/rpm*60)*fs); t=np.arange(n)/fs; th=th0+t*rpm*np.pi/30
        te=4*th
        if tab is not None: c=tab(te+off); D,Q=c
        else: D=idd+0*t;Q=iq+0*t
        # drive turns currents by its own angle (off el. rad)
        z=(D+1j*Q)*np.exp(1j*off); D1,Q1=z.real,z.imag
        T=B2(te,D1,Q1,k)-np.sign(rpm)*0.35-0.004*rpm*np.pi/30
        # once-per-turn real: uneven magnets
        T=T+0.12*np.sin(th*4*1+0.3)*0+0.10*np.sin(48*th+.4)*0
        Tm=T*1.004+0.06+r.normal(0,0.08,n)
        enc=np.round((th+off/4)/(2*np.pi)*8192)/8192*360
        out.append(np.c_[t0+t,enc,rpm+r.normal(0,.05,n),D+r.normal(0,.3,n),Q+r.normal(0,.3,n),Tm]); t0+=n/fs+.5; th0=th[-1]
    a=np.vstack(out); open(fn,'w').write(head+'\n'); 
    with open(fn,'a') as f: np.savetxt(f,a,fmt=['%.4f','%.4f','%.2f','%.3f','%.3f','%.3f'],delimiter=',')
if __name__=='__main__':
    rec('b_d0.csv',[(0,0,23.9,10),(0,0,-23.9,10)])
    rec('b_d1.csv',[(-40,80,23.9,10)],seed=2); rec('b_d2.csv',[(-40,80,-95,10)],seed=3); rec('b_d3.csv',[(0,120,23.9,10)],seed=4)
    rec('b_d4.csv',[(-80,120,-23.9,10)],seed=5); rec('b_d5.csv',[(20,60,95,10)],seed=6); rec('b_d6.csv',[(-100,60,60,10)],seed=7)
