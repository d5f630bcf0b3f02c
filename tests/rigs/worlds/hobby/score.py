#!/usr/bin/env python3
"""python3 score.py PROGRAM --seeds A-B [--kinds a,b] [--jobs 2] [--keep DIR] : runs `PROGRAM diagnose` on the worlds, prints kind x (exact, honest, wrong)."""
import argparse, csv, json, os, subprocess, sys, tempfile, threading, shutil
from concurrent.futures import ThreadPoolExecutor
HERE = os.path.dirname(os.path.abspath(__file__)); sys.path.insert(0, HERE)
import world

def judge(tr, rc, sec, out):
    """-> (class, words)"""
    if sec > 30: return "wrong", "took %.0f s" % sec
    if rc < 0 or rc > 5: return "wrong", "crash, exit %d" % rc
    try:
        s = json.load(open(out + "/summary.json")); rows = list(csv.DictReader(open(out + "/effects.csv")))
    except (OSError, ValueError): return "wrong", "nothing written, exit %d" % rc
    added = {r["effect"] for r in rows if r["verdict"] == "added" and r["effect"] != "unknown"}
    amb = {r["effect"] for r in rows if r["verdict"] == "ambiguous" and r["effect"] != "unknown"}
    v = str(s.get("verdict")).replace("_", " ")
    said = "%s: added {%s}%s, exit %d" % (v, " ".join(sorted(added)), " ambiguous {%s}" % " ".join(sorted(amb)) if amb else "", rc)
    rights = [set(tr["hidden"])] + [set(x) for x in tr["also_right"]]
    allowed = set().union(*rights)
    if not tr["outside"] and added == rights[0] and not amb and rc == 0: return "exact", said
    over = lambda A: any(A <= R for R in rights)
    if added and not over(added):
        if amb: said += " (false claim)"
        return "wrong", said
    open_ = rc == 1 or v in ("ambiguous", "unknown", "partly explained")
    if not tr["outside"] and not tr["hidden"] and v in ("unknown", "partly explained"): return "wrong", said + " (something unknown claimed where nothing is missing)"
    if tr["outside"]:
        if amb and not over(added | amb) and v != "unknown" and v != "partly explained": return "wrong", said
        if not open_ and not added and tr["answerable"]: return "wrong", said + " (plain misfit called complete)"
        return "honest", said
    if any(added == R for R in rights[1:]): return "honest", said
    if amb:
        if any(added <= R and R <= added | amb for R in rights): return "honest", said
        if v in ("unknown", "partly explained") and over(added) and any(R & amb for R in rights): return "honest", said
        return "wrong", said + " (truth not in the list)"
    if added == rights[0]: return "honest", said
    if not tr["answerable"] and over(added): return "honest", said
    if open_: return "honest", said
    if any(not R for R in rights) and not added: return "honest", said
    return "wrong", said + " (hidden effect denied)"

def one(a):
    prog, kind, seed, keep = a
    d = os.path.join(keep, "%s_%d" % (kind, seed)) if keep else tempfile.mkdtemp()
    shutil.rmtree(d, ignore_errors=True)
    try:
        g = subprocess.run([sys.executable, HERE + "/world.py", kind, str(seed), d], capture_output=True, text=True)
        if g.returncode: return kind, seed, "wrong", "GENERATOR: " + g.stderr[-200:], 0
        tr = json.load(open(d + "/truth.json"))
        with open(d + "/stderr.txt", "w+") as ef:     # seconds of this process, not of the clock: the cores are shared
            q = subprocess.Popen([prog, "diagnose", d + "/machine", "--runs", d + "/runs.csv", "-o", d + "/out"], stdout=subprocess.DEVNULL, stderr=ef)
            stop = threading.Timer(300, q.kill); stop.start(); _, st, ru = os.wait4(q.pid, 0); stop.cancel(); q.returncode = rc = os.waitstatus_to_exitcode(st)
            sec = ru.ru_utime + ru.ru_stime; ef.seek(0); err = ef.read()
        c, w = judge(tr, rc, sec, d + "/out")
        if "nothing written" in w: w += ": " + " ".join(err.split())[:300]
        if tr.get("motor"): w += " [%s]" % tr["motor"]
        return kind, seed, c, w, sec
    finally:
        if not keep: shutil.rmtree(d, ignore_errors=True)

def main():
    ap = argparse.ArgumentParser(); ap.add_argument("program"); ap.add_argument("--seeds", default="1-3"); ap.add_argument("--kinds"); ap.add_argument("--jobs", type=int, default=2); ap.add_argument("--keep"); ap.add_argument("--all", action="store_true")
    o = ap.parse_args(); lo, _, hi = o.seeds.partition("-"); kinds = o.kinds.split(",") if o.kinds else sorted(world.KINDS)
    jobs = [(o.program, k, s, o.keep) for k in kinds for s in range(int(lo), int(hi or lo) + 1)]; tab, lines, slow = {k: {"exact": 0, "honest": 0, "wrong": 0} for k in kinds}, [], 0
    with ThreadPoolExecutor(o.jobs) as ex:
        for k, s, c, w, sec in ex.map(one, jobs):
            tab[k][c] += 1; slow = max(slow, sec)
            if c == "wrong" or o.all: lines.append("%-6s %s %d (%.1f s): %s" % (c, k, s, sec, w)); print(lines[-1], file=sys.stderr, flush=True)
    print("| kind | exact | honest | wrong |\n|---|---|---|---|")
    for k in kinds: print("| %s | %d | %d | %d |" % (k, tab[k]["exact"], tab[k]["honest"], tab[k]["wrong"]))
    print("| **all %d** | %d | %d | %d |" % (len(jobs), *(sum(t[c] for t in tab.values()) for c in ("exact", "honest", "wrong"))))
    print("slowest %.1f s" % slow); print("\n".join(lines))
main()
