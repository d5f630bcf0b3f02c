#!/bin/sh
# What is seen on a terminal, and only there: colour, bars, progress; widths; what --quiet and --json leave; Ctrl-C.
#   cli_terminal.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
cd "$source_dir" || exit 1
python3 -c 'import fcntl, pty, termios; pty.openpty()' 2>/dev/null || { echo "skipped: no pseudo-terminal through python3"; exit 77; }

escape=$(printf '\033')
target=data/scenarios/02/target.csv
unset COLUMNS NO_COLOR LC_CTYPE LANG

# see CODE COLUMNS WORD...: like run, but standard error is a terminal; what it got is in $work/screen. $settings: NAME=VALUE...
# for the program; $keys: options of terminal.py.
see() {
    expected=$1
    columns=$2
    shift 2
    shown="hci-solve $* (on a terminal of $columns columns; ${settings-})"
    checks=$((checks + 1))
    # settings and keys have no blanks or quotes inside
    # shellcheck disable=SC2086
    env TERM=xterm LC_ALL=C.UTF-8 ${settings-} python3 tests/cli/terminal.py "$columns" "$work/screen" "$work/stdout" ${keys-} -- \
        "$hci_solve" "$@" </dev/null
    code=$?
    [ "$code" -eq "$expected" ] || fail "exit code $code, expected $expected"
    # what is left to see: progress is overwritten and erased
    sed "s/^.*$(printf '\r')$escape\[K//" "$work/screen" >"$work/stderr"
}
shows() { # EXPRESSION...: on what is left to see
    says "$@"
}
lacks() { # WHAT EXPRESSION: no line of what the terminal got
    check "$1" eval "! LC_ALL=C grep -q -e '$2' '$work/screen'"
}
# within COLUMNS: no line is longer, escapes not counted, but commands to copy; a character of UTF-8 is one column
within() {
    check "a line is longer than $1 columns" python3 -c '
import re, sys
text = open(sys.argv[1], encoding="utf-8").read()
lines = [re.sub("\x1b\\[[0-9;]*[mK]", "", line) for part in text.split("\n") for line in part.split("\r")]
long = [line for line in lines if len(line) > int(sys.argv[2]) and not line.startswith("    hci-solve ")]
sys.exit("\n".join(long) if long else 0)' "$work/screen" "$1"
}
json() {
    check "not JSON alone on standard output" python3 -c 'import json, sys; json.load(open(sys.argv[1], encoding="utf-8"))' "$work/stdout"
}

# Of each command that draws, one that takes no second.
"$hci_solve" simulate data/machine_a data/drive/driven.csv -q -o "$work/driven" || exit 1
"$hci_solve" solve data/machine_a --target $target -q -o "$work/solved" || exit 1
mkdir "$work/bench"
cp -R data/machine_a "$work/bench/machine"
sed 's/^12,.*/12,0.1,0/' data/machine_a/cogging.csv >"$work/bench/machine/cogging.csv"
printf 'file,role\n../driven/trajectory.csv,fit\n' >"$work/bench/runs.csv"
drawings='solve|data/machine_a --target data/scenarios/02/target.csv
solve|data/machine_b --target data/scenarios/08/target.csv --auto 13
simulate|data/machine_a data/drive/imposed.csv
harmonics|'"$work"'/driven/trajectory.csv --quantity cogging --pole-pairs 2
predict|data/machine_a '"$work"'/driven/trajectory.csv
diagnose|'"$work"'/bench/machine --runs '"$work"'/bench/runs.csv'

# ---- every drawing: widths, ASCII, quiet, JSON, a pipe

echo "$drawings" >"$work/drawings"
while IFS='|' read -r command words <&3; do
    # shellcheck disable=SC2086
    set -- "$command" $words
    LC_ALL=C.UTF-8 "$hci_solve" "$@" >"$work/stdout" 2>"$work/stderr"
    code=$?
    nothing_on_stdout
    check "an escape in a pipe" eval "! grep -q '$escape' '$work/stderr'"
    check "blocks in a pipe" eval "! grep -q '█' '$work/stderr'"
    for columns in 60 80 120; do
        see $code $columns "$@"
        within $columns
        nothing_on_stdout
        shows '█' "$escape\[3[123];1m" '(linear|logarithmic), [0-9]' 'N·m'
    done
    settings=LC_ALL=C see $code 80 "$@"
    shows '##' 'N\*m'
    check "other than ASCII in the locale C" eval "! LC_ALL=C grep -q '[^ -~$escape]' '$work/stderr'"
    see $code 80 "$@" --quiet
    check "--quiet shows something" [ ! -s "$work/screen" ]
    nothing_on_stdout
    see $code 80 "$@" --json
    json
    check "--json shows words" [ ! -s "$work/stderr" ]
    run $code "$@" --json
    json
    nothing_on_stderr
done 3<"$work/drawings"

# ---- when there is colour

set -- solve data/machine_a --target $target
settings=COLUMNS=60 see 0 120 "$@"
within 60
settings=NO_COLOR=1 see 0 80 "$@"
lacks "colour with NO_COLOR" "$escape\[3"
settings=NO_COLOR= see 0 80 "$@"
shows "$escape\[32;1m" # empty is as good as none
settings=TERM=dumb see 0 80 "$@"
lacks "an escape on a dumb terminal" "$escape"
lacks "blocks on a dumb terminal" '█'
see 0 80 "$@" --color never
lacks "colour with --color never" "$escape\[3"
settings=NO_COLOR=1 see 0 80 "$@" --color always
shows "$escape\[32;1m"
run 0 "$@" --color always
says "^$escape\[32;1mreached$escape\[0m: "
run 2 "$@" --color blue
says '--color: found `blue`, expected one of: auto, always, never'
see 0 80 "$@" --json -q
json
check "--json -q shows something" [ ! -s "$work/screen" ]

# ---- commands without a drawing

for words in "emit $work/solved --name t -o $work/emitted" "init mn4004 --poles 24 --kv 300 -o $work/mn4004"; do
    # shellcheck disable=SC2086
    see 0 80 $words --json
    json
    check "--json shows words" [ ! -s "$work/screen" ]
    rm -rf "$work/mn4004"
    # shellcheck disable=SC2086
    see 0 80 $words
    shows "$escape\[32;1m"
    within 80
    rm -rf "$work/mn4004"
    # shellcheck disable=SC2086
    see 0 80 $words --quiet
    check "--quiet shows something" [ ! -s "$work/screen" ]
    rm -rf "$work/mn4004"
done

# ---- the verdict has the colour of what it says; errors and notes theirs

see 0 80 solve data/machine_a --target $target
shows "^$escape\[32;1mreached$escape\[0m: "
see 1 80 solve data/machine_a --target $target --limit-current 1
shows "^$escape\[33;1mreached$escape\[0m, but a limit is not kept: "
see 1 80 solve data/machine_a --target data/scenarios/07/target.csv --harmonics data/scenarios/07/harmonics.csv
shows "^$escape\[31;1mnot reached$escape\[0m "
see 3 80 solve no_such_machine --target $target -q
shows "^$escape\[31;1mhci-solve:$escape\[0m no_such_machine"

# What a name may hold does not drive the terminal.
name=$(printf 'a\033[31mb')
see 3 80 solve "$name" --target $target
lacks "the escape of a name" "$escape\[31mb"

# ---- the baseline is said, and each number has a unit

see 0 120 solve data/machine_a --target $target
shows 'by electrical order, N·m \(peak\); before: the plain fundamental of 11\.[0-9]+ A' '^ +6 1\.1048 (█)+ +0\.0000 0\.0000$'
# a bar is as long as its number: order 24 has 0.3702/1.1048 of 40 blocks, 13 and three eighths
shows '^ +24 0\.3702 (█){13}▍ +0\.0000 0\.0000$'
# on a logarithmic scale from 0.001 to 0.3702 order 12 with 0.3102 has 0.9701 of 40 blocks, 38 and six eighths
see 0 120 harmonics "$work/driven/trajectory.csv" --quantity cogging --pole-pairs 2
shows '^ +12 +0\.3102 .* (█){38}▊$'

# Of thirty orders that are alike twenty are drawn, and the others are told.
{ echo order,amplitude_Nm,phase_rad; echo 0,2,0; seq 6 35 | sed 's/$/,0.1,0/'; } >"$work/thirty.csv"
run 0 solve data/machine_a --target "$work/thirty.csv"
check "rows drawn: $(grep -Ec '^ +[0-9]+ [0-9.]+ .* 0\.[01]' "$work/stderr")" [ "$(grep -Ec '^ +[0-9]+ [0-9.]+ .* 0\.[01]' "$work/stderr")" -eq 20 ]
says '^  and [0-9]+ smaller ones: spectrum.csv$'

# ---- progress: on work longer than a second, with rate and time, and then gone

# scenario SECONDS: one that the machine at hand takes a while for
scenario() {
    printf 'name,value,unit\nduration,%s,s\nprescribed_speed,80,rpm\ntorque_reference,8,Nm\ncurrent_control,hysteresis,\n' "$1"
}
seconds=1
took=0 # ms
while [ "$took" -lt 5000 ]; do
    seconds=$((took < 100 ? seconds * 2 : seconds * 7000 / took + 1))
    scenario $seconds >"$work/long.csv"
    started=$(date +%s%N)
    "$hci_solve" simulate data/machine_c "$work/long.csv" -q || exit 1
    took=$((($(date +%s%N) - started) / 1000000 + 1))
done

progress='simulating [█▏▎▍▌▋▊▉ ]* *[0-9]+ %  [0-9]+:[0-9][0-9], [0-9]+:[0-9][0-9] left  [0-9.]+ s simulated/s'
see 0 80 simulate data/machine_c "$work/long.csv"
check "no progress with bar, share, time and rate" grep -Eq "$progress" "$work/screen"
check "progress is not erased" eval "! grep -q 'simulating' '$work/stderr'"
check "the last thing is not erased" grep -q "$(printf '\r')$escape\[K$escape\[3" "$work/screen"
within 80
tr '\r' '\n' <"$work/screen" | sed -n 's/.* \([0-9]*\) %  .*/\1/p' >"$work/shares"
check "fewer than ten steps of progress" [ "$(wc -l <"$work/shares")" -ge 10 ]
check "the share falls" sort -nc "$work/shares"
# the time that is left is what is left, to a second or a third of it
check "the time that is left is wrong" python3 -c '
import re, sys
seconds = lambda text: 60 * int(text[0]) + int(text[1])
lines = re.findall(r"  (\d+):(\d\d), (\d+):(\d\d) left", open(sys.argv[1], encoding="utf-8").read())
end = seconds(lines[-1][:2])
left = [seconds(line[2:]) for line in lines]
if max(left) < 2 or left[0] <= left[-1]:
    sys.exit("it does not fall: " + str(left))
wrong = [line for line in lines if abs(end - seconds(line[:2]) - seconds(line[2:])) > 1.6 + 0.35 * (end - seconds(line[:2]))]
sys.exit(str(wrong) if len(wrong) > 0.2 * len(lines) else 0)' "$work/screen"
settings=COLUMNS=60 see 0 80 simulate data/machine_c "$work/long.csv"
within 60
settings=LC_ALL=C see 0 80 simulate data/machine_c "$work/long.csv"
check "no progress in ASCII" grep -Eq 'simulating #+ +[0-9]+ %' "$work/screen"
see 0 80 simulate data/machine_c "$work/long.csv" --quiet
check "progress with --quiet" [ ! -s "$work/screen" ]
see 0 80 simulate data/machine_c "$work/long.csv" --json
json
check "no progress with --json on a terminal" grep -Eq "$progress" "$work/screen"
check "progress is not erased" [ ! -s "$work/stderr" ]
settings=TERM=dumb see 0 80 simulate data/machine_c "$work/long.csv"
lacks "progress on a dumb terminal" simulating
run 0 simulate data/machine_c "$work/long.csv"
check "progress in a pipe" eval "! grep -q simulating '$work/stderr'"

# ---- Ctrl-C: a clear line, no files, no folders that were made for them; older results as they were

interrupted() { # FOLDER
    check "the line is not cleared" grep -q "$(printf '\r')$escape\[K\(^C\)*\$" "$work/screen"
    check "left behind: $(ls -A "$1" 2>/dev/null)" [ ! -e "$1" ]
}
scenario 300 >"$work/endless.csv"
keys='--keys simulating \x03'
see 130 80 simulate data/machine_c "$work/endless.csv" -o "$work/made/for/it"
interrupted "$work/made"
mkdir "$work/older"
echo older >"$work/older/summary.json"
see 130 80 simulate data/machine_c "$work/endless.csv" --report -o "$work/older"
check "older results have changed: $(ls -A "$work/older")" [ "$(ls -A "$work/older") $(cat "$work/older/summary.json")" = "summary.json older" ]
keys=

# What ends it without a terminal does the same.
shown="hci-solve simulate, and kill"
"$hci_solve" simulate data/machine_c "$work/endless.csv" -o "$work/killed" 2>"$work/stderr" &
job=$!
tries=300
while [ $tries -gt 0 ] && [ -z "$(ls -A "$work/killed" 2>/dev/null)" ]; do
    sleep 0.1
    tries=$((tries - 1))
done
check "nothing to kill" [ -n "$(ls -A "$work/killed" 2>/dev/null)" ]
kill -TERM $job
wait $job 2>/dev/null
code=$?
check "exit code $code of a program that was ended" [ $code -eq 143 ]
check "left behind: $(ls -A "$work/killed" 2>/dev/null)" [ ! -e "$work/killed" ]
nothing_on_stderr

finish
