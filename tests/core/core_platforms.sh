#!/bin/sh
# labels: slow
# The core's own numbers, tables and blobs on a processor of the other byte order and on one of 32 bits, emulated: the tests of
# scripts/platforms --quick. Skipped where the compilers and emulators for them are missing. Slow because
# the core is compiled for each.
#   core_platforms.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
set -eu
cd "$1"
HCI_PLATFORMS=$2/nested/platforms sh scripts/platforms --quick s390x armhf
