#!/bin/sh
# labels: slow
# Currents within limits: wider ones make nothing worse; against clarabel and SciPy, where python3 has them: some seconds a case.

. "$1/tests/support/common.sh"

python3 "$1/tests/rigs/limits/monotone_check.py" "$hci_solve" "$1" few || fail "a wider limit makes something worse, or costs what is not said"
if python3 -c 'import numpy, scipy' 2>/dev/null; then
    python3 "$1/tests/rigs/limits/interior_check.py" "$hci_solve" "$1" --starts 3 --points 4 --envelope 2 || fail "interior magnets: not the optimum of SLSQP"
fi
python3 -c 'import clarabel, numpy, scipy' 2>/dev/null || {
    [ "$failures" -eq 0 ] || finish
    echo "SKIPPED: python3 has no clarabel, numpy and scipy (pip install clarabel numpy scipy)"
    exit 77
}
python3 "$1/tests/rigs/limits/clarabel_check.py" "$hci_solve" "$1" few || fail "not the optimum of clarabel"
python3 "$1/tests/rigs/limits/prices_check.py" "$hci_solve" "$1" || fail "a limit does not cost what is said"
finish
