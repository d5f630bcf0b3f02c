#!/bin/sh
# Shows that effect_names.sh can fail: each offence below must be refused, the good lines must pass.
#   effect_names_controls.sh
set -eu
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0

# expect NAME CODE FILE LINE: a tree with this line in FILE.
expect() {
    root=$work/tree
    rm -rf "$root"
    mkdir -p "$root/src/core/effects" "$root/src/host/diagnose" "$root/cli" "$root/src/host/csv" "$root/include/hci/host/simulate"
    printf '#define HCI_EFFECT_TYPES(X) \\\n    X(cogging) \\\n    X(back_emf) \\\n    X(mechanical_order) \\\n    X(magnet_temperature)\n' >"$root/src/core/effects/type.h"
    echo "$4" >"$root/$3"
    code=0
    said=$(sh "$here/effect_names.sh" "$root") || code=$?
    if [ "$code" -eq "$2" ]; then
        echo "ok: $1: ${said:-passes}"
    else
        echo "WRONG: $1: exit code $code, wanted $2, got \"$said\""
        failed=1
    fi
}

expect "a comparison with a name" 1 src/host/diagnose/a.c 'if (strcmp(type->name, "cogging") == 0) return;'
expect "a look-up by name" 1 cli/a.c 'x = hci_effect_type_find("back_emf");'
expect "the symbol of an effect" 1 src/host/diagnose/a.c 'return type == &hci_effect_cogging;'
expect "a name in a public header" 1 include/hci/host/a.h 'X("magnet_temperature")'
expect "a table's file name" 0 src/host/diagnose/a.c 'path(folder, "cogging.csv");'
expect "the quantity of harmonics" 0 cli/a.c '[HCI_WAVEFORM_COGGING] = {"cogging", NULL},'
expect "prose" 0 src/host/diagnose/a.c '"the cogging torque of this machine"'
expect "the key of a scenario" 0 include/hci/host/simulate/simulate.h '    X(magnet_temperature_C, "magnet_temperature", "C")'
expect "a column" 0 src/host/csv/alias.c 'PLAIN("mechanical_order", "order", "1", "many"),'
expect "an effect of the name of a column" 1 src/host/diagnose/a.c 'strcmp(name, "mechanical_order")'
expect "an effect itself" 0 src/core/effects/cogging.c 'const hci_effect_type hci_effect_cogging = {.name = "cogging"};'
expect "no registry" 1 src/core/effects/type.h ''
exit $failed
