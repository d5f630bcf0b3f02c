#!/usr/bin/env python3
"""What `hci-solve fleet` says of a line that `motors` made, against truth.csv.

    score.py FLEET_OUT TRUTH... [--require CAUGHT FALSE]   shares: named of the hidden faults, at least; false alarms, at most
"""
import csv
import sys

NAMED = {"magnets": "back_emf", "phase": "phase_imbalance", "pole": "unequal_magnets", "friction": "friction", "offset": "position_offset"}


def main(words):
    required = None
    if "--require" in words:
        at = words.index("--require")
        required = float(words[at + 1]), float(words[at + 2])
        words = words[:at]
    truth = {row["motor"]: row["fault"] for path in words[1:] for row in csv.DictReader(open(path))}
    found = {row["motor"]: row for row in csv.DictReader(open(words[0] + "/deviations.csv"))}
    if truth.keys() != found.keys():
        sys.exit("other motors than in truth.csv")
    sound = [name for name in truth if truth[name] == "none"]
    alarms = [name for name in sound if found[name]["stands_out"] == "yes"]
    print(f"{len(truth)} motors, {len(sound)} sound: {len(alarms)} false alarms, {100 * len(alarms) / len(sound):.2f} %")
    faulty = caught = named = 0
    for kind, effect in NAMED.items():
        names = [name for name in truth if truth[name] == kind]
        out = [name for name in names if found[name]["stands_out"] == "yes"]
        right = [name for name in out if found[name]["effect"] == effect]
        print(f"{kind:9} {len(names):4} hidden, {len(out):4} caught, {len(right):4} named {effect}")
        for name in names:
            if name not in right:
                print("          ", name, found[name]["stands_out"], found[name]["effect"], found[name]["parameter"], found[name]["deviation"])
        faulty += len(names)
        caught += len(out)
        named += len(right)
    print(f"all       {faulty:4} hidden, {100 * caught / faulty:.1f} % caught, {100 * named / faulty:.1f} % caught and named")
    if required and (named < required[0] * faulty or len(alarms) > required[1] * len(sound)):
        sys.exit("not as required")


main(sys.argv[1:])
