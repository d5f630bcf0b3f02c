#!/bin/sh
# hci::core builds for a microcontroller and keeps the same promises there.
#   cortex_m4.sh SOURCE_DIR BUILD_DIR
set -eu
command -v arm-none-eabi-gcc >/dev/null || exit 77
cd "$1"
cmake --preset cortex-m4 -B "$2" >/dev/null
cmake --build "$2"
NM=arm-none-eabi-nm SIZE=arm-none-eabi-size sh tests/layers/check.sh core "$2/src/core/libhci_core.a"
arm-none-eabi-size -t "$2/src/core/libhci_core.a"
