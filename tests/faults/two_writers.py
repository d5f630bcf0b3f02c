"""Two commands of hci-solve write into the same folder at the same time, again and again, the second one later by a random time.

    two_writers.py TIMES SEED HCI_SOLVE FOLDER COMMAND [WORD...] -- COMMAND [WORD...]

FOLDER has older results, or is not there. Both commands get -q and -o. Each ends with its own exit code, or with 5 and words where the
other one is writing; the folder then has all files of one that was not refused and nothing else. Prints how often which was; ends with 1 if one was wrong.
"""

import collections
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time

from results import content, left_over


class Pair:
    def __init__(self, program, older, commands, work):
        self.older, self.folder = older, os.path.join(work, "out")
        self.commands = [[program, *words, "-q", "-o", self.folder] for words in commands]

    def begin(self):
        shutil.rmtree(self.folder, ignore_errors=True)
        if os.path.isdir(self.older):
            shutil.copytree(self.older, self.folder)

    def start(self, k):
        return subprocess.Popen(self.commands[k], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)

    def alone(self, k):
        """Exit code, files and seconds."""
        self.begin()
        begun = time.monotonic()
        child = self.start(k)
        child.communicate()
        return child.returncode, content(self.folder), time.monotonic() - begun

    def both(self, seconds):
        """Exit codes and words."""
        self.begin()
        first = self.start(0)
        time.sleep(seconds)
        children = first, self.start(1)
        words = [child.communicate()[1].decode(errors="replace").strip() for child in children]
        return [child.returncode for child in children], words


def main(times, seed, program, older, *words):
    middle = words.index("--")
    counted, wrong, chance = collections.Counter(), 0, random.Random(int(seed))
    with tempfile.TemporaryDirectory() as work:
        pair = Pair(program, older, [words[:middle], words[middle + 1 :]], work)
        code, new, took = zip(*(pair.alone(k) for k in range(2)))
        if not set(code) <= {0, 1} or new[0] == new[1]:
            return f"one after the other: exit codes {code}, the same files: {new[0] == new[1]}"
        for _ in range(int(times)):
            seconds = chance.uniform(0.0, 1.2 * took[0])
            ended, said = pair.both(seconds)
            found = content(pair.folder)
            done = [k for k in range(2) if ended[k] == code[k]]
            refused = [k for k in range(2) if ended[k] == 5 and said[k]]
            counted["both" if len(done) == 2 else "one refused" if done else "none"] += 1
            if len(done) + len(refused) < 2 or not done or found not in [new[k] for k in done] or left_over(pair.folder):
                wrong += 1
                print(f"{seconds:.4f} s apart: exit codes {ended}, {sorted(found or [])}, {left_over(pair.folder)}: {said}")
    print(f"{times} times: {dict(sorted(counted.items()))}, {wrong} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
