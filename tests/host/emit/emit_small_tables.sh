#!/bin/sh
# labels: slow
# Tables of 16-bit and 8-bit knots in code for Cortex-M4F, M3 and M0+ on an emulated board: integers and floats at 65 536 angles are
# those of the host to the last bit, and an evaluation takes the instructions that emit states. The same currents on other processors
# of Linux, big-endian ones among them, where there are a compiler and an emulator for them (scripts/platforms --install).
#   emit_small_tables.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"

for tool in arm-none-eabi-gcc qemu-system-arm; do
    command -v $tool >/dev/null || { echo "skipped: no $tool here"; exit 77; }
done
echo '#include <stdio.h>' | arm-none-eabi-gcc -E - >/dev/null 2>&1 || { echo "skipped: no newlib here"; exit 77; }

mcu=$source_dir/examples/mcu
run 0 solve "$source_dir/data/machine_a" --target "$source_dir/data/scenarios/02/target.csv" --auto --quiet -o "$work/currents"

# table NAME OPTION...: emits it; TYPE, function and arguments go into the list.
list=
table() {
    name=$1 type=$2 function=$3 extra=$4
    shift 4
    run 0 emit "$work/currents" --name "$name" "$@" --json -o "$work/tables"
    cp "$work/stdout" "$work/$name.json"
    echo "#include \"$name.h\"" >>"$work/includes"
    list="$list    X($name, hci_$type, hci_table_i16_$function, $extra) \\
"
}
small='--max-error 0.024'
# shellcheck disable=SC2086
for shape in linear quadratic cubic; do
    table "i8_abc_$shape" units_abc abc_q15 '' --format i8 --shape $shape
    table "i8_dq_torque_$shape" units_dq dq_torque_q15 'COMMA 16000' --format i8 --max-error 0.4 --frame dq --shape $shape --per-torque
    for frame in abc dq; do
        table "i16_${frame}_$shape" "currents_$frame" $frame '' $small --format i16 --frame $frame --shape $shape
        table "q15_${frame}_$shape" "units_$frame" ${frame}_q15 '' $small --format q15 --frame $frame --shape $shape
        table "i16_${frame}_torque_$shape" "currents_$frame" ${frame}_torque 'COMMA 1.25f' $small --format i16 --frame $frame --shape $shape --per-torque
        table "q15_${frame}_torque_$shape" "units_$frame" ${frame}_torque_q15 'COMMA 16000' $small --format q15 --frame $frame --shape $shape --per-torque
    done
done
{
    cat "$work/includes"
    printf '#define COMMA ,\n#define TABLES(X) \\\n%s\n' "$list"
} >"$work/tables/tables.h"

sources="$source_dir/tests/host/emit/small_tables/main.c $work/tables/*.c"
warnings='-std=c99 -O2 -Wall -Wextra -Wconversion -Wno-unused-function'
# shellcheck disable=SC2086
check 'built for the host' cc $warnings -ffp-contract=off -I"$source_dir/include" -I"$work/tables" $sources -o "$work/host"
"$work/host" >"$work/host.txt" || fail 'the host program'

# board NAME FLAG...: builds, runs, and keeps what it says.
board() {
    name=$1
    shift
    # shellcheck disable=SC2086
    check "built for $name" arm-none-eabi-gcc "$@" -mthumb $warnings -ffp-contract=off -DON_BOARD -nostartfiles \
        --specs=rdimon.specs -T "$mcu/mps2-an386.ld" -I"$source_dir/include" -I"$work/tables" -I"$mcu" $sources \
        "$mcu/measure.c" "$mcu/startup.c" -o "$work/$name.elf"
    timeout 200 qemu-system-arm -M mps2-an386 -nographic -monitor none -serial none \
        -semihosting-config enable=on,target=native -icount shift=0 -kernel "$work/$name.elf" >"$work/$name.txt" ||
        fail "$name ended with an error"
    check "$name reached its end" grep -qx done "$work/$name.txt"
    grep '^sum' "$work/host.txt" >"$work/expected"
    grep '^sum' "$work/$name.txt" >"$work/found"
    check "$name computes the currents of the host" diff "$work/expected" "$work/found"
}
board cortex_m4f -mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -mfloat-abi=hard
board cortex_m0_plus -mcpu=cortex-m0plus
board cortex_m3 -mcpu=cortex-m3

# elsewhere NAME COMPILER EMULATOR FLAG...: float arithmetic has to be that of floats, which the flags see to.
elsewhere() {
    name=$1 compiler=$2 emulator=$3
    shift 3
    command -v "$compiler" >/dev/null && command -v "$emulator" >/dev/null || { echo "not compared: no $compiler or $emulator here"; return 0; }
    # shellcheck disable=SC2086
    check "built for $name" "$compiler" "$@" $warnings -static -ffp-contract=off -I"$source_dir/include" -I"$work/tables" $sources -o "$work/$name"
    "$emulator" "$work/$name" >"$work/$name.txt" || fail "$name ended with an error"
    grep '^sum' "$work/$name.txt" >"$work/found"
    check "$name computes the currents of the host" diff "$work/expected" "$work/found"
}
elsewhere i686 i686-linux-gnu-gcc qemu-i386 -msse2 -mfpmath=sse
elsewhere armhf arm-linux-gnueabihf-gcc qemu-arm
elsewhere aarch64 aarch64-linux-gnu-gcc qemu-aarch64
elsewhere s390x s390x-linux-gnu-gcc qemu-s390x -fexcess-precision=fast

# Knots, probes and code of one table, linked by sections: the struct is folded into the code. 1 KiB with the evaluation; of
# quadratic knots with the check at start-up too.
bytes_of() { # NAME
    for source in "$work/size.c" "$work/tables/$1.c"; do
        # shellcheck disable=SC2086
        arm-none-eabi-gcc -mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -mfloat-abi=hard -mthumb $warnings -Wno-missing-prototypes -ffunction-sections \
            -fdata-sections -DTABLE="$1" -include "$work/tables/$1.h" -I"$source_dir/include" -I"$work/tables" -c "$source" -o "$work/size.o" &&
            arm-none-eabi-size -A "$work/size.o"
    done | awk '/^\.text\.reference/ { code = $2 } /^\.text\.is_good|^\.rodata\.remainder/ { check += $2 } /^\.rodata\..*_(knots|probes)/ { data += $2 }
        END { print data, code, check }'
}
cat >"$work/size.c" <<'C'
hci_currents_abc reference(uint32_t angle) { return hci_table_i16_abc(&TABLE, angle); }
int is_good(void) { return hci_table_i16_check(&TABLE) == HCI_TABLE_GOOD; }
C
for shape in linear quadratic; do
    bytes=$(bytes_of i16_abc_$shape)
    echo "i16 abc $shape, Cortex-M4F: knots and probes, evaluation, check: $bytes bytes"
    echo "$shape $bytes" >>"$work/sizes"
done
check 'the aim of 1 KiB' awk '{ sum = $2 + $3 + ($1 == "quadratic" ? $4 : 0); if (!($2 > 200 && $3 > 100 && $4 > 200 && sum <= 1024)) exit 1; n++ } END { exit n != 2 }' "$work/sizes"

# What emit states of a table against what was counted.
compare_costs() {
    awk '$1 == "cost" { print $2, $4, $6 }' "$work/$1.txt" | while read -r name counted start; do
        stated=$(tr ',{' '\n\n' <"$work/$name.json" | sed -n "s/.*\"instructions_$1\": *//p" | head -n 1)
        echo "$1 $name: $counted instructions, stated $stated; check at start-up $start"
        awk -v c="$counted" -v s="$stated" -v k="$start" 'BEGIN { d = 4 + s / 50; exit !(c > s - d && c < s + d && k < 50000) }' || echo "$name" >>"$work/wrong"
    done
}
: >"$work/wrong"
compare_costs cortex_m4f
compare_costs cortex_m0_plus
awk '$1 == "cost" && $2 ~ /(abc|dq)_(linear|quadratic|cubic)/ { print "cortex_m3", $2, $4 }' "$work/cortex_m3.txt"
cat "$work/wrong"
check 'instructions as stated' test ! -s "$work/wrong"
finish
