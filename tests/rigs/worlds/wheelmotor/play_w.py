import sys
from play import *; from gen import *
for o in sys.argv[1:]:
    a=o.split('@'); judge(a[0],Wm,SW,w=.314)
