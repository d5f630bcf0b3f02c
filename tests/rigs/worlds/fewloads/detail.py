import sys,json,os; sys.path.insert(0,'.')
from judge import *
for a in sys.argv[1:]:
    n,*suf=a.split(':'); o=f'out/{n}'; base=n[:-2] if n.endswith('_L') else n
    info=json.load(open(f'lists/{base}/info.json')); s=json.load(open(o+'/summary.json')); e=s.get('expected') or {}
    for fl in ([1] if not info['warm'] else [1,1-.0011*info['warm']*(len(info['runs'])-1)/2,1-.0011*info['warm']*(len(info['runs'])-1)]):
        m=M[info['mot']](); m.flux=fl
        if not os.path.exists(o+'/currents/currents.csv'): print(n,'no table',s['verdict']); continue
        for em in (False,True):
            if em and not os.path.exists(o+'/table/tuned.c'): continue
            T,D,Q=play(m,o,info,emitted=em); S=np.abs(np.fft.rfft(T))*2/len(T); k=np.argsort(-S[1:])[:6]+1
            print(n,'flux %.3f'%fl,'emitted' if em else 'currents','pp %.4g'%pp(T),'mean %.4g'%T.mean(),'orders',' '.join('%g:%.3g'%(x/m.p,S[x]) for x in k))
        X,I=sine(m,info['mode'],info['enc'],T.mean()); print('   sine pp %.4g'%pp(X),'I %.4g'%I,'bound',e.get('peak_to_peak_Nm_95'),'worst',e.get('worst_order'),e.get('worst_order_Nm_95'),'mean',e.get('mean_Nm'),e.get('mean_error_Nm_95'),'before/after',s['before']['peak_to_peak_Nm'],s['after']['peak_to_peak_Nm'],'rc verdict',s['verdict'],corrections(o))
