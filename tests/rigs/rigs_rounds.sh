#!/bin/sh
# labels: slow
# Rounds of diagnose, solve and record on machines of lumped teeth (tests/rigs/rounds/teeth.c), whose iron is none of the series of the library: in
# each round what was promised of the currents is kept when they are played, and the ripple falls to what the bench resolves.
# HCI_ROUNDS_SEEDS: machines; every fourth has no noise, the others 0.02, 0.1 and 0.3 % of the rated torque.
#   rigs_rounds.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
use_plain_build
teeth=$built/tests/teeth

"$hci_solve" diagnose --help >/dev/null 2>&1 || {
    echo "skipped: hci-solve has no command diagnose"
    exit 77
}

number() { # NAME FILE
    sed -n "s/^[[:space:]]*\"$1\":[[:space:]]*\([-0-9.e+]*\),*\$/\1/p" "$2" | head -n 1
}

# Ripple of the true machine with the currents of a solution, in per cent of its mean.
ripple() { # SEED WAVEFORM
    "$teeth" "$1" true "$2" | awk '{ printf "%.6g\n", 100 * $2 / ($1 < 0 ? -$1 : $1) }'
}

# What was promised of the last currents, and what they make.
round() { # SEED NUMBER
    made=$(ripple "$1" "$work/$1/out$2/solution/waveform.csv")
    bound=$(number T_ripple_percent_95 "$work/$1/out$2/solution/summary.json")
    [ "$2" -ne 1 ] || first=$made
    within=
    [ "$2" -eq 1 ] || within="; error of the last machine $(number rms_last_Nm "$work/$1/out$2/summary.json") N·m, bound $(number bound_Nm_95 "$work/$1/out$2/summary.json")"
    echo "machine $1, round $2: ripple $made %, bound $bound %$within"
    echo "$made ${bound:-0}" >>"$work/promises"
}

for seed in ${HCI_ROUNDS_SEEDS:-5 6}; do
    check "teeth $seed" "$teeth" "$seed" "$work/$seed"
    run 0 solve "$work/$seed/machine" --target "$work/$seed/target.csv" --auto -q -o "$work/$seed/declared"
    declared=$(ripple "$seed" "$work/$seed/declared/waveform.csv")
    echo "machine $seed, currents of the declared machine: ripple $declared %"
    "$hci_solve" diagnose "$work/$seed/machine" --runs "$work/$seed/runs.csv" --target "$work/$seed/target.csv" -q -o "$work/$seed/out1"
    round "$seed" 1
    for k in 1 2 3; do
        next=$((k + 1))
        "$teeth" "$seed" play "$work/$seed/out$k/solution/waveform.csv" "$work/$seed/runs/played$k.csv" "$k"
        printf 'file,role\nruns/played%s.csv,fit\n' "$k" >"$work/$seed/new$k.csv"
        "$hci_solve" diagnose --again "$work/$seed/out$k" --runs "$work/$seed/new$k.csv" --target "$work/$seed/target.csv" -q -o "$work/$seed/out$next"
        echo "$(number rms_last_Nm "$work/$seed/out$next/summary.json") $(number bound_Nm_95 "$work/$seed/out$next/summary.json")" >>"$work/promises"
        round "$seed" "$next"
    done
    check "machine $seed: ripple $made % after three rounds, $first % before, $declared % without" \
        awk -v made="$made" -v first="$first" -v declared="$declared" 'BEGIN { exit !(made <= 1.5 * first && made < 0.2 * declared) }'
done
awk '{ ++all; kept += $1 <= $2 } END { printf "%d of %d ripples and errors within the bound\n", kept, all; exit !(all > 0 && kept >= 0.95 * all - 1e-9) }' "$work/promises" ||
    fail "more than one of twenty outside of the bound"
finish
