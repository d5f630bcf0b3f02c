"""The simulated drive."""
from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Optional

import numpy as np
import numpy.typing as npt

from . import _look
from ._arrays import view
from ._binding import lib
from ._call import text
from ._result import Result, json_of
from .solution import Samples, amplitude

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure


class Follow(Result):
    """What `Machine.follow` has run: the ripple through a current loop, with each remedy at each speed.

    Attributes:
        summary: all figures, as `--json` of the program prints them.
    """

    def __init__(self, code: int, words: str, remark: str) -> None:
        self.summary = json.loads(words)
        self._remark = remark

    @property
    def verdict(self) -> str:
        """The least ripple at each speed."""
        lines = []
        for row in self.summary["speeds"]:
            best = min(row["remedies"], key=lambda one: float(one["T_ripple"]))
            lines.append(f"{row['speed_rpm']:g} rpm: ripple {best['T_ripple']:.3g} % with {best['remedy']}")
        return "\n".join(lines)

    @property
    def remark(self) -> str:
        return self._remark

    def to_pandas(self) -> "pandas.DataFrame":
        """A row for each remedy at each speed."""
        import pandas

        return pandas.DataFrame([{"speed_rpm": row["speed_rpm"], **one} for row in self.summary["speeds"] for one in row["remedies"]])

    def plot(self, figure: Optional["Figure"] = None) -> "Figure":
        """Ripple over the speed."""
        figure = _look.figure_of(figure, 7.0, 4.2, f"Ripple at {self.summary['torque_Nm']:.4g} N·m through the current loop")
        axes, rows = figure.subplots(), self.summary["speeds"]
        _look.axes_of(axes, "", "rpm", "ripple peak to peak, % of the mean")
        for k, one in enumerate(rows[0]["remedies"]):
            axes.plot([row["speed_rpm"] for row in rows], [row["remedies"][k]["T_ripple"] for row in rows], "o-", ms=4, label=one["remedy"])
        _look.logarithmic(axes, "y")
        _look.legend_of(axes)
        return figure


class Simulation(Result):
    """What `Machine.simulate` has run.

    Attributes:
        trajectory: the rows that trajectory.csv would have: trajectory["torque_Nm"] is a column.
        summary: all figures, as summary.json has them.
    """

    def __init__(self, c: Any, samples: Any) -> None:
        self._c = c
        self.trajectory = Samples(samples)
        self.summary = json_of(lib.hci_simulation_json(c))

    @property
    def verdict(self) -> str:
        """Mean torque and its ripple over the time that was evaluated."""
        c = self._c
        first = f"Mean torque {c.torque_Nm.mean:.4g} N·m"
        if np.isfinite(c.T_ripple_percent):
            first += f", ripple {c.T_ripple_percent:.3g} % peak to peak"
        span = f"evaluated from {c.from_s:.4g} to {c.to_s:.4g} s, mean speed {c.speed_rad_per_s.mean * 30 / np.pi:.4g} rpm"
        return f"{first}\n{span}, peak phase current {c.peak_phase_A:.4g} A"

    @property
    def remark(self) -> str:
        return text(self._c.remark.text)

    @property
    def spectrum(self) -> npt.NDArray[Any]:
        """Torque by electrical order: fields order, sine and cosine in N·m. A view."""
        return view(self._c, self._c.spectrum_Nm, self._c.spectrum_count, "hci_harmonic")

    @property
    def T_ripple_percent(self) -> float:
        """100 (T_max − T_min)/T_mean."""
        return float(self._c.T_ripple_percent)

    @property
    def mean_torque_Nm(self) -> float:
        """Over the time that was evaluated."""
        return float(self._c.torque_Nm.mean)

    def to_pandas(self) -> "pandas.DataFrame":
        """The trajectory."""
        return self.trajectory.to_pandas()

    def plot(self, figure: Optional["Figure"] = None) -> "Figure":
        """Torque, speed and phase currents over time, and the torque by order."""
        first, facts = self.verdict.splitlines()
        figure = _look.figure_of(figure, 10.0, 6.6, first, facts)
        axes, rows = figure.subplots(2, 2), self.trajectory
        time = rows["time_s"]
        for place, title, column, unit in ((axes[0][0], "Torque", "torque_Nm", "N·m"),
                                           (axes[1][0], "Speed", "speed_rad_per_s", "rad/s")):
            _look.axes_of(place, title, "time, s", unit)
            place.plot(time, rows[column], color=_look.AFTER, lw=1.2)
            place.axvspan(time[0], self._c.from_s, color="#eceef1", zorder=0)
            place.margins(x=0)
            _look.calm(place, 0.05)  # a smooth torque looks smooth
        self._draw_end(axes[1][1])
        self._draw_spectrum(axes[0][1])
        return figure

    def _draw_end(self, axes: Any) -> None:
        """Phase currents over the last two electrical turns."""
        rows, angle = self.trajectory, np.unwrap(self.trajectory["theta_e_rad"])
        last = np.abs(angle - angle[-1]) <= 4.0 * np.pi
        _look.axes_of(axes, "Phase currents at the end", "time, s", "A")
        for phase, colour in zip("abc", _look.PHASES):
            axes.plot(rows["time_s"][last], rows[f"i{phase}_A"][last], color=colour, lw=1.4, label=phase)
        axes.margins(x=0)
        _look.legend_of(axes)

    def _draw_spectrum(self, axes: Any) -> None:
        ripple = self.spectrum[1:]
        _look.axes_of(axes, "Torque ripple by order", "electrical order", "N·m, peak")
        axes.bar(ripple["order"], amplitude(ripple), 0.8, color=_look.AFTER)
