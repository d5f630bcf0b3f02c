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
for command in $(sed -n 's/^  \([a-z-]*\)  .*/\1/p' "$work/stdout" | sort -u); do
    check "no page of $command" [ -s "$work/pages/$command.md" ]
done
for page in "$work"/pages/*.md; do
    for link in $(grep -o '](\.\./[^)]*)' "$page" | sed 's/^](\.\.\///; s/)$//'); do
        check "$page: no docs/$link" [ -f "$source_dir/docs/$link" ]
    done
done

# the options of a command by its --help, which is printed by other code
options() {
    [ -s "$work/help.$1" ] || "$hci_solve" "$1" --help >"$work/help.$1"
    sed -n '/^Example/,$d;s/^  [ -][ a-zA-Z][ ,] \(--[a-z-]*\).*/\1/p' "$work/help.$1" | sort
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

# is_offered WORDS... -- WORD...: what is offered in place of the last word. One shell is asked for all of them, by answers_are_right.
: >"$work/asked"
: >"$work/expected"
is_offered() {
    words=
    while [ "$1" != -- ]; do
        words="$words$1
"
        shift
    done
    shift
    echo "== hci-solve $*" >>"$work/expected"
    printf '%s' "$words" | sort >>"$work/expected"
    { printf '%s\037' "$@"; echo; } >>"$work/asked"
}
answers_are_right() {
    bash --norc -c 'source "$1" || exit
        while IFS= read -r line; do
            IFS=$(printf "\037") read -r -d "" -a words <<<"$line$(printf "\037")"
            unset "words[-1]" "words[-1]"
            COMP_WORDS=(hci-solve "${words[@]}") COMP_CWORD=${#words[@]}
            _hci_solve
            echo "== ${COMP_WORDS[*]}"
            [[ ${#COMPREPLY[@]} -eq 0 ]] || printf "%s\n" "${COMPREPLY[@]}" | sort
        done' bash "$work/hci-solve.bash" <"$work/asked" >"$work/offered"
    check "not offered" diff "$work/expected" "$work/offered"
    : >"$work/asked"
    : >"$work/expected"
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
is_offered solve sweep simulate -- s # they begin with s
is_offered --method --max-loss --minimise -- solve data/machine_a --m
is_offered -- solve --bogus

# refusal COMMAND OPTION: the words after "expected one of" of the program that is given a wrong one
refusal() {
    case $1 in
    simulate | predict) set -- "$1" "$2" @ x x ;;
    *) set -- "$1" "$2" @ x ;;
    esac
    "$hci_solve" "$@" 2>&1 >/dev/null | sed -n 's/^hci-solve: .*found .@., expected one of: \([a-z0-9_, -]*\).*/\1/p' | sed 's/,//g'
}

cd "$source_dir" || exit 1
with_words=0
for command in $commands; do
    for option in $(sed -n '/^Example/,$d;s/^  [ -][ a-zA-Z][ ,] \(--[a-z-]*\) \(NAME\|WHAT\|WHEN\) .*/\1/p' "$work/help.$command"); do
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
answers_are_right

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
answers_are_right

# ---- in the shells themselves

mkdir "$work/functions"
run 0 reference zsh
cp "$work/stdout" "$work/functions/_hci-solve"

# Lines that are typed, and what they are completed to.
cat >"$work/lines" <<'LINES'
hci-solve diag|hci-solve diagnose
hci-solve solve --limit-cu|hci-solve solve --limit-current
hci-solve solve x --method poi|hci-solve solve x --method pointwise
hci-solve init x --kv-of phase|hci-solve init x --kv-of phase-peak
hci-solve solve --target a\ fi|hci-solve solve --target a file.csv
hci-solve solve --out a|hci-solve solve --out a folder/
hci-solve reference markdown diag|hci-solve reference markdown diagnose
LINES

python3 -c 'import pty; pty.openpty()' 2>/dev/null || { echo "the shells are left out: no pseudo-terminal here"; finish; exit 0; }

for shell in bash zsh; do
    if ! command -v $shell >/dev/null; then
        echo "skipped: completion in $shell, not here"
        continue
    fi
    case $shell in
    bash) setup="bind 'set enable-bracketed-paste off'; source '$work/hci-solve.bash'" words='bash --norc --noprofile -i' ;;
    zsh) setup="fpath=('$work/functions' \$fpath); autoload -Uz compinit && compinit -D -u; unsetopt auto_remove_slash; bindkey -e" words='zsh -f -i' ;;
    esac
    shown="$shell, with the lines of this script"
    # shellcheck disable=SC2086
    cut -d '|' -f 1 "$work/lines" | python3 "$tests/complete.py" "$setup" $words >"$work/completed"
    cut -d '|' -f 2 "$work/lines" >"$work/expected"
    check "completed otherwise" diff "$work/expected" "$work/completed"
    shown=
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
