#!/bin/sh
# What is found in recordings of the rig, of sensors that err or swing, is what was hidden, and number by number that in tests/files/kept/rig_sensors.txt.
# After a change that is meant: --renew, and look at the differences.
#   cli_kept_rig_sensors.sh SOURCE_DIR BUILD_DIR HCI_SOLVE [--renew]
. "$1/tests/support/common.sh"
use_plain_build
. "$source_dir/tests/cli/rig_inputs.sh"
diagnosed torque_sensor 5
diagnosed channel_delay 3
diagnosed position_eccentricity 3
kept_all rig_sensors "${4-}"
finish
