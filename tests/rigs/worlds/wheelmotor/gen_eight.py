"""the eight runs of docs/measuring.md on the servo: 20 A = 100 %; slow 30, fast 150 rpm"""
from gen_servo import *
import numpy as np
def g(n,I,gam,rpm,turns,seed,t0,fs=2000): rec('s/eight/%s.csv'%n,I*np.cos(gam),-I*np.sin(gam),rpm,turns,seed,t0,fs)
g('1_zero_forward',0,0,30,10,1,0); g('2_zero_backward',0,0,-30,10,2,60); g('3_full_slow',20,0,30,10,3,120)
g('4_half_lead_fast',10,.6,-150,20,4,180); g('5_full_lag_fast',20,-.4,150,20,5,240); g('6_full_brake_slow',20,np.pi,-30,10,6,300)
g('7_quarter_fast',5,0,150,20,7,360); g('8_held_out',15,.3,-75,20,8,420)
