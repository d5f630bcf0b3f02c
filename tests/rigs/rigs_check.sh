#!/bin/sh
# labels: slow
# How often `check` names a slip of convention that was written into correct files, and whether it is quiet on correct ones; see tests/rigs/slips/README.md.
# HCI_SLIPS replaces the options of the score; HCI_SLIPS='--seed 2 --repeat 5 --correct 500' tells more.
. "$1/tests/support/common.sh"

options=${HCI_SLIPS:---seed 1 --correct 100 --named 0.95 --false 0}

slips=$source_dir/tests/rigs/slips
use_plain_build
command -v python3 >/dev/null 2>&1 || {
    echo "skipped: no python3"
    exit 77
}
export PYTHONDONTWRITEBYTECODE=1 # nothing is written beside the sources
python3 "$slips/self_test.py" 8 || exit 1
# shellcheck disable=SC2086
python3 "$slips/score.py" "$hci_solve" $options
