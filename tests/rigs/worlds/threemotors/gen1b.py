from gen1 import *
import os; os.makedirs('m1n',exist_ok=True)
import math
log1('m1n/n1.csv',125,0,-15,T=41,fs=1000); log1('m1n/n2.csv',125,np.pi,-15,T=41,fs=1000)
log1('m1n/n3.csv',125,-math.atan2(70.5,103),15,T=41,fs=1000); log1('m1n/n4.csv',125,np.pi,15,T=41,fs=1000)
