"""Recordings from memory: to the bit what the same numbers in a file give."""
import numpy as np
import pytest

import hci

NAMES = ("time_ms", "theta_e_deg", "iq_A", "torque_mNm")


@pytest.fixture(scope="module")
def columns():
    k = np.arange(2000.0)
    return dict(zip(NAMES, (0.1 * k, np.mod(3.7 * k, 360.0), 5 + np.sin(0.01 * k), 1000 + 50 * np.cos(0.2 * k))))


@pytest.fixture(scope="module")
def expected(machine_a, columns, tmp_path_factory):
    file = tmp_path_factory.mktemp("run") / "run.csv"
    rows = [",".join(NAMES)] + [",".join(repr(float(x)) for x in row) for row in zip(*columns.values())]
    file.write_text("\n".join(rows) + "\n")
    return machine_a.predict(file)


def same(found, expected):
    assert np.array_equal(found.torque_model_Nm, expected.torque_model_Nm)
    assert np.array_equal(found.residual_Nm, expected.residual_Nm)
    assert found.summary == expected.summary


def test_a_mapping(machine_a, columns, expected):
    same(machine_a.predict(columns), expected)
    assert expected.rms_residual_Nm > 0.01


def test_the_residual(machine_a, columns, expected):
    assert np.allclose(expected.residual_Nm, 1e-3 * columns["torque_mNm"] - expected.torque_model_Nm, atol=1e-12)
    assert np.sqrt(np.mean(expected.residual_Nm**2)) == pytest.approx(expected.rms_residual_Nm)
    assert np.allclose(np.diff(expected.run.theta_m_rad), np.radians(3.7) / 2)


def test_pandas(machine_a, columns, expected):
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame({**columns, "note": "words"})
    same(machine_a.predict(frame), expected)
    table = expected.to_pandas()
    assert list(table)[-2:] == ["torque_model_Nm", "residual_Nm"] and len(table) == 2000
    start = pandas.Timestamp("2026-01-01")
    dated = frame.assign(time_s=start + pandas.to_timedelta(columns["time_ms"], unit="ms")).drop(columns="time_ms")
    assert np.allclose(machine_a.predict(dated).torque_model_Nm, expected.torque_model_Nm, atol=1e-9)


def test_rows_of_names_in_pandas(machine_a, columns, expected):
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(dict(zip((("time", "ms"), ("theta_e", "deg"), ("iq", "A"), ("torque", "mNm")), columns.values())))
    assert list(hci.Recording(frame).columns) == ["time (ms)", "theta_e (deg)", "iq (A)", "torque (mNm)"]
    same(machine_a.predict(frame), expected)
    single = hci.Recording({("count", "-"): [1.0], ("Unnamed: 3_level_0", "A"): [1.0], ("iq", "Unnamed: 4_level_1"): [1.0]})
    assert list(single.columns) == ["count", "(A)", "iq"]
    twice = pandas.DataFrame([[1.0, 2.0]], columns=["iq_A", "iq_A"])
    with pytest.raises(ValueError, match="column 'iq_A': found twice"):
        hci.Recording(twice)


def test_polars(machine_a, columns, expected):
    polars = pytest.importorskip("polars")
    same(machine_a.predict(polars.DataFrame(columns)), expected)


def test_named_fields_and_other_types(machine_a, columns, expected):
    array = np.empty(2000, [(name, "f8") for name in NAMES])
    for name in NAMES:
        array[name] = columns[name]
    same(machine_a.predict(array), expected)
    whole = {name: values[:, None].repeat(2, 1)[:, 0] for name, values in columns.items()}  # with strides
    same(machine_a.predict(whole), expected)
    integers = {"theta_e_deg": np.arange(0, 360, 3), "iq_A": np.full(120, 2, np.int16), "torque_Nm": [1.0] * 120}
    assert len(machine_a.predict(integers).run) == 120


def test_mat_files(machine_a, columns, expected, tmp_path):
    scipy_io = pytest.importorskip("scipy.io")
    scipy_io.savemat(tmp_path / "run.mat", {**columns, "sample_rate": 1e4, "comment": "words"})
    same(machine_a.predict(hci.Recording.from_mat(tmp_path / "run.mat")), expected)
    scipy_io.savemat(tmp_path / "struct.mat", {"log": {"data": columns}})
    same(machine_a.predict(hci.Recording.from_mat(tmp_path / "struct.mat", variables=NAMES)), expected)
    with pytest.raises(ValueError, match="found no variable"):
        hci.Recording.from_mat(tmp_path / "run.mat", variables=["speed"])


def test_no_copy_of_contiguous_doubles(columns):
    recording = hci.Recording(columns)
    assert all(np.shares_memory(recording.columns[name], columns[name]) for name in NAMES)


def test_holes_and_names(machine_a, columns, expected):
    torn = {name: values.copy() for name, values in columns.items()}
    torn["torque_mNm"][7] = np.nan
    assert len(machine_a.predict(torn).run) == 1999
    with pytest.raises(hci.InputError):
        machine_a.predict(torn, strict=True)
    named = dict(zip(("t", "angle", "ch3", "ch4"), columns.values()))
    said = {"time_ms": "t", "theta_e_deg": "angle", "iq_A": "ch3", "torque_mNm": "ch4"}
    assert np.array_equal(machine_a.predict(named, columns=said).torque_model_Nm, expected.torque_model_Nm)


def test_cogging_from_a_simulated_recording(machine_a, data):
    driven = machine_a.simulate(data / "drive/driven.csv")
    found = machine_a.harmonics(driven.trajectory.to_pandas() if pytest.importorskip("pandas") else None, "cogging")
    size = {row["order"]: row["amplitude"] for row in found.kept}
    assert size[24.0] == pytest.approx(0.3702, abs=2e-4)
    assert set(found.kept["order"]) <= {6.0, 12.0, 18.0, 24.0, 30.0, 36.0}


def test_check_finds_a_slip(machine_a, data, tmp_path):
    driven = machine_a.simulate(data / "drive/imposed.csv").trajectory
    good = {name: driven[name].copy() for name in ("time_s", "theta_m_rad", "ia_A", "ib_A", "ic_A", "torque_Nm")}
    assert machine_a.check(good).consistent
    good["ia_A"], good["ib_A"] = good["ib_A"], good["ia_A"]
    check = machine_a.check(hci.Recording(good, "swapped"))
    assert not check.consistent and check.slips and check.slips[0].file == "swapped"
