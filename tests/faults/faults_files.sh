#!/bin/sh
# A folder of results that is replaced: the process is killed before any call that changes the folder, or the call fails.
# The folder holds the older results or the newer. While another process writes into it, it is refused; results of which a
# file is not their own are, too.
. "$(dirname "$0")/../support/common.sh"
use_plain_build
cd "$source_dir" || exit 1

${CC:-cc} -shared -fPIC -O1 -o "$work/faulty_calls.so" tests/faults/faulty_calls.c -ldl || exit 1
run 0 solve data/machine_b --target data/scenarios/02/target.csv --auto -q -o "$work/older"

for older in older none; do
    for mode in kill error; do
        check "$mode, $older" python3 tests/faults/every_call.py "$work/faulty_calls.so" $mode "$hci_solve" "$work/$older" \
            solve data/machine_a --target data/scenarios/02/target.csv --harmonics data/scenarios/02/harmonics.csv
    done
done

cp -R "$work/older" "$work/before"
flock -o "$work/older" sleep 5 &
holder=$!
sleep 0.2
run 5 solve data/machine_a --target data/scenarios/02/target.csv --auto -o "$work/older"
says 'older: cannot be written: another process is writing into it; wait until it has ended, or name another folder$'
check "the folder has changed" diff -r "$work/before" "$work/older"
kill $holder
wait $holder 2>/dev/null
run 0 solve data/machine_a --target data/scenarios/02/target.csv --auto -q -o "$work/older"
# A file of another run among those of this one.
cp "$work/before/currents.csv" "$work/older/currents.csv"
run 3 emit "$work/older" --name x -o "$work/emitted"
says 'older/currents.csv: found a file with the checksum [0-9 ]+, expected [0-9 ]+, as summary.json beside it says'
check "something was emitted" [ ! -e "$work/emitted" ]
run 3 simulate data/machine_a data/drive/imposed.csv --currents "$work/older" -q -o "$work/simulated"
run 0 emit "$work/older/currents.csv" --name x -q -o "$work/emitted"
finish
