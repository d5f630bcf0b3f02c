#!/bin/sh
# What is found in recordings of the rig, of what no effect is, is what was hidden, and number by number that in tests/files/kept/rig_unknown.txt.
# After a change that is meant: --renew, and look at the differences.
#   cli_kept_rig_unknown.sh SOURCE_DIR BUILD_DIR HCI_SOLVE [--renew]
. "$1/tests/support/common.sh"
use_plain_build
. "$source_dir/tests/cli/rig_inputs.sh"
diagnosed unknown_loose_part 3
diagnosed unknown_drift 3
diagnosed unknown_belt 2
diagnosed unknown_stick 2
kept_all rig_unknown "${4-}"
finish
