"""What can go wrong, with the place where it did."""
from __future__ import annotations

import re
from typing import Optional

#: With a line first, since the name of a recording may have ": " in it.
_PLACES = (re.compile(r"^(?P<file>[^\n`]+?):(?P<line>\d+): (?:column (?P<column>\d+)\b)?"),
           re.compile(r"^(?P<file>[^\n]+?)(?P<line>): (?:column (?P<column>\d+)\b)?"))


class HciError(Exception):
    """An error of the library, in its words.

    Attributes:
        text: the whole message: file, line, column, what was found, what was expected, the remedy.
        file: where it is wrong, or None.
        line: of the file, from 1, or None. A recording in memory counts as a file with its header in line 1.
        column: from 1, or None.
        remedy: what to do about it, or None.
    """

    text: str
    file: Optional[str]
    line: Optional[int]
    column: Optional[int]
    remedy: Optional[str]

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self.text = text
        of_argument = isinstance(self, ArgumentError) or text.startswith(("--", "columns="))
        place = None if of_argument else _PLACES[0].match(text) or _PLACES[1].match(text)
        self.file = place["file"] if place else None
        self.line = int(place["line"]) if place and place["line"] else None
        self.column = int(place["column"]) if place and place["column"] else None
        self.remedy = _remedy(text)


def _remedy(text: str) -> Optional[str]:
    """What stands behind the first semicolon outside of `quotes`."""
    quoted = False
    for k, letter in enumerate(text):
        quoted ^= letter == "`"
        if letter == ";" and not quoted:
            return text[k + 1 :].strip() or None
    return None


class ArgumentError(HciError, ValueError):
    """An argument is outside its range, or does not go with another one."""


class InputError(HciError, ValueError):
    """A file or a recording is wrong."""


class NumericError(HciError, ArithmeticError):
    """The numerical method did not succeed."""


class OutOfMemoryError(HciError, MemoryError):
    """Memory is out."""


class OutputError(HciError, OSError):
    """Something could not be written."""


class StoppedError(HciError):
    """The progress function asked for a stop."""
