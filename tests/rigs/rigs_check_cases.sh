#!/bin/sh
# labels: slow
# Whether `check` is quiet on correct machines that are odd, and finds slips on the recordings that people make; see tests/rigs/check_cases/README.md.
# HCI_CHECK_CASES replaces the options of the score; HCI_CHECK_CASES='--seeds 1-9' tells more.

options=${HCI_CHECK_CASES:---seeds 1-2 --accused 0 --found 0.95}

cases=$1/tests/rigs/check_cases
build_dir=$2
hci_solve=$3
plain=$build_dir/nested/all/hci-solve # without sanitizers, which take long
[ ! -x "$plain" ] || hci_solve=$plain
command -v python3 >/dev/null 2>&1 || {
    echo "skipped: no python3"
    exit 77
}
export PYTHONDONTWRITEBYTECODE=1 # nothing is written beside the sources
# shellcheck disable=SC2086
exec python3 "$cases/score.py" "$hci_solve" $options
