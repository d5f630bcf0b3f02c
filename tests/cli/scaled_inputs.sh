# Machines of found_inputs.sh and their recordings, diagnosed as they are and in another size: sourced by cli_scaled_*.sh, after common.sh. The
# factors are powers of two, so that nothing is rounded otherwise.
mkdir "$work/kept"
cd "$work" || exit 1
. "$source_dir/tests/cli/found_inputs.sh"

# diagnosed FOLDER MACHINE
diagnosed() {
    (cd "$1" && "$hci_solve" diagnose "$2" --runs "$2.csv" -q -o "out/$2") >stdout 2>stderr || [ $? -eq 1 ]
    check "$2 is diagnosed in $1" [ -s "$1/out/$2/summary.json" ]
}

# scaled MACHINE AMPERES NEWTON_METRES: results of such a size beside those of the machine.
scaled() {
    [ -e "out/$1" ] || diagnosed . "$1"
    folder=size_$2
    python3 "$source_dir/tests/cli/scaled.py" scale "$2" "$3" . "$folder" "$1" "$1"*.csv || exit 1
    diagnosed "$folder" "$1"
    shown="diagnose $1, currents times $2"
    check "results do not go with the size" python3 "$source_dir/tests/cli/scaled.py" compare "$2" "$3" out "$folder/out"
}
