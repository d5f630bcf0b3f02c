"""Recordings: files, or columns of numbers in memory that never become a file."""
from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Dict, Iterable, List, Mapping, Optional, Sequence, Set, Tuple, Union

import numpy as np
import numpy.typing as npt

from ._arrays import view
from ._binding import ffi, lib
from ._call import Note, Path, path, text

if TYPE_CHECKING:
    import pandas

Array = npt.NDArray[Any]


class Recording:
    """A recording: a file, or columns by name.

    Args:
        data: the path of a CSV file, a DataFrame of pandas or polars, a mapping of names to arrays, or an
            array with named fields. Names are as docs/files.md has them, with their units ("torque_mNm"), or
            those of other tools; two rows of names, as pandas reads a row of units, are "name (unit)". Columns of
            dates become seconds, columns of words are left out.
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
        self.name = name
        seen: Set[str] = set()
        for label, values in _pairs(data):
            column, numbers = _name(label), _numbers(values)
            if column in seen:
                raise ValueError(f"{name}: column {column!r}: found twice, expected each name once; rename one of them")
            seen.add(column)
            if numbers is not None:
                self.columns[column] = numbers
        lengths = {column: len(values) for column, values in self.columns.items()}
        if len(set(lengths.values())) > 1:
            raise ValueError(f"{name}: columns of different lengths: {lengths}; give as many values of each")

    @classmethod
    def from_mat(cls, file: Path, variables: Optional[Sequence[str]] = None, name: Optional[str] = None) -> "Recording":
        """A recording from a MAT file (scipy reads it).

        Args:
            file: the file.
            variables: those that are columns; otherwise all vectors that are as long as the longest. Fields of a
                struct count by their own names.
            name: stands for the path in messages.
        """
        from scipy.io import loadmat

        found: Dict[str, Array] = {}
        for key, value in loadmat(file, squeeze_me=True, struct_as_record=True).items():
            if not key.startswith("__"):
                _flatten(key, value, found)
        if variables is not None:
            missing = [key for key in variables if key not in found]
            if missing:
                raise ValueError(f"{os.fspath(file)}: found no variable {missing[0]} but {', '.join(found)}")
            found = {key: found[key] for key in variables}
        longest = max((len(value) for value in found.values()), default=0)
        columns = {key: value for key, value in found.items() if len(value) == longest}
        return cls(columns, name or os.fspath(file))

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


def recordings_of(data: Iterable[Recordable]) -> List[Recording]:
    """Each as a recording, those in memory with names of their own."""
    found = [value if isinstance(value, Recording) else Recording(value, f"recording {k + 1}")
             for k, value in enumerate(data)]
    names = [value.name for value in found]
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f"{name}: found twice, expected each recording once; give names of their own")
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


def _pairs(data: Any) -> Iterable[Tuple[Any, Any]]:
    """Columns of whatever has some."""
    if isinstance(data, Mapping):
        return data.items()
    if isinstance(data, np.ndarray) and data.dtype.names:
        return [(name, data[name]) for name in data.dtype.names]
    frame: Any = data
    if hasattr(frame, "columns") and hasattr(frame, "__getitem__"):
        return [(name, frame[name]) for name in frame.columns]
    raise TypeError(f"found {type(data).__name__}, expected a path, a DataFrame, a mapping of arrays or an array "
                    "with named fields")


def _name(label: Any) -> str:
    """Of a column; of several rows of names, as pandas reads them, the last is the unit."""
    if not isinstance(label, tuple):
        return str(label)
    *words, unit = [str(word) for word in label]
    name = " ".join(word for word in words if word and not word.startswith("Unnamed: "))
    return name if unit in ("", "-", "1") or unit.startswith("Unnamed: ") else f"{name} ({unit})".strip()


def _numbers(values: Any) -> Optional[npt.NDArray[np.float64]]:
    """A column as contiguous doubles; None for words."""
    array = np.asarray(values.to_numpy() if hasattr(values, "to_numpy") else values)
    if array.dtype.kind in "Mm":
        array = _seconds(array)
    if array.dtype.kind == "O":
        try:
            array = np.array([np.nan if value is None else value for value in array], np.float64)
        except (TypeError, ValueError):
            return None
    if array.dtype.kind not in "biuf" or array.ndim != 1:
        return None
    return np.ascontiguousarray(array, np.float64)


def _seconds(array: Array) -> Array:
    """Dates, from the first on, or durations."""
    spans = array - array[0] if array.dtype.kind == "M" and len(array) else array
    seconds = spans.astype("timedelta64[ns]").astype(np.float64) * 1e-9
    return np.where(np.isnat(spans), np.nan, seconds)


def _flatten(key: str, value: Any, found: Dict[str, Array]) -> None:
    """Vectors of a MAT file; fields of structs count by their own names."""
    array = np.asarray(value)
    if array.dtype.names:
        for name in array.dtype.names:
            _flatten(name, array[name].item() if array.ndim == 0 else array[name], found)
    elif array.dtype.kind in "biuf" and array.ndim == 1:
        found[key] = array
