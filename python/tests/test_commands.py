"""What is the work of whole commands, and what goes with them: the same as the program gives."""
import json
import os
import signal
import subprocess
import threading
import time
import zipfile

import numpy as np
import pytest

import hci

DRIVE = "drive/machine_a_10kHz.csv"


@pytest.fixture(scope="module")
def record(machine_a):
    def make(torque, speed, name):
        rows = machine_a.simulate({"duration": 0.1, "prescribed_speed": (speed, "rpm"), "torque_reference": torque,
                                   "torque_noise": 0.01, "seed": speed, "strategy": "id0", "trajectory_every": 16}).trajectory
        names = ("time_s", "theta_m_rad", "speed_rad_per_s", "ia_A", "ib_A", "ic_A", "torque_Nm")
        return hci.Recording({column: rows[column] for column in names}, name)

    return make


def said(program, *words):
    done = subprocess.run([program, *map(str, words), "--json", "--quiet"], capture_output=True, text=True)
    assert done.returncode in (0, 1), done.stderr
    return json.loads(done.stdout)


def test_fit(machine_a, data, record, program, tmp_path):
    runs = [record(1.0, 600, "slow"), record(-2.0, 900, "fast")]
    found = machine_a.fit(runs)
    for one in runs:
        one.write(tmp_path / f"{one.name}.csv")
    (tmp_path / "runs.csv").write_text("file,role\nslow.csv,fit\nfast.csv,fit\n")
    assert found.summary == said(program, "fit", data / "machine_a", "--runs", tmp_path / "runs.csv")
    assert machine_a.fit(tmp_path / "runs.csv").summary == found.summary
    assert found.found and {row.effect for row in found.parameters} >= {"back_emf", "friction"}
    (tmp_path / "limits.csv").write_text("effect,parameter,low,high\nback_emf,common,-0.5,0.5\n")
    assert found.passed is None and machine_a.fit(runs, limits=tmp_path / "limits.csv").passed is True
    (tmp_path / "limits.csv").write_text("effect,parameter,low,high\nback_emf,common,0.4,0.5\n")
    assert machine_a.fit(runs, limits=tmp_path / "limits.csv").passed is False
    found.write(tmp_path / "fit")
    assert (tmp_path / "fit/parameters.csv").exists() and found.plot().axes


def test_solve_for_a_drive(machine_a, data, smooth, program, tmp_path):
    target = data / "scenarios/02/target.csv"
    solution = machine_a.solve(target, drive=data / DRIVE, speed_rpm=6000)
    assert solution.summary == said(program, "solve", data / "machine_a", "--target", target, "--auto", "--drive", data / DRIVE,
                                    "--speed", 6000)
    assert len(solution.currents) < len(smooth.currents) and "orders up to 20 in the rotor frame" in solution.remark
    with pytest.raises(hci.ArgumentError, match="drive: .*give speed_rpm, not 0"):
        machine_a.solve(1.0, drive=data / DRIVE)
    with pytest.raises(hci.InputError, match="leaves no harmonic to choose"):
        machine_a.solve(1.0, drive=data / DRIVE, speed_rpm=1e5)
    followed = machine_a.follow(smooth, data / DRIVE, [300, 600])
    table = followed.to_pandas() if pytest.importorskip("pandas") else None
    assert set(table["speed_rpm"]) == {300, 600} and followed.verdict.startswith("300 rpm: ripple 0.24")


def test_emit_for_drives(data, smooth, program, tmp_path):
    smooth.write(tmp_path / "solution")
    machine = ["--machine", data / "machine_a", "-o", tmp_path / "program"]
    loop = smooth.emit_for_drive(tmp_path / "python", "loop", data / DRIVE, blob=True, up_to_rpm=600)
    assert loop.summary == said(program, "emit", tmp_path / "solution", "--name", "loop", "--drive", data / DRIVE, "--blob", "--speed", 600,
                                *machine)
    map_of = smooth.emit_for("simplefoc", tmp_path / "python", "map", per_torque=True, encoder_direction=-1)
    assert map_of.summary == said(program, "emit", tmp_path / "solution", "--name", "map", "--for", "simplefoc", "--per-torque",
                                  "--encoder-direction", "-1", *machine)
    for file in loop.files + map_of.files:
        assert (tmp_path / "python" / file).read_bytes() == (tmp_path / "program" / file).read_bytes(), file
    with pytest.raises(ValueError, match="target: found 'vesc', expected one of simplefoc"):
        smooth.emit_for("vesc", tmp_path, "map")


def test_diagnose_again(machine_a, record, tmp_path):
    before = [record(1.0, 600, "a"), record(2.0, 700, "b"), record(-1.0, 600, "c")]
    machine_a.diagnose(before).write(tmp_path / "first")
    found = hci.diagnose_again(tmp_path / "first", [record(1.5, 800, "d")], before=before)
    assert found.verdict.startswith("On 1 new recording the machine of last time was off by 0.0")
    assert found.summary["again"]
    with pytest.raises(hci.ArgumentError, match="give them as before"):
        hci.diagnose_again(tmp_path / "first", [record(1.5, 800, "d")])


def test_tune(machine_a, data, tmp_path):
    driven = machine_a.simulate(data / "drive/driven.csv").trajectory
    log = {name: driven[name] for name in ("time_s", "theta_m_rad", "speed_rad_per_s", "torque_Nm")}
    tuned = hci.tune(log, folder=tmp_path / "tuned", pole_pairs=2, kv=39)
    assert tuned.done and tuned.machine.effects == ["cogging"]
    assert tuned.verdict.startswith("tuned: A ripple of 1.35 N·m") and tuned.summary["command"] == "tune"
    assert np.ptp(tuned.table("currents/waveform.csv")["torque_Nm"]) < 1e-3 and len(tuned.plot().axes) == 2
    with pytest.raises(hci.ArgumentError, match="did you mean `--pole-pairs`") as caught:
        hci.tune(log, folder=tmp_path / "no", pole_pears=2)
    assert caught.value.file is None
    with pytest.raises(hci.InputError) as caught:
        hci.tune(tmp_path / "none.csv", folder=tmp_path / "no", pole_pairs=2, kv=39)
    assert caught.value.file == str(tmp_path / "none.csv") and not (tmp_path / "no").exists()


def test_batch_and_fleet(data, tmp_path):
    runs = data.resolve() / "fem_c"
    rows = [f"m{k},{runs}/machine,{runs}/runs.csv" for k in range(4)]
    (tmp_path / "motors.csv").write_text("\n".join(["motor,machine,runs", *rows, f"bad,none,{runs}/runs.csv"]) + "\n")
    batch = hci.batch(tmp_path / "motors.csv", "fit", tmp_path / "batch", jobs=2)
    table = batch.table("fleet.csv")
    assert not batch.done and list(table["state"]) == ["done"] * 4 + ["failed"] and batch.summary["failed"] == 1
    assert np.ptp(table["rms_after_Nm"][:4]) == 0.0 and batch.plot().axes
    line = batch.fleet(tmp_path / "line")
    assert line.stands_out == [] and line.plot().axes and (tmp_path / "line/report.html").exists()


def test_ctrl_c_ends_the_program_too(data, tmp_path):
    """A motor whose target is never told; what was done before stays, and the same call goes on."""
    os.mkfifo(tmp_path / "pipe.csv")
    machine, target = data.resolve() / "machine_a", data.resolve() / "scenarios/02/target.csv"
    (tmp_path / "motors.csv").write_text(f"motor,machine,target\ngood,{machine},{target}\nhangs,{machine},pipe.csv\n")

    def when_one_is_done():
        while not (tmp_path / "batch/motors/good").exists():
            time.sleep(0.01)
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=when_one_is_done)
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        hci.batch(tmp_path / "motors.csv", "solve", tmp_path / "batch", jobs=2, auto=True)
    thread.join()
    late = hci.batch(tmp_path / "motors.csv", "solve", tmp_path / "batch", jobs=2, time_limit_s=0.3, auto=True)
    assert list(late.table("fleet.csv")["state"]) == ["done", "late"]


def test_sweep_and_fmu(machine_a, data, smooth, tmp_path):
    swept = machine_a.sweep(tmp_path / "sweep", map=True, torques=[1, 2], speeds=[0], limit_current=20)
    points = swept.table("map.csv")
    assert sorted(zip(points["torque_Nm"], points["speed_rpm"])) == [(1, 0), (2, 0)] and swept.plot().axes
    made = machine_a.export_fmu(tmp_path / "controller.fmu", table=smooth, drive=data / DRIVE, fmi=3, sources_only=True)
    assert made["fmi_version"] == 3 and made["binary_bytes"] == 0
    names = zipfile.ZipFile(tmp_path / "controller.fmu").namelist()
    assert {"modelDescription.xml", "sources/torque_table.c"} <= set(names)
