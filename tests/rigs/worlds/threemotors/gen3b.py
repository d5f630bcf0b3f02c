from gen3 import *
log3('m3/n_idle_r5.csv',0,-5,T=120.); log3('m3/n_idle_r20.csv',0,-20,T=30.)
import math
log3('m3/n_lead.csv',math.hypot(3.95,5.77),5,T=120.,ang=math.atan2(3.95,5.77))
