"""log the first turns with the table of out/v4L: corrected sensors, uncorrected, 10 electrical degrees off, half table turn"""
from gen_servo import *
from play import *
import sys
out=sys.argv[1]; t=table(out); corr=corrections(out)
def log(name,off=0.,use=True,seed=77,rpm=30):
    rng=np.random.default_rng(seed); fs=2000; w=rpm*np.pi/30; n=int(6*2*np.pi/abs(w)*fs); tt=np.arange(n)/fs; ph=w*tt+.3
    thm=ph+.01*np.sin(ph+.5)*.3+.002*np.sin(2*ph); thr=SS.angle(thm); ws=np.gradient(thm,tt)
    cor=corr if use else dict(g=[0]*3,o=[0]*3,ecc=[],harm=[],off=0.)
    f=thr-sum([v*(np.sin(k*thr) if q=='sine' else np.cos(k*thr)) for k,q,v in cor['ecc']]) if cor['ecc'] else thr
    el=3*f-cor['off']
    idr,iqr=look(t,el+off)
    i=SS.true_currents(el,idr,iqr,.03,rng,cor['g'],cor['o'])
    T=S.shaft(thm,ws,i); from scipy.signal import lfilter
    a=np.exp(-1/fs/.0012); T=lfilter([1-a],[1,-a],T-T[0])+T[0]
    T=1.012*T+.15+.03+rng.normal(0,.03,n); r=SS.read(i)+rng.normal(0,.03,i.shape)
    print(name,'true-ish measured pp (sensor)',pp(1.012*S.shaft(thm,ws,SS.true_currents(el,idr,iqr,0,rng,cor['g'],cor['o']))))
    with open(name,'w',encoding='cp1252') as fo:
        fo.write('Zeit [ms];Winkel [°];Drehzahl [1/min];I_U [A];I_V [A];I_W [A];Moment [Nm]\n')
        for k in range(n): fo.write(';'.join([de(tt[k]*1e3,1),de(np.degrees(thr[k])%360,3),de(ws[k]*30/np.pi,2),de(r[0,k],3),de(r[1,k],3),de(r[2,k],3),de(T[k],3)])+'\n')
log('s/played/good.csv'); log('s/played/raw.csv',use=False); log('s/played/off10.csv',off=np.radians(10)); log('s/played/off60.csv',off=np.radians(60)); log('s/played/back.csv',rpm=-30)
