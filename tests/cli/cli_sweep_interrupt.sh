#!/bin/sh
# labels: slow
# A sweep that Ctrl-C or a kill ends keeps the points that it has, and goes on from them to the bytes of one that was not ended.
# Slow because points are kept from the first second on, and the sweep has to run so long.
#   cli_sweep_interrupt.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
. "$1/tests/cli/small_machine.sh"
use_plain_build
cd "$source_dir" || exit 1

fresh
printf 'resistance,0.3,ohm,test\ninductance_d,1.5,mH,test\ninductance_q,1.5,mH,test\n' >>"$m/machine.csv"
printf 'order,set\n1,pos\n5,neg\n7,pos\n11,neg\n13,pos\n' >"$h"
long="sweep $m --map --torques 0.2:2:0.01 --speeds 300,900,1500 --limit-current 12 --limit-voltage 40 --harmonics $h --minimise peak-to-peak"
# shellcheck disable=SC2086
run 0 $long -q -o "$work/whole"

# ended SIGNAL CODE FOLDER: the sweep, ended as soon as some points are kept, and gone on.
ended() {
    shown="hci-solve $long, and kill -$1"
    # shellcheck disable=SC2086
    env --default-signal=INT "$hci_solve" $long --jobs 1 -o "$3" >"$work/stdout" 2>"$work/stderr" &
    job=$!
    tries=0
    while [ ! -s "$3/points.csv" ] && kill -0 $job 2>/dev/null && [ $tries -lt 600 ]; do sleep 0.05 && tries=$((tries + 1)); done
    kill "-$1" $job 2>/dev/null
    wait $job 2>/dev/null
    code=$?
    check "exit code $code of a program that was ended" [ $code -eq "$2" ]
    check "results of a sweep that was ended" [ ! -e "$3/map.csv" ]
    kept=$(($(wc -l <"$3/points.csv") - 1))
    check "$kept points of 543 were kept" [ "$kept" -gt 0 -a "$kept" -lt 543 ]
    [ "$1" = KILL ] || says "note: ended early: $kept of 543 points are done and kept in .*; the same command goes on from there"
    # shellcheck disable=SC2086
    run 0 $long -q -o "$3"
    rm -f "$3"/.hci-*
    check "ended by $1 and gone on is not the whole" diff -r "$work/whole" "$3"
}
ended INT 130 "$work/interrupted"
ended TERM 143 "$work/terminated"
ended KILL 137 "$work/killed"

finish
