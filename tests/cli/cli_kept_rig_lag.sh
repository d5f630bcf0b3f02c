#!/bin/sh
# What is found in recordings of the rig, of a torque sensor that lags, is what was hidden, and number by number that in tests/files/kept/rig_lag.txt.
# After a change that is meant: --renew, and look at the differences.
#   cli_kept_rig_lag.sh SOURCE_DIR BUILD_DIR HCI_SOLVE [--renew]
. "$1/tests/support/common.sh"
use_plain_build
. "$source_dir/tests/cli/rig_inputs.sh"
diagnosed torque_sensor 2
kept_all rig_lag "${4-}"
finish
