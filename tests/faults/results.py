"""A folder of results, for the scripts beside this one that break off what writes there."""

import os
import subprocess


def content(folder):
    """Names and bytes of all that is not hidden, in folders within too; None where there is nothing."""
    found = {}
    for path, folders, names in os.walk(folder):
        folders[:] = [name for name in folders if not name.startswith(".")]
        for name in names:
            if not name.startswith("."):
                place = os.path.join(path, name)
                with open(place, "rb") as file:
                    found[os.path.relpath(place, folder)] = file.read()
    return found or None


def left_over(folder):
    """What a set of files that has not ended has left there."""
    return sorted(name for _, _, names in os.walk(folder) for name in names if name.startswith(".hci-"))


def read(program, folder):
    """A command that looks for a table in the folder and in each within, and so ends what was begun there."""
    for path, _, _ in os.walk(folder):
        command = [program, "harmonics", os.path.join(path, "none.csv"), "--quantity", "cogging", "--pole-pairs", "2"]
        subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True)
