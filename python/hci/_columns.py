"""Columns of whatever has some, as contiguous doubles."""
from __future__ import annotations

import datetime
import re
from typing import Any, Dict, Iterable, List, Mapping, Optional, Tuple

import numpy as np
import numpy.typing as npt

from .errors import InputError

Array = npt.NDArray[Any]
Doubles = npt.NDArray[np.float64]

#: Units of time at the end of a name, in a second: dates have none, their column is in the unit that it says.
_PER_SECOND = {"ns": 1e9, "us": 1e6, "µs": 1e6, "μs": 1e6, "ms": 1e3, "min": 1 / 60.0, "h": 1 / 3600.0}
_UNIT = re.compile(r"[_ (\[](ns|us|µs|μs|ms|min|h)[)\]]?$")


def columns_of(data: Any, where: str) -> Dict[str, Doubles]:
    """By their names, each once, as long as each other; a single value is one of all samples."""
    found: Dict[str, Doubles] = {}
    for label, values in _pairs(data):
        name = _name(label)
        if name in found:
            raise InputError(f"{where}: column {name!r}: found twice, expected each name once; rename one of them")
        if "\0" in name:
            raise InputError(f"{where}: column {name!r}: found a zero byte in a name; rename it")
        numbers = _numbers(values, name, f"{where}: column {name!r}")
        if numbers is not None:
            found[name] = numbers
    longest = max((values.size for values in found.values() if values.ndim), default=1)
    found = {name: values if values.ndim else np.full(longest, values) for name, values in found.items()}
    lengths = {name: len(values) for name, values in found.items()}
    if len(set(lengths.values())) > 1:
        raise InputError(f"{where}: columns of different lengths: {lengths}; give as many values of each")
    return found


def has_columns(data: Any) -> bool:
    """Whether this is one recording, and no list of them."""
    return isinstance(data, Mapping) or hasattr(data, "columns") or getattr(getattr(data, "dtype", None), "names", None) is not None


def _pairs(data: Any) -> Iterable[Tuple[Any, Any]]:
    if isinstance(data, Mapping):  # "__header__" and the like: loadmat of scipy
        return [(name, values) for name, values in data.items() if not str(name).startswith("__")]
    if isinstance(data, np.ndarray) and data.dtype.names:
        return [(name, data[name]) for name in data.dtype.names]
    frame: Any = data
    if hasattr(frame, "collect_schema") and hasattr(frame, "collect"):  # lazy, of polars
        frame = frame.collect()
    if hasattr(frame, "column_names"):  # a table of pyarrow
        return [(name, frame[name]) for name in frame.column_names]
    if hasattr(frame, "columns") and hasattr(frame, "__getitem__"):
        columns = [(name, frame[name]) for name in frame.columns]
        return _index(getattr(frame, "index", None), [name for name, _ in columns]) + columns
    if isinstance(data, (list, tuple)):
        raise TypeError(f"found a {type(data).__name__}, expected one recording; take its elements one by one")
    raise TypeError(f"found {type(data).__name__}, expected a path, a DataFrame, a mapping of arrays or an array "
                    "with named fields; give each column a name, such as {\"iq_A\": values}")


def _index(index: Any, taken: List[Any]) -> List[Tuple[Any, Any]]:
    """The index of a DataFrame of pandas where it has a name, or is the time."""
    found = []
    for level, name in enumerate(getattr(index, "names", None) or []):
        values = index.get_level_values(level)
        if name is None and getattr(values.dtype, "kind", "") in "Mm":
            name = "time_s"
        if name is not None and name not in taken:
            found.append((name, values))
    return found


def _name(label: Any) -> str:
    """Of a column; of several rows of names, as pandas reads them, the last is the unit."""
    if not isinstance(label, tuple):
        return str(label)
    *words, unit = [str(word) for word in label]
    name = " ".join(word for word in words if word and not word.startswith("Unnamed: "))
    return name if unit in ("", "-", "1") or unit.startswith("Unnamed: ") else f"{name} ({unit})".strip()


def _numbers(values: Any, name: str, where: str) -> Optional[Doubles]:
    """As doubles, NaN for what is no number; None for a single word. Contiguous ones are not copied."""
    array = _array(values)
    if array.ndim > 1 and array.size in (0, max(array.shape)):
        array = array.reshape(-1 if array.size != 1 else ())  # a row or a column of a matrix, a number of MATLAB
    if array.ndim > 1 or array.dtype.kind in "cV":
        what = "complex numbers" if array.dtype.kind == "c" else f"an array of shape {array.shape}"
        raise InputError(f"{where}: found {what}, expected one number for each sample; give each part a name of its own")
    if array.dtype.kind not in "biuf" and (array.ndim == 0 or array.dtype.kind == "U" and array.size == 1):
        return None
    if array.dtype.kind in "OUST":
        array = _of_objects(array)
    if array.dtype.kind in "Mm":
        array = _seconds(array)
        unit = _UNIT.search(name)
        array = array * _PER_SECOND[unit[1]] if unit else array
    return np.asarray(array, np.float64, order="C")


def _array(values: Any) -> Array:
    dtype = getattr(values, "dtype", None)
    if getattr(dtype, "tz", None) is not None:  # pandas: instants of a time zone
        return np.asarray(values, "datetime64[ns]")
    if isinstance(values, np.ma.MaskedArray) and np.ma.is_masked(values):
        return np.asarray(np.ma.filled(values.astype(np.float64), np.nan))
    return np.asarray(values.to_numpy() if hasattr(values, "to_numpy") else values)


def _of_objects(array: Array) -> Array:
    """Cells of several kinds: dates and durations, else numbers, also as text."""
    if any(isinstance(value, datetime.datetime) for value in array):
        return np.array([_instant(value) for value in array], "datetime64[ns]")
    return np.array([_number(value) for value in array], np.float64)


def _number(value: Any) -> float:
    if isinstance(value, datetime.timedelta):
        return value.total_seconds()
    try:
        return float(value)
    except (TypeError, ValueError):
        return float("nan")


def _instant(value: Any) -> np.datetime64:
    if not isinstance(value, datetime.datetime) or value != value:
        return np.datetime64("NaT")
    return np.datetime64(value.astimezone(datetime.timezone.utc).replace(tzinfo=None) if value.tzinfo else value, "ns")


def _seconds(array: Array) -> Doubles:
    """Dates, from the first on, or durations."""
    there = array[~np.isnat(array)]
    spans = array - there[0] if array.dtype.kind == "M" and len(there) else array
    seconds = spans.astype("timedelta64[ns]").astype(np.float64) * 1e-9
    return np.where(np.isnat(spans), np.nan, seconds)
