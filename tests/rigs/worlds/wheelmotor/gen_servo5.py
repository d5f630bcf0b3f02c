from gen_servo import *
import gen_servo
old=gen_servo.sweep
for d,tau in (('lag',.004),('lag2',.0025)):
    def f(*a,**k): k['tau']=tau; return old(*a,**k)
    gen_servo.sweep=f
    rec(f's/{d}/leer_vor.csv',0,0,30,6,1); rec(f's/{d}/leer_rueck.csv',0,0,-30,6,2,60)
    rec(f's/{d}/last07.csv',7,0,30,6,3,120); rec(f's/{d}/last14.csv',14,0,30,6,4,180); rec(f's/{d}/last20.csv',20,0,30,6,5,240); rec(f's/{d}/last14b.csv',14,0,-30,6,6,300)
