import sys, recordS
from recordS import *; import playS
c=playS.cur('S/t3',-149.198)
for nm,rpm,dur,seed in (('tab60',60,4,51),('tab60b',60,4,53)):
    recordS.run(nm,1,0,rpm,dur,seed,cur=c)
    L=open(f'S/load/{nm}.csv').read().split('\n')
    for k in range(7,len(L)):
        if L[k]: q=L[k].split(','); q[4]='%.5f'%(float(q[4])%10); L[k]=','.join(q)
    open(f'S/m_load/{nm}.csv','w').write('\n'.join(L))
