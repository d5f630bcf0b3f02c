import gen3; from gen3 import *; import copy
m=copy.copy(M3); m.cogm=[(36,.05,1.9),(72,.02,-2.),(9,.02,2.)]; m.hd=[(6,-.0008,1.)]; m.psi=M3.psi*1.05
log3('mis/other4.csv',4,20,drift=.0003,mot=m)
