"""Times of the Python package beside those of the program: python bench/python_times.py HCI_SOLVE [ROWS]

`predict` of a recording with so many rows (a million) and `solve`: processor time, best of three each, so that what else runs on the
machine does not count. The program starts, reads and computes; the package is loaded already, which takes as long as the last line
says.
"""
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

DATA = Path(__file__).parents[1] / "data"


def processor_s():
    """Of this process and of those that it has waited for."""
    return sum(os.times()[:4])


def best(work, times=3):
    found = []
    for _ in range(times):
        began = processor_s()
        work()
        found.append(processor_s() - began)
    return min(found)


def recording(rows):
    k = np.arange(float(rows))
    columns = {"time_s": 1e-4 * k, "theta_m_rad": 0.01 * k, "iq_A": 5 + np.sin(1e-3 * k), "torque_Nm": 1 + 0.1 * np.cos(0.02 * k)}
    return {name: values.round(9) for name, values in columns.items()}


def main(program, rows=1_000_000):
    began = time.perf_counter()
    import hci

    loaded = time.perf_counter() - began
    machine, target = hci.Machine.read(DATA / "machine_a"), DATA / "scenarios/02/target.csv"
    columns = recording(int(rows))
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "run.csv"
        np.savetxt(file, np.column_stack(list(columns.values())), "%.9g", ",", header=",".join(columns), comments="")

        def run(*words):
            subprocess.run([program, *words, "--quiet"], check=True, capture_output=True)

        table = [
            ("predict, file", lambda: run("predict", DATA / "machine_a", file), lambda: machine.predict(file)),
            ("predict, arrays", None, lambda: machine.predict(columns)),
            ("solve", lambda: run("solve", DATA / "machine_a", "--target", target), lambda: machine.solve(target)),
            ("solve, at most 12", lambda: run("solve", DATA / "machine_a", "--target", target, "--auto", "12"),
             lambda: machine.solve(target, at_most=12)),
        ]
        for name, of_program, of_package in table:
            repeats = 1 if name.startswith("predict") else 20  # the clock ticks in hundredths
            package = best(lambda: [of_package() for _ in range(repeats)]) / repeats
            if of_program is None:
                print(f"{name:18} program            python {package:8.4f} s")
                continue
            alone = best(lambda: [of_program() for _ in range(repeats)]) / repeats
            print(f"{name:18} program {alone:8.4f} s python {package:8.4f} s ratio {package / alone:.3f}")
    print(f"import hci: {loaded:.3f} s, with numpy loaded before")


if __name__ == "__main__":
    main(*sys.argv[1:])
