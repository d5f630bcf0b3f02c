"""From a recording to the orders of a waveform."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional

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


class Waveform(Result):
    """Cogging torque or back-EMF by order, with standard errors: what `Machine.harmonics` has measured."""

    def __init__(self, c: Any) -> None:
        self._c = c
        self._is_cogging = c.quantity == lib.HCI_WAVEFORM_COGGING
        self.summary = json_of(lib.hci_waveform_json(c))

    @property
    def unit(self) -> str:
        """Of the amplitudes."""
        return "N·m" if self._is_cogging else "N·m/A"

    @property
    def orders(self) -> npt.NDArray[Any]:
        """All that were looked at: fields order, amplitude, phase_rad, std_error, chance, kept. A view."""
        return view(self._c, self._c.order, self._c.count, "hci_waveform_order")

    @property
    def kept(self) -> npt.NDArray[Any]:
        """Those that stand out of the noise, or were asked for."""
        found: npt.NDArray[Any] = self.orders[self.orders["kept"]]
        return found

    @property
    def verdict(self) -> str:
        """How many orders stand out."""
        name = "Cogging torque" if self._is_cogging else "Back-EMF"
        kept = self.kept
        if len(kept) == 0:
            return f"{name}: no order stands out of the noise"
        top = kept[np.argmax(kept["amplitude"])]
        return (f"{name}: {len(kept)} of {self._c.count} orders stand out\nthe largest is order {top['order']:.5g} "
                f"with {top['amplitude']:.4g} ± {top['std_error']:.2g} {self.unit}")

    @property
    def remark(self) -> str:
        return text(self._c.remark.text)

    def to_pandas(self) -> "pandas.DataFrame":
        """The orders that are kept, as the table of a machine has them."""
        import pandas

        return pandas.DataFrame({name: self.kept[name] for name in ("order", "amplitude", "phase_rad", "std_error")})

    def write(self, folder: Path) -> None:
        """Writes back_emf.csv or cogging.csv as a machine folder has it, and a picture."""
        note = Note()
        with writing:
            note.check(lib.hci_waveform_write(self._c, path(folder), note.c))

    def plot(self, figure: Optional["Figure"] = None) -> "Figure":
        """The waveform over a turn, and its orders."""
        first, *more = self.verdict.splitlines()
        figure = _look.figure_of(figure, 10.0, 4.0, first, more[0] if more else "")
        axes, kept = figure.subplots(1, 2), self.kept
        terms = ffi.new("hci_harmonic[]", max(1, len(kept)))
        for k, row in enumerate(kept):
            terms[k] = lib.hci_harmonic_polar(row["order"], row["amplitude"], row["phase_rad"])
        angle = np.linspace(0.0, 2.0 * np.pi, 1441)
        _look.axes_of(axes[0], "Over an electrical turn", "electrical angle, degrees", self.unit)
        axes[0].plot(np.degrees(angle), [lib.hci_harmonics_at(terms, len(kept), float(x)) for x in angle], color=_look.AFTER)
        axes[0].margins(x=0)
        _look.axes_of(axes[1], "By order", "electrical order", f"{self.unit}, peak")
        axes[1].errorbar(kept["order"], kept["amplitude"], 1.96 * kept["std_error"], fmt="o", ms=4, color=_look.AFTER)
        if len(kept):
            _look.logarithmic(axes[1], "y")
        return figure
