#!/usr/bin/env python3
"""The map of one target through a second implementation of its drive.

    check.py HCI_SOLVE SOURCE_DIR WORK TARGET

For an encoder as it is, turned, and turned the other way round: the ripple that `emit --for` states is that of the
drive on the machine; what `harmonics` reads back is what stands in the file; a wrong direction would be seen."""
import cmath
import importlib
import json
import math
import os
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from plant import Mounted, Plant  # noqa: E402

solve, source, work, target = sys.argv[1:]
MACHINE = work + "/machine"
PLACES = [(0.0, 1), (37.3, 1), (-101.7, -1)]
failures = 0


def expect(right, what):
    global failures
    if not right:
        failures += 1
        print("FAILED: %s: %s" % (target, what))


def run(*words):
    done = subprocess.run([solve, *words], capture_output=True, text=True, cwd=source)
    if done.returncode:
        sys.exit("%s: %s: %s" % (target, " ".join(words), done.stderr))
    return done.stdout


def make_machine():
    """Machine A and an order 1, by which a shift of any part of an electrical turn is seen."""
    if os.path.exists(MACHINE):
        return
    shutil.copytree(source + "/data/machine_a", MACHINE)
    with open(MACHINE + "/cogging.csv", "a", encoding="utf-8") as file:
        file.write("1,0.05,0.7\n")


def solution(name):
    """Currents for no mean torque and for that of a scenario."""
    folder = work + "/" + name
    if not os.path.exists(folder):
        wanted = work + "/none.csv"
        with open(wanted, "w", encoding="utf-8") as file:
            file.write("order,amplitude_Nm,phase_rad\n0,0,0\n")
        run("solve", MACHINE, "--target", wanted if name == "none" else "data/scenarios/02/target.csv", "--auto", "-q", "-o", folder)
    return folder


def near(a, b, share, floor=0.0):
    return abs(a - b) <= share * max(abs(a), abs(b)) + floor


def check_ripple(plant, drive, place, summary, name):
    for stated in summary["ripple"]:
        mounted = Mounted(plant, drive, *place)
        found = mounted.ripple(stated["torque_Nm"], constant=summary["torque_constant_Nm_per_A"])
        expect(near(found, stated["map_peak_to_peak_Nm"], 0.002),
               "%s, encoder %s, %g N·m: stated %g N·m, found %g" % (name, place, stated["torque_Nm"], stated["map_peak_to_peak_Nm"], found))
        wrong = Mounted(plant, drive, place[0], -place[1])
        if summary["torque_Nm"] == stated["torque_Nm"]:
            expect(found < 0.35 * stated["sine_peak_to_peak_Nm"], "%s, encoder %s: it leaves %g N·m" % (name, place, found))
            expect(wrong.ripple(stated["torque_Nm"], 997, summary["torque_constant_Nm_per_A"]) > 3 * found, "%s: the wrong direction is not seen" % name)


def check_limit(plant, drive_type):
    """A torque that the drive makes with currents which it cuts, found by halving, and one that it cannot make."""
    for counts in (1700, 2500):
        base = work + "/limited"
        words = ["emit", solution("loaded"), "--for", target, "--machine", MACHINE, "--name", "limited", "-o", work, "--counts-per-ampere", str(counts), "--json"]
        stated = json.loads(run(*words))["ripple"][1]
        drive = drive_type(base)
        drive.counts = counts
        mounted = Mounted(plant, drive)
        low, high = 0.0, 40.0
        for _ in range(18):
            values = mounted.torques((low + high) / 2, 1999)
            mean = sum(values) / len(values)
            low, high = ((low + high) / 2, high) if mean < stated["torque_Nm"] else (low, (low + high) / 2)
        expect(near(mean, stated["map_mean_Nm"], 0.002) and near(max(values) - min(values), stated["map_peak_to_peak_Nm"], 0.005),
               "%d counts: found %g N·m with a mean of %g, stated %s" % (counts, max(values) - min(values), mean, stated))


def order_of(values, order):
    """amplitude·e^(i phase) of a sine of this order in equal steps of a turn."""
    return 2j * sum(v * cmath.exp(-2j * math.pi * order * k / len(values)) for k, v in enumerate(values)) / len(values)


def check_reading(plant, drive, place, path):
    """Cogging torque from the file by `harmonics`, against that of the drive's own values at standstill."""
    K, steps = getattr(drive, "torque_constant", plant.torque_constant), 30011
    electrical = drive.electrical
    values = []
    for k in range(steps):
        angle = 2 * math.pi * k / steps
        turn = (drive.zero_deg + place[0]) / 360 + place[1] * angle / (2 * math.pi)
        values.append(-place[1] * K * drive.add(turn - math.floor(turn), 0.0)[1])
    out = json.loads(run("harmonics", path, "--quantity", "cogging", "--pole-pairs", str(plant.pole_pairs), "--orders", "1,12,24,36",
                         "--torque-constant", repr(K), "--json"))
    for row in out["orders"]:
        order = row["order"] * (1 if electrical else plant.pole_pairs)
        there = order_of(values, round(order))
        read = cmath.rect(row["amplitude"], row["phase_rad"])
        expect(abs(read - there) < 0.002 * abs(there) + K * drive.step(), "encoder %s, order %g: read %s, in the file %s" % (place, row["order"], read, there))


def main():
    make_machine()
    plant = Plant(MACHINE)
    module = importlib.import_module({"csv": "csv_table"}.get(target, target.replace("-", "_")))
    for name in ("none", "loaded"):
        for k, place in enumerate(PLACES):
            base = "%s/%s_%s_%d" % (work, module.__name__, name, k)
            words = ["emit", solution(name), "--for", target, "--machine", MACHINE, "--name", os.path.basename(base), "-o", work,
                     "--encoder-offset", repr(place[0]), "--encoder-direction", str(place[1]), "--json", *module.Drive.emit]
            if name == "loaded":
                words += getattr(module.Drive, "emit_loaded", [])
            summary = json.loads(run(*words))
            drive = module.Drive(base)
            check_ripple(plant, drive, place, summary, name)
            if hasattr(drive, "compiled") and k == 2:
                off = drive.compiled()
                expect(off is None or off <= 1, "%s: the compiled function is another one: %s" % (name, off))
            if name == "none":
                check_reading(plant, drive, place, base + ("" if module.Drive.file.startswith("_") else ".") + module.Drive.file)
    if target == "openffboard":
        check_limit(plant, module.Drive)
    for name in summary["files"].split(", "):
        with open(work + "/" + name, encoding="utf-8") as file:
            head = file.read(200)
        if head.startswith("#!"):
            script(work + "/" + name, ["sh"] if "/bin/sh" in head else [sys.executable, "-B"])


def script(path, by):
    """Without --store nothing is sent: it ends well where no library of the drive is there, and says so."""
    done = subprocess.run([*by, path], capture_output=True, text=True, env={"PATH": os.environ["PATH"]})
    expect(done.returncode == 0 and "nothing was sent" in done.stdout, "%s without --store: %s" % (path, done.stderr or done.stdout[-200:]))
    done = subprocess.run([*by, path, "--store"], capture_output=True, text=True, env={"PATH": os.environ["PATH"]})
    expect("nothing was sent" not in done.stdout, "%s --store does nothing" % path)
    expect("Traceback" not in done.stderr, "%s --store without its package: %s" % (path, done.stderr))
    done = subprocess.run([*by, path, "--help"], capture_output=True, text=True, env={"PATH": os.environ["PATH"]})
    expect(done.returncode == 0 and "--store" in done.stdout and "nothing was sent" not in done.stdout, "%s --help: %s" % (path, done.stdout))


main()
sys.exit(failures > 0)
