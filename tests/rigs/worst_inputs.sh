#!/bin/sh
# The worst input of each command, with time and peak memory of what it does of it: refused with words, done, or still at work
# when HCI_WORST_SECONDS (60) are over and Ctrl-C has ended it without a trace, but for the points of `sweep` and the motors of
# `batch`, from which they go on, and for a diagnosis that says that its search was interrupted. Not a ctest: it takes minutes, 1.2 GB of disk in TMPDIR and 1 GB of memory. docs/files.md, *How large*, has what was measured.
#   sh tests/rigs/worst_inputs.sh [HCI_SOLVE]
set -eu
cd "$(dirname "$0")/../.."
hci_solve=$(realpath "${1:-build/release/hci-solve}")
seconds=${HCI_WORST_SECONDS:-60}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
command -v /usr/bin/time >/dev/null || { echo "skipped: no /usr/bin/time here"; exit 77; }

python3 tests/rigs/worst_inputs.py "$work"
cd "$work"
failures=0

# What Ctrl-C may leave.
is_promised() {
    [ ! -e out ] || [ "$(ls out)" = "$(printf 'points.csv\nsweep.csv')" ] || [ "$(ls out)" = "$(printf 'fleet.csv\nfleet.sqlite\nmotors')" ] || grep -q '"search":.*"interrupted"' out/summary.json
}

# measure WHAT EXPECTED WORD...: EXPECTED is refused, done, or stopped (done, or still at work).
measure() {
    what=$1 expected=$2 command=$3
    shift 3
    rm -rf out
    code=0
    timeout -s INT "$seconds" /usr/bin/time -o figures -f '%e s, %U s of it computing, %M KiB' "$hci_solve" "$command" -q "$@" >said 2>&1 </dev/null || code=$?
    case $code in
        0 | 1) end=done ;;
        124 | 130) end=stopped ;;
        2 | 3) end=refused ;;
        *) end="code $code" ;;
    esac
    ! grep -q 'unknown option' said || end="not asked"
    [ "$end" = "$expected" ] || [ "$expected $end" = "stopped done" ] || { failures=$((failures + 1)); end="$end, EXPECTED $expected"; }
    [ "$end" = done ] || is_promised || { failures=$((failures + 1)); end="$end, LEFT FILES"; }
    printf '%-58s %-9s %s\n' "$what" "$end" "$(tail -n 1 figures)"
}

measure 'check: 10^6 samples' done check small run1e6.csv -o out
measure 'harmonics: 10^6 samples' done harmonics run1e6.csv --quantity cogging --pole-pairs 2 -o out
measure 'predict: 10^6 samples' done predict small run1e6.csv -o out
measure 'predict: 10^6 rows of effects.csv' stopped predict effects run20.csv -o out
measure 'solve: target of 10^6 rows' refused solve small --target target1e6.csv --auto -o out
measure 'solve: cogging.csv of 10^6 rows' refused solve cogging1e6 --target target.csv --auto -o out
measure 'solve: 10^5 components' refused solve small --target target.csv --harmonics set1e5.csv -o out
measure 'solve: 2000 orders of back-EMF and cogging, 2000 components' stopped solve emf2000 --target target.csv --harmonics set2000.csv -o out
measure 'solve: order 2000, --auto' stopped solve orders2000 --target target.csv --auto -o out
measure 'solve: target with a line of 1 GB' refused solve small --target line1GB.csv --auto -o out
measure 'diagnose: 10^5 recordings' refused diagnose small --runs runs1e5.csv -o out
measure 'diagnose: 4096 recordings of 20 samples' stopped diagnose small --runs runs4096.csv -o out
measure 'simulate: 10^15 steps' refused simulate small steps1e15.csv -o out
measure 'simulate: 4*10^9 steps' stopped simulate small steps4e9.csv -o out
measure 'emit: 10^5 rows of currents.csv' refused emit currents1e5.csv --name x -o out
measure 'emit: 10^4 rows of currents.csv, more than f32 holds' refused emit currents1e4.csv --name x -o out
measure 'tune: a log of 10^6 samples' done tune run1e6.csv --pole-pairs 2 --kv 100 -o out
measure 'tune: 4096 recordings of 20 samples' stopped tune small --runs runs4096.csv -o out
measure 'fit: 4096 recordings of 20 samples' stopped fit small --runs runs4096.csv -o out
measure 'batch: 10^5 motors' stopped batch motors1e5.csv --command solve -j 1 -o out -- --auto
measure 'fleet: 10^5 motors' done fleet fleet1e5 -o out
measure 'export-fmu: 2000 orders of back-EMF and cogging' done export-fmu emf2000 --sources-only -o out
measure 'sweep: grid of 10^6 points' stopped sweep small grid1e6.csv --auto -o out
[ "$failures" -eq 0 ]
