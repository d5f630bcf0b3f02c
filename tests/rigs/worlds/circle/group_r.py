from bench import *
# what makes the clean benches fail: direction of the third run, encoder, hunting, alias
A=['--pole-pairs','5','--torque-constant','0.368','--slots','12','--rated-current','3.7','--torque','0.7']
AI=['--pole-pairs','4','--flux','0.075','--slots','48','--rated-current','250','--resistance','0.012','--torque','60']
B={}
def mk(name,args,hz,back,sgn,r,**k):
    def f(i):
        P=Plant(name,**k);I=P.m['rated'];ls=[]
        for n,l in enumerate((0,.33,.66,1.)):
            b=-1 if (n==2 and back) else 1
            ls+=dyno(P,'load%d'%round(100*l),l*I*(sgn if b<0 else 1),0,r*b,hz=hz,seed=n+3,turns=12)
        return circle(i,P,ls,args,note='%s %d Hz back %s sign %d %s'%(name,hz,back,sgn,k),again=False)
    return f
B['r_s_fwd']=mk('servo',A,2000,False,1,60)
B['r_s_mot']=mk('servo',A,2000,True,-1,60)
B['r_s_gen']=mk('servo',A,2000,True,1,60)
B['r_i_fwd']=mk('ipm',AI,1000,False,1,100)
B['r_i_mot']=mk('ipm',AI,1000,True,-1,100)
B['r_i_enc']=mk('ipm',AI,1000,True,1,100,counts=2**20,ecc=0)
B['r_i_hunt']=mk('ipm',AI,1000,True,1,100,hunt=0,hunt1=0)
B['r_i_alias']=mk('ipm',AI,1000,True,1,100,alias=0)
B['r_i_Tc']=mk('ipm',AI,1000,True,1,100,Tc=.06,Ts=.07)
if __name__=='__main__': main(B)
