#!/bin/sh
# The results of commands on small inputs, of recordings: check, fit, diagnose, tune, harmonics, batch, fleet, are those in tests/files/kept/measured.txt, number by number: what no
# other test looks at must not change unnoticed. After a change that is meant: --renew, and look at the differences.
#   cli_kept_measured.sh SOURCE_DIR BUILD_DIR HCI_SOLVE [--renew]
. "$1/tests/support/common.sh"
use_plain_build
. "$source_dir/tests/cli/kept_inputs.sh"
kept check 0 check data/fem_c/machine data/fem_c/runs/I0.csv data/fem_c/runs/id0_iq6.csv
kept check_simple 0 check simple slow.csv back.csv fast.csv
kept check_worn 1 check simple worn_slow.csv worn_back.csv worn_fast.csv worn_idle.csv
kept check_wrong 1 check $a slow.csv back.csv
kept worn_cogging 0 harmonics worn_slow.csv --quantity cogging --pole-pairs 2 --torque-constant 0.3
kept worn_fit 0 fit simple --runs worn.csv
kept fit 0 fit data/fem_c/machine --runs data/fem_c/runs.csv
kept diagnose 0 diagnose simple --runs runs.csv
kept worn 1 diagnose simple --runs worn.csv --target $t
kept tune 0 tune slow.csv fast.csv back.csv --pole-pairs 2 --torque-constant 0.3
kept emf 0 harmonics open.csv --quantity back_emf --pole-pairs 2
kept servo 0 init servo --pole-pairs 4 --volt-per-krpm 98 --resistance 1.9 --resistance-of line --inductance-d 4e-3 --inductance-q 6e-3 --slots 12
kept batch 0 batch motors.csv --command fit -j 1
kept fleet 0 fleet kept/batch
kept_all measured "${4-}"
finish
