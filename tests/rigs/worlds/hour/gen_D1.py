# motor of bounds/D_lag250_1 again (seed 1)
from sim import *
def motor():
    rng=np.random.default_rng(1); r=lambda s: s*rng.uniform(.5,1.5); ph=lambda: rng.uniform(0,TP); K=.412
    return Motor(5,K,{1:(1,0),5:(r(.02),ph()),7:(r(.01),ph()),11:(r(.004),ph()),13:(r(.003),ph())},
       {60:(r(.025),ph()),12:(r(.012),ph()),10:(r(.008),ph()),120:(r(.003),ph())},zero_e=0,coul=.04,visc=.0003,J=3e-4,sat=0)
