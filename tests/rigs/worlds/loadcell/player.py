import subprocess, numpy as np, os, ctypes
def load(folder,name='tuned',inc=os.environ['HCI_INCLUDE']):
    """returns f(u in turns of table period)->(2,N) , attributes period_turns, frame"""
    w=folder+'/_w.c'
    open(w,'w').write('#include "%s.h"\n#include <string.h>\nvoid ev(const double*u,int n,double*o,int q,double T){for(int k=0;k<n;k++){double x=u[k]; x-=(long)x; if(x<0)x+=1; float c[3]; uint32_t a=(uint32_t)(x*4294967296.0); hci_table_f32_currents(&%s,a,(float)T,c); o[2*k]=c[0];o[2*k+1]=c[1];}}\nint period(void){return %s.period_turns;} int frame(void){return %s.frame;} int check(void){return hci_table_f32_check(&%s);} int parts(void){return %s.parts;} double ref(void){return %s.reference_torque_Nm;} double peak(void){return %s.peak_A;}\n'%((name,)*8))
    so=folder+'/_w.so'; 
    subprocess.check_call(['gcc','-O2','-shared','-fPIC','-I',inc,'-I',folder,w,folder+'/'+name+'.c','-o',so])
    L=ctypes.CDLL(os.path.abspath(so)); L.ref.restype=ctypes.c_double; L.peak.restype=ctypes.c_double
    D=ctypes.POINTER(ctypes.c_double)
    def f(u,T=0.):
        u=np.ascontiguousarray(np.atleast_1d(u),float); o=np.zeros((len(u),2))
        L.ev(u.ctypes.data_as(D),len(u),o.ctypes.data_as(D),0,ctypes.c_double(T)); return o.T
    f.period=L.period(); f.frame='abc' if L.frame()==0 else 'dq'; f.ok=L.check(); f.parts=L.parts(); f.peak=L.peak()
    return f
