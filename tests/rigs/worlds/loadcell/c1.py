from sim import *
import datetime
def seg(iq,rpm,turns,fs,r,t0,th0,idd=0.,tab=None,seed=0,gains=(1.0,1.015,1.0),offs=(0.05,-0.03,0.0),hold=1.2):
    n=int(abs(turns/rpm*60)*fs); t=np.arange(n)/fs; th=th0+t*rpm*np.pi/30
    te=5*th
    if tab is None: D=idd+0*t;Q=iq+0*t
    else: D,Q=tab(th)
    i3=ph(D,Q,te)
    T=C.air(th,i3)-np.sign(rpm)*C.fric-C.visc*rpm*np.pi/30
    F=T/0.12+0.35*1  # tare 0.35 N
    F=np.round((F+r.normal(0,0.08,n))/0.01)*0.01
    ii=[np.round((g*x+o+r.normal(0,.01,n))/0.005)*.005 for g,o,x in zip(gains,offs,i3)]
    return t0+t,th,np.full(n,rpm)+r.normal(0,.05,n),ii,F
def rec(fn,segs,fs=80,seed=1,tab=None,title=True,z0=0.0):
    r=R(seed); t0=0; th0=0.1; base=datetime.datetime(2026,11,30,14,3,5,120000)
    with open(fn,'w',encoding='cp1252',newline='') as f:
        if title: f.write('Prüfstand 3;Servo XY-80;;;;;;\r\nPrüfer: M. Huber;;;;;;;\r\nHebelarm 120 mm;;;;;;;\r\n\r\n')
        f.write('Zeitstempel;Winkel mech [°];Drehzahl [1/min];Strom L1 [A];Strom L2 [A];Strom L3 [A];Kraft [N];Bemerkung\r\n')
        for iq,rpm,turns in segs:
            t,th,w,ii,F=seg(iq,rpm,turns,fs,r,t0,th0,tab=tab)
            for k in range(len(t)):
                s=(base+datetime.timedelta(seconds=float(t[k]))).strftime('%d.%m.%Y %H:%M:%S,%f')[:-3]
                f.write((s+';%.3f;%.1f;%.3f;%.3f;%.3f;%.2f'%(np.degrees(th[k]+z0)%360,w[k],ii[0][k],ii[1][k],ii[2][k],F[k])).replace('.',',').replace(s.replace('.',','),s)+';\r\n')
            t0=t[-1]+1.0; th0=th[-1]
if __name__=='__main__':
    # 80 readings/s, 6 rpm -> 800 samples a turn
    for j,i in enumerate((0,1.5,3.0,5.0)): rec('c_%d.csv'%j,[(i,6,4),(i,-6,4)],seed=j+1)
