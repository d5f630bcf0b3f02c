import subprocess,os,numpy as np,math,re,json,sys
SRC=r'''
#include <stdio.h>
#include "tuned.h"
int main(void){unsigned a; while(fread(&a,4,1,stdin)==1){hci_currents_dq i=hci_table_f32_dq(&tuned,a);float o[2]={i.id_A,i.iq_A};fwrite(o,4,2,stdout);}return 0;}
'''
def build(folder):
    t=os.path.join(folder,'table'); exe=os.path.join(folder+'_play')
    open(exe+'.c','w').write(SRC)
    subprocess.run(['gcc','-O1','-I',t,'-I',os.environ['HCI_INCLUDE'],exe+'.c',t+'/tuned.c','-o',exe,'-lm'],check=True)
    return os.path.abspath(exe)
def info(folder):
    h=open(folder+'/table/tuned.h').read()
    m=re.search(r'2\^32 = (\d+) electrical',h); periods=int(m.group(1))
    m=re.search(r'mechanical angle \+ \((-?[\d.]+)\) degrees',h); off=float(m.group(1)) if m else 0.0
    return periods,off,h
def sensors(h):
    """corrections of angle: list (sign,amp,fn,n); currents offs, gains"""
    ang=[];offs=[0,0,0];gain=[1,1,1]
    hh=re.sub(r'\n \* +',' ',h)
    for s,a,f,n in re.findall(r'theta_m = theta_m(?:_read)? ([-+]) (\S+) rad \* (sin|cos)\((\d+) theta_m',hh):
        ang.append((-1 if s=='-' else 1,float(a),f,int(n)))
    for p,s,a in re.findall(r'i_([abc]) = \(i_[abc]_read ([-+]) (\S+) A\)',hh):
        offs['abc'.index(p)]=(1 if s=='-' else -1)*float(a)
    for p,a in re.findall(r'i_([abc]) = \(?i_[abc]_read(?: [-+] \S+ A\))? \* ([\d.]+)',hh): gain['abc'.index(p)]=1/float(a)
    return ang,offs,gain
def table(folder,thm,p,correct=True):
    """dq of the table at the log's mechanical angle thm (array), correcting the angle; returns te_used (elec), id, iq"""
    exe=build(folder); per,off,h=info(folder); ang,offs,gain=sensors(h)
    th=np.array(thm,float)
    if correct:
        c=np.zeros_like(th)
        for s,a,f,n in ang: c+=s*a*(np.sin if f=='sin' else np.cos)(n*th)
        th=th+c
    te=p*th+math.radians(off)
    if correct:
        hh=re.sub(r'\n \* +',' ',h)
        c=0
        for sg,a,f,n in re.findall(r'(subtract|add) (?:from|to) the electrical angle (\S+) rad (sin|cos)\((\d*) ?theta\)',hh):
            c=c+(-1 if sg=='subtract' else 1)*float(a)*(np.sin if f=='sin' else np.cos)(int(n or 1)*te)
        for sg,a in re.findall(r'(subtract|add) (\S+) rad (?:from|to) the electrical angle',hh): c=c+(-1 if sg=='subtract' else 1)*float(a)
        te=te+c
    u=(np.floor((te/(2*math.pi*per)%1.0)*2**32)).astype(np.uint64)%(2**32)
    r=subprocess.run([exe],input=u.astype(np.uint32).tobytes(),stdout=subprocess.PIPE,check=True).stdout
    o=np.frombuffer(r,dtype=np.float32).reshape(-1,2).astype(float)
    return te,o[:,0],o[:,1],offs,gain
def pp(x): return x.max()-x.min()
