"""Runs a command of hci-solve that replaces a folder of results on disks that are too small, by bytes or by files.

    full_disk.py HCI_SOLVE FOLDER COMMAND [WORD...]

FOLDER has older results. The command gets -q and -o; the disk is a file system in memory, which takes the right to mount one (root, or
`unshare --map-root-user --mount`), from one that has hardly room for the older results to one that has room for both. Each time the
folder has to hold the newer files with exit code 0 or 1, or the older ones with exit code 5 and words, and nothing else. Prints how often
which was; ends with 1 if one was wrong, or if no disk was too small or none large enough.
"""

import collections
import os
import shutil
import subprocess
import sys
import tempfile

from results import content, left_over

PAGE = 4096  # of which such a file system counts its bytes
SIZES = 40


def kib_of(files):
    return sum((len(text) + PAGE - 1) // PAGE * PAGE for text in files.values()) // 1024


def disks(old, new):
    """Options of mount."""
    least, most = kib_of(old) + 4, kib_of(old) + kib_of(new) + 64
    step = max(4, (most - least) // SIZES // 4 * 4)
    folders = 2 + len({os.path.dirname(name) for name in old})
    by_files = range(len(old) + folders, len(old) + len(new) + 2 * folders + 8)
    return [f"size={k}k" for k in range(least, most, step)] + [f"nr_inodes={k}" for k in by_files]


def attempt(disk, command, older, options):
    """Exit code, words, the files that are there and what is left over; None where the older results do not fit."""
    subprocess.run(["mount", "-t", "tmpfs", "-o", options, "tmpfs", disk], check=True)
    try:
        folder = os.path.join(disk, "out")
        try:
            shutil.copytree(older, folder)
        except (shutil.Error, OSError):
            return None
        ended = subprocess.run(command + ["-q", "-o", folder], stdin=subprocess.DEVNULL, capture_output=True)
        return ended.returncode, ended.stderr.decode(errors="replace").strip(), content(folder), left_over(folder)
    finally:
        subprocess.run(["umount", disk], check=True)


def main(program, older, *words):
    counted, wrong = collections.Counter(), 0
    with tempfile.TemporaryDirectory() as work:
        disk = os.path.join(work, "disk")
        os.mkdir(disk)
        old, new = content(older), attempt(disk, [program, *words], older, "size=1g")[2]  # files may name their folder
        for options in disks(old, new):
            result = attempt(disk, [program, *words], older, options)
            if result is None:
                continue
            code, said, found, left = result
            what = "older" if found == old else "newer" if found == new else "neither"
            is_right = code in (0, 1) if what == "newer" else what == "older" and code == 5 and said
            counted[what if is_right and not left else "wrong"] += 1
            if not is_right or left:
                wrong += 1
                print(f"{options}: exit code {code}, the folder holds {what}, left over {left}: {said}")
    print(f"{words[0]} on {sum(counted.values())} disks: {dict(sorted(counted.items()))}")
    return 0 if not wrong and old != new and counted["older"] and counted["newer"] else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
