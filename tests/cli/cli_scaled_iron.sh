#!/bin/sh
# A motor whose currents are 64 times as small, and its torques 4096 times, has the same effects, so many times as small, and so does one as much
# larger: no size in amperes or newton metres is built in. Of a salient machine whose iron saturates.
#   cli_scaled_iron.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
use_plain_build
. "$source_dir/tests/cli/scaled_inputs.sh"
scaled iron 0.015625 0.000244140625
finish
