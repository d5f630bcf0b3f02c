#!/bin/sh
# labels: slow
# Emitted tables on an emulated Cortex-M4: built from currents of machine A by the project in examples/mcu, compared with the
# currents themselves, measured, and damaged to see that the start-up check notices.
#   emit_mcu.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
set -eu
export LC_ALL=C

source=$1 work=$2/mcu hci_solve=$3
for tool in arm-none-eabi-gcc qemu-system-arm; do
    command -v $tool >/dev/null || { echo "emit_mcu: skipped, no $tool here"; exit 77; }
done
echo '#include <stdio.h>' | arm-none-eabi-gcc -E - >/dev/null 2>&1 || { echo "emit_mcu: skipped, no newlib here"; exit 77; }

fail() {
    echo "emit_mcu: $*" >&2
    exit 1
}

run_board() {
    timeout 120 qemu-system-arm -M mps2-an386 -nographic -monitor none -serial none \
        -semihosting-config enable=on,target=native -icount shift=0 -kernel "$work/build/mcu.elf"
}

rm -rf "$work"
mkdir -p "$work"
cd "$source"
"$hci_solve" solve data/machine_a --target data/scenarios/02/target.csv --auto --quiet -o "$work/currents"
cmake -S examples/mcu -B "$work/build" --toolchain "$source/cmake/cortex-m4.cmake" \
    -DHCI_SOLVE="$hci_solve" -DHCI_CURRENTS="$work/currents" >"$work/log" 2>&1 || { cat "$work/log" >&2; fail "cmake"; }
cmake --build "$work/build" >>"$work/log" 2>&1 || { cat "$work/log" >&2; fail "build"; }
run_board >"$work/output" || { cat "$work/output" >&2; fail "the program ended with an error"; }
tail -n 1 "$work/output" | grep -qx done || fail "the program did not reach its end"

# Σ A sin(nθ − σ2πs/3 + γ) of the CSV files, in double, by the definitions of the conventions.
cat >"$work/compare.awk" <<'AWK'
function sequence(set, order) {
    if (set == "sym") return order % 3 == 2 ? -1 : order % 3
    return set == "neg" ? -1 : set == "zero" ? 0 : 1
}
function sum(file, s, theta,    k, x) {
    for (k = 1; k <= count[file]; ++k)
        x += amplitude[file, k] * sin(order[file, k] * theta - sigma[file, k] * 2 * pi * s / 3 + phase[file, k])
    return x
}
function compare(found, expected) {
    error = found > expected ? found - expected : expected - found
    if (error > worst[$1]) worst[$1] = error
    compared[$1]++
}
BEGIN { pi = atan2(0, -1) }
FILENAME ~ /\.csv$/ {
    if (FNR == 1) { ++file; FS = ","; next }
    split($0, cell, ",")
    k = ++count[file]
    order[file, k] = cell[1] + 0; amplitude[file, k] = cell[3] + 0; phase[file, k] = cell[4] + 0
    sigma[file, k] = sequence(cell[2], cell[1])
    next
}
{ split($0, word, " "); $1 = word[1] }
$1 == "check" { allowed[word[2]] = word[7]; if (word[3] != "good") { print "check of " word[2] " says " word[3]; bad = 1 } }
$1 == "abc" || $1 == "dq" || $1 == "torque" {
    theta = 2 * pi * word[2] / 4294967296; d = q = 0
    for (s = 0; s < 3; ++s) {
        i[s] = $1 == "torque" ? word[3] * sum(3, s, theta) + sum(2, s, theta) : sum(1, s, theta)
        d -= 2 / 3 * i[s] * cos(theta - 2 * pi * s / 3); q += 2 / 3 * i[s] * sin(theta - 2 * pi * s / 3)
    }
    if ($1 == "dq") { compare(word[4], d); compare(word[5], q) }
    else for (s = 0; s < 3; ++s) compare(word[4 + s], i[s])
}
END {
    for (name in allowed) {
        if (worst[name] > allowed[name] || worst[name] < allowed[name] / 20 || compared[name] < 400) bad = 1
        printf "currents %-6s %d values, worst error %.4f A, stated %.4f A\n", name, compared[name], worst[name], allowed[name]
        names++
    }
    exit bad || names != 3
}
AWK
awk -f "$work/compare.awk" "$work/currents/currents.csv" "$work/currents/currents_constant.csv" \
    "$work/currents/currents_per_Nm.csv" "$work/output" || fail "the board's currents are not those of the CSV files"

# The references of the current loop: those of the table by torque, read ahead. Errors of 0.05 A in three phases are up to 4/3
# of that in the rotor frame.
awk '$1 == "loop" { print; n++; if (!($3 < 0.07 && $5 < 0.001 && $7 > 100 && $7 < 1000)) bad = 1 } END { exit bad || n != 1 }' "$work/output" ||
    fail "the loop's references are not those of the table"
awk '$1 == "cost" && $2 == "lead" { print; n++; if (!($4 > 100 && $4 < 300)) bad = 1 } END { exit bad || n != 1 }' "$work/output" ||
    fail "the instructions of a reference of the loop"

# Sizes in bytes of sections whose name matches, of an object file.
section_bytes() {
    arm-none-eabi-size -A "$1" | awk -v name="$2" '$1 ~ name { sum += $2 } END { print sum + 0 }'
}
object() {
    find "$work/build" -name "$1.c.obj"
}

# figure WHAT VALUE LEAST MOST: prints a figure, and fails outside bounds that leave a compiler some freedom.
figure() {
    echo "$1: $2"
    awk -v v="$2" -v least="$3" -v most="$4" 'BEGIN { exit !(v >= least && v <= most) }' || fail "$1: expected $3 to $4"
}

code=$(object current_reference)
stack_usage=$(find "$work/build" -name 'current_reference.c.su')
for form in abc dq torque; do
    table=$(object currents_$form)
    points=$(awk -v form=$form '$1 == "check" && $2 == form { print $5 }' "$work/output")
    instructions=$(awk -v form=$form '$1 == "cost" && $2 == form { print $4 }' "$work/output")
    painted=$(awk -v form=$form '$1 == "cost" && $2 == form { print $6 }' "$work/output")
    frame=$(awk -F'[:\t]' -v name=reference_$form '$4 == name { print $5 }' "$stack_usage")
    lines=$(arm-none-eabi-objdump -d --no-show-raw-insn -j .text.reference_$form "$code" | grep -c '^ .*:')
    figure "$form: table of $points points, flash bytes" "$(section_bytes "$table" '^\.(text|rodata)')" $((points * 8)) $((points * 16 + 400))
    figure "$form: evaluation, flash bytes" "$(section_bytes "$code" "^\.text\.reference_$form\$")" 60 320
    figure "$form: RAM bytes of table and evaluation" \
        $(($(section_bytes "$table" '^\.(data|bss)') + $(section_bytes "$code" '^\.(data|bss)'))) 0 0
    figure "$form: instructions for an evaluation, without call and return" "$instructions" 15 "$((lines - 1))"
    figure "$form: stack bytes, frame by the compiler" "$frame" "$painted" 64
done
figure "check: flash bytes" "$(section_bytes "$code" '^\.text\.(reference_good|hci_)')" 200 1600

# One digit of one value is changed: the board must say so, and end with an error.
awk '/_rows\[/ { rows = NR } rows && NR > rows + 20 && !done { done = sub(/[.][1-8]/, ".9") } 1' \
    "$work/build/tables/currents_dq.c" >"$work/currents_dq.c"
mv "$work/currents_dq.c" "$work/build/tables/currents_dq.c"
cmake --build "$work/build" >>"$work/log" 2>&1 || fail "build of the damaged table"
run_board >"$work/damaged" && fail "the program ran on with a damaged table"
grep -q '^check dq bad-crc ' "$work/damaged" || { cat "$work/damaged" >&2; fail "a damaged table was not noticed"; }
echo "damaged table: noticed"
