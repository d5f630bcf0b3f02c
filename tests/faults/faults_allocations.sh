#!/bin/sh
# One allocation of the process fails, ours or that of a library: exit code 4 and nothing written, or the same files.
# tests/faults/every_allocation.py with a stride of 1 tries each; here it is some of them, and of `batch` and `sweep` those
# at which a row or a point once became another one without a word, or another
# process was blamed.
. "$(dirname "$0")/../support/common.sh"
use_plain_build
export hci_solve

${CC:-cc} -shared -fPIC -O1 -o "$work/failing_malloc.so" "$source_dir/tests/faults/failing_malloc.c" || exit 1

# tries STRIDE WORD...
tries() {
    stride=$1
    shift
    shown="hci-solve $*"
    check "every allocation" python3 "$source_dir/tests/faults/every_allocation.py" "$work/failing_malloc.so" "$stride" \
        "$hci_solve" "$@"
}

scenario=$source_dir/data/scenarios/02
tries 7 solve "$source_dir/data/machine_a" --target "$scenario/target.csv" --harmonics "$scenario/harmonics.csv"
tries 97 solve "$source_dir/data/machine_a" --target "$scenario/target.csv" --harmonics "$scenario/harmonics.csv" \
    --limit-current 20
# The digest of a machine with effects.csv, and names of columns beside a log, were left out without a word.
tries 1:80 solve "$source_dir/data/machine_c_saturated" --target "$scenario/target.csv"
mkdir "$work/log"
"$hci_solve" simulate "$source_dir/data/machine_a" "$source_dir/data/drive/driven.csv" -q -o "$work/driven" || fail "simulate"
sed 's/torque_Nm/brake/' "$work/driven/trajectory.csv" >"$work/log/trajectory.csv"
printf 'name,column\ntorque_Nm,brake\n' >"$work/log/columns.csv"
tries 1 predict "$source_dir/data/machine_a" "$work/log/trajectory.csv"
tries 2400 batch "$source_dir/data/fleet/motors.csv" --command solve -j 1
tries 3:45 batch "$source_dir/data/fleet/motors.csv" --command solve -j 1
tries 900 sweep "$source_dir/data/machine_a" --map --torques 1,2 --speeds 0 --limit-current 20 -j 1
finish
