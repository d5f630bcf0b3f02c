# variants of motor C: harsh truths; tune; play true table (sensors corrected as told); compare with promise
import sys,json,subprocess,re,os
from sim import *; import sim, c1
from player import load
from scipy.signal import lfilter
LOG=open('cv2.txt','a')
def mk(tag,loads=(0,1.5,3.0,5.0),turns=4,rpm=6,lag=0,ecc=0,zoff=0,drag=0,drift=0,gains=(1,1.015,1),offs=(.05,-.03,0),mag=0,imb=(1,1,1),both=True,fs=80,noise=.08,idd=None,extra='',cogscale=1,once=0,hyst=0,noisei=.01,vary=None):
    files=[]
    fsx=fs
    for j,I in enumerate(loads):
        r=R(100+j); out=[];t0=0.;th0=.1
        for s in ((1,-1) if both else (1,)):
            rp=rpm if vary is None else vary[j%len(vary)]
            n=int(turns/rp*60*fs); t=np.arange(n)/fs; th=th0+s*t*rp*np.pi/30; te=5*th
            D=(idd[j] if idd else 0)+0*t
            i3=ph(D,I+0*t,te)
            i3=[x*1. for x in i3]
            m=1-mag*j
            T=C.air(th,[m*b*x for b,x in zip(imb,i3)])
            sh=T-s*(C.fric+drag*abs(T))-C.visc*s*rp*np.pi/30+once*np.sin(th+1)
            if lag:
                a=1-np.exp(-1/(fs*lag)); sh=lfilter([a],[1,-(1-a)],sh,zi=[sh[0]*(1-a)])[0]
            F=sh/0.12+.35+drift*(t0+t)/100
            F=np.round((F+r.normal(0,noise,n))/.01)*.01
            ang=th+ecc*np.sin(th+.5)+zoff/5
            ii=[np.round((g*x+o+r.normal(0,noisei,n))/.005)*.005 for g,o,x in zip(gains,offs,i3)]
            out.append(np.c_[t0+t,np.degrees(ang),np.full(n,s*rp),*ii,F*.12]); t0+=n/fs+1; th0=th[-1]
        a=np.vstack(out); fn='cv_%s_%d.csv'%(tag,j); files.append(fn)
        with open(fn,'w') as f:
            f.write('time_s,theta_m_deg,speed_rpm,ia_A,ib_A,ic_A,torque_Nm\n'); np.savetxt(f,a,fmt='%.4f',delimiter=',')
    cmd='nice hci-solve tune %s --pole-pairs 5 --slots 12 --torque-constant 0.82 --rated-current 5 --json -o cv_%s %s'%(' '.join(files),tag,extra)
    p=subprocess.run(cmd,shell=True,capture_output=True,text=True); 
    try: d=json.loads(p.stdout)
    except Exception: print(tag,p.returncode,p.stdout[:200],p.stderr[:300],file=LOG); return
    res=''
    if os.path.exists('cv_%s/table/tuned.c'%tag):
        fo='cv_%s/table'%tag; f=load(fo); M={k:float(v) for k,v in re.findall(r'#define tuned_(\w+) \(?(-?[\d.e-]+)f',open(fo+'/tuned.h').read())}
        th=np.linspace(0,2*np.pi,20000,endpoint=False); rd=th+ecc*np.sin(th+.5)+zoff/5
        # corrected angle, in order: zero, then sines
        e=rd-M.get('THETA_ZERO_RAD',0)/5
        e=e-M.get('THETA_M_SIN1_RAD',0)*np.sin(e); e=e-M.get('THETA_M_COS1_RAD',0)*np.cos(e)
        c=f(e*5/(2*np.pi)/f.period); i3=ph(c[0],c[1],5*e)
        T=C.air(th,[b*x for b,x in zip(imb,i3)])+once*np.sin(th+1)
        lo,hi=.05,9; m=T.mean()
        for _ in range(50):
            q=(lo+hi)/2
            if C.air(th,[b*x for b,x in zip(imb,ph(0*th,0*th+q,5*th))]).mean()<m: lo=q
            else: hi=q
        T0=C.air(th,[b*x for b,x in zip(imb,ph(0*th,0*th+q,5*th))])+once*np.sin(th+1)
        ex=d['expected']; res='true mean %.4f pp %.4f plain pp %.4f'%(m,np.ptp(T),np.ptp(T0))
        F=np.abs(np.fft.rfft(T))/len(T)*2; res+=' '+str({'%.2f'%(k/5):round(float(F[k]),4) for k in np.argsort(-F[1:])[:4]+1})
        res+=' EXP '+str({k:v for k,v in ex.items() if not isinstance(v,(list,dict,str))} if ex else None)[:400]
    print('==',tag,'EXIT',p.returncode,'|',d['verdict'],'|',d['words'],'\n    ',res,'\n    caveats',[x[:160] for x in d['caveats'] if 'current loop adds' not in x],file=LOG,flush=True)
if __name__=='__main__':
    V=dict(ro2=dict(lag=.03,cogscale=1,turns=8),rpm2=dict(lag=.02,rpm=12),alias=dict(fs=16,turns=10),al2=dict(fs=11,turns=10),nc=dict(offs=(.0,.0,.0),gains=(1,1,1),imb=(1.0,1.015,1)),lag10=dict(lag=.01),lag05=dict(lag=.005),lag30n=dict(lag=.03,gains=(1,1,1),offs=(0,0,0)),lag2b=dict(lag=.03,loads=(0,0,3.,3.,5.),vary=(6,3,6,3,6)),base={},lag=dict(lag=.03),lag1=dict(lag=.03,both=False),ecc=dict(ecc=.005),zoff=dict(zoff=.05),drag=dict(drag=.06),drift=dict(drift=.5),mag=dict(mag=.01),imb=dict(imb=(1.02,1,.99)),few=dict(turns=1.3),one=dict(loads=(3.,)),one1=dict(loads=(0,4.),both=False),once=dict(once=.03),noisy=dict(noise=.6,noisei=.05),idq=dict(idd=(0,-1,0,-2.)),lag2=dict(lag=.05,vary=(3,6,12,6)),eccz=dict(ecc=.004,zoff=-.06,idd=(0,1,-2,0)),coarse=dict(fs=14))
    for k in (sys.argv[1:] or V): mk(k,**V[k])
