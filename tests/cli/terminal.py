"""Runs programs on a pseudo-terminal; with --json their standard output is a file.

    terminal.py <JOBS

A line of JOBS is a program to run: FIELD, each ended by the byte 31: NAME, COLUMNS, KEYS, NAME=VALUE…, `--`, WORD…
NAME.screen gets every byte that the terminal got, NAME.stdout what was printed with --json, NAME.code the exit code, 128 and more for a signal as
a shell has it, and NAME.long the lines that are longer than the terminal, escapes and commands to copy not counted. KEYS, if any, is
REGEX>TEXT (with escapes, such as \\x03 for Ctrl-C): TEXT is typed as soon as the expression is found in what is shown.
"""
import fcntl
import os
import pty
import re
import signal
import struct
import sys
import termios


def start(words, columns, settings, stdout):
    """The child has the terminal as its own, so that Ctrl-C reaches it."""
    child, terminal = pty.fork()
    if child:
        return child, terminal
    fcntl.ioctl(2, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # a job in the background of a shell ignores it
    os.dup2(os.open("/dev/null", os.O_RDONLY), 0)
    file = os.open(stdout, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o666)
    if "--json" in words:
        os.dup2(file, 1)
    os.environ.update(TERM="xterm", LC_ALL="C.UTF-8")
    os.environ.update(setting.split("=", 1) for setting in settings)
    os.execvp(words[0], words)


def follow(terminal, expression, keys):
    shown = b""
    while True:
        try:
            some = os.read(terminal, 65536)
        except OSError:  # how Linux says that the other end is closed
            some = b""
        if not some:
            os.close(terminal)
            return shown.replace(b"\r\n", b"\n")
        shown += some
        if expression and re.search(expression, shown):
            os.write(terminal, keys)
            expression = None


def too_long(screen, columns):
    """A character of UTF-8 is one column."""
    text = re.sub("\x1b\\[[0-9;]*[mK]", "", screen.decode("utf-8", "replace"))
    return [line for line in re.split("[\r\n]", text) if len(line) > columns and not line.startswith("    hci-solve ")]


def run(fields):
    name, columns, keys = fields[0], int(fields[1]), fields[2]
    settings, words = fields[3:fields.index("--")], fields[fields.index("--") + 1:]
    expression, _, text = keys.partition(">")
    child, terminal = start(words, columns, settings, name + ".stdout")
    screen = follow(terminal, expression.encode(), text.encode().decode("unicode_escape").encode())
    status = os.waitpid(child, 0)[1]
    code = 128 + os.WTERMSIG(status) if os.WIFSIGNALED(status) else os.WEXITSTATUS(status)
    columns = int(dict(s.split("=", 1) for s in settings).get("COLUMNS", columns))
    with open(name + ".screen", "wb") as file:
        file.write(screen)
    with open(name + ".code", "w") as file:
        file.write(str(code))
    with open(name + ".long", "w", encoding="utf-8") as file:
        file.write("\n".join(too_long(screen, columns)))


for line in sys.stdin.read().split("\n"):
    if line:
        run(line.split("\x1f")[:-1])
