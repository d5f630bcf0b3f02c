"""Figures of docs/drive.md that no command on the page makes, by `hci-solve simulate`.

    python3 drive_figures.py HCI_SOLVE SOURCE_DIR

Gains 10 % off: the loop has k_p and k_i of its own, while the compensation knows the response of the nominal ones, at 64
points of the formula (theory.md, section 16, without decoupling and at standstill). Noise: the same with normal errors of
2 % and 2 degrees, three draws. Dead time and quantised readings, the saturated machine C, machine A at 20 kHz, and currents
for the hexagon in a drive that keeps the circle.

A line each, WRONG where it is not what the page says (to the digits there). Nothing but the standard library is needed.
"""
import cmath
import csv
import math
import os
import random
import shutil
import subprocess
import sys
import tempfile

R, L, T = 0.1, 0.5e-3, 1e-4  # of data/drive/machine_a_10kHz.csv
K_P, K_I = 0.2 / T * L, 0.2 / T * R
TARGET_8 = "order,amplitude_Nm,phase_rad\n0,8,0\n"


class Page:
    def __init__(self, program, source, work):
        self.program, self.source, self.work, self.bad = program, source, work, 0

    def run(self, *words):
        done = subprocess.run([self.program, *map(str, words), "--quiet"], cwd=self.source, capture_output=True, text=True, check=False)
        if done.returncode not in (0, 1):
            sys.exit(done.stderr)

    def drive(self, base, changes, more=()):
        """A copy of a drive with other values of some names, and further rows."""
        path = f"{self.work}/drive.csv"
        with open(f"{self.source}/data/drive/{base}") as file, open(path, "w") as out:
            for line in file:
                name = line.split(",")[0]
                out.write(f"{name},{changes[name]},of the test\n" if name in changes else line)
            out.writelines(f"{row},of the test\n" for row in more)
        return path

    def ripple(self, machine, table, drive, speeds):
        """{(speed, remedy): T_ripple in %}"""
        self.run("simulate", machine, "--table", table, "--drive", drive, "--speeds", speeds, "-o", f"{self.work}/speeds")
        with open(f"{self.work}/speeds/speeds.csv") as file:
            return {(float(r["speed_rpm"]), r["remedy"]): float(r["T_ripple_percent"]) for r in csv.DictReader(file)}

    def says(self, what, found, low, high):
        wrong = not low <= found <= high
        self.bad += wrong
        print(f"{'WRONG ' if wrong else ''}{what}: {found:.4g} %, the page has {low:g} to {high:g}", flush=True)


def response(f_Hz):
    z, a = cmath.exp(2j * math.pi * f_Hz * T), math.exp(-R / L * T)
    loop = (K_P + K_I * T / (z - 1)) * (1 - a) / (R * (z - a)) / z
    return loop / (1 + loop)


def write_response(path, points, noise, seed):
    draw, last = random.Random(seed), 0.0
    with open(path, "w") as out:
        out.write("frequency_Hz,gain_d,phase_d_rad,gain_q,phase_q_rad\n")
        for k in range(points):
            f_Hz = 20.0 * 100.0 ** (k / (points - 1))
            gain, phase = cmath.polar(response(f_Hz))
            last = phase - 2.0 * math.pi * math.ceil((phase - last - 0.5) / (2.0 * math.pi))
            cells = [f"{gain * (1 + draw.gauss(0, noise)):.6g},{last + draw.gauss(0, noise * math.pi / 1.8):.6g}" for _ in "dq"]
            out.write(f"{f_Hz:.6g},{','.join(cells)}\n")


def gains(page, a):
    write_response(f"{page.work}/loop.csv", 64, 0.0, 1)
    for factor in (0.9, 1.1):
        rows = ["response,loop.csv,", f"current_kp,{factor * K_P},ohm", f"current_ki,{factor * K_I},V/(A*s)"]
        got = page.ripple("data/machine_a", a, page.drive("machine_a_10kHz.csv", {"decoupling": "none,"}, rows), "100,300,1000")
        for speed, low, high in ((100, 2.15, 2.75), (300, 7.35, 8.85), (1000, 21.5, 23.5)):
            page.says(f"gains × {factor}, compensation at {speed} rpm", got[speed, "compensation"], low, high)
        page.says(f"gains × {factor}, feedforward at 300 rpm", got[300, "feedforward"], 0.235, 0.245)


def noise(page, a):
    drive = page.drive("machine_a_10kHz.csv", {"decoupling": "none,"}, ["response,loop.csv,"])
    for points in (8, 32, 128):
        for seed in (1, 2, 3):
            write_response(f"{page.work}/loop.csv", points, 0.02, seed)
            page.says(f"{points} points with noise, compensation at 100 rpm", page.ripple("data/machine_a", a, drive, "100")[100, "compensation"], 0.45, 3.05)


def dead_time(page, c):
    rows = ["current_quantum,10,mA", "encoder_counts,16384,"]
    for what, more, expected in (("readings", [], 0.12), ("and dead time", ["dead_time,2,us"], 0.23),
                                 ("and its compensation", ["dead_time,2,us", "dead_time_compensation,1,"], 0.13)):
        got = page.ripple("data/machine_c", c, page.drive("machine_c_10kHz.csv", {}, rows + more), "80")
        page.says(f"{what}, feedforward at 80 rpm", got[80, "feedforward"], expected - 0.005, expected + 0.005)


def saturated(page, target):
    folder = f"{page.work}/saturated"
    shutil.copytree(f"{page.source}/data/machine_c_saturated", folder)
    with open(f"{folder}/machine.csv", "a") as out:
        out.write("inductance_d,80,mH,declared\ninductance_q,80,mH,declared\n")
    page.run("solve", folder, "--target", target, "--auto", "-o", f"{page.work}/with")
    got = page.ripple(folder, f"{page.work}/with", "data/drive/machine_c_10kHz.csv", "20,80,320")
    for key, low, high in (((20, "compensation"), 0.0015, 0.0025), ((80, "compensation"), 0.0025, 0.0035), ((80, "table"), 4.25, 4.35),
                           ((320, "compensation"), 0.0545, 0.0555)):
        page.says(f"saturated machine C, {key[1]} at {key[0]} rpm", got[key], low, high)
    shutil.copytree(folder, f"{page.work}/without")
    os.remove(f"{page.work}/without/effects.csv")
    page.run("solve", f"{page.work}/without", "--target", target, "--auto", "-o", f"{page.work}/unsaturated")
    got = page.ripple(folder, f"{page.work}/unsaturated", "data/drive/machine_c_10kHz.csv", "20,80,320")
    for speed in (20, 80, 320):
        page.says(f"solved without saturation, compensation at {speed} rpm", got[speed, "compensation"], 15.5, 17.5)


def faster(page, a):
    drive = page.drive("machine_a_10kHz.csv", {"current_sample_time": "50,us", "computing_delay": "50,us"})
    page.says("machine A at 20 kHz, feedforward at 1500 rpm", page.ripple("data/machine_a", a, drive, "1500")[1500, "feedforward"], 1.605, 1.615)


def circle(page, target):
    drives = {"hexagon": "data/drive/machine_c_10kHz.csv", "circle": page.drive("machine_c_10kHz.csv", {"modulation": "circle,"})}
    for solved, low, high in (("hexagon", 4.05, 4.15), ("circle", 0.115, 0.125)):
        page.run("solve", "data/machine_c", "--target", target, "--drive", drives[solved], "--speed", 600, "-o", f"{page.work}/{solved}")
        got = page.ripple("data/machine_c", f"{page.work}/{solved}", drives["circle"], "600")
        page.says(f"solved for the {solved}, in the circle at 600 rpm", got[600, "feedforward"], low, high)


def main():
    with tempfile.TemporaryDirectory() as work:
        page = Page(os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), work)
        target = f"{work}/target.csv"
        with open(target, "w") as file:
            file.write(TARGET_8)
        page.run("solve", "data/machine_a", "--target", "data/scenarios/02/target.csv", "--auto", "-o", f"{work}/a")
        page.run("solve", "data/machine_c", "--target", target, "--auto", "-o", f"{work}/c")
        gains(page, f"{work}/a")
        noise(page, f"{work}/a")
        faster(page, f"{work}/a")
        dead_time(page, f"{work}/c")
        saturated(page, target)
        circle(page, target)
        print(f"{page.bad} wrong")
        sys.exit(1 if page.bad else 0)


if __name__ == "__main__":
    main()
