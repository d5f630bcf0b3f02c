import sys,numpy as np,math
import importlib,play,re
mod=importlib.import_module(sys.argv[1])
n=7200; thm=np.arange(n)*2*math.pi/3/n
for f in sys.argv[2:]:
    per,off,h=play.info(f); hh=re.sub(r'\n \* +',' ',h)
    a=0.0
    for s,x in re.findall(r'(add|subtract) (\S+) rad (?:to|from) the electrical angle',hh): a=(1 if s=='add' else -1)*float(x)
    te,d,q,offs,gain=play.table(f,thm,3,False)
    te2,d2,q2,_,_=play.table(f,thm+a/3,3,False)
    for dev in (0.,1.):
        T=mod.T(d,q,te,dev)
        T2=mod.T(d2,q2,te,dev)  # table read at corrected angle, id iq by the machine's own frame
        c=np.cos(a);s=np.sin(a) # phases made with corrected angle: dq in true frame rotated
        # ia=q sin(te+a)-d cos(te+a) -> true frame
        q3=q2*c+d2*s; d3=d2*c-q2*s
        T3=mod.T(d3,q3,te,dev)
        S=mod.T(0*d+d.mean(),0*q+q.mean(),te,dev)
        print(f,'dev',dev,'asis pp %.3f m %.3f | angle corrected, own dq pp %.3f m %.3f | wholly corrected pp %.3f m %.3f | sine pp %.3f'%(play.pp(T),T.mean(),play.pp(T2),T2.mean(),play.pp(T3),T3.mean(),play.pp(S)),offs,gain)
