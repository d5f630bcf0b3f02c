#!/usr/bin/env python3
"""python3 score.py PROGRAM [--seeds A-B] [--kinds a,b] [--noise SHARE] [--keep DIR]: how often the truth lies within the bound that `solve` states, and by
how much it is wider. Each machine is diagnosed once, and solved for half and nine tenths of its rated torque."""
import argparse, json, os, shutil, subprocess, sys, tempfile, time
import numpy as np
from plants import Plant


def interval(k, n):
    """Wilson's, 95 %."""
    z, p = 1.96, k / n
    middle, half = p + z * z / 2 / n, z * np.sqrt(p * (1 - p) / n + z * z / 4 / n / n)
    return [100 * (middle + s * half) / (1 + z * z / n) for s in (-1, 1)]


def cases(a, kind, seed):
    folder = f'{a.keep}/{kind}_{seed}' if a.keep else tempfile.mkdtemp()
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    plant, started = Plant(kind, seed), time.time()
    plant.record(a.program, folder, a.noise)
    subprocess.run([a.program, 'diagnose', f'{folder}/machine', '--runs', f'{folder}/runs.csv', '-q', '-o', f'{folder}/out'], capture_output=True)
    summary = json.load(open(f'{folder}/out/summary.json'))
    for name in ('half', 'most'):
        subprocess.run([a.program, 'solve', f'{folder}/out/machine', '--target', f'{folder}/{name}.csv', '--auto', '-q', '-o', f'{folder}/{name}'], capture_output=True)
        said = json.load(open(f'{folder}/{name}/summary.json'))
        said = said.get('expected', said)
        bound, middle = said.get('peak_to_peak_Nm_95'), said.get('T_ripple_percent_middle', said.get('T_ripple_percent_50'))
        swing, mean = plant.made_by(f'{folder}/{name}/waveform.csv')
        print(f'{kind:8} {seed:3} {name} {summary["verdict"]:16} search {summary.get("search", ""):9} ripple {100 * swing / mean:7.3f} %  '
              + ('no bound' if bound is None else f'bound {100 * bound / mean:7.3f} %  ratio {bound / swing:6.2f}{"" if swing <= bound else "  OUTSIDE"}')
              + f'  {time.time() - started:.1f} s', flush=True)
        yield None if bound is None else bound / swing
    if not a.keep: shutil.rmtree(folder)


def main():
    a = argparse.ArgumentParser(description=__doc__)
    a.add_argument('program'); a.add_argument('--seeds', default='1-20'); a.add_argument('--kinds', default='mirror,servo,salient,ipm,iron')
    a.add_argument('--noise', type=float, default=0.002); a.add_argument('--keep'); a = a.parse_args()
    a.program = os.path.abspath(a.program)
    first, last = map(int, a.seeds.split('-'))
    for kind in a.kinds.split(','):
        ratio = [x for seed in range(first, last + 1) for x in cases(a, kind, seed)]
        told = np.array([x for x in ratio if x is not None])
        if len(told) == 0: print(f'{kind}: no bound of {len(ratio)}'); continue
        kept = int((told >= 1).sum())
        print(f'{kind}: {kept} of {len(told)} within the bound ({100 * kept / len(told):.0f} %, 95 % interval {"%.0f to %.0f" % tuple(interval(kept, len(told)))} %), of {len(ratio)} '
              f'{len(ratio) - len(told)} without one; bound over truth: median {np.median(told):.2f}, nine tenths below {np.quantile(told, 0.9):.1f}', flush=True)


main()
