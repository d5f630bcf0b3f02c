#!/bin/sh
# No percentage is printed with an exponent (1.2e+02 %): sentences print it by HCI_PERCENT and not by %g. Prints one line for
# each offence and fails when there is one.
#   percent.sh SOURCE_DIR
set -eu
cd "$1"
blank='( |\xC2\xA0|\\xC2\\xA0)?'
offences=$(find src cli -name '*.[ch]' | sort | while read -r file; do
    sed -e ':a' -e 'N' -e '$!ba' -e 's/" *\n *"//g' "$file" | grep -aoE "%[-+#0-9.*]*[eEgG]$blank%%.{0,30}" | sed "s|^|$file: |"
done)
[ -z "$offences" ] || { echo "$offences" | sed 's/^/percent: /'; exit 1; }
