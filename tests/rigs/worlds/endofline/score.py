#!/usr/bin/env python3
"""score.py BIN [--seeds N|A-B] [--kinds a,b] [--jobs J] [--keep DIR] [-v]: e exact, h honest, w wrong for each kind and seed."""
import argparse, csv, json, os, re, resource, shutil, subprocess, sys, tempfile, math
from concurrent.futures import ThreadPoolExecutor
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import world
U = {'': 1, '1': 1, '-': 1, '%': .01, 'mA': 1e-3, 'deg': math.pi/180, 'mrad': 1e-3, 'ms': 1e-3, 'us': 1e-6, 'mH': 1e-3, 'uH': 1e-6, 'mNm': 1e-3}
def go(binary, folder, limit=60):
    out = folder+'/out'; shutil.rmtree(out, ignore_errors=True)
    o, e = open(folder+'/words.txt', 'w'), open(folder+'/remarks.txt', 'w')
    p = subprocess.Popen(['nice', '-n', '10', binary, 'diagnose', folder+'/machine', '--runs', folder+'/runs.csv', '-o', out], stdout=o, stderr=e,
                         preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit)))
    _, st, ru = os.wait4(p.pid, 0); p.returncode = os.waitstatus_to_exitcode(st)
    return p.returncode, ru.ru_utime+ru.ru_stime
def answer(folder):
    o = folder+'/out'; A, Mb, val = [], [], {}
    for r in csv.DictReader(open(o+'/effects.csv')):
        if r['verdict'] == 'added': A.append(r['effect'])
        elif r['verdict'] == 'ambiguous': Mb.append(r['effect'])
    f = o+'/machine/effects.csv'
    if os.path.exists(f):
        for r in csv.DictReader(open(f)):
            u = U.get(r['unit'], 1); val.setdefault(r['effect'], {})[r['parameter']] = (float(r['value'])*u, float(r['std_error'] or 0)*u)
    return json.load(open(o+'/summary.json'))['verdict'], [a for a in A if a != 'unknown'], [a for a in Mb if a != 'unknown'], val
def close(want, got):
    """largest deviation from what is hidden, relative to the largest hidden value of the effect; and in standard errors"""
    big = max([abs(v) for v in want.values()] or [0]); bad = 0.
    def look(k):
        if k in got: return got[k]
        m = re.match(r'(.*_)(\d*\.\d+)$', k)
        if m:
            for g, v in got.items():
                n = re.match(r'(.*_)(\d*\.?\d+)$', g)
                if n and n[1] == m[1] and abs(float(n[2])-float(m[2])) < 2e-6: return v
        return (0., 0.)
    for k, v in want.items():
        if '-' in k:
            a, b = k.split('-'); g = look(a)[0]-look(b)[0]; s = math.hypot(look(a)[1], look(b)[1])
        else: g, s = look(k)
        if abs(g-v) > 4*s: bad = max(bad, abs(g-v)/big)
    return bad
def judge(x, code, cpu, folder):
    if code not in (0, 1): return 'w', f'exit {code}, {cpu:.1f} s: '+open(folder+'/remarks.txt').read()[-300:].replace('\n', ' ')
    v, A, Mb, val = answer(folder); words = open(folder+'/words.txt').read(); T = x['truth']; al = x.get('alias', set()); note = f"{v}; added {A}; ambiguous {Mb}"
    if 'index slip' in words: return 'w', note+'; an index slip is named, none is hidden'
    if cpu > 30: return 'w', f'{cpu:.0f} s of processor; '+note
    c = x['cls']
    if c == 'sound':
        if A or Mb: return 'w', note+f' {val}'
        import numpy as np                      # what the declared machine leaves of the readings, by the model of world.py
        for q, d in zip(x['runs'], x['data']):
            if q.get('notorque') or x.get('hold'): continue
            raw = d['torque_Nm']-x['decl'].torque(d['theta_m_rad'], np.array([d['ia_A'], d['ib_A'], d['ic_A']]), d['temperature_C'])[0]; rms = float(np.sqrt(np.mean(raw**2)))
            for r in csv.DictReader(open(folder+'/out/errors.csv')):
                if r['file'] == f"runs/{q['name']}.csv" and float(r['rms_before_Nm'] or 0) > 1.5*rms:
                    return 'w', note+f"; errors.csv: {r['file']} has {r['rms_before_Nm']} N·m left by the declared machine, its readings have {rms:.4g}"
        return ('e' if v == 'complete' else 'h'), note
    if c == 'slip':
        if A: return 'w', note
        return ('e' if re.search(x['words'], re.sub(r'\S*/\S*', '', words), re.I) else 'h'), note
    if c == 'unknown':
        ok = x.get('allowed', set())
        if set(A)-ok: return 'w', note+f' false: {sorted(set(A)-ok)} {val}'
        if v == 'complete': return 'w', note+' (denied)'
        if v == 'explained': return 'w' if not A else 'h', note
        return ('e' if v in ('partly explained', 'unknown') else 'h'), note
    false = set(A)-set(T)-al; dev = {t: close(T[t], val.get(t, {})) for t in T if t in A and T[t]}
    note += ''.join(f'; {t} off by {100*d:.0f} %' for t, d in dev.items() if d > .05)
    if false: return 'w', note+f' false: {sorted(false)}'+f' {val}'
    if v == 'complete': return ('h' if x.get('loose') else 'w'), note+' (denied)'
    miss = [t for t in T if t not in A+Mb]
    if any(d > .3 for d in dev.values()): return 'w', note+f' {val}'
    if v == 'explained':
        if miss and not (set(A+Mb) & al) and not x.get('loose'): return 'w', note+f' missing {miss}'
        return ('e' if not miss and not set(A)-set(T) and max(list(dev.values()) or [0]) < .12 else 'h'), note
    if v == 'ambiguous' and miss and not (set(A+Mb) & al): return 'w', note+f' missing {miss}'
    return 'h', note
def one(binary, kind, seed, keep, again=False):
    f = os.path.join(keep, f'{kind}_{seed}')
    if again:
        old = json.load(open(f+'/judged.json')); x = world.build(kind, seed); code, cpu = old.get('code', 0), old['cpu']
        if not os.path.exists(f+'/out/summary.json'): code = 99
    else:
        shutil.rmtree(f, ignore_errors=True); x = world.make(kind, seed, f); code, cpu = go(binary, f)
    try: j, note = judge(x, code, cpu, f)
    except Exception as err: j, note = 'w', f'no answer: {err!r}'
    json.dump(dict(kind=kind, seed=seed, cls=x['cls'], judged=j, cpu=cpu, code=code, note=note, truth={k: {a: float(b) for a, b in v.items()} for k, v in x['truth'].items()}), open(f+'/judged.json', 'w'))
    return kind, seed, x['cls'], j, cpu, note
def main():
    a = argparse.ArgumentParser(); a.add_argument('program'); a.add_argument('--rejudge', action='store_true', help='judge what --keep holds again'); a.add_argument('--seeds', default='0-1', help='A-B, or N for 0 to N-1'); a.add_argument('--kinds'); a.add_argument('--jobs', type=int, default=1); a.add_argument('--keep'); a.add_argument('-v', action='store_true'); a = a.parse_args()
    first, _, last = ('0-%d' % (int(a.seeds)-1) if a.seeds.isdigit() else a.seeds).partition('-'); ks = a.kinds.split(',') if a.kinds else list(world.KINDS); keep = a.keep or tempfile.mkdtemp(); res = []
    with ThreadPoolExecutor(a.jobs) as ex:
        for r in ex.map(lambda q: one(a.program, q[1], q[0], keep, a.rejudge), [(s, k) for s in range(int(first), int(last)+1) for k in ks]):
            res.append(r)
            if a.v or r[3] == 'w': print(f'{r[3]} {r[0]} {r[1]} ({r[2]}, {r[4]:.1f} s): {r[5]}', flush=True)
    print(f"\n{'kind':30s}{'class':9s} e h w")
    for k in ks:
        q = [r for r in res if r[0] == k]; print(f'{k:30s}{q[0][2]:9s} '+' '.join(str(sum(r[3] == c for r in q)) for c in 'ehw'))
    for c in ('sound', 'known', 'unknown', 'slip'): print(c, {j: sum(r[3] == j and r[2] == c for r in res) for j in 'ehw'})
    print('all', {j: sum(r[3] == j for r in res) for j in 'ehw'}, f'processor {sum(r[4] for r in res)/max(len(res), 1):.1f} s a case, at most {max([r[4] for r in res] or [0]):.1f}')
    if not a.keep: shutil.rmtree(keep)
if __name__ == '__main__': main()
