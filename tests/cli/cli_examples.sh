#!/bin/sh
# labels: slow
# The examples of each command's help, run as they stand there, and the second paper's experiment as it is shipped. They have the
# size of real work, whole fields of finite elements and seconds of a drive: hence slow, and with the build without sanitizers.
#   cli_examples.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
use_plain_build

# A folder in which the examples find data/ and may write out/.
mkdir "$work/here" && ln -s "$source_dir/data" "$work/here/data" && cd "$work/here" || exit 1

run 0 --help
commands=$(sed -n 's/^  \([a-z-]*\)  .*/\1/p' "$work/stdout")
check "no commands in the help" [ -n "$commands" ]

examples() {
    sed -n '/^Example/,/^Exit codes/{/^Example/d;/^Exit codes/d;p;}' "$1" | awk '
        { sub(/^ +/, ""); line = line $0 }
        /\\$/ { sub(/\\$/, "", line); next }
        line != "" { print line }
        { line = "" }'
}

for command in $commands; do
    run 0 "$command" --help
    cp "$work/stdout" "$work/help"
    examples "$work/help" >"$work/examples"
    check "no example in the help of $command" [ -s "$work/examples" ]
    while read -r words; do
        folder=$(echo "$words" | sed -n 's/.* -o \([^ ]*\).*/\1/p')
        # the examples have no blanks or quotes inside words
        # shellcheck disable=SC2086
        run 0 ${words#hci-solve }
        [ -z "$folder" ] || check "example wrote nothing into $folder: $words" [ -n "$(ls "$folder" 2>/dev/null)" ]
    done <"$work/examples"
done

# ---- the second paper's experiment

value() { # FILE KEY: the number of a key that the summary has once
    sed -n "s/.*\"$2\":[[:space:]]*\([-0-9.e+]*\),*\$/\1/p" "$1"
}
near() { # FOUND EXPECTED RELATIVE
    check "found $1, expected $2" awk -v a="$1" -v b="$2" -v e="$3" 'BEGIN { d = a - b; if (d < 0) d = -d; if (b < 0) b = -b; exit !(d <= e * b) }'
}
run 0 simulate data/machine_c data/drive/filho_strategy_3.csv -o "$work/three"
says 'evaluated    1.75 s to 2.5 s, 2 whole periods at 80 rpm' 'switching    [0-9.]+ Hz' 'energy .* J in'
near "$(value "$work/three/summary.json" mean_Nm)" 8 1e-4
near "$(value "$work/three/summary.json" T_ripple)" 3.9 0.15 # what a band of 0.1 A lets through
check "F_ripple" awk -v f="$(value "$work/three/summary.json" F_ripple)" 'BEGIN { exit !(f > 0.5 && f < 0.9) }'

finish
