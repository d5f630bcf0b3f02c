#!/bin/sh
# A motor whose currents are 64 times as small, and its torques 4096 times, has the same effects, so many times as small, and so does
# one as much larger: no size in amperes or newton metres is built in. The factors are powers of two, so that nothing is rounded otherwise.
#   cli_scaled.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
use_plain_build
. "$source_dir/tests/cli/kept_inputs.sh"
. "$source_dir/tests/cli/found_inputs.sh"
cd "$work" || exit 1
machines="iron free slow swung"

# results FOLDER MACHINE...
results() {
    folder=$1
    shift
    cd "$folder" || exit 1
    for name; do
        "$hci_solve" diagnose $name --runs $name.csv -q -o out/$name >"$work/stdout" 2>"$work/stderr" || [ $? -eq 1 ]
        check "$name is diagnosed in $folder" [ -s out/$name/summary.json ]
    done
    cd "$work" || exit 1
}

results . $machines
while read -r folder amperes newton_metres which; do
    python3 "$source_dir/tests/cli/scaled.py" scale $amperes $newton_metres . $folder $machines *.csv || exit 1
    results $folder $which
    shown="$folder: diagnose $which"
    check "results do not go with the size" python3 "$source_dir/tests/cli/scaled.py" compare $amperes $newton_metres out $folder/out
done <<END
small 0.015625 0.000244140625 $machines
large 64 4096 free slow
END
finish
