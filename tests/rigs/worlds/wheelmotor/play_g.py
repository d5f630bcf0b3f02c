import sys
from play import *; from gen import *
for o in sys.argv[1:]: judge(o,G,SG,w=0.21)
