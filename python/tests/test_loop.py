"""A hidden effect is found from recordings in memory, and what it did to the torque is gone."""
import shutil

import numpy as np
import pytest

import hci


@pytest.fixture(scope="module")
def truth(data, tmp_path_factory):
    """Machine A with more cogging torque and weaker magnets."""
    folder = tmp_path_factory.mktemp("truth") / "machine"
    shutil.copytree(data / "machine_a", folder)
    (folder / "effects.csv").write_text("effect,parameter,value,unit,std_error\ncogging,sine_6,0.15,Nm,\n"
                                        "back_emf,sine_1,-0.01,Nm_per_A,\n")
    return hci.Machine.read(folder)


def test_found_and_corrected(machine_a, truth, tmp_path):
    def record(torque, speed):
        rows = truth.simulate({"duration": 0.3, "prescribed_speed": (speed, "rpm"), "torque_reference": torque,
                               "torque_noise": 0.01, "seed": speed, "strategy": "id0", "trajectory_every": 16}).trajectory
        names = ("time_s", "theta_m_rad", "speed_rad_per_s", "ia_A", "ib_A", "ic_A", "torque_Nm")
        return hci.Recording({name: rows[name] for name in names}, f"{torque} N·m at {speed} rpm")

    runs = [record(torque, speed) for torque, speed in ((0.5, 600), (2.0, 600), (2.0, 1200), (-1.0, 900))]
    held = [record(1.5, 900)]
    found = machine_a.diagnose(runs, holdout=held)
    assert set(found.effects) == {"cogging", "back_emf"}
    assert found.complete and found.word == "explained"
    table = found.to_pandas() if pytest.importorskip("pandas") else None
    assert list(table["role"]) == ["fit"] * 4 + ["holdout"]
    corrected = found.corrected(tmp_path / "diagnosed")
    assert set(corrected.effects) == {"cogging", "back_emf"}
    detail = {finding.effect: finding.detail for finding in found.findings}
    assert detail["cogging"].startswith("sine_6 = 0.15")
    assert detail["back_emf"].startswith("sine_1 = -0.0")
    assert corrected.predict(held[0]).rms_residual_Nm == pytest.approx(0.01, rel=0.1)
    assert machine_a.predict(held[0]).rms_residual_Nm > 0.1


def test_currents_of_a_solution_flow(machine_a, smooth):
    drive = machine_a.simulate({"duration": 0.2, "prescribed_speed": 100.0}, currents=smooth)
    assert drive.T_ripple_percent < 1e-3
    assert np.ptp(drive.trajectory["torque_Nm"]) < 1e-4


def test_a_slip_is_said_and_nothing_searched(machine_a):
    """Phases b and c swapped, as `check` finds."""
    rows = machine_a.simulate({"duration": 0.3, "prescribed_speed": (600, "rpm"), "torque_reference": 2.0, "torque_noise": 0.01,
                               "strategy": "id0", "trajectory_every": 16}).trajectory
    log = {name: rows[name] for name in ("time_s", "theta_m_rad", "speed_rad_per_s", "ia_A", "ic_A", "ib_A", "torque_Nm")}
    swapped = hci.Recording(dict(zip(("time_s", "theta_m_rad", "speed_rad_per_s", "ia_A", "ib_A", "ic_A", "torque_Nm"), log.values())), "swapped")
    assert machine_a.check(swapped).slips[0].probability > 0.99
    found = machine_a.diagnose(swapped)
    assert found.word == "unknown" and "swapped" in found.verdict and "No effect was looked for" in found.verdict
