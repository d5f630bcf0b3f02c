"""replay.py: the same tables, read over the encoder as it quantises (mean half a count late), against the bound"""
import re,glob,os
from bounds import *
import play
for fold in sorted(glob.glob('bounds/*_*')):
    if not os.path.exists(fold+'/out/table/tuned.c') or 'exc_' in fold: continue
    tag=os.path.basename(fold); seed=int(tag.split('_')[-1])
    import json; s=open(fold+'/out/report.html').read(); b=re.search(r'at most ([\d.e-]+) N',s)
    if not b: continue
    b=float(b.group(1)); rng=np.random.default_rng(seed); sat=1e-3 if 'B_sat' in tag else 0
    m=make(rng,'scratch',[],0,sat,0)
    N=60000; th=np.arange(N)/N*TP; r=[]
    for sens in (th, th-.5/10000*TP, np.floor(th/TP*1e4)/1e4*TP):
        the=m.pp*sens; d,q=play.currents(fold+'/out',the); M=m.torque(th,*phases(q,d,the)); r.append(np.ptp(M))
    print(f'{tag:16s} bound {b:.4f} truth {r[0]:.4f} half a count {r[1]:.4f} with steps {r[2]:.4f}', 'BROKEN x%.1f'%(min(r)/b) if min(r)>b else '')
