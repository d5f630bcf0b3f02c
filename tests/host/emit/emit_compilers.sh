#!/bin/sh
# Emitted files under every compiler at hand, strictest warnings first: C99, and inside a C++ program that runs them.
#   emit_compilers.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
set -eu
export LC_ALL=C

source=$1 work=$2/emitted hci_solve=$3
fail() {
    echo "emit_compilers: $*" >&2
    exit 1
}

rm -rf "$work"
mkdir -p "$work"
cd "$source"
"$hci_solve" solve data/machine_a --target data/scenarios/02/target.csv --auto --quiet -o "$work/currents"
emit_all() {
    "$hci_solve" emit "$work/currents" --name form_abc --frame abc --points 100 --quiet -o "$1"
    "$hci_solve" emit "$work/currents" --name form_dq --frame dq --max-error 0.1 --quiet -o "$1"
    "$hci_solve" emit "$work/currents" --name form_torque --frame abc --per-torque --quiet -o "$1"
    "$hci_solve" emit "$work/currents" --name form_drive --machine "$source/data/machine_a" --drive "$source/data/drive/machine_a_10kHz.csv" \
        --per-torque --quiet -o "$1"
}
emit_all "$work/first"
(cd "$work" && emit_all second)
diff -r "$work/first" "$work/second" || fail "the same currents gave other bytes"
grep -rlF "$work" "$work/first" && fail "a path is in the files"

gcc_c="-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wdouble-promotion -Wfloat-equal -Wcast-qual
    -Wcast-align -Wstrict-prototypes -Wmissing-prototypes -Wundef -Wvla -Wswitch-enum -Wwrite-strings -Werror"
gcc_cxx="-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wdouble-promotion -Wfloat-equal -Wcast-qual
    -Wold-style-cast -Wuseless-cast -Wzero-as-null-pointer-constant -Wundef -Werror"
# All that clang has, but for layout, for C before C99, for C++ before C++11, and for NULL of its own stddef.h, which it takes
# for a zero.
clang_c="-Weverything -Wno-padded -Wno-declaration-after-statement -Wno-unknown-warning-option -Wno-unsafe-buffer-usage
    -Wno-pre-c11-compat -Wno-used-but-marked-unused -Werror"
clang_cxx="-Weverything -Wno-padded -Wno-c++98-compat -Wno-c++98-compat-pedantic -Wno-unknown-warning-option
    -Wno-unsafe-buffer-usage -Wno-zero-as-null-pointer-constant -Werror"

compile_c() {
    for standard in c99 c11 gnu17; do
        for name in form_abc form_dq form_torque form_drive; do
            "$1" -std=$standard -O2 $2 -Iinclude -I"$work/first" -c "$work/first/$name.c" -o "$work/$name.o" ||
                fail "$1 -std=$standard $name.c"
        done
    done
    echo "$1: C99, C11, C17"
}
compile_cxx() {
    for standard in c++11 c++20; do
        "$1" -std=$standard -O2 $2 -Iinclude -I"$work/first" tests/host/emit/cxx/main.cpp "$work"/form_*.o -o "$work/program" ||
            fail "$1 -std=$standard"
        "$work/program" || fail "$1 -std=$standard: the program found fault $?"
    done
    echo "$1: C++11, C++20"
}
have() {
    command -v "$1" >/dev/null
}
have gcc || have clang || { echo "emit_compilers: skipped, no compiler of these: gcc clang"; exit 77; }
! have gcc || compile_c gcc "$gcc_c"
! have clang || compile_c clang "$clang_c"
! have g++ || compile_cxx g++ "$gcc_cxx"
! have clang++ || compile_cxx clang++ "$clang_cxx"

# Another version of the runtime is refused with words that say so.
cc=gcc
have gcc || cc=clang
mkdir -p "$work/other/hci"
sed 's/^#define HCI_TABLE_VERSION 2$/#define HCI_TABLE_VERSION 3/' include/hci/table.h >"$work/other/hci/table.h"
! cmp -s include/hci/table.h "$work/other/hci/table.h" || fail "the version of hci/table.h was not found"
! $cc -I"$work/other" -I"$work/first" -c "$work/first/form_abc.c" -o "$work/refused.o" 2>"$work/refused" ||
    fail "another version of hci/table.h was taken"
grep -q 'form_abc needs version 2 of hci/table.h' "$work/refused" || { cat "$work/refused" >&2; fail "the refusal does not say why"; }
echo "another version: refused"
