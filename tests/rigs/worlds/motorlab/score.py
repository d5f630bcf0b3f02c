#!/usr/bin/env python3
"""score.py PROGRAM --seeds A-B [--kinds a,b] [--keep DIR] [-v]"""
import argparse, json, os, resource, shutil, subprocess, sys, tempfile, time

HERE = os.path.dirname(os.path.abspath(__file__))


def judge(t, rc, s, cpu):
    """(exact | honest | wrong, why)"""
    if cpu > 30:
        return 'wrong', 'over 30 s'
    if s is None:
        return 'wrong', 'nothing written' if rc >= 0 else f'killed by signal {-rc}'
    if rc not in (0, 1):
        return 'wrong', f'exit {rc}'
    added = {e['effect'] for e in s['effects'] if e['verdict'] == 'added'} - {'unknown'}
    amb = {e['effect'] for e in s['effects'] if e['verdict'] == 'ambiguous'} - {'unknown'}
    hid, opt, may = set(t['hidden']), set(t['optional']), set(t['may'])
    right = [hid] + [set(x) for x in t['also_right']]
    nothing = not added and not amb
    sure = rc == 0
    is_right = any(added - opt == r - opt or added == r for r in right) or (not t['answerable'] and not added)
    if sure:
        if t['must_doubt']:
            return 'wrong', 'sure of what these recordings cannot tell'
        if nothing:
            if t['outside'] and t['answerable']:
                return 'wrong', 'denied: says that nothing is missing'
            if hid <= opt or not hid or not t['answerable']:
                return 'exact', ''
            return 'wrong', 'denied: says that nothing is missing'
        if t['outside']:
            if is_right and added:
                return 'exact', ''
            return ('wrong', 'sure, but something else acts') if added <= hid | may else ('wrong', 'claimed ' + ','.join(sorted(added - hid - may)))
        if is_right:
            return 'exact', ''
        extra = min((added - r for r in right), key=len)
        return 'wrong', 'claimed ' + ','.join(sorted(extra)) if extra else 'sure, but misses ' + ','.join(sorted(hid - added))
    # exit 1: in doubt
    false = min((added - r for r in right), key=len) - may
    if false:
        return 'wrong', 'claimed ' + ','.join(sorted(false))
    if nothing:
        if not hid and not t['outside']:
            return 'wrong', 'nothing is missing, but says that something is'
        return ('exact' if t['outside'] and not hid else 'honest'), 'claims nothing'
    if amb:
        listed = added | amb
        if not any(listed & r for r in right if r) and not listed <= may:
            return 'wrong', 'the truth is not in the list ' + ','.join(sorted(amb))
        if t['must_doubt'] and any(r <= listed for r in right):
            return 'exact', ''
        return 'honest', 'ambiguous'
    if (t['outside'] or t['must_doubt']) and is_right:
        return 'exact', ''
    return 'honest', 'in part'


def cpu_of_children():
    r = resource.getrusage(resource.RUSAGE_CHILDREN)
    return r.ru_utime + r.ru_stime


def main():
    ap = argparse.ArgumentParser()
    ap.add_argument('program'); ap.add_argument('--seeds', required=True); ap.add_argument('--kinds'); ap.add_argument('--keep'); ap.add_argument('-v', action='store_true')
    a = ap.parse_args()
    lo, hi = (a.seeds.split('-') + [a.seeds])[:2] if '-' in a.seeds else (a.seeds, a.seeds)
    w = os.path.join(HERE, 'world.py')
    kinds = a.kinds.split(',') if a.kinds else subprocess.run([sys.executable, w, '--list'], capture_output=True, text=True).stdout.split()
    base = a.keep or tempfile.mkdtemp(prefix='motorlab_')
    table, lines, total, slow = {}, [], 0.0, 0.0
    for k in kinds:
        row = table[k] = {'exact': 0, 'honest': 0, 'wrong': 0}
        for seed in range(int(lo), int(hi) + 1):
            d = os.path.join(base, f'{k}_{seed}')
            shutil.rmtree(d, ignore_errors=True)
            subprocess.run([sys.executable, w, k, str(seed), d], check=True)
            t = json.load(open(os.path.join(d, 'truth.json')))
            c0 = cpu_of_children()
            try:
                pr = subprocess.run([a.program, 'diagnose', d + '/machine', '--runs', d + '/runs.csv', '-o', d + '/out'], capture_output=True, text=True, timeout=180)
                rc, err = pr.returncode, pr.stderr
            except subprocess.TimeoutExpired:
                rc, err = -9, 'timeout'
            cpu = cpu_of_children() - c0
            total += cpu; slow = max(slow, cpu)
            try:
                s = json.load(open(d + '/out/summary.json'))
            except (OSError, ValueError):
                s = None
            open(d + '/stderr.txt', 'w').write(err)
            v, why = judge(t, rc, s, cpu)
            row[v] += 1
            said = '' if s is None else s['verdict'] + ' ' + ' '.join(
                e['effect'] + ('' if e['verdict'] == 'added' else '?') for e in s['effects'] if e['verdict'] != 'rejected')
            line = f'{v:6} {k} {seed}: hidden {"+".join(t["hidden"]) or "-"}{" (outside)" if t["outside"] else ""}; exit {rc}, {said or err.strip()[-160:]}; {why}; {cpu:.1f} s'
            if v == 'wrong':
                lines.append(line)
            if a.v:
                print(line, flush=True)
            if not a.keep:
                shutil.rmtree(d, ignore_errors=True)
    print(f'{"kind":22}{"exact":>6}{"honest":>7}{"wrong":>6}')
    for k, r in table.items():
        print(f'{k:22}{r["exact"]:6}{r["honest"]:7}{r["wrong"]:6}')
    tot = {v: sum(r[v] for r in table.values()) for v in ('exact', 'honest', 'wrong')}
    print(f'{"all":22}{tot["exact"]:6}{tot["honest"]:7}{tot["wrong"]:6}   {total:.0f} s of processor, the slowest {slow:.1f} s')
    print('\n'.join(lines))
    if not a.keep:
        shutil.rmtree(base, ignore_errors=True)


if __name__ == '__main__':
    main()
