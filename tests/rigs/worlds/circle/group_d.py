from bench import *
A=['--pole-pairs','22','--torque-constant','3.4','--slots','48','--rated-current','8','--torque','10']
S=lambda **k:Plant('ring',**k)
B={}
k=dict(play_rpm=5)
B['d01']=lambda i:circle(i,S(),slow(S(),r=3,turns=1.2,fmt='plc',hz=250),A,note='ring motor, PLC, 3 rpm fwd/back',sensor=False,**k)
B['d02']=lambda i:circle(i,S(),slow(S(),r=3,turns=1.2,fmt='moteus',hz=250)+slow(S(),r=3,turns=1.2,fmt='moteus',hz=250,brake=8,name='brake8',seed=5),A,note='ring, none + brake 8 Nm',sensor=False,**k)
B['d03']=lambda i:circle(i,S(),slow(S(),r=1,turns=.3,fmt='moteus',hz=250),A,note='0.3 turns only',sensor=False,**k)
B['d04']=lambda i:circle(i,S(),loads(S(),r=5,turns=3,hz=300),A,note="ring, torque sensor, idle + 3 loads, 5 rpm",again=False,**k)
B['d05']=lambda i:circle(i,S(),loads(S(),r=5,turns=4,hz=300,hunt=.1,fhunt=.7,hunt1=.08),A,again=False,note='load machine hunts 10 % and once a turn',**k)
B['d06']=lambda i:circle(i,S(),loads(S(),levels=(0,),r=5,turns=4,hz=500),A,note='ring idle only',**k)
B['d07']=lambda i:circle(i,S(),dyno(S(),'open',0,0,30,turns=4,fmt='daqv',hz=4000,open=1)+loads(S(),levels=(0,.5),r=5,turns=4,hz=500),A,note='open-terminal voltages + idle + one load',**k)
SC=lambda **k:Plant('cobot',**k)
AC=['--pole-pairs','10','--torque-constant','0.11','--slots','24','--rated-current','9','--torque','0.4']
def gear(ls,n): 
    for f,fm,o in ls: o[:,2]/=n;o[:,3]/=n
    return ls
B['e01']=lambda i:circle(i,SC(),slow(SC(),fmt='moteus'),AC,note='cobot joint, motor encoder, gear mesh 4 mNm at 2.02/turn, fwd/back',sensor=False,play_rpm=30)
B['e02']=lambda i:circle(i,SC(),gear(slow(SC(),fmt='moteus',r=100,turns=20),50),AC,note='angle behind a gear 1:50',sensor=False,play_rpm=30)
B['e03']=lambda i:circle(i,SC(mesh=0),loads(SC(mesh=0),fmt='daqdq',hz=2000,turns=6),AC,note='cobot motor on dyno, idle + 3 loads',fmt2='daqdq')
B['e04']=lambda i:circle(i,SC(mesh=0),slow(SC(mesh=0),fmt='odrive'),['--pole-pairs','10','--torque-constant','0.155','--slots','24','--rated-current','9','--torque','0.4'],note='K_t of the sheet is per A rms, given as peak',sensor=False,play_rpm=30)
if __name__=='__main__': main(B)
