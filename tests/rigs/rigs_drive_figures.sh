#!/bin/sh
# labels: slow
# Figures of docs/drive.md that no command on the page makes: gains that are off, a noisy response, dead time, saturation, the circle.

. "$1/tests/support/common.sh"
use_plain_build # with sanitizers it takes minutes

python3 "$1/tests/rigs/loop/drive_figures.py" "$hci_solve" "$1" || fail "docs/drive.md has other figures"
finish
