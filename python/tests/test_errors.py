"""Exceptions say where it is wrong and what to do."""
import pickle

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


def test_a_table_from_numbers_is_an_argument(machine_a):
    with pytest.raises(hci.InputError) as caught:
        machine_a.solve({0: 1.0, -3: 0.1})
    assert (caught.value.file, caught.value.line, caught.value.column) == ("argument target", 3, 1)
    with pytest.raises(hci.InputError, match="^argument scenario: "):
        machine_a.simulate({"prescribed_speed": 10.0})


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
    for number in (-3, 2**40, 1.5):
        with pytest.raises(hci.ArgumentError, match=f"at_most: found {number}, expected a whole number from 0 on"):
            machine_a.solve(1.0, at_most=number)
    with pytest.raises(hci.ArgumentError, match="a set of harmonics is given, and so many are to be chosen"):
        machine_a.solve(1.0, at_most=2, harmonics=[(1, "pos")])
    with pytest.raises(hci.ArgumentError, match="method pointwise has no set"):
        machine_a.pointwise(1.0, harmonics=[(1, "pos")])
    with pytest.raises(hci.ArgumentError, match="speed_rpm"):
        machine_a.solve(1.0, limit_voltage_V=10.0)
    (tmp_path / "file").write_text("")
    with pytest.raises(hci.OutputError):
        machine_a.solve(1.0).write(tmp_path / "file" / "below")
    with pytest.raises(ValueError, match="different lengths"):
        hci.Recording({"a": [1.0, 2.0], "b": [1.0]})
    with pytest.raises(hci.ArgumentError, match="per_torque: these currents are not linear"):
        machine_a.solve(1.0, fundamental=(5.0, 0.1)).emit(tmp_path, "x", per_torque=True)
    for words, wrong in (("target, order 0: found", {"target": {0: (2.4, 0, 1, 9)}}), ("argument target: found None", {"target": None}),
                         ("limit_current_A: found phase 'd'", {"limit_current_A": {"d": 3}}), ("at_most: found '3'", {"at_most": "3"}),
                         ("limit_rms_A: found None", {"limit_rms_A": {"a": None}}), ("fundamental: found", {"fundamental": (np.nan, 0)})):
        with pytest.raises(hci.ArgumentError, match=words):
            machine_a.solve(**{"target": 1.0, **wrong})
    with pytest.raises(hci.ArgumentError, match="found a zero byte"):
        hci.Machine.read(machine_a.path + "\0x")
    with pytest.raises(hci.ArgumentError, match="^rated_speed: found a value"):
        hci.Machine.from_datasheet(pole_pairs=2, strength=0.1, reading="flux", rated_speed_rpm=-1)
    assert hci.Machine.from_datasheet(pole_pairs=2, strength=0.1, reading="flux", name="a/../../b").name == "a_.._.._b"
    with pytest.raises(TypeError, match="expected a path"):
        hci.Recording(3)


@pytest.mark.parametrize("text, place", [
    ("a/b.csv:7: column 2 `x; y`: found `;`, expected a number; write one", ("a/b.csv", 7, 2, "write one")),
    ("a/b.csv:7: found nothing", ("a/b.csv", 7, None, None)),
    ("bench 3: Monday:7: column 2: found `x:9: y`", ("bench 3: Monday", 7, 2, None)),
    ("--column iq_A=I: found no column `I`; write one", (None, None, None, "write one")),
    ("out of memory", (None, None, None, None)),
])
def test_places(text, place):
    error = hci.InputError(text)
    assert (error.file, error.line, error.column, error.remedy) == place


def test_words_of_the_program_are_those_of_python(machine_a):
    log = {"time_s": [0.0, 0.1, 0.2], "x": [1.0, 2.0, 3.0]}
    with pytest.raises(hci.InputError, match=r'say which column it is: columns=\{"theta_m_deg": "COLUMN"\}'):
        machine_a.predict(log)
    with pytest.raises(hci.InputError, match=r'^columns=\{"torque_Nm": "Channel 3"\}: found no column') as error:
        machine_a.predict(log, columns={"torque_Nm": "Channel 3"})
    assert error.value.file is None
    with pytest.raises(hci.ArgumentError, match="^fmi: found `4`"):
        machine_a.export_fmu("none.fmu", fmi=4)
    with pytest.raises(TypeError, match="expected one recording"):
        machine_a.predict([log])


def test_results_say_why_they_cannot_be_pickled(machine_a):
    with pytest.raises(TypeError, match="hand on its `summary`"):
        pickle.dumps(machine_a.solve(1.0))


def test_a_data_sheet_that_does_not_agree():
    sheet = {"pole_pairs": 7, "reading": "kv_line_peak", "strength": 110}
    assert hci.Machine.from_datasheet(**sheet, rated_current_A=4, rated_torque_Nm=0.3).remark == ""
    assert "998 times" in hci.Machine.from_datasheet(**sheet, rated_current_A=4, rated_torque_Nm=300).remark
    with pytest.raises(hci.ArgumentError, match="^strength: found '110 rpm/V', expected a number"):
        hci.Machine.from_datasheet(**{**sheet, "strength": "110 rpm/V"})
