import sys,json,os,glob; sys.path.insert(0,'.')
from judge import *; import lists
for n in lists.L:
    p=f'lists/{n}/result.json'
    if not os.path.exists(p) or n[0] not in '145': continue
    if not os.path.exists(f'out/{n}/currents/currents.csv'): continue
    c=corrections(f'out/{n}'); o=json.load(open(p)); x=np.degrees(c.get(('position_offset','angle'),0))
    if abs(x)>1: print(n,'offset found %.1f deg (true %.0f)'%(x,json.load(open(f'lists/{n}/info.json'))['enc']),'rc',o['rc'],'true sine %.3g table %.3g'%(o['true_sine'],o['true_table']),'mean said %.3g true %.3g'%(o['mean'],o['true_mean']))
