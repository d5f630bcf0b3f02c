from mkC import *
import mkC
for n,r in (('leer','rpm=30 open=1 seed=1'),('l4','rpm=30 iq=4 seed=4')):
    a=sim('T=13 '+r,exe='./sims');k=np.arange(0,len(a['t']),8)
    np.savetxt(f'C/sym_{n}.csv',np.column_stack([a[x][k] for x in('t','menc','ia','ib','ic','torque')]),delimiter=',',header='time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm',comments='',fmt='%.6g')
