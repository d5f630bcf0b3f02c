"""Runs a program with its standard error on a pseudo-terminal and its standard output in a file.

    terminal.py COLUMNS SCREEN STDOUT [--keys REGEX TEXT] -- WORD...

SCREEN gets every byte that the terminal got. --keys types TEXT (with escapes, such as \\x03 for Ctrl-C) as soon as the expression
is found in it. Ends with the program's exit code, 128 and more for a signal as a shell has it.
"""
import fcntl
import os
import pty
import re
import signal
import struct
import sys
import termios


def start(words, columns, stdout):
    """The child has the terminal as its own, so that Ctrl-C reaches it."""
    child, terminal = pty.fork()
    if child:
        return child, terminal
    fcntl.ioctl(2, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # a job in the background of a shell ignores it
    os.dup2(os.open(stdout, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o666), 1)
    os.execvp(words[0], words)


def follow(terminal, expression, keys):
    shown = b""
    while True:
        try:
            some = os.read(terminal, 65536)
        except OSError:  # how Linux says that the other end is closed
            some = b""
        if not some:
            return shown
        shown += some
        if expression and re.search(expression, shown):
            os.write(terminal, keys)
            expression = None


def main(arguments):
    options, words = arguments[:arguments.index("--")], arguments[arguments.index("--") + 1:]
    columns, screen, stdout = int(options[0]), options[1], options[2]
    expression = keys = None
    if options[3:4] == ["--keys"]:
        expression, keys = options[4].encode(), options[5].encode().decode("unicode_escape").encode()
    child, terminal = start(words, columns, stdout)
    shown = follow(terminal, expression, keys)
    with open(screen, "wb") as file:
        file.write(shown.replace(b"\r\n", b"\n"))
    status = os.waitpid(child, 0)[1]
    return 128 + os.WTERMSIG(status) if os.WIFSIGNALED(status) else os.WEXITSTATUS(status)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
