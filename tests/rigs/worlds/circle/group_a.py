from bench import *
A=['--pole-pairs','7','--kv','270','--slots','12','--rated-current','12','--torque','0.15']
I=['--inertia','4e-5']
S=lambda **k:Plant('outrunner',**k)
B={}
k=dict(sensor=False,play_rpm=30)
B['a01']=lambda i:circle(i,S(zlog=.3),slow(S(zlog=.3)),A,note='outrunner, ODrive log, slow fwd/back at 10 rpm',fmt2='odrive',**k)
B['a02']=lambda i:circle(i,S(ecc=.015),slow(S(ecc=.015)),A,note='magnet encoder eccentric 0.015 rad (0.1 rad el)',**k)
B['a03']=lambda i:circle(i,S(),slow(S(iqsign=-1)),A,note='i_q logged with other sign',**k)
B['a04']=lambda i:circle(i,S(),slow(S(oneway=1),turns=1.4),A+I+['--holding'],note='one direction only, --inertia --holding',**k)
B['a05']=lambda i:circle(i,S(offe=.3,zlog=.1),slow(S(offe=.3,zlog=.1)),A,note='commutation 0.3 rad el off',fmt2='odrive',**k)
B['a06']=lambda i:circle(i,S(aoffa=.15,aoffb=-.1),slow(S(aoffa=.15,aoffb=-.1)),A,note='current offsets 0.15 A, -0.1 A',**k)
B['a07']=lambda i:circle(i,S(Ts=.02,Tc=.012,ws=.3),slow(S(Ts=.02,Tc=.012,ws=.3),r=2,turns=1.2,speedbw=3),A,note='stick-slip at 2 rpm, soft loop',**k)
B['a08']=lambda i:circle(i,S(),slow(S(),r=60,turns=8),A,note='60 rpm, too fast',**k)
B['a09']=lambda i:circle(i,S(),slow(S(),fmt='simplefoc'),A,note='SimpleFOC monitor tab, current.q in mA',**k)
B['a10']=lambda i:circle(i,S(),slow(S(),fmt='vesc'),A,note='VESC Tool',**k)
B['a11']=lambda i:circle(i,S(),slow(S(),fmt='moteus')+slow(S(),fmt='moteus',brake=.1,name='brake1',seed=4)+slow(S(),fmt='moteus',brake=.2,name='brake2',seed=5),A,note='moteus, none + brake 0.1 + 0.2 Nm',**k)
B['a12']=lambda i:circle(i,S(),slow(S(),fmt='moteus')+slow(S(),fmt='moteus',brake=.2,name='brake2',seed=5),['--pole-pairs','7','--kv','330','--slots','12','--rated-current','12','--torque','0.15'],note='Kv of the sheet 22 % high; brake',**k)
B['a13']=lambda i:circle(i,S(counts=1024),slow(S(counts=1024),fmt='simplefoc2'),A,note='encoder of 1024 counts',**k)
B['a14']=lambda i:circle(i,S(),slow(S(),turns=.4,r=15),A,note='0.4 turns only',**k)
B['a15']=lambda i:circle(i,S(),slow(S(),fmt='plc',hz=50,r=5,speedbw=100),A,note='PLC trend 50 Hz, 5 rpm',**k)
B['a16']=lambda i:circle(i,S(),slow(S()),['--pole-pairs','14','--kv','270','--slots','12','--rated-current','12','--torque','0.15'],note='poles for pole pairs',**k)
B['a17']=lambda i:circle(i,S(elag=.004),slow(S(elag=.004),r=15),A,note='encoder filter 4 ms',**k)
if __name__=='__main__': main(B)
