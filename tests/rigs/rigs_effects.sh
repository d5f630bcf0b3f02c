#!/bin/sh
# labels: slow
# Two implementations of every effect, the library's and the rig's: with the rig's truth for effects.csv, what `predict` leaves of the
# held-out runs is the rig's noise.

. "$1/tests/support/common.sh"
rig=$(cd "$2" && pwd)/tests/rig

"$hci_solve" predict --help >/dev/null 2>&1 || {
    echo "skipped: hci-solve has no command predict"
    exit 77
}

# Mean square of the last column, residual_Nm.
mean_square() {
    awk -F, 'NR == 1 { if ($NF != "residual_Nm") exit; next } { sum += $NF * $NF } END { printf "%.9g\n", sum / (NR - 1) }' "$1"
}

# Largest ratio to the noise. predict turns delayed currents by their slope, which noise blurs where harmonics are injected, and
# follows the torque sensor by the trapezoidal rule from a settled start.
bar_of() {
    case $1 in
        channel_delay | torque_sensor | two) echo 1.4 ;;
        *) echo 1.002 ;;
    esac
}

for kind in $("$rig" --list | grep -v '^unknown_'); do
    for seed in 2 3; do
        case=$work/${kind}_$seed
        check "rig $kind $seed" "$rig" "$kind" "$seed" "$case"
        sed -e '/^noise,/d' -e 's/$/,/' -e '1s/,$/,std_error/' "$case/truth.csv" >"$case/machine/effects.csv"
        for file in $(sed -n 's/,holdout//p' "$case/runs.csv"); do
            run 0 predict "$case/machine" "$case/$file" -o "$case/predicted.csv" --quiet
            mean_square "$case/predicted.csv"
        done >"$case/squares"
        noise=$(sed -n 's/^noise,rms,\(.*\),Nm/\1/p' "$case/truth.csv")
        ratio=$(awk -v noise="$noise" '{ sum += $1 } END { printf "%.4f\n", sqrt(sum / NR) / noise }' "$case/squares")
        bar=$(bar_of "$kind")
        check "$kind $seed: residual/noise $ratio, expected 0.998 … $bar" \
            awk -v r="$ratio" -v bar="$bar" 'BEGIN { exit !(r > 0.998 - 0.01 * (bar > 1.1) && r <= bar) }'
        rm -rf "$case"
    done
done
finish
