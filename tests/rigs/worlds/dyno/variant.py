# variants of a world: python3 var.py KIND SEED OUT 'python statements on c'
import sys,json,random,os
sys.path.insert(0, sys.path[0]); import world as W
kind,seed,out,code=sys.argv[1],int(sys.argv[2]),sys.argv[3],sys.argv[4]
f=W.KINDS[kind]
def g(rng):
    c=f(rng); exec(code,dict(c=c,W=W,math=W.math)); return c
W.KINDS[kind]=g; W.generate(kind,seed,out)
