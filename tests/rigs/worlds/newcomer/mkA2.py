from mkA import *
import os
os.makedirs('A2',exist_ok=True)
D={'idle_cw':'rpm=60 open=1 T=10.5 seed=1','load30_cw':'rpm=60 id=-10 iq=28 T=10.5 seed=3','load60_cw':'rpm=60 id=-28 iq=53 T=10.5 seed=4'}
import mkA
for n,r in D.items():
    dewesoft(f'A2/nolag_{n}.txt',sim(r+' lag=0 aaf=0'))
    a=sim(r)
    dewesoft(f'A2/mag_{n}.txt',a,zero=-np.pi/4)       # zero of angle on the magnets
    dewesoft(f'A2/z37_{n}.txt',a,zero=np.radians(37)/4)
    dewesoft(f'A2/neg_{n}.txt',a,torque=-1)
    dewesoft(f'A2/vw_{n}.txt',a,cols=('ia','ic','ib'))
    dewesoft(f'A2/vwonly_{n}.txt',a,cols=('ia','ic','ib') if n=='load60_cw' else ('ia','ib','ic'))
    # Ziel: without W, without torque, without angle
    L=open(f'A/{n}.txt',encoding='latin-1').read().split('\n')
    def cut(c,f):
        with open(f,'w',encoding='latin-1') as g:
            for i,l in enumerate(L):
                x=l.split('\t')
                g.write(('\t'.join(x[:c]+x[c+1:]) if len(x)>5 else l)+'\n')
    cut(4,f'A2/noW_{n}.txt');cut(5,f'A2/notorque_{n}.txt');cut(1,f'A2/noangle_{n}.txt')
    # names nobody knows
    open(f'A2/names_{n}.txt','w',encoding='latin-1').write('\n'.join(L).replace('Rotor angle (deg)','AI 7 (deg)').replace('Torque (Nm)','T40B/HBM (Nm)'))
