#!/bin/sh
# labels: slow
# How often `check` names a slip of convention that was written into correct files, and whether it is quiet on correct ones; see tests/rigs/slips/README.md.
# HCI_SLIPS replaces the options of the score; HCI_SLIPS='--seed 2 --repeat 5 --correct 500' tells more.

options=${HCI_SLIPS:---seed 1 --correct 100 --named 0.95 --false 0}

slips=$1/tests/rigs/slips
build_dir=$2
hci_solve=$3
plain=$build_dir/nested/all/hci-solve # without sanitizers, which take long
[ ! -x "$plain" ] || hci_solve=$plain
command -v python3 >/dev/null 2>&1 || {
    echo "skipped: no python3"
    exit 77
}
"$hci_solve" check --help >/dev/null 2>&1 || {
    echo "skipped: hci-solve has no command check"
    exit 77
}
export PYTHONDONTWRITEBYTECODE=1 # nothing is written beside the sources
python3 "$slips/self_test.py" 8 || exit 1
# shellcheck disable=SC2086
exec python3 "$slips/score.py" "$hci_solve" $options
