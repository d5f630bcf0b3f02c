#!/bin/sh
# A motor whose currents are 64 times as small, and its torques 4096 times, has the same effects, so many times as small, and so does one as much
# larger: no size in amperes or newton metres is built in. Of shafts that control turns slowly.
#   cli_scaled_slow.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
use_plain_build
. "$source_dir/tests/cli/scaled_inputs.sh"
scaled slow 0.015625 0.000244140625
scaled slow 64 4096
finish
