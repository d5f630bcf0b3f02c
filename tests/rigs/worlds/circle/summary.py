import json,glob,statistics as st,os
R=[json.load(open(f)) for f in sorted(glob.glob('lists/*/result.json'))]
main=[r for r in R if r['id'][0] in 'abcde' and not r['id'].startswith('x')]
def cnt(L,t):
    u=[r['user'] for r in L];b=[r for r in L if r.get('bound') and r.get('true_ideal') is not None]
    print(t,'lists',len(L),'tables',sum('true_ideal' in r for r in L),'bounds',len(b),'ideal kept',sum(r['true_ideal']<=r['bound'] for r in b),'real kept',sum(r['true_real']<=r['bound'] for r in b),'user median %.1f max %.1f'%(st.median(u),max(u)))
cnt(main,'main');cnt([r for r in R if r not in main],'variants');cnt(R,'all')
print('id|rc|user|verdict|before|model|bound|sine|ideal|real|ri|rr')
f=lambda x:'-' if x is None else '%.3g'%x
for r in R:
    b=r.get('bound');t=r.get('true_ideal')
    print('|'.join([r['id'],str(r['rc']),'%.1f'%r['user'],str(r['verdict'])[:24],f(r['before']),f(r['model']),f(b),f(r.get('true_sine')),f(t),f(r.get('true_real')),f(t/b if b and t is not None else None),f(r['true_real']/b if b and t is not None else None),(r.get('check_table')or'')[:12],(' kept' if 'promise was kept' in (r.get('again')or'') else ' NOTKEPT' if 'was not kept' in (r.get('again')or'') else '')]))
