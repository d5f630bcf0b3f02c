#!/bin/sh
# labels: slow
# Every target of `emit --for` through a second implementation of its drive, written from its description: drives/TARGET.py.
# Slow, since these are in Python: a quarter of a minute of processor time.
#   foreign_targets.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
cd "$source_dir" || exit 1
command -v python3 >/dev/null || exit 77
drives=$source_dir/tests/host/foreign/drives

run 2 emit data/example_currents/currents.csv --for nothing --name x --machine data/machine_a
says 'expected one of: '
targets=$(sed -n 's/.*expected one of: //p' "$work/stderr" | tr -d ',')
check "no targets" [ -n "$targets" ]
for target in $targets; do
    check "$target" python3 -B "$drives/check.py" "$hci_solve" "$source_dir" "$work" "$target"
done

# reluctance and saturation, by the program's own torque: what is left is what the table rounds
printf 'order,amplitude_Nm,phase_rad\n0,8,0\n' >"$work/eight.csv"
for machine in machine_c machine_c_saturated; do
    run 0 solve "data/$machine" --target "$work/eight.csv" --auto -q -o "$work/$machine"
    run 0 emit "$work/$machine" --machine "data/$machine" --for moteus --name "$machine" -o "$work" --json
    check "$machine: what is left" awk -F'[:,]' '/"torque_Nm"/ { at = $2 } /sine_peak/ { sine = $2 } /map_peak/ && at > 7.9 && at < 8.1 { seen = 1; bad = $2 > 0.015 * sine }
        END { exit !seen || bad }' "$work/stdout"
done
finish
