"""Runs a command of hci-solve that replaces a folder of results, each time with another system call failing, as it does on a disk that
breaks: what the C library asks of the system for its own functions too, which faulty_calls.c does not see.

    every_system_call.py CALLS STRIDE HCI_SOLVE FOLDER COMMAND [WORD...]

CALLS such as openat,read,write,close:EIO; of each every STRIDE-th is tried, by strace. FOLDER has older results, or is not there. The
command gets -q and -o. It has to hold the newer files with the exit code that these have without a fault, or the older ones with
another code and words; what was read wrongly must not become a result. Prints how often which was; ends with 1 if one was wrong.
"""

import collections
import os
import re
import shutil
import subprocess
import sys
import tempfile

from results import content, read


class Trial:
    def __init__(self, program, older, words, work):
        self.program, self.older, self.folder, self.trace = program, older, os.path.join(work, "out"), os.path.join(work, "trace")
        self.command = [program, *words, "-q", "-o", self.folder]

    def run(self, *options):
        """Exit code and words, on a fresh copy of the older results, under strace with these options; then what was begun is ended."""
        shutil.rmtree(self.folder, ignore_errors=True)
        if os.path.isdir(self.older):
            shutil.copytree(self.older, self.folder)
        ended = subprocess.run(
            ["strace", "-f", "-qq", "-o", self.trace, *options, *self.command], stdin=subprocess.DEVNULL, capture_output=True
        )
        read(self.program, self.folder)
        return ended.returncode, ended.stderr.decode(errors="replace").strip()

    def calls(self, name):
        self.run("-e", f"trace={name}")
        with open(self.trace) as trace:
            return sum(re.match(rf"\d+ +{name}\(", line) is not None for line in trace)

    def place(self):
        """The call that failed."""
        with open(self.trace, errors="replace") as trace:
            return next((line.strip() for line in trace if "INJECTED" in line), "")


def verdict(trial, ended, whole, old, new):
    """What the folder holds, and whether that is right. The loader of the program has exit code 127, or is ended by a signal."""
    code, words = ended
    found = content(trial.folder)
    what = "older" if found == old else "newer" if found == new else "neither"
    if what == "newer":
        return what, code == whole
    return what, what == "older" and code not in (0, 1) and bool(words)


def main(calls, stride, program, older, *words):
    counted, wrong = collections.Counter(), 0
    names, error = calls.split(":")
    with tempfile.TemporaryDirectory() as work:
        trial = Trial(program, older, words, work)
        code, _ = trial.run("-e", "trace=none")
        old, new = content(older), content(trial.folder)
        if code not in (0, 1) or old == new:
            return f"without a fault: exit code {code}, and the results are the same: {old == new}"
        for name in names.split(","):
            for at in range(1, trial.calls(name) + 1, int(stride)):
                ended = trial.run("-e", f"trace={name}", "-e", f"inject={name}:error={error}:when={at}")
                what, is_right = verdict(trial, ended, code, old, new)
                counted[f"{name} {what if is_right else 'wrong'}"] += 1
                if not is_right:
                    wrong += 1
                    print(f"{name} {at}: exit code {ended[0]}, the folder holds {what}: {trial.place()}: {ended[1]}")
    print(f"{words[0]}, {error}: {dict(sorted(counted.items()))}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
