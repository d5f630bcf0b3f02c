"""Lines typed into an interactive shell, the tabulator key pressed, and what then stands there.

    complete.py SETUP SHELL [WORD...] <LINES       SETUP: a command that the shell gets first; prints the completed lines
"""
import os
import pty
import select
import sys
import time

PATIENCE_S = 60.0
READY, RESULT, END = b"<ready>", b"<result>", b"<end>"


def read_until(master, mark):
    seen, end = b"", time.monotonic() + PATIENCE_S
    while mark not in seen:
        left_s = end - time.monotonic()
        if left_s <= 0.0 or not select.select([master], [], [], left_s)[0]:
            sys.exit("complete.py: no answer, only: " + repr(seen))
        seen += os.read(master, 4096)
    return seen


def main():
    setup, shell = sys.argv[1], sys.argv[2:]
    lines = sys.stdin.read().splitlines()
    pid, master = pty.fork()
    if pid == 0:
        os.environ.update(TERM="dumb", PS1="$ ", HISTFILE="/dev/null")
        os.execvp(shell[0], shell)
    # The marks are put together by the shell, so that the echo of what is typed is none of them.
    os.write(master, setup.encode() + b"; echo '<re''ady>'\n")
    read_until(master, READY)
    for line in lines:
        os.write(master, line.encode() + b"\t")
        os.write(master, b"\x01echo '<res''ult>' \x05 '<e''nd>'\n")
        seen = read_until(master, END)
        print(seen.split(RESULT)[1].split(END)[0].decode().strip())
    os.close(master)
    os.waitpid(pid, 0)


main()
