import sys
from play import *; from gen import *
# the zero: the table of a run without --angle-offset is played over the angle of the logs (+ correction found)
for o in sys.argv[1:]:
    a=o.split('@'); judge(a[0],S,SS,w=3.14,idq=float(a[1]) if len(a)>1 else 0.,extra=np.radians(float(a[2])) if len(a)>2 else 0.)
