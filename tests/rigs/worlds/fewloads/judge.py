import numpy as np,json,csv,re,os
from motors import *
def corrections(out):
    c={}
    f=out+'/diagnose/machine/effects.csv'
    if os.path.exists(f):
        for r in csv.DictReader(l for l in open(f) if not l.startswith('#')):
            if r['effect'] in('position_offset','position_eccentricity','position_harmonics','current_offset','current_gain'): c[(r['effect'],r['parameter'])]=float(r['value'])
    return c
def machine_effects(c,te,p):
    x=c.get(('position_offset','angle'),0)+0*te
    for (e,k),v in c.items():
        if e=='position_eccentricity':
            n=float(k.split('_')[-1]); x=x+p*v*(np.sin if 'sine' in k and 'cosine' not in k else np.cos)(n*te/p)
        if e=='position_harmonics':
            n=float(k.split('_')[-1]); x=x+v*(np.sin if 'cosine' not in k else np.cos)(n*te)
    return x
def play(m,out,info,N=1440,emitted=False):
    """as told: the drive corrects angle and currents by what tune found; g, z are the true errors of the sensors"""
    c=corrections(out); te=np.linspace(0,2*np.pi*m.p,N*m.p,endpoint=False)
    tl=te+np.radians(info['enc'])            # what the encoder reads
    tc=tl-machine_effects(c,te,m.p)          # corrected
    if emitted:
        s=open(out+'/table/tuned.c').read(); h=open(out+'/table/tuned.h').read()
        per=int(re.search(r'2\^32 = (\d+) electrical',h).group(1)) if 'electrical turns (period' in h else 1
        n=int(re.search(r'Size:\s+(\d+) points',h).group(1))
        b=s[s.index('{'):]; v=[float(x.rstrip('f')) for x in re.findall(r'-?\d+\.\d*(?:e[-+]?\d+)?f|-?\d+e[-+]?\d+f',b)]
        v=np.array(v[:2*(n+1)]).reshape(-1,2); x=(tc/(2*np.pi*per))%1*n; k=np.floor(x).astype(int); fr=x-k
        d,q=[(1-fr)*v[k,j]+fr*v[k+1,j] for j in (0,1)]; i=ph(d,q,tc)
    else:
        i=[0*te for _ in range(3)]
        for r in csv.DictReader(l for l in open(out+'/currents/currents.csv') if not l.startswith('#')):
            n=float(r['order']); n=round(n*m.p)/m.p; A=float(r['amplitude_A']); f=float(r['phase_rad']); S=r['set']
            for s in range(3):
                sg={'pos':1,'asym':1,'neg':-1,'zero':0}.get(S); sg=(round(n)%3) if S=='sym' else sg
                i[s]=i[s]+A*np.sin(n*tc+f-sg*2*np.pi*s/3)
    g=info['gain']*np.array([1,-.6,.4]); z=info['zero']*np.array([1,-.7,.3])
    i=[(i[s]*(1+c.get(('current_gain','abc'[s]),0))+c.get(('current_offset','abc'[s]),0)-z[s])/(1+g[s]) for s in range(3)]
    i0=sum(i)/3; i=[x-i0 for x in i]
    D,Q=dq(i,te); T=m.T(D,Q,te); return T,D,Q
def sine(m,mode,enc,Tw,N=1440):
    te=np.linspace(0,2*np.pi*m.p,N*m.p,endpoint=False)
    lo,hi=0,m.Ir*3; sg=np.sign(Tw)
    for _ in range(40):
        I=(lo+hi)/2; d,q=direction(m,mode,I,sg); D,Q=dq(ph(d,q,te+np.radians(enc)),te); T=m.T(D,Q,te)
        if abs(T.mean())<abs(Tw): lo=I
        else: hi=I
    return T,I
def pp(x): return x.max()-x.min()
