import sys; import m1,play,numpy as np,math
# table as feed-forward on a grid of the encoder angle
f=sys.argv[1]; out=sys.argv[2]; load=float(sys.argv[3])
n=65536; g=np.arange(n)*2*np.pi/n
te,d,q,o,ga=play.table(f,g,21,False)
D=d.tolist();Q=q.tolist()
orig=m1.torque_el; st={}
def tq(idq,th):
    e=m1.enc(th); k=int((e/(2*math.pi)%1)*n)%n
    a=(D[k],idq[1]+Q[k]); st['k']=k
    return orig(a,th)
m1.torque_el=tq
pr,dd=m1.trap(8/60,1.3)
rows=m1.run(pr,dd,480,seed=31,load=lambda t,th:load)
with open(out,'w') as fo:
    fo.write('time,pos_estimate,vel_estimate,Iq_measured,Iq_setpoint,vbus_voltage\n')
    for r in rows:
        k=int((r[1]%1)*n)%n
        r=list(r); r[3]+=Q[k]; r[4]+=Q[k]
        fo.write('%.4f,%.6f,%.5f,%.4f,%.4f,%.2f\n'%tuple(r))
