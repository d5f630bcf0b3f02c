#!/bin/sh
# A folder of results on a disk that is full while it is replaced, by its bytes or by its number of files: it holds the older results, and
# that is said, or the newer. Skipped where no file system in memory can be mounted.
. "$(dirname "$0")/../support/common.sh"
use_plain_build
cd "$source_dir" || exit 1

alone="unshare --map-root-user --mount"
$alone mount -t tmpfs tmpfs "$work" 2>/dev/null || {
    echo "skipped: no right to mount a file system here"
    exit 77
}

target=data/scenarios/02/target.csv
run 0 solve data/machine_b --target $target --auto -q -o "$work/older"
run 0 emit "$work/older" --name x -q -o "$work/older_table"
run 0 solve data/machine_a --target $target --auto -q -o "$work/currents"
full() { # FOLDER WORD...
    check "a full disk: $2" $alone python3 tests/faults/full_disk.py "$hci_solve" "$@"
}
full "$work/older" solve data/machine_a --target $target --auto
full "$work/older_table" emit "$work/currents" --name x
finish
