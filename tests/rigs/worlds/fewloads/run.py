import sys,os,subprocess,json,resource,time
sys.path.insert(0,'.'); os.environ['OMP_NUM_THREADS']='1'; os.environ['OPENBLAS_NUM_THREADS']='1'
from gen import *; from judge import *; import lists
def go(name,extra=()):
    k=dict(lists.L[name]); extra=list(extra)+list(k.pop('args',[])); c=make(name,**k)
    out=f'out/{name}'
    c=c+extra+['-o',out]; subprocess.run(['rm','-rf',out])
    open(f'lists/{name}/cmd','w').write(' '.join(c)+'\n')
    a=resource.getrusage(resource.RUSAGE_CHILDREN); t0=time.time()
    r=subprocess.run(c,capture_output=True,text=True)
    b=resource.getrusage(resource.RUSAGE_CHILDREN); cpu=b.ru_utime+b.ru_stime-a.ru_utime-a.ru_stime
    open(f'lists/{name}/said.txt','w').write(r.stdout+r.stderr)
    o=dict(name=name,rc=r.returncode,cpu=round(cpu,1),wall=round(time.time()-t0,1))
    try: s=json.load(open(out+'/summary.json'))
    except Exception as e: print(o,r.stderr[-300:]); return o
    info=json.load(open(f'lists/{name}/info.json'))
    o['verdict']=s['verdict']; o['words']=s['words']
    if s.get('before') and os.path.exists(out+'/currents/currents.csv'):
        o['before']=s['before']['peak_to_peak_Nm']; o['after']=s['after']['peak_to_peak_Nm']; o['exp']=s.get('expected')
        m=M[info['mot']](); m.flux=1-.0011*info['warm']*(len(info['runs'])-1)/2
        T,D,Q=play(m,out,info); S,I=sine(m,info['mode'],info['enc'],T.mean())
        S0,_=sine(m,info['mode'],info['enc'],s['after']['mean_Nm'])
        o['true_table']=pp(T); o['true_emitted']=pp(play(m,out,info,emitted=True)[0]) if os.path.exists(out+'/table/tuned.c') else None; o['true_sine']=pp(S); o['mean']=s['after']['mean_Nm']; o['true_mean']=T.mean(); o['dq']=(D.mean(),Q.mean())
    json.dump(o,open(f'lists/{name}/result.json','w'))
    f=lambda x:'  -  ' if x is None else f'{x:.4g}'
    e=o.get('exp') or {}
    print(name,'rc',o['rc'],'cpu',o['cpu'],'|',o['verdict'],'| before',f(o.get('before')),'after',f(o.get('after')),'exp',json.dumps(e)[:160],'| true sine',f(o.get('true_sine')),'table',f(o.get('true_table')),'emitted',f(o.get('true_emitted')),'mean',f(o.get('mean')),f(o.get('true_mean')),'dq',o.get('dq'),flush=True)
    return o
if __name__=='__main__':
    for n in (sys.argv[1:] or lists.L): go(n)
