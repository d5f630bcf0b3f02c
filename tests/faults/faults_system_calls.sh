#!/bin/sh
# A system call fails: the folder has the new results, or the old ones and words. What could not be read or looked at is never taken for
# a file that is not there. Here some of the places; tests/faults/every_system_call.py with a stride of 1 tries each.
. "$(dirname "$0")/../support/common.sh"
use_plain_build
cd "$source_dir" || exit 1
strace -e trace=none true 2>/dev/null || {
    echo "skipped: no strace here, or no right to use it"
    exit 77
}

target=data/scenarios/02/target.csv
run 0 solve data/machine_b --target $target --auto -q -o "$work/older"
run 0 solve data/machine_a --target $target --auto -q -o "$work/currents"
run 0 emit "$work/older" --name x -q -o "$work/older_table"
fails() { # CALLS STRIDE FOLDER WORD...
    calls=$1 stride=$2 older=$3
    shift 3
    check "system calls: $1" python3 tests/faults/every_system_call.py "$calls:EIO" "$stride" "$hci_solve" "$work/$older" "$@"
}
fails newfstatat 1 older solve data/machine_a --target $target --harmonics data/scenarios/02/harmonics.csv
fails write,close,fsync,rename 4 older solve data/machine_a --target $target --harmonics data/scenarios/02/harmonics.csv
fails read,openat,newfstatat 1 older_table emit "$work/currents" --name x
finish
