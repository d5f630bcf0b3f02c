#!/bin/sh
# The results of commands on small inputs, simulate, predict and sweep, are those in tests/files/kept/played.txt, number by number: what no
# other test looks at must not change unnoticed. After a change that is meant: --renew, and look at the differences.
#   cli_kept_played.sh SOURCE_DIR BUILD_DIR HCI_SOLVE [--renew]
. "$1/tests/support/common.sh"
use_plain_build
. "$source_dir/tests/cli/kept_inputs.sh"
kept auto 0 solve $a --target $t --auto --report
kept imposed 0 simulate $a data/drive/imposed.csv --report
kept driven 0 simulate $a data/drive/driven.csv
kept filho 0 simulate data/machine_c filho.csv
kept speeds 0 simulate $a --table kept/auto --drive data/drive/machine_a_10kHz.csv --speeds 100,1000
kept cogging 0 harmonics kept/driven/trajectory.csv --quantity cogging --pole-pairs 2
kept predicted.csv 0 predict $a kept/imposed/trajectory.csv
kept trade 0 sweep $a --trade-off --torque 1 --currents 8 --harmonics few.csv --report
kept envelope 0 sweep $a --envelope --speeds 0 --ripple 40 --limit-current 20 --harmonics few.csv --report
kept map 0 sweep m --map --torques 1,2 --speeds 300,1500 --limit-current 12 --limit-voltage 40 --harmonics $h --report
kept_all played "${4-}"
finish
