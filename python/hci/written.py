"""Folders that whole commands of the program write: tune, batch, fleet, sweep."""
from __future__ import annotations

import csv
import json
import os
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any, Dict, List, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from . import _look, _program
from ._call import Path
from ._result import Result
from .recording import Recordable, recordings_of

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure

    from .machine import Machine

Table = Dict[str, npt.NDArray[Any]]


def read_table(file: Path) -> Table:
    """A table that the program has written, by its columns: numbers, NaN where a cell is empty, or words."""
    with open(file, newline="", encoding="utf-8") as lines:
        head, *rows = list(csv.reader(line for line in lines if not line.startswith("#")))
    found: Table = {}
    for name, cells in zip(head, zip(*rows) if rows else [()] * len(head)):
        try:
            found[name] = np.array([float(cell) if cell else np.nan for cell in cells])
        except ValueError:
            found[name] = np.array(cells, object)
    return found


class Written(Result):
    """A folder of results, and what the program said of it.

    Attributes:
        folder: where the files are.
        done: whether the program ended with exit code 0.
        summary: all figures, as summary.json has them.
    """

    #: The table of `to_pandas`.
    _main = ""
    __reduce__ = object.__reduce__  # files and numbers

    def __init__(self, folder: Path, code: int, words: str, remark: str) -> None:
        self.folder = FilePath(folder)
        self.done: bool = code == 0
        self._words, self._notes = words, remark
        self.summary = json.loads((self.folder / "summary.json").read_text(encoding="utf-8"))

    @property
    def verdict(self) -> str:
        """What the program says, in its words."""
        return self._words

    @property
    def remark(self) -> str:
        return self._notes

    def table(self, name: str) -> Table:
        """A table of the folder by its columns, such as table("fleet.csv")["motor"]."""
        return read_table(self.folder / name)

    def to_pandas(self) -> "pandas.DataFrame":
        """The main table of the folder."""
        import pandas

        return pandas.DataFrame(self.table(self._main))


class Tuned(Written):
    """What `tune` has made of logs: currents, a table for the drive, a report."""

    _main = "currents/waveform.csv"

    @property
    def machine(self) -> "Machine":
        """The machine as the logs have corrected it."""
        from .machine import Machine

        return Machine.read(self.folder / "diagnose/machine")

    def plot(self, figure: Optional["Figure"] = None) -> "Figure":
        """Phase currents of the table, and the torque that they make in the model."""
        wave = self.table(self._main)
        figure = _look.figure_of(figure, 10.0, 4.2, self.verdict.splitlines()[0])
        axes, angle = figure.subplots(1, 2), np.degrees(wave["theta_e_rad"])
        _look.axes_of(axes[0], "Torque", "electrical angle, degrees", "N·m")
        axes[0].plot(angle, wave["torque_Nm"], color=_look.AFTER, lw=1.4)
        axes[0].set_ylim(min(0.0, 1.2 * np.min(wave["torque_Nm"])), max(0.0, 1.2 * np.max(wave["torque_Nm"])))
        _look.axes_of(axes[1], "Phase currents", "electrical angle, degrees", "A")
        for phase, colour in zip("abc", _look.PHASES):
            axes[1].plot(angle, wave[f"i{phase}_A"], color=colour, lw=1.4, label=phase)
        for place in axes:
            place.margins(x=0)
        _look.legend_of(axes[1])
        return figure


class Batch(Written):
    """What `batch` has done: a row for each motor of the list."""

    _main = "fleet.csv"

    def fleet(self, folder: Path, **options: Any) -> "Fleet":
        """The motors side by side: `fleet` of this folder."""
        return fleet(self.folder, folder=folder, **options)

    def plot(self, figure: Optional["Figure"] = None) -> "Figure":
        """How many motors came out how."""
        states, count = np.unique(self.table(self._main)["state"].astype(str), return_counts=True)
        figure = _look.figure_of(figure, 7.0, 1.6 + 0.4 * len(states), self.verdict.splitlines()[0])
        axes = _look.axes_of(figure.subplots(), "Motors", "motors", "")
        axes.barh(range(len(states)), count, color=[_look.AFTER if name == "done" else _look.ALARM for name in states])
        axes.set_yticks(range(len(states)), states)
        return figure


class Fleet(Written):
    """Motors of one make side by side: which stand out and by what."""

    _main = "deviations.csv"

    @property
    def stands_out(self) -> List[str]:
        """Names of the motors that stand out."""
        return [str(one["motor"]) for one in self.summary["outside"]]

    def plot(self, figure: Optional["Figure"] = None) -> "Figure":
        """Each motor at the parameter in which it differs most, in standard deviations of the line, with the limits."""
        line, motors = self.table("line.csv"), self.table(self._main)
        names = [f"{effect} {parameter}" for effect, parameter in zip(line["effect"], line["parameter"])]
        out = motors["stands_out"].astype(str) == "yes"
        figure = _look.figure_of(figure, 9.0, 1.6 + 0.28 * len(names), self.verdict.splitlines()[0])
        axes = _look.axes_of(figure.subplots(), "Parameters", "standard deviations from the median", "")
        place = np.array([names.index(f"{effect} {parameter}") if effect else -1
                          for effect, parameter in zip(motors["effect"], motors["parameter"])])
        for shown, mark, colour in ((~out & (place >= 0), "|", _look.AXIS), (out, "o", _look.ALARM)):
            axes.plot(motors["deviation"][shown], place[shown], mark, ms=6, color=colour)
        for limit in (-self.summary["limit"], self.summary["limit"]):
            axes.axvline(limit, color=_look.WANTED, lw=1)
        axes.set_yticks(range(len(names)), names)
        axes.set_ylim(len(names) - 0.5, -0.5)
        return figure


class Sweep(Written):
    """Points of a grid: a trade-off, an envelope or a map."""

    @property
    def _main(self) -> str:  # type: ignore[override]
        return {"trade-off": "trade_off.csv", "envelope": "envelope.csv", "map": "map.csv"}[self.summary["kind"]]

    def plot(self, figure: Optional["Figure"] = None) -> "Figure":
        """Ripple over the peak current, or torque over the speed."""
        points, is_map = self.table(self._main), self.summary["kind"] != "trade-off"
        figure = _look.figure_of(figure, 7.0, 4.4, self.verdict.splitlines()[0])
        x, y = ("speed_rpm", "mean_Nm") if is_map else ("peak_phase_A", "T_ripple_percent")
        axes = _look.axes_of(figure.subplots(), "", *(("rpm", "N·m") if is_map else ("peak phase current, A", "ripple, %")))
        axes.plot(points[x], points[y], "o", ms=4, color=_look.AFTER)
        return figure


def tune(*logs: Recordable, folder: Path, columns: Optional[Dict[str, str]] = None, **options: Any) -> Tuned:
    """From logs to currents and a table for the drive, by all the steps: `hci-solve tune`.

    Args:
        logs: paths, DataFrames, mappings of arrays or `Recording`s; or none, with machine= and runs=. What is in memory is
            written into FOLDER-logs beside the folder, since the report and commands.sh name it.
        folder: a new folder, where everything goes.
        columns: which column is which quantity, where names do not say it.
        options: those of the program with _ for -: pole_pairs=7, kv=400, slots=12, holding=True, torque=0.2.
    """
    machine = options.pop("machine", None)
    words: List[Any] = [one.path or one.write(_beside(folder) / f"{k + 1}.csv") for k, one in enumerate(recordings_of(logs))]
    if machine is not None:
        words.insert(0, machine if isinstance(machine, (str, os.PathLike)) else machine.path)
    return Tuned(folder, *_program.run("tune", *words, *_program.words_of({"column": columns, **options}), "--out", folder))


def _beside(folder: Path) -> FilePath:
    """A folder for what a report names and is in memory."""
    made = FilePath(os.fspath(folder).rstrip("/") + "-logs")
    made.mkdir(parents=True, exist_ok=True)
    return made


def batch(motors: Path, command: str, folder: Path, *, jobs: Optional[int] = None, shard: Optional[str] = None,
          time_limit_s: Optional[float] = None, retry: bool = False, **options: Any) -> Batch:
    """One command for each motor of a list: `hci-solve batch`. Interrupted, the same call goes on.

    Args:
        motors: motors.csv: a row for each motor, docs/files.md.
        command: fit, diagnose, tune or solve.
        folder: where the results go.
        jobs: processes; without it as many as there are processors.
        shard: "3/16" does the third of sixteen shares.
        time_limit_s: a motor that takes longer is ended, and is a row.
        retry: motors that have no result are done again.
        options: of the command, for every motor, with _ for -.
    """
    own = {"command": command, "jobs": jobs, "shard": shard, "time_limit": time_limit_s, "retry": retry, "out": folder}
    return Batch(folder, *_program.run("batch", motors, *_program.words_of(own), "--", *_program.words_of(options)))


def fleet(*folders: Union[Path, Batch], folder: Path, false_alarms_percent: Optional[float] = None) -> Fleet:
    """Motors of one make side by side: `hci-solve fleet`.

    Args:
        folders: of `batch` with the command fit or diagnose; several of its shares are joined.
        folder: where the results go.
        false_alarms_percent: of sound motors that may stand out by chance; without it 0.2.
    """
    words: Sequence[Any] = [one.folder if isinstance(one, Batch) else one for one in folders]
    options = _program.words_of({"false_alarms": false_alarms_percent, "out": folder})
    return Fleet(folder, *_program.run("fleet", *words, *options))
