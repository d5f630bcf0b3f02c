"""Exceptions say where it is wrong and what to do."""
import numpy as np
import pytest

import hci


def test_a_broken_machine(tmp_path):
    (tmp_path / "machine.csv").write_text("name,value,unit,source\npole_pairs,two,1,\n")
    (tmp_path / "back_emf.csv").write_text("order,amplitude_Nm_per_A,phase_rad\n1,0.1,0\n")
    with pytest.raises(hci.InputError) as caught:
        hci.Machine.read(tmp_path)
    error = caught.value
    assert error.file == str(tmp_path / "machine.csv")
    assert (error.line, error.column) == (2, 2)
    assert "`two`" in error.text and error.remedy and error.remedy in error.text
    assert isinstance(error, ValueError)


def test_a_table_from_numbers_has_no_temporary_path(machine_a):
    with pytest.raises(hci.InputError) as caught:
        machine_a.solve({0: 1.0, -3: 0.1})
    assert (caught.value.file, caught.value.line, caught.value.column) == ("target.csv", 3, 1)


def test_a_recording_in_memory(machine_a):
    angle = np.arange(10.0)
    angle[4] = np.inf
    with pytest.raises(hci.InputError) as caught:
        machine_a.predict(hci.Recording({"theta_m_rad": angle, "iq_A": np.ones(10)}, "monday"), strict=True)
    assert (caught.value.file, caught.value.line, caught.value.column) == ("monday", 6, 1)
    assert caught.value.remedy.startswith("remove the line")


def test_arguments(machine_a, tmp_path):
    with pytest.raises(ValueError, match="method: found 'magic', expected one of auto"):
        machine_a.solve(1.0, method="magic")
    with pytest.raises(hci.ArgumentError, match="speed_rpm"):
        machine_a.solve(1.0, limit_voltage_V=10.0)
    (tmp_path / "file").write_text("")
    with pytest.raises(hci.OutputError):
        machine_a.solve(1.0).write(tmp_path / "file" / "below")
    with pytest.raises(ValueError, match="different lengths"):
        hci.Recording({"a": [1.0, 2.0], "b": [1.0]})
    with pytest.raises(TypeError, match="expected a path"):
        hci.Recording(3)


@pytest.mark.parametrize("text, place", [
    ("a/b.csv:7: column 2 `x; y`: found `;`, expected a number; write one", ("a/b.csv", 7, 2, "write one")),
    ("a/b.csv:7: found nothing", ("a/b.csv", 7, None, None)),
    ("out of memory", (None, None, None, None)),
])
def test_places(text, place):
    error = hci.InputError(text)
    assert (error.file, error.line, error.column, error.remedy) == place
