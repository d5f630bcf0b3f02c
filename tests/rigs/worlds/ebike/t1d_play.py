from playH import *
c,m=cur('H/t1d'); mm={k:v for k,v in m.items() if not k.startswith('I')}
for nm,mmm,off in (('corrected as the report says',m,None),('currents not corrected',mm,None),('sensors nulled at start',mm,(0,0,0))):
    if off: H.off=off
    T,o=truth('',c,mmm,True); print(nm,'mean %.2f pp %.3f'%(T.mean(),np.ptp(T)),o[:3])
H.off=(.35,-.20,.10)
T,o=truth('',lambda r:(0*r,0*r+19.4),m); print('plain sine with those corrections pp %.3f'%np.ptp(T))
c,m=cur('H/t1'); H.off=(0,0,0); T,o=truth('',c,m,True); print('first table, sensors nulled: pp %.3f'%np.ptp(T))
