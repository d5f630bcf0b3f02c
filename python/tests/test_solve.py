"""Currents: against the torque formula written out in numpy, and against the program."""
import csv
import gc
import json
import subprocess

import numpy as np
import pytest

import hci


def table(path):
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines, quoting=csv.QUOTE_NONE))


def torque_of(folder, waveform):
    """e·i + T_cog from the tables of machine A: volts at 50 Hz, 2 pole pairs."""
    theta, torque = waveform["theta_e_rad"], 0.0
    emf, cogging = table(folder / "back_emf.csv"), table(folder / "cogging.csv")
    for row in emf:
        for k, phase in enumerate("abc"):
            wave = np.sin(float(row["order"]) * (theta - 2 * np.pi * k / 3) + float(row["phase_rad"]))
            torque = torque + float(row["amplitude_V"]) / (2 * np.pi * 50 / 2) * wave * waveform[f"i{phase}_A"]
    for row in cogging:
        torque = torque + float(row["amplitude_Nm"]) * np.sin(float(row["order"]) * theta + float(row["phase_rad"]))
    return torque


def test_the_torque_is_smooth(data, smooth):
    torque = torque_of(data / "machine_a", smooth.waveform)
    assert smooth.reached
    assert np.ptp(torque) < 1e-9
    assert np.allclose(torque, 2.462900341, atol=1e-9)
    assert np.allclose(smooth.waveform["torque_Nm"], torque, atol=1e-9)


def test_before_is_a_plain_sine(data, smooth):
    wave = smooth.waveform
    theta = wave["theta_e_rad"]
    plain = {f"i{phase}_A": np.max(wave["ia_plain_A"]) * np.sin(theta - 2 * np.pi * k / 3) for k, phase in enumerate("abc")}
    torque = torque_of(data / "machine_a", {"theta_e_rad": theta, **plain})
    assert np.allclose(wave["torque_before_Nm"], torque, atol=1e-3)


def test_arrays_are_views_that_live_on(machine_a):
    solution = machine_a.solve(2.0)
    currents, orders, values = solution.currents, solution.orders, solution.waveform.values
    assert not currents.flags.owndata and not currents.flags.writeable
    assert np.shares_memory(solution.currents, currents)
    kept = currents.copy(), orders.copy(), values.copy()
    del solution
    gc.collect()
    again = [machine_a.solve(1.0) for _ in range(3)]  # takes memory that would be free
    assert all(np.array_equal(a, b) for a, b in zip(kept, (currents, orders, values)))
    del again


def test_currents_are_linear_in_the_torque(smooth):
    per, rest = smooth.currents_per_Nm, smooth.currents_constant
    assert np.allclose(smooth.currents["sine"], 2.462900341 * per["sine"] + rest["sine"], atol=1e-12)


def test_tables_from_numbers(machine_a):
    ripple = machine_a.solve({0: 2.4, 6: (0.5, 0.3), 12: (0.1, 0.0, 0.0)}, harmonics=[(1, "pos"), (5, "neg"), (7, "pos")])
    at = {order["order"]: order for order in ripple.orders["torque_Nm"]}
    assert at[6]["sine"] == pytest.approx(0.5 * np.cos(0.3), abs=1e-6)
    assert at[6]["cosine"] == pytest.approx(0.5 * np.sin(0.3), abs=1e-6)
    assert set(ripple.currents["order"]) <= {1.0, 5.0, 7.0}
    assert not ripple.reached  # orders 18 and more are left


def test_limits(machine_a):
    free = machine_a.solve(2.0)
    limited = machine_a.solve(2.0, limit_current_A=0.9 * free.peak_current_A)
    assert limited.peak_current_A <= 0.9 * free.peak_current_A * (1 + 1e-9)
    one_phase = machine_a.solve(1.0, limit_current_A={"a": 0.0})
    assert np.max(np.abs(one_phase.waveform["ia_A"])) < 1e-9


def test_pointwise(machine_c):
    solution = machine_c.pointwise(4.0, strategy="mtpa")
    assert np.ptp(solution.waveform["torque_Nm"]) < 1e-5
    assert solution.summary["system"]["method"] == "pointwise"


def test_tables(smooth):
    pandas = pytest.importorskip("pandas")
    frame = smooth.to_pandas()
    assert isinstance(frame, pandas.DataFrame) and len(frame) == len(smooth.waveform)
    assert list(smooth.spectrum()["verdict"].unique()) == ["reached"]


def test_the_program_says_the_same(data, smooth, program, tmp_path):
    arguments = [program, "solve", data / "machine_a", "--target", data / "scenarios/02/target.csv", "--json", "--quiet",
                 "-o", tmp_path / "program"]
    said = json.loads(subprocess.run(arguments, check=True, capture_output=True, text=True).stdout)
    said.pop("checksums", None)  # of the files that it has written
    assert said == smooth.summary
    smooth.write(tmp_path / "python")
    for file in sorted((tmp_path / "program").iterdir()):
        assert file.read_bytes() == (tmp_path / "python" / file.name).read_bytes(), file.name


def test_the_program_emits_the_same(data, smooth, program, tmp_path):
    smooth.write(tmp_path / "solution")
    for more, arguments in (({}, []), ({"format": "i16", "frame": "dq"}, ["--format", "i16", "--frame", "dq"]),
                            ({"per_torque": True, "blob": True}, ["--per-torque", "--blob"])):
        emitted = smooth.emit(tmp_path / "python", "smooth", **more)
        subprocess.run([program, "emit", tmp_path / "solution", "--name", "smooth", "--machine", data / "machine_a",
                        "-o", tmp_path / "program", *arguments], check=True, capture_output=True)
        for file in emitted.files:
            assert (tmp_path / "python" / file).read_bytes() == (tmp_path / "program" / file).read_bytes(), file


def test_a_machine_from_a_data_sheet(tmp_path):
    sheet = {"pole_pairs": 7, "strength": 400.0, "reading": "kv_line_rms", "slots": 12, "resistance_ohm": 0.1}
    machine = hci.Machine.from_datasheet(**sheet)
    k_e = np.sqrt(2.0 / 3.0) / (400.0 * np.pi / 30.0)
    assert np.hypot(machine.back_emf["sine"], machine.back_emf["cosine"])[0] == pytest.approx(k_e)
    assert machine.solve(0.1).mean_torque_Nm == pytest.approx(0.1)
    kept = hci.Machine.from_datasheet(**sheet, folder=tmp_path / "motor")
    assert (tmp_path / "motor/machine.csv").exists() and kept.values["resistance_ohm"] == 0.1
    with pytest.raises(hci.OutputError):
        hci.Machine.from_datasheet(**sheet, folder=tmp_path / "motor")
