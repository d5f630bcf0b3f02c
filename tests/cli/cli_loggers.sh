#!/bin/sh
# Recordings as two dozen loggers write them are read as they are meant: the model that made them leaves their noise, and time,
# speed, angle, currents and torque are found.
#   cli_loggers.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
command -v python3 >/dev/null 2>&1 || { echo "no python3: skipped"; exit 0; }

python3 "$source_dir/tests/cli/loggers.py" "$work/logs" >"$work/names"
while read -r name; do
    run 0 predict "$work/logs/machine" "$work/logs/$name.csv"
    check "$name: not as meant" awk '$1 == "residual" { found = $2 > 0.003 && $2 < 0.008 } END { exit !found }' "$work/stdout"
    sed 's/not used: `Date`$//; s/not used: `Comment`$//' "$work/stderr" >"$work/remarks"
    check "$name: something is not used" eval "! grep -qE 'not used: |no column is read|slope of the angle' '$work/remarks'"
done <"$work/names"

finish
