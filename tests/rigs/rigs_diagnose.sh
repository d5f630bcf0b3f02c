#!/bin/sh
# labels: slow
# How often `diagnose` names what the rig has hidden: a case of each kind with a fixed seed, see tests/rigs/bench/README.md.
# HCI_SCORE_CASES and HCI_SCORE_REQUIRE replace what stands here. More cases tell more: score --cases 10, or --fresh.

cases=${HCI_SCORE_CASES:-1}
require=${HCI_SCORE_REQUIRE:-exact=0.9,false=0,holdout=1.15,within2=0.85}

build_dir=$2
hci_solve=$3
plain=$build_dir/nested/all/hci-solve # without sanitizers, which take minutes
[ ! -x "$plain" ] || hci_solve=$plain
"$hci_solve" diagnose --help >/dev/null 2>&1 || {
    echo "skipped: hci-solve has no command diagnose"
    exit 77
}
exec "$build_dir/tests/score" --solve "$hci_solve" --cases "$cases" --jobs 2 --verbose --require "$require"
