"""Memory of the library as numpy arrays, without copies; an array keeps what it is part of."""
from __future__ import annotations

from typing import Any, Dict

import numpy as np
import numpy.typing as npt

from ._binding import ffi

_CODES = {"double": "f8", "float": "f4", "_Bool": "?", "char": "S1"}
_dtypes: Dict[str, np.dtype[Any]] = {}


def _dtype_of(kind: Any) -> np.dtype[Any]:
    if kind.kind == "struct":
        fields = [(name, field) for name, field in kind.fields if field.type.kind != "pointer"]
        return np.dtype(
            {
                "names": [name for name, _ in fields],
                "formats": [_dtype_of(field.type) for _, field in fields],
                "offsets": [field.offset for _, field in fields],
                "itemsize": ffi.sizeof(kind),
            }
        )
    if kind.kind == "array":
        return np.dtype((_dtype_of(kind.item), (kind.length,)))
    if kind.kind == "enum":
        return np.dtype("i4")
    if kind.cname in _CODES:
        return np.dtype(_CODES[kind.cname])
    sign = "i" if int(ffi.cast(kind, -1)) < 0 else "u"
    return np.dtype(f"{sign}{ffi.sizeof(kind)}")


def dtype(name: str) -> np.dtype[Any]:
    """The numpy type of a type of C; pointers in a struct are left out."""
    if name not in _dtypes:
        _dtypes[name] = _dtype_of(ffi.typeof(name))
    return _dtypes[name]


def view(owner: Any, pointer: Any, count: int, name: str = "double") -> npt.NDArray[Any]:
    """`count` items at a pointer, which belong to `owner`; not to be written to."""
    kind = dtype(name)
    if count == 0 or pointer == ffi.NULL:
        return np.empty(0, kind)
    alive = ffi.gc(ffi.cast("char *", pointer), lambda _, kept=owner: None)
    array: npt.NDArray[Any] = np.frombuffer(ffi.buffer(alive, count * kind.itemsize), kind)
    array.flags.writeable = False
    return array
