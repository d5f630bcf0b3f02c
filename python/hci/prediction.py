"""What the model says of a recording."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional

import numpy as np
import numpy.typing as npt

from . import _look
from ._arrays import view
from ._binding import ffi, lib
from ._call import text
from ._result import Result, json_of
from .recording import Run

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure


class Prediction(Result):
    """What `Machine.predict` has compared.

    Attributes:
        run: the recording as it was read.
        torque_model_Nm: the torque that the sensor should have read, of each sample. A view.
        residual_Nm: measured less modelled torque, or None where the recording has no torque. A view.
    """

    def __init__(self, samples: Any, c: Any) -> None:
        self._samples, self._c = samples, c
        self.run = Run(samples.run, samples)
        self.torque_model_Nm: npt.NDArray[Any] = view(samples, samples.model_Nm, samples.run.count)
        self.residual_Nm: Optional[npt.NDArray[Any]] = None
        if samples.residual_Nm != ffi.NULL:
            self.residual_Nm = view(samples, samples.residual_Nm, samples.run.count)
        self.summary = json_of(lib.hci_prediction_json(c))

    @property
    def rms_residual_Nm(self) -> float:
        """Of measured less modelled torque; NaN where the recording has no torque."""
        return float(self._c.rms_residual_Nm)

    @property
    def verdict(self) -> str:
        """Mean, ripple and error of the model."""
        c = self._c
        model = f"model: mean {c.mean_model_Nm:.4g} N·m, ripple {c.ripple_model_Nm:.3g} N·m rms"
        if self.residual_Nm is None:
            return f"No torque to compare with\n{model}"
        return (f"The model is off by {c.rms_residual_Nm:.3g} N·m rms\n{model}; "
                f"recorded: mean {c.mean_torque_Nm:.4g} N·m, ripple {c.ripple_torque_Nm:.3g} N·m rms")

    @property
    def remark(self) -> str:
        return text(self._c.remark.text)

    def to_pandas(self) -> "pandas.DataFrame":
        """The run with torque_model_Nm and, where there is one, residual_Nm."""
        table = self.run.to_pandas()
        table["torque_model_Nm"] = self.torque_model_Nm
        if self.residual_Nm is not None:
            table["residual_Nm"] = self.residual_Nm
        return table

    def plot(self, figure: Optional["Figure"] = None) -> "Figure":
        """Torque recorded and modelled over the mechanical angle, and what is left."""
        first, facts = self.verdict.splitlines()
        figure = _look.figure_of(figure, 10.0, 5.6, first, facts)
        axes, angle = figure.subplots(2, 1, sharex=True), self.run.theta_m_rad
        assert angle is not None
        turned = np.degrees(np.mod(angle, 2.0 * np.pi))
        kept = slice(None, None, max(1, len(turned) // 20000))
        _look.axes_of(axes[0], "Torque", "", "N·m")
        if self.run.torque_Nm is not None:
            axes[0].plot(turned[kept], self.run.torque_Nm[kept], ".", ms=2, color=_look.BEFORE, label="recorded")
        axes[0].plot(turned[kept], self.torque_model_Nm[kept], ".", ms=2, color=_look.AFTER, label="model")
        _look.legend_of(axes[0], markerscale=4)
        _look.axes_of(axes[1], "Recorded less modelled", "mechanical angle, degrees", "N·m")
        if self.residual_Nm is not None:
            axes[1].plot(turned[kept], self.residual_Nm[kept], ".", ms=2, color=_look.ALARM)
        for place in axes:
            _look.calm(place)
        return figure
