#!/bin/sh
# labels: slow
# The API reference is built without a warning: every public function, struct, field, constant and macro has its docstring. An undocumented
# one is refused. The programs on its main page are run by tests/consumer/consumer_library.sh.
#   docs_doxygen.sh SOURCE_DIR
set -eu
cd "$1"
for tool in doxygen python3; do
    command -v $tool >/dev/null || { echo "skipped: no $tool here"; exit 77; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

scripts/docs "$work/docs" 2>&1 || { echo "the docstrings above are missing or wrong"; exit 1; }
for header in $(cd include && find hci -name '*.h'); do
    page=$(basename "$header" .h | sed 's/_/__/g')_8h.html
    [ -s "$work/docs/html/$page" ] || { echo "no page of $header"; exit 1; }
    grep -q "$page" "$work/docs/html/index.html" || { echo "docs/api.md does not name $header"; exit 1; }
done

# two of the headers with a docstring less each, in a copy
mkdir -p "$work/copy/docs" "$work/copy/include/hci/drive"
cp -R Doxyfile cmake scripts "$work/copy"
cp docs/api.md "$work/copy/docs"
cp include/hci/version.h "$work/copy/include/hci"
cp include/hci/drive/control.h "$work/copy/include/hci/drive"
printf 'int hci_undocumented(void);\n' >>"$work/copy/include/hci/version.h"
sed -i 's|/\* V, .* not used by the ideal loop \*/||' "$work/copy/include/hci/drive/control.h"
if (cd "$work/copy" && scripts/docs "$work/refused") >"$work/log" 2>&1; then
    echo "not refused: members without a docstring"
    exit 1
fi
for refusal in 'hci_undocumented.*is not documented' 'Member v.*hci_control_state is not documented'; do
    grep -q "$refusal" "$work/log" || { cat "$work/log"; echo "refused, but not because of: $refusal"; exit 1; }
done
