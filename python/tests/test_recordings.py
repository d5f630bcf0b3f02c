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
    frame = pandas.DataFrame(columns)
    same(machine_a.predict(frame), expected)
    assert "columns not used: `note`" in machine_a.predict(frame.assign(note="words")).remark
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
    with pytest.raises(hci.InputError, match="column 'iq_A': found twice"):
        hci.Recording(twice)


def test_dates_of_all_kinds(machine_a, columns, expected):
    """In a time zone, with a hole first, as objects, as the index; in the unit of the name."""
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(columns).drop(columns="time_ms")
    times = pandas.Timestamp("2026-01-01") + pandas.to_timedelta(columns["time_ms"], unit="ms")
    holed = times.to_series(index=frame.index)
    holed[0] = pandas.NaT
    for dated in (frame.assign(time_s=times.tz_localize("Europe/Rome")), frame.assign(time_s=times.to_pydatetime().astype(object)),
                  frame.assign(time_ms=times), frame.set_index(times)):
        assert np.allclose(machine_a.predict(dated).run.time_s, expected.run.time_s, atol=1e-9)
    same(machine_a.predict(pandas.DataFrame(columns).set_index("time_ms")), expected)
    assert len(machine_a.predict(frame.assign(time_s=holed)).run.time_s) == 1999


def test_polars(machine_a, columns, expected):
    polars = pytest.importorskip("polars")
    same(machine_a.predict(polars.DataFrame(columns)), expected)
    same(machine_a.predict(polars.DataFrame(columns).lazy()), expected)


def test_named_fields_and_other_types(machine_a, columns, expected):
    array = np.empty(2000, [(name, "f8") for name in NAMES])
    for name in NAMES:
        array[name] = columns[name]
    same(machine_a.predict(array), expected)
    whole = {name: values[:, None].repeat(2, 1)[:, 0] for name, values in columns.items()}  # with strides
    same(machine_a.predict(whole), expected)
    for change in (lambda x: x.astype(">f8"), lambda x: x[:, None], lambda x: x[None], lambda x: [str(y) for y in x],
                   lambda x: np.ma.masked_array(x, x != x), lambda x: np.frombuffer(b"x" + x.tobytes(), "u1")[1:].view("f8")):
        same(machine_a.predict({name: change(values) for name, values in columns.items()}), expected)
    masked = np.ma.masked_array(columns["iq_A"], np.arange(2000) == 5)
    assert len(machine_a.predict({**columns, "iq_A": masked}).run) == 1999
    constant, words = machine_a.predict({**columns, "iq_A": 5}), machine_a.predict({**columns, "iq_A": ["4,9"] * 2000})
    assert np.ptp(constant.run.i_A[:, 0]) > 9.0 and "2000 of 2000 cells have no number" in words.remark
    for wrong, said in ((columns["iq_A"] + 0j, "complex numbers"), (np.ones((2000, 3)), r"an array of shape \(2000, 3\)")):
        with pytest.raises(hci.InputError, match=f"column 'iq_A': found {said}, expected one number for each sample; give"):
            machine_a.predict({**columns, "iq_A": wrong})
    integers = {"theta_e_deg": np.arange(0, 360, 3), "iq_A": np.full(120, 2, np.int16), "torque_Nm": [1.0] * 120}
    assert len(machine_a.predict(integers).run) == 120


def test_mat_files(machine_a, columns, expected, tmp_path):
    scipy_io = pytest.importorskip("scipy.io")
    scipy_io.savemat(tmp_path / "run.mat", {**columns, "sample_rate": 1e4, "comment": "words"})
    same(machine_a.predict(hci.Recording.from_mat(tmp_path / "run.mat")), expected)
    scipy_io.savemat(tmp_path / "struct.mat", {"log": {"data": columns}})
    same(machine_a.predict(hci.Recording.from_mat(tmp_path / "struct.mat", variables=NAMES)), expected)
    same(machine_a.predict(scipy_io.loadmat(tmp_path / "run.mat")), machine_a.predict({**columns, "sample_rate": 1e4}))
    with pytest.raises(hci.InputError, match="found no variable"):
        hci.Recording.from_mat(tmp_path / "run.mat", variables=["speed"])


def test_mat_files_of_structs(machine_a, columns, expected, tmp_path):
    """Signals of Simulink by their labels; two structs with a field of the same name; files that are none."""
    scipy_io, file = pytest.importorskip("scipy.io"), tmp_path / "run.mat"
    signals = np.zeros(3, [("values", "O"), ("label", "O")])
    for k, name in enumerate(NAMES[1:]):
        signals[k] = columns[name][:, None], name
    scipy_io.savemat(file, {"out": {"time": columns["time_ms"] * 1e-3, "signals": signals}})
    simulink = machine_a.predict(hci.Recording.from_mat(file))
    assert np.allclose(simulink.torque_model_Nm, expected.torque_model_Nm, atol=1e-9)
    scipy_io.savemat(file, {"first": columns, "second": {**columns, "iq_A": -columns["iq_A"]}})
    with pytest.raises(hci.InputError, match="found `iq_A` more than once, as first.iq_A, second.iq_A; give variables="):
        hci.Recording.from_mat(file)
    chosen = hci.Recording.from_mat(file, variables=["time_ms", "theta_e_deg", "torque_mNm", "first.iq_A"])
    same(machine_a.predict(chosen, columns={"iq_A": "first.iq_A"}), expected)
    for content, said in ((b"", "found no MAT file"), (b"MATLAB 7.3".ljust(124) + b"\x00\x02IM", "found a MAT file of version 7.3")):
        file.write_bytes(content)
        with pytest.raises(hci.InputError, match=said):
            hci.Recording.from_mat(file)


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
