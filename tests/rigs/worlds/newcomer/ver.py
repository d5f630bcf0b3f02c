import subprocess,sys,os,re,io,numpy as np,json
import os; H=os.environ['HCI_INCLUDE']
def build(folder,exe='./simt',name='tuned'):
    h=open(f'{folder}/{name}.h').read()
    pp=int(re.search(r'_POLE_PAIRS (\d+)u',h).group(1));per=re.search(r'_PERIODS (\d+)u',h);per=int(per.group(1)) if per else pp
    m=re.search(r'2\^32 = (.*?)\.',h,re.S);print('  angle:',' '.join(m.group(1).split()).replace('*',''))
    subprocess.run(['gcc','-std=gnu99','-O2','-Wall','-Wextra','-I',H,'-I',folder,f'-DTABLE="{name}.h"',f'-DTNAME={name}','-Wno-unused','-o',exe,'sim.c',f'{folder}/{name}.c','-lm'],check=True)
    return pp/per
def run(exe,args):
    o=subprocess.run([exe]+args.split(),capture_output=True,text=True,check=True).stdout
    n=o[:o.index('\n')].split(',');a=np.loadtxt(io.StringIO(o),delimiter=',',skiprows=1)
    return {k:a[:,i] for i,k in enumerate(n)}
def mean_curve(a,turns=1,bins=2048):
    b=np.floor(((a['mtrue']/(2*np.pi))%1)*bins).astype(int)
    s=np.bincount(b,a['Ttrue'],bins);n=np.bincount(b,minlength=bins);return s[n>0]/n[n>0]
def pp(a): 
    c=mean_curve(a);return c.mean(),np.ptp(c)
def orders(a,p,top=6):
    c=mean_curve(a);F=2*np.fft.rfft(c)/len(c);k=np.argsort(-abs(F[1:]))[:top]+1
    return ' '.join('%.4g:%.4f'%(i/p,abs(F[i])) for i in sorted(k))
