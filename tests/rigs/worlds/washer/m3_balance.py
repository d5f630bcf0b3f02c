# Motor 3: torque motor on an air bearing, p=11, 24 slots, shaft held by a 250 mm arm on a laboratory balance (g), 200 positions a turn
# (index 1.8 deg), LabVIEW export (tab, preamble, units in the name). DC currents from the drive. Magnets warm during the loaded logs (winding temperature logged, magnets lag).
# lcm(24,22)=264 a turn, 24 electrical: ABOVE what 200 positions tell; it folds to 64 a turn
from lib import *
import sys
p=11
m=Motor(p,[(1,.55,0),(5,.009,.4),(7,.007,-2.5),(11,.003,1)],[(264,.010,.6),(24,.030,1.2),(22,.022,-.5),(66,.018,.8),(48,.006,2)],rel=-.0)
def drive(): return Drive((1.,1.006,.996),(.012,.0,-.01))
def log(name,iq,npos=200,turns=1,seed=0,warm=True,off=0.,jit=0.02):
    r=np.random.default_rng(seed); k=np.arange(int(npos*turns)); deg=k*360/npos+off+r.normal(0,jit,len(k)); thm=np.radians(deg); th=p*thm
    meas=ipark(0*th,iq+0*th,th); tru=drive().true(meas) if iq else 0*meas
    tt=k*10.; Tw=22+(55*(iq/6)**2*(1-np.exp(-tt/400)) if warm else 0*tt); Tmag=22+(38*(iq/6)**2*(1-np.exp(-tt/1500)) if warm else 0*tt)
    T=m.torque(thm,tru,1-.0011*(Tmag-22))
    g=T/9.80665/.25*1000+r.normal(0,.4,len(k))+3.1
    rd=meas+r.normal(0,.004,meas.shape) if iq else 0*meas
    with open(name,'w') as o:
        o.write('LabVIEW Measurement\nWriter_Version\t2\nOperator\tKM\n***End_of_Header***\nPosition [deg]\tBalance [g]\tIu [A]\tIv [A]\tIw [A]\tT_winding [degC]\n')
        for j in range(len(k)): o.write('%.3f\t%.2f\t%.3f\t%.3f\t%.3f\t%.1f\n'%(deg[j],g[j],*rd[:,j],Tw[j]))
def play(folder):
    f,per,txt=load_table(folder); thm=np.linspace(0,tau,96000,endpoint=False); d,q=f(thm)
    for nm,dr,te in (('sensors as they are',drive(),1.),('perfect, cold',Drive(),1.),('perfect, +38 K',Drive(),1-.0011*38)):
        tru=dr.true(ipark(d,q,p*thm)); T=m.torque(thm,tru,te); Tp=m.torque(thm,dr.true(ipark(0*thm,T.mean()/(.825*te)+0*thm,p*thm)),te)
        print('%-22s mean %.4f ripple pp %.5f | plain sine mean %.4f pp %.5f | peak A %.2f'%(nm,T.mean(),pp(T),Tp.mean(),pp(Tp),abs(tru).max()))
if __name__=='__main__':
    if sys.argv[1]=='make':
        for n,i in (('i0',0),('i2',2),('i4',4),('i6',6)): log('m3/%s.txt'%n,i,seed=i)
        log('m3/fine0.txt',0,npos=720,seed=11); log('m3/fine4.txt',4,npos=720,seed=12); log('m3/fine6.txt',6,npos=720,seed=13); log('m3/fine2.txt',2,npos=720,seed=14)
        log('m3/i4cold.txt',4,seed=15,warm=False)
    else: play(sys.argv[2])
