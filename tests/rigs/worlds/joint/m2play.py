import sys; import m2,play,numpy as np,math
# log while the table is played; drive UNcorrected or corrected sensors; writes raw readings
folder,out,corr,rpm=sys.argv[1],sys.argv[2],int(sys.argv[3]),float(sys.argv[4])
fs=2500; n=int(6.3*fs); t=np.arange(n)/fs; w0=rpm*math.pi/30
th=w0*t+0.7; th=th+0.006*np.sin(th+.3); w=np.gradient(th,t); acc=np.gradient(w,t)
thr=m2.res(th)
te,d,q,offs,gain=play.table(folder,thr,4,bool(corr))
if not corr: offs,gain=(0,0,0),(1,1,1)
want=np.array([q*np.sin(te-2*math.pi/3*s)-d*np.cos(te-2*math.pi/3*s) for s in range(3)])
i=np.array([(want[k]*gain[k]+offs[k]-m2.OFF[k])/m2.GAIN[k] for k in range(3)]); i=i-i.mean(0)
T=m2.torque(th,i)-np.sign(w)*m2.TC-m2.TV*w-m2.JR*acc
a=1-math.exp(-2*math.pi*m2.FT/fs); y=np.zeros(n); s=T[0]
for k in range(n): s+=a*(T[k]-s); y[k]=s
rng=np.random.default_rng(5)
y=m2.GT*y+0.04+rng.normal(0,.012,n); im=np.array([m2.GAIN[k]*i[k]+m2.OFF[k] for k in range(3)])+rng.normal(0,.015,(3,n))
with open(out,'w',encoding='latin-1') as f:
    f.write('Zeit;Resolverwinkel;Strom L1;Strom L2;Strom L3;Drehmoment;Drehzahl\ns;°;A;A;A;Nm;1/min\n')
    for k in range(int(.3*fs),n):
        f.write(';'.join(['%.4f'%(t[k]-.3),'%.3f'%(np.degrees(thr[k])%360)]+['%.3f'%im[j,k] for j in range(3)]+['%.4f'%y[k],'%.2f'%(w[k]*30/math.pi)]).replace('.',',')+'\n')
