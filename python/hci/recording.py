"""Recordings: files, or columns of numbers in memory that never become a file."""
from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Dict, Iterable, List, Mapping, Optional, Sequence, Set, Union, cast

import numpy as np
import numpy.typing as npt

from ._arrays import view
from ._binding import ffi, lib
from ._call import Note, Path, path, text
from ._columns import columns_of, has_columns
from ._mat import vectors_of
from .errors import InputError

if TYPE_CHECKING:
    import pandas

Array = npt.NDArray[Any]


class Recording:
    """A recording: a file, or columns by name.

    Args:
        data: the path of a CSV file, a DataFrame of pandas or polars, a mapping of names to arrays, or an
            array with named fields. Names are as docs/files.md has them, with their units ("torque_mNm"), or
            those of other tools; two rows of names, as pandas reads a row of units, are "name (unit)". An index of
            pandas is a column where it has a name or is a date. Columns of dates become time from the first on, in
            seconds or in the unit of their name; numbers as text become numbers, and what is none a hole. A single
            number is that of all samples.
        name: stands for a path in messages.

    Columns that are contiguous doubles are not copied.
    """

    def __init__(self, data: Any, name: str = "recording") -> None:
        self.path: Optional[str] = None
        self.columns: Dict[str, npt.NDArray[np.float64]] = {}
        if isinstance(data, (str, os.PathLike)):
            self.path = os.fspath(data)
            self.name = self.path
            return
        self.name = name or "recording"
        self.columns = columns_of(data, self.name)

    @classmethod
    def from_mat(cls, file: Path, variables: Optional[Sequence[str]] = None, name: Optional[str] = None) -> "Recording":
        """A recording from a MAT file (scipy reads it).

        Args:
            file: the file.
            variables: those that are columns; otherwise all vectors that are as long as the longest. Fields of a
                struct count by their own names, signals of Simulink by their labels; log.iq_A is the one of log.
            name: stands for the path in messages.
        """
        return cls(vectors_of(file, variables), name or os.fspath(file))

    def write(self, file: Path) -> str:
        """Writes columns in memory as a CSV file that reads back to the same numbers. Returns its path."""
        rows = np.column_stack(list(self.columns.values()))
        head = ",".join('"' + name.replace('"', '""') + '"' for name in self.columns)
        np.savetxt(file, rows, "%.17g", ",", header=head, comments="", encoding="utf-8")
        return os.fspath(file)

    def __len__(self) -> int:
        return len(next(iter(self.columns.values()), ()))

    def __repr__(self) -> str:
        return f"<Recording {self.name}: {', '.join(self.columns) or 'file'}>"

    def read(self, pole_pairs: int, *, inertia_kgm2: float = float("nan"), torque_constant_Nm_per_A: float = 0.0,
             columns: Optional[Mapping[str, str]] = None, holding: bool = False, strict: bool = False) -> "Run":
        """The run as the library understands it: one angle, one speed, phase currents, torque.

        Args:
            pole_pairs: of the machine.
            inertia_kgm2: for a free shaft without a torque.
            torque_constant_Nm_per_A: of i_q, for a torque that a drive computed.
            columns: which column is which quantity, where names do not say it: {"torque_mNm": "Channel 3"}.
            holding: without a torque column the shaft is turned slowly, and its torque is 0.
            strict: a cell without a number is an error.
        """
        reading = Reading([self], columns=columns, holding=holding, strict=strict)
        reading.c.pole_pairs, reading.c.inertia_kgm2 = pole_pairs, inertia_kgm2
        reading.c.torque_constant_Nm_per_A = torque_constant_Nm_per_A
        run, note = ffi.gc(ffi.new("hci_run *"), lib.hci_run_release), Note()
        note.check(lib.hci_run_read(path(self.name), reading.c, run, note.c))
        return Run(run, run)


#: What counts as a recording.
Recordable = Union[Recording, str, "os.PathLike[str]", Any]


def listed(data: Union[Recordable, Iterable[Recordable]]) -> List[Recordable]:
    """Recordings as a list; one alone is a list of one."""
    alone = isinstance(data, (Recording, str, os.PathLike)) or has_columns(data)
    return [data] if alone else list(cast(Iterable[Recordable], data))


def recordings_of(data: Union[Recordable, Iterable[Recordable]]) -> List[Recording]:
    """Each as a recording, those in memory with names of their own"""
    found = [value if isinstance(value, Recording) else Recording(value, f"recording {k + 1}")
             for k, value in enumerate(listed(data))]
    seen: Set[str] = set()
    for value in found:
        if value.name in seen:
            raise InputError(f"{value.name}: found twice, expected each recording once; give names of their own")
        seen.add(value.name)
    return found


class Reading:
    """Options of reading, and the recordings in memory, for as long as this lives."""

    def __init__(self, recordings: Sequence[Recording], *, columns: Optional[Mapping[str, str]] = None,
                 holding: bool = False, strict: bool = False) -> None:
        self.c = ffi.new("hci_run_options *")
        self.c.inertia_kgm2 = float("nan")
        self.c.holding, self.c.strict = holding, strict
        self._names = ffi.gc(ffi.new("hci_column_names *"), lib.hci_column_names_release)
        for name, column in (columns or {}).items():
            note = Note()
            note.check(lib.hci_column_names_add(self._names, f"{name}={column}".encode(), note.c))
        self.c.columns = self._names
        self._kept: List[Any] = []
        held = [recording for recording in recordings if recording.path is None]
        self._memory = ffi.new("hci_csv_memory[]", max(1, len(held)))
        for memory, recording in zip(self._memory, held):
            self._fill(memory, recording)
        self.c.memory, self.c.memory_count = self._memory, len(held)

    def _fill(self, memory: Any, recording: Recording) -> None:
        names = [ffi.new("char[]", column.encode()) for column in recording.columns]
        values = [ffi.from_buffer("double[]", column) for column in recording.columns.values()]
        name, heads, rows = ffi.new("char[]", path(recording.name)), ffi.new("char *[]", names), ffi.new("double *[]", values)
        self._kept += [name, names, values, heads, rows]
        memory.name, memory.column, memory.value = name, heads, rows
        memory.columns, memory.rows = len(names), len(recording)


class Run:
    """A recording as the library has read it. Arrays belong to the library and are not to be written to."""

    def __init__(self, c: Any, owner: Any) -> None:
        self._c, self._owner = c, owner

    def _column(self, pointer: Any, width: int = 1) -> Optional[Array]:
        if pointer == ffi.NULL:
            return None
        array = view(self._owner, pointer, self._c.count * width)
        return array.reshape(-1, width) if width > 1 else array

    def __len__(self) -> int:
        return int(self._c.count)

    @property
    def name(self) -> str:
        """The file, or the name of what was in memory."""
        return text(self._c.name)

    @property
    def time_s(self) -> Optional[Array]:
        """Ascending; None: the samples have no order in time."""
        return self._column(self._c.time_s)

    @property
    def theta_m_rad(self) -> Optional[Array]:
        """Mechanical angle, unwrapped."""
        return self._column(self._c.theta_m_rad)

    @property
    def speed_rad_per_s(self) -> Optional[Array]:
        """Mechanical, signed."""
        return self._column(self._c.speed_rad_per_s)

    @property
    def i_A(self) -> Optional[Array]:
        """Phase currents, [samples, 3]."""
        return self._column(self._c.i_A, 3)

    @property
    def v_V(self) -> Optional[Array]:
        """Phase voltages, [samples, 3]."""
        return self._column(self._c.v_V, 3)

    @property
    def torque_Nm(self) -> Optional[Array]:
        """On the shaft: measured, 0 of a shaft that is held, or inertia times acceleration."""
        return self._column(self._c.torque_Nm)

    @property
    def temperature_C(self) -> Optional[Array]:
        """Of the magnets."""
        return self._column(self._c.temperature_C)

    @property
    def remark(self) -> str:
        """What was supposed on reading."""
        return text(self._c.remark.text)

    def arrays(self) -> Dict[str, Array]:
        """What the run has, by the names of docs/files.md."""
        found: Dict[str, Optional[Array]] = {
            "time_s": self.time_s, "theta_m_rad": self.theta_m_rad, "speed_rad_per_s": self.speed_rad_per_s,
        }
        for name, values in (("i{}_A", self.i_A), ("v{}_V", self.v_V)):
            for k, phase in enumerate("abc"):
                found[name.format(phase)] = None if values is None else values[:, k]
        found["torque_Nm"], found["temperature_C"] = self.torque_Nm, self.temperature_C
        return {name: values for name, values in found.items() if values is not None}

    def to_pandas(self) -> "pandas.DataFrame":
        """What the run has, a row for each sample."""
        import pandas

        return pandas.DataFrame(self.arrays())
