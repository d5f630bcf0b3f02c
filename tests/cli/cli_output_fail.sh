#!/bin/sh
# What cannot be written: exit code 5, a reason and a remedy on standard error, nothing half written, older results untouched.
#   cli_output_fail.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
cd "$source_dir" || exit 1

target=data/scenarios/02/target.csv

# Everything below a folder, hidden files included, with its content.
snapshot() {
    (cd "$1" && find . -type f -exec cksum {} + -o -print | sort)
}

# not_written OUT EXPRESSION... : solve into OUT fails and $work/old is as it was.
not_written() {
    out=$1
    shift
    snapshot "$work/old" >"$work/before"
    run 5 solve data/machine_a --target $target --auto -o "$out"
    nothing_on_stdout
    says '^hci-solve: .*cannot be (written|made)' "$@"
    one_line_is_said
    snapshot "$work/old" >"$work/after"
    check "older files have changed" cmp -s "$work/before" "$work/after"
}

# ---- an input that a result would replace

mkdir "$work/same"
cp $target "$work/same/spectrum.csv"
run 2 solve data/machine_a --target "$work/same/spectrum.csv" --auto -o "$work/same"
says 'would be replaced by a result of the same name; give another --out'
check "the target has changed" cmp -s $target "$work/same/spectrum.csv"
check "something was written" [ "$(ls "$work/same")" = spectrum.csv ]

# Older results, of another solve.
run 0 solve data/machine_b --target $target --auto -q -o "$work/old/results"
cp -R "$work/old" "$work/pristine"
echo mine >"$work/old/file"

# ---- names that are taken or wrong

not_written "$work/old/file" 'old/file: .*; '
not_written "$work/old/file/below" 'old/file'
not_written '' 'no name; name one, or \. for this one'
not_written /dev/null '/dev/null'
not_written /proc/nowhere '/proc/nowhere'
rm "$work/old/results/spectrum.csv" && mkdir "$work/old/results/spectrum.csv"
not_written "$work/old/results" 'results/spectrum.csv: .*found a folder of this name; remove or rename it'
rmdir "$work/old/results/spectrum.csv" && ln -s /dev/full "$work/old/results/spectrum.csv"
not_written "$work/old/results" 'results/spectrum.csv: .*not a plain file'
rm "$work/old/results/spectrum.csv" && mkfifo "$work/old/results/spectrum.csv"
not_written "$work/old/results" 'results/spectrum.csv: .*not a plain file'
rm "$work/old/results/spectrum.csv"
cp "$work/pristine/results/spectrum.csv" "$work/old/results"
long=$(awk 'BEGIN { for (k = 0; k < 300; k++) printf "x" }')
not_written "$work/old/$long" 'too long'
not_written "$work/old/a/b/$long" 'too long' # and the parents that were made are gone

# ---- no permission; root has them all

chmod 555 "$work/old/results"
if [ -w "$work/old/results" ]; then
    echo "skipped: folders without permission (root)"
else
    not_written "$work/old/results" 'Permission denied'
    not_written "$work/old/results/below" 'Permission denied'
    chmod 755 "$work/old/results"
    chmod 444 "$work/old/results/summary.json"
    not_written "$work/old/results" 'summary.json: .*Permission denied; make the file writable'
fi
chmod -R u+w "$work/old"

# ---- a full disk: at each of these sizes another file is the one that does not fit

# limited BLOCKS WORD...: with a limit on the size of files. A block has 512 bytes, in some shells 1024.
limited() {
    blocks=$1
    shift
    shown="ulimit -f $blocks; hci-solve $*"
    (
        ulimit -f "$blocks"
        "$hci_solve" "$@" 2>&1
        echo "exit $?"
    ) | cat >"$work/stderr"
    code=$(sed -n 's/^exit //p' "$work/stderr")
}

failed=0
fitted=0
snapshot "$work/old" >"$work/before"
for blocks in 0 1 $(cd "$work/old/results" && wc -c * | awk '$2 != "total" { print int($1 / 512), int($1 / 512) + 1 }') 10000; do
    for out in "$work/old/results" "$work/old/new/folder"; do
        limited "$blocks" solve data/machine_b --target $target --auto -q -o "$out"
        if [ "$code" -eq 0 ]; then
            fitted=$((fitted + 1))
            check "not all is there" diff -r "$work/pristine/results" "$out"
            rm -rf "$work/old/new"
        else
            failed=$((failed + 1))
            check "exit code $code, expected 5" [ "$code" -eq 5 ]
            says '^hci-solve: .*/[a-z_A-Z]*\.(csv|json|svg): cannot be written: File too large; free some space or name another folder$'
        fi
        snapshot "$work/old" >"$work/after"
        check "older files have changed, or something is left" cmp -s "$work/before" "$work/after"
    done
done
check "no size of a disk was too small, or none large enough: $failed, $fitted" [ $((failed >= 4 && fitted >= 2)) -eq 1 ]
for file in "$work"/pristine/results/*; do
    check "${file##*/} is not what it was" cmp -s "$file" "$work/old/results/${file##*/}"
done

# ---- emit

run 0 solve data/machine_a --target $target --auto -q -o "$work/currents"
mkdir "$work/old/emitted" && echo mine >"$work/old/emitted/t.h" && mkdir "$work/old/emitted/t.c"
snapshot "$work/old" >"$work/before"
run 5 emit "$work/currents" --name t -o "$work/old/emitted"
says 't.c: cannot be written: found a folder'
run 5 emit "$work/currents" --name t -o "$work/old/file"
limited 1 emit "$work/currents" --name u -o "$work/old/emitted"
check "a full disk gives exit code $code" [ "$code" -eq 5 ]
snapshot "$work/old" >"$work/after"
check "older files have changed, or something is left" cmp -s "$work/before" "$work/after"

# ---- standard output that cannot be written

on_stdout() { # WHAT: the exit code in $work/code is 5, and standard error says so
    shown="hci-solve ... $1"
    check "$1: exit code $(cat "$work/code")" [ "$(cat "$work/code")" = 5 ]
    says '^hci-solve: standard output: '
}
cat >"$work/calls" <<CALLS
solve data/machine_a --target $target --auto --json -q
--help
--version
solve --help
CALLS
while read -r words <&3; do
    if [ -w /dev/full ]; then
        # shellcheck disable=SC2086
        "$hci_solve" $words >/dev/full 2>"$work/stderr"
        echo $? >"$work/code"
        on_stdout "$words >/dev/full"
        says 'No space left'
    fi
    # shellcheck disable=SC2086
    "$hci_solve" $words >&- 2>"$work/stderr"
    echo $? >"$work/code"
    on_stdout "$words >&-"
done 3<"$work/calls"

# The reader is gone before the first byte: no error, and the exit code is that of the work.
{
    sleep 0.3
    k=0
    while read -r words <&3; do
        # shellcheck disable=SC2086
        "$hci_solve" $words 2>"$work/stderr.$k"
        echo $? >"$work/code.$k"
        k=$((k + 1))
    done 3<"$work/calls"
} | :
k=0
while read -r words <&3; do
    shown="hci-solve $words | :"
    cp "$work/stderr.$k" "$work/stderr"
    check "exit code $(cat "$work/code.$k")" [ "$(cat "$work/code.$k")" = 0 ]
    nothing_on_stderr
    k=$((k + 1))
done 3<"$work/calls"

# A reader that takes the first byte and goes.
{ "$hci_solve" solve data/machine_a --target $target --auto --json -q 2>/dev/null; echo $? >"$work/code"; } | head -c 1 >/dev/null
check "| head -c 1: exit code $(cat "$work/code")" grep -qx 0 "$work/code"

# Without standard error the results are written all the same; what goes to descriptor 2 is in none of the files.
shown="hci-solve solve ... 2>&-"
"$hci_solve" solve data/machine_a --target $target --auto -o "$work/silent" >/dev/null 2>&-
check "2>&-: exit code $?" [ -s "$work/silent/summary.json" ]
check "2>&-: other results" diff -r "$work/currents" "$work/silent"
"$hci_solve" solve data/machine_a --target $target --auto --json -o "$work/closed" 2>/dev/null >&-
check ">&-: other files" diff -r "$work/currents" "$work/closed"

finish
