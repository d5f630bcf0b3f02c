import json,glob,os,sys,re
sys.path.insert(0,'.'); import lists
f=lambda x,s='%.3g': ' - ' if x is None else s%x
for n in (sys.argv[1:] or lists.L):
    p=f'lists/{n}/result.json'
    if not os.path.exists(p): continue
    o=json.load(open(p)); e=o.get('exp') or {}
    b=e.get('peak_to_peak_Nm_95') if e.get('known') else None
    t=o.get('true_emitted') or o.get('true_table')
    fl=''
    if b and t and t>b: fl+=' BROKEN x%.2f'%(t/b)
    if t and t>o['true_sine']: fl+=' WORSE'
    if o.get('before') and abs(o['before']/o['true_sine']-1)>.15: fl+=' before-off %+.0f%%'%(100*(o['before']/o['true_sine']-1))
    if t and o.get('true_mean') and abs(o['true_mean']/o['mean']-1)>.03: fl+=' mean %+.1f%%'%(100*(o['true_mean']/o['mean']-1))
    print(f"{n:14s} rc{o['rc']} {o['cpu']:5.1f}s | {f(o.get('before'))} / {f(o.get('after'),'%.2g')} / {f(b)} | {f(o.get('true_sine'))} / {f(t)} | mean {f(o.get('mean'))} {f(o.get('true_mean'))} | {o.get('verdict')}{fl}")
