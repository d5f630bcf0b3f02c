#!/bin/sh
# Shows that check.sh can fail: every offence below must be refused, and for the very reason given; the good examples
# must pass.
#   controls.sh CC
set -eu
here=$(cd "$(dirname "$0")" && pwd)
cc=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0

# expect NAME REASON RULES PATH: check.sh must say exactly REASON and fail, or say nothing and succeed.
expect() {
    code=0
    said=$(sh "$here/check.sh" "$3" "$4") || code=$?
    [ -n "$2" ] && wanted_code=1 || wanted_code=0
    if [ "$said" = "$2" ] && [ "$code" -eq "$wanted_code" ]; then
        echo "ok: $1: ${2:-passes}"
    else
        echo "WRONG: $1: exit code $code, wanted \"$2\", got \"$said\""
        failed=1
    fi
}

# The first line of a control holds the reason in double quotes, or says that it must pass.
for source in "$here"/controls/*.c; do
    name=$(basename "$source" .c)
    "$cc" -std=c99 -O2 -DNDEBUG -c "$source" -o "$work/$name.o"
    ar rc "$work/$name.a" "$work/$name.o"
    reason=$(sed -n '1s/.*"\(.*\)".*/\1/p' "$source")
    expect "$name" "$reason" "${name%%_*}" "$work/$name.a"
done

# include NAME REASON FILE LINE [FILE LINE]: a tree with these includes.
include() {
    root=$work/tree
    rm -rf "$root"
    mkdir -p "$root/src/core" "$root/src/host" "$root/cli" "$root/include/hci/host"
    name=$1
    reason=$2
    shift 2
    while [ $# -gt 0 ]; do
        echo "$2" >>"$root/$1"
        shift 2
    done
    expect "$name" "$reason" includes "$root"
}

include "includes that may be" "" \
    src/core/a.c '#include <math.h>' src/core/a.c '#include "hci/status.h"' src/core/a.c '#include "b.h"' \
    src/host/c.c '#include <stdio.h>' src/host/d.c '#include <stdio.h>' src/host/c.c '#include <umfpack.h>' \
    src/host/d.c '#include <cjson/cJSON.h>' src/host/c.c '#include "hci/host/csv.h"' cli/e.c '#include <unistd.h>' \
    include/hci/host/csv.h '#include <stdio.h>' include/hci/status.h '#include <stddef.h>'
include "stdlib in core" "core-include: src/core/a.c includes <stdlib.h>" src/core/a.c '# include <stdlib.h>'
include "stdio in a core header" "core-include: include/hci/a.h includes <stdio.h>" include/hci/a.h '#include <stdio.h>'
include "host in core" 'core-include: src/core/a.c includes "hci/host/csv.h"' src/core/a.c '#include "hci/host/csv.h"'
include "cli in host" 'host-include: src/host/a.c includes "../cli/b.h"' src/host/a.c '#include "../cli/b.h"'
include "system header in a host header" 'host-include: public include/hci/host/a.h includes <sys/stat.h>' \
    include/hci/host/a.h '#include <sys/stat.h>'
include "two files know zlib.h" "one-owner: zlib.h in src/host/b.c and in src/host/a.c" \
    src/host/a.c '#include <zlib.h>' src/host/b.c '#include <zlib.h>'
include "two files know SuiteSparseQR_C.h" \
    'one-owner: SuiteSparseQR_C.h in src/host/b.c and in src/host/a.c' \
    src/host/a.c '#include "SuiteSparseQR_C.h"' src/host/b.c '#include <suitesparse/SuiteSparseQR_C.h>'
include "cli knows sqlite3.h" "one-owner: <sqlite3.h> in cli/a.c" cli/a.c '#include <sqlite3.h>'
include "cli knows cJSON.h" "one-owner: <cjson/cJSON.h> in cli/a.c" cli/a.c '#include <cjson/cJSON.h>'
expect "an archive without members" "empty: no symbols in $work/none.a" core "$work/none.a"
mkdir "$work/nothing"
expect "a folder without sources" "empty: no src/core or include/hci in $work/nothing" includes "$work/nothing"

exit $failed
