from mkA4 import std
from mkA import sim,dewesoft
import numpy as np
for n,x in {'real':'','lag0':'lag=0','aaf0':'aaf=0','nogain':'ga=0 gb=0 gc=0','nooff':'oa=0 ob=0 oc=0','noe2':'e2=0','toff0':'toff=0 tdrift=0','lagonly':'ga=0 gb=0 gc=0 oa=0 ob=0 oc=0 e2=0 aaf=0 tdrift=0 toff=0 tnoise=0.03'}.items():
    for m,iq in(('l60',53),('gen60',-53)):
        a=sim(f'T=5.5 rpm=60 id=-28 iq={iq} seed=9 '+x);std(f'A4/q_{n}_{m}.csv',a)
        if n=='real': dewesoft(f'A4/q_dew_{m}.txt',a)
        if n=='real': a['menc']=a['menc']%(2*np.pi);std(f'A4/q_wrap_{m}.csv',a)
