#!/bin/sh
# Currents, sweeps, simulations, fits and tables of a motor whose currents are 64 times as small, and its torques 4096 times, are those of
# the motor, so many times as small. The factors are powers of two, so that nothing is rounded otherwise.
#   cli_scaled_solved.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
use_plain_build
. "$source_dir/tests/cli/kept_inputs.sh"
cd "$work" || exit 1
cp -r data/machine_c_saturated c && cp $t t.csv && cp data/drive/imposed.csv data/drive/driven.csv data/drive/machine_a_10kHz.csv data/drive/machine_a_currents.csv .
small="0.015625 0.000244140625"
python3 "$source_dir/tests/cli/scaled.py" scale $small . small m c simple t.csv few.csv imposed.csv driven.csv machine_a_currents.csv slow.csv back.csv fast.csv held.csv runs.csv open.csv || exit 1
few='--harmonics few.csv'

# at NAME WORD...: both motors; words such as 12@A are numbers in a unit that goes with the size: A, Nm, V.
words_of() { # A NM V
    sed "s/@A\$/ $1/; s/@Nm\$/ $2/; s/@V\$/ $3/" | awk 'NF == 2 { printf "%.17g ", $1 * $2; next } { printf "%s ", $0 }'
}
at() {
    name=$1
    shift
    large_words=$(printf '%s\n' "$@" | words_of 1 1 1) small_words=$(printf '%s\n' "$@" | words_of $small 0.015625)
    shown="$name: $large_words"
    "$hci_solve" $large_words -q -o "out/$name" >stdout 2>stderr </dev/null || [ $? -eq 1 ] || fail "the motor is refused"
    (cd small && "$hci_solve" $small_words -q -o "out/$name") >stdout 2>stderr </dev/null || [ $? -eq 1 ] || fail "the small motor is refused"
}

at auto solve m --target t.csv --auto --ignore-ratings
at peak solve m --target t.csv $few --limit-current 11.5@A
at rms solve m --target t.csv $few --limit-rms 8@A
at copper solve m --target t.csv $few --limit-copper 1.1x
at link solve m --target t.csv $few --limit-voltage 40@V --speed 1300
at pointwise solve m --target t.csv --method pointwise
at mtpa solve c --target t.csv --method pointwise --strategy mtpa
at saturated solve c --target t.csv --auto
at map sweep m --map --torques 2@Nm --speeds 600 --limit-current 12@A --limit-voltage 40@V $few
at trade sweep m --trade-off --torque 2@Nm --currents 8@A --coppers 1.05,1.2 $few
at imposed simulate m imposed.csv
at driven simulate m driven.csv
at fitted fit simple --runs runs.csv
at cogging harmonics slow.csv --quantity cogging --pole-pairs 2
at back_emf harmonics open.csv --quantity back_emf --pole-pairs 2
shown=
check "results do not go with the size" python3 "$source_dir/tests/cli/scaled.py" compare $small out small/out
finish
