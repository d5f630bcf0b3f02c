from mkC import *
import sys
V={'plain':'ga=0 gb=0 oa=0 ob=0 toff=0 tgain=0 e1=0 lag=0','nogain':'ga=0 gb=0 tgain=0','noecc':'e1=0','nolag':'lag=0','nooff':'oa=0 ob=0 toff=0'}
for v,x in V.items():
    for n,r in (('leer','rpm=30 open=1 seed=1'),('l4','rpm=30 iq=4 seed=4')): de(f'C/v_{v}_{n}.csv',[sync(sim('T=13 '+r+' '+x))])
