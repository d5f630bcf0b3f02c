import sys,os,json,subprocess,resource,shutil,time,csv
from plant import *
HCI=os.environ.get('HCI','hci-solve')
OUT=os.environ.get('OUT','lists')
R2D=180/np.pi;T2=2*np.pi
def rpm(x): return x*T2/60
# ---------- how logs look ----------
def w(f,head,cols,fmt='%.6g',delim=',',pre='',dec='.'):
    a=np.column_stack(cols)
    with open(f,'w',encoding='utf-8') as g:
        g.write(pre);g.write(head+'\n')
        for r in a:
            l=delim.join(fmt%x if isinstance(fmt,str) else fm%x for x,fm in zip(r,[fmt]*len(r) if isinstance(fmt,str) else fmt))
            g.write((l.replace('.',dec) if dec!='.' else l)+'\n')
def wr(x): return np.mod(x,T2)
F={}
def daq(f,o,p): w(f,'time_s,theta_m_deg,speed_rpm,ia_A,ib_A,ic_A,torque_Nm',[o[:,0],o[:,2]*R2D,o[:,3]*60/T2,o[:,4],o[:,5],o[:,6],o[:,9]],'%.7g')
def daqdq(f,o,p): w(f,'Time [s],Rotor angle [deg],Speed [rpm],Id [A],Iq [A],Torque [Nm]',[o[:,0],wr(o[:,2])*R2D,o[:,3]*60/T2,o[:,7],o[:,8],o[:,9]],'%.7g')
def daqv(f,o,p): w(f,'time_s,theta_m_deg,speed_rpm,va_V,vb_V,vc_V,torque_Nm',[o[:,0],o[:,2]*R2D,o[:,3]*60/T2,o[:,11],o[:,12],-o[:,11]-o[:,12],o[:,9]],'%.7g')
def odrive(f,o,p): w(f,'timestamp,axis0.pos_vel_mapper.pos_rel,axis0.pos_vel_mapper.vel,axis0.motor.foc.Id_measured,axis0.motor.foc.Iq_measured,axis0.motor.torque_estimate',[o[:,0],o[:,2]/T2,o[:,3]/T2,o[:,7],o[:,8],o[:,8]*.03],'%.7g')
def simplefoc(f,o,p): w(f,'time_us\ttarget\tvoltage.q\tvoltage.d\tcurrent.q\tcurrent.d\tvelocity\tangle',[o[:,0]*1e6,o[:,3]*0+1.05,o[:,14],o[:,13],o[:,8]*1e3,o[:,7]*1e3,o[:,3],o[:,2]],'%.8g','\t')
def simplefoc2(f,o,p): w(f,'time_us,shaft_angle,shaft_velocity,current_q_A,current_d_A',[o[:,0]*1e6,o[:,2],o[:,3],o[:,8],o[:,7]],'%.8g')
def vesc(f,o,p): w(f,'ms_today;input_voltage;temp_mos_max;temp_motor;current_motor;d_axis_current;q_axis_current;erpm;duty_cycle;encoder_position;fault_code',[np.round(o[:,0]*1e3+4.1e7),24+0*o[:,0],31+0*o[:,0],o[:,15],np.hypot(o[:,7],o[:,8]),o[:,7],o[:,8],o[:,3]*60/T2*p,o[:,14]/24,wr(o[:,2])*R2D,0*o[:,0]],'%.9g',';')
def moteus(f,o,p): w(f,'time,mode,position,velocity,torque,q_current,d_current,voltage,motor_temperature',[o[:,0],10+0*o[:,0],o[:,2]/T2,o[:,3]/T2,o[:,8]*.03,o[:,8],o[:,7],24+0*o[:,0],o[:,15]],'%.7g')
def excel(f,o,p): w(f,'Zeit [s];Winkel mech. [°];Drehzahl [1/min];Strom U [A];Strom V [A];Strom W [A];Drehmoment [Nm]',[o[:,0],wr(o[:,2])*R2D,o[:,3]*60/T2,o[:,4],o[:,5],o[:,6],o[:,9]],'%.7g',';',pre='Prüfstand 3;;;;;;\nDatum;12.3.2026;;;;;\n',dec=',')
def lvm(f,o,p): w(f,'X_Value\tMech angle (deg)\tI_U (A)\tI_V (A)\tI_W (A)\tTorque (Nm)\tComment',[o[:,0],wr(o[:,2])*R2D,o[:,4],o[:,5],o[:,6],o[:,9]],'%.7g','\t',pre='LabVIEW Measurement\t\nWriter_Version\t2\nReader_Version\t2\nSeparator\tTab\nDecimal_Separator\t.\nMulti_Headings\tNo\nX_Columns\tOne\nTime_Pref\tRelative\n***End_of_Header***\t\n\nChannels\t5\n***End_of_Header***\n')
def simulink(f,o,p): w(f,'time,theta_m,w_m,i_sd,i_sq,T_e',[o[:,0],o[:,2],o[:,3],o[:,7],o[:,8],o[:,9]],'%.7g')
def plc(f,o,p): w(f,'Timestamp;Axis_1.ActualPosition [deg];Axis_1.ActualVelocity [deg/s];Axis_1.TorqueCurrent [A];Axis_1.FollowingError [deg]',[o[:,0],o[:,2]*R2D,o[:,3]*R2D,o[:,8],0*o[:,0]+.01],'%.6g',';')
def plcrms(f,o,p): w(f,'Timestamp;Axis_1.ActualPosition [deg];Axis_1.ActualVelocity [deg/s];Axis_1.ActualCurrent [A rms];Axis_1.DrehmomentSensor [Nm]',[o[:,0],o[:,2]*R2D,o[:,3]*R2D,o[:,8]/np.sqrt(2),o[:,9]],'%.6g',';')
for g in (daq,daqdq,daqv,odrive,simplefoc,simplefoc2,vesc,moteus,excel,lvm,simulink,plc,plcrms): F[g.__name__]=g
# ---------- kinds of logs ----------
def slow(P,r=15,turns=1.4,fmt='odrive',hz=500,brake=0,name='slow',**kw):
    kw.setdefault('speedbw',60 if P.name!='ring' else 20)
    """position/velocity control, forward and back"""
    T=2*(turns/(r/60))+1.2
    o=P.run(T,mode=2 if brake else 1,w0=rpm(r),dec=int(P.m['fs']/hz),brake=brake,**kw);return [(name+'.csv',fmt,o)]
def dyno(P,name,iq,id=0,r=60,turns=10,fmt='daq',hz=1000,**kw):
    T=turns/(abs(r)/60)+.3
    o=P.run(T,mode=0,w0=rpm(r),iq=iq,id=id,dec=max(1,int(P.m['fs']/hz)),**kw);return [(name+'.csv',fmt,o)]
def loads(P,levels=(0,.33,.66,1.),r=60,fmt='daq',share=1.,ids=None,**kw):
    I=P.m['rated']*share;ls=[]
    for k,l in enumerate(levels):
        ls+=dyno(P,'load%d%s'%(round(100*l),'' if levels.count(l)<2 else 'abc'[k%3]),l*I,(ids[k]*I if ids else 0),r*(-1 if k==2 else 1),fmt=fmt,seed=k+3,**kw)
    return ls
# ---------- the circle ----------
def call(cmd,cwd,log):
    t=time.time();r0=resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    q=subprocess.run(cmd,cwd=cwd,stdout=subprocess.PIPE,stderr=subprocess.STDOUT,text=True,timeout=500)
    u=resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime-r0
    open(os.path.join(cwd,log),'w').write('$ '+' '.join(c if ' ' not in c else "'%s'"%c for c in cmd)+'\n'+q.stdout+'\nrc %d  wall %.1f user %.1f\n'%(q.returncode,time.time()-t,u))
    return q.returncode,q.stdout,u
def circle(id,P,logs,args,play_rpm=60,play=None,second='dyno',fmt2='daq',tune_of=None,note='',sensor=True,again=True,runs=None,init=None):
    play=play or P
    d=OUT+'/'+id;shutil.rmtree(d,ignore_errors=True);os.makedirs(d);p=P.m['p']
    for f,fm,o in logs: F[fm](d+'/'+f,o,p)
    fs=[f for f,_,_ in logs]
    if runs:
        with open(d+'/runs.csv','w') as g:
            g.write('file,role\n'+''.join('%s,%s\n'%(f,'holdout' if k in runs else 'fit') for k,f in enumerate(fs)))
        call([HCI,'init','mot']+init,d,'init.txt');cmd=[HCI,'tune','mot','--runs','runs.csv']+args+['-o','t']
    else: cmd=[HCI,'tune']+fs+args+['-o','t']
    rc,so,u=call(cmd,d,'tune.txt')
    R=dict(id=id,note=note,rc=rc,user=u,cmd=' '.join(cmd[1:]),first=so.split('\n')[0])
    try: S=json.load(open(d+'/t/summary.json'))
    except Exception: S={}
    R['verdict']=S.get('verdict');e=S.get('expected') or {};R['bound']=e.get('peak_to_peak_Nm_95');R['known']=e.get('known');R['mean_bound']=e.get('mean_error_Nm_95');R['mean_said']=(S.get('after') or {}).get('mean_Nm')
    R['before']=(S.get('before') or {}).get('peak_to_peak_Nm');a=S.get('after') or {};R['model']=max(a.get('table_peak_to_peak_Nm') or 0,a.get('peak_to_peak_Nm') or 0)
    if os.path.exists(d+'/t/table'):
        tab,per,h=read_table(d+'/t/table');per=per or 1
        import re
        m=re.search(r'plus (-?[\d.]+)',h)
        yi=play.static(tab,per);mean=float(yi.mean())
        # plain sine of the same true mean
        I=mean/P.Kt
        for _ in range(6):
            ys=play.static(iq=I);I*=mean/ys.mean() if abs(ys.mean())>1e-9 else 1
        wv=rpm(play_rpm);T=8/(play_rpm/60)+.5
        o=play.run(T,tab,per,w0=wv,dec=1,seed=77,anoise=0,aq=0,alias=0,hunt=0,hunt1=0);yr=play.binned(o)  # repeatable part alone: no ADC noise
        os_=play.run(T,None,1,w0=wv,iq=I,dec=1,seed=78,anoise=0,aq=0,alias=0,hunt=0,hunt1=0);ysr=play.binned(os_)
        R.update(true_ideal=pp(yi),true_sine=pp(ys),true_real=pp(yr),sine_real=pp(ysr),mean_true=mean)
        o2=play.run(T+2/(play_rpm/60),tab,per,w0=wv,dec=max(1,int(P.m['fs']/1000)),seed=79)
        F[fmt2](d+'/second.csv',o2,p)
        rc2,s2,u2=call([HCI,'check','t/diagnose/machine' if os.path.exists(d+'/t/diagnose/machine') else 't/machine','second.csv','--table','t/currents'],d,'checktable.txt');R['check_table']='%d %s'%(rc2,s2.split('\n')[0])
        if os.path.exists(d+'/t/diagnose') and sensor and again:
            open(d+'/new.csv','w').write('file,role\nsecond.csv,holdout\n')
            rc3,s3,u3=call([HCI,'diagnose','--again','t/diagnose','--runs','new.csv','-o','second'],d,'again.txt')
            pr=[l for l in s3.replace('\n    ',' ').replace('\n  ','\n').split('\n') if 'promise' in l or 'promis' in l]
            R['again']='%d %s | %s'%(rc3,s3.split('\n')[0],' '.join(pr)[:400]);R['again_user']=u3
    json.dump(R,open(d+'/result.json','w'),indent=1)
    show(R);return R
def g(x): return '-' if x is None else '%.4g'%x
def show(R):
    print('## %s  [%s] rc %s user %.1f  verdict: %s\n   %s'%(R['id'],R['note'],R['rc'],R['user'],R['verdict'],R['first'][:900]))
    print('   said: before %s model %s bound95 %s | TRUE sine %s (real loop %s) table ideal %s real %s | mean said %s true %s'%tuple(map(g,(R['before'],R['model'],R['bound'],R.get('true_sine'),R.get('sine_real'),R.get('true_ideal'),R.get('true_real'),R['mean_said'],R.get('mean_true')))))
    if R['bound'] and R.get('true_ideal') is not None: print('   ratio true/bound ideal %.2f real %.2f'%(R['true_ideal']/R['bound'],R['true_real']/R['bound']))
    if R.get('check_table'): print('   check --table: '+R['check_table'][:250])
    if R.get('again'): print('   again: '+R['again'][:700])
    sys.stdout.flush()
def main(LISTS):
    want=sys.argv[1:] 
    if want and '/' in want[0]:
        global HCI;HCI=want[0];want=want[1:]
    for k,f in LISTS.items():
        if not want or k in want:
            try: f(k)
            except Exception as ex: print('##',k,'SCRIPT',repr(ex))
