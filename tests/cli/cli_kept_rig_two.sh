#!/bin/sh
# What is found in recordings of the rig, of two effects at once and phases that differ, is what was hidden, and number by number that in tests/files/kept/rig_two.txt.
# After a change that is meant: --renew, and look at the differences.
#   cli_kept_rig_two.sh SOURCE_DIR BUILD_DIR HCI_SOLVE [--renew]
. "$1/tests/support/common.sh"
use_plain_build
. "$source_dir/tests/cli/rig_inputs.sh"
diagnosed two 3
diagnosed phase_imbalance 3
kept_all rig_two "${4-}"
finish
