#!/usr/bin/env python3
"""Scores `hci-solve diagnose` on the kinds of world.py: python3 score.py HCI_SOLVE [--seeds 1-3] [--kinds a,b] [--keep FOLDER]"""
import argparse
import csv
import json
import os
import resource
import subprocess
import sys
import tempfile
import zlib

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import world


def judged(kind, verdict, code, seconds, added, ambiguous):
    """exact, honest or wrong, and why."""
    named = added | ambiguous
    truths = [set(x) for x in kind['exact']]
    allowed = set(kind['ok']).union(*truths) if truths else set(kind['ok'])
    false = added - allowed if ambiguous else named - allowed
    if code not in (0, 1): return 'wrong', f'exit code {code}'
    if seconds > 30: return 'wrong', f'{seconds:.0f} s'
    if false: return 'wrong', 'claims ' + ', '.join(sorted(false))
    if verdict == 'complete': return ('exact', '') if set() in truths else ('wrong', 'says that nothing is missing')
    if verdict == 'explained':
        if any(x <= named for x in truths if x): return 'exact', ''
        if set() in truths: return ('wrong', 'adds to a sound machine') if named - set(kind['ok']) else ('honest', '')
        return ('wrong', 'denies a part') if truths or kind['mustnot0'] else ('honest', '')
    if verdict == 'ambiguous' and not any(x & named or not x for x in truths): return 'wrong', 'the truth is not listed'
    return 'honest', ''


def answer(program, folder):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        code = subprocess.run([program, 'diagnose', folder + '/machine', '--runs', folder + '/runs.csv', '-o', folder + '/out', '-q'],
                              capture_output=True, timeout=200).returncode
    except subprocess.TimeoutExpired:
        code = 'timeout'
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return code, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def score(program, name, seed, folder):
    kind = world.K[name]
    os.makedirs(folder, exist_ok=True)
    kind['fn'](folder, np.random.default_rng(zlib.crc32(name.encode()) + seed))
    code, seconds = answer(program, folder)
    if not os.path.exists(folder + '/out/summary.json'): return 'wrong', 'nothing written', seconds
    summary = json.load(open(folder + '/out/summary.json'))
    effects = {row['effect']: row['verdict'] for row in csv.DictReader(open(folder + '/out/effects.csv'))}
    added = {e for e, v in effects.items() if v == 'added' and e != 'unknown'}
    ambiguous = {e for e, v in effects.items() if v == 'ambiguous'}
    verdict = summary.get('verdict') or summary['diagnosis']['verdict']
    return (*judged(kind, verdict, code, seconds, added, ambiguous), seconds)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('program')
    parser.add_argument('--seeds', default='1-2')
    parser.add_argument('--kinds', default='')
    parser.add_argument('--keep', default='')
    a = parser.parse_args()
    ends = [int(x) for x in a.seeds.split('-')]
    total = {'exact': 0, 'honest': 0, 'wrong': 0}
    with tempfile.TemporaryDirectory() as temporary:
        for name in a.kinds.split(',') if a.kinds else world.K:
            for seed in range(ends[0], ends[-1] + 1):
                word, why, seconds = score(a.program, name, seed, f'{a.keep or temporary}/{name}_{seed}')
                total[word] += 1
                print(f'{name:34s} {seed:4d} {word:7s} {seconds:5.1f} s  {why}', flush=True)
    print('all: ' + ', '.join(f'{n} {w}' for w, n in total.items()))


main()
