# Calls on a terminal, of which standard output is a file with --json; read after tests/support/common.sh.

python3 -c 'import fcntl, pty, termios; pty.openpty()' 2>/dev/null || { echo "skipped: no pseudo-terminal through python3"; exit 77; }

escape=$(printf '\033')
unset COLUMNS NO_COLOR LC_CTYPE LANG
mkdir "$work/seen"

# plan NAME COLUMNS [NAME=VALUE...] -- WORD...: a call on a terminal. Calls are made together by `perform`, since
# python takes longer to start than they take. $keys: what is typed when something is seen, as terminal.py has it.
plan() {
    { printf '%s\037' "$work/seen/$1" "$2" "${keys-}"; shift 2
      while [ "$1" != -- ]; do printf '%s\037' "$1"; shift; done
      shift
      printf '%s\037' -- "$hci_solve" "$@"; echo; } >>"$work/jobs"
}
perform() {
    python3 tests/cli/terminal.py <"$work/jobs" || fail "tests/cli/terminal.py"
    : >"$work/jobs"
}

# seen CODE NAME: what has become of a call. Its screen is $screen; what is left to see of it is on $work/stderr.
seen() {
    shown="the call $2 of this script, on a terminal"
    screen=$work/seen/$2.screen
    code=$(cat "$work/seen/$2.code" 2>/dev/null)
    check "exit code $code, expected $1" [ "$code" = "$1" ]
    # progress is overwritten and erased
    sed "s/^.*$(printf '\r')$escape\[K//" "$screen" >"$work/stderr"
    cp "$work/seen/$2.stdout" "$work/stdout"
    [ "$2" = dumb ] || # which is not known to have a width
        check "a line is wider than the terminal: $(cat "$work/seen/$2.long")" [ ! -s "$work/seen/$2.long" ]
}
lacks() { # WHAT EXPRESSION: no line of what the terminal got
    check "$1" eval "! LC_ALL=C grep -q -e '$2' '$screen'"
}
shows_nothing() { # WHAT
    check "$1" [ ! -s "$screen" ]
}
