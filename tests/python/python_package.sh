#!/bin/sh
# labels: slow
# The Python package as a user has it: a wheel, installed into a clean environment, and its own tests, which know the package
# and the program alone. Slow, since it compiles the library once more and fetches packages. Skipped where Python's venv or
# headers are missing, or no packages can be had.
#   python_package.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
set -eu
source_dir=$(cd "$1" && pwd)
build=$(cd "$2" && pwd)/nested/python
program=$3
mkdir -p "$build"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

skip() {
    echo "skipped: $*"
    exit 77
}

# Quiet, unless it fails.
quietly() {
    "$@" >"$work/log" 2>&1 || { cat "$work/log"; echo "python_package: $1 failed"; exit 1; }
}

python3 -c 'import ensurepip, venv' 2>/dev/null || skip "python3 has no venv here (scripts/install test)"
python3 -c 'import os, sysconfig; os.stat(sysconfig.get_path("include") + "/Python.h")' 2>/dev/null || skip "no headers of Python"
python3 -m venv "$work/venv"
python=$work/venv/bin/python
unset PYTHONDONTWRITEBYTECODE # what is used is compiled once, what is not never; nothing of it in the sources
export PYTHONPYCACHEPREFIX=$work/pycache
export PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_NO_INPUT=1
$python -m pip -q install --no-compile "scikit-build-core>=0.10" cffi >"$work/log" 2>&1 || skip "no packages to be had: $(tail -n 1 "$work/log")"
# Those of the extra `test`, apart from the wheel, so that a failure below is one of the package.
$python -m pip -q install --no-compile numpy pytest matplotlib pandas polars scipy tqdm nbclient nbformat ipykernel mypy >"$work/log" 2>&1 ||
    skip "no packages to be had: $(tail -n 1 "$work/log")"

export CMAKE_BUILD_PARALLEL_LEVEL=2
# ccache has the objects from build/dev/nested/all, which has the same flags. Python would name its own compiler; and ccache tells
# variables that are set to nothing, as `ctest --build-and-test` leaves them, from those that are not.
export CC="${CC:-cc}"
! command -v ccache >/dev/null || export CMAKE_C_COMPILER_LAUNCHER=ccache
LC_ALL=${LC_ALL-} LC_MESSAGES=${LC_MESSAGES-} quietly $python -m pip wheel --no-deps --no-build-isolation --config-settings=build-dir="$build" \
    --config-settings=cmake.define.HCI_WERROR=ON -w "$work/dist" "$source_dir"
quietly $python -m pip install --no-index "$work"/dist/hci-*.whl
cd "$work"
echo "wheel: $(wc -c <"$(echo dist/hci-*.whl)") bytes"
$python - <<'END'
import time

began = time.perf_counter()
import numpy
between = time.perf_counter()
import hci

print(f"import hci {hci.__version__}: {time.perf_counter() - between:.3f} s after numpy's {between - began:.3f} s")
END
(cd "$source_dir/python" && quietly $python -m mypy --strict --ignore-missing-imports --cache-dir "$work/mypy" hci)
[ "$("$work/venv/bin/hci-solve" --version)" = "$("$program" --version)" ] || { echo "python_package: no hci-solve in the wheel"; exit 1; }
HCI_SOLVE=$program HCI_DATA=$source_dir/data MPLBACKEND=Agg IPYTHONDIR=$work/ipython \
    $python -m pytest -q -p no:cacheprovider --durations=3 "$source_dir/python/tests"
