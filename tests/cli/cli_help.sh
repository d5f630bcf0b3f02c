#!/bin/sh
# Help, version, and what is said to a wrong command line.
#   cli_help.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"

# A folder in which the examples find data/ and may write out/.
mkdir "$work/here" && ln -s "$source_dir/data" "$work/here/data" && cd "$work/here" || exit 1

run 0 --help
nothing_on_stderr
cp "$work/stdout" "$work/usage"
commands=$(sed -n 's/^  \([a-z-]*\)  .*/\1/p' "$work/usage")
check "no commands in the help" [ -n "$commands" ]
# shellcheck disable=SC2086
commands=$(echo $commands)
check "not in the order in which one uses them: $commands" \
    [ "$(echo "$commands" | sed 's/ check / /')" = "tune init harmonics solve sweep emit simulate export-fmu predict diagnose fit batch fleet" ]
for words in 'hci-solve init .* -o out/' 'hci-solve help COMMAND' 'Documentation: man hci-solve'; do
    check "the help lacks: $words" grep -q -e "$words" "$work/usage"
done
for word in -h help; do
    run 0 "$word"
    check "$word differs from --help" cmp -s "$work/stdout" "$work/usage"
done

version=$(sed -n 's/^#define HCI_VERSION_STRING *"\(.*\)"/\1/p' "$source_dir/include/hci/version.h" "$2/include/hci/version.h" 2>/dev/null |
    head -n 1)
run 0 -V
cp "$work/stdout" "$work/version"
run 0 --version
nothing_on_stderr
check "-V differs from --version" cmp -s "$work/stdout" "$work/version"
check "not a version" grep -Eq '^hci-solve [0-9]+\.[0-9]+\.[0-9]+$' "$work/stdout"
[ -z "$version" ] || check "not the version of the header" grep -Fqx "hci-solve $version" "$work/stdout"

# ---- each command's help; its examples are run in cli_examples.sh

for command in $commands; do
    run 0 "$command" --help
    nothing_on_stderr
    cp "$work/stdout" "$work/help"
    run 0 "$command" no_such_machine -h
    check "-h differs from --help" cmp -s "$work/stdout" "$work/help"
    run 0 help "$command"
    check "help $command differs from --help" cmp -s "$work/stdout" "$work/help"
    check "help of $command does not name its exit codes" grep -q '^Exit codes: 0' "$work/help"
    check "help of $command has no example" grep -q "^  hci-solve $command " "$work/help"
    check "help of $command does not say what is written" grep -Eq '^Writes |changes nothing' "$work/help"
    sed -n '/^Options of every command/,/^$/p' "$work/help" >"$work/common"
    [ -s "$work/every" ] || cp "$work/common" "$work/every"
    check "the options of every command are other ones, or in other words, in $command" \
        eval "sed 's/  */ /g' '$work/common' | tr '\n' ' ' | tr -s ' ' >'$work/a'; sed 's/  */ /g' '$work/every' | tr '\n' ' ' | tr -s ' ' | cmp -s - '$work/a'"
    COLUMNS=60 "$hci_solve" "$command" --help >"$work/narrow"
    check "help of $command is wider than 60 columns" \
        eval "! sed '/^Example/,/^\$/d;1d;/order,amplitude_Nm,phase_rad/d' '$work/narrow' | grep -q '.\{61\}'" # one word
    # what the help lists is understood: the first unknown option is the one after them all
    options=$(sed -n '/^Example/q;s/^  [ -][ a-z][ ,] \(--[a-z-]*\) \([A-Z]\{0,1\}\).*/\1=\2/p' "$work/help" | sed '/^--help=/d;s/=$//')
    check "fewer options than every command has: $options" [ "$(echo "$options" | wc -l)" -ge 3 ]
    # shellcheck disable=SC2086
    run 2 "$command" $options --not-of-the-help
    says 'unknown option `--not-of-the-help`'
done

# ---- wrong command lines: exit code 2, the word and a remedy on standard error, nothing on standard output

wrong() {
    expression=$1
    shift
    run 2 "$@"
    nothing_on_stdout
    says "$expression"
}

target=data/scenarios/02/target.csv
set=data/scenarios/02/harmonics.csv

wrong 'COMMAND' # no word at all: the usage
wrong 'unknown command `sovle`; did you mean `solve`\? ' sovle
says 'hci-solve help COMMAND'
check "a mistyped command is answered with a page" [ "$(wc -l <"$work/stderr")" -eq 1 ]
wrong 'did you mean `simulate`\?' simulat
wrong 'did you mean `simulate`\?' help simulat
wrong 'unknown command `xyzzy`; hci-solve --help' xyzzy
wrong 'found the option `--bogus` in place of a command, expected one first' --bogus
wrong 'found 0 words, expected 1: MACHINE --target FILE; see hci-solve solve --help' solve
wrong 'found 2 words, expected 1' solve data/machine_a data/machine_b --target $target
wrong 'solve: found an empty word, expected MACHINE --target FILE; is a variable of the shell not set\?' solve "" --target $target
wrong '--speed: found `1,5`, expected a number from .*; write a decimal point in place of the comma' solve data/machine_a --target $target --speed 1,5
wrong 'unknown option `--bogus`; see hci-solve solve --help' solve data/machine_a --bogus
wrong 'unknown option `--targe`; did you mean `--target`\? see hci-solve solve --help' solve data/machine_a --targe $target
wrong 'unknown option `--targets=x`; did you mean `--target`' solve data/machine_a --targets=x
wrong 'unknown option `--tagret`; did you mean `--target`' solve data/machine_a --tagret $target # neighbours swapped
wrong 'unknown option `--harm`; did you mean `--harmonics`' solve data/machine_a --harm x        # a beginning
wrong 'unknown option `--outt=x`; did you mean `--out`' simulate data/machine_a --outt=x
wrong 'unknown option `-x`' solve data/machine_a -x
wrong 'unknown option `-qx`' solve data/machine_a --target $target -qx
wrong '`--target` needs a value: FILE' solve data/machine_a --target
wrong '`-o` needs a value: FOLDER' solve data/machine_a --target $target -o
wrong '`-o` needs a value: FOLDER; found the option `--report`; a path of that name is written ./--report' solve data/machine_a --target $target -o --report
check "a folder of the name of an option" [ ! -e ./--report ]
wrong 'found more than 1024 words' check data/machine_a $(seq 1100)
wrong 'is given more than 72 times' check data/machine_a $(seq -f '--column=x=y%g' 80)
wrong '`--target` is given twice' solve data/machine_a --target $target --target $target
wrong '`--out=x` is given twice' solve data/machine_a --target $target -o "$work/x" --out=x
wrong '`--json=yes` takes no value' solve data/machine_a --target $target --json=yes
wrong 'add --target FILE' solve data/machine_a
wrong '--method: found `gauss`, expected one of: auto, lu' solve data/machine_a --target $target --method gauss
wrong '--compare: found `some`, expected one of: all, square' solve data/machine_a --target $target --harmonics $set --compare some
for number in 0 -1 2 nan inf abc '' 1,5 '1 2' 0x1p-3; do
    wrong "--tolerance: found \`$number\`, expected a number" solve data/machine_a --target $target --tolerance "$number"
done
for number in 0 -3 x 1e9 '' 1.5; do
    wrong "--auto: found \`$number\`, expected" solve data/machine_a --target $target --auto="$number"
done
wrong '--max-loss: found `0.9`' solve data/machine_a --target $target --auto 9 --max-loss 0.9
for pair in 12 '' , 12, ,0.2 x,0.2 12,x nan,0 12,inf 12,0.2,3 '12;0.2' '12 0.2'; do
    wrong "--fundamental: found \`$pair\`, expected .* such as 12,0.2" solve data/machine_a --target $target --fundamental "$pair"
done
wrong 'leave out --auto' solve data/machine_a --target $target --harmonics $set --auto
wrong '--harmonics.*pointwise' solve data/machine_a --target $target --harmonics $set --method pointwise
wrong '--auto.*leave out --method' solve data/machine_a --target $target --auto --method qr
wrong '--harmonics FILE' solve data/machine_a --target $target --method lu
wrong '--harmonics FILE' solve data/machine_a --target $target --compare square
wrong 'pointwise.*cannot hold the fundamental' solve data/machine_a --target $target --method pointwise --fundamental 12,0.2
wrong 'square system.*--method qr' solve data/machine_a --target $target --harmonics $set --method umfpack
wrong '--limit-voltage and --speed go together' solve data/machine_a --target $target --limit-voltage 300
wrong '--limit-voltage and --speed go together' solve data/machine_a --target $target --speed 300
for current in 0 -3 a=-1 a=x d=3 12,13 a=1,a=2 '' 12, a= 1e10; do
    wrong "--limit-current: found \`$current\`, expected a peak above 0 A" solve data/machine_a --target $target --limit-current "$current"
done
for current in 0 a=0 -3 x; do
    wrong "--limit-rms: found \`$current\`, expected a rms current above 0 A" solve data/machine_a --target $target --limit-rms "$current"
done
for loss in 0 -3 x 1.2y x ''; do
    wrong "--limit-copper: found \`$loss\`, expected a copper loss above 0 W" solve data/machine_a --target $target --limit-copper "$loss"
done
wrong 'two phases are limited to 0 A, and a star' solve data/machine_a --target $target --limit-current a=0,c=0 -o "$work/x"
wrong 'all three phases are limited to 0 A' solve data/machine_a --target $target --limit-current a=0,b=0,c=0 -o "$work/x"
wrong 'phase a carries no current, but a fundamental' solve data/machine_a --target $target --fundamental 12,0.2 --limit-current a=0
wrong '--dead-time and --pwm-frequency go together' solve data/machine_c --target $target --speed 80 --dead-time 1e-6
wrong '--voltage-reserve .* add --speed' solve data/machine_c --target $target --voltage-reserve 0.1
wrong 'reserve and dead time take 1\.4' solve data/machine_c --target $target --speed 80 --voltage-reserve 0.4 --dead-time 5e-4 --pwm-frequency 1000
wrong '--minimise: found `least`' solve data/machine_a --target $target --minimise least
wrong '--minimise is of sets' solve data/machine_a --target $target --minimise rms --method pointwise
wrong 'unless machine.csv has a `dc_link_voltage`' solve data/machine_c --target $target --speed 80 --ignore-ratings

currents=data/example_currents/currents.csv
wrong 'add --name ID' emit $currents
for name in 1x 'a b' a-b '' '../x' 'ä'; do
    wrong "name.*C identifier|C identifier.*name" emit $currents --name "$name" -o "$work/emitted"
done
wrong '--points or --max-error, not both' emit $currents --name t --points 9 --max-error 0.1
for number in 0 -1 1.5 x 1e9; do
    wrong "--points: found \`$number\`, expected" emit $currents --name t --points "$number"
done
wrong '--frame: found `xyz`, expected one of: abc, dq' emit $currents --name t --frame xyz
wrong '--format: found `q31`, expected one of: f32, i16, q15' emit $currents --name t --format q31 -o "$work/emitted"
wrong '`cubic` with format `f32`.*use format `i16`' emit $currents --name t --shape cubic -o "$work/emitted"
wrong 'instructions: found at most 20, but a linear table' emit $currents --name t --format q15 --max-instructions 20 -o "$work/emitted"
wrong '--reference-torque goes with --per-torque' emit $currents --name t --reference-torque 2
wrong '--per-torque needs the folder' emit $currents --name t --per-torque
check "a wrong command line has written" [ ! -e "$work/emitted" ] && check "a wrong command line has written" [ ! -e "$work/x" ]

# ---- with --json an error is an object on standard output too

# error_has CODE FIELD...: a call that fails has said each of these lines on standard output.
error_has() {
    for field; do check "the error lacks: $field" grep -Fq "$(printf '\t\t%s' "$field")" "$work/stdout"; done
}
run 2 sovle --json
error_has '"exit_code":	2,' '"message":	"unknown command `sovle`; did you mean `solve`?'
run 2 solve data/machine_a --target $target --json --tolerance 9
error_has '"exit_code":	2,' '"message":	"--tolerance: found `9`, expected a number'
printf 'order,amplitude_Nm,phase_rad\n0,2,0\n6,x,0\n' >"$work/a: b.csv"
run 3 solve data/machine_a --target "$work/a: b.csv" --json -q
error_has '"exit_code":	3,' "\"file\":	\"$work/a: b.csv\"," '"line":	3,' '"column":	2,' '"column_name":	"amplitude_Nm",' '"remedy":	"'
run 3 solve no_such_machine --target $target --json
error_has '"file":	"no_such_machine",'
run 5 solve data/machine_a --target $target --json -o "$work/a: b.csv/x"
error_has '"exit_code":	5,'

# ---- - is standard input

piped() { # WORD...: the program reads the file $input
    shown="hci-solve $* <$input"
    "$hci_solve" "$@" <"$input" >"$work/stdout" 2>"$work/stderr"
    code=$?
    check "exit code $code" [ "$code" -eq 0 ]
    streams_are_kept
}
input=$target
piped solve data/machine_a --target - --json
cp "$work/stdout" "$work/piped"
run 0 solve data/machine_a --target $target --json
check "--target - is another one" cmp -s "$work/stdout" "$work/piped"
run 0 simulate data/machine_a data/drive/imposed.csv -q -o "$work/run"
input=$work/run/trajectory.csv
for words in 'harmonics RUN --quantity cogging --pole-pairs 2' 'predict data/machine_a RUN' 'check data/machine_a RUN'; do
    # shellcheck disable=SC2046
    piped $(echo "$words" | sed 's/RUN/-/') --json
    sed "s|$input|-|" "$work/stdout" >"$work/piped"
    # shellcheck disable=SC2046
    run 0 $(echo "$words" | sed "s|RUN|$input|") --json
    check "$words is another one" eval "sed 's|$input|-|' '$work/stdout' | cmp -s - '$work/piped'"
done

# ---- right ones that look odd

run 0 solve --target=$target --quiet data/machine_a --auto
run 0 solve -q --auto 13 --tolerance 0.9 --target $target -- data/machine_a
run 3 solve --target $target -- --help-me
says '^hci-solve: --help-me: '

finish
