# 250 W motor, 8 pole pairs 9?->24 slots; reaction torque by lever 150 mm and load cell in g (HX711, 80 Hz), turned by a geared motor at 2 rpm
from sim import *
rng=np.random.default_rng(7)
K=0.075
def motor():
    return Motor(7,K,{1:(1,0),5:(.03,.2),7:(.015,2.5)},{84:(.012,.5),12:(.006,-.7),14:(.004,1.1)},zero_e=math.radians(200),coul=.006,visc=0,J=2.5e-5)
if __name__=='__main__':
    m=motor()
    for nm,I,rpm in (('0A',0,1.5),('0A_rev',0,-1.5),('5A',5,1.5),('10A',10,1.5),('15A',15,-1.5)):
        t=np.arange(0,100,1/80); th=rpm*TP/60*t
        a,b,c=phases(I,0,m.pp*th+m.z)
        M=m.torque(th,a,b,c)-np.sign(rpm)*m.coul
        F=M/.15/9.80665*1000*1.0 - 40 + rng.normal(0,1.0,len(t)) # gram force, tare not nulled
        with open(f'd_lever/{nm}.csv','w') as f:
            f.write('millis,enc_counts,load_g,iq_set\n')
            for k in range(len(t)): f.write(f'{int(t[k]*1000)},{int(th[k]/TP*4000)%4000},{F[k]:.1f},{I}\n')
