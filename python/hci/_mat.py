"""Vectors of a MAT file, which scipy reads."""
from __future__ import annotations

import os
from typing import Any, Dict, List, Optional, Sequence, Tuple

import numpy as np
import numpy.typing as npt

from ._call import Path
from .errors import InputError

Array = npt.NDArray[Any]
#: By all its names, those of the structs that it is in first: ("log", "data", "iq_A").
Found = List[Tuple[Tuple[str, ...], Array]]


def vectors_of(file: Path, variables: Optional[Sequence[str]] = None) -> Dict[str, Array]:
    """Those that are wanted, or all that are as long as the longest, by their own names."""
    found: Found = []
    for key, value in _load(file).items():
        if not key.startswith("__"):
            _flatten((key,), value, found)
    if variables is not None:
        return {key: _one(key, found, file) for key in variables}
    longest = max((len(value) for _, value in found if value.ndim == 1), default=0)
    names = [path[-1] for path, value in found if value.ndim == 1 and len(value) == longest]
    return {key: _one(key, [(path, value) for path, value in found if value.ndim == 1], file) for key in dict.fromkeys(names)}


def _load(file: Path) -> Dict[str, Any]:
    from scipy.io import loadmat

    where = os.fspath(file)
    try:
        content: Dict[str, Any] = loadmat(where, squeeze_me=True, struct_as_record=True, appendmat=False)
        return content
    except NotImplementedError:
        raise InputError(f"{where}: found a MAT file of version 7.3, expected one up to 7; save it with save(…, '-v7')") from None
    except OSError as error:
        raise InputError(f"{where}: cannot be read: {error.strerror or error}; give the path of a MAT file that you may read") from None
    except Exception as error:  # scipy has a kind for each part that is broken
        raise InputError(f"{where}: found no MAT file ({error}); save the recording again") from None


def _flatten(path: Tuple[str, ...], value: Any, found: Found) -> None:
    """Fields of structs, one by one; a signal of Simulink has the name of its label."""
    array = np.asarray(value)
    if array.dtype.names and array.ndim:
        for one in array.reshape(-1):
            _flatten(path, one, found)
    elif array.dtype.names:
        label = str(array["label"].item()) if {"values", "label"} <= set(array.dtype.names) else ""
        for name in array.dtype.names:
            own = label.strip("<>") if label and name == "values" else name
            _flatten((*path, own), array[name].item(), found)
    elif array.dtype.kind in "biufc" and array.ndim:
        found.append((path, array))


def _one(name: str, found: Found, file: Path) -> Array:
    """The variable of this name, alone or behind the names of its structs."""
    where = os.fspath(file)
    of_name = [(path, value) for path, value in found if name in (path[-1], ".".join(path))]
    if not of_name:
        raise InputError(f"{where}: found no variable {name} but {', '.join(dict.fromkeys(path[-1] for path, _ in found))}; "
                         "give one of these")
    if any(not np.array_equal(value, of_name[0][1]) for _, value in of_name):
        paths = ", ".join(".".join(path) for path, _ in of_name)
        raise InputError(f"{where}: found `{name}` more than once, as {paths}; give variables=[…], with the one that is meant")
    return of_name[0][1]
