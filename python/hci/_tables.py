"""Small tables as the files that the library reads, so that it is the one that checks them."""
from __future__ import annotations

import os
import re
import tempfile
from pathlib import Path
from typing import Any, Iterable, Mapping, Sequence, Tuple, Union

from ._call import number
from .errors import ArgumentError


class Tables:
    """A temporary folder, of which messages say nothing: a table in it is the argument that it was made of."""

    def __init__(self) -> None:
        self._folder = tempfile.TemporaryDirectory(prefix="hci-")

    def __enter__(self) -> "Tables":
        return self

    def __exit__(self, *_: Any) -> None:
        self._folder.cleanup()

    @property
    def folder(self) -> Path:
        return Path(self._folder.name)

    def solution(self, solution: Any, number: int = 0) -> str:
        """The folder of a solution: its own, or one in here."""
        if isinstance(solution, (str, os.PathLike)):
            return os.fspath(solution)
        folder = self.folder / f"solution_{number + 1}"
        solution.write(folder)
        return os.fspath(folder)

    def hide(self, words: str) -> str:
        """A message with the names of arguments in place of paths."""
        return re.sub(re.escape(self._folder.name + os.sep) + r"(\w+)(\.csv)?", r"argument \1", words)

    def write(self, name: str, columns: Sequence[str], rows: Iterable[Sequence[Any]]) -> Path:
        """A table; numbers are written so that they read back to the same double."""
        path = self.folder / name
        lines = [",".join(columns)] + [",".join(_cell(value, f"argument {path.stem}") for value in row) for row in rows]
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")
        return path


def _cell(value: Any, where: str) -> str:
    if isinstance(value, str):
        return '"' + value.replace('"', '""') + '"' if set(value) & set(',"\n') else value
    return repr(number(value, where))


#: Order to amplitude in N·m, or to (amplitude, phase in rad), or to (amplitude, phase, weight).
Target = Union[str, "os.PathLike[str]", float, Mapping[float, Union[float, Tuple[float, ...]]]]


def target_path(target: Target, tables: Tables) -> Path:
    """A wanted torque as a file."""
    if isinstance(target, (str, os.PathLike)):
        return Path(target)
    if not isinstance(target, Mapping):
        target = {0.0: target}
    rows = []
    for order, value in target.items():
        parts = tuple(value) if isinstance(value, (tuple, list)) else (value,)
        if not 1 <= len(parts) <= 3:
            raise ArgumentError(f"target, order {order}: found {value!r}, expected an amplitude, or an amplitude, a phase and a weight; "
                                "leave the others out")
        rows.append((order, *parts, *(0.0, 1.0)[len(parts) - 1:]))
    return tables.write("target.csv", ("order", "amplitude_Nm", "phase_rad", "weight"), rows)


#: (order, set) of each component, set being pos, neg, sym, asym or zero.
Harmonics = Union[str, "os.PathLike[str]", Iterable[Tuple[float, str]]]


def harmonics_path(harmonics: Harmonics, tables: Tables) -> Path:
    """A set of components as a file."""
    if isinstance(harmonics, (str, os.PathLike)):
        return Path(harmonics)
    return tables.write("harmonics.csv", ("order", "set"), harmonics)


#: Name to value in the unit of docs/simulate.md, to (value, unit), or to a word.
Scenario = Union[str, "os.PathLike[str]", Mapping[str, Any]]


def scenario_path(scenario: Scenario, tables: Tables) -> Path:
    """A scenario as a file."""
    if isinstance(scenario, (str, os.PathLike)):
        return Path(scenario)
    rows = []
    for name, value in scenario.items():
        number, unit = value if isinstance(value, tuple) else (value, "")
        rows.append((name, os.path.abspath(number) if name == "currents" else number, unit))
    return tables.write("scenario.csv", ("name", "value", "unit"), rows)
