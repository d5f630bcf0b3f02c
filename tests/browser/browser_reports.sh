#!/bin/sh
# labels: report slow
# The reports in a headless Chromium without network: nothing on the console, nothing fetched, readable in the light, in
# the dark, on a telephone, on paper, by keyboard and without JavaScript. Then copies of a report that are spoilt in one way each:
# what is wrong is said of each of them.
#   browser_reports.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
# To look at them: python3 tests/browser/check.py chromium EMPTY_FOLDER --pictures FOLDER report.html
. "$1/tests/support/common.sh"
use_plain_build
skip() {
    echo "skipped: $*"
    exit 77
}
for chromium in chromium chromium-browser google-chrome google-chrome-stable ''; do
    ! command -v "$chromium" >/dev/null || break
done
[ -n "$chromium" ] || skip "neither chromium nor google-chrome is installed, so that the reports were not opened"
"$chromium" --headless --no-sandbox --version >/dev/null 2>&1 || skip "$chromium does not start here"
command -v python3 >/dev/null || skip "python3 is not installed, which drives the browser"

cd "$source_dir" || exit 1
run 1 solve data/machine_a --target data/scenarios/02/target.csv --auto --limit-current 15 -q -o "$work/solve" --report
run 0 simulate data/machine_c data/drive/filho_strategy_3.csv -q -o "$work/simulate" --report
run 0 diagnose data/fem_c/machine --runs data/fem_c/runs.csv -q -o "$work/diagnose"
# orders that are no whole numbers, a torque of 50 mN.m with a ripple of a thousandth of it, and names that are long
printf 'name,value,unit,source\npole_pairs,12,1,test\n' >"$work/machine.csv"
mkdir -p "$work/small" && mv "$work/machine.csv" "$work/small/machine.csv"
printf 'order,amplitude_Nm_per_A,phase_rad\n1,0.0184,0\n' >"$work/small/back_emf.csv"
printf 'order,amplitude_Nm,phase_rad\n1.0833333333333333,3e-5,1\n4.583333333333333,1e-5,1\n5.916666666666667,1e-5,2\n6,5e-5,0.7\n6.083333333333333,1e-5,0\n' >"$work/small/cogging.csv"
printf 'order,set,amplitude_A,phase_rad\n1,pos,1.814,0\n' >"$work/sine.csv"
printf 'name,value,unit\nduration,2.1,s\nprescribed_speed,30,rpm\ncurrent_control,ideal,\nencoder_counts,20000,\n' >"$work/turn.csv"
run 0 simulate "$work/small" "$work/turn.csv" --currents "$work/sine.csv" -q -o "$work/small_simulated" --report
printf 'order,set\n1,pos\n5,neg\n' >"$work/set.csv"
run 1 solve data/machine_a --target data/scenarios/02/target.csv --harmonics "$work/set.csv" -q -o "$work/missed" --report
# a log in jerks, and one that is tuned
slow_turn() { # FILE SHARE: 7 pole pairs at 12 rpm, forward and back; cogging torque has no mean over the angle
    awk -v share="$2" 'BEGIN { print "t,i_q,theta_m"; for (k = 0; k < 2000; ++k) { t = 0.01 * k; way = t < 10 ? 1 : -1; x = 1.2566 * (10 + (t - 10) * way)
        printf "%.2f,%.5f,%.5f\n", t, way * 0.05 + 0.3 * (sin(84 * x + 0.4) - share / 2 * sin(0.4)), x + share * sin(84 * x) / 84 } }' >"$1"
}
slow_turn "$work/slow.csv" 0.1
run 0 tune "$work/slow.csv" --pole-pairs 7 --kv 120 -q -o "$work/tuned"
slow_turn "$work/jerks.csv" 0.9
run 1 tune "$work/jerks.csv" --pole-pairs 7 --kv 120 -q -o "$work/jerks"

# spoil CHECK NAME EXPECTED SED_EXPRESSION: a copy of the report in which something is wrong, and what is to be said of it.
mkdir -p "$work/spoilt" "$work/profile"
spoilt=
spoil() {
    sed "$4" "$work/solve/report.html" >"$work/spoilt/$2.html"
    printf '%s\t%s\n' "$2" "$3" >>"$work/expected"
    spoilt="$spoilt $1=$work/spoilt/$2.html"
    ! cmp -s "$work/solve/report.html" "$work/spoilt/$2.html" || fail "the copy $2 is not spoilt"
}
spoil light console 'console: spoilt' 's|</main>|<script>console.warn("spoilt")</script>&|'
spoil light exception 'exception: ' 's|</main>|<script>nothing.at.all()</script>&|'
spoil light request 'request: http://example.invalid/' 's|</main>|<img alt="" src="http://example.invalid/x.png"/>&|'
spoil phone wide 'wider than a telephone: ' 's|</main>|<div style="width:600px">.</div>&|'
spoil light light 'light: .*contrast' 's/--quiet:#5a6068/--quiet:#8b9099/'
spoil dark dark 'dark: .*contrast' 's/--quiet:#a6adb6/--quiet:#5a6068/'
spoil light pale 'polyline after: contrast' 's/\.hci \.after{stroke:#0072b2/.hci .after{stroke:#9fd0ee/'
spoil light role 'torque-title: no role' 's/role="img"/role="presentation"/'
spoil light title 'vector-title: no title' 's/<title id="vector-title">[^<]*/<title id="vector-title">/'
spoil light description 'limits-title: no description' 's/id="limits-desc"/id="nothing"/'
spoil light table 'torque-title: no table follows' 's|<tbody>|<tbody hidden=""></tbody>&|'
spoil light cut 'torque-title: cut off: ' 's/<text class="quiet end" x="[0-9.]*"/<text class="quiet end" x="14"/'
spoil light over 'torque-title: over another text: ' '/id="torque-title"/,/<\/svg>/s/<text class="quiet middle" x="[0-9.]*"/<text class="quiet middle" x="300"/'
spoil light sources 'spectrum-title: no sources' 's/ Made from: [^<]*//'
spoil light headings 'headings are not in order' 's/<h2>/<h4>/'
spoil light unnamed 'cannot be scrolled by keys' 's/class="table" tabindex="0"/class="table"/'
spoil light ringless 'no ring about the focus' 's/:focus-visible{outline:3px solid/:focus-visible{outline:0 solid/'
spoil light skipless 'the first stop is not a visible link' 's/\.skip:focus{top/.skip:focus{bottom/'
spoil paper paper 'cut off on paper' 's/@media print{/@media nothing{/'
spoil paper piece 'in one piece on paper' 's/@media print{/@media print{section{break-inside:avoid;min-height:500px}/'
spoil paper pages 'pages on paper' 's/@media print{/@media print{section{break-after:page}/'
spoil script script 'different without JavaScript' 's|</main>|<script>document.body.append("more")</script>&|'

# shellcheck disable=SC2086 # one word for each copy
python3 tests/browser/check.py "$(command -v "$chromium")" "$work/profile" "$work"/*/report.html $spoilt >"$work/found" 2>&1
check "the browser did not get to its end" [ $? -eq 1 ]
shown=
grep -v -e "^$work/spoilt/" -e '^network log: http://example.invalid/' "$work/found" >"$work/wrong"
sed "s|^$work/||" "$work/wrong"
check "a report is not as it should be" [ ! -s "$work/wrong" ]
while IFS="$(printf '\t')" read -r name expected; do
    check "nobody notices: $name" grep -q "^$work/spoilt/$name.html: .*$expected" "$work/found"
done <"$work/expected"
check "nobody notices in the network log" grep -q '^network log: http://example.invalid/' "$work/found"
finish
