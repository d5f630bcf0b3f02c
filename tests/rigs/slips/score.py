"""How often `check` names what was seeded, and how often it reports something on a correct machine. See README.md."""

import argparse
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from multiprocessing.pool import ThreadPool
from collections import Counter

import slips

OUTCOMES = ("named", "ambiguous", "missed", "wrong")


class Answer:
    """What the program said of a folder."""

    def __init__(self, code, summary, stderr):
        self.code, self.stderr = code, stderr
        self.verdict = summary.get("verdict", "none")
        self.findings = summary.get("findings", [])
        self.riddles = ["%s %.4g for %g" % (e["name"], e["as_read"], e["expected"]) for e in summary.get("evidence", [])
                        if e["state"] == "not_understood"]

    def words(self):
        found = ["%s %.2f (%s)" % (f["slip"], f["probability"], " ".join(sorted(names_of(f) - {f["slip"]}))) for f in self.findings]
        riddles = ", not understood: " + ", ".join(self.riddles) if self.riddles else ""
        return "exit %d, %s: %s%s" % (self.code, self.verdict, "; ".join(found) or "nothing", riddles)


def names_of(finding):
    """The slip of a finding and all that it names as alternatives, in whatever form these are written."""
    return {finding["slip"]} | set(re.findall(r"[a-z_]+", json.dumps(finding.get("alternatives", [])))) & set(slips.APPLY)


def hashes(folder):
    result = {}
    for path, _, files in os.walk(folder):
        for name in files:
            with open(os.path.join(path, name), "rb") as file:
                result[os.path.join(path, name)] = hashlib.sha256(file.read()).hexdigest()
    return result


def ask(program, folder, case, timeout_s):
    """Runs check in a folder of its own. An answer that cannot be read, or a crash, is an error."""
    runs = sorted(path for path in case.files if path.startswith("runs/"))
    done = subprocess.run([program, "check", "machine"] + runs + ["--json"], cwd=folder, capture_output=True, text=True, timeout=timeout_s)
    with open(os.path.join(folder, "check.log"), "w") as log:
        log.write("hci-solve check machine %s --json\n%s\n%s\nexit %d\n" % (" ".join(runs), done.stdout, done.stderr, done.returncode))
    if done.returncode == 3:
        return Answer(3, {}, done.stderr)
    if done.returncode not in (0, 1):
        raise ValueError("exit code %d: %s" % (done.returncode, done.stderr[-300:]))
    answer = Answer(done.returncode, json.loads(done.stdout), done.stderr)
    if (done.returncode == 0) != (answer.verdict == "consistent"):
        raise ValueError("exit code %d with the verdict %s" % (done.returncode, answer.verdict))
    return answer


def is_named(name, truth, findings):
    """By its own name with at least even odds; or, where others look the same, by any of these names if the true one stands beside it."""
    family = {name} | truth.alike
    return any((f["slip"] == name and f["probability"] >= 0.5) or
               (truth.alike and f["slip"] in family and name in names_of(f) and names_of(f) & truth.alike) for f in findings)


def by_own_names(case, answer):
    """Whether each slip is found by its own name with at least even odds, none by one that looks the same."""
    sure = {f["slip"] for f in answer.findings if f["probability"] >= 0.5}
    return set(case.truths) <= sure


def compare(case, answer):
    """One of OUTCOMES."""
    allowed = set(case.truths).union(*[truth.alike for truth in case.truths.values()])
    if any(f["probability"] >= 0.5 and f["slip"] not in allowed for f in answer.findings):
        return "wrong"
    if all(is_named(name, truth, answer.findings) for name, truth in case.truths.items()):
        return "named"
    mentioned = set().union(*[names_of(f) for f in answer.findings])
    return "ambiguous" if set(case.truths) <= mentioned else "missed"


def pointing(case, answer):
    """What is wrong with file, line, and the value that should be there, of findings with the right name."""
    faults = []
    for f in answer.findings:
        truth = case.truths.get(f["slip"])
        if not truth or f["probability"] < 0.5:
            continue
        if os.path.basename(f.get("file") or "") not in truth.files:
            faults.append("%s points to file %s, not to %s" % (f["slip"], f.get("file"), " or ".join(truth.files)))
        should_be = re.findall(r"[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?", str(f.get("should_be")))
        if truth.should_be and not any(abs(float(x) / truth.should_be - 1) < 0.03 for x in should_be):
            faults.append("%s should be %r, not %g" % (f["slip"], f.get("should_be"), truth.should_be))
    return faults


def examine(task):
    """Makes a case, runs `check`, compares: (name, slips, outcome, words, faults, by their own names). Runs in a process of its own."""
    make, arguments, options = task
    case = make(*arguments)
    folder = os.path.join(options.work, case.name)
    case.write(folder)
    before = hashes(folder)
    try:
        answer = ask(options.program, folder, case, options.timeout)
    except (ValueError, KeyError, subprocess.TimeoutExpired) as error:
        return case.name, sorted(case.truths), "error", str(error)[:300], [], False
    after = hashes(folder)
    after.pop(os.path.join(folder, "check.log"))
    if before != after:
        return case.name, sorted(case.truths), "error", "check changed the folder", [], False
    return (case.name, sorted(case.truths)) + verdict(case, answer)


def verdict(case, answer):
    words = answer.words() + (": " + answer.stderr.strip().split("\n")[0] if answer.code == 3 else "")
    if not case.truths:
        return ("false" if answer.verdict != "consistent" or answer.findings else "quiet"), words, [], False
    alike = "; ".join("%s looks like %s" % (name, " ".join(sorted(truth.alike))) for name, truth in case.truths.items() if truth.alike)
    return compare(case, answer), words + (" [%s]" % alike if alike else ""), pointing(case, answer), by_own_names(case, answer)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("--seed", type=int, default=1, help="of the first set of cases")
    parser.add_argument("--repeat", type=int, default=1, help="sets of cases, each with the next seed")
    parser.add_argument("--correct", type=int, default=100, help="correct machines")
    parser.add_argument("--only", default="", help="cases whose name contains this")
    parser.add_argument("--named", type=float, default=0.0, help="least share of seeded cases that are named")
    parser.add_argument("--false", type=int, default=None, dest="false_alarms", help="most correct machines on which something is reported")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--timeout", type=float, default=60, help="of one check, in s")
    parser.add_argument("--keep", help="folder for the cases that went wrong")
    options = parser.parse_args()
    options.program = os.path.abspath(options.program)
    return options


def tasks(options):
    seeded = [case for k in range(options.repeat) for case in slips.seeded(options.seed + k)]
    correct = [(slips.correct, (options.seed + k,)) for k in range(options.correct)]
    chosen = [(make, args) for make, args in seeded + correct if options.only in label(make, args)]
    return [(make, args, options) for make, args in chosen]


def label(make, args):
    return "correct" if make is slips.correct else "+".join(slips.PAIRS[args[0]][0]) if make is slips.pair else args[0]


def table(results):
    """A line per slip: cases alone and in pairs, and their outcomes."""
    lines = ["%-34s %6s %s" % ("slip", "cases", " ".join("%9s" % x for x in OUTCOMES + ("error",)))]
    for name in slips.APPLY:
        counts = Counter(outcome for _, truths, outcome, *_ in results if name in truths)
        if counts:
            lines.append("%-34s %6d %s" % (name, sum(counts.values()), " ".join("%9s" % (counts[x] or ".") for x in OUTCOMES + ("error",))))
    return "\n".join(lines)


def keep(options, name):
    if not options.keep:
        return ""
    target = os.path.join(os.path.abspath(options.keep), name)
    shutil.rmtree(target, ignore_errors=True)
    shutil.copytree(os.path.join(options.work, name), target)
    return "\n    " + target


def report(options, results):
    for name, _, outcome, words, faults, _ in results:
        if outcome not in ("named", "quiet") or faults:
            print("%-9s %s: %s%s%s" % (outcome, name, words, "".join("\n    " + f for f in faults), keep(options, name)))
    seeded = [r for r in results if r[1]]
    print(table(seeded))
    counts, correct = Counter(r[2] for r in seeded), Counter(r[2] for r in results if not r[1])
    pointing_faults = sum(1 for r in seeded if r[4])
    share = counts["named"] / len(seeded) if seeded else 1.0
    own = sum(1 for r in seeded if r[2] == "named" and r[5])
    print("%d seeded cases, %.1f %% named: %s" % (len(seeded), 100 * share, ", ".join("%s %d" % (x, counts[x]) for x in OUTCOMES + ("error",))))
    print("of those named, %d with even odds by their own names; pointing to the wrong place or value: %d" % (own, pointing_faults))
    alarms = sum(correct.values()) - correct["quiet"]
    print("%d correct machines, %d false alarms" % (sum(correct.values()), alarms))
    good = share >= options.named and not counts["error"] and (options.false_alarms is None or alarms <= options.false_alarms) and not correct["error"]
    print("verdict: %s" % ("good" if good else "below the bar"))
    return 0 if good else 1


def main():
    options = arguments()
    with tempfile.TemporaryDirectory(prefix="hci-slips-") as options.work:
        with ThreadPool(options.jobs) as pool:  # they only wait for the program
            results = pool.map(examine, tasks(options), chunksize=1)
        return report(options, results)


if __name__ == "__main__":
    sys.exit(main())
