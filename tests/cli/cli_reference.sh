#!/bin/sh
# `reference`: the pages in docs/reference are those of this program; the man page is well formed; completion offers every command, every
# option and every word that an option accepts, in the shells themselves.
#   cli_reference.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
tests=$source_dir/tests/cli
unset COLUMNS

# ---- the pages

sh "$source_dir/scripts/reference" "$hci_solve" "$work/pages" || fail "scripts/reference"
check "docs/reference is not what the program says: run scripts/reference" diff -r "$source_dir/docs/reference" "$work/pages"
commands=$(sed -n 's/^| \[`\(.*\)`\](.*/\1/p' "$work/pages/README.md")
check "the index of the pages is empty" [ -n "$commands" ]

run 0 --help
for command in $(sed -n 's/^  \([a-z]*\) .*/\1/p' "$work/stdout" | sort -u); do
    check "no page of $command" [ -s "$work/pages/$command.md" ]
done
for page in "$work"/pages/*.md; do
    for link in $(grep -o '](\.\./[^)]*)' "$page" | sed 's/^](\.\.\///; s/)$//'); do
        check "$page: no docs/$link" [ -f "$source_dir/docs/$link" ]
    done
done

# the options of a command by its --help, which is printed by other code
options() {
    "$hci_solve" "$1" --help | sed -n '/^Example/,$d;s/^  [ -][ a-zA-Z][ ,] \(--[a-z-]*\).*/\1/p' | sort
}

for command in $commands; do
    [ ! -f "$source_dir/docs/$command.md" ] || check "the page of $command does not name docs/$command.md" \
        grep -q "](../$command.md)" "$work/pages/$command.md"
    options "$command" >"$work/options"
    check "no option of $command found" [ -s "$work/options" ]
    sed -n 's/^| .*`\(--[a-z-]*\).*` |.*/\1/p' "$work/pages/$command.md" | sort >"$work/listed"
    check "$command: other options than --help" diff "$work/options" "$work/listed"
    check "$command: no exit codes" grep -q '^| 0 | ' "$work/pages/$command.md"
    check "$command: no files written" awk '/^## Files written$/ { found = NR } NR == found + 2 && /[a-z]/ { said = found } END { exit !said }' \
        "$work/pages/$command.md"
    check "$command: no example" grep -q "^hci-solve $command " "$work/pages/$command.md"
done

# ---- the man page

run 0 reference man
nothing_on_stderr
cp "$work/stdout" "$work/hci-solve.1"
if command -v mandoc >/dev/null; then
    # no dates in what is built
    mandoc -Tlint -Wwarning "$work/hci-solve.1" | grep -v 'missing date, using ""' >"$work/lint"
    check "mandoc: $(cat "$work/lint")" [ ! -s "$work/lint" ]
    mandoc -Tutf8 -Owidth=150 "$work/hci-solve.1" | sed "s/.$(printf '\b')//g" >"$work/man"
    for command in $commands; do
        check "man page: no $command" grep -q "^ *hci-solve $command " "$work/man"
        for option in $(options "$command"); do
            check "man page: no $option" grep -q -e "^ .*$option\\b" "$work/man"
        done
    done
else
    echo "skipped: man page, no mandoc here"
fi
if command -v groff >/dev/null; then
    groff -man -ww -Tutf8 "$work/hci-solve.1" 2>"$work/lint" >/dev/null
    check "groff: $(cat "$work/lint")" [ ! -s "$work/lint" ]
fi

# ---- completion in bash

run 0 reference bash
cp "$work/stdout" "$work/hci-solve.bash"
check "bash does not read it" bash -n "$work/hci-solve.bash"

# offered WORD...: what is offered in place of the last word
offered() {
    bash --norc -c 'source "$1" || exit; shift; COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)); _hci_solve
        [[ ${#COMPREPLY[@]} -eq 0 ]] || printf "%s\n" "${COMPREPLY[@]}"' bash "$work/hci-solve.bash" hci-solve "$@" | sort
}

# is_offered WORDS... -- WORD...
is_offered() {
    expected=
    while [ "$1" != -- ]; do
        expected="$expected$1
"
        shift
    done
    shift
    shown="completion of: hci-solve $*"
    printf '%s' "$expected" | sort >"$work/expected"
    offered "$@" >"$work/offered"
    check "not offered" diff "$work/expected" "$work/offered"
    shown=
}

# Every option of every command; and the words that the program names when it refuses one, no others.
# shellcheck disable=SC2046,SC2086
complete_all() {
    is_offered $commands --help --version -- ''
    for command in $commands; do
        is_offered $(options "$command") -- "$command" -
        is_offered $(options "$command") -- "$command" word --json --
    done
}
complete_all
is_offered solve simulate -- s # both begin with s
is_offered --method --max-loss -- solve data/machine_a --m
is_offered -- solve --bogus

# refusal COMMAND OPTION: the words after "expected one of", or "expected `WORD`", of the program that is given a wrong one
refusal() {
    case $1 in
    solve) set -- "$1" "$2" data/machine_a --target data/scenarios/02/target.csv ;;
    emit) set -- "$1" "$2" data/example_currents/currents.csv --name t -o "$work/never" ;;
    init) set -- "$1" "$2" x --pole-pairs 2 --resistance 1 --rated-current 1 -o "$work/never" ;;
    harmonics) set -- "$1" "$2" x --pole-pairs 2 ;;
    simulate | predict) set -- "$1" "$2" x x ;;
    *) set -- "$1" "$2" x ;;
    esac
    command=$1 option=$2
    shift 2
    for more in '' '--kv 1' '--volt-per-krpm 1' '--torque-constant 1'; do
        [ -z "$more" ] || [ "$command" = init ] || continue
        # shellcheck disable=SC2086
        "$hci_solve" "$command" "$@" $more "$option" @ 2>&1 >/dev/null |
            sed -n "s/^hci-solve: .*found .@., expected \(one of: \([a-z0-9_, -]*\)\|.\([a-z0-9_]*\).; this version\).*/\2\3/p" | sed 's/,//g'
    done | sed -n '1p'
}

cd "$source_dir" || exit 1
with_words=0
for command in $commands; do
    for option in $("$hci_solve" "$command" --help | sed -n '/^Example/,$d;s/^  [ -][ a-zA-Z][ ,] \(--[a-z-]*\) \(NAME\|WHAT\|WHEN\) .*/\1/p'); do
        words=$(refusal "$command" "$option")
        check "$command $option: the program names no words" [ -n "$words" ]
        # shellcheck disable=SC2086
        is_offered $words -- "$command" "$option" ''
        # shellcheck disable=SC2086
        is_offered $words -- "$command" "$option" = ''
        with_words=$((with_words + 1))
    done
done
check "only $with_words options with words" [ "$with_words" -ge 10 ]
is_offered man bash zsh markdown --help -- reference ''
# shellcheck disable=SC2086
is_offered $commands -- reference markdown ''

mkdir "$work/here" "$work/here/a folder" && touch "$work/here/a file.csv" && cd "$work/here" || exit 1
is_offered 'a file.csv' 'a folder' -- solve ''
is_offered 'a file.csv' 'a folder' -- solve --target 'a'
is_offered 'a folder' -- solve x --out ''
is_offered 'a folder' -- solve x -o 'a'
is_offered 'a folder' -- solve x --out = 'a'
is_offered 'a folder' -- solve x --out =
is_offered 'a file.csv' 'a folder' -- diagnose x --runs ''
is_offered -- harmonics x --orders ''
is_offered -- solve x --speed ''

# ---- in the shells themselves

mkdir "$work/functions"
run 0 reference zsh
cp "$work/stdout" "$work/functions/_hci-solve"

# typed SHELL LINE COMPLETED
typed() {
    case $1 in
    bash) setup="bind 'set enable-bracketed-paste off'; source '$work/hci-solve.bash'" words='bash --norc --noprofile -i' ;;
    zsh) setup="fpath=('$work/functions' \$fpath); autoload -Uz compinit && compinit -D -u; unsetopt auto_remove_slash; bindkey -e" words='zsh -f -i' ;;
    esac
    shown="$1: $2"
    # shellcheck disable=SC2086
    found=$(python3 "$tests/complete.py" "$setup" "$2" $words)
    check "completed to: $found" [ "$found" = "$3" ]
    shown=
}

python3 -c 'import pty; pty.openpty()' 2>/dev/null || { echo "the shells are left out: no pseudo-terminal here"; finish; exit 0; }

for shell in bash zsh; do
    if ! command -v $shell >/dev/null || ! command -v python3 >/dev/null; then
        echo "skipped: completion in $shell, not here"
        continue
    fi
    typed $shell 'hci-solve diag' 'hci-solve diagnose'
    typed $shell 'hci-solve solve --limit-c' 'hci-solve solve --limit-current'
    typed $shell 'hci-solve solve x --method poi' 'hci-solve solve x --method pointwise'
    typed $shell 'hci-solve init x --kv-of phase' 'hci-solve init x --kv-of phase-peak'
    typed $shell 'hci-solve solve --target a\ fi' 'hci-solve solve --target a file.csv'
    typed $shell 'hci-solve solve --out a' 'hci-solve solve --out a folder/'
    typed $shell 'hci-solve reference markdown diag' 'hci-solve reference markdown diagnose'
done
! command -v zsh >/dev/null || check "zsh does not read it" zsh -n "$work/functions/_hci-solve"

# ---- wrong words

run 2 reference
nothing_on_stdout
says 'expected one of: man, bash, zsh, markdown'
run 2 reference html
says 'found `html`'
run 2 reference markdown sovle
says 'found `sovle`'
run 2 reference man solve
says 'found `solve`'
run 0 reference man --help
check "no help" grep -q '^hci-solve reference' "$work/stdout"

finish
