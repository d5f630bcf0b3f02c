"""Pictures show the numbers of the result, and a notebook shows picture and verdict."""
import base64
import inspect
import re

import numpy as np
import pytest

import hci

pytest.importorskip("matplotlib")


def axes(figure, title):
    (found,) = [one for one in figure.axes if one.get_title(loc="left") == title]
    return found


def test_a_solution(smooth):
    figure = smooth.plot()
    after = [line for line in axes(figure, "Torque").lines if line.get_label() == "after"][0]
    assert np.array_equal(after.get_ydata(), smooth.waveform["torque_Nm"])
    assert [line.get_color() for line in axes(figure, "Phase currents").lines] == ["#767c86", "#0072b2", "#b87a00", "#009e73"]
    before = [bar.get_height() for bar in axes(figure, "Torque ripple by order").patches][0]
    assert before == pytest.approx(smooth.spectrum()["before_Nm"][1])


def test_the_others(machine_a, smooth, data):
    drive = machine_a.simulate(data / "drive/driven.csv")
    columns = {name: drive.trajectory[name] for name in ("time_s", "theta_m_rad", "speed_rad_per_s", "torque_Nm")}
    prediction = machine_a.predict(columns)
    results = [drive, prediction, machine_a.harmonics(columns, "cogging"), machine_a.check(columns)]
    drive_smooth = machine_a.simulate({"duration": 0.1, "prescribed_speed": 100.0, "current_control": "ideal"}, currents=smooth)
    low, high = axes(drive_smooth.plot(), "Torque").get_ylim()
    assert high - low >= 0.0499 * drive_smooth.mean_torque_Nm
    for result in results:
        figure = result.plot()
        assert figure.axes and all(one.lines or one.patches or one.collections for one in figure.axes)


def collisions(figure):
    """Pairs of labels of one axis that overlap, and texts that leave the figure."""
    figure.draw_without_rendering()
    box = {text: text.get_window_extent() for text in [figure._suptitle] if text}
    found = [text.get_text() for text, extent in box.items() if extent.x1 > figure.bbox.x1 or extent.x0 < figure.bbox.x0]
    for axes in figure.axes:
        for axis in (axes.xaxis, axes.yaxis):
            shown = [label.get_window_extent() for label in axis.get_ticklabels(which="both") if label.get_text()]
            found += [(axis.get_label_text(), k) for k, (a, b) in enumerate(zip(shown, shown[1:])) if a.overlaps(b)]
    return found


@pytest.fixture
def many_runs(machine_a):
    """A diagnosis of forty recordings, whose errors are within a decade."""
    angle = np.arange(180) * 2 * np.pi / 180
    iq = np.linspace(1.0, 3.0, 40)
    rng = np.random.default_rng(1)
    runs = []
    for k, size in enumerate(iq):
        torque = 0.2 * size + 0.02 * np.sin(12 * angle) + rng.normal(0, 0.01, 180)
        runs.append(hci.Recording({"theta_m_rad": angle, "iq_A": np.full(180, size), "torque_Nm": torque}, f"recording of run {k}"))
    return machine_a.diagnose(runs, progress=lambda what, share: True)


def test_labels_have_room(many_runs, smooth, machine_c):
    for result in (smooth, machine_c.solve({0: 4.0, 6: 0.5}, harmonics=[(1, "pos")]), many_runs):
        assert not collisions(result.plot()), type(result)


def test_in_a_notebook(smooth):
    page = smooth._repr_html_()
    assert smooth.verdict.splitlines()[0] in page
    picture = base64.b64decode(re.search(r"base64,([^\"]*)", page)[1])
    assert picture.startswith(b"\x89PNG") and 20_000 < len(picture) < 200_000
    assert repr(smooth) == "<Solution: Reached: every torque order is within 2.463 µN·m of what is wanted>"


def test_a_notebook_says_the_verdict_once(smooth, monkeypatch):
    from matplotlib.figure import Figure

    drawn = []
    save = Figure.savefig
    monkeypatch.setattr(Figure, "savefig", lambda figure, *words, **more: (drawn.append(figure), save(figure, *words, **more)))
    smooth._repr_html_()
    assert [figure.get_suptitle() for figure in drawn] == [""]
    assert smooth.verdict.splitlines()[0] in smooth.plot().get_suptitle().replace("\n", " ")


def test_everything_is_documented_and_typed():
    for name in hci.__all__:
        thing = getattr(hci, name)
        assert thing.__doc__, name
        for member, value in vars(thing).items():
            if member.startswith("_") or not (inspect.isfunction(value) or isinstance(value, (property, classmethod))):
                continue
            function = value.fget if isinstance(value, property) else getattr(value, "__func__", value)
            assert function.__annotations__.get("return") is not None, f"{name}.{member}"
            inherited = any(getattr(getattr(base, member, None), "__doc__", None) for base in thing.__mro__)
            assert inherited, f"{name}.{member}"
