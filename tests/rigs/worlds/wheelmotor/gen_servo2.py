from gen_servo import *
import gen_servo
rec('s/n_leer_vor.csv',0,0,7.5,10,31,600,fs=500)
rec('s/n_leer_rueck.csv',0,0,-7.5,10,32,700,fs=500)
rec('s/n_feld.csv',16.5,-11.2,7.5,10,33,800,fs=500)
rec('s/n_last14_rueck.csv',14,0,-30,6,34,900)
rec('s/x_last20.csv',20,0,30,6,105,240)
rec('s/x_last14.csv',14,0,30,6,104,240)
rec('s/last10.csv',10.5,0,30,6,106,240)
