#!/bin/sh
# Cogging of machine A learnt on an emulated Cortex-M4F, machine compiled in: two slow turns each way take it down to 2 % of
# itself; the same program on the build machine learns the same; and `diagnose` and `harmonics` read the blob.
#   emit_learn.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"

command -v cc >/dev/null || { echo "skipped: no cc here"; exit 77; }
cd "$source_dir" || exit 1
list() { # NAME FILE FACTOR
    awk -F, -v name="$1" -v factor="$3" '/^[0-9]/ { text = text sprintf("    {(float)%s, (float)%.17g, (float)%s},\n", $1, $2 * factor, $3) }
        END { printf "static const float %s[][3] = {\n%s};\n", name, text }' "$2"
}
{
    list BACK_EMF data/machine_a/back_emf.csv "$(awk 'BEGIN { printf "%.17g", 2 / (2 * atan2(0, -1) * 50) }')"
    list COGGING data/machine_a/cogging.csv 1
    echo "#define POLE_PAIRS 2"
} >"$work/machine.h"

options="-O2 -std=c99 -ffp-contract=off -Wall -Wextra -Wpedantic -Wconversion -Wdouble-promotion -Iinclude -I$work"
# shellcheck disable=SC2086
check 'built for this machine' cc $options tests/host/emit/learn/main.c -o "$work/native"
"$work/native" >"$work/native.txt" || fail 'the program on this machine'

# ripple FILE: what is left of the cogging torque, and the share.
ripple() {
    awk -v file="$1" '$1 == "ripple" { printf "%s: %.4g N·m without, %.3g N·m with the table: %.2f %%\n", file, $2, $3, 100 * $3 / $2
        n++; if (!($3 <= 0.02 * $2)) bad = 1 } END { exit bad || n != 1 }' "$work/$1.txt"
}
check 'cogging is down to 2 %' ripple native

# The blob as a recording: order 24 of the machine, electrical, is 48 of the turn; its current is that which was learnt.
awk '$1 == "blob" { for (k = 1; k < length($2); k += 2)
    printf "\\%03o", 16 * (index("0123456789abcdef", substr($2, k, 1)) - 1) + index("0123456789abcdef", substr($2, k + 1, 1)) - 1 }' \
    "$work/native.txt" >"$work/octal"
# shellcheck disable=SC2059
printf "$(cat "$work/octal")" >"$work/learnt.hcil"
cp -R data/machine_a "$work/unknown"
printf 'order,amplitude_Nm,phase_rad\n' >"$work/unknown/cogging.csv"
printf 'file,role\nlearnt.hcil,fit\n' >"$work/runs.csv"
"$hci_solve" diagnose "$work/unknown" --runs "$work/runs.csv" -o "$work/diagnosed" >"$work/stdout" 2>"$work/stderr" </dev/null
code=$?
check "diagnose reads what was learnt (exit code $code)" [ $code -le 1 ]
check 'it finds the cogging torque, to its error' awk -F, 'NR == FNR { if (/^[0-9]/) truth[$1] = $2; next }
    $1 == "cogging" { split($2, part, "_"); value[part[2]] += $3^2; error[part[2]] = $5 }
    $1 == "friction" && $2 == "coulomb" { printf "friction %.4f N·m, in truth 0.08\n", $3; friction = $3 }
    END { for (n in truth) if (truth[n] > 0.1) { x = sqrt(value[n]); m++
            printf "order %s: %.4f ± %.1e N·m, in truth %.4f\n", n, x, error[n], truth[n]
            if (x > 1.01 * truth[n] || x < 0.99 * truth[n] || error[n] < 3e-6 || error[n] > 1e-4) bad = 1 }
        exit bad || m != 3 || friction < 0.079 || friction > 0.081 }' data/machine_a/cogging.csv "$work/diagnosed/machine/effects.csv"

# The pole pairs are those in the file.
run 0 harmonics "$work/learnt.hcil" --quantity cogging --torque-constant 0.2094 --json && cp "$work/stdout" "$work/own"
run 0 harmonics "$work/learnt.hcil" --quantity cogging --torque-constant 0.2094 --pole-pairs 2 --json
check 'the pole pairs in the file' cmp -s "$work/stdout" "$work/own"
run 3 harmonics "$work/learnt.hcil" --quantity cogging --torque-constant 0.2094 --pole-pairs 3
says 'learnt of a machine with 2 pole pairs, expected 3'

head -c 300 "$work/learnt.hcil" >"$work/cut.hcil"
run 3 harmonics "$work/cut.hcil" --pole-pairs 2 --quantity cogging
says 'cut.hcil: found the beginning of what a device has learnt.*read it from the device again'
{ head -c 100 "$work/learnt.hcil"; printf x; tail -c +102 "$work/learnt.hcil"; } >"$work/damaged.hcil"
run 3 harmonics "$work/damaged.hcil" --pole-pairs 2 --quantity cogging
says 'damaged: its CRC-32 is another'

for tool in arm-none-eabi-gcc qemu-system-arm; do
    command -v $tool >/dev/null || { finish; echo "no $tool here: not on a target"; exit; }
done
echo '#include <stdio.h>' | arm-none-eabi-gcc -E - >/dev/null 2>&1 || { finish; echo "no newlib here: not on a target"; exit; }
# shellcheck disable=SC2086
check 'built for a Cortex-M4F' arm-none-eabi-gcc -mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16 $options -DON_TARGET -Iexamples/mcu \
    tests/host/emit/learn/main.c examples/mcu/startup.c examples/mcu/measure.c -nostartfiles --specs=rdimon.specs \
    -T examples/mcu/mps2-an386.ld -o "$work/mcu.elf"
timeout 300 qemu-system-arm -M mps2-an386 -nographic -monitor none -serial none -semihosting-config enable=on,target=native \
    -icount shift=0 -kernel "$work/mcu.elf" >"$work/target.txt" || fail 'the program on the target'
check 'the target reached its end' grep -qx done "$work/target.txt"
check 'cogging is down to 2 % on the target' ripple target
grep -E '^(order|ripple|blob)' "$work/native.txt" >"$work/expected"
grep -E '^(order|ripple|blob)' "$work/target.txt" >"$work/found"
check 'the target learns what this machine learns' cmp -s "$work/found" "$work/expected"
grep -E '^(cost|bytes)' "$work/target.txt"
check 'instructions' awk '$1 == "cost" { most = $2 == "sample" ? 60 : $2 == "step" ? 150 : $2 == "work" ? 16 * 120 : 1000000
    if (!($3 > 0 && $3 < most)) bad = 1; n++ } END { exit bad || n != 4 }' "$work/target.txt"
finish
