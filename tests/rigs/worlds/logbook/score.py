#!/usr/bin/env python3
"""score.py BIN --seeds A-B [--kinds a,b] [--jobs N] [--work FOLDER] [--out FILE]: makes, runs and judges cases; a line each. --selftest: of world.py.

exact: what is hidden and nothing else, values within their errors. honest: doubt, the truth not denied; of what is in no catalogue, nothing
false beside it. wrong: a false claim, a denial, a value or a bound that the truth breaks, no answer, or over 30 s of processor."""
import argparse, collections, csv, json, os, shutil, subprocess, sys, tempfile
from concurrent.futures import ThreadPoolExecutor, as_completed

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import world as W


def run(args):
    """Exit code and both outputs; 60 s of processor end it."""
    p = subprocess.run([sys.executable, "-c", CHILD] + args, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    return p.returncode, p.stdout, p.stderr


def effects_of(folder):
    path = os.path.join(folder, "machine", "effects.csv")
    if not os.path.exists(path):
        return {}
    with open(path) as f:
        return {r["effect"] + " " + r["parameter"]: (float(r["value"]), float(r["std_error"] or 0)) for r in csv.DictReader(f)}


def true_ripple(case, out, temp=20.0):
    """T_ripple in per cent and mean that the solved currents make in the true machine over whole mechanical turns; None without."""
    path = os.path.join(out, "solution", "waveform.csv")
    if not os.path.exists(path):
        return None
    with open(path) as f:
        rows = list(csv.DictReader(f))
    th = np.array([float(r["theta_e_rad"]) for r in rows])
    i = np.array([[float(r["i%s_A" % s]) for r in rows] for s in "abc"])
    step = th[1] - th[0]
    span = round((th[-1] + step) / W.TAU)
    m = case.m
    whole = np.concatenate([th + W.TAU * span * k for k in range(max(1, m.p // span))])
    i = np.tile(i, max(1, m.p // span))
    T = m.torque(whole / m.p, i, temp) + m.cogging(whole / m.p)
    return 100 * (T.max() - T.min()) / abs(T.mean()), T.mean()


def judge(truth, code, text, summary, values, ripple):
    """Judgement and reason."""
    if summary is None:
        if truth["refuse"] and code in (2, 3) and len(text) > 60:
            return "honest", "refused with words"
        return "wrong", "no answer: exit %d" % code
    added = {e["effect"] for e in summary["effects"] if e["verdict"] == "added"} - {"unknown"}
    doubt = {e["effect"] for e in summary["effects"] if e["verdict"] == "ambiguous"} - {"unknown"}
    sets = [set(truth["truth"])] + [set(a) for a in truth["alts"]]
    true = set().union(*sets)
    fair = true | set(truth["also"]) | (set(truth["may"]) if code else set())
    if added - fair:
        return "wrong", "claims " + ", ".join(sorted(added - fair))
    if doubt and not doubt & (true | set(truth["also"]) | set(truth["may"])):
        return "wrong", "the truth is not among " + ", ".join(sorted(doubt))
    for name, (value, share) in truth["values"].items():
        if name in values:
            got, error = values[name]
            if abs(got - value) > max(4 * error, share * abs(value)):
                return "wrong" if code == 0 else "honest", "%s %.4g ± %.2g, is %.4g" % (name, got, error, value)
    expected = summary.get("expected") or {}
    if ripple and expected.get("known") and ripple[0] > 1.2 * expected["T_ripple_percent_95"] + 0.02:
        return "wrong", "ripple %.3g %%, promised %.3g %%" % (ripple[0], expected["T_ripple_percent_95"])
    if truth["outside"]:
        if code == 0:
            return "wrong", "sure, although what acts is in no catalogue (%s)" % (", ".join(sorted(added)) or "complete")
        return ("exact" if set(truth["truth"]) and set(truth["truth"]) <= added else "honest"), summary["verdict"]
    if not true:
        return ("exact", "complete") if code == 0 and not added else ("honest", summary["verdict"])
    if any(s <= added for s in sets) and code == 0:
        return "exact", "explained"
    if code == 0:
        return "wrong", "denies " + ", ".join(sorted(set(truth["truth"]) - added)) + " (" + summary["verdict"] + ")"
    if any(s <= added | doubt for s in sets) and summary["verdict"] == "ambiguous" and len(doubt) <= 3:
        return "exact" if doubt <= true | set(truth["also"]) | set(truth["may"]) else "honest", "ambiguous: " + ", ".join(sorted(doubt))
    return "honest", summary["verdict"] + ": " + ", ".join(sorted(added | doubt))


def case(binary, name, seed, work):
    folder = os.path.join(work, "%s_%d" % (name, seed))
    shutil.rmtree(folder, ignore_errors=True)
    made = W.build(name, seed, folder)
    mean = 0.4 * made.m.rated["torque"]
    with open(os.path.join(folder, "target.csv"), "w") as f:
        f.write("order,amplitude_Nm,phase_rad\n0,%.9g,1.5707963267948966\n" % mean)
    out = os.path.join(folder, "out")
    code, text, err = run([binary, "diagnose", folder + "/machine", "--runs", folder + "/runs.csv",
                                   "--target", folder + "/target.csv", "-o", out, "--json"] + made.truth["args"])
    seconds = float(err.rsplit("SECONDS", 1)[1]) if "SECONDS" in err else 999.0
    err = err.rsplit("SECONDS", 1)[0]
    summary = None
    if code in (0, 1) and os.path.exists(out + "/summary.json"):
        with open(out + "/summary.json") as f:
            summary = json.load(f)
    ripple = true_ripple(made, out) if summary else None
    verdict, why = judge(made.truth, code, text + err, summary, effects_of(out), ripple)
    if seconds > 30:
        verdict, why = "wrong", "%.0f s" % seconds
    bound = ((summary or {}).get("expected") or {}).get("T_ripple_percent_95")
    return name, seed, verdict, why, seconds, (summary or {}).get("verdict", "-"), bound, ripple and ripple[0]


CHILD = ("import resource, subprocess, sys\nresource.setrlimit(resource.RLIMIT_CPU, (60, 60))\nc = subprocess.call(sys.argv[1:])\nu = resource.getrusage(resource.RUSAGE_CHILDREN)\n"
         "print('SECONDS%.2f' % (u.ru_utime + u.ru_stime), file=sys.stderr)\nsys.exit(c)")


def main():
    ap = argparse.ArgumentParser(description=__doc__)
    ap.add_argument("binary", nargs="?")
    ap.add_argument("--seeds", default="1-2")
    ap.add_argument("--kinds", default="")
    ap.add_argument("--jobs", type=int, default=1)
    ap.add_argument("--work")
    ap.add_argument("--out")
    ap.add_argument("--selftest", action="store_true")
    a = ap.parse_args()
    if a.selftest:
        return W.selftest()
    work = a.work or tempfile.mkdtemp()
    first, _, last = a.seeds.partition("-")
    todo = [(k, s) for s in range(int(first), int(last or first) + 1) for k in (a.kinds.split(",") if a.kinds else W.KINDS)]
    count, bounds, broken = collections.Counter(), 0, 0
    rows = []
    with ThreadPoolExecutor(a.jobs) as pool:
        for done in as_completed([pool.submit(case, os.path.abspath(a.binary), k, s, work) for k, s in todo]):
            row = done.result()
            name, seed, verdict, why, seconds, said, bound, ripple = row
            count[verdict] += 1
            if bound is not None and ripple is not None:
                bounds, broken = bounds + 1, broken + (ripple > bound)
            print("%-7s %-28s %3d %5.1f s  %s%s" % (verdict, name, seed, seconds, why,
                  "" if bound is None or ripple is None else "  [ripple %.3g, bound %.3g]" % (ripple, bound)), flush=True)
            rows.append(row)
            if not a.work:
                shutil.rmtree(os.path.join(work, "%s_%d" % (name, seed)), ignore_errors=True)
    if a.out:
        with open(a.out, "w") as f:
            csv.writer(f).writerows([["kind", "seed", "judged", "why", "seconds", "verdict", "bound", "ripple"]] + rows)
    print("%d cases: %d exact, %d honest, %d wrong; %d bounds stated, %d broken" %
          (len(todo), count["exact"], count["honest"], count["wrong"], bounds, broken))
    return 0


if __name__ == "__main__":
    sys.exit(main())
