#!/bin/sh
# labels: slow
# FMUs as another program has them: FMPy, which checks the description against the standard's schema and runs the binary
# through its own binding of FMI. Slow: fetches FMPy once, into a folder of the build, and compiles seven FMUs, three seconds
# each. Skipped where Python's venv is missing or FMPy cannot be had.
#   fmu_fmpy.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
use_plain_build
skip() {
    echo "skipped: $*"
    exit 77
}
command -v cc >/dev/null || skip "no cc"
python3 -c 'import ensurepip, venv' 2>/dev/null || skip "python3 has no venv here (scripts/install test)"
venv=$built/nested/fmpy
python=$venv/bin/python
export PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_NO_INPUT=1 PYTHONDONTWRITEBYTECODE=1
if ! "$python" -c 'import fmpy' 2>/dev/null; then
    rm -rf "$venv"
    python3 -m venv "$venv" || skip "no venv"
    "$python" -m pip -q install fmpy >"$work/log" 2>&1 || skip "no FMPy to be had: $(tail -n 1 "$work/log")"
fi
cd "$work" || exit 1

# The functions against the headers of the standard, which FMPy has: the same prototypes, and none is missing.
headers=$("$python" -c 'import os, fmpy; print(os.path.join(os.path.dirname(fmpy.__file__), "c-code"))')
for version in 2 3; do
    cc -std=c99 -Wall -Werror -c -o "fmi$version.o" -I "$source_dir/src" -I "$source_dir/include" -I "$headers" \
        -include "fmi${version}Functions.h" "-DHCI_SRC_FMU_FMI${version}_H" "-DHCI_FMI$version(name)=name" \
        "$source_dir/src/fmu/fmi$version.c" || { echo "FAILED: other prototypes than those of FMI $version"; exit 1; }
done
grep -o 'TYPE *fmi3[A-Za-z0-9]*' "$headers/fmi3Functions.h" | sed 's/TYPE *//' | sort >standard
nm --defined-only fmi3.o | awk '$3 ~ /^fmi3/ { print $3 }' | sort | diff standard - || { echo "FAILED: functions of FMI 3 are missing"; exit 1; }

"$python" "$source_dir/tests/host/fmu/imported.py" "$hci_solve" "$source_dir/data"
