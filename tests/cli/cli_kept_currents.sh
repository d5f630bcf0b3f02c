#!/bin/sh
# The results of commands on small inputs, solve and emit, are those in tests/files/kept/currents.txt, number by number: what no
# other test looks at must not change unnoticed. After a change that is meant: --renew, and look at the differences.
#   cli_kept_currents.sh SOURCE_DIR BUILD_DIR HCI_SOLVE [--renew]
. "$1/tests/support/common.sh"
use_plain_build
. "$source_dir/tests/cli/kept_inputs.sh"
kept auto 0 solve $a --target $t --auto --report
kept limited 1 solve m --target $t --harmonics $h --limit-current 12 --limit-voltage 40 --speed 1500 --report
kept limited_auto 1 solve $a --target $t --auto --limit-current 17 --limit-rms 10
kept few 1 solve data/machine_b --target data/scenarios/12/target.csv --auto 9 --max-loss 1.5
kept interior 0 solve data/machine_c --target $t --auto
kept saturated 0 solve data/machine_c_saturated --target $t --auto
kept pointwise 0 solve $a --target $t --method pointwise
kept driven_set 0 solve $a --target $t --auto --drive data/drive/machine_a_10kHz.csv --speed 600
kept loop 0 emit kept/auto --name loop --machine $a --drive data/drive/machine_a_10kHz.csv
kept loop_check 0 check $a --drive data/drive/machine_a_10kHz.csv --speed 500
kept beckhoff 0 emit kept/auto --name map --for beckhoff --machine $a
kept moteus 0 emit kept/auto --name map --for moteus --machine $a
kept openffboard 0 emit kept/auto --name map --for openffboard --machine $a --counts-per-ampere 400
kept salient_limited 0 solve data/machine_c --target $t --auto --limit-current 6 --limit-voltage 200 --speed 300 --report
kept moved.fmu 0 export-fmu $a --table kept/auto --drive data/drive/machine_a_10kHz.csv --fmi 3 --sources-only
kept machine.fmu 0 export-fmu data/machine_c --sources-only
kept rows 0 emit kept/auto --name rows --points 64
kept knots 0 emit kept/auto --name knots --frame dq --format i16 --per-torque --max-error 0.05
kept_all currents "${4-}"
finish
