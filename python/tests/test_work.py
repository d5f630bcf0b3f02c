"""Long work: progress, stopping, Ctrl-C, and other threads that go on."""
import copy
import os
import pickle
import signal
import threading
import time

import numpy as np
import pytest

import hci

LONG = {"duration": 1000.0, "prescribed_speed": 100.0, "torque_reference": 2.0, "step": 1e-5, "trajectory_every": 1e6}


def test_progress(machine_c):
    seen = []
    machine_c.simulate({**LONG, "duration": 5.0}, progress=lambda what, share: seen.append((what, share)))
    shares = [share for _, share in seen]
    assert seen[0][0] == "simulating" and shares == sorted(shares) and 0.0 <= shares[0] <= shares[-1] <= 1.0


def test_a_progress_function_stops(machine_c):
    with pytest.raises(hci.StoppedError, match="was stopped at"):
        machine_c.simulate(LONG, progress=lambda what, share: True)


def test_what_a_progress_function_raises_is_raised(machine_c):
    def progress(what, share):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        machine_c.simulate(LONG, progress=progress)


@pytest.mark.parametrize("work", ["simulate", "solve"])
def test_ctrl_c(machine_a, machine_c, work):
    timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
    started = time.monotonic()
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        if work == "simulate":
            machine_c.simulate(LONG)
        else:
            while True:
                machine_a.solve({0: 2.4, 6: 0.3}, at_most=24)
    assert time.monotonic() - started < 5.0
    timer.join()


def test_other_threads_go_on(machine_c):
    """While the library works, a thread of Python counts; with the lock held it would not begin."""
    counted, stop = [0], threading.Event()

    def count():
        while not stop.is_set():
            counted[0] += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    before = counted[0]
    machine_c.simulate({**LONG, "duration": 5.0})
    during = counted[0] - before
    stop.set()
    thread.join()
    assert during > 20


def test_two_threads(machine_a):
    found = [None, None]

    def solve(k):
        found[k] = machine_a.solve(1.0 + k).currents.copy()

    threads = [threading.Thread(target=solve, args=(k,)) for k in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert np.array_equal(found[1], machine_a.solve(2.0).currents)
    other = pickle.loads(pickle.dumps(machine_a))  # for processes in place of threads
    assert np.array_equal(found[1], other.solve(2.0).currents) and copy.deepcopy(machine_a) is machine_a


def test_tqdm_fits(machine_c):
    tqdm = pytest.importorskip("tqdm")
    with tqdm.tqdm(total=1, disable=False, file=open(os.devnull, "w")) as bar:
        machine_c.simulate({**LONG, "duration": 2.0}, progress=bar)
        assert bar.n == pytest.approx(1.0)


def test_diagnose_ends_with_what_it_has(data):
    machine = hci.Machine.read(data / "fem_c/machine")
    timer = threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT))
    started = time.monotonic()
    timer.start()
    found = machine.diagnose(data / "fem_c/runs.csv")
    assert found.summary["search"] == "interrupted" and not found.complete
    assert time.monotonic() - started < 15.0
    timer.join()
    stopped = machine.diagnose(data / "fem_c/runs.csv", progress=lambda what, share: True)
    assert stopped.summary["search"] == "interrupted"
