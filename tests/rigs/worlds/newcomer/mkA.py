import subprocess,sys,numpy as np,io
BASE="motor=0 ga=0.005 gb=-0.004 gc=0.003 oa=0.08 ob=-0.05 oc=0.02 inoise=0.15 lag=0.001 toff=0.1 tdrift=0.002 tnoise=0.06 e2=0.0014 aaf=2500 sr1=0.002 sr2=0.001 bw=400 skip=0.3"
def sim(args,exe='./sim'):
    o=subprocess.run([exe]+BASE.split()+args.split(),capture_output=True,text=True,check=True).stdout
    n=o[:o.index('\n')].split(',')
    a=np.loadtxt(io.StringIO(o),delimiter=',',skiprows=1)
    return {k:a[:,i] for i,k in enumerate(n)}
def dewesoft(f,a,zero=0.,cols=('ia','ib','ic'),torque=1,angle=True,speed=True,swap=False,drop=()):
    ang=np.degrees((a['menc']+zero)%(2*np.pi))
    with open(f,'w',encoding='latin-1') as g:
        g.write('Data file name: D:\\Dyno\\EM48-8\\%s.dxd\nStart time: 03.11.2026 09:12:44.120\nNumber of channels: 6\nSample rate: 10000 Hz\nStore type: always fast\n\n'%f.split('/')[-1][:-4])
        g.write('Time (s)\tRotor angle (deg)\tI_U (A)\tI_V (A)\tI_W (A)\tTorque (Nm)\tSpeed (rpm)\n')
        x=np.column_stack([a['t']-a['t'][0],ang,a[cols[0]],a[cols[1]],a[cols[2]],torque*a['torque'],a['rpm']])
        np.savetxt(g,x,fmt='%.4f\t%.4f\t%.3f\t%.3f\t%.3f\t%.4f\t%.2f')
if __name__=='__main__':
    runs={'idle_cw':'rpm=60 open=1 T=10.5 seed=1','idle_ccw':'rpm=-60 open=1 T=10.5 seed=2',
     'load30_cw':'rpm=60 id=-10 iq=28 T=10.5 seed=3','load60_cw':'rpm=60 id=-28 iq=53 T=10.5 seed=4','load80_cw':'rpm=60 id=-42 iq=68 T=10.5 seed=5','load60_ccw':'rpm=-60 id=-28 iq=53 T=10.5 seed=6',
     'load60_300':'rpm=300 id=-28 iq=53 T=4 seed=7','load40_iq':'rpm=60 id=0 iq=40 T=10.5 seed=8','gen60_cw':'rpm=60 id=-28 iq=-53 T=10.5 seed=9','load60_id':'rpm=60 id=-45 iq=40 T=10.5 seed=10'}
    for n,r in runs.items():
        a=sim(r);dewesoft('A/%s.txt'%n,a)
        k=slice(len(a['t'])//2,None)
        print(n,'Tmean true %.3f pp %.3f measured pp %.3f'%(a['Ttrue'][k].mean(),np.ptp(a['Ttrue'][k]),np.ptp(a['torque'][k])))
