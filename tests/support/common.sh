# Read by the tests of the command line, which are called as `sh SCRIPT SOURCE_DIR BUILD_DIR HCI_SOLVE`: a folder to write
# in, a way to run the program, and checks that go on after a failure.

set -u
export LC_ALL=C
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}exitcode=99" UBSAN_OPTIONS="${UBSAN_OPTIONS:+$UBSAN_OPTIONS:}exitcode=99"

source_dir=$(cd "$1" && pwd) && hci_solve=$3 || exit 1
case $hci_solve in
    /*) ;;
    *) hci_solve=$PWD/$hci_solve ;;
esac
built=$(cd "$2" && pwd) || exit 1
work=$(mktemp -d) || exit 1
trap 'chmod -R u+rwX "$work"; rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM

# The program without sanitizers, where that is built: for what takes long.
use_plain_build() {
    [ ! -x "$built/nested/all/hci-solve" ] || hci_solve=$built/nested/all/hci-solve
}

checks=0
failures=0
shown= # what ran last

fail() {
    failures=$((failures + 1))
    echo "FAILED: $*"
    [ -z "$shown" ] || echo "    after: $shown"
    [ ! -s "$work/stderr" ] || sed 's/^/    stderr: /' "$work/stderr" | head -n 4
    [ ! -s "$work/stdout" ] || sed 's/^/    stdout: /' "$work/stdout" | head -n 4
}

# check WHAT COMMAND...: the command succeeds.
check() {
    what=$1
    shift
    checks=$((checks + 1))
    "$@" || fail "$what"
}

# run CODE WORD...: the program ends with this exit code; what it says is in $work/stdout and $work/stderr.
run() {
    expected=$1
    shift
    shown="hci-solve $*"
    checks=$((checks + 1))
    "$hci_solve" "$@" >"$work/stdout" 2>"$work/stderr" </dev/null
    code=$?
    [ "$code" -eq "$expected" ] || fail "exit code $code, expected $expected"
    streams_are_kept
}

# What was found is on standard output, a remark or an error on standard error; with an error standard output is empty, or has it as JSON.
streams_are_kept() {
    if [ "$code" -le 1 ]; then
        ! grep -Ev '^hci-solve: (.\[[0-9;]*m)?note:' "$work/stderr" >"$work/strays" || fail "more than remarks on standard error"
    elif [ -s "$work/stdout" ]; then
        grep -q '^	"error":' "$work/stdout" || fail "an error has standard output"
    fi
}

# says EXPRESSION...: each extended regular expression is found in what is said, on either stream.
says() {
    for expression; do
        checks=$((checks + 1))
        grep -Eqs -e "$expression" "$work/stdout" "$work/stderr" || fail "not said: $expression"
    done
}

# One line is said on standard error, and it begins with the program's name.
one_line_is_said() {
    checks=$((checks + 1))
    { IFS= read -r said_line && ! IFS= read -r said_more && [ -z "$said_more" ]; } <"$work/stderr" || fail "not one line is said"
    case $said_line in
        'hci-solve: '*) ;;
        *) fail "what is said does not begin with hci-solve:" ;;
    esac
}

nothing_on_stdout() {
    check "standard output is not empty" [ ! -s "$work/stdout" ]
}

nothing_on_stderr() {
    check "standard error is not empty" [ ! -s "$work/stderr" ]
}

finish() {
    shown=
    [ "$failures" -eq 0 ] || {
        echo "$failures of $checks checks failed"
        exit 1
    }
    echo "$checks checks"
}
