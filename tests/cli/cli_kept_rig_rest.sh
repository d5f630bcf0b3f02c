#!/bin/sh
# What is found in recordings of the rig, of friction, orders of the turn, zeros of sensors and of nothing, is what was hidden, and number by number that in tests/files/kept/rig_rest.txt.
# After a change that is meant: --renew, and look at the differences.
#   cli_kept_rig_rest.sh SOURCE_DIR BUILD_DIR HCI_SOLVE [--renew]
. "$1/tests/support/common.sh"
use_plain_build
. "$source_dir/tests/cli/rig_inputs.sh"
diagnosed friction 2
diagnosed mechanical_order 1
diagnosed current_offset 2
diagnosed none 1
kept_all rig_rest "${4-}"
finish
