#!/bin/sh
# Blobs of `emit --blob`, read by hci/blob.h in a C and a C++ program: the currents of the compiled tables, and nothing that is
# cut off, damaged in a bit, newer or of another kind.
#   emit_blob.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"

command -v cc >/dev/null || { echo "skipped: no cc here"; exit 77; }
cd "$source_dir" || exit 1
run 0 solve data/machine_a --target data/scenarios/02/target.csv --auto --quiet -o "$work/currents"
emit() { # NAME OPTION...
    name=$1
    shift
    run 0 emit "$work/currents" --name "$name" --machine data/machine_a "$@" --blob --quiet -o "$work/tables"
}
emit rows --points 20
options="-std=c11 -O1 -g -Wall -Wextra -Wconversion -Wno-unused-function -fsanitize=address,undefined -fno-sanitize-recover=all -Iinclude -I$work/tables"
for table in 'i16 abc linear' 'i16 abc cubic --per-torque' 'i8 abc linear' 'i8 dq quadratic --per-torque'; do
    # shellcheck disable=SC2086
    set -- $table
    emit small --max-error 0.25 --format "$1" --frame "$2" --shape "$3" ${4:+"$4"} # small: each bit of it is flipped
    # shellcheck disable=SC2086
    check "built: $table" cc $options tests/host/emit/blob/main.c "$work"/tables/rows.c "$work"/tables/small.c -o "$work/program"
    check "blobs: $table" "$work/program" "$work/tables/rows.bin" "$work/tables/small.bin"
done
emit rows --frame dq --per-torque --points 15
# shellcheck disable=SC2086
check 'built' cc $options tests/host/emit/blob/main.c "$work"/tables/rows.c "$work"/tables/small.c -o "$work/program"
check 'rows per torque' "$work/program" "$work/tables/rows.bin" "$work/tables/small.bin"

# Orders for a drive.
cp "$work/tables/rows.bin" "$work/other.bin"
run 0 emit "$work/currents" --name orders --machine data/machine_a --drive data/drive/machine_a_10kHz.csv --blob --quiet -o "$work/tables"
# shellcheck disable=SC2086
check 'built: orders' cc $options tests/host/emit/blob_loop/main.c "$work"/tables/orders.c -o "$work/program"
check 'blob of orders' "$work/program" "$work/tables/orders.bin" "$work/other.bin"
run 0 emit "$work/currents" --name orders --machine data/machine_a --drive data/drive/machine_a_10kHz.csv --quiet -o "$work/tables"
check 'an old blob of orders stays' test ! -e "$work/tables/orders.bin"

# One that an earlier run left holds another table; another maker's drive has none.
run 0 emit "$work/currents" --name rows --quiet -o "$work/tables"
check 'an old blob stays' test ! -e "$work/tables/rows.bin"
run 2 emit "$work/currents" --name rows --blob --for moteus --machine data/machine_a -o "$work/tables"
says '--blob is for hci/table.h'
run 0 emit "$work/currents" --name rows --machine data/machine_a/ --quiet -o "$work/tables"
check 'facts in the header' grep -q 'Motor:  machine_a, 2 pole pairs' "$work/tables/rows.h"
check 'facts in the header' grep -q '^#define rows_PERIODS 2u' "$work/tables/rows.h"
cp -r data/machine_a "$work/warm"
echo 'rated_speed,1500,rpm,nameplate' >>"$work/warm/machine.csv"
printf 'effect,parameter,value,unit,std_error\nmagnet_temperature,emf_per_kelvin,-0.0011,1/K,\nmagnet_temperature,reference,25,C,\n' >"$work/warm/effects.csv"
run 0 emit "$work/currents" --name rows --machine "$work/warm" --quiet -o "$work/tables"
check 'rated speed' grep -q 'rated are 1500 rpm, 2450 Hz' "$work/tables/rows.h"
check 'magnets' grep -q 'that of 25.0 deg C and changes by -0.11 % a kelvin' "$work/tables/rows.h"
run 0 emit "$work/currents" --name rows --machine "$work/warm" --drive data/drive/machine_a_10kHz.csv --quiet -o "$work/tables"
check 'facts for a drive' grep -q 'Motor:  warm, 2 pole pairs' "$work/tables/rows.h"
check 'magnets for a drive' grep -q 'that of 25.0 deg C' "$work/tables/rows.h"
check 'poles for a drive' grep -q '^#define rows_POLE_PAIRS 2u' "$work/tables/rows.h"
finish
