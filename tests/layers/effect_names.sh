#!/bin/sh
# What is known of an effect stands in its one file: no file outside src/core/effects names an effect in a string, compares
# with its name, or uses its symbol hci_effect_NAME. Prints one line for each offence and fails when there is one.
#   effect_names.sh SOURCE_DIR
# Allowed: back_emf and cogging where a line is about the quantity of `harmonics` or about the tables back_emf.csv and
# cogging.csv (those are not "back_emf" alone); the key magnet_temperature of a scenario; the column mechanical_order.
set -eu
cd "$1"
names=$(sed -n 's/^ *X(\([a-z_]*\)).*/\1/p' src/core/effects/type.h | paste -s -d '|')
[ -n "$names" ] || { echo "empty: no registry in src/core/effects/type.h"; exit 1; }
folders=
for folder in src/host cli include src/core/math src/core/machine src/core/drive; do
    [ ! -d "$folder" ] || folders="$folders $folder"
done
offences=$(grep -rnE "\"($names)\"|\\bhci_effect_($names)\\b" $folders --include='*.[ch]' |
    grep -vE '(HCI_WAVEFORM_|"quantity").*"(back_emf|cogging)"' |
    grep -vE '^include/hci/host/simulate/simulate\.h:[0-9]+: *X\(magnet_temperature_C,' |
    grep -vE '^src/host/csv/[a-z_]+\.c:[0-9]+:.*"mechanical_order"' || true)
[ -z "$offences" ] || { echo "$offences" | sed 's/^/effect-name: /'; exit 1; }
