#!/bin/sh
# labels: report
# report.html as a reader has it: few figures, each under a sentence; every mark tells its value and is in the legend; no sentence stands
# twice; figures are those of summary.json; one angle for all pictures. Then copies that are spoilt in one way each: what is wrong is said of
# each of them.
#   cli_report_pages.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
use_plain_build
command -v python3 >/dev/null || {
    echo "skipped: python3 is not installed, which reads the reports"
    exit 77
}
cd "$source_dir" || exit 1

mkdir "$work/pages"
run 0 solve data/machine_a --target data/scenarios/02/target.csv --auto -q -o "$work/pages/solve" --report
run 1 solve data/machine_a --target data/scenarios/02/target.csv --auto --limit-current 15 -q -o "$work/pages/limit" --report
run 0 simulate data/machine_c data/drive/filho_strategy_3.csv -q -o "$work/pages/simulate" --report
run 0 diagnose data/fem_c/machine --runs data/fem_c/runs.csv -q -o "$work/pages/diagnose"
run 0 simulate data/machine_a data/drive/driven.csv -q -o "$work/driven"
run 0 tune "$work/driven/trajectory.csv" --pole-pairs 2 --kv 39 --torque 2.46 -q -o "$work/pages/driven"
# a servo of 4 pole pairs with unequal teeth on a bench with a torque sensor: its ripple is bounded, over more than one turn
bench() { # FILE i_q SPEED
    awk -v i="$2" -v w="$3" 'BEGIN { srand(5); p = 6.283185307179586; print "time_s,theta_m_rad,id_A,iq_A,torque_Nm"
        for (k = 0; k < 12000; ++k) { t = 0.0005 * k; a = w * t; n = 0.002 * sqrt(-2 * log(1 - rand())) * cos(p * rand())
            printf "%.4f,%.9f,0,%.5f,%.6f\n", t, a, i, 0.45 * i * (1 + 0.012 * sin(24 * a + 0.3)) + 0.03 * sin(24 * a + 0.8) + 0.01 * sin(6 * a) + n } }' >"$1"
}
for i in 0 1 2 3 4; do bench "$work/r$i.csv" $i $((3 + i % 3)); done
run 0 tune "$work"/r[0-4].csv --pole-pairs 4 --torque-constant 0.45 --rated-current 5 -q -o "$work/pages/bench"
check "the bound on the machine is not known" grep -q 'at most [0-9.]* N·m<small>' "$work/pages/bench/report.html"
check "what to record next has a measure of diagnose" [ "$(grep -c '"measure_next":.*χ²' "$work/pages/bench/summary.json")" -eq 0 ]

pages() { # FOLDER...
    python3 -B tests/cli/report_pages.py "$@" >"$work/found" 2>&1
}
check "a report is not as it should be" pages "$work"/pages/*
[ ! -s "$work/found" ] || cat "$work/found"

# spoil PAGE NAME EXPECTED SED_EXPRESSION
spoil() {
    mkdir -p "$work/spoilt/$2" && cp "$work/pages/$1/summary.json" "$work/spoilt/$2"
    sed "$4" "$work/pages/$1/report.html" >"$work/spoilt/$2/report.html"
    ! cmp -s "$work/pages/$1/report.html" "$work/spoilt/$2/report.html" || fail "the copy $2 is not spoilt"
    if pages "$work/spoilt/$2"; then fail "nobody notices: $2"; fi
    check "nobody says: $2: $(cat "$work/found")" grep -q "^$2: $3" "$work/found"
}
spoil limit six '6 figures' 's|</main>|<section><h2>One more than there is room for</h2><figure><figcaption>With a caption of its own</figcaption></figure></section>&|'
spoil solve wordless 'a figure under .*no sentence' 's|<h2>The phases carry[^<]*|<h2>Currents|'
spoil solve bare 'a figure over .*no caption' '0,/<figcaption>[^<]*/s//<figcaption>/'
spoil solve mute 'torque-title: <rect hit> tells nothing' '/<rect class="hit"/{x;s/^/x/;/^x$/{x;s/^/<\/g><g>/;x};x}'
spoil limit silent 'limits-title: <rect after> tells nothing' '/<title>phase current: /s/<title>[^<]*/<title>/'
spoil solve unnamed 'current-title: b is not in the legend' 's/<path class="b"/<path class="a"/'
spoil driven twice 'twice: what harmonics of the real back-emf add under load' 's|</main>|<p>What harmonics of the real back-EMF add under load is not known</p>&|'
spoil driven other 'Torque ripple, column 1: ' 's|\(Torque ripple in the model, peak to peak</th><td>\)[0-9.]*|\11.23|'
spoil bench bound 'Torque ripple: at most ' 's|at most [0-9.]* N·m<small>|at most 0.0001 N·m<small>|'
spoil driven known 'Torque ripple, column 3: .*it is not known' 's|<small>not known</small>|0.01 N·m|g'
spoil driven aside 'open-title: its angle is at ' '/id="open-title"/,/<\/svg>/s/<path class="grid" d="M\([0-9.]*\) \([0-9.]*\)L\1 /<path class="grid" d="M99.00 \2L99.00 /'
spoil driven late 'the first picture is nothing' '0,/aria-labelledby="torque-title"/s//aria-labelledby="nothing"/'
finish
