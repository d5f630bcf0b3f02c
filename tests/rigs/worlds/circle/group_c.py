from bench import *
A=['--pole-pairs','4','--flux','0.075','--slots','48','--rated-current','250','--resistance','0.012','--torque','60']
S=lambda **k:Plant('ipm',**k)
B={}
B['c01']=lambda i:circle(i,S(),loads(S(),r=100,fmt='daqdq'),A,note='IPM, id=0, idle + 3 loads',fmt2='daqdq')
B['c02']=lambda i:circle(i,S(),loads(S(),levels=(0,.3,.6,.6,.9),ids=(0,-.3,0,-.5,.2),r=100),A,note='IPM, loads with several id')
B['c03']=lambda i:circle(i,S(),loads(S(),levels=(0,.2,.4),r=100),A[:-1]+['100'],note='table far above what was recorded')
B['c04']=lambda i:circle(i,S(offe=.1,zlog=.025),loads(S(offe=.1,zlog=.025),levels=(0,.3,.6,.6,.9),ids=(0,-.3,0,-.5,.2),r=100),A,note='resolver zero 0.1 rad el off, several id')
B['c05']=lambda i:circle(i,S(),loads(S(),levels=(0,.3,.6,.9),ids=(0,-.15,-.4,-.6),r=100,fmt='simulink'),A,note='MTPA-like currents only, Simulink names')
B['c06']=lambda i:circle(i,S(),loads(S(),levels=(0,.3,.6,.9),r=100),A,runs=[2],init=['--pole-pairs','4','--flux','0.075','--slots','48','--rated-current','250','--resistance','0.012'],note='MACHINE --runs with holdout') if False else circle(i,S(),loads(S(),levels=(0,.3,.6,.9),r=100),['--torque','60'],runs=[2],init=['mot','--pole-pairs','4','--flux','0.075','--slots','48','--rated-current','250','--resistance','0.012'][1:],note='MACHINE --runs with holdout')
B['c07']=lambda i:circle(i,S(Trise=50,Ttau=1e-3),loads(S(Trise=0),levels=(0,.3,.6,.9),r=100),A,note='recorded cold, played 50 K warmer',play=S(Trise=50,Ttau=1e-3))
if __name__=='__main__': main(B)
