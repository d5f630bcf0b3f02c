"""Kills a command of hci-solve that replaces a folder of results, at random times of its run, and looks at what is there.

    random_kills.py TIMES SEED HCI_SOLVE FOLDER COMMAND [WORD...]

FOLDER has older results, or is not there. The command gets -q and -o; it is killed (SIGKILL, with its children) after a time that
is drawn evenly from nothing to a tenth more than it took when it ran to its end last. Once another command has read the folder it has to hold the
older files or the newer, in all folders within. Then the same command runs to its end, and has to leave the newer files and
nothing else. `sweep`, which keeps its points as it goes, may hold those too, and goes on. `tune`, which writes step by
step into a folder that is new, may hold some of the newer files, each whole and without the summary.json that ends it, and
is refused that folder; where it had older results these stand beside it meanwhile, and it puts them back, and goes on. Prints how often which was; ends with 1 if one was wrong.
"""

import collections
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from results import content, left_over, read

PROGRESS = ("points.csv", "sweep.csv")


class Trial:
    def __init__(self, program, older, words, work):
        self.program, self.older, self.folder = program, older, os.path.join(work, "out")
        self.aside = os.path.join(work, ".out.before")  # of tune: the older results, until the newer are whole
        self.command = [program, *words, "-q", "-o", self.folder]
        self.name = words[0]

    def begin(self):
        for folder in self.folder, self.aside:
            shutil.rmtree(folder, ignore_errors=True)
        if os.path.isdir(self.older):
            shutil.copytree(self.older, self.folder)

    def run(self, seconds=None):
        """Exit code; negative where it was killed."""
        begun = time.monotonic()
        child = subprocess.Popen(self.command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, start_new_session=True)
        if seconds is not None:
            time.sleep(seconds)
            try:
                os.killpg(child.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        self.words = child.communicate()[1].decode(errors="replace")
        if child.returncode in (0, 1):
            self.took = time.monotonic() - begun
        return child.returncode

    def holds(self, old, new):
        """older, newer, progress, steps, or None."""
        found = content(self.folder)
        if found == new:
            return "newer"
        if found == old and not (self.name == "tune" and not old and os.path.isdir(self.folder)):
            return "older"
        rest = {name: text for name, text in (found or {}).items() if name not in PROGRESS}
        if self.name == "sweep" and (rest or None) == old:
            return "progress"
        is_step = self.name == "tune" and "summary.json" not in (found or {}) and (found or {}).items() <= new.items()
        return "steps" if is_step and content(self.aside) == old else None


def one(trial, share, old, new):
    """What came of one kill, after a share of the time, and why it is wrong or None."""
    seconds = share * trial.took
    trial.begin()
    code = trial.run(seconds)
    read(trial.program, trial.folder)
    held = trial.holds(old, new)
    what = f"{held or 'neither'}, {'killed' if code < 0 else 'ended before'}"
    if not held or (code >= 0 and held != "newer"):
        return what, f"after {seconds:.4f} s it holds {held or sorted(content(trial.folder) or [])}"
    found = content(trial.folder)
    again = trial.run()
    is_refused = again == 2 and "a call was broken off there" in trial.words
    if held == "steps" and is_refused and not old:
        return what, None
    if held == "steps" and found and not old:
        return what, f"after {seconds:.4f} s the same command ends with {again}: {trial.words.strip()}"
    if held == "newer" and trial.name == "tune":
        return what, None
    if again not in (0, 1) or content(trial.folder) != new or left_over(trial.folder) or os.path.exists(trial.aside):
        return what, f"after {seconds:.4f} s the same command ends with {again}, {left_over(trial.folder)}: {trial.words.strip()}"
    return what, None


def main(times, seed, program, older, *words):
    counted, wrong, chance = collections.Counter(), 0, random.Random(int(seed))
    with tempfile.TemporaryDirectory() as work:
        trial = Trial(program, older, words, work)
        trial.begin()
        code = trial.run()
        old, new = content(older), content(trial.folder)
        if code not in (0, 1) or old == new:
            return f"without a kill: exit code {code}, and the results are the same: {old == new}: {trial.words}"
        for _ in range(int(times)):
            what, why = one(trial, chance.uniform(0.0, 1.1), old, new)
            counted[what] += 1
            if why:
                wrong += 1
                print(why)
    print(f"{words[0]}, {trial.took:.2f} s, {times} times: {dict(sorted(counted.items()))}, {wrong} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
