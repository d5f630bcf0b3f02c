"""play OUT MOTOR: emitted table -> motor through false sensors with the corrections that the report asks for"""
import numpy as np,subprocess,os,csv,json,sys
from motors import *
def table(out,name='tuned'):
    d=out+'/table'; 
    subprocess.check_call(['gcc','-std=c99','-O1','-I'+os.environ['HCI_INCLUDE'],'-I'+d,'-DHDR=%s.h'%name,'-DNAME='+name,'rows.c',d+'/%s.c'%name,'-o','./rows.bin'])
    L=subprocess.check_output(['./rows.bin'],text=True).split('\n'); h=L[0].split()
    v=np.array([float(x) for x in L[1:] if x]).reshape(int(h[2]),int(h[3])*int(h[4]))
    return int(h[0]),int(h[1]),v
def look(t,the):
    fr,per,v=t; n=len(v); x=(the/(2*np.pi*per)%1)*n; k=np.floor(x).astype(int)%n; f=x-np.floor(x)
    r=v[k]*(1-f)[:,None]+v[(k+1)%n]*f[:,None]
    if fr==0:
        ic=-r[:,0]-r[:,1]; return park(the,r[:,0],r[:,1],ic)
    return r[:,0],r[:,1]
def corrections(out):
    c=dict(g=[0,0,0],o=[0,0,0],ecc=[],harm=[],off=0.,load=0.,other=[])
    p=out+'/diagnose/machine/effects.csv'
    if not os.path.exists(p): p=out+'/machine/effects.csv'
    if os.path.exists(p):
        for r in csv.DictReader(open(p)):
            e,n,v,u=r['effect'],r['parameter'],float(r['value']),r['unit']
            u={'deg':np.pi/180,'%':.01,'mA':1e-3,'mrad':1e-3}.get(u,1.); v*=u
            if e=='current_gain': c['g']['abc'.index(n)]=v
            elif e=='current_offset': c['o']['abc'.index(n)]=v
            elif e=='position_eccentricity': c['ecc'].append((int(n.split('_')[-1]),n.split('_')[1],v))
            elif e=='position_harmonics': c['harm'].append((float(n.split('_')[-1]),n.split('_')[0],v))
            elif e=='position_offset': c['off']=v
            elif e=='position_load': c['load']=v
            elif e in('channel_delay','current_filter'): c['other'].append((e,n,v))
    return c
def pp(x): return x.max()-x.min()
def run(m,s,ref,cor,N=40000,w=1.0,turns=1):
    rng=np.random.default_rng(5)
    thm=np.linspace(0,2*np.pi*turns,N,endpoint=False); thr=s.angle(thm)
    f=thr.copy()
    for _ in range(3):
        e=0
        for k,t,v in cor['ecc']: e=e+v*(np.sin(k*f) if t=='mech' and False else (np.sin(k*f)))if t=='sine' else e+v*np.cos(k*f)
        f=thr-e
    el=m.p*f
    for _ in range(3):
        e=cor['off']+0*thr
        for k,t,v in cor['harm']: e=e+v*(np.sin(k*el) if t=='sine' else np.cos(k*el))
        el=m.p*f-e
    idr,iqr=ref(el)
    if cor['load']: el=el-cor['load']*iqr; idr,iqr=ref(el)
    i=s.true_currents(el,idr,iqr,0,rng,cor['g'],cor['o'])
    return thm,m.shaft(thm,w*np.ones(N),i),i
def judge(out,m,s,name='tuned',w=1.0,extra=0.,idq=None):
    t=table(out,name); cor=corrections(out); none=dict(g=[0]*3,o=[0]*3,ecc=[],harm=[],off=0.,load=0.)
    cor['off']-=extra; none2=dict(none,off=-extra)
    th,T,i=run(m,s,lambda e:look(t,e),cor,w=w)
    th,Tn,_=run(m,s,lambda e:look(t,e),none2,w=w)
    # plain sine of same shaft mean, same corrections; along given current angle (i_d/i_q ratio of the table means)
    a,b=look(t,np.linspace(0,2*np.pi*t[1],20000,endpoint=False)); ang=0 if idq is None else idq
    lo,hi=-400.,400.
    f=lambda I: run(m,s,lambda e:(I*np.sin(ang)+0*e,I*np.cos(ang)+0*e),cor,N=6000,w=w)[1].mean()
    sg=np.sign(b.mean()); x0,x1=0.,sg*np.hypot(a.mean(),b.mean())*2.
    for _ in range(50):
        xm=.5*(x0+x1); 
        if (f(xm)-T.mean())*sg<0: x0=xm
        else: x1=xm
    th,S,_=run(m,s,lambda e:(xm*np.sin(ang)+0*e,xm*np.cos(ang)+0*e),cor,w=w)
    th,S0,_=run(m,s,lambda e:(xm*np.sin(ang)+0*e,xm*np.cos(ang)+0*e),none2,w=w)
    emm=T.mean()+m.drag(w)
    print(f"TRUE {out}: air-gap mean {emm:.4f} shaft {T.mean():.4f} | table pp {pp(T):.4f} (uncorrected sensors {pp(Tn):.4f}) | sine {xm:.3f} A pp {pp(S):.4f} (unc. {pp(S0):.4f}) | mean id {a.mean():.2f} iq {b.mean():.2f} peak {np.abs(i).max():.2f} period {t[1]}")
    F=np.abs(np.fft.rfft(T-T.mean()))*2/len(T); k=np.argsort(F)[::-1][:6]; print('   left, mech order: '+', '.join(f'{q}:{F[q]:.4f}' for q in k))
    F=np.abs(np.fft.rfft(S-S.mean()))*2/len(T); k=np.argsort(F)[::-1][:6]; print('   sine, mech order: '+', '.join(f'{q}:{F[q]:.4f}' for q in k))
    return T,S
