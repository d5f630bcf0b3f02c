#!/bin/sh
# MISRA C:2012 in all that runs on a microcontroller: the headers, and files that emit writes for them. No finding against a
# mandatory or required rule; a shift and an address stand in the sources as deviations, with the reason. Advisory rules that
# are not kept are listed below.
#   emit_misra.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"

command -v cppcheck >/dev/null || { echo "skipped: no cppcheck here"; exit 77; }
echo 'int x;' >"$work/none.c"
cppcheck --addon=misra --quiet "$work/none.c" >/dev/null 2>&1 || { echo "skipped: this cppcheck has no addon for MISRA C"; exit 77; }

# 2.3, 2.4, 2.5: a header has types and macros that one program does not use. 11.5: blobs are read through pointers to void.
# 12.1: precedence of + and * is not spelled out. 12.3: several members or variables in a declaration. 15.5: checks return
# early. 17.8: parameters are changed. 18.4: pointers move. 19.2: bits of a float by a union.
advisory='2\.3|2\.4|2\.5|11\.5|12\.1|12\.3|15\.5|17\.8|18\.4|19\.2'

run 0 solve "$source_dir/data/machine_a" --target "$source_dir/data/scenarios/02/target.csv" --auto --quiet -o "$work/currents"
run 0 emit "$work/currents" --name form_rows --per-torque --quiet -o "$work/tables"
run 0 emit "$work/currents" --name form_knots --format q15 --quiet -o "$work/tables"
run 0 emit "$work/currents" --name form_orders --machine "$source_dir/data/machine_a" --drive "$source_dir/data/drive/machine_a_10kHz.csv" --quiet -o "$work/tables"

# findings INCLUDE SOURCE...: rules that are broken, one a line.
findings() {
    include=$1
    shift
    cppcheck --addon=misra --std=c99 --quiet --inline-suppr -I"$include" -I"$work/tables" --suppress=missingIncludeSystem \
        --suppress=unusedFunction "$@" 2>&1 | grep -E 'misra-c2012-' | grep -vE "misra-c2012-($advisory)\]"
}
for header in table table_i16 loop guard counter foc blob loop_blob learn; do
    [ -f "$source_dir/include/hci/$header.h" ] || fail "no hci/$header.h"
    echo "#include \"hci/$header.h\""
done >"$work/all.c"
findings "$source_dir/include" "$work/all.c" "$work"/tables/*.c >"$work/found"
cat "$work/found"
check 'no required rule is broken' test ! -s "$work/found"

# The check itself: a header that shifts a signed number is found.
cp -R "$source_dir/include" "$work/include"
sed -i 's|/\* cppcheck-suppress misra-c2012-10.1 \*/||' "$work/include/hci/table_i16.h"
echo '#include "hci/table_i16.h"' >"$work/one.c"
findings "$work/include" "$work/one.c" >"$work/found"
check 'a deviation that is not declared is found' grep -q 'misra-c2012-10.1' "$work/found"
finish
