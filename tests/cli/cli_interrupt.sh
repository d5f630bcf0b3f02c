#!/bin/sh
# labels: slow
# Progress, and Ctrl-C as soon as there is some: a clear line, no files, no folders that were made for them; older results as they were.
# Without a terminal the same, and no progress.
# Slow because progress is shown from the first second on only, and two simulations and a search have to run so long.
#   cli_interrupt.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
. "$1/tests/cli/on_terminal.sh"
cd "$source_dir" || exit 1

printf 'name,value,unit\nduration,300,s\nprescribed_speed,80,rpm\ntorque_reference,8,Nm\ncurrent_control,hysteresis,\n' \
    >"$work/endless.csv"
endless="simulate data/machine_c $work/endless.csv"
mkdir "$work/older"
echo older >"$work/older/summary.json"
keys='simulating.*s simulated/s>\x03'
# shellcheck disable=SC2086
{
    plan made 80 -- $endless -o "$work/made/for/it"
    plan older 80 LC_ALL=C -- $endless --json --report -o "$work/older"
}
# A search that would go on for half a minute: each recording four times, and small effects asked for.
mkdir "$work/recorded"
echo file,role >"$work/recorded/runs.csv"
for copy in 1 2 3 4; do
    cp -R data/fem_c/runs "$work/recorded/$copy"
    sed "1d; s|^runs/|$copy/|" data/fem_c/runs.csv >>"$work/recorded/runs.csv"
done
keys='looking for effects>\x03'
plan early 80 -- diagnose data/fem_c/machine --runs "$work/recorded/runs.csv" --work 30 --resolution 0.001 -o "$work/early"
keys=
perform
interrupted() {
    check "the line is not cleared" grep -q "$(printf '\r')$escape\[K\(^C\)*\$" "$screen"
}
seen 130 made
interrupted
check "no progress with bar, share, time and rate" grep -Eq 'simulating [█▏▎▍▌▋▊▉ ]* *[0-9]+ %  [0-9]+:[0-9][0-9].*  [0-9.]+ s simulated/s' "$screen"
check "left behind: $(ls -A "$work/made" 2>/dev/null)" [ ! -e "$work/made" ]
seen 130 older
interrupted
check "no progress with --json, in ASCII" grep -Eq 'simulating #* +[0-9]+ %' "$screen"
check "older results have changed: $(ls -A "$work/older")" [ "$(ls -A "$work/older") $(cat "$work/older/summary.json")" = "summary.json older" ]

# A search that Ctrl-C ends writes what it has, and says so.
seen 130 early
check "files: $(ls "$work/early")" [ "$(ls "$work/early" | tr '\n' ' ')" = "declared effects.csv errors.csv machine measure_next.csv report.html residual_spectrum.csv summary.json " ]
check "summary.json does not say that it was interrupted" grep -q '"search":[[:space:]]*"interrupted"' "$work/early/summary.json"
check "the words do not say it" grep -q 'The search was interrupted' "$work/early/summary.json"
check "the report does not say it" grep -q 'The search was interrupted' "$work/early/report.html"

shown="hci-solve simulate, and kill"
# shellcheck disable=SC2086
"$hci_solve" $endless -o "$work/killed" 2>"$work/stderr" &
job=$!
while [ -z "$(ls -A "$work/killed" 2>/dev/null)" ] && kill -0 $job 2>/dev/null; do sleep 0.1; done
check "nothing to kill" [ -n "$(ls -A "$work/killed" 2>/dev/null)" ]
kill -TERM $job
wait $job 2>/dev/null
code=$?
check "exit code $code of a program that was ended" [ $code -eq 143 ]
check "left behind: $(ls -A "$work/killed" 2>/dev/null)" [ ! -e "$work/killed" ]
nothing_on_stderr

finish
