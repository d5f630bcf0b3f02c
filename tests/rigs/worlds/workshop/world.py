import numpy as np, os, csv
TP=2*np.pi
class M:  # a machine, own physics
    def __init__(s,p=4,emf=((1,.30,0),(5,.009,.4),(7,.006,2.8),(11,.002,1.)),cog=((6,.03,1.),(12,.02,-.6)),rated=10.,rs=0,ipm=None):
        s.p=p;s.emf=list(emf);s.cog=list(cog);s.rated=rated;s.slots=rs;s.ipm=ipm
    def e(s,th,k): return sum(E*np.sin(m*(th-TP*k/3)+f) for m,E,f in s.emf)
    def cogt(s,th): return sum(A*np.sin(n*th+f) for n,A,f in s.cog)
    def torque(s,th,ia,ib,ic):
        T=s.e(th,0)*ia+s.e(th,1)*ib+s.e(th,2)*ic+s.cogt(th)
        if s.ipm:
            d,q=dq(th,ia,ib,ic);L=s.ipm;x=q/L['Is']
            ld=L['Ld']*d+L['k']*L['Ls']*L['Is']*np.log(np.cosh(x))
            lq=L['Ls']*L['Is']*np.tanh(x)*(1+L['k']*d/L['Is'])+L['L6']*np.cos(6*th)*q
            T=T+1.5*s.p*(ld*q-lq*d)-1.5*s.p*3*L['L6']*np.sin(6*th)*q*q
        return T
    def coen(s,th,ia,ib,ic): # without cogging
        d,q=dq(th,ia,ib,ic);L=s.ipm
        return 1.5*(.5*L['Ld']*d*d+L['Ls']*L['Is']**2*np.log(np.cosh(q/L['Is']))*(1+L['k']*d/L['Is'])+.5*L['L6']*np.cos(6*th)*q*q)
def dq(th,a,b,c):
    sh=[TP*k/3 for k in range(3)]
    q=2/3*sum(i*np.sin(th-h) for i,h in zip((a,b,c),sh)); d=-2/3*sum(i*np.cos(th-h) for i,h in zip((a,b,c),sh))
    return d,q
def abc(th,d,q): return [q*np.sin(th-TP*k/3)-d*np.cos(th-TP*k/3) for k in range(3)]
class Run: pass
def go(m,r,rpm=300,iq=0.,id=0.,fs=5000,n=3000,wf=None,iqf=None,th0=None,sig_i=.01,t0=0.):
    R=Run();R.m=m;R.fs=fs;R.t=t0*0+np.arange(n)/fs
    w=rpm*TP/60*np.ones(n) if wf is None else wf(R.t)
    R.w=w;ths=r.uniform(0,TP) if th0 is None else th0
    R.th=ths+np.concatenate([[0],np.cumsum((w[1:]+w[:-1])/2)])/fs  # mechanical
    R.te=m.p*R.th
    if iqf is None: q=iq*np.ones(n);d=id*np.ones(n)
    else: d,q=iqf(R.t,R.te)
    R.i=abc(R.te,d,q); R.T=m.torque(R.te,*R.i); R.rd=None; R.si=sig_i
    return R
def noise(R,r,st=.02):
    # readings: made once, after the truth
    n=len(R.t); R.Tr=(R.Tr if hasattr(R,'Tr') else R.T)+st*r.normal(size=n)
    ir=R.ir if hasattr(R,'ir') else R.i
    a=ir[0]+R.si*r.normal(size=n);b=ir[1]+R.si*r.normal(size=n);c=ir[2]+R.si*r.normal(size=n)
    R.ir=[a,b,c]; 
    if not hasattr(R,'thr'): R.thr=R.th
    return R
def cols(R,tem=None,temp=None,wrap=True,speed=True):
    D={'time_s':R.t,'theta_m_rad':np.mod(R.thr,TP) if wrap else R.thr}
    if speed: D['speed_rad_per_s']=R.w
    D['ia_A'],D['ib_A'],D['ic_A']=R.ir; D['torque_Nm']=R.Tr
    if temp is not None: D['temperature_C']=temp
    return D
def lp1(x,fs,tau):
    a=1-np.exp(-1/fs/tau);y=np.empty_like(x);s=x[0]
    for k,v in enumerate(x): s+=a*(v-s);y[k]=s
    return y
def second(x,fs,fn,z,pre=None):
    # exact-ish: RK on 8 substeps, started in equilibrium
    w=TP*fn;h=1/fs/8;y=x[0];v=0.;o=np.empty_like(x)
    for k in range(len(x)):
        o[k]=y;x1=x[min(k+1,len(x)-1)];x0=x[k]
        for j in range(8):
            u=x0+(x1-x0)*(j+.5)/8
            f=lambda y,v:(v,w*w*(u-y)-2*z*w*v)
            k1=f(y,v);k2=f(y+h/2*k1[0],v+h/2*k1[1]);y+=h*k2[0];v+=h*k2[1]
    return o
def write(folder,m,runs,hold=(),eff=None,decl=None,rated=True,names=None):
    os.makedirs(folder+'/machine',exist_ok=True);d=decl or m
    with open(folder+'/machine/machine.csv','w') as f:
        f.write('name,value,unit\npole_pairs,%d,\n'%d.p+('rated_current,%g,A\n'%d.rated if rated else ''))
    with open(folder+'/machine/back_emf.csv','w') as f:
        f.write('order,amplitude_Nm_per_A,phase_rad\n'+''.join('%d,%.9g,%.9g\n'%x for x in d.emf))
    with open(folder+'/machine/cogging.csv','w') as f:
        f.write('order,amplitude_Nm,phase_rad\n'+''.join('%g,%.9g,%.9g\n'%x for x in d.cog))
    if eff:
        with open(folder+'/machine/effects.csv','w') as f:
            f.write('effect,parameter,value,unit,std_error\n'+''.join('%s,%s,%.9g,,\n'%x for x in eff))
    with open(folder+'/runs.csv','w') as f:
        f.write('file,role\n')
        for k,D in enumerate(runs):
            nm='run%02d.csv'%k;f.write('%s,%s\n'%(nm,'holdout' if k in hold else 'fit'))
            with open(folder+'/'+nm,'w') as g:
                ks=list(D);g.write(','.join(ks)+'\n');A=np.column_stack([D[c] for c in ks])
                np.savetxt(g,A,fmt='%.8g',delimiter=',')
SPM=lambda: M()
DR=lambda: M(p=7,emf=((1,.075,0),(5,.0012,.3),(7,.001,2)),cog=((12,.012,.5),(24,.003,1)),rated=15)
IPMp=dict(Ld=.9e-3,Ls=2.4e-3,Is=14.,k=-.06,L6=4e-5)
def IPM(): return M(p=3,emf=((1,.24,0),(5,.006,1),(7,.004,-1)),cog=((6,.02,.7),(12,.012,0)),rated=15,ipm=IPMp)
POINTS=[(150,2,0),(300,5,0),(600,8,-2),(900,3,-4),(450,-5,0),(240,-8,1),(750,6,3),(1100,10,-3),(360,0,0),(520,9,0)]
def std(m,r,pts=POINTS,st=.02,fs=5000,n=3000,rev=True,f=None,scale=1.,**k):
    out=[]
    for j,(rpm,q,d) in enumerate(pts):
        s=-1 if (rev and j%3==1) else 1
        R=go(m,r,s*rpm,q*scale,d*scale,fs=fs,n=n); R.j=j
        if f: f(R)
        noise(R,r,st); out.append(R)
    return out
K={}
def kind(exact,ok=(),sound=False,honest='',wrong='',mustnot0=False):
    """exact: list of alternatives (sets); ok: effects that may be named besides; mustnot0: exit 0 is wrong"""
    def w(fn): K[fn.__name__]=dict(fn=fn,exact=[set(x) for x in exact],ok=set(ok),sound=sound,honest=honest,wrong=wrong,mustnot0=mustnot0);return fn
    return w
def reject_change(m,**k):
    d=M(m.p,m.emf,m.cog,m.rated,m.slots,m.ipm)
    for a,b in k.items(): setattr(d,a,b)
    return d
# ------------------------------------------------------------- sound
@kind([()],sound=True,wrong='any effect')
def s01_startups(F,r):
    m=SPM();J=.002;out=[]
    for j in range(8):
        wm=r.uniform(40,100)*(-1)**j;q0=r.uniform(3,10);tau=.08
        wf=lambda t:wm*(1-np.exp(-t/tau))+1e-9
        iqf=lambda t,th:(-1.5*np.exp(-t/.1)+0*t,np.sign(wm)*q0*(.4+.6*np.exp(-t/.05)*np.cos(60*t)))
        R=go(m,r,wf=wf,iqf=iqf,n=3000);R.Tr=R.T-J*wm/tau*np.exp(-R.t/tau);noise(R,r);out.append(cols(R))
    write(F,m,out,(2,5),eff=[('rotor_inertia','inertia',J)])
@kind([()],sound=True,wrong='any effect')
def s02_hand_turned(F,r):
    m=SPM();out=[]
    for j in range(6):
        a=r.uniform(.8,2.5);f1=r.uniform(.3,.7);f2=r.uniform(1,1.6)
        wf=lambda t:a*(np.sin(TP*f1*t)+.3*np.sin(TP*f2*t+j))
        R=go(m,r,wf=wf,fs=500,n=2500);noise(R,r,.006);out.append(cols(R,speed=False))
    write(F,m,out,(4,))
@kind([()],sound=True,ok=(),wrong='any effect')
def s03_resampled(F,r):
    m=SPM();out=[]
    for R in std(m,r,fs=2137,n=1500):
        t2=np.arange(int(R.t[-1]*5000))/5000
        D=cols(R,wrap=False);D={k:(t2 if k=='time_s' else np.interp(t2,R.t,v)) for k,v in D.items()};out.append(D)
    write(F,m,out,(3,6))
@kind([()],sound=True,wrong='any effect')
def s04_quantised(F,r):
    m=SPM();out=[]
    for R in std(m,r,st=.008):
        R.Tr=np.round(R.Tr/.04)*.04;R.ir=[np.round(x/.05)*.05 for x in R.ir];R.thr=np.floor(R.th/TP*2048)/2048*TP+TP/4096
        out.append(cols(R))
    write(F,m,out,(3,6))
@kind([()],sound=True,honest='a hum of 50 Hz that does not follow the turn may be left as unknown',wrong='an effect of machine or sensor')
def s05_hum(F,r):
    m=SPM();out=[]
    def f(R): R.Tr=R.T+.03*np.sin(TP*49.97*R.t+r.uniform(0,6))+.012*np.sin(TP*149.91*R.t)
    out=[cols(R) for R in std(m,r,pts=[(750,4,0)]+POINTS[:9],f=f,rev=False)]
    write(F,m,out,(3,6))
@kind([()],sound=True,wrong='any effect')
def s06_ten_equal(F,r):
    m=DR();out=[cols(R) for R in std(m,r,pts=[(400,8,0)]*10,rev=False)]
    write(F,m,out,(8,9))
@kind([()],sound=True,wrong='any effect')
def s07_dropped_mixed_rates(F,r):
    m=SPM();out=[]
    for j,R in enumerate(std(m,r,n=5000,fs=4000)):
        D=cols(R,speed=j%2==0)
        keep=r.random(5000)>.25
        if j%3==0: keep[1200:1900]=False
        if j%3==1: keep[:]=False;keep[::4]=True
        D={k:v[keep] for k,v in D.items()}
        if j%4==3: D.pop('time_s')
        out.append(D)
    write(F,m,out,(3,6))
def mixed(m,r,f=None,st=.02):
    out=[]
    for rpm in (200,-500,900): out.append(go(m,r,rpm,0,0))
    for a in range(3): # stall: held, rising current over angle where current is turned
        out.append(go(m,r,th0=r.uniform(0,TP),wf=lambda t:0*t,iqf=lambda t,th:(0*t,10*t/t[-1]),n=600,fs=1000))
    for rpm,q,d in POINTS[1:6]: out.append(go(m,r,rpm*(1 if q>4 else -1),q,d))
    for j,R in enumerate(out):
        R.j=j
        if f:f(R)
        noise(R,r,st)
    return out
@kind([()],sound=True,wrong='any effect')
def s08_drag_stall_load(F,r):
    m=SPM();write(F,m,[cols(R) for R in mixed(m,r)],(7,))
@kind([()],sound=True,wrong='any effect')
def s09_clipped_drive(F,r):
    m=SPM();out=[]
    for rpm,q,d in POINTS:
        R=go(m,r,rpm,q*1.3,d)
        i=[np.clip(x,-7,7) for x in R.i];z=sum(i)/3;R.i=[x-z for x in i];R.T=m.torque(R.te,*R.i);noise(R,r);out.append(cols(R))
    write(F,m,out,(3,6))
@kind([()],sound=True,wrong='any effect')
def s10_single(F,r):
    m=DR();R=go(m,r,350,7,0,n=5000);noise(R,r);write(F,m,[cols(R)])
@kind([()],sound=True,honest='zero of the torque sensor wanders: said as unknown, offset or drift',ok=('torque_drift','torque_sensor'),wrong='an effect of the machine')
def s11_pink_zero(F,r):
    m=SPM();out=[]
    def f(R):
        n=len(R.T);X=np.fft.rfft(r.normal(size=n));fr=np.fft.rfftfreq(n,1/R.fs);X[1:]/=np.sqrt(fr[1:]/200);X[0]=0
        R.Tr=R.T+.02*np.fft.irfft(X,n)
    write(F,m,[cols(R) for R in std(m,r,f=f)],(3,6))
@kind([()],sound=True,wrong='any effect')
def s12_load_noise(F,r):
    m=IPM2=SPM();out=[]
    def f(R): R.Tr=R.T*(1+.01*r.normal(size=len(R.T)));R.si=.01+.003*abs(R.i[0]).max()
    write(F,m,[cols(R) for R in std(m,r,f=f,st=.008)],(3,6))
@kind([()],sound=True,wrong='any effect')
def s13_six_step_two_currents(F,r):
    m=SPM();out=[]
    for rpm,q,d in POINTS[:8]:
        def iqf(t,th):
            k=np.floor((th%TP)/(TP/6)+.5)*TP/6
            return 0*t,0*t
        R=go(m,r,rpm,0,0)
        blk=lambda x:np.clip(4*np.sin(x),-1,1)*(np.abs(np.sin(x))>.5)
        i=[abs(q)*(np.sin(R.te-TP*k/3)>.5)-abs(q)*(np.sin(R.te-TP*k/3)<-.5) for k in range(3)]
        i=[lp1(x.astype(float),R.fs,.0008) for x in i];R.i=i;R.T=m.torque(R.te,*R.i);noise(R,r)
        D=cols(R);D.pop('ic_A');out.append(D)
    write(F,m,out,(3,6))
# ------------------------------------------------------------- hidden
@kind([],honest='unknown / other pole pairs',wrong='a list of effects, explained',mustnot0=True)
def h01_poles_for_pairs(F,r):
    m=SPM();d=reject_change(m,p=8);write(F,m,[cols(R) for R in std(m,r)],(3,6),decl=d)
@kind([],honest='unknown / swapped phases',wrong='effects, explained',mustnot0=True)
def h02_swapped_bc(F,r):
    m=SPM()
    def f(R): R.ir=[R.i[0],R.i[2],R.i[1]]
    write(F,m,[cols(R) for R in std(m,r,f=f)],(3,6))
@kind([],honest='unknown / sign of the torque',wrong='effects, explained',mustnot0=True)
def h03_torque_sign(F,r):
    m=SPM()
    def f(R): R.Tr=-R.T
    write(F,m,[cols(R) for R in std(m,r,f=f)],(3,6))
@kind([('back_emf','cogging')],ok=('phase_imbalance','magnet_temperature','torque_gain','current_gain'),honest='unknown',wrong='saturation, sensors')
def h04_wrong_motor(F,r):
    m=M(emf=((1,.20,0),(5,.012,2),(7,.001,0),(11,.004,2)),cog=((6,.008,2),(18,.03,.3)));write(F,m,[cols(R) for R in std(m,r)],(3,6),decl=SPM())
@kind([()],sound=True,ok=('mechanical_order','rotor_inertia'),honest='what the belt does does not repeat with the turn: unknown',wrong='cogging, back_emf, sensors')
def h05_belt(F,r):
    m=SPM()
    def f(R): R.Tr=R.T+.08*np.sin(.3717*R.th+r.uniform(0,6))+.04*np.sin(2*.3717*R.th+r.uniform(0,6))
    write(F,m,[cols(R) for R in std(m,r,f=f,n=5000,pts=[(x*2,a,b) for x,a,b in POINTS[:8]])],(3,6))
@kind([('torque_sensor',)],wrong='effects of the machine')
def h06_coupling_resonance(F,r):
    m=SPM()
    def f(R):
        R.Tr=second(R.T,R.fs,173.,.04)
    out=[]
    for R in std(m,r,f=f,n=4000):
        D=cols(R);D={k:v[1000:] for k,v in D.items()};out.append(D)
    write(F,m,out,(3,6))
@kind([],honest='partly/unknown, or friction-like of the sensor',ok=('torque_sensor','friction'),wrong='effects of the machine explained',mustnot0=False)
def h07_sensor_play(F,r):
    m=SPM()
    def f(R):
        h=.03;y=R.T[0];o=np.empty_like(R.T)
        for k,x in enumerate(R.T): y=min(max(y,x-h),x+h);o[k]=y
        R.Tr=o
    write(F,m,[cols(R) for R in std(m,r,f=f,st=.01)],(3,6))
@kind([('magnet_temperature',)],ok=('back_emf',),wrong='other')
def h08_warm_logged(F,r):
    m=SPM();out=[]
    for j,(rpm,q,d) in enumerate(POINTS):
        R=go(m,r,rpm,q,d);tc=25+6*j+4*R.t;a=-.0019*(tc-20)
        R.T=R.T+a*(R.T-m.cogt(R.te));noise(R,r);out.append(cols(R,temp=tc+.3*r.normal()))
    write(F,m,out,(3,6))
@kind([],ok=('back_emf','magnet_temperature','torque_gain'),honest='weaker magnets, differing from run to run: partly / unknown',wrong='saturation, friction, sensors as certain',mustnot0=True)
def h09_warm_not_logged(F,r):
    m=SPM();out=[];o=r.permutation(10)
    for j,(rpm,q,d) in enumerate(POINTS):
        R=go(m,r,rpm,q,d);a=-.0019*(5+7*o[j]);R.T=R.T+a*(R.T-m.cogt(R.te));noise(R,r);out.append(cols(R))
    write(F,m,out,(3,6))
@kind([('cogging',)],wrong='denied or another')
def h10_tenth_of_noise(F,r):
    m=SPM();m.cog=m.cog+[(18,.006,.9)];write(F,m,[cols(R) for R in std(m,r,st=.06,n=5000)],(3,6),decl=SPM())
@kind([('current_offset','back_emf','friction')],wrong='others')
def h11_three(F,r):
    m=SPM();d=SPM();m.emf=m.emf[:2]+[(7,.014,1.9),m.emf[3]]
    def f(R):
        R.Tr=R.T-.0012*R.w;R.ir=[R.i[0]+.15,R.i[1]-.08,R.i[2]-.02]
    write(F,m,[cols(R) for R in std(m,r,f=f)],(3,6),decl=d)
@kind([('reluctance','saturation')],ok=('back_emf',),wrong='sensors')
def h12_ipm_sat(F,r):
    m=IPM();pts=[(300,q,d) for q in (3,8,14) for d in (0,-5,-12)]+[(300,-8,-5),(500,11,-8),(500,5,-2)]
    write(F,m,[cols(R) for R in std(m,r,pts=pts,rev=False,n=2500)],(4,10),decl=reject_change(m,ipm=None))
@kind([('mechanical_order','friction')],ok=('stribeck_friction',),wrong='others')
def h13_hand_ecc_friction(F,r):
    m=SPM();out=[]
    for j in range(6):
        a=r.uniform(2,5)*(-1)**j;b=.4*a
        R=go(m,r,wf=lambda t:a+b*np.sin(TP*.8*t+j),fs=500,n=2500)
        R.Tr=R.T+.025*np.sin(R.th+.7)-.04*np.sign(R.w);noise(R,r,.006);out.append(cols(R,speed=False))
    write(F,m,out,(4,))
@kind([('cogging',)],wrong='others')
def h14_partial_arc_cogging(F,r):
    m=SPM();m.cog=[(6,.05,1.9),m.cog[1]];out=[]
    for j in range(6):
        s=(-1)**j
        R=go(m,r,wf=lambda t:s*.5+0*t,fs=500,n=1800+100*j,th0=.3+(0 if s>0 else 1.9));noise(R,r,.008);out.append(cols(R))
    write(F,m,out,(4,),decl=SPM())
@kind([('position_offset',)],wrong='others')
def h15_stall_offset(F,r):
    m=SPM();out=[]
    for j in range(12):
        d0=(-1)**j*3
        R=go(m,r,th0=j*TP/12/4+.03+r.uniform(0,.05),wf=lambda t:0*t,iqf=lambda t,th:(d0*t/t[-1],10*t/t[-1]*(-1 if j%4==3 else 1)),n=500,fs=1000)
        R.thr=R.th+np.radians(5)/4;noise(R,r);out.append(cols(R))
    write(F,m,out,(3,8))
@kind([('current_gain',),('phase_imbalance',),('current_gain','phase_imbalance')],ok=('back_emf',),wrong='others')
def h16_mixed_gain_b(F,r):
    m=SPM()
    def f(R): R.ir=[R.i[0],R.i[1]*1.05,R.i[2]]
    write(F,m,[cols(R) for R in mixed(m,r,f)],(7,))
@kind([],honest='partly / unknown (current logged is the reference where the voltage ends)',ok=(),wrong='friction, saturation explained',mustnot0=True)
def h17_reference_logged(F,r):
    m=SPM()
    def f(R):
        if abs(R.w[0])>70:
            k=70/abs(R.w[0]);R.ir=[x/k for x in R.i]
    write(F,m,[cols(R) for R in std(m,r,f=f)],(3,6))
@kind([('channel_delay',),('current_filter',)],wrong='others')
def h18_delay_current(F,r):
    m=SPM()
    def f(R):
        tau=150e-6;dd,qq=dq(R.te,*R.i);R.ir=abc(R.te-R.w*m.p*tau,dd,qq)
    write(F,m,[cols(R) for R in std(m,r,f=f)],(3,6))
@kind([('torque_sensor',)],wrong='effects of the machine')
def h19_antialias_100Hz(F,r):
    m=SPM()
    def f(R): R.Tr=second(R.T,R.fs,100.,.7071)
    out=[]
    for R in std(m,r,f=f,n=4000): out.append({k:v[500:] for k,v in cols(R).items()})
    write(F,m,out,(3,6))
@kind([('position_offset',),('channel_delay',),('position_offset','channel_delay')],honest='ambiguous with a delay',wrong='others')
def h20_single_offset(F,r):
    m=DR();R=go(m,r,350,7,-3,n=5000);R.thr=R.th+np.radians(6)/7;noise(R,r);write(F,m,[cols(R)])
@kind([('cogging',),('back_emf',)],ok=('reluctance','saturation'),honest='ambiguous cogging / back-EMF / reluctance',wrong='one of them as certain')
def h21_ten_equal_ripple(F,r):
    m=DR();m.cog=m.cog+[(6,.01,.4)];write(F,m,[cols(R) for R in std(m,r,pts=[(400,8,0)]*10,rev=False)],(8,9),decl=DR())
@kind([],honest='zero differs each run: said; partly/unknown',ok=(),wrong='friction, saturation as certain',mustnot0=True)
def h22_tare_each_run(F,r):
    m=SPM()
    def f(R): R.Tr=R.T+r.normal()*.08
    write(F,m,[cols(R) for R in std(m,r,f=f)],(3,6))
@kind([],ok=(),honest='one run slipped: partly/unknown, best naming the run',wrong='an effect for all runs, explained',mustnot0=True)
def h23_slipped_coupling(F,r):
    m=SPM()
    def f(R):
        if R.j==7: R.thr=R.th+np.where(np.arange(len(R.th))>1400,np.radians(12)/4,0)
    write(F,m,[cols(R) for R in std(m,r,f=f)],(3,6))
@kind([],ok=('channel_delay',),honest='two clocks: partly/unknown, delay',wrong='effects of the machine',mustnot0=False)
def h24_two_clocks(F,r):
    m=SPM()
    def f(R):
        R.Tr=np.interp(R.t*(1+.0015),R.t,R.T)   # torque logger 0.15 % fast
        R.Tr[-8:]=R.T[-8:]
    out=[]
    for R in std(m,r,f=f): out.append({k:v[:-10] for k,v in cols(R).items()})
    write(F,m,out,(3,6))
@kind([('back_emf',)],wrong='others')
def h25_sixstep_fifth(F,r):
    m=SPM();d=SPM();m.emf=[m.emf[0],(5,.02,.2)]+m.emf[2:];out=[]
    for rpm,q,dd in POINTS:
        R=go(m,r,rpm,0,0);R.i=[lp1(q*((np.sin(R.te-TP*k/3)>.5)*1.-(np.sin(R.te-TP*k/3)<-.5)),R.fs,.0006) for k in range(3)]
        R.T=m.torque(R.te,*R.i);noise(R,r);out.append(cols(R))
    write(F,m,out,(3,6),decl=d)
@kind([('mechanical_order',)],wrong='others',ok=('unequal_magnets',))
def h26_gear(F,r):
    m=SPM()
    def f(R): R.Tr=R.T+.03*np.sin(17*R.th+1)+.015*np.sin(R.th)
    write(F,m,[cols(R) for R in std(m,r,f=f,pts=[(x*2,a,b) for x,a,b in POINTS[:8]])],(3,6))
@kind([('rotor_inertia',)],wrong='others')
def h27_load_speed_ripple(F,r):
    m=SPM();J=.004;out=[]
    for rpm,q,d in POINTS:
        w0=rpm*2*TP/60;n=4000;t=np.arange(n)/5000;th=w0*t
        nu=2*abs(w0);th=w0*t+.004*np.sin(nu*t);w=w0+.004*nu*np.cos(nu*t);al=-.004*nu*nu*np.sin(nu*t)  # a load machine whose torque swings at a steady frequency
        R=go(m,r,rpm,0,0,n=n);R.th=th;R.te=m.p*th;R.w=w;R.i=abc(R.te,d+0*t,q+0*t);R.T=m.torque(R.te,*R.i);R.Tr=R.T-J*al;noise(R,r);out.append({k:v[5:-5] for k,v in cols(R).items()})
    write(F,m,out,(3,6))
@kind([('friction',)],ok=('torque_sensor',),honest='one direction: friction or zero of the sensor',wrong='others')
def h28_generator_coastdown(F,r):
    m=SPM();out=[]
    for j in range(8):
        w1=r.uniform(60,110);Rl=3+j;wf=lambda t:w1*np.exp(-t/.9)
        R=go(m,r,wf=wf,n=4000)
        i=[-m.e(R.te,k)*R.w/Rl for k in range(3)];z=sum(i)/3;R.i=[x-z for x in i]
        R.T=m.torque(R.te,*R.i);R.Tr=R.T-.03-.0008*R.w;noise(R,r);out.append(cols(R))
    write(F,m,out,(3,6))
@kind([('torque_sensor',)],ok=('channel_delay',),honest='a low pass by averaging: lag of sensor; partly',wrong='cogging, back_emf, saturation as certain')
def h29_averaged_log(F,r):
    m=SPM();out=[]
    for R in std(m,r,pts=[(x/3,a,b) for x,a,b in POINTS],n=5000*8,fs=20000,st=.05,rev=False):
        w=40
        g=lambda v:v[:len(v)//w*w].reshape(-1,w).mean(1)
        dd,qq=dq(R.te,*R.ir)
        out.append({'time_s':g(R.t),'theta_m_rad':g(R.th),'id_A':g(dd),'iq_A':g(qq),'torque_Nm':g(R.Tr)})
    write(F,m,out,(3,6))

def six(m,r,pts,fs=5000,st=.02,n=3000,tau=.0006,three=True,f=None,cn=.01):
    out=[]
    for j,(rpm,q,dd) in enumerate(pts):
        R=go(m,r,rpm,0,0,fs=fs,n=n,sig_i=cn)
        i=[lp1(q*((np.sin(R.te-TP*k/3)>.5)*1.-(np.sin(R.te-TP*k/3)<-.5)),fs,tau) for k in range(3)] if tau else [q*((np.sin(R.te-TP*k/3)>.5)*1.-(np.sin(R.te-TP*k/3)<-.5)) for k in range(3)]
        R.i=i;R.j=j;R.T=m.torque(R.te,*R.i)
        if f:f(R)
        noise(R,r,st);D=cols(R)
        if not three:D.pop('ic_A')
        out.append(D)
    return out
@kind([()],sound=True,wrong='any effect')
def n01_six_step_sound(F,r):
    m=SPM();write(F,m,six(m,r,POINTS),(3,6))
@kind([()],sound=True,wrong='any effect')
def n02_six_step_drone_both_ways(F,r):
    m=DR();write(F,m,six(m,r,[(x*(-1)**j,q,0) for j,(x,q,_) in enumerate(POINTS)],fs=20000,n=4000,tau=.0002,cn=.05,st=.01),(3,6))
@kind([('back_emf',)],wrong='others')
def n03_prbs_hidden_7th(F,r):
    m=SPM();d=SPM();m.emf=m.emf[:2]+[(7,.012,1.)]+m.emf[3:];out=[]
    for j in range(8):
        st=r.integers(-1,2,200)*1.;s2=r.integers(-1,2,200)*1.
        def iqf(t,th):
            k=(t/.02).astype(int);return lp1(3*s2[k],5000,.002),lp1(7*st[k],5000,.002)
        R=go(m,r,(200+90*j)*(-1)**j,iqf=iqf,n=3500);noise(R,r);out.append(cols(R))
    write(F,m,out,(3,6),decl=d)
@kind([()],sound=True,wrong='any effect')
def n04_tiny_motor_mNm(F,r):
    m=M(p=1,emf=((1,.004,0),(5,.0001,0),(7,.00004,1)),cog=((6,.00002,1),),rated=.5)
    write(F,m,[cols(R) for R in std(m,r,pts=[(x*8,q,d) for x,q,d in POINTS],scale=.05,st=2e-5,fs=20000,f=lambda R:setattr(R,'si',.0005))],(3,6))
@kind([()],sound=True,wrong='any effect')
def n05_big_p20(F,r):
    m=M(p=20,emf=((1,40,0),(5,.6,1),(7,.3,2)),cog=((6,50,1),(3.6,9,2)),rated=200)
    write(F,m,[cols(R) for R in std(m,r,pts=[(x/10,q,d) for x,q,d in POINTS],scale=20,st=40,fs=2000,n=5000,f=lambda R:setattr(R,'si',.3))],(3,6))
@kind([('friction',)],ok=('stribeck_friction',),wrong='others')
def n06_reversal_within_run(F,r):
    m=SPM();out=[]
    for j in range(8):
        a=r.uniform(20,80);wf=lambda t:a*np.sin(TP*1.3*t+j)
        R=go(m,r,wf=wf,iq=(j-3)*2.5,id=-j%3,n=4000);R.Tr=R.T-.05*np.tanh(R.w/.01)-.0006*R.w;noise(R,r);out.append(cols(R))
    write(F,m,out,(3,6))
@kind([('torque_drift','position_offset','mechanical_order')],wrong='others')
def n07_drift_offset_ecc(F,r):
    m=SPM()
    def f(R):
        R.Tr=R.T+.05*R.t+.02*np.sin(R.th+.4);R.thr=R.th+np.radians(3)/4
    write(F,m,[cols(R) for R in std(m,r,f=f,n=5000,pts=[(x+300,q,d) for x,q,d in POINTS])],(3,6))
@kind([],honest='torque sensor clips at high load: partly/unknown',wrong='saturation of the iron explained',mustnot0=True)
def n08_sensor_clips(F,r):
    m=SPM()
    def f(R): R.Tr=np.clip(R.T,-3.7,3.7)
    write(F,m,[cols(R) for R in std(m,r,f=f,rev=False)],(3,6))
@kind([('rotor_inertia',)],wrong='others')
def n09_ramps_inertia(F,r):
    m=SPM();J=.0015;out=[]
    for j in range(8):
        w0=r.uniform(-60,60);al=r.uniform(60,200)*(-1)**j
        R=go(m,r,wf=lambda t:w0+al*t,iq=r.uniform(-8,8),id=r.uniform(-3,2),n=3500);R.Tr=R.T-J*al;noise(R,r);out.append(cols(R))
    write(F,m,out,(3,6))
@kind([('position_eccentricity',)],wrong='others')
def n10_encoder_eccentric(F,r):
    m=SPM()
    def f(R): R.thr=R.th+np.radians(.6)*np.sin(R.th+.9)
    write(F,m,[cols(R) for R in std(m,r,f=f,n=5000,pts=[(x+200,q,d) for x,q,d in POINTS])],(3,6))
@kind([('cogging',)],wrong='others')
def n11_shuffled_rows_cogging(F,r):
    m=SPM();d=SPM();m.cog=[(6,.045,1.),m.cog[1]];out=[]
    for R in std(m,r):
        D=cols(R);D.pop('time_s');o=r.permutation(len(R.t));out.append({k:v[o] for k,v in D.items()})
    write(F,m,out,(3,6),decl=d)
@kind([()],sound=True,honest='logger averages: unknown / lag',ok=('torque_sensor',),wrong='machine effects certain')
def n12_averaged_log_slow(F,r):
    m=SPM();out=[]
    for R in std(m,r,pts=[(x/3,a,b) for x,a,b in POINTS],n=5000*8,fs=20000,st=.05):
        w=60;g=lambda v:v[:len(v)//w*w].reshape(-1,w).mean(1);dd,qq=dq(R.te,*R.ir)
        out.append({'time_s':g(R.t),'theta_m_rad':g(R.th),'id_A':g(dd),'iq_A':g(qq),'torque_Nm':g(R.Tr)})
    write(F,m,out,(3,6))

@kind([()],sound=True,wrong='any effect')
def n13_sharp_blocks(F,r):
    m=SPM();write(F,m,six(m,r,POINTS,tau=0),(3,6))
@kind([()],sound=True,wrong='any effect')
def n14_clipped_one_direction_tau(F,r):
    m=SPM();write(F,m,six(m,r,[(abs(x),abs(q),0) for x,q,_ in POINTS],tau=.0012),(3,6))
@kind([('cogging',)],honest='aliasing: few samples a turn',wrong='others')
def n15_fast_machine_few_samples(F,r):
    m=SPM();d=SPM();m.cog=[(6,.05,1.),m.cog[1]];write(F,m,[cols(R) for R in std(m,r,pts=[(x*3,q,e) for x,q,e in POINTS],n=4000)],(3,6),decl=d)
@kind([()],sound=True,honest='load that swings at its own frequency does not repeat with the turn',wrong='any effect of the machine')
def n16_load_swing_3p3Hz(F,r):
    m=SPM()
    def f(R): R.Tr=R.T+.06*np.sin(TP*3.3*R.t+r.uniform(0,6))
    write(F,m,[cols(R) for R in std(m,r,f=f,n=6000)],(3,6))
@kind([],honest='spikes: unknown or sound',ok=(),wrong='any effect')
def n17_spikes(F,r):
    m=SPM()
    def f(R):
        R.Tr=R.T.copy();k=r.integers(0,len(R.T),6);R.Tr[k]+=r.choice([-1,1],6)*5.
    write(F,m,[cols(R) for R in std(m,r,f=f)],(3,6))
@kind([('phase_imbalance',),('current_gain',)],ok=('back_emf',),wrong='others')
def n18_shorted_turn(F,r):
    m=SPM();out=[]
    def f(R): R.T=R.T-.06*m.e(R.te,2)*R.i[2]
    write(F,m,[cols(R) for R in std(m,r,f=f)],(3,6))
if __name__=='__main__':
    # the generator against itself
    r=np.random.default_rng(1);th=np.linspace(0,TP,2001)[:-1];m=SPM()
    i=abc(th,-2.,6.);d,q=dq(th,*i);assert abs(d+2).max()<1e-12 and abs(q-6).max()<1e-12 and abs(sum(i)).max()<1e-12
    assert abs(m.torque(th,*i).mean()-1.5*.30*6)<1e-9
    # power balance: lambda by integration of e; T w = sum e w i; here emf voltage by finite difference of flux
    m=IPM();rr=r.uniform(-10,10,(3,50));rr-=rr.mean(0);t0=r.uniform(0,TP,50);h=1e-5
    Tn=m.p*(m.coen(t0+h,*rr)-m.coen(t0-h,*rr))/(2*h)
    m0=reject_change(m,ipm=None);print('coenergy vs torque',abs(Tn-(m.torque(t0,*rr)-m0.torque(t0,*rr))).max())
    m=IPM();m.ipm=dict(Ld=1e-3,Ls=2e-3,Is=1e6,k=0,L6=0)
    print('reluctance',(m.torque(th,*abc(th,-4,9)) ).mean()-(1.5*.24*9+1.5*3*(1e-3-2e-3)*-36))
    x=np.sin(TP*60*np.arange(20000)/5000);y=second(x,5000,173,.04);u=60/173
    print('resonance',abs(np.fft.rfft(y[10000:])[120])*2/10000,1/abs(1-u*u+2j*.04*u))
    R=go(SPM(),r,300,5);print('angle',R.th[-1]-R.th[0],300*TP/60*R.t[-1])
