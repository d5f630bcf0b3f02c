L={}
def add(n,**k): L[n]=k
I0=('idle_f',0,60); I1=('idle_b',0,-60)
for key,mot,mode in (('1','ipm','mtpa'),('2','ipm','id0'),('1b','ipm2','mtpa'),('2b','ipm2','id0'),('3','spm','id0'),('4','syr','mtpa')):
    r={'ipm':200,'ipm2':200,'spm':5,'syr':20}[mot]
    def ld(f,rpm=60,s=1): return (f"load{int(f*100)}{'b' if rpm<0 else ''}{'n' if s<0 else ''}",s*f*r,rpm)
    z={'ipm':.5,'ipm2':.5,'spm':.05,'syr':.05}[mot]
    b=dict(mot=mot,mode=mode)
    full=[I0,I1,ld(.3),ld(.6),ld(1)]
    add(key+'_base',runs=full,**b)
    add(key+'_noise2',runs=full,noise=2,**b)
    add(key+'_replaced',runs=[I0,I1,ld(.45),ld(.6),ld(1)],**b)
    add(key+'_less',runs=[I0,I1,ld(.5),ld(1)],**b)
    add(key+'_more',runs=full+[ld(.8)],**b)
    add(key+'_two',runs=[I0,ld(1)],**b)
    add(key+'_three',runs=[I0,ld(.5),ld(1)],**b)
    add(key+'_back',runs=[I0,ld(.3),ld(1),ld(.6,-60,-1)],**b)
    add(key+'_brake',runs=[I0,I1,ld(.5),ld(1),ld(.7,-60,1)],**b)
    add(key+'_sens',runs=full,gain=.005,zero=z,lag=.001,**b)
    add(key+'_sens2',runs=[I0,('idle_b',0,-30),ld(.3,30),ld(.6,90),ld(1,60)],gain=.005,zero=z,lag=.001,**b)
    add(key+'_1k3',runs=[I0,I1,ld(.4),ld(.8)],fs=1000,turns=3,gain=.005,zero=z,**b)
# second round
B=dict(L)
def var(src,suffix,**k):
    b=dict(B[src]); b.update(k); L[src+suffix]=b
R2=[]
before=set(L)
for s in ('1b_1k3','1_brake','3_base'): var(s,'_s2',seed=2)
for s in ('1_brake','1b_more','3_base'):
    var(s,'_warm',warm=8.)        # magnets 8 K warmer from log to log
    var(s,'_half',args=['--torque',{'1':'45','1b':'45','3':'0.45'}[s.split('_')[0]]])
    var(s,'_dq',form='dq')
    var(s,'_bench',bench=.003)    # coupling: 0.3 % of the rated torque once a turn
    var(s,'_enc0',enc=0.)
for s in ('1_less','1b_three','2_base','3_brake'): var(s,'_enc0',enc=0.)
class_=None
L['5_base']=dict(B['4_base'],mot='syw'); L['5_less']=dict(B['4_less'],mot='syw'); L['5_sens2']=dict(B['4_sens2'],mot='syw')
R2=[n for n in L if n not in before]
# third round
before=set(L)
for k in (3,4,5,6,7,8): var('3_base',f'_s{k}',seed=k)
for k in (3,4,5,6): var('1_less',f'_s{k}',seed=k)
for k in (3,4,5): var('1_base',f'_s{k}',seed=k)
var('2_base','_t60',args=['--torque','60'])
var('2_base','_work4',args=['--work','4'])
var('2_base','_next',runs=B['2_base']['runs']+[('n1',-200,15),('n2',200,-15),('n3',-200,-15)])
R3=[n for n in L if n not in before]
