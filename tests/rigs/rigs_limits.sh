#!/bin/sh
# labels: slow
# Currents within limits: wider ones make nothing worse; against clarabel, where python3 has it: some seconds a case.

. "$1/tests/support/common.sh"

python3 "$1/tests/rigs/limits/monotone_check.py" "$hci_solve" "$1" few || fail "a wider limit makes something worse, or costs what is not said"
python3 -c 'import clarabel, numpy, scipy' 2>/dev/null || {
    echo "SKIPPED: python3 has no clarabel, numpy and scipy (pip install clarabel numpy scipy)"
    exit 77
}
python3 "$1/tests/rigs/limits/clarabel_check.py" "$hci_solve" "$1" few || fail "not the optimum of clarabel"
python3 "$1/tests/rigs/limits/prices_check.py" "$hci_solve" "$1" || fail "a limit does not cost what is said"
