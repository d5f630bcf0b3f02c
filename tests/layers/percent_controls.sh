#!/bin/sh
# Shows that percent.sh can fail: each offence below must be refused, the good lines must pass.
#   percent_controls.sh
set -eu
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0

# expect NAME CODE LINE: a tree with this line in a file.
expect() {
    rm -rf "$work/tree"
    mkdir -p "$work/tree/src/host" "$work/tree/cli"
    printf '%s\n' "$3" '' >"$work/tree/cli/a.c"
    code=0
    said=$(sh "$here/percent.sh" "$work/tree") || code=$?
    if [ "$code" -eq "$2" ]; then
        echo "ok: $1: ${said:-passes}"
    else
        echo "WRONG: $1: exit code $code, wanted $2, got \"$said\""
        failed=1
    fi
}

expect "two digits" 1 'cli_say("%.2g %% of it", share);'
expect "digits of a variable" 1 'cli_say("%.*g%%", 2, share);'
expect "with a blank that holds" 1 'cli_say("%.3g\xC2\xA0%%", share);'
expect "a sentence of two lines" 1 'cli_say("it is %.2g "
        "%% of it", share);'
expect "by its own function" 0 'cli_say("%s %% of it", HCI_PERCENT(share, 2));'
expect "a whole number" 0 'cli_say("%.0f %% and %d %%", share, 5);'
expect "another number before" 0 'cli_say("%.3g A, %s %%", current_A, text);'
exit $failed
