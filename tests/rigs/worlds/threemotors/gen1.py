"""motor 1: dyno logs, DAQ export ; decimal comma, units row. args: none -> all logs"""
from mot import *
import sys
R=np.random.default_rng(11)
GA=dict(off=(0.55,-0.4,0.3),gain=(1.006,0.995,1.003))   # current sensors: zero A, gain
def log1(fn,I,ang,rpm,T=8.,fs=4000.,sensors=True,zero=0.35,seed=None):
    n=int(T*fs); t=np.arange(n)/fs
    w=rpm*2*np.pi/60*(1+0.003*np.sin(2*np.pi*.7*t+R.uniform(0,6)))  # dyno holds the speed, not quite
    tm=R.uniform(0,6)+np.cumsum(w)/fs; te=M1.p*tm
    d0,q0=-I*np.sin(ang),I*np.cos(ang)
    # the drive regulates its own (false) readings: true = reading corrected
    a,b,c=abc(d0,q0,te)
    if I>0:
        a,b,c=[x+0.004*I*np.sin(5*te+k)+.05*R.standard_normal(n) for k,x in enumerate((a,b,c))]
        s=(a+b+c)/3; a,b,c=a-s,b-s,c-s
        a,b,c=[(x-o)/g for x,o,g in zip((a,b,c),GA['off'],GA['gain'])]
        s=(a+b+c)/3; a,b,c=a-s,b-s,c-s
    d,q=dq(a,b,c,te); 
    if I==0: d=q=0*te
    Tq=M1.T(d,q,tm)-np.sign(rpm)*(1.1+0.4*np.exp(-abs(rpm)/40))-.002*w*8
    # sensor: 1 kHz low pass neglected at these speeds below; noise .25 Nm, gain +0.3 %, zero
    k=np.exp(-2*np.pi*500/fs); y=np.empty(n); acc=Tq[0]
    from scipy.signal import lfilter
    y=lfilter([1-k],[1,-k],Tq,zi=[k*Tq[0]])[0]
    y=1.003*y+zero+.25*R.standard_normal(n)
    if I>0: ia,ib,ic=[g*x+o+.15*R.standard_normal(n) for x,o,g in zip((a,b,c),GA['off'],GA['gain'])]
    else: ia,ib,ic=[o+.15*R.standard_normal(n) for o in GA['off']]
    cm=lambda x,f:(f%x).replace('.',',')
    with open(fn,'w',encoding='cp1252') as f:
        f.write('Messung Prüfstand 3;Datum 12.03.2026\r\nMesszeit;Winkel_mech;Drehzahl;Strom_U;Strom_V;Strom_W;Drehmoment;T_Wicklung\r\ns;°;1/min;A;A;A;Nm;°C\r\n')
        deg=np.degrees(tm)%360
        for i in range(0,n):
            f.write(';'.join((cm(t[i],'%.5f'),cm(deg[i],'%.3f'),cm(w[i]*60/2/np.pi,'%.2f'),cm(ia[i],'%.2f'),cm(ib[i],'%.2f'),cm(ic[i],'%.2f'),cm(y[i],'%.3f'),'41,5'))+'\r\n')
if __name__=='__main__':
    import os; os.makedirs('m1',exist_ok=True)
    log1('m1/leer_vor.csv',0,0,60); log1('m1/leer_rueck.csv',0,0,-60)
    for I,a in ((40,.42),(80,.55),(120,.64)): log1(f'm1/last_{I}.csv',I,a,60)
    log1('m1/brems_80.csv',80,np.pi-.55,60,)
    d=80
