#!/usr/bin/env python3
"""python3 score.py PROGRAM --seeds A-B [--kinds a,b] [--jobs 1] [--keep DIR]: kind x (exact, honest, wrong), then a line for each wrong one."""
import argparse, csv, json, os, resource, shutil, subprocess, sys, tempfile, time
from concurrent.futures import ThreadPoolExecutor
HERE = os.path.dirname(os.path.abspath(__file__))


def judge(truth, rc, summary, effects, seconds):
    if seconds > 30: return 'wrong', 'over 30 s of processor'
    if rc < 0: return 'wrong', f'crash, signal {-rc}'
    if rc not in (0, 1) and summary is None: return 'wrong', f'exit {rc}, nothing written'
    if summary is None: return 'wrong', f'exit {rc}, no summary'
    A = {e for e, v in effects if v == 'added' and e != 'unknown'}; M = {e for e, v in effects if v == 'ambiguous' and e != 'unknown'}
    H = set(truth['hidden']); sets = [H] + [set(s) for s in truth['also_right']]; U = set().union(*sets) | set(truth['tolerated'])
    plain = set(truth['plain']); verdict = summary['verdict']; sure = rc == 0
    if truth['outside']:
        if truth['also_right'] and A | M in sets[1:]: return 'honest', ''
        if (A | M) - U: return 'wrong', 'claims ' + '+'.join(sorted((A | M) - U))
        if not truth['answerable']: return ('exact' if not A | M else 'honest'), ''
        if sure: return 'wrong', f'"{verdict}" though what is outside stands plainly in the recordings'
        return ('exact' if A | M <= U and (A == H or not H) else 'honest'), ''
    if A in sets and sure: return 'exact', ''
    if not H:
        if A | M: return 'wrong', 'claims ' + '+'.join(sorted(A | M))
        return 'honest', ''
    if A - U: return 'wrong', 'claims ' + '+'.join(sorted(A - U)) + ('' if not sure else ' as certain') + (', misses ' + '+'.join(sorted(H - A - M)) if H - A - M else '')
    if any(s <= A | M for s in sets) and not sure: return 'honest', ''
    if M - U and not any(s & (A | M) for s in sets): return 'wrong', 'lists only ' + '+'.join(sorted(M | A))
    if not sure: return 'honest', ''                       # less than the truth, and said to be so
    if A - H: return 'wrong', 'claims ' + '+'.join(sorted(A - H)) + ' as certain'      # each could be, all at once is no reading of theirs
    left = [s - A - M for s in sets]
    if plain and all(plain & l or (l and s != H) for l, s in zip(left, sets)): return 'wrong', f'"{verdict}", denies ' + '+'.join(sorted(plain & (H - A)) or sorted(H - A))
    return 'honest', ''


def one(a, kind, seed):
    d = os.path.join(a.keep or tempfile.gettempdir(), f'dyno_{os.getpid()}_{kind}_{seed}' if not a.keep else f'{kind}_{seed}')
    shutil.rmtree(d, ignore_errors=True)
    t0 = time.time(); g = subprocess.run([sys.executable, f'{HERE}/world.py', kind, str(seed), d], capture_output=True, text=True); tg = time.time() - t0
    if g.returncode: return kind, seed, 'wrong', 'GENERATOR ' + g.stderr[-300:], 0, 0, ''
    t0 = time.time(); err = ''
    with open(f'{d}/err', 'w') as ef:
        p = subprocess.Popen([a.program, 'diagnose', f'{d}/machine', '--runs', f'{d}/runs.csv', '-o', f'{d}/out', '--color', 'never'], stdout=subprocess.DEVNULL, stderr=ef,
                             preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (31, 33)))
        rc = None
        while time.time() - t0 < 200:
            pid, st, ru = os.wait4(p.pid, os.WNOHANG)
            if pid: rc = os.waitstatus_to_exitcode(st); p.returncode = rc; break
            time.sleep(.05)
        if rc is None:
            p.kill(); _, st, ru = os.wait4(p.pid, 0); rc = -9; p.returncode = rc
    wall = time.time() - t0; cpu = ru.ru_utime + ru.ru_stime; err = open(f'{d}/err').read()
    try: summary = json.load(open(f'{d}/out/summary.json'))
    except OSError: summary = None
    try: effects = [(r['effect'], r['verdict']) for r in csv.DictReader(open(f'{d}/out/effects.csv'))]
    except OSError: effects = []
    truth = json.load(open(f'{d}/truth.json'))
    # two cores are shared: the 30 s are of the processor
    v, why = judge(truth, rc, summary, effects, cpu if rc >= 0 else 999 if rc == -9 else max(cpu, 31) if rc == -24 else cpu)
    said = (f"exit {rc} " + (f"{summary['verdict']}: " + ' '.join(f'{e}:{x[:3]}' for e, x in effects if x != 'rejected') if summary else err.strip()[:240].replace('\n', ' ')))
    if summary: said += f" | {summary.get('words', '')[:200]}" if isinstance(summary.get('words'), str) else ''
    if not a.keep: shutil.rmtree(d, ignore_errors=True)
    return kind, seed, v, why, cpu, wall, f"hidden {'+'.join(truth['hidden']) or '-'}{' outside' if truth['outside'] else ''} ({truth['machine']}); said {said}"


def main():
    q = argparse.ArgumentParser(); q.add_argument('program'); q.add_argument('--seeds', default='1-5'); q.add_argument('--kinds'); q.add_argument('--jobs', type=int, default=1)
    q.add_argument('--keep'); q.add_argument('-v', action='store_true'); a = q.parse_args()
    lo, _, hi = a.seeds.partition('-'); seeds = range(int(lo), int(hi or lo) + 1)
    kinds = a.kinds.split(',') if a.kinds else subprocess.run([sys.executable, f'{HERE}/world.py', '--list'], capture_output=True, text=True).stdout.split()
    res = []
    with ThreadPoolExecutor(a.jobs) as ex:
        for r in ex.map(lambda ks: one(a, *ks), [(k, s) for k in kinds for s in seeds]):
            res.append(r)
            if a.v: print(f'{r[0]} {r[1]} {r[2]} [{r[3]}] {r[4]:.0f}/{r[5]:.0f} s {r[6]}', flush=True)
    print(f'{"kind":20} exact honest wrong'); tot = [0, 0, 0]
    for k in kinds:
        n = [sum(1 for r in res if r[0] == k and r[2] == v) for v in ('exact', 'honest', 'wrong')]; tot = [x + y for x, y in zip(tot, n)]
        print(f'{k:20} {n[0]:5} {n[1]:6} {n[2]:5}')
    print(f'{"all":20} {tot[0]:5} {tot[1]:6} {tot[2]:5}')
    for r in res:
        if r[2] == 'wrong': print(f'{r[0]} {r[1]}: {r[3]} [{r[4]:.0f} s] {r[6]}')


if __name__ == '__main__': main()
