# play.py FOLDER motor torque : compile the table, play it through the true motor; wrong and corrected sensors
import sys,re,subprocess,ctypes,os,numpy as np
from motors import *
folder,mot,Tw=sys.argv[1],sys.argv[2],float(sys.argv[3])
import json
inc=os.environ['HCI_INCLUDE']
w=open('w.c','w'); w.write('#include "tuned.h"\nvoid ev(unsigned a,float*o){hci_currents_dq i=hci_table_f32_dq(&tuned,a);o[0]=i.id_A;o[1]=i.iq_A;}\n'); w.close()
subprocess.check_call(['gcc','-O1','-shared','-fPIC','-I',inc,'-I',folder+'/table',folder+'/table/tuned.c','w.c','-o',folder+'/t.so'])
L=ctypes.CDLL(folder+'/t.so'); o=(ctypes.c_float*2)()
hdr=open(folder+'/table/tuned.h').read()+open(folder+'/table/tuned.c').read()
m=re.search(r'2\^32 of the angle is (\d+) electrical',re.sub(r'\s+',' ',subprocess.run(['sh','-c',f'cat {folder}.txt'],capture_output=True,text=True).stdout))
turns=int(m.group(1)) if m else 1
txt=re.sub(r'\s+',' ',open(folder+'.txt').read())
gi=[1,1,1];oi=[0,0,0];ang=[]
mm=re.search(r'(correct(?:ed)? before, in the order.*?)(?: - [A-Z]|plain sine)',txt)
c=mm.group(1) if mm else ''
for k,n in enumerate('abc'):
    q=re.search(r'i_%s = \(?i_%s_read(?: [-+] \S+ A\))? \* ([\d.]+)'%(n,n),c); gi[k]=1/float(q.group(1)) if q else 1
    q=re.search(r'i_%s = \(i_%s_read ([-+]) (\S+) A\)'%(n,n),c); oi[k]=(1 if q.group(1)=='-' else -1)*float(q.group(2)) if q else 0
for s,wd,f,n in re.findall(r'theta_m = theta_m(?:_read)? ([-+]) (\S+) rad \* (sin|cos)\((\d+) theta_m',c): ang.append(((1 if s=='-' else -1)*float(wd),f,int(n)))
M={'servo':servo,'hub':hub,'ipm':ipm}[mot]; S={'servo':S1,'hub':Sens(),'ipm':S3}[mot]; p=M.p
N=int(os.environ.get('N',7000)); thm=np.arange(N)*2*np.pi/N
def play(fn,corr):
    a=S.angle(thm)
    if corr: a=a+float(os.environ.get("SH",0))-sum((k*(np.sin if f=='sin' else np.cos)(n*a) for k,f,n in ang),0*a)
    d,q=fn(a)
    r=dq2abc(d,q,p*a)
    if corr: r=[r[k]*gi[k]+oi[k] for k in range(3)]
    t=S.true(r)
    if mot=='ipm':
        D,Q=abc2dq(*t,p*thm); return M.torque_em(p*thm,D,Q)
    return M.torque_em(thm,t)
def tab(a):
    D=np.empty_like(a);Q=np.empty_like(a)
    for i,x in enumerate(a):
        L.ev(ctypes.c_uint32(int((x*p/turns/(2*np.pi)%1)*2**32)),o); D[i],Q[i]=o[0],o[1]
    return D,Q
D,Q=tab(thm)
sine=lambda a:(D.mean()+0*a,Q.mean()+0*a)
print(folder,'period',turns,'el turns; corrections:',gi,oi,ang)
for nm,fn in (('sine',sine),('table',tab)):
    for corr in (0,1):
        T=play(fn,corr); F=np.fft.rfft(T)*2/N; k=np.argsort(-abs(F[1:]))[:5]+1
        print(f'  {nm:5s} corrected={corr}: mean {T.mean():.4f} p-p {np.ptp(T):.5f}  '+', '.join(f'el {x/p:.3g}:{abs(F[x])*1e3:.2f}m' for x in k))
