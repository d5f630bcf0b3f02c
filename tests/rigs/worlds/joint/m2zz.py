import sys; import m2
for z in (0.042,0.045,0.05,0.06): m2.record('m2z/fast_%g.csv'%z,5,200,2.4,seed=7,zero=z)
m2.record('m2z/third_z.csv',3,40,6,seed=3,dec=2,zero=0.06)
