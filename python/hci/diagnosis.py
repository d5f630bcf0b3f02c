"""What the model of a machine lacks."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, List, NamedTuple, Optional

import numpy as np
import numpy.typing as npt

from . import _look
from ._arrays import view
from ._binding import ffi, lib
from ._call import Note, Path, path, text, writing
from ._result import Result, json_of

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure

    from .machine import Machine


#: Most runs that a picture names.
_NAMES = 60


class Finding(NamedTuple):
    """One effect: added, ambiguous or rejected."""

    effect: str
    verdict: str
    #: Fall of the Bayesian information criterion by having it.
    delta_bic: float
    #: Of the mean square of the residual before, that it explains; NaN: none.
    residual_share: float
    #: Its parameters with standard errors, or why not.
    detail: str


class NextPoint(NamedTuple):
    """A steady run to record next."""

    id_A: float
    #: NaN: the current answers to what holds or brakes the shaft.
    iq_A: float
    speed_rad_per_s: float
    turns: float
    #: dyno (with a torque sensor), holding or free.
    test: str
    why: str


class Diagnosis(Result):
    """What `Machine.diagnose` has found.

    Attributes:
        machine: that it started from; `corrected` makes the one that it found.
        complete: whether the verdict is that nothing is missing or that what was added explains the residual.
    """

    def __init__(self, machine: "Machine", c: Any, runs: Any, status: int) -> None:
        self.machine, self._c = machine, c
        self._runs, self._slip = runs  # the words of a slip are those of the check
        self.complete: bool = status == lib.HCI_OK
        self.summary = json_of(lib.hci_diagnosis_json(c, ffi.NULL))

    @property
    def word(self) -> str:
        """complete, explained, ambiguous, partly explained or unknown."""
        return text(lib.hci_diagnosis_verdict_name(self._c.verdict))

    @property
    def verdict(self) -> str:
        """The verdict as a few plain sentences."""
        words = ffi.new("char[4096]")
        lib.hci_diagnosis_words(self._c, words, len(words))
        if self._c.again == ffi.NULL:
            return text(words)
        first = ffi.new("char[2048]")
        lib.hci_again_words(self._c.again, first, len(first))
        return text(first) + "\n" + text(words)

    @property
    def advice(self) -> str:
        """What to record next, in a few sentences, or ""."""
        return text(self._c.advice)

    @property
    def findings(self) -> List[Finding]:
        """Effects, most important first."""
        return [Finding(text(f.effect), text(lib.hci_finding_verdict_name(f.verdict)), f.delta_bic, f.residual_share,
                        text(f.detail)) for f in self._c.finding[0 : self._c.findings]]

    @property
    def effects(self) -> List[str]:
        """Names of the effects that were added."""
        return [finding.effect for finding in self.findings if finding.verdict == "added"]

    @property
    def next_points(self) -> List[NextPoint]:
        """What to record next, most telling first."""
        return [NextPoint(p.id_A, p.iq_A, p.speed_rad_per_s, p.turns, text(lib.hci_next_test_name(p.source)), text(p.why))
                for p in self._c.next[0 : self._c.next_points]]

    @property
    def lines(self) -> npt.NDArray[Any]:
        """Orders of the residual: fields run, order, before_Nm, after_Nm, noise_Nm. A view."""
        return view(self._c, self._c.line, self._c.lines, "hci_residual_line")

    def to_pandas(self) -> "pandas.DataFrame":
        """The error of each run before and after, as errors.csv has it."""
        import pandas

        errors = view(self._c, self._c.run, self._c.runs, "hci_run_errors")
        runs = [self._c.run[k] for k in range(self._c.runs)]
        table = {"file": [text(run.file) for run in runs],
                 "role": ["holdout" if run.role == lib.HCI_ROLE_HOLDOUT else "fit" for run in runs]}
        names = [name for name in errors.dtype.names or () if name.endswith(("_Nm", "_rad"))]
        return pandas.DataFrame({**table, **{name: errors[name] for name in names}})

    def write(self, folder: Path) -> None:
        """Writes the files that `hci-solve diagnose -o` writes, the corrected machine in folder/machine."""
        note = Note()
        with writing:
            note.check(lib.hci_diagnosis_write(self._c, ffi.NULL, self._runs.c, path(self.machine.path), path(folder), note.c))

    def corrected(self, folder: Path) -> "Machine":
        """Writes all files into a folder, and reads the corrected machine from there."""
        import os

        self.write(folder)
        return type(self.machine).read(os.path.join(os.fspath(folder), "machine"))

    def plot(self, figure: Optional["Figure"] = None) -> "Figure":
        """Error of each run before and after, and the residual by order."""
        figure = _look.figure_of(figure, 10.0, max(5.0, 1.2 + 0.18 * min(self._c.runs, _NAMES)), self.word.capitalize() + ": " + (", ".join(self.effects) or "no effect added"))
        axes = figure.subplots(1, 2)
        self._draw_runs(axes[0])
        self._draw_orders(axes[1])
        return figure

    def _draw_runs(self, axes: Any) -> None:
        runs = [self._c.run[k] for k in range(self._c.runs)]
        place = np.arange(len(runs))
        _look.axes_of(axes, "Error of the runs (hollow: held out)", "N·m rms", "")
        for k, run in zip(place, runs):
            held = run.role == lib.HCI_ROLE_HOLDOUT
            axes.plot([run.rms_before_Nm, run.rms_after_Nm], [k, k], color="#c3c7cd", lw=1)
            axes.plot(run.rms_before_Nm, k, "o", ms=4, color=_look.AXIS)
            axes.plot(run.rms_after_Nm, k, "o", ms=5, color=_look.AFTER, mfc="white" if held else _look.AFTER)
        if runs and min(run.rms_after_Nm for run in runs) > 0.0:
            _look.logarithmic(axes, "x")
        axes.set_yticks(place, [text(run.file).rsplit("/", 1)[-1] for run in runs] if len(runs) <= _NAMES else [""] * len(runs))
        axes.invert_yaxis()

    def _draw_orders(self, axes: Any) -> None:
        _look.axes_of(axes, "Residual by order", "electrical order", "N·m, peak")
        orders = np.unique(self.lines["order"])
        for name, colour, label in (("before_Nm", _look.AXIS, "before"), ("after_Nm", _look.AFTER, "after")):
            size = [np.max(self.lines[name][self.lines["order"] == order]) for order in orders]
            axes.plot(orders, size, "o", ms=4, color=colour, label=label)
        if len(orders):
            _look.logarithmic(axes, "y")
            _look.legend_of(axes)
