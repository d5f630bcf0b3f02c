"""Runs a command of hci-solve again and again, each time with another allocation of the whole process failing.

    every_allocation.py LIBRARY STRIDE HCI_SOLVE COMMAND [WORD...]

LIBRARY is failing_malloc.c, compiled; of the allocations every STRIDE-th is tried. The command gets -q and -o FOLDER.
It has to end with exit code 4, words and no folder, or as it does with enough memory, with the same files. Prints how
often which happened, and each that is neither; ends with 1 if there was one.
"""

import collections
import filecmp
import os
import re
import shutil
import subprocess
import sys
import tempfile


def files_below(folder):
    return sorted(
        os.path.relpath(os.path.join(path, name), folder) for path, _, names in os.walk(folder) for name in names
    )


def is_same(folder, other):
    names = files_below(folder)
    return names == files_below(other) and filecmp.cmpfiles(folder, other, names, shallow=False)[1:] == ([], [])


class Trial:
    def __init__(self, library, command, folder):
        self.library, self.command, self.folder = library, command, folder

    def run(self, at):
        """Exit code and standard error with allocation number `at` failing, of 0 none."""
        shutil.rmtree(self.folder, ignore_errors=True)
        environment = dict(os.environ, LD_PRELOAD=self.library, FAIL_AT=str(at), OPENBLAS_NUM_THREADS="1", FAIL_COUNT="2")
        ended = subprocess.run(
            self.command + ["-q", "-o", self.folder], env=environment, stdin=subprocess.DEVNULL, capture_output=True
        )
        return ended.returncode, ended.stderr.decode(errors="replace")


def outcome(trial, at, code, words, whole):
    whole_code, whole_folder = whole
    left = files_below(trial.folder)
    said = re.sub(r"\d+\n$", "", words).strip()
    if code == 4 and not os.path.exists(trial.folder):
        return "no memory" if said else None
    if code == whole_code and is_same(trial.folder, whole_folder):
        return "absorbed"
    return None


def main(library, stride, *command):
    counted, wrong = collections.Counter(), 0
    with tempfile.TemporaryDirectory() as work:
        trial = Trial(library, list(command), os.path.join(work, "whole"))
        code, words = trial.run(0)
        allocations = int(words.split()[-1])
        whole = code, trial.folder
        trial.folder = os.path.join(work, "out")
        for at in range(1, allocations + 1, int(stride)):
            ended, words = trial.run(at)
            what = outcome(trial, at, ended, words, whole)
            counted[what or "wrong"] += 1
            if not what:
                wrong += 1
                print(f"allocation {at}: exit code {ended}, left {files_below(trial.folder)}: {words.strip()}")
    print(f"{allocations} allocations: {dict(counted)}")
    return 1 if wrong or not counted["no memory"] else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
