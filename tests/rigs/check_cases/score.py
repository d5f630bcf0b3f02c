"""What `check` says of correct machines that are odd, of effects that its model lacks, and of real slips. See README.md."""

import argparse
import json
import math
import os
import random
import shutil
import subprocess
import sys
import tempfile
from collections import Counter

import bench
import cases

OUTCOMES = ("quiet", "doubt", "listed", "accused", "found", "noticed", "missed", "wrong", "error")
GOOD = ("quiet", "doubt", "found")


def write(folder, files):
    for path, table in files.items():
        full = os.path.join(folder, path)
        os.makedirs(os.path.dirname(full), exist_ok=True)
        with open(full, "w") as file:
            file.write(bench.text(table))


def ask(program, folder, files):
    runs = sorted(path for path in files if path.startswith("runs/"))
    done = subprocess.run([program, "check", "machine"] + runs + ["--json"], cwd=folder, capture_output=True, text=True, timeout=60)
    if done.returncode not in (0, 1):
        return None, "exit %d: %s" % (done.returncode, done.stderr.strip()[-300:])
    return json.loads(done.stdout), ""


def hollow(answer):
    """Numbers under consistent that are not: off by more than a factor of two."""
    found = []
    for e in answer["evidence"]:
        x, to = e["declared"], e["expected"]
        if e["state"] != "consistent" or to == 0 or e.get("at_most") or e["name"].startswith("cogging_s"):
            continue
        if x is None or x <= 0 or abs(math.log(x / to)) > math.log(2):
            found.append("%s %.4g for %g" % (e["name"], x if x is not None else math.nan, to))
    return found


def judge(answer, truth, alike):
    probability = {f["slip"]: f["probability"] for f in answer["findings"]}
    allowed = {truth} | set(alike)
    named = set(probability).union(*[f.get("alternatives", []) for f in answer["findings"]])
    if truth is None:
        if any(p >= 0.5 for p in probability.values()):
            return "accused"
        return "listed" if probability else "quiet" if answer["verdict"] == "consistent" else "doubt"
    if any(p >= 0.5 and slip not in allowed for slip, p in probability.items()):
        return "wrong"
    if sum(p for slip, p in probability.items() if slip in allowed) >= 0.5:  # those that look alike share it
        return "found"
    if named & allowed:
        return "listed"
    return "missed" if answer["verdict"] == "consistent" else "noticed"


def words(answer):
    found = ["%s %.2f" % (f["slip"], f["probability"]) for f in answer["findings"]]
    off = ["%s %.3g for %g" % (e["name"], e["declared"], e["expected"]) for e in answer["evidence"] if e["state"] not in ("consistent", "unjudged")]
    return "%s: %s [%s]" % (answer["verdict"], ", ".join(found) or "nothing", "; ".join(off))


def examine(options, name, seed):
    files, truth, alike = cases.CASES[name](random.Random("%s %d" % (name, seed)))
    folder = os.path.join(options.work, "%s.%d" % (name, seed))
    write(folder, files)
    answer, trouble = ask(options.program, folder, files)
    outcome, said, empty = ("error", trouble, []) if answer is None else (judge(answer, truth, alike), words(answer), hollow(answer))
    if options.keep and (outcome not in GOOD or empty):
        shutil.copytree(folder, os.path.join(options.keep, os.path.basename(folder)), dirs_exist_ok=True)
    shutil.rmtree(folder)
    return outcome, said, empty


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("--seeds", default="1-3", help="first-last")
    parser.add_argument("--only", default="", help="cases whose name contains this")
    parser.add_argument("--keep", help="folder for the cases that went wrong")
    parser.add_argument("-v", action="store_true", dest="verbose")
    parser.add_argument("--accused", type=int, default=None, help="most correct ones that are accused, refused or called consistent by a number that is not; more: exit 1")
    parser.add_argument("--found", type=float, default=0.0, help="least share of slips that are found")
    options = parser.parse_args()
    options.program = os.path.abspath(options.program)
    first, last = (int(x) for x in (options.seeds.split("-") * 2)[:2])
    total, hollows = Counter(), 0
    with tempfile.TemporaryDirectory(prefix="hci-check-cases-") as options.work:
        for name in cases.CASES:
            if options.only not in name:
                continue
            results = [examine(options, name, seed) for seed in range(first, last + 1)]
            counts = Counter(r[0] for r in results)
            total.update({(name.startswith("slip_"), k): n for k, n in counts.items()})
            print("%-32s %s" % (name, ", ".join("%s %d" % (k, counts[k]) for k in OUTCOMES if counts[k])))
            for seed, (outcome, said, empty) in enumerate(results, first):
                hollows += len(empty) > 0
                if options.verbose or outcome not in GOOD or empty:
                    print("    %d %s: %s%s" % (seed, outcome, said, "  HOLLOW " + ", ".join(empty) if empty else ""))
    innocent = {k: n for (guilty, k), n in total.items() if not guilty}
    guilty = {k: n for (is_slip, k), n in total.items() if is_slip}
    show = lambda x: ", ".join("%s %d" % (k, x[k]) for k in OUTCOMES if k in x)
    print("correct: %d: %s\nslips: %d: %s\nnumbers called consistent that are not, in %d cases" % (sum(innocent.values()), show(innocent), sum(guilty.values()), show(guilty), hollows))
    bad = innocent.get("accused", 0) + innocent.get("error", 0) + hollows
    share = guilty.get("found", 0) / max(1, sum(guilty.values()))
    return int((options.accused is not None and bad > options.accused) or share < options.found or guilty.get("error", 0) > 0)


if __name__ == "__main__":
    sys.exit(main())
