"""play.py CASE OUTDIR OFFSET_DEG : compile the emitted table and play it in the own simulation"""
import sys,re,os,subprocess,ctypes,importlib
from sim import *
def load(out):
    c='''#include <stdint.h>
#include "tuned.h"
void play(const uint32_t*a,int n,float*d,float*q){for(int k=0;k<n;++k){hci_currents_dq i=hci_table_f32_dq(&tuned,a[k]);d[k]=i.id_A;q[k]=i.iq_A;}}
'''
    open(out+'/table/play.c','w').write(c)
    so=out+'/../%s_play.so'%out.rstrip('/').split('/')[-1]
    subprocess.check_call(['cc','-O2','-shared','-fPIC','-I',os.environ['HCI_INCLUDE'],'-I',out+'/table',out+'/table/play.c',out+'/table/tuned.c','-lm','-o',so])
    import os; os.remove(out+'/table/play.c')
    return ctypes.CDLL(os.path.abspath(so)).play
def currents(out,the):
    h=open(out+'/table/tuned.h').read(); per=re.search(r'2\^32 = (\d+) electrical|2\^32 = 1 electrical',h)
    turns=float(per.group(1) or 1); f=load(out)
    a=np.asarray(np.floor((the/TP/turns%1)*2**32),dtype=np.uint64).astype(np.uint32); n=len(a)
    d=np.zeros(n,np.float32); q=np.zeros(n,np.float32); P=ctypes.c_void_p
    f(a.ctypes.data_as(P),n,d.ctypes.data_as(P),q.ctypes.data_as(P)); return d.astype(float),q.astype(float)
if __name__=='__main__':
    case,out,off=sys.argv[1],sys.argv[2],math.radians(float(sys.argv[3]))
    m=importlib.import_module('gen_'+case).motor()
    N=46000*2; th=np.arange(N)/N*TP
    sens=getattr(importlib.import_module('gen_'+case),'sense',lambda x:x)(th)
    the=m.pp*sens+off
    d,q=currents(out,the)
    # table's phase currents are placed by the drive at the table's angle (the+off is the drive's own angle)
    if len(sys.argv)>4: the=m.pp*sens+math.radians(float(sys.argv[4]))  # the drive has its own zero
    ia,ib,ic=phases(q,d,the)
    M=m.torque(th,ia,ib,ic)
    I=np.hypot(q,d).mean()
    dirn=math.atan2(-d.mean(),q.mean())
    a,b,c=phases(q.mean(),d.mean(),the); M0=m.torque(th,a,b,c)
    # best plain sine of the same mean torque
    thT=m.pp*th+m.z; a,b,c=phases(I,0,thT); M1=m.torque(th,a,b,c)
    print(f'{out}: table mean {M.mean():.4f} pp {np.ptp(M):.4f} rms {M.std():.4f}; mean currents of the table alone pp {np.ptp(M0):.4f} mean {M0.mean():.4f}; true plain sine pp {np.ptp(M1):.4f} mean {M1.mean():.4f}')
