# servo on dyno, 5 pole pairs 12 slots, German DAQ export; merged channels at different rates, two layouts
from sim import *
rng=np.random.default_rng(5)
K=0.412
def motor():
    return Motor(5,K,{1:(1,0),5:(.022,math.pi-.4),7:(.011,.9),11:(.004,0.3)},
      {60:(.025,.8),12:(.015,-.6),10:(.008,2.0)},zero_e=math.radians(73),coul=.04,visc=.0003,J=3e-4,sat=6e-4)
def de(x,n): return f'{x:.{n}f}'.replace('.',',')
def run(name,I,rpm,T=12.0,layout='merged'):
    m=motor(); fs=2000; t=np.arange(int(T*fs))/fs
    w=rpm*TP/60
    th=0.3+w*t+0.004*np.sin(w*t+1)   # dyno not quite steady
    ws=w*(1+0.004*np.cos(w*t+1))
    the=m.pp*th+m.z
    ia,ib,ic=phases(I,0,the)
    # current loop of 400 Hz hit by emf harmonics: small 5/7 current ripple
    ia=ia+0*ia
    M=m.torque(th,ia,ib,ic)-np.sign(w)*m.coul-m.visc*w
    # transducer: low pass 250 Hz, gain 1.004, offset .018
    y=np.empty_like(M); a=1-math.exp(-TP*250/fs); v=M[0]
    for k,x in enumerate(M): v+=a*(x-v); y[k]=v
    y=1.004*y+.018+rng.normal(0,.004,len(y))
    ang=np.floor((np.degrees(th)%360)/360*10000)/10000*360
    g=(1.008,.995,1.0)
    A=[ (x*q+o+rng.normal(0,.02,len(x))) for x,q,o in zip((ia,ib,ic),g,(.03,-.02,.01))]
    n=ws*60/TP+rng.normal(0,.05,len(ws))
    with open(f'b_dyno/{name}.csv','w',encoding='cp1252',newline='') as f:
        if layout=='merged':
            f.write('Messung;Prüfstand 3\r\nDatum;12.03.2026 14:07:33\r\nBediener;Möller\r\nKommentar;'+name+'\r\n\r\n')
            f.write('Zeit;Winkel Welle;Drehmoment T22;I_L1;I_L2;I_L3;Drehzahl\r\n')
            f.write('s;°;Nm;A;A;A;1/min\r\n')
            for k in range(len(t)):
                mm=de(y[k],4) if k%2==0 else ''
                nn=de(n[k],2) if k%20==0 else ''
                f.write(f'{de(t[k],5)};{de(ang[k],3)};{mm};{de(A[0][k],3)};{de(A[1][k],3)};{de(A[2][k],3)};{nn}\r\n')
        elif layout=='times': # each group with its own time column, torque half as often, so column is shorter
            f.write('t_Encoder [s];Winkel_mech [°];t_Moment [s];Drehmoment_Messwelle [Nm];t_Strom [s];Strom L1 [A];Strom L2 [A];Strom L3 [A]\r\n')
            N=len(t)
            for k in range(N):
                mm=f'{de(t[2*k],5)};{de(y[2*k],4)}' if 2*k<N else ';'
                f.write(f'{de(t[k],5)};{de(ang[k],3)};{mm};{de(t[k],5)};{de(A[0][k],3)};{de(A[1][k],3)};{de(A[2][k],3)}\r\n')
    return th,M
if __name__=='__main__':
    for nm,I,r in (('leer_vor',0,20),('leer_rueck',0,-20),('last_2A',2,20),('last_4A',4,20),('last_6A',6,-20),('last_5A_schnell',5,60)): run(nm,I,r)
    run('zeiten_last_4A',4,20,layout='times')
