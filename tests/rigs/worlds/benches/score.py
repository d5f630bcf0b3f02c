"""Judges `hci-solve diagnose` on the worlds of world.py.

    python score.py BIN --seeds 1-2 [--kinds a,b] [--work DIR] [--nice N]

exact: what is hidden is named, nothing else, and values are within their errors. honest: it says that something is not known,
or not told apart, with the truth among what it lists. wrong: it claims what is not there, denies what is, writes nothing, states
a bound on the ripple that the plant breaks by more than a tenth, or takes more than 30 s of processor time.
"""
import argparse
import csv
import json
import os
import re
import shutil
import statistics
import subprocess
import numpy as np
import world

UNITS = {"mA": 1e-3, "deg": np.pi / 180, "%": .01, "us": 1e-6, "ms": 1e-3, "mNm": 1e-3, "mH": 1e-3, "uH": 1e-6}


def call(binary, folder, args, nice):
    """Runs diagnose; its exit code, words and seconds of processor."""
    out = os.path.join(folder, "out")
    shutil.rmtree(out, ignore_errors=True)
    cmd = ["nice", "-n", str(nice), binary, "diagnose", os.path.join(folder, "machine"), "--runs", os.path.join(folder, "runs.csv"),
           "--target", os.path.join(folder, "target.csv"), "-o", out] + args
    with open(os.path.join(folder, "words.txt"), "w") as f:
        child = subprocess.Popen(cmd, stdout=f, stderr=subprocess.STDOUT)
        _, status, usage = os.wait4(child.pid, 0)
    words = open(os.path.join(folder, "words.txt"), errors="replace").read()
    return os.waitstatus_to_exitcode(status), words, usage.ru_utime + usage.ru_stime


def found(folder):
    """What the corrected machine's effects.csv says: effect -> parameter -> (value, error)."""
    out, path = {}, os.path.join(folder, "out", "machine", "effects.csv")
    if os.path.exists(path):
        for row in csv.DictReader(x for x in open(path) if not x.startswith("#")):
            u = UNITS.get(row["unit"], 1.0)
            out.setdefault(row["effect"], {})[row["parameter"]] = (float(row["value"]) * u, float(row["std_error"] or 0) * u)
    return out


def read(values, parameter):
    """The value of a parameter, whose order may be written with other digits; None where it is not there."""
    for p in parameter.split("|"):
        if p == "Ld-Lq":
            d, q = (values.get(k, (0.0, 0.0)) for k in ("dd_cosine_0", "qq_cosine_0"))
            return d[0] - q[0], np.hypot(d[1], q[1])
        for key, v in values.items():
            a, b = key.rpartition("_"), p.rpartition("_")
            if key == p or (a[0] == b[0] and a[0] and re.fullmatch(r"[\d.]+", a[2]) and re.fullmatch(r"[\d.]+", b[2]) and abs(float(a[2]) - float(b[2])) < 2e-4):
                return v
    return None


def law(f, speed):
    """The torque of a friction, with which its values are compared: the terms of one law make up for each other."""
    return f.get("coulomb", 0) + f.get("viscous", 0) * speed + f.get("quadratic", 0) * speed ** 2


def compare(hidden, got, fast):
    """Values of effects that were named: a list of remarks, and whether one is plainly wrong."""
    off, wrong = [], False
    for effect, truth in hidden.items():
        values = dict(got.get(effect, {}))
        if effect not in got:
            continue
        if effect == "friction":
            speeds = np.linspace(.25, 1, 4) * fast
            a, b = law(truth, speeds), law({k: v[0] for k, v in values.items()}, speeds)
            if abs(a - b).max() > .05 * a.max():
                off.append(f"friction at {speeds[abs(a - b).argmax()]:.3g} rad/s is off by {abs(a - b).max() / a.max():.0%}")
                wrong |= abs(a - b).max() > .15 * a.max()
            continue
        if effect == "current_offset" and len(set(values) & set("abc")) == 3:  # what all three have in common makes no torque
            c = np.mean([values[x][0] for x in "abc"]), np.mean([truth.get(x, 0.0) for x in "abc"])
            if max(abs(values[x][0] - c[0] - truth.get(x, 0.0) + c[1]) / max(4 * values[x][1], .01 * max(map(abs, truth.values()))) for x in "abc") < 1:
                continue
        size = max([abs(v) for v in truth.values() if v is not None] + [0])
        for p, v in truth.items():
            hit = read(values, p)
            if v is None or (hit is None and abs(v) < .2 * size):
                continue
            if hit is None:
                off.append(f"{effect}.{p} is missing (true {v:.4g})")
                continue
            d = abs(hit[0] - v)
            if d > max(4 * hit[1], .03 * size):
                off.append(f"{effect}.{p} = {hit[0]:.4g} ± {hit[1]:.1g}, true {v:.4g}")
                wrong |= d > max(6 * hit[1], .15 * size) or d > max(8 * hit[1], .5 * abs(v))
    return off, wrong


def bound(w, folder, summary):
    """The stated bound on the ripple and the true one of the same currents: (stated, true, mean error stated, true) or None."""
    e = summary.get("expected") or {}
    path = os.path.join(folder, "out", "solution", "currents.csv")
    if not (w.bound and e.get("known") and os.path.exists(path)):
        return None
    m = w.m
    th = np.arange(1440 * m.p) * 2 * np.pi / 1440
    i = np.zeros((3, th.size))
    for row in csv.DictReader(x for x in open(path) if not x.startswith("#")):
        n = float(row["order"])
        seq = {"pos": 1, "asym": 1, "neg": -1, "zero": 0, "sym": (n + 1) % 3 - 1}[row["set"]]
        i += float(row["amplitude_A"]) * np.sin(n * th + float(row["phase_rad"]) - seq * world.LAG)
    if "position_offset" not in found(folder):  # the zero of the corrected machine is then that of the recordings
        th = th - w.off
    d, q = world.park(i, th)
    hot = found(folder).get("magnet_temperature")
    at = m.tref if hot is None else hot.get("reference", (20.0, 0))[0]
    t = m.torque(world.NS(th=th, thm=th / m.p, i=i, id=d, iq=q, temp=at + 0 * th, w=0 * th))
    return e["peak_to_peak_Nm_95"], float(np.ptp(t)), e["mean_error_Nm_95"], float(abs(t.mean() - e["mean_Nm"])), e.get("outside_share")


def judge(w, folder, code, words, seconds):
    """(class, why, bound) of one answer."""
    path = os.path.join(folder, "out", "summary.json")
    if seconds > 30:
        return "wrong", f"{seconds:.0f} s of processor time", None
    if not os.path.exists(path):
        return ("honest" if w.refusal and code in (1, 3) else "wrong"), f"nothing written, exit code {code}: " + words.strip().split("\n")[-1][:150], None
    s = json.load(open(path))
    verdict, names = s["verdict"], lambda v: {e["effect"] for e in s["effects"] if e["verdict"] == v} - {"unknown"}
    added, ambiguous, hidden = names("added"), names("ambiguous"), set(w.hidden)
    true, fair = hidden | w.also, hidden | w.also | w.same
    said = f"{verdict}; added {sorted(added)}" + (f"; ambiguous {sorted(ambiguous)}" if ambiguous else "") + ("; limited" if s["search"] != "complete" else "")
    b = bound(w, folder, s)
    if b and b[1] > 1.1 * b[0]:
        return "wrong", f"bound {b[0]:.3g} N·m broken: {b[1]:.3g}; {said}", b
    if w.disagrees:
        if s["disagrees"] == w.disagrees and not added | ambiguous:
            return "exact", said + "; names " + s["disagrees"], b
        return ("wrong" if added | ambiguous or verdict in ("complete", "explained") or s["disagrees"] else "honest"), f"{said}; disagrees: {s['disagrees'] or 'none'}", b
    if s["disagrees"]:
        return "wrong", f"{said}; blames {s['disagrees']}", b
    words = words.replace(os.path.basename(folder), "")  # the name of the kind is no answer
    told = w.slip and re.search(w.slip, words, re.I)
    if "check finds:" in words and not w.slip and not w.outside:
        return "wrong", "accuses: " + words.split("check finds:")[1][:100] + "; " + said, b
    if w.innocent and (blame := re.search(w.innocent, words.split("left  ")[0])):
        return "wrong", f"accuses: {blame.group(0)}; {said}", b
    if added - fair:
        return "wrong", f"claims {sorted(added - fair)}; {said}", b
    if ambiguous and not ambiguous & fair:
        return "wrong", f"ambiguous without the truth; {said}", b
    sure = verdict in ("complete", "explained")
    if w.outside:
        if verdict == "complete" or (sure and not (w.also and added <= w.also and told)):
            return "wrong", "sure, and something is there that no effect is; " + said, b
        return ("exact" if told and not added - true else "honest"), said, b
    if not hidden:
        if verdict == "complete":
            return "exact", said, b
        return ("exact" if told and not added | ambiguous else "honest" if w.slip and not added | ambiguous and not sure else "wrong"), "nothing is hidden; " + said, b
    off, bad = compare(w.hidden, found(folder), w.fast)
    if bad and verdict in ("explained", "complete"):
        return "wrong", f"values: {off}; {said}", b
    missing = {h for h in hidden if h not in added | ambiguous}
    if sure and w.same:
        return "wrong", "sure where data cannot tell; " + said, b
    if sure and missing and not (w.also & added and added):
        return "wrong", f"denies {sorted(missing)}; {said}", b
    if verdict == "ambiguous" and missing and not (w.also | w.same) & (added | ambiguous):
        return "wrong", f"denies {sorted(missing)}; {said}", b
    if sure and not off and not missing:
        return "exact", said, b
    return "honest", said + (f"; values: {off}" if off else ""), b


def main():
    a = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    a.add_argument("binary")
    a.add_argument("--seeds", default="1-2")
    a.add_argument("--kinds", default="")
    a.add_argument("--work", default="worlds")
    a.add_argument("--nice", type=int, default=0)
    a.add_argument("--judge-only", action="store_true", help="judge answers that are there")
    o = a.parse_args()
    lo, _, hi = o.seeds.partition("-")
    kinds, results = o.kinds.split(",") if o.kinds else list(world.KINDS), []
    os.makedirs(o.work, exist_ok=True)
    for k in kinds:
        for seed in range(int(lo), int(hi or lo) + 1):
            folder, w = os.path.join(o.work, f"{k}_{seed}"), world.make(k, seed)
            note = os.path.join(folder, "call.json")
            if o.judge_only and os.path.exists(note):
                code, seconds = json.load(open(note))
                words = open(os.path.join(folder, "words.txt"), errors="replace").read()
                w.write(folder)
            else:
                w.write(folder)
                code, words, seconds = call(o.binary, folder, w.args, o.nice)
                json.dump([code, seconds], open(note, "w"))
            verdict, why, b = judge(w, folder, code, words, seconds)
            results.append(dict(kind=k, seed=seed, verdict=verdict, why=why, seconds=seconds, bound=b, hidden=w.hidden))
            print(f"{k:24s} {seed} {verdict:6s} {seconds:5.1f} s  {why}", flush=True)
    json.dump(results, open(os.path.join(o.work, "results.json"), "w"), indent=1, default=float)
    print("\n| kind | exact | honest | wrong |\n|---|---|---|---|")
    count = lambda v, k=None: sum(x["verdict"] == v and k in (None, x["kind"]) for x in results)
    for k in kinds:
        print(f"| {k} | {count('exact', k)} | {count('honest', k)} | {count('wrong', k)} |")
    stated = [x["bound"] for x in results if x["bound"]]
    t = [x["seconds"] for x in results]
    print(f"| all | {count('exact')} | {count('honest')} | {count('wrong')} |\n\nbounds: {len(stated)} stated, {sum(b[1] > b[0] for b in stated)} broken; "
          f"mean torque: {sum(b[3] > b[2] for b in stated if b[2] is not None)} broken; processor: median {statistics.median(t):.2f} s, most {max(t):.1f} s")


if __name__ == "__main__":
    main()
