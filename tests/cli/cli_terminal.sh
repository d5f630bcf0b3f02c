#!/bin/sh
# What is seen on a terminal, and only there: colour, bars; widths; what --quiet and --json leave. Progress is in cli_interrupt.sh and, with a
# clock of its own, in test_progress.c.
#   cli_terminal.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
. "$1/tests/cli/on_terminal.sh"
cd "$source_dir" || exit 1
target=data/scenarios/02/target.csv

json_on_stdout() {
    check "standard output does not begin as JSON" [ "$(head -c 1 "$work/stdout")" = '{' ]
    cat "$work/stdout" >>"$work/all.json"
    echo , >>"$work/all.json"
}

# Of each command that draws, one that takes no second.
sed 's/^duration,0.4,/duration,0.12,/' data/drive/driven.csv >"$work/driven.csv"
"$hci_solve" simulate data/machine_a "$work/driven.csv" -q -o "$work/driven" || exit 1
mkdir -p "$work/bench/machine"
printf 'name,value,unit\npole_pairs,2,1\n' >"$work/bench/machine/machine.csv"
printf 'order,amplitude_Nm_per_A,phase_rad\n1,0.2,0\n' >"$work/bench/machine/back_emf.csv"
awk 'BEGIN { srand(7); print "time_s,theta_m_rad,speed_rad_per_s,id_A,iq_A,torque_Nm"; p = 6.283185307179586
    for (k = 0; k < 150; ++k) { a = p * k * 3 / 150
        printf "%.12g,%.12g,20,0,1,%.12g\n", a / 20, a, 0.3 + 0.05 * sin(12 * a + 0.3) + 0.004 * sqrt(-2 * log(1 - rand())) * cos(p * rand()) } }' \
    >"$work/bench/run.csv"
printf 'file,role\nrun.csv,fit\n' >"$work/bench/runs.csv"
cat >"$work/drawings" <<DRAWINGS
solve data/machine_a --target data/scenarios/02/target.csv
solve data/machine_b --target data/scenarios/08/target.csv --auto 3
simulate data/machine_a data/drive/imposed.csv
harmonics $work/driven/trajectory.csv --quantity cogging --pole-pairs 2
predict data/machine_a $work/driven/trajectory.csv
diagnose $work/bench/machine --runs $work/bench/runs.csv
DRAWINGS

# ---- every drawing: widths, ASCII, quiet, JSON, a pipe

k=0
while read -r words <&3; do
    k=$((k + 1))
    # none of these words has a blank in it
    # shellcheck disable=SC2086
    set -- $words
    for columns in 60 120; do plan $k.$columns $columns -- "$@"; done
    plan $k.ascii 80 LC_ALL=C -- "$@"
    plan $k.quiet 80 -- "$@" --quiet
    plan $k.json 80 -- "$@" --json
done 3<"$work/drawings"
perform
k=0
while read -r words <&3; do
    k=$((k + 1))
    # shellcheck disable=SC2086
    set -- $words
    LC_ALL=C.UTF-8 "$hci_solve" "$@" >"$work/stdout" 2>"$work/stderr"
    piped=$?
    check "an escape in a pipe" eval "! grep -q '$escape' '$work/stdout' '$work/stderr'"
    check "blocks in a pipe" eval "! grep -q '█' '$work/stdout'"
    for columns in 60 120; do
        seen $piped $k.$columns
        says '█' "$escape\[3[123];1m" '(linear|logarithmic), [0-9]' 'N·m'
    done
    seen $piped $k.ascii
    says '##' 'N\*m'
    check "other than ASCII in the locale C" eval "! LC_ALL=C grep -q '[^ -~$escape]' '$work/stderr'"
    seen $piped $k.quiet
    shows_nothing "--quiet shows something"
    seen $piped $k.json
    json_on_stdout
    shows_nothing "--json shows words"
    cp "$work/stdout" "$work/on_terminal.json"
    run $piped "$@" --json
    nothing_on_stderr
    check "--json is another one on a terminal" cmp -s "$work/stdout" "$work/on_terminal.json"
done 3<"$work/drawings"

# ---- when there is colour; commands without a drawing; the colour of the verdict, of errors and notes; what is drawn

# Of thirty orders that are alike twenty are drawn, and the others are told.
{ echo order,amplitude_Nm,phase_rad; echo 0,2,0; seq 6 35 | sed 's/$/,0.1,0/'; } >"$work/thirty.csv"
"$hci_solve" solve data/machine_a --target $target -q -o "$work/solved" || exit 1
solve="solve data/machine_a --target $target"
# shellcheck disable=SC2086
{
    plan narrow 120 COLUMNS=60 -- $solve
    plan no_color 80 NO_COLOR=1 -- $solve
    plan empty_no_color 80 NO_COLOR= -- $solve
    plan dumb 80 TERM=dumb -- $solve
    plan never 80 -- $solve --color never
    plan always 80 NO_COLOR=1 -- $solve --color always
    plan json_quiet 80 -- $solve --json -q
    plan reached 120 -- $solve
    plan limit 80 -- $solve --method pointwise --limit-current 1
    plan missed 80 -- solve data/machine_a --target data/scenarios/07/target.csv --harmonics data/scenarios/07/harmonics.csv
    plan error 80 -- solve no_such_machine --target $target -q
    # what a name may hold does not drive the terminal
    plan name 80 -- solve "$(printf 'a\033[31mb')" --target $target
    plan logarithmic 120 -- harmonics "$work/driven/trajectory.csv" --quantity cogging --pole-pairs 2
    plan emit.json 80 -- emit "$work/solved" --name t -o "$work/emitted" --json
    plan emit 80 -- emit "$work/solved" --name t -o "$work/emitted"
    plan emit.quiet 80 -- emit "$work/solved" --name t -o "$work/emitted" --quiet
    plan init.json 80 -- init mn4004 --poles 24 --kv 300 -o "$work/mn4004_1" --json
    plan init 80 -- init mn4004 --poles 24 --kv 300 -o "$work/mn4004_2"
    plan init.quiet 80 -- init mn4004 --poles 24 --kv 300 -o "$work/mn4004_3" --quiet
}
perform
seen 0 narrow
seen 0 no_color
lacks "colour with NO_COLOR" "$escape\[3"
seen 0 empty_no_color
says "$escape\[32;1m" # empty is as good as none
seen 0 dumb
lacks "an escape on a dumb terminal" "$escape"
lacks "blocks on a dumb terminal" '█'
seen 0 never
lacks "colour with --color never" "$escape\[3"
seen 0 always
says "$escape\[32;1m"
seen 0 json_quiet
json_on_stdout
shows_nothing "--json -q shows something"
# shellcheck disable=SC2086
run 0 $solve --color always
says "^$escape\[32;1mreached$escape\[0m: "
# shellcheck disable=SC2086
run 2 $solve --color blue
says '--color: found `blue`, expected one of: auto, always, never'
for command in emit init; do
    seen 0 $command.json
    json_on_stdout
    shows_nothing "--json shows words"
    seen 0 $command
    says "$escape\[32;1m"
    seen 0 $command.quiet
    shows_nothing "--quiet shows something"
done
seen 1 limit
says "^$escape\[33;1mreached$escape\[0m, but a limit is not kept: "
seen 1 missed
says "^$escape\[31;1mnot reached$escape\[0m "
seen 3 error
says "^$escape\[31;1mhci-solve:$escape\[0m no_such_machine"
seen 3 name
lacks "the escape of a name" "$escape\[31mb"

# The baseline is said, and each number has a unit. A bar is as long as its number: order 24 has 0.3702/1.1048 of 40 blocks, 13 and
# three eighths.
seen 0 reached
says "^$escape\[32;1mreached$escape\[0m: " 'by electrical order, N·m \(peak\); before: the plain fundamental of 11\.[0-9]+ A' \
    '^ +6 1\.1048 (█)+ +0\.0000 0\.0000$' '^ +24 0\.3702 (█){13}▍ +0\.0000 0\.0000$'
# On a logarithmic scale from 0.001 to 0.3702 order 12 with 0.3102 has 0.9701 of 40 blocks, 38 and six eighths.
seen 0 logarithmic
says '^ +12 +0\.3102 .* (█){38}▊$'

run 0 solve data/machine_a --target "$work/thirty.csv"
rows=$(grep -Ec '^ +[0-9]+ [0-9.]+ .* 0\.[01]' "$work/stdout")
check "rows drawn: $rows" [ "$rows" -eq 20 ]
says '^  and [0-9]+ smaller ones: spectrum.csv$'

echo "$(cat "$work/all.json") null" | sed '1s/^/[/; $s/$/]/' >"$work/list.json"
check "not JSON" python3 -m json.tool "$work/list.json" "$work/tool.json"

finish
