"""more.py: further seeds and loads, for bounds.py"""
from bounds import *
B=[(0,20),(0,-20),(3,20),(6,20)]; D=[(0,20),(3,20),(6,20)]; A2=[(0,20),(0,-20),(4,20),(6,-20)]
for s in (4,5,6,7): one('D_lag250',s,D,lag=250)
for dr in (.005,.01): one('B_drift%g'%dr,1,B,drift=dr)
for s in (1,2): one('A2_lag250',s,A2,lag=250); one('D_nolag',s,D)
B=[(0,20),(0,-20),(3,20),(6,20)]; T5=[(0,60),(.7/.412,60),(1.4/.412,-60),(2.1/.412,60),(1/.412,300)]
for s in (1,2,3): one('B_excc',s,B,exc=math.radians(.15))
for s in (1,2,3): one('T5_lag250',s,T5,lag=250)
for s in (4,5,6): one('B_lag100',s,B,lag=100); one('B_sat',s,B,lag=250,sat=1e-3)
D=[(0,20),(3,20),(6,20)]; A=[(0,20),(4,20),(6,-20)]; A3=[(0,20),(0,-20),(4,20),(6,-20)]
for s in range(8,20): one('D_lag250',s,D,lag=250)
for s in range(1,5): one('D_nolag',s,D)
for s in range(3,6): one('A3',s,A3,lag=250)
