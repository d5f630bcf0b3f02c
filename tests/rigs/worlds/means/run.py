import sys,os,json,subprocess,time,re
from sim import *
F,B=30,-30
D={}
def add(k,m,logs,torque,z=.05,ktoff=.0,**kw): D[k]=(m,logs,torque,z,ktoff,kw)
# logs: (iq,id,rpm) ; z: number or list
add('01_loadF_idleB','S',[(10,0,F),(0,0,B)],1.4,ktoff=.05)
add('02_loadF_idleF','S',[(10,0,F),(0,0,F)],1.4,ktoff=-.06)
add('03_two_F','S',[(10,0,F),(5,0,F)],1.4,ktoff=.08)
add('04_opp_sameF','S',[(10,0,F),(-10,0,F)],1.4,ktoff=-.08)
add('05_opp_motoring','S',[(10,0,F),(-10,0,B)],1.4,ktoff=.04)
add('06_F_Bbrake_idleF','S',[(10,0,F),(10,0,B),(0,0,F)],1.4,ktoff=.07)
add('07_three_F','S',[(5,0,F),(10,0,F),(15,0,F)],2.0,ktoff=-.05)
add('08_three_F_idle_FB','S',[(5,0,F),(10,0,F),(15,0,F),(0,0,F),(0,0,B)],2.0,ktoff=.06)
add('09_one_load','S',[(10,0,F)],1.4,ktoff=.03)
add('10_one_idle','S',[(0,0,F)],1.4,ktoff=.03)
add('11_loadF_idleB_dz','S',[(10,0,F),(0,0,B)],1.4,z=[.12,-.06],ktoff=.05)
add('12_two_F_dz','S',[(10,0,F),(5,0,F)],1.4,z=[.12,-.06],ktoff=-.05)
add('13_F_Bbrake_idleF_dz','S',[(10,0,F),(10,0,B),(0,0,F)],1.4,z=[.1,-.05,.02],ktoff=.05)
add('14_gear_three_F_idleB','S',[(5,0,F),(10,0,F),(15,0,F),(0,0,B)],2.0,ktoff=-.04,gear=.06)
add('15_gear_loadF_idleB','S',[(10,0,F),(0,0,B)],1.4,ktoff=.05,gear=.06)
add('16_gear_opp_idleFB','S',[(10,0,F),(-10,0,B),(0,0,F),(0,0,B)],1.4,ktoff=.05,gear=.06)
add('17_W_loadF_idleB','W',[(10,0,F),(0,0,B)],1.4,ktoff=.05)
add('18_W_three_F_idleF','W',[(5,0,F),(10,0,F),(15,0,F),(0,0,F)],2.0,ktoff=-.05)
add('19_W_two_F','W',[(10,0,F),(5,0,F)],1.4,ktoff=.05,gain=.02)
add('20_X_loadF_idleB','X',[(10,0,F),(0,0,B)],1.4,ktoff=.03)
add('21_X_two_F','X',[(10,0,F),(5,0,F)],1.4,ktoff=-.04)
add('22_X_id_idleF','X',[(10,0,F),(10,-6,F),(0,0,F)],1.4,ktoff=.05)
add('23_X_mtpa_idleB','X',[(10,-5,F),(5,-2,F),(0,0,B)],1.4,ktoff=.05)
add('24_X_5logs','X',[(14,-5,F),(10,4,F),(5,0,F),(0,0,F),(0,0,B)],1.8,ktoff=-.05)
add('25_X_opp','X',[(10,0,F),(-10,0,B)],1.4,ktoff=.05)
add('26_X_gear_three_idleB','X',[(5,0,F),(10,0,F),(15,0,F),(0,0,B)],2.0,ktoff=.04,gear=.05)
add('27_two_speeds_lag','S',[(10,0,F),(10,0,90),(0,0,F),(0,0,-90)],1.4,ktoff=.04,tau=1.5e-3)
add('28_loadF_idleB_lag','S',[(10,0,F),(0,0,B)],1.4,ktoff=.04,tau=2e-3)
add('29_W_dz_load2_idle','W',[(10,0,F),(5,0,B),(0,0,F)],1.4,z=[.1,-.05,.02],ktoff=.05)
add('30_two_F_extrap','S',[(8,0,F),(4,0,F)],2.0,ktoff=.05)
add('31_X_two_id_noidle','X',[(10,-5,F),(10,5,F)],1.4,ktoff=.05,z=[.05,-.05])
add('32_X_three_F_gain','X',[(5,0,F),(10,0,F),(15,0,F)],2.0,gain=-.03,ktoff=.05)
if os.path.exists('more.py'): exec(open('more.py').read())
M={'S':S,'W':W,'X':X}
inst={}
def run(k):
    mk,logs,tq,z,ko,kw=D[k]; kw=dict(kw); extra=kw.pop('args',[])
    m=inst.setdefault(mk,M[mk]()); rng=np.random.default_rng(sum(map(ord,k)))
    gain=kw.get('gain',.01); kw['gain']=gain
    fs=[]
    for j,(iq,id,rpm) in enumerate(logs):
        fn=f'L/{k}_{j}.csv'; fs.append(fn)
        log(fn,m,iq,id,rpm,z[j] if isinstance(z,list) else z,rng,turns=[4,5,3,4,6][j],n=[4000,5000,3000,3600,6000][j],**kw)
    cmd=['./hci-solve','tune']+fs+['--pole-pairs','7','--torque-constant','%.4f'%(m.kt*(1+ko)),'--slots',str(m.slots),'--rated-current','16','--torque',str(tq),'-o','O/'+k]+extra
    t0=time.time()
    r=subprocess.run(['nice','-n','5']+cmd,capture_output=True,text=True); dt=time.time()-t0
    open('O/'+k+'.txt','w').write('CMD '+' '.join(cmd)+f'\nEXIT {r.returncode} {dt:.0f}s\n'+r.stdout+'\n--- stderr\n'+r.stderr)
    out=f'{k} exit {r.returncode} {dt:.0f}s '
    wf='O/'+k+'/currents/waveform.csv'
    if os.path.exists(wf):
        pp,mean=play(m,wf); out+='TRUE pp %.4f mean %.4f meas-scale pp %.4f mean %.4f asked %.2f'%(pp,mean,pp*(1+gain),mean*(1+gain),tq)
    fl=' '.join(r.stdout.split())
    a=re.search(r'Ripple at most [\d.e+-]+ % of the mean torque \(95 %\), ([\d.e+-]+) N·m',fl) or re.search(r'at most ([\d.]+) N·m on the machine',fl)
    b=re.search(r'Mean torque ([\d.]+) N·m, at most ([\d.e+-]+) N·m off',fl)
    v=''
    if a and os.path.exists(wf):
        P=float(a.group(1)); v+=' P=%.3g P/true=%.2f'%(P,P/(pp*(1+gain)))+(' RIPPLE-BROKEN' if P<pp*(1+gain)*.995 else '')
    if b and os.path.exists(wf):
        off=abs(float(b.group(1))-mean*(1+gain)); v+=' MEAN off %.3f of %s'%(off,b.group(2))+(' MEAN-BROKEN' if off>float(b.group(2)) else '')
    elif os.path.exists(wf): v+=' no mean bound'
    out+=v
    print(out,'|',r.stdout.split('\n')[0][:300],flush=True)
    open('O/'+k+'.txt','a').write('\n'+out+'\n')
os.makedirs('O',exist_ok=True)
ks=[a for a in D if not sys.argv[1:] or any(a.startswith(s) for s in sys.argv[1:])]
for k in ks:
    try: run(k)
    except Exception as ex: print(k,'ERR',ex,flush=True)
