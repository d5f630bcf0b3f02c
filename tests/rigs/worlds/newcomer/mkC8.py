from mkC import *
def std(f,a):
    k=np.arange(0,len(a['t']),8);np.savetxt(f,np.column_stack([a[x][k] for x in('t','menc','ia','ib','ic','torque')]),delimiter=',',header='time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm',comments='',fmt='%.6g')
for n,r in (('mot','rpm=30 iq=4 id=-2 seed=4'),('gen','rpm=30 iq=-4 id=-2 seed=5'),('idle','rpm=30 open=1 seed=6'),('mot2','rpm=30 iq=2 id=-1 seed=7')): std(f'C/fw_{n}.csv',sim('T=8 '+r))
