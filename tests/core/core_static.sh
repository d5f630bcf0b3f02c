#!/bin/sh
# cppcheck on core and the headers of the table runtime: nothing is found that has no reason in
# scripts/static-analysis.known. `scripts/static-analysis` runs gcc -fanalyzer, clang-tidy and MISRA C too, which take half a minute.
#   core_static.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"

command -v cppcheck >/dev/null || { echo "skipped: no cppcheck here"; exit 77; }

"$source_dir/scripts/static-analysis" cppcheck >"$work/stdout" 2>&1
code=$?
cat "$work/stdout"
check 'nothing without a reason is found' [ "$code" -eq 0 ]

# The check itself: a fault is found, and a reason for nothing.
mkdir -p "$work/tree/src/core"
cp -R "$source_dir/include" "$source_dir/scripts" "$work/tree"
printf 'int fault(int k);\nint fault(int k)\n{\n    int values[2] = {k, k};\n    return values[2];\n}\n' >"$work/tree/src/core/fault.c"
"$work/tree/scripts/static-analysis" cppcheck >"$work/stdout" 2>&1
check 'a fault ends with exit code 1' [ $? -eq 1 ]
says 'cppcheck: found without a reason: src/core/fault.c arrayIndexOutOfBounds' 'cppcheck: has a reason and is not found any more: src/core/machine/torque.c'
finish
