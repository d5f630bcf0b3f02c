from bench import *
A=['--pole-pairs','5','--torque-constant','0.368','--slots','12','--rated-current','3.7','--torque','0.7']
B={}
def mk(kw):
    return lambda i:circle(i,Plant('servo',**kw),loads(Plant('servo',**kw)),A,note=str(kw),sensor=False)
for n,kw in {'x_sat0':dict(satm=0),'x_uneven0':dict(uneven=[]),'x_alias0':dict(alias=0),'x_ecc0':dict(ecc=0),'x_hunt0':dict(hunt=0,hunt1=0),'x_fang0':dict(fang=0),'x_l60':dict(l6=0,c3=0),'x_tsl0':dict(tsl=0)}.items(): B[n]=mk(kw)
B['x_ripp']=lambda i:circle(i,Plant('servo'),loads(Plant('servo'),levels=(0,.33,.5,.66,1.)),A,note='five runs',sensor=False)
if __name__=='__main__': main(B)
