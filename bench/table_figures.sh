#!/bin/sh
# The figures of docs/controller.md: bytes, error, instructions and stack of tables for machines A and C, in phase currents, in the
# rotor frame and by torque, at 1, 0.1 and 0.01 % of the peak, on four processors in the emulator.
#   bench/table_figures.sh HCI_SOLVE
# Needs arm-none-eabi-gcc, newlib, qemu-system-arm, riscv64-unknown-elf-gcc, picolibc and qemu-system-riscv32. Machine C has
# reluctance torque: its currents are not linear in the torque, and there is no table by torque.
set -eu
export LC_ALL=C

source=$(cd "$(dirname "$0")/.." && pwd)
hci_solve=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() {
    echo "table_figures: $*" >&2
    exit 1
}

"$hci_solve" solve "$source/data/machine_a" --target "$source/data/scenarios/02/target.csv" --auto --quiet -o "$work/a"
printf 'order,amplitude_Nm,phase_rad\n0,8,0\n' >"$work/target.csv"
"$hci_solve" solve "$source/data/machine_c" --target "$work/target.csv" --auto --quiet -o "$work/c"

field() { # FILE NAME: the first number of that name
    tr ',{' '\n\n' <"$1" | sed -n "s/.*\"$2\":[[:space:]]*\"\{0,1\}\([^\"]*\)\"\{0,1\}.*/\1/p" | head -n 1
}

# emit MACHINE PERCENT FORM FORMAT: one table; its line goes into the list of figures.
emit() {
    machine=$1 percent=$2 form=$3 format=$4
    name=${format}_${machine}_${form}_$(echo "$percent" | tr . _)
    case $form in
    abc) frame=abc extra='' call=abc argument='' ;;
    dq) frame=dq extra='' call=dq argument='' ;;
    torque) frame=abc extra=--per-torque call=abc_torque argument=', 1.25f' ;;
    esac
    [ "$format" = f32 ] && function=hci_table_f32_$call || function=hci_table_i16_$call
    type=hci_currents_$frame
    if [ "$format" = q15 ] || [ "$format" = i8 ]; then
        function=${function}_q15 type=hci_units_$frame
        [ -z "$argument" ] || argument=', 16000'
    fi
    peak=$(awk -v name=peak_phase_A 'BEGIN { RS = "," } $0 ~ name { sub(/.*:/, ""); print $1; exit }' "$work/$machine/summary.json")
    error=$(awk -v p="$peak" -v s="$percent" 'BEGIN { printf "%.6g", p * s / 100 }')
    # shellcheck disable=SC2086
    "$hci_solve" emit "$work/$machine" --name "$name" --format "$format" --frame $frame $extra --max-error "$error" --quiet --json -o "$work/tables" \
        >"$work/json" 2>"$work/refused" || { echo "not possible: $name: $(cat "$work/refused")" >&2; return 0; }
    echo "#include \"$name.h\"" >>"$work/includes"
    echo "    X($name, $type, $function(&$name, angle$argument)) \\" >>"$work/list"
    case "$machine $percent $form" in
    'a 0.1 abc' | 'a 0.1 torque' | 'a 0.01 torque') [ "$format" = q15 ] || [ "$format" = i8 ] || echo "    X($name, hci_table_${format}_check) \\" >>"$work/checks" ;;
    esac
    awk -v m="$machine" -v p="$percent" -v f="$form" -v t="$format" -v shape="$(field "$work/json" shape)" -v bytes="$(field "$work/json" bytes)" \
        -v error="$(field "$work/json" max_error_A)" -v peak="$peak" -v name="$name" \
        'BEGIN { printf "%s %s %s %s %s %s %s %.3g\n", name, m, p, f, t, shape, bytes, 100 * error / peak }' >>"$work/figures"
}
for machine in a c; do
    for percent in 1 0.1 0.01; do
        for form in abc dq torque; do
            [ $machine$form = ctorque ] && continue
            for format in f32 i16 q15 i8; do
                [ $format = i8 ] && [ $percent != 1 ] && continue
                emit $machine $percent $form $format
            done
        done
    done
done
{
    echo '#include "hci/table_i16.h"'
    cat "$work/includes"
    printf '#define TABLES(X) \\\n'
    cat "$work/list"
    printf '\n#define CHECKS(X) \\\n'
    cat "$work/checks"
    echo
} >"$work/tables/tables.h"

options="-std=c99 -O2 -ffp-contract=off -w -I$source/include -I$work/tables -I$source/examples/mcu"
run_arm() { # NAME FLAG...
    name=$1
    shift
    # shellcheck disable=SC2086
    arm-none-eabi-gcc "$@" -mthumb $options "$source/bench/table_figures.c" "$work"/tables/*.c "$source/examples/mcu/measure.c" \
        "$source/examples/mcu/startup.c" -nostartfiles --specs=rdimon.specs -T "$source/examples/mcu/mps2-an386.ld" -o "$work/$name.elf"
    timeout 300 qemu-system-arm -M mps2-an386 -nographic -monitor none -serial none -semihosting-config enable=on,target=native \
        -icount shift=0 -kernel "$work/$name.elf" >"$work/$name.txt" 2>&1 || fail "$name"
    grep -qx done "$work/$name.txt" || fail "$name did not reach its end"
}
run_arm m4f -mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -mfloat-abi=hard
run_arm m3 -mcpu=cortex-m3
run_arm m0plus -mcpu=cortex-m0plus
# shellcheck disable=SC2086
riscv64-unknown-elf-gcc -march=rv32imac -mabi=ilp32 --specs=picolibc.specs --oslib=semihost --crt0=hosted $options \
    -Wl,--defsym=__flash=0x80000000,--defsym=__flash_size=0x200000,--defsym=__ram=0x80200000,--defsym=__ram_size=0x100000 \
    "$source/bench/table_figures.c" "$work"/tables/*.c -o "$work/rv32.elf"
timeout 300 qemu-system-riscv32 -M virt -bios none -nographic -monitor none -serial none -semihosting-config enable=on,target=native \
    -icount shift=0 -kernel "$work/rv32.elf" >"$work/rv32.txt" 2>&1 || fail rv32
grep -qx done "$work/rv32.txt" || fail 'rv32 did not reach its end'

for name in m4f m3 m0plus rv32; do
    awk -v target=$name 'NF == 3 { print target, $0 }' "$work/$name.txt"
done | awk '
    NR == FNR { cost[$2, $1] = $3; if ($4 > stack[$2]) stack[$2] = $4; next }
    { row = toupper($2) ", " $3 " %, " ($4 == "torque" ? "abc by torque" : $4)
      if (!(row in seen)) { seen[row] = 1; order[++rows] = row }
      shape = $5 == "f32" ? "" : $6 " "
      cell[row, $5] = sprintf("%s%d B, %s %% | %d | %d | %d | %d | %d", shape, $7, $8, cost[$1, "m4f"], cost[$1, "m3"], cost[$1, "m0plus"], cost[$1, "rv32"], stack[$1]) }
    END {
        split("f32 i16 q15 i8", format, " ")
        title["f32"] = "`f32`"; title["i16"] = "`i16`, in amperes"; title["q15"] = "`q15`, integers"; title["i8"] = "`i8`, integers"
        for (f = 1; f <= 4; ++f) {
            printf "%s:\n\n| | size, error | M4F | M3 | M0+ | rv32imac | stack |\n|---|---|---|---|---|---|---|\n", title[format[f]]
            for (k = 1; k <= rows; ++k) if (format[f] != "i8" || order[k] ~ / 1 %/) printf "| %s | %s |\n", order[k], (order[k], format[f]) in cell ? cell[order[k], format[f]] : "not possible | | | | |"
            printf "\n"
        } }' - "$work/figures"

printf 'Beside a table, instructions:\n\n| | M4F | M3 | M0+ | rv32imac |\n|---|---|---|---|---|\n'
for name in m4f m3 m0plus rv32; do
    awk -v target=$name '$1 == "beside" { print target, $2, $3 }' "$work/$name.txt"
done | awk '{ if (!($2 in seen)) { seen[$2] = 1; order[++n] = $2 } cost[$2, $1] = $3 }
    END { for (k = 1; k <= n; ++k) { name = order[k]; words = name; gsub(/_/, " ", words)
        printf "| %s | %d | %d | %d | %d |\n", words, cost[name, "m4f"], cost[name, "m3"], cost[name, "m0plus"], cost[name, "rv32"] } }'
