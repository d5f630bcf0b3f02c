from mkC6 import *
# continuous angle, no jump, real reversal
b2=sim(f'T=13 rpm=-30 open=1 seed=2 skip=0 m0={m0}')
std('C/ff_cont.csv',[f,b2],gap=0.05);std('C/ff_contpause.csv',[f,b2],pause=True)
std('C/ff_one_fwd_l.csv',[f,l],gap=3)
