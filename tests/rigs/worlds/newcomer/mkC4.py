from mkC import *
for n,r,m in (('leer','rpm=30 open=1 seed=1',None),('l4','rpm=30 iq=4 seed=4',None)):
    a=sim('T=13 '+r); s=sync(a); de(f'C/t_{n}.csv',[s],time=True,thousands=False)
    # plain time-synchronous 1 kHz log with unwrapped rad, standard names
    k=np.arange(0,len(a['t']),8)
    np.savetxt(f'C/std_{n}.csv',np.column_stack([a[x][k] for x in('t','menc','ia','ib','ic','torque')]),delimiter=',',header='time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm',comments='',fmt='%.6g')
