import sys,json,subprocess,os; sys.path.insert(0,'.')
from judge import *
for n,mech in (('1_less',26.0),('1_1k3',24.1),('1b_base',None),('1_replaced',None),('1b_three',None),('1_three',None)):
    o=f'out/{n}'; info=json.load(open(f'lists/{n}/info.json')); m=M[info['mot']]()
    off=np.degrees(corrections(o).get(('position_offset','angle'),0))
    cmd=[l for l in open(o+'/commands.sh') if ' solve ' in l][0]; a=float(cmd.split('--current-angle ')[1].split()[0])
    T,D,Q=play(m,o,info)
    new=f'out2/{n}'; os.makedirs(new+'/diagnose',exist_ok=True); subprocess.run(['rm','-rf',new+'/currents'])
    subprocess.run(['cp','-r',o+'/diagnose/machine',new+'/diagnose/'])
    lim=cmd.split('--limit-rms ')[1].split()[0] if '--limit-rms' in cmd else '1000'
    r=subprocess.run(['hci-solve','solve',new+'/diagnose/machine','--target',o+'/target.csv','-q','-o',new+'/currents','--method','pointwise','--current-angle',f'{a+off:.2f}','--limit-rms','300'],capture_output=True,text=True)
    S,_=sine(m,info['mode'],info['enc'],T.mean())
    try: T2,D2,Q2=play(m,new,info); s2='%.3g mean %.4g'%(pp(T2),T2.mean())
    except Exception as e: s2=str(e)+r.stderr[:200]
    print(f'{n}: solved at --current-angle {a}, offset found {off:.1f} deg; true pp {pp(T):.3g} mean {T.mean():.4g}; sine {pp(S):.3g}; solved anew at {a+off:.1f}: true pp {s2}; rc {r.returncode}')
