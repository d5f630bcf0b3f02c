#!/bin/sh
# A `tune` that ends with an error leaves the folder as it was, with logs and with recordings of a machine, whichever of its steps
# fails.
#   cli_tune_failed.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
cd "$work" || exit 1

"$hci_solve" simulate "$source_dir/data/machine_a" "$source_dir/data/drive/driven.csv" -q -o driven || fail "simulate"
printf 'file,role\ndriven/trajectory.csv,fit\n' >runs.csv

# CODE STEP WORD...: a file stands where the folder of a step has to be
fails_at() {
    ends=$1 step=$2
    shift 2
    mkdir out
    echo before >"out/$step"
    run "$ends" tune "$@" -o out
    check "what is left beside a file at $step" [ "$(find out -type f)" = "out/$step" ]
    check "the file at $step" [ "$(cat "out/$step")" = before ]
    rm -rf out
}

for step in check diagnose currents table; do
    fails_at 5 "$step" "$source_dir/data/machine_a" --runs runs.csv
    fails_at 2 "$step" driven/trajectory.csv --pole-pairs 2 --kv 39 --torque 2.46
done
finish
