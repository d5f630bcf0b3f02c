"""Conventions that a machine folder and its recordings may have broken."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, List, NamedTuple, Optional

import numpy as np

from . import _look
from ._binding import lib
from ._call import text
from ._result import Result, json_of

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure

_WORDS = {
    "consistent": "Consistent: everything that could be checked agrees as declared",
    "slips": "Something is read wrongly",
    "ambiguous": "Something is read wrongly, and several readings mend it",
    "not_understood": "Something disagrees that no known slip explains",
}


class Slip(NamedTuple):
    """A broken convention that is found or possible."""

    name: str
    file: str
    line: int
    column: str
    found: str
    should_be: str
    probability: float
    words: str
    told_by: str


class Check(Result):
    """What `Machine.check` has found.

    Attributes:
        consistent: whether everything that could be checked agrees as declared.
    """

    def __init__(self, c: Any, owners: Any, status: int) -> None:
        self._c, self._owners = c, owners
        self.consistent: bool = status == lib.HCI_OK
        self.summary = json_of(lib.hci_check_json(c))

    @property
    def word(self) -> str:
        """consistent, slips, ambiguous or not_understood."""
        return text(lib.hci_check_verdict_name(self._c.verdict))

    @property
    def verdict(self) -> str:
        """The verdict, and each slip with the line to change."""
        lines = [_WORDS[self.word]]
        for slip in self.slips:
            lines.append(f"{slip.words} ({100 * slip.probability:.0f} %): {slip.file}:{slip.line}: column {slip.column}: "
                         f"found {slip.found}, should be {slip.should_be}")
        return "\n".join(lines)

    @property
    def slips(self) -> List[Slip]:
        """Most probable first."""
        return [Slip(text(f.slip), text(f.file), f.line, text(f.column), text(f.found), text(f.should_be), f.probability,
                     text(f.words), text(f.told_by)) for f in self._c.finding[0 : self._c.findings]]

    def to_pandas(self) -> "pandas.DataFrame":
        """The relations that were checked: declared and expected value, tolerance, state."""
        import pandas

        rows = self._c.evidence[0 : self._c.evidences]
        return pandas.DataFrame({
            "relation": [text(row.name) for row in rows], "words": [text(row.words) for row in rows],
            "declared": [row.declared for row in rows], "expected": [row.expected for row in rows],
            "as_read": [row.as_read for row in rows], "tolerance": [row.tolerance for row in rows],
            "state": [text(lib.hci_check_state_name(row.state)) for row in rows]})

    def plot(self, figure: Optional["Figure"] = None) -> "Figure":
        """Each relation as declared and as it is best read, over what is expected."""
        figure = _look.figure_of(figure, 8.0, 1.6 + 0.3 * self._c.evidences, _WORDS[self.word])
        axes, table = figure.subplots(), self.to_pandas()
        _look.axes_of(axes, "Relations", "value over what the other numbers make of it", "")
        place = np.arange(len(table))
        expected = table["expected"].to_numpy(float)
        fine = expected != 0.0
        for name, colour, label, size in (("declared", _look.AXIS, "as declared", 7), ("as_read", _look.AFTER, "best reading", 4)):
            axes.plot(table[name].to_numpy(float)[fine] / expected[fine], place[fine], "o", ms=size, color=colour, label=label)
        axes.axvline(1.0, color=_look.AXIS, lw=1)
        axes.set_yticks(place, table["relation"])
        axes.invert_yaxis()
        _look.legend_of(axes)
        return figure
