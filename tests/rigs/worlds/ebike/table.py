import ctypes, subprocess, numpy as np, re, os
def load(folder):
    """emitted dq table as function of mechanical angle (rad, of the logs) -> (id, iq)"""
    h=open(folder+'/tuned.h').read(); c=f'{folder}/_w.c'
    inc=os.environ['HCI_INCLUDE']
    per=int(re.search(r'tuned_PERIODS (\d+)u',h).group(1)); turns=per
    i16='hci_table_i16' in h and 'table_i16.h' in h
    fn='hci_table_i16_dq' if i16 else 'hci_table_f32_dq'
    open(c,'w').write('#include "tuned.h"\nvoid ev(const unsigned*a,float*d,float*q,int n){for(int k=0;k<n;k++){hci_currents_dq i=%s(&tuned,a[k]);d[k]=i.id_A;q[k]=i.iq_A;}}\nint chk(void){return %s_check(&tuned)==0;}\n'%(fn,fn[:-3]))
    so=f'{folder}/_w.so'; subprocess.check_call(['gcc','-O2','-shared','-fPIC','-I',inc,'-I',folder,c,folder+'/tuned.c','-o',so])
    L=ctypes.CDLL(os.path.abspath(so))
    def f(thm, periods):
        a=np.floor((np.asarray(thm)*periods/(2*np.pi)%1.)*2**32).astype(np.uint64).astype(np.uint32)
        d=np.empty(a.size,np.float32); q=np.empty(a.size,np.float32)
        L.ev(a.ctypes.data_as(ctypes.c_void_p),d.ctypes.data_as(ctypes.c_void_p),q.ctypes.data_as(ctypes.c_void_p),a.size)
        return d.astype(float),q.astype(float)
    return f,per,turns
