#!/bin/sh
# A folder of results that is replaced: the process is killed before any call that changes the folder, or the call fails, or it is
# killed at random times (tests/faults/random_kills.py; a commit lasts a small part of a run).
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

# Folders within a folder: of a diagnosis with new currents these were the older ones, or none, beside the newer findings.
run 0 simulate data/machine_a data/drive/driven.csv -q -o "$work/driven"
awk 'NR == 1 || NR % 32 == 0' "$work/driven/trajectory.csv" >"$work/driven/thinned.csv" # some 400 runs of it: what counts is what it writes
printf 'file,role\ndriven/thinned.csv,fit\n' >"$work/runs.csv"
printf 'order,amplitude_Nm,phase_rad\n0,1,1.5707963267948966\n' >"$work/target.csv"
diagnose="diagnose data/machine_a --runs $work/runs.csv"
run 0 $diagnose --target "$work/target.csv" -q -o "$work/older_diagnosis"
for mode in kill error; do
    check "$mode, diagnose" python3 tests/faults/every_call.py "$work/faulty_calls.so" $mode "$hci_solve" "$work/older_diagnosis" \
        $diagnose --target data/scenarios/02/target.csv
done
check "killed at random" python3 tests/faults/random_kills.py 20 1 "$hci_solve" "$work/older_diagnosis" $diagnose --target data/scenarios/02/target.csv

# tune writes step by step: into a new folder, or with its older results set aside.
tune="tune $work/driven/trajectory.csv --pole-pairs 2"
run 0 $tune --kv 40 -q -o "$work/older_tuning"
for older in none older_tuning; do
    check "tune killed at random, $older" python3 tests/faults/random_kills.py 5 2 "$hci_solve" "$work/$older" $tune --kv 39
done

# Two of them at once: the second could take the files of the first away, which had ended with exit code 0.
check "two of tune" python3 tests/faults/two_writers.py 6 5 "$hci_solve" "$work/older_tuning" $tune --kv 39 -- $tune --kv 41
check "tune beside another one" python3 - "$work" "$hci_solve" $tune --kv 39 <<'PYTHON'
import fcntl, subprocess, sys
with open(sys.argv[1] + "/.older_tuning.lock", "w") as lock:
    fcntl.lockf(lock, fcntl.LOCK_EX)
    ended = subprocess.run([*sys.argv[2:], "-o", sys.argv[1] + "/older_tuning"], capture_output=True, text=True)
words = "older_tuning: another process is writing into it; wait until it has ended, or name another folder"
sys.exit(not (ended.returncode == 5 and words in ended.stderr))
PYTHON
# The file that is left there locks nothing, and goes with the next call.
check "no file to take over" [ -f "$work/.older_tuning.lock" ]
run 0 $tune --kv 39 -q -o "$work/older_tuning"
check "the lock is left" [ ! -e "$work/.older_tuning.lock" ]

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
