#!/bin/sh
# A batch in shares by GNU parallel, one process a share, and its report.
#   parallel.sh LIST COMMAND SHARES OUT
# HCI_SOLVE names the program. On several computers: --sshloginfile of parallel, and a folder that all of them see.
# Interrupted, the same command goes on. A share that ends with exit code 1 has motors without a result: no reason to stop.
set -eu
list=$1 command=$2 shares=$3 out=$4
program=${HCI_SOLVE:-hci-solve}

parallel --will-cite --jobs "${JOBS:-100%}" --halt soon,fail=1 \
    "$program" batch "$list" --command "$command" --jobs 1 --quiet --shard "{}/$shares" -o "$out/share{}" '||' '[ $? -eq 1 ]' \
    ::: $(seq "$shares")
"$program" fleet "$out"/share* -o "$out/line"
