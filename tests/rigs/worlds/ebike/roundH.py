import numpy as np, sys, recordH, motors
from motors import *; from playH import cur, corrected
h=recordH.h
fo=sys.argv[1]; tag=sys.argv[2]; logcorr=sys.argv[3]=='logcorr'
c,m=cur(fo)
orig=H.angle_read
def patched(s,thm):  # drive whose angle is corrected in the firmware, log too
    return corrected(orig(s,thm),m)
if logcorr:
    H.angle_read=patched
    from table import load; f,per,_=load(fo+'/table'); cc=lambda a:f(a,per)
else:
    cc=c
    so=recordH.sensors_H
    def sens(s,thm,dm,qm):
        th_r=s.p*corrected(orig(s,thm),m); mm=abc(th_r,dm,qm); t=[(mm[k]-s.off[k])/s.gain[k] for k in range(3)]; z=sum(t)/3
        return dq(s.p*thm,*[x-z for x in t])
    recordH.sensors_H=sens
recordH.run(tag+'_6',1,6,45,21,cur=cc); recordH.run(tag+'_12',1,12,30,22,cur=cc)
if not logcorr: recordH.run('zurueck30',-30,-6,45,23)
