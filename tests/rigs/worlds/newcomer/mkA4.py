from mkA import *
import os,mkA
os.makedirs('A4',exist_ok=True)
R={'idle_cw':'rpm=60 open=1 seed=1','idle_ccw':'rpm=-60 open=1 seed=2','l30':'rpm=60 id=-10 iq=28 seed=3','l60':'rpm=60 id=-28 iq=53 seed=4','l80':'rpm=60 id=-42 iq=68 seed=5','l60ccw':'rpm=-60 id=-28 iq=53 seed=6','l60id':'rpm=60 id=-45 iq=40 seed=10','l40iq':'rpm=60 id=0 iq=40 seed=8','slow60':'rpm=15 id=-28 iq=53 seed=11 T=21.3'}
def std(f,a,dec=5):
    k=np.arange(0,len(a['t']),dec)
    np.savetxt(f,np.column_stack([a[x][k] for x in('t','menc','ia','ib','ic','torque')]),delimiter=',',header='time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm',comments='',fmt='%.7g')
for n,r in R.items():
    std(f'A4/clean_{n}.csv',sim('T=5.5 '+r+' lag=0 aaf=0 ga=0 gb=0 gc=0 oa=0 ob=0 oc=0 e2=0 tdrift=0 tnoise=0.03'))
    std(f'A4/real_{n}.csv',sim('T=5.5 '+r))
