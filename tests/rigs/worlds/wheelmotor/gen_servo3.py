from gen_servo import *
import gen_servo, gen
old=gen_servo.sweep
def nodrift(*a,**k): k['tdrift']=0; k['tzero']=.15; return old(*a,**k)
gen_servo.sweep=nodrift
rec('s/z_feld.csv',16.5,-11.2,7.5,10,33,0,fs=500)
rec('s/z_leer_vor.csv',0,0,7.5,10,31,0,fs=500)
rec('s/z_leer_rueck.csv',0,0,-7.5,10,32,0,fs=500)
rec('s/z_feld5.csv',16.5,-11.2,7.5,5,33,0,fs=500)
gen_servo.sweep=old
rec('s/y_feld30.csv',16.5,-11.2,30,10,33,0)
rec('s/y_feld2.csv',16.5,-11.2,30,6,33,0)
rec('s/y_feld3.csv',14,-9,7.5,6,33,0,fs=500)
