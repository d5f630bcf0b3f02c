"""Time of `solve` within limits beside that of clarabel (PyPI): python bench/limits_times.py HCI_SOLVE [PEAK_A...]

Machine A, scenario 2, 43 components up to order 127. Processor time, so that what else runs on the machine does not count. Of the
program, best of three, all of it: start, reading, the free solution, mean torque, ripple and copper within the limit, writing. Of
clarabel the same three wishes, to what the program has reached, on rows that numpy makes and beyond whose angles peaks are looked for
in the same way (tests/rigs/limits/clarabel_check.py), from the peaks of the program's currents on, once; its own iterations alone are a column by themselves, and what the ratio is
to. The rows are dense, which clarabel is not made for. With 21 A 0.09 s by 4 s.
"""
import os
import sys
import tempfile
from pathlib import Path

TOP = Path(__file__).parents[1]
sys.path[:0] = [str(TOP / "bench"), str(TOP / "tests/rigs/limits")]

import clarabel_check as check  # noqa: E402
from python_times import processor_s  # noqa: E402

ORDERS = [1] + [n + s for n in range(6, 132, 6) for s in (-1, 1)]
COMPONENTS = [(float(n), 1 if n % 3 == 1 else -1) for n in ORDERS[:43]]


def program_s(program, folder, peak_A):
    """Of the program, its currents, and the ripple that it says is the smallest."""
    began = processor_s()
    rows, summary = check.run(program, folder, ["--target", f"{TOP}/data/scenarios/02/target.csv", "--harmonics", f"{folder}/h.csv",
                                  "--minimise", "worst", "--limit-current", repr(peak_A)], f"{folder}/out")
    return processor_s() - began, rows, summary["limits"]["minimised_Nm"]


def peer_s(task, x, smallest_Nm):
    """Of clarabel with its rows, and of its iterations alone."""
    inside = []
    conic = check.conic

    def timed(*words):
        began = processor_s()
        answer = conic(*words)
        inside.append(processor_s() - began)
        return answer

    check.conic = timed
    began = processor_s()
    check.solve(task, "mean", near=x, known=abs(task.mean(x) - task.mean_h))
    check.solve(task, "ripple", task.mean(x), near=x, known=smallest_Nm)
    nearest = check.proof_of_copper(task, x, task.mean(x), task.worst(x))[2]
    check.solve(task, "copper", task.mean(x), task.worst(x), nearest, 1.5 * float(x @ x))
    check.conic = conic
    return processor_s() - began, sum(inside)


def main(program, *peaks):
    machine = check.machine_a(str(TOP))
    target = [tuple(float(v) for v in row) for row in check.read_csv(f"{TOP}/data/scenarios/02/target.csv")]
    print("peak, A  program, s  clarabel, s  its iterations, s  program/clarabel")
    for peak_A in [float(p) for p in peaks] or [21.0, 17.0]:
        with tempfile.TemporaryDirectory() as folder:
            machine.write(f"{folder}/m")
            with open(f"{folder}/m/h.csv", "w") as out:
                out.write("order,set\n" + "".join(f"{n:g},{'pos' if s > 0 else 'neg'}\n" for n, s in COMPONENTS))
            ours = []
            for _ in range(3):
                time_s, rows, smallest_Nm = program_s(os.path.abspath(program), f"{folder}/m", peak_A)
                ours.append(time_s)
            task = check.Task(machine, COMPONENTS, target, peak_A * (1 - check.TIGHTER), None, 0.0)
            x = check.coordinates(COMPONENTS, rows)
            theirs = peer_s(task, x, smallest_Nm)
            print(f"{peak_A:7g}  {min(ours):10.2f}  {theirs[0]:11.2f}  {theirs[1]:17.2f}  {min(ours) / theirs[1]:16.2g}", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
