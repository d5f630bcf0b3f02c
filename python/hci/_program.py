"""The program of the wheel, for what is the work of whole commands: tune, batch, fleet, sweep, export-fmu."""
from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path as FilePath
from typing import Any, List, Mapping, NoReturn, Tuple, Type

from . import errors

_CLASSES: dict[int, Type[errors.HciError]] = {
    2: errors.ArgumentError, 3: errors.InputError, 4: errors.NumericError, 5: errors.OutputError}


def find() -> str:
    """The program that came with the package, or the one of the PATH."""
    own = FilePath(__file__).with_name("hci-solve")
    found = str(own) if own.exists() else shutil.which("hci-solve")
    if found is None:
        raise FileNotFoundError("hci-solve: found neither beside the package nor on the PATH; install the package again with pip")
    return found


def main() -> NoReturn:
    """`hci-solve` on the command line."""
    os.execv(find(), ["hci-solve", *sys.argv[1:]])


def _word(value: Any) -> str:
    if isinstance(value, float):
        return repr(float(value))
    return os.fspath(value) if isinstance(value, os.PathLike) else str(value)


def words_of(options: Mapping[str, Any]) -> List[str]:
    """Options of the program: limit_current=12 is --limit-current 12; True a word alone; None and False nothing; a
    list of numbers one word with commas, of anything else one option each; a mapping one NAME=VALUE each."""
    words: List[str] = []
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        if value is None or value is False:
            continue
        if isinstance(value, Mapping):
            value = [f"{key}={_word(part)}" for key, part in value.items()]
        elif hasattr(value, "tolist"):
            value = value.tolist()
        if value is True:
            words.append(option)
        elif not isinstance(value, (list, tuple)):
            words += [option, _word(value)]
        elif all(isinstance(part, (int, float)) for part in value):
            words += [option, ",".join(_word(part) for part in value)]
        else:
            words += [word for part in value for word in (option, _word(part))]
    return words


def run(*words: Any) -> Tuple[int, str, str]:
    """Exit code 0 or 1, what the program says, and its remarks; an error becomes an exception. Ctrl-C is passed on."""
    command = [find(), *[_word(word) for word in words]]
    with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          start_new_session=True) as process:
        try:
            out, said = process.communicate()
        except BaseException:
            process.send_signal(signal.SIGINT)
            process.communicate()
            raise
    lines = [line[len("hci-solve: "):] for line in said.decode("utf-8", "replace").splitlines() if line.startswith("hci-solve: ")]
    code = process.returncode
    if code in (0, 1):
        return code, out.decode("utf-8", "replace").strip(), "\n".join(line[len("note: "):] for line in lines)
    kind = errors.StoppedError if code < 0 or code > 128 else _CLASSES.get(code, errors.HciError)
    if lines and lines[-1].startswith("--"):  # an option; here an argument
        option, rest = lines[-1][2:].split(":", 1)
        raise kind(f"{option.replace('-', '_')}:{rest}")
    raise kind(lines[-1] if lines else f"hci-solve ended with exit code {code}")
