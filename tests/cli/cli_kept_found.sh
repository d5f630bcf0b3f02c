#!/bin/sh
# What is found in recordings of several stands, and solved for it, is that in tests/files/kept/found.txt, number by number: a salient machine whose iron saturates, a free
# shaft, one that control turns slowly, one that swings, and recordings after a diagnosis. After a change that is meant: --renew, and look at the differences.
#   cli_kept_found.sh SOURCE_DIR BUILD_DIR HCI_SOLVE [--renew]
. "$1/tests/support/common.sh"
use_plain_build
. "$source_dir/tests/cli/kept_inputs.sh"
cd "$work" || exit 1

. "$source_dir/tests/cli/found_inputs.sh"

for name in iron free slow swung; do "$hci_solve" diagnose $name --runs $name.csv -q -o kept/$name >stdout 2>stderr || [ $? -eq 1 ]; check "$name is diagnosed" [ -s kept/$name/summary.json ]; done
"$hci_solve" diagnose --again kept/swung --runs later.csv -q -o kept/later >stdout 2>stderr
check "it is diagnosed again" [ -s kept/later/summary.json ]
kept fitted 0 fit iron --runs iron.csv
kept held 0 harmonics slow_a.csv --quantity cogging --pole-pairs 5 --torque-constant 0.1 --holding
kept coasted 0 harmonics free_a.csv --quantity cogging --pole-pairs 4 --torque-constant 0.15 --inertia 8e-4

# Currents for these machines, and what to expect of them.
for torque in 2 0.9 0.05; do printf 'order,amplitude_Nm,phase_rad\n0,%s,1.5707963267948966\n6,%s,0.4\n' $torque "$(awk "BEGIN { print 0.02 * $torque }")" >t$torque.csv; done
solved() { # NAME MACHINE TARGET OPTION...
    name=$1 from=$2 target=$3
    shift 3
    "$hci_solve" solve "kept/$from/machine" --target "$target" "$@" -q -o "kept/$name" >stdout 2>stderr || [ $? -eq 1 ]
    check "$name is solved: $(cat stderr)" [ -s "kept/$name/summary.json" ]
}
solved s_swung swung t0.9.csv --auto --bandwidth 200 --report
solved s_later later t0.9.csv --auto --limit-current 3.1
solved s_slow slow t0.05.csv --method pointwise --current-angle 0
solved s_slow_angle slow t0.05.csv --method pointwise --current-angle 20
solved s_free free t0.05.csv --auto 4
solved s_iron_mtpa iron t2.csv --method pointwise --strategy mtpa --report
kept_all found "${4-}"
finish
