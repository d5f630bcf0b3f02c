#!/bin/sh
# labels: slow
# The bound that `solve` states for the machine that `diagnose` has corrected, against the rig's truth: what the true machine makes of the
# currents that were solved for the corrected one. Of twenty cases one may be outside; HCI_EXPECTED_SEEDS has the seeds of each kind.
. "$1/tests/support/common.sh"
use_plain_build
rig=$built/tests/rig
seeds=${HCI_EXPECTED_SEEDS:-1 2}

"$hci_solve" diagnose --help >/dev/null 2>&1 || {
    echo "skipped: hci-solve has no command diagnose"
    exit 77
}

# Rows of truth.csv that act in the machine, as effects.csv: solve's currents are the true ones at the true angle.
truth() { # CASE
    awk -F, 'NR == 1 { print $0 ",std_error"; next }
        $1 ~ /^(cogging|back_emf|phase_imbalance|reluctance|saturation|magnet_temperature|mechanical_order)$/ { print $0 "," }' "$1/truth.csv"
}

number() { # NAME FILE
    sed -n "s/^[[:space:]]*\"$1\":[[:space:]]*\([-0-9.e+]*\),*\$/\1/p" "$2" | head -n 1
}

# Ripple of the last torque_model_Nm column in per cent of its mean.
ripple() {
    awk -F, 'NR == 1 { for (k = 1; k <= NF; ++k) if ($k == "torque_model_Nm") c = k; next }
        { if (NR == 2 || $c > most) most = $c; if (NR == 2 || $c < least) least = $c; sum += $c }
        END { printf "%.6g\n", 100 * (most - least) * (NR - 1) / (sum < 0 ? -sum : sum) }' "$1"
}

for kind in none cogging back_emf phase_imbalance reluctance saturation magnet_temperature mechanical_order two; do
    for seed in $seeds; do
        case=$work/${kind}_$seed
        check "rig $kind $seed" "$rig" "$kind" "$seed" "$case"
        rated=$(sed -n 's/^rated_torque,\([^,]*\),.*/\1/p' "$case/machine/machine.csv")
        printf 'order,amplitude_Nm,phase_rad\n0,%s,1.5707963267948966\n' "$rated" >"$case/target.csv"
        "$hci_solve" diagnose "$case/machine" --runs "$case/runs.csv" --target "$case/target.csv" -q -o "$case/out"
        bound=$(number T_ripple_percent_95 "$case/out/solution/summary.json")
        truth "$case" >"$case/machine/effects.csv"
        run 0 predict "$case/machine" "$case/out/solution/waveform.csv" -q -o "$case/true.csv"
        [ -z "$bound" ] || echo "$kind $seed: ripple $(ripple "$case/true.csv") %, bound $bound %" | tee -a "$work/all"
        rm -rf "$case"
    done
done
awk '{ ++cases; inside += $4 + 0 <= $7 + 0; if ($4 + 0 > 0) ratio[++n] = $7 / $4 }
    END { printf "%d of %d within the bound\n", inside, cases; exit !(cases > 0 && inside >= 0.95 * cases - 1e-9) }' "$work/all" ||
    fail "more than one of twenty outside of the bound"
finish
