#!/usr/bin/env python3
"""Runs `BIN diagnose` on generated recordings and judges what it says, as a demanding but fair engineer.

    score.py BIN --seeds 1-3 [--kinds a,b] [--jobs 1] [--work FOLDER] [--out FILE]

exact   names what is hidden and nothing else (of what no one could tell apart: names it as ambiguous)
honest  says not known, not told apart, partly explained; nothing that it claims is false
wrong   claims what is not there, denies what is, writes no answer, crashes, takes more than 30 s
"""
import argparse
import concurrent.futures
import csv
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import threading
import time

import world

LIMIT = 30.0      # seconds
FAINT_CHI = 60.0  # below this no one could see it
FAINT_RMS = 0.06  # below this part of the noise of a sample it does not matter


def numbers(text):
    out = []
    for part in text.split(","):
        first, _, last = part.partition("-")
        out += range(int(first), int(last or first) + 1)
    return out


def parameters(folder):
    """Of the corrected machine: effect -> parameter -> value."""
    out = {}
    try:
        with open(os.path.join(folder, "machine", "effects.csv"), newline="") as f:
            for row in csv.DictReader(line for line in f if not line.startswith("#")):
                out.setdefault(row["effect"], {})[row["parameter"]] = float(row["value"])
    except OSError:
        pass
    return out


def predicted(program, machine, run, cwd):
    """rms of a recording without noise less the prediction."""
    done = subprocess.run([program, "predict", machine, run, "--json"], cwd=cwd, capture_output=True, text=True, timeout=60)
    try:
        return json.loads(done.stdout)["residual"]["rms_Nm"]
    except (ValueError, KeyError, TypeError):
        return None


def judge(truth, code, seconds, summary, values, before=None, after=None):
    """exact, honest or wrong, with the reason."""
    if seconds > LIMIT:
        return "wrong", f"took {seconds:.0f} s"
    if code == 3 and truth["refusal_ok"]:
        return "exact", "refused, and there is nothing to compare"
    if code in (0, 1) and summary and truth["refusal_ok"] and summary["verdict"] == "unknown" and not any(
            e["verdict"] in ("added", "ambiguous") for e in summary["effects"]):
        return "exact", "says that nothing can be said"
    if code not in (0, 1) or summary is None:
        return "wrong", f"no answer, exit code {code}"
    verdict = summary["verdict"]
    confident = verdict in ("complete", "explained")
    added = [e["effect"] for e in summary["effects"] if e["verdict"] == "added"]
    doubtful = [e["effect"] for e in summary["effects"] if e["verdict"] == "ambiguous"]
    said = f"{verdict}: " + ", ".join(added + [e + "?" for e in doubtful])
    names = {h: [h] + truth["synonyms"].get(h, []) for h in truth["hidden"]}
    true = {n for many in names.values() for n in many}
    allowed = true | set(truth["also"]) | {"unknown"}
    false = [e for e in added if e not in allowed]
    if false:
        return "wrong", f"claims {', '.join(false)} ({said})"
    if doubtful and not allowed & set(doubtful):
        return "wrong", f"not told apart, and none of it is there ({said})"
    loud = [h for h in truth["hidden"] if truth["strength"].get(h, [1e9, 1e9])[0] > FAINT_CHI
            and truth["strength"].get(h, [1e9, 1e9])[1] > FAINT_RMS]
    missing = [h for h in loud if not set(names[h]) & set(added + doubtful)]
    if truth["must_doubt"]:
        if confident:
            return "wrong", f"nothing is doubted ({said})"
        return ("honest" if added or doubtful else "exact"), said
    if before is not None and after is not None:
        if after > 1.15 * before + 0.15 * truth["sigma_Nm"]:
            return "wrong", f"unseen run is described worse: {before:.3g} to {after:.3g} N·m ({said})"
        if confident and added and after > 0.5 * before and after > truth["sigma_Nm"]:
            return "wrong", f"sure of it, but an unseen run keeps {after:.3g} of {before:.3g} N·m ({said})"
    if truth["outside"]:
        if confident and added:
            return "wrong", f"sure, of something outside of its catalogue ({said})"
        return ("honest" if added or doubtful or confident else "exact"), said
    if missing and confident:
        return "wrong", f"denies {', '.join(missing)} ({said})"
    if not truth["hidden"]:
        if verdict == "complete":
            return "exact", said
        return ("wrong" if truth["noise_only"] else "honest"), f"something is left, it says ({said})"
    if missing:
        return "honest", f"does not find {', '.join(missing)} ({said})"
    for effect, parameter, value, tolerance in truth["values"]:
        if effect in added:
            found = values.get(effect, {})
            plus, _, minus = parameter.partition("-")
            if plus.startswith("amplitude_"):
                n = plus[len("amplitude_"):]
                found = {plus: math.hypot(found.get("sine_" + n, 0.0), found.get("cosine_" + n, 0.0))}
            x = found.get(plus, 0.0) - (found.get(minus, 0.0) if minus else 0.0)
            if abs(x - value) > tolerance:
                return ("wrong" if confident else "honest"), f"{effect} {parameter} {x:.4g} for {value:.4g} ({said})"
    if truth["strict"]:
        others = {a for many in truth["alternatives"].values() for a in many}
        if doubtful and set(doubtful) <= true | others:
            return "exact", said
        return "honest", f"surer than one can be ({said})"
    if confident and not doubtful:
        return "exact", said
    return "honest", said


def one(program, name, seed, work):
    folder = os.path.join(work, f"{name}_{seed}")
    shutil.rmtree(folder, ignore_errors=True)
    truth = world.write_case(name, seed, folder)
    truth = json.load(open(os.path.join(folder, "truth.json")))
    start = time.monotonic()
    words_file = open(os.path.join(folder, "words.txt"), "w+", encoding="utf-8")
    child = subprocess.Popen([program, "diagnose", "machine", "--runs", "runs.csv", "-o", "out"], cwd=folder,
                             stdout=subprocess.DEVNULL, stderr=words_file)
    timer = threading.Timer(6 * LIMIT, child.kill)
    timer.start()
    _, status, usage = os.wait4(child.pid, 0)
    timer.cancel()
    code = child.returncode = os.waitstatus_to_exitcode(status)
    elapsed = time.monotonic() - start
    # of a machine that others share, the processor's time is what the program takes
    seconds = min(elapsed, usage.ru_utime + usage.ru_stime)
    words_file.seek(0)
    words = words_file.read()
    words_file.close()
    summary = None
    try:
        summary = json.load(open(os.path.join(folder, "out", "summary.json")))
    except (OSError, ValueError):
        pass
    before = after = None
    if summary and os.path.exists(os.path.join(folder, "secret", "secret.csv")):
        before = predicted(program, "machine", "secret/secret.csv", folder)
        after = predicted(program, "out/machine", "secret/secret.csv", folder)
    verdict, reason = judge(truth, code, seconds, summary, parameters(os.path.join(folder, "out")), before, after)
    if summary is None:
        reason += ": " + " ".join(words.split())[:300]
    return {"kind": name, "seed": seed, "judgement": verdict, "seconds": round(seconds, 2), "elapsed": round(elapsed, 2), "exit": code, "reason": reason,
            "not_repeating": bool(summary and summary.get("does_not_repeat")), "hidden": truth["hidden"], "strength": truth["strength"], "secret_before_Nm": before, "secret_after_Nm": after}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--seeds", default="1-3")
    parser.add_argument("--kinds", default="")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--work", default="")
    parser.add_argument("--out", default="score.jsonl")
    a = parser.parse_args()
    program = os.path.abspath(a.program)
    kinds = a.kinds.split(",") if a.kinds else list(world.KINDS)
    unknown = [k for k in kinds if k not in world.KINDS]
    if unknown:
        parser.error("no kind " + ", ".join(unknown))
    work = a.work or tempfile.mkdtemp(prefix="plantfloor")
    os.makedirs(work, exist_ok=True)
    table = {k: {"exact": 0, "honest": 0, "wrong": 0} for k in kinds}
    slow = {k: 0.0 for k in kinds}
    tasks = [(k, s) for k in kinds for s in numbers(a.seeds)]
    with open(a.out, "w") as out, concurrent.futures.ThreadPoolExecutor(max(1, a.jobs)) as pool:
        for row in pool.map(lambda task: one(program, *task, work), tasks):
            table[row["kind"]][row["judgement"]] += 1
            slow[row["kind"]] = max(slow[row["kind"]], row["seconds"])
            out.write(json.dumps(row, ensure_ascii=False) + "\n")
            out.flush()
            if row["judgement"] == "wrong":
                print(f"  {row['kind']} {row['seed']}: {row['reason']}", file=sys.stderr)
    print(f"{'world':26}{'exact':>6}{'honest':>8}{'wrong':>7}{'slowest s':>11}")
    for k in kinds:
        print(f"{k:26}{table[k]['exact']:6}{table[k]['honest']:8}{table[k]['wrong']:7}{slow[k]:11.1f}")
    total = [sum(t[j] for t in table.values()) for j in ("exact", "honest", "wrong")]
    print(f"{'all':26}{total[0]:6}{total[1]:8}{total[2]:7}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
