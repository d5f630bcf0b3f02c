"""Runs a command of hci-solve again and again, each time with another allocation of the whole process failing.

    every_allocation.py LIBRARY STRIDE HCI_SOLVE COMMAND [WORD...]

LIBRARY is failing_malloc.c, compiled; of the allocations every STRIDE-th is tried, with STRIDE:LAST up to one. The command gets -q and -o FOLDER.
It has to end with exit code 4, words and no folder, or as it does with enough memory, with the same files; `batch`
also with exit code 1 and a row of a motor that says it, or with exit code 4, words and a folder from which the same
command goes on to the same files, as `sweep` does. Prints how often which happened, and each that is neither;
ends with 1 if there was one.
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
    """Without the database of `batch`, which has times in it."""
    paths = [os.path.join(path, name) for path, _, names in os.walk(folder) for name in names]
    return sorted(os.path.relpath(path, folder) for path in paths if not path.endswith(".sqlite"))


def remove(result):
    """A folder, or the one file of `predict`."""
    if os.path.isfile(result):
        os.remove(result)
    shutil.rmtree(result, ignore_errors=True)


def is_same(folder, other):
    if os.path.isfile(folder):
        return os.path.isfile(other) and filecmp.cmp(folder, other, shallow=False)
    names = files_below(folder)
    return names == files_below(other) and filecmp.cmpfiles(folder, other, names, shallow=False)[1:] == ([], [])


class Trial:
    def __init__(self, library, command, folder):
        self.library, self.command, self.folder = library, command, folder

    def run(self, at, goes_on=False):
        """Exit code and standard error with allocation number `at` failing, of 0 none."""
        if not goes_on:
            remove(self.folder)
        environment = dict(os.environ, LD_PRELOAD=self.library, FAIL_AT=str(at), OPENBLAS_NUM_THREADS="1", FAIL_COUNT="2")
        ended = subprocess.run(
            self.command + ["-q", "-o", self.folder], env=environment, stdin=subprocess.DEVNULL, capture_output=True
        )
        return ended.returncode, ended.stderr.decode(errors="replace")


def has_row(folder):
    """Whether a motor has no result for lack of memory, and its row says so."""
    path = os.path.join(folder, "fleet.csv")
    return os.path.exists(path) and re.search(",failed,4,,[^,]*out of memory", open(path).read())


def ends(trial, whole_folder):
    """Whether the same command ends what it has begun."""
    code, _ = trial.run(0, goes_on=True)
    return code == 0 and is_same(trial.folder, whole_folder)


def outcome(trial, at, code, words, whole):
    whole_code, whole_folder = whole
    left = files_below(trial.folder)
    said = re.sub(r"\d+\n$", "", words).strip()
    if code == 4 and not os.path.exists(trial.folder):
        return "no memory" if said else None
    if code == whole_code and is_same(trial.folder, whole_folder):
        return "absorbed"
    if code == 1 and has_row(trial.folder):
        return "row"
    if code == 4 and said and trial.command[1] in ("batch", "sweep") and ends(trial, whole_folder):
        return "goes on"
    return None


def main(library, stride, *command):
    counted, wrong = collections.Counter(), 0
    with tempfile.TemporaryDirectory() as work:
        trial = Trial(library, list(command), os.path.join(work, "out"))
        code, words = trial.run(0)
        allocations = int(words.split()[-1])
        whole = code, os.path.join(work, "whole")
        os.rename(trial.folder, whole[1])
        step, _, last = stride.partition(":")
        for at in range(1, int(last or allocations) + 1, int(step)):
            ended, words = trial.run(at)
            what = outcome(trial, at, ended, words, whole)
            counted[what or "wrong"] += 1
            if not what:
                wrong += 1
                print(f"allocation {at}: exit code {ended}, left {files_below(trial.folder)}: {words.strip()}")
    print(f"{allocations} allocations: {dict(counted)}")
    return 0 if not wrong and counted["no memory"] + counted["row"] else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
