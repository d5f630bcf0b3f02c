#!/bin/sh
# A motor whose currents are 64 times as small, and its torques 4096 times, has the same effects, so many times as small, and so does one as much
# larger: no size in amperes or newton metres is built in. Of speeds that go up and down.
#   cli_scaled_swung.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
use_plain_build
. "$source_dir/tests/cli/scaled_inputs.sh"
scaled swung 0.015625 0.000244140625
scaled swung 64 4096
finish
