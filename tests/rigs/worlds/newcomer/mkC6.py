from mkC import *
def std(f,bl,gap=3.0,wrap=False,speed=False,pause=False):
    t0=0;X=[];off=0
    for a in bl:
        k=np.arange(0,len(a['t']),8);c=[a['t'][k]-a['t'][0]+t0,a['menc'][k],a['ia'][k],a['ib'][k],a['ic'][k],a['torque'][k]]
        if wrap:c[1]=c[1]%(2*np.pi)
        if speed:c.append(a['rpm'][k])
        X.append(np.column_stack(c))
        if pause:
            n=int(gap*1000);e=X[-1][-1].copy();nx=None
            P=np.tile(e,(n,1));P[:,0]+=np.arange(1,n+1)*1e-3;P[:,2:5]=0.01*rng.standard_normal((n,3));P[:,5]=0.02+0.004*rng.standard_normal(n)
            if speed:P[:,6]=0
            X.append(P)
        t0=X[-1][-1,0]+(0.001 if pause else gap)
    np.savetxt(f,np.vstack(X),delimiter=',',header='time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm'+(',speed_rpm' if speed else ''),comments='',fmt='%.6g')
rng=np.random.default_rng(3)
f=sim('T=13 rpm=30 open=1 seed=1');m0=f['mtrue'][-1];b=sim(f'T=13 rpm=-30 open=1 seed=2 m0={m0+np.pi}')
l=sim('T=13 rpm=30 iq=4 seed=3');lb=sim('T=13 rpm=-30 iq=4 seed=6')
std('C/ff_gap.csv',[f,b]);std('C/ff_pause.csv',[f,b],pause=True);std('C/ff_speed.csv',[f,b],speed=True);std('C/ff_pause_wrap_speed.csv',[f,b],wrap=True,speed=True,pause=True);std('C/ff_4.csv',[f,b,l,lb],speed=True,pause=True,wrap=True);std('C/ff_4g.csv',[f,b,l,lb])
