#!/bin/sh
# labels: slow
# Whether `check` is quiet on correct machines that are odd, and finds slips on the recordings that people make; see tests/rigs/check_cases/README.md.
# HCI_CHECK_CASES replaces the options of the score; HCI_CHECK_CASES='--seeds 1-9' tells more.
. "$1/tests/support/common.sh"

options=${HCI_CHECK_CASES:---seeds 1-2 --accused 0 --found 0.95}

cases=$source_dir/tests/rigs/check_cases
use_plain_build
command -v python3 >/dev/null 2>&1 || {
    echo "skipped: no python3"
    exit 77
}
export PYTHONDONTWRITEBYTECODE=1 # nothing is written beside the sources
# shellcheck disable=SC2086
python3 "$cases/score.py" "$hci_solve" $options
