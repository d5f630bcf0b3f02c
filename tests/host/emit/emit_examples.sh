#!/bin/sh
# The projects in examples/: integer references on a Cortex-M0+ and on rv32imac are those of this machine, and take so many
# instructions; the Arduino library is packed, and its sketch feeds the solved currents forward in SimpleFOC's terms.
#   emit_examples.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"

cd "$source_dir" || exit 1
run 0 solve data/machine_a --target data/scenarios/02/target.csv --auto --quiet -o "$work/currents"

# ---- integers

build_integer() { # NAME CMAKE_OPTION...
    name=$1
    shift
    { cmake -S examples/integer -B "$work/$name" -DHCI_SOLVE="$hci_solve" -DHCI_CURRENTS="$work/currents" -DHCI_MACHINE="$source_dir/data/machine_a" "$@" &&
        cmake --build "$work/$name"; } >"$work/log" 2>&1 || { cat "$work/log"; fail "build for $name"; }
}
same() { # NAME: its output is that of this machine
    check "$1 reached its end" grep -qx done "$work/$1.txt"
    grep -v '^cost' "$work/$1.txt" >"$work/references"
    check "$1 has the references of this machine" cmp -s "$work/references" "$work/native.txt"
    echo "$1: $(grep -c ' ' "$work/native.txt") references as on this machine"
}
build_integer native
"$work/native/integer.elf" >"$work/native.txt" || fail 'the program on this machine'
check 'references on this machine' awk '{ for (k = 2; k <= 4; ++k) if ($k > 15000) big = 1 } END { exit !big || NR != 121 }' "$work/native.txt"
# The torque is there, and the phases are those of the solved currents: their sum is 0 but for rounding.
check 'sum of the phases' awk 'NF == 4 { s = $2 + $3 + $4; if (s > 2 || s < -2) bad = 1 } END { exit bad }' "$work/native.txt"

if command -v arm-none-eabi-gcc >/dev/null && command -v qemu-system-arm >/dev/null && echo '#include <stdio.h>' | arm-none-eabi-gcc -E - >/dev/null 2>&1; then
    build_integer m0plus --toolchain "$source_dir/examples/integer/cortex-m0plus.cmake"
    timeout 100 qemu-system-arm -M microbit -nographic -monitor none -serial none -semihosting-config enable=on,target=native \
        -kernel "$work/m0plus/integer.elf" >"$work/m0plus.txt" || fail 'the program on the micro:bit'
    same m0plus
else
    echo 'no compiler, newlib or emulator for a Cortex-M0+ here'
fi

if command -v riscv64-unknown-elf-gcc >/dev/null && command -v qemu-system-riscv32 >/dev/null &&
    echo '#include <stdio.h>' | riscv64-unknown-elf-gcc --specs=picolibc.specs -march=rv32imac -mabi=ilp32 -E - >/dev/null 2>&1; then
    build_integer rv32 --toolchain "$source_dir/examples/integer/rv32imac.cmake"
    timeout 100 qemu-system-riscv32 -M virt -bios none -nographic -monitor none -serial none \
        -semihosting-config enable=on,target=native -icount shift=0 -kernel "$work/rv32/integer.elf" >"$work/rv32.txt" 2>&1 ||
        fail 'the program on rv32imac'
    same rv32
    cost=$(awk '$1 == "cost" { print $2 }' "$work/rv32.txt")
    echo "rv32imac: $cost instructions for counter, table by torque, ramp and limit"
    check 'instructions on rv32imac' test "$cost" -gt 40 -a "$cost" -lt 300
else
    echo 'no compiler, picolibc or emulator for rv32imac here'
fi

# ---- Arduino

sh examples/arduino/pack "$work/library" || fail 'packing the Arduino library'
for header in "$work"/library/src/hci/*.h; do
    sed -n 's/^#include "hci\/\(.*\)"/\1/p' "$header"
done | sort -u | while read -r name; do
    [ -f "$work/library/src/hci/$name" ] || echo "hci/$name is missing in the library"
done >"$work/missing"
cat "$work/missing"
check 'the library is whole' test ! -s "$work/missing"
sketch=$work/library/examples/torque_ripple
run 0 emit "$work/currents" --name smooth --format i16 --frame dq --per-torque --machine data/machine_a --quiet -o "$sketch"
run 0 emit "$work/currents" --name fine --frame abc --per-torque --max-error 0.01 --quiet -o "$work/fine"
if command -v g++ >/dev/null; then
    for source in "$sketch/smooth.c" "$work/fine/fine.c"; do
        gcc -std=c99 -O2 -I"$work/library/src" -c "$source" -o "$source.o" || fail "$source"
    done
    check 'the sketch compiles' g++ -std=c++11 -O2 -Wall -Wextra -I"$work/library/src" -Itests/host/emit/arduino -I"$sketch" -I"$work/fine" -Wno-unused-function \
        tests/host/emit/arduino/main.cpp "$sketch/smooth.c.o" "$work/fine/fine.c.o" -o "$work/sketch"
    check 'what is fed forward' "$work/sketch"
else
    echo 'no g++ here: the sketch is not compiled'
fi
finish
