"""Runs a command of hci-solve that replaces a folder of results, each time with another call that changes the folder
failing, or with the process killed before it.

    every_call.py LIBRARY kill|error HCI_SOLVE FOLDER COMMAND [WORD...]

LIBRARY is faulty_calls.c, compiled; FOLDER has older results, or is not there. The command gets -q and -o. Once
another command has read the folder it has to hold the older files or the newer, in all folders within, and, where the process was not
killed, those that the exit code says; where it was, no backup of an older file is left. Prints how often which was; ends with 1 if a folder was neither.
"""

import collections
import os
import shutil
import subprocess
import sys
import tempfile

from results import content, left_over, read


class Trial:
    def __init__(self, library, mode, program, older, words, work):
        self.environment = dict(os.environ, LD_PRELOAD=library, FAULT_COUNT="2")
        if mode == "error":
            self.environment["FAULT_ERROR"] = "1"
        self.program, self.older, self.words, self.folder = program, older, words, os.path.join(work, "out")

    def run(self, at):
        """Exit code and the number of calls, on a fresh copy of the older results, with call number `at` failing."""
        shutil.rmtree(self.folder, ignore_errors=True)
        if os.path.isdir(self.older):
            shutil.copytree(self.older, self.folder)
        environment = dict(self.environment, FAULT_AT=str(at))
        command = [self.program] + self.words + ["-q", "-o", self.folder]
        ended = subprocess.run(command, env=environment, stdin=subprocess.DEVNULL, capture_output=True)
        return ended.returncode, int((ended.stderr.decode().split() or ["0"])[-1]) if ended.returncode >= 0 else 0


def main(library, mode, program, older, *words):
    counted = collections.Counter()
    with tempfile.TemporaryDirectory() as work:
        trial = Trial(library, mode, program, older, list(words), work)
        code, calls = trial.run(0)
        old, new = content(older), content(trial.folder)
        if code not in (0, 1) or old == new or not calls:
            return f"without a fault: exit code {code}, {calls} calls, and the results are the same: {old == new}"
        for at in range(1, calls + 1):
            code, _ = trial.run(at)
            read(program, trial.folder)
            found = content(trial.folder)
            what = "older" if found == old else "newer" if found == new else "neither"
            backups = [name for name in left_over(trial.folder) if name.endswith(".old") and mode == "kill"]
            good = what != "neither" and not backups and (code < 0 or (what == "newer") == (code in (0, 1)))
            counted[what if good else "wrong"] += 1
            if not good:
                print(f"call {at}: exit code {code}, the folder holds {what}: {sorted(found or [])} {backups}")
        print(f"{calls} calls, {mode}: {dict(counted)}")
    return 1 if counted["wrong"] else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
