# The eight runs of docs/measuring.md, from the bench of tests/rigs/bench: a machine with two pole pairs and a current sensor with an offset. In the
# runs without current the terminals are open, and their voltages are written by the formula.
# Called in a scratch folder with $rig; without the bench it names what is then not there.
[ -n "${rig:-}" ] || {
    echo runs runs.csv new.csv machine
    exit 77
}
set -e
"$rig" current_offset 4 bench
mkdir runs
cp -R bench/machine machine

# with_voltages RUN: its rows with va_V, vb_V, vc_V behind them.
with_voltages() {
    awk -F, '
        NR == FNR { if (FNR > 1) { order[++n] = $1; amplitude[n] = $2; phase[n] = $3 } next }
        FNR == 1 { print $0 ",va_V,vb_V,vc_V"; next }
        {
            row = $0
            for (s = 0; s < 3; ++s) {
                e = 0
                for (k = 1; k <= n; ++k)
                    e += amplitude[k] * sin(order[k] * (2 * $2 - s * 2.0943951023931953) + phase[k])
                row = row "," $3 * e
            }
            print row
        }' bench/machine/back_emf.csv "$1"
}

echo file,role >runs.csv
while read -r file name role; do
    case $name in
        zero_*) with_voltages "bench/runs/$file.csv" ;;
        *) cat "bench/runs/$file.csv" ;;
    esac >"runs/$name.csv"
    echo "runs/$name.csv,$role" >>runs.csv
done <<'END'
02 zero_forward fit
01 zero_backward fit
05 full_slow fit
07 half_lead_fast fit
06 full_lag_fast fit
08 full_brake_slow fit
03 quarter_fast fit
11 held_out holdout
END

# And one more, as if it had been asked for.
cp bench/runs/09.csv runs/next.csv
printf 'file,role\nruns/next.csv,fit\n' >new.csv
