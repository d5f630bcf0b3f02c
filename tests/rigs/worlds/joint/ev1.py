import sys,numpy as np,math
import m1,play
n=252*24
th=np.arange(n)*2*math.pi/n
enc=th+m1.ECC*np.sin(th+m1.ECCP)+m1.ECC2*np.sin(2*th+m1.ECC2P)
def tq(d,q,offs=(0,0,0),gain=(1,1,1),frame=None):
    te=(m1.P*enc if frame is None else frame)+m1.CAL
    m=[q*np.sin(te-2*math.pi/3*s)-d*np.cos(te-2*math.pi/3*s) for s in range(3)]
    # corrected sensors: drive makes (read-off)/gain = m  -> read = m*gain+off ; read = G*i+O
    a=(m[0]*gain[0]+offs[0]-m1.OA)/m1.GA; b=(m[1]*gain[1]+offs[1]-m1.OB)/m1.GB; c=-a-b
    x=m1.P*th
    T=0
    for s,i in enumerate((a,b,c)):
        y=x-2*math.pi/3*s
        T=T+i*(np.sin(y)+m1.K5*np.sin(5*y+.2)+m1.K7*np.sin(7*y-.5)+m1.K11*np.sin(11*y)+m1.K13*np.sin(13*y+1))
    return m1.KE*T+sum(A*np.sin(o*th+p) for o,A,p in m1.COG)
if __name__=='__main__':
    for f in sys.argv[1:]:
        te,d,q,offs,gain=play.table(f,enc,m1.P,False)
        T=tq(d,q); im=np.hypot(d.mean(),q.mean())
        print(f,'table, sensors as they are: pp %.4f mean %.4f'%(play.pp(T),T.mean()), 'sine: pp %.4f'%play.pp(tq(0*q,0*q+q.mean())))
        te,d,q,offs,gain=play.table(f,enc,m1.P,True)
        T2=tq(d,q,offs,gain,te); print('   corrected as told: pp %.4f mean %.4f'%(play.pp(T2),T2.mean()),offs,gain)
