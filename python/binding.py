"""Writes the C source of hci._binding: binding.py COMPILER INCLUDE_DIR SOURCE_DIR OUT.

The declarations that cffi needs are those of the public headers, as the preprocessor leaves them, so that no
second list of functions and structs has to be kept.
"""
import re
import subprocess
import sys
from pathlib import Path

import cffi

WATCH = """
typedef struct { void *handle; double next_s; int stopped; } hci_python_watch;
extern "Python" int hci_python_tick(void *handle, const char *what, double share);
void hci_python_progress(void *context, const char *what, double share);
bool hci_python_stop(void *context);
const char *hci_python_version(void);
"""


def preprocessed(compiler: str, include: str, source: str) -> str:
    command = [compiler, "-E", "-D__attribute__(x)=", "-I", include, str(Path(source) / "binding.h")]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def own_lines(text: str, include: str) -> str:
    """What is of the project's own headers."""
    kept, own = [], False
    for line in text.splitlines():
        marker = re.match(r'# \d+ "([^"]*)"', line)
        if marker:
            own = marker.group(1).startswith(include)
        elif own:
            kept.append(line)
    return "\n".join(kept)


def without_bodies(text: str) -> str:
    """Without the functions that are defined in headers."""
    out, at = [], 0
    for found in re.finditer(r"static inline ", text):
        if found.start() < at:
            continue
        out.append(text[at : found.start()])
        depth, at = 0, text.index("{", found.start())
        while True:
            depth += {"{": 1, "}": -1}.get(text[at], 0)
            at += 1
            if depth == 0:
                break
    return "".join(out) + text[at:]


def without_asserts(text: str) -> str:
    """Without types that stop the compiler where something is not as it must be."""
    return re.sub(r"typedef char \w+\[[^;]*\? 1 : -1\];", "", text)


def main(compiler: str, include: str, source: str, out: str) -> None:
    ffi = cffi.FFI()
    text = own_lines(preprocessed(compiler, include, source), include)
    ffi.cdef(without_asserts(without_bodies(text)))
    ffi.cdef(WATCH)
    ffi.set_source("hci._binding", '#include "binding.h"\n#include "watch.c"\n')
    ffi.emit_c_code(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
