"""Calls into the library: errors become exceptions, and long work can be watched and stopped."""
from __future__ import annotations

import os
import re
import threading
from typing import Any, Callable, Dict, List, Optional, Tuple, Type, Union

from . import errors
from ._binding import ffi, lib

Path = Union[str, "os.PathLike[str]"]
#: Called with what is being done and the share 0 … 1 of it that is done; returns True to stop. A bar of tqdm
#: with total=1 will do as well.
Progress = Union[Callable[[str, float], Optional[bool]], Any, None]

#: The library keeps a list of the files that it writes: one thread writes at a time.
writing = threading.RLock()

_CLASSES: Dict[int, Type[errors.HciError]] = {
    lib.HCI_ERROR_ARGUMENT: errors.ArgumentError,
    lib.HCI_ERROR_INPUT: errors.InputError,
    lib.HCI_ERROR_MEMORY: errors.OutOfMemoryError,
    lib.HCI_ERROR_OUTPUT: errors.OutputError,
    lib.HCI_ERROR_STOPPED: errors.StoppedError,
}


#: Options in the words of the library, of which the argument here is `columns`: at the beginning, where a name may have
#: blanks in it, and as a remedy, with or without quotes.
_COLUMN = (re.compile(r"^--column (?P<quote>)(?P<name>[^=\s]+)=(?P<column>.*?)(?=: )"),
           re.compile(r"""--column (?P<quote>["']?)(?P<name>[^="'\s]+)=(?P<column>[^"']+?)(?P=quote)(?=[\s;,)]|$)"""))


def raw_text(pointer: Any) -> str:
    """A string of C as it is; "" for NULL."""
    return "" if pointer == ffi.NULL else ffi.string(pointer).decode("utf-8", "replace")


def text(pointer: Any) -> str:
    """Words of the library as one says them in Python; "" for NULL."""
    words = raw_text(pointer)
    for column in _COLUMN if "--column" in words else ():
        words = column.sub(r'columns={"\g<name>": "\g<column>"}', words)
    return words


def path(value: Path) -> bytes:
    """A path for C."""
    encoded = os.fsencode(os.fspath(value))
    if b"\0" in encoded:
        raise errors.ArgumentError(f"path {os.fspath(value)!r}: found a zero byte; give the path of a file or folder")
    return encoded


class Note:
    """What a function of the library says when it fails."""

    def __init__(self) -> None:
        self.c = ffi.new("hci_note *")

    def check(self, status: int, hide: Optional[Callable[[str], str]] = None) -> int:
        """Raises what a status stands for. hide: makes of a message one that names no temporary file."""
        if status in (lib.HCI_OK, lib.HCI_NOT_REACHED):
            return status
        words = text(self.c.text) or text(lib.hci_status_text(status))
        raise _CLASSES.get(status, errors.NumericError)(hide(words) if hide else words)


def number(value: Any, name: str) -> float:
    """A number, also one of numpy."""
    try:
        return float(value)
    except (TypeError, ValueError):
        raise errors.ArgumentError(f"{name}: found {value!r}, expected a number; give another one") from None


def whole(value: int, name: str) -> int:
    """A whole number that C takes as a size."""
    if not 0 <= number(value, name) < 2**31 or value != int(value):
        raise errors.ArgumentError(f"{name}: found {value!r}, expected a whole number from 0 on; give another one")
    return int(value)


class Watch:
    """Progress and stop of one call. Signals such as Ctrl-C are looked at whenever Python is asked."""

    def __init__(self, progress: Progress = None) -> None:
        self._progress = progress
        self._handle = ffi.new_handle(self)
        self.c = ffi.new("hci_python_watch *", {"handle": self._handle})
        self._raised: Optional[BaseException] = None

    def into(self, options: Any, can_stop: bool = True) -> None:
        """Sets the members of a struct of options."""
        options.progress = lib.hci_python_progress
        options.progress_context = self.c
        if can_stop:
            options.stop = lib.hci_python_stop
            options.stop_context = self.c

    def tick(self, what: str, share: float) -> bool:
        """Tells the user how far the work is; True: it is to stop."""
        if what == "" or self._progress is None:
            return False
        if callable(self._progress) and not hasattr(self._progress, "update"):
            return self._progress(what, share) is True
        bar: Any = self._progress
        if hasattr(bar, "set_description"):
            bar.set_description(what, refresh=False)
        bar.update(max(0.0, share * (bar.total or 1) - bar.n))
        return False

    def failed(self, exception: BaseException) -> None:
        """Keeps what a function of the user, or Ctrl-C, has raised."""
        self._raised = exception

    def finish(self, kept: Tuple[Type[BaseException], ...] = ()) -> None:
        """After the call: raises what was kept, and fills a bar. kept: what only ends the work early."""
        if self._raised is None and self.c.stopped and _lost:
            self._raised = _lost.pop()
        if self._raised is not None and not isinstance(self._raised, kept):
            raise self._raised
        bar: Any = self._progress
        if hasattr(bar, "update"):
            bar.update(max(0.0, (bar.total or 1) - bar.n))


#: What was raised before a watch was known: a signal may come at any instant.
_lost: List[BaseException] = []


def _keep(kind: Any, value: BaseException, trace: Any) -> None:
    _lost.append(value)


@ffi.def_extern(onerror=_keep, error=1)  # type: ignore[untyped-decorator]
def hci_python_tick(handle: Any, what: Any, share: float) -> int:
    watch: Watch = ffi.from_handle(handle)
    try:
        return 1 if watch.tick(text(what), share) else 0
    except BaseException as exception:  # Ctrl-C too: it is raised again when the library has returned
        watch.failed(exception)
        return 1


def strings(words: List[bytes]) -> Tuple[Any, List[Any]]:
    """An array of strings for C, and what keeps them alive."""
    kept = [ffi.new("char[]", word) for word in words]
    return ffi.new("char *[]", kept), kept
