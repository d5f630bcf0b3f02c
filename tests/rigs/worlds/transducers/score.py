#!/usr/bin/env python3
"""score.py PROGRAM [--seeds A-B] [--kinds a,b] [--keep DIR]: a line for each list (exact, honest, wrong; the true ripple of solved
currents beside the bound), then a table of the kinds. Some answers that it counts as exact or honest ask for eyes: a bound that is broken."""
import argparse, collections, csv, json, math, os, shutil, subprocess, sys, tempfile, time

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import world as W

BIN = None


def table(p):
    with open(p) as f: return list(csv.DictReader(l for l in f if not l.startswith('#')))


def judge(w, out, rc, dt):
    t = w.truth; r = dict(kind=w.kind, seed=w.seed, p=w.p, rc=rc, sec=round(dt, 2))
    if not os.path.exists(out + '/summary.json'): return dict(r, judged='wrong', why='nothing written')
    S = json.load(open(out + '/summary.json')); E = table(out + '/effects.csv')
    try: M = {(x['effect'], x['parameter']): (float(x['value']), float(x['std_error'] or 0), x['unit']) for x in table(out + '/machine/effects.csv')}
    except OSError: M = {}
    add = [x['effect'] for x in E if x['verdict'] == 'added']; amb = [x['effect'] for x in E if x['verdict'] == 'ambiguous']
    r.update(verdict=S['verdict'], added=add, ambiguous=amb, detail={x['effect']: x['detail'] for x in E if x['verdict'] != 'rejected'}, words=S['words'],
             rms=[S[k] for k in ('rms_before_Nm', 'rms_after_Nm', 'noise_Nm', 'holdout_rms_before_Nm', 'holdout_rms_after_Nm', 'holdout_noise_Nm')])
    known = {x for g in t['hidden'] for x in g} | set(t['may']); inm = {k[0] for k in M}
    false = [x for x in add if x not in known and x != 'unknown']
    vals = []
    for e, pn, v in t['values']:
        g = M.get((e, pn)); ok = g and abs(g[0] - v) <= max(.2 * abs(v), 2.5 * g[1]); vals.append((e, pn, v, g, bool(ok)))
    r['values'] = vals; r['false'] = false
    if t['clean']:
        j = 'exact' if S['verdict'] == 'complete' and not add and not amb else 'wrong' if false else 'honest'
    elif w.kind.startswith('file_') and S.get('disagrees'):
        j = 'exact' if 'full_lag' in json.dumps(S['disagrees']) and not false else 'wrong'
    elif t.get('none_named'):
        j = 'wrong' if false or S['verdict'] in ('complete', 'explained') else 'honest'
    else:
        have = [any(x in add + amb for x in g) for g in t['hidden']]
        if all(have) and not false and S['verdict'] == 'explained' and all(v[4] or v[3] is None for v in vals): j = 'exact'
        elif false: j = 'wrong'
        elif S['verdict'] in ('explained', 'complete'): j = 'wrong'
        else: j = 'honest'
    r['judged'] = j
    return r


def bound(w, out):
    tg = out + '/t.csv'; open(tg, 'w').write('order,amplitude_Nm,phase_rad\n0,%.6g,0\n' % (.6 * w.T0))
    d = out + '/solved'; p = subprocess.run([BIN, 'solve', out + '/machine', '--target', tg, '--auto', '-q', '-o', d], capture_output=True, text=True)
    if not os.path.exists(d + '/summary.json'): return dict(rc=p.returncode, err=p.stderr[-300:])
    S = json.load(open(d + '/summary.json')); X = S['expected']
    thm = np.linspace(0, W.TAU, 6001)[:-1]; th = w.p * thm; i = [0 * th for _ in range(3)]
    for c in table(d + '/currents.csv'):
        n, A, g = float(c['order']), float(c['amplitude_A']), float(c['phase_rad'])
        sg = {'pos': 1, 'asym': 1, 'neg': -1, 'zero': 0, 'sym': [0, 1, -1][int(round(n)) % 3]}[c['set']]
        for s in range(3): i[s] = i[s] + A * np.sin(n * th - sg * W.PH[s] + g)
    T = w.T(thm, *i, w.tref)
    pp = T.max() - T.min()
    return dict(rc=p.returncode, known=X.get('known'), remark=X.get('remark'), bound_pp=X.get('peak_to_peak_Nm_95'), true_pp=pp, model_mean=S['torque']['mean_Nm'], true_mean=float(T.mean()),
                bound_pc=X.get('T_ripple_percent_95'), true_pc=100 * pp / T.mean())


def one(kind, seed, base):
    src, out = f'{base}/data/{kind}_{seed}', f'{base}/out/{kind}_{seed}'
    shutil.rmtree(src, ignore_errors=True); shutil.rmtree(out, ignore_errors=True)
    w = W.make(kind, seed, src); t0 = time.time()
    command = ['nice', BIN, 'diagnose', src + '/machine', '--runs', src + '/runs.csv', '-o', out] + w.flags
    try: p = subprocess.run(command, capture_output=True, text=True, timeout=90); rc, err = p.returncode, p.stderr
    except subprocess.TimeoutExpired: rc, err = -9, 'time'
    dt = time.time() - t0; os.makedirs(out, exist_ok=True); open(out + '/words.txt', 'w').write(err)
    r = judge(w, out, rc, dt); r['truth'] = w.truth
    if os.path.exists(out + '/machine'):
        try: r['bound'] = bound(w, out)
        except Exception as e: r['bound'] = dict(err=repr(e))
    json.dump(r, open(out + '/judged.json', 'w'), indent=1, default=float)
    return r


def main():
    global BIN
    q = argparse.ArgumentParser(); q.add_argument('program'); q.add_argument('--seeds', default='1-2'); q.add_argument('--kinds'); q.add_argument('--keep')
    a = q.parse_args(); BIN = os.path.abspath(a.program)
    first, _, last = a.seeds.partition('-'); kinds = a.kinds.split(',') if a.kinds else list(W.K); base = a.keep or tempfile.mkdtemp()
    count, broken, stated = collections.defaultdict(collections.Counter), 0, 0
    for seed in range(int(first), int(last or first) + 1):
        for kind in kinds:
            r = one(kind, seed, base); count[kind][r['judged']] += 1; b = r.get('bound', {})
            is_stated = b.get('bound_pp') is not None and 'true_pp' in b; stated += is_stated; broken += is_stated and b['true_pp'] > b['bound_pp']
            print('%-22s %d %-7s rc%d %5.1fs %-17s + %s ~ %s F %s | %s' % (kind, seed, r['judged'], r['rc'], r['sec'], r.get('verdict'), ','.join(r.get('added', [])), ','.join(r.get('ambiguous', [])), r.get('false'),
                  'pp %.4g bound %s' % (b['true_pp'], b.get('bound_pp')) if 'true_pp' in b else b), flush=True)
    print(f"\n{'kind':24s}exact honest wrong")
    for kind in kinds: print(f"{kind:24s}" + ' '.join(f"{count[kind][j]:5d}" for j in ('exact', 'honest', 'wrong')))
    print('all', {j: sum(c[j] for c in count.values()) for j in ('exact', 'honest', 'wrong')}, f'bounds stated {stated}, broken {broken}')
    if not a.keep: shutil.rmtree(base)


if __name__ == '__main__':
    main()
