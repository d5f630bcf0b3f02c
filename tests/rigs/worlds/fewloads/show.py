import sys; sys.path.insert(0,'.')
from judge import *
for k,c in M.items():
    m=c()
    for mode in (['mtpa','id0'] if k not in('spm',) else ['id0']):
        for f in (.001,.3,.6,1):
            te=np.linspace(0,2*np.pi*m.p,1440*m.p,endpoint=False)
            d,q=direction(m,mode,f*m.Ir); T=m.T(d,q,te); S=np.abs(np.fft.rfft(T))*2/len(T)
            o=np.argsort(-S[1:])[:5]+1
            print(k,mode,f,'dq %.1f %.1f'%(d,q),'T %.3f pp %.3f'%(T.mean(),pp(T)),' '.join('%g:%.3g'%(x/m.p,S[x]) for x in o))
