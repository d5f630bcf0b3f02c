"""The few parameters in which motors of one make differ."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, List, NamedTuple, Optional

import numpy as np

from . import _look
from ._binding import lib
from ._call import Note, Path, path, text, writing
from ._result import Result, json_of

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure


class Parameter(NamedTuple):
    """By how much a motor differs from its machine folder in one respect; NaN: the recordings do not tell."""

    effect: str
    parameter: str
    unit: str
    value: float
    std_error: float


class Fit(Result):
    """What `Machine.fit` has fitted.

    Attributes:
        found: whether the error has its least value; else the declared values stay.
        passed: whether all parameters are within the limits that were given; None without limits.
        summary: all figures, as summary.json has them.
    """

    def __init__(self, c: Any) -> None:
        self._c = c
        self.found: bool = bool(c.is_found)
        self.passed: Optional[bool] = c.beyond == 0 if c.judged else None
        self.summary = json_of(lib.hci_fleet_fit_json(c))

    @property
    def parameters(self) -> List[Parameter]:
        """In the order of the effects."""
        return [Parameter(text(p.effect), text(p.parameter), text(p.unit), p.value, p.std_error)
                for p in self._c.parameter[0 : self._c.count]]

    @property
    def verdict(self) -> str:
        """The error as declared, and fitted."""
        first = "Fitted" if self.found else "Not fitted"
        error = f"{self._c.rms_before_Nm:.4g} N·m rms as declared"
        if self.found:
            error += f", {self._c.rms_after_Nm:.4g} N·m fitted"
        return f"{first}: {error}; {self._c.samples} samples"

    @property
    def remark(self) -> str:
        return text(self._c.remark.text)

    def to_pandas(self) -> "pandas.DataFrame":
        """The parameters with their standard errors, as parameters.csv has them."""
        import pandas

        return pandas.DataFrame(self.parameters, columns=list(Parameter._fields))

    def write(self, folder: Path) -> None:
        """Writes parameters.csv and summary.json."""
        note = Note()
        with writing:
            note.check(lib.hci_fleet_fit_write(self._c, path(folder), note.c))

    def plot(self, figure: Optional["Figure"] = None) -> "Figure":
        """Each parameter over its standard error."""
        rows = [row for row in self.parameters if np.isfinite(row.value)]
        figure = _look.figure_of(figure, 8.0, 1.6 + 0.28 * len(rows), self.verdict)
        axes = _look.axes_of(figure.subplots(), "Parameters", "value over its standard error", "")
        axes.barh(range(len(rows)), [row.value / row.std_error for row in rows], color=_look.AFTER)
        axes.set_yticks(range(len(rows)), [f"{row.effect} {row.parameter}: {row.value:+.3g} {row.unit}" for row in rows])
        axes.invert_yaxis()
        return figure
