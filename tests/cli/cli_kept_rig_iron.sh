#!/bin/sh
# What is found in recordings of the rig, of iron and magnets, is what was hidden, and number by number that in tests/files/kept/rig_iron.txt.
# After a change that is meant: --renew, and look at the differences.
#   cli_kept_rig_iron.sh SOURCE_DIR BUILD_DIR HCI_SOLVE [--renew]
. "$1/tests/support/common.sh"
use_plain_build
. "$source_dir/tests/cli/rig_inputs.sh"
diagnosed saturation 3
diagnosed magnet_temperature 3
diagnosed reluctance 2
kept_all rig_iron "${4-}"
finish
