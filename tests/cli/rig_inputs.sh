# Cases of the rig, which hides an effect in recordings of a machine of its own (tests/rigs/bench), diagnosed: sourced by cli_kept_rig_*.sh, after
# common.sh. The truth is the rig's; the numbers beside it are kept.
[ -x "$built/tests/rig" ] || {
    echo "skipped: the rig is not built here"
    exit 77
}
cd "$work" || exit 1
export OPENBLAS_NUM_THREADS=1
mkdir kept

# is_true CASE: each value that was hidden is found within four of its standard errors; of an invention, that something is unknown; of
# nothing, nothing.
is_true() {
    ! grep -q '^unknown_' "$1/truth.csv" || { grep -q '"verdict":	"unknown"' "kept/$1/summary.json"; return; }
    [ -e "kept/$1/machine/effects.csv" ] || [ "$(grep -c , "$1/truth.csv")" -eq 2 ] || return 1
    [ -e "kept/$1/machine/effects.csv" ] || return 0
    awk -F, 'function name_of(x,   part, n) { n = split(x, part, "_"); return part[n] + 0 > 0 ? sprintf("%s %.5f", substr(x, 1, length(x) - length(part[n])), part[n]) : x }
        FNR == 1 { next }
        NR == FNR { value[$1 name_of($2)] = $3; error[$1 name_of($2)] = $5; next }
        $1 != "noise" && $2 != "reference_current" {
            name = $1 name_of($2); off = value[name] - $3
            if (!(name in value) || off > 4 * error[name] || -off > 4 * error[name]) { print name ": " value[name] " ± " error[name] ", hidden " $3; bad = 1 } }
        END { exit bad }' "kept/$1/machine/effects.csv" "$1/truth.csv"
}

# diagnosed KIND SEED...
diagnosed() {
    kind=$1
    shift
    for seed; do
        name=${kind}_$seed shown="diagnose of the rig's $kind, seed $seed"
        "$built/tests/rig" $kind $seed $name >/dev/null || exit 1
        (cd $name && "$hci_solve" diagnose machine --runs runs.csv -q -o ../kept/$name) >stdout 2>stderr || [ $? -eq 1 ] || fail "it is refused"
        check "what was hidden is not found" is_true $name
    done
}
kept_all() { # NAME [--renew]
    shown="tests/cli/kept.py"
    check "results differ from tests/files/kept/$1.txt; where that is meant: the command of this test with --renew behind it" \
        python3 "$source_dir/tests/cli/kept.py" kept "$source_dir/tests/files/kept/$1.txt" ${2:+"$2"}
}
