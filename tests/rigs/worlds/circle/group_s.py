from bench import *
# sweep: how much saturation of the torque constant (per cent lost at the largest load) breaks the diagnosis; everything else the clean servo bench / IPM
A=['--pole-pairs','5','--torque-constant','0.368','--slots','12','--rated-current','3.7','--torque','0.7']
B={}
def mk(pc,fang,lv):
    sm=pc/100/(1-pc/100)/3.7**2
    P=Plant('servo',satm=sm,fang=fang)
    return lambda i:circle(i,P,loads(P,levels=lv),A,note='servo, torque per ampere falls %g %% at full current, friction varies %g %% in a turn, %d loads'%(pc,fang*100,len(lv)),again=False)
for pc in (.3,.7,1.4,3,6,10): B['s%g'%pc]=mk(pc,.05,(0,.33,.66,1.))
B['s6_6']=mk(6,.05,(0,.2,.4,.6,.8,1.))
AI=['--pole-pairs','4','--flux','0.075','--slots','48','--rated-current','250','--resistance','0.012','--torque','60']
def mi(**k):
    P=Plant('ipm',**k); return lambda i:circle(i,P,loads(P,r=100),AI,note='ipm '+str(k),again=False)
B['i_nosat']=mi(satm=0,satq=0)
B['i_sat1']=mi(satm=1.6e-7)
B['i_tsl0']=mi(tsl=0)
B['i_tsl0_nosat']=mi(tsl=0,satm=0,satq=0,l6=0,c3=0)
def m2(hz,turns,**k):
    P=Plant('servo',**k);return lambda i:circle(i,P,loads(P,hz=hz,turns=turns),A,note='servo clean, %d Hz, %d turns '%(hz,turns)+str(k),again=False)
B['h2000']=m2(2000,12)
B['h2000_10']=m2(2000,10)
B['h1000_12']=m2(1000,12)
if __name__=='__main__': main(B)
