#!/bin/sh
# One allocation of the process fails, ours or that of a library: exit code 4 and nothing written, or the same files.
# tests/faults/every_allocation.py with a stride of 1 tries each; here it is some of them.
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
tries 5 solve "$source_dir/data/machine_a" --target "$scenario/target.csv" --harmonics "$scenario/harmonics.csv"
tries 59 solve "$source_dir/data/machine_a" --target "$scenario/target.csv" --harmonics "$scenario/harmonics.csv" \
    --limit-current 20
finish
