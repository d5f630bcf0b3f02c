#!/bin/sh
# Shows that folders.py can fail: every offence below must be refused, alone and for the very reason given; what is right
# must pass.
#   folders_controls.sh CC
set -eu
here=$(cd "$(dirname "$0")" && pwd)
cc=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export PYTHONDONTWRITEBYTECODE=1
failed=0

# The tree that is right: core/math below core/machine, host/base below host/solve below cli. Circles through a public header
# and through a .c and its own .h are none.
tree() {
    root=$work/tree
    rm -rf "$root"
    for folder in src/core/math src/core/machine src/host/base src/host/solve include/hci/math include/hci/host/solve cli tests/layers; do
        mkdir -p "$root/$folder"
    done
    printf '%s: what it is for\n' core core/math core/machine host/base host/solve cli >"$root/tests/layers/order"
    echo '`core`, `src/core/math`, `core/machine/`, `host/base`, `host/solve` and `cli/`' >"$root/DESIGN.md"
    : >"$root/include/hci/status.h"
    : >"$root/include/hci/table.h"
    : >"$root/include/hci/math/lu.h"
    add src/core/status.c '#include "hci/status.h"' 'int status(void) { return 0; }'
    add src/core/math/lu.c '#include "hci/math/lu.h"' 'int status(void); int lu(void) { return status(); }'
    add src/core/machine/torque.c '#include "hci/math/lu.h"' 'int lu(void); int torque(void) { return lu(); }'
    add src/host/base/text.c '#include "hci/status.h"' '#include "hci/table.h"' 'int text(void) { return 0; }'
    add include/hci/host/solve/solve.h '#include "hci/math/lu.h"'
    add src/host/solve/newton.h '#include "hci/host/solve/solve.h"'
    add src/host/solve/newton.c '#include "newton.h"' 'int torque(void); int newton(void) { return torque(); }'
    add src/host/solve/solve.c '#include "hci/host/solve/solve.h"' '#include "host/solve/newton.h"' \
        'int newton(void), text(void); int solve(void) { return newton() + text(); }'
    add cli/main.c '#include "hci/host/solve/solve.h"' 'int solve(void); int main(void) { return solve(); }'
}

# add FILE LINE...
add() {
    file=$root/$1
    shift
    printf '%s\n' "$@" >>"$file"
}

# compile LAYER SOURCE: to an object where CMake puts it.
compile() {
    object=$work/objects/$1/CMakeFiles/any.dir/$2.o
    mkdir -p "${object%/*}"
    "$cc" -std=c99 -I"$root" -I"$root/src" -I"$root/include" -c "$root/$1/$2" -o "$object"
}

# Objects of the tree that is right, and one of a source that is gone.
compile_all() {
    for layer in src/core src/host cli; do
        for source in $(cd "$root/$layer" && find . -name '*.c'); do compile $layer "$source"; done
    done
    echo 'int solve(void); int gone(void) { return solve(); }' | "$cc" -c -x c - -o "$work/objects/src/core/CMakeFiles/any.dir/math/gone.c.o"
    cp -R "$work/objects" "$work/right"
}

# compiled NAME REASON [LAYER SOURCE]...: as expect, with the objects, of which these are other ones than in the tree that is right.
compiled() {
    compiled_name=$1 compiled_reason=$2
    shift 2
    rm -rf "$work/objects"
    cp -R "$work/right" "$work/objects"
    while [ $# -gt 0 ]; do
        compile "$1" "$2"
        shift 2
    done
    set -- "$compiled_name" "$compiled_reason"
    expect "$1" "$2" "$work/objects/src" "$work/objects/cli"
}

# expect NAME REASON [OBJECT_DIR...]: folders.py must say exactly REASON and fail, or say nothing and succeed.
expect() {
    name=$1 reason=$2 code=0
    shift 2
    said=$(python3 -S "$here/folders.py" "$root" "$@") || code=$?
    [ -n "$reason" ] && wanted=1 || wanted=0
    if [ "$said" = "$reason" ] && [ "$code" -eq "$wanted" ]; then
        echo "ok: $name: ${reason:-passes}"
    else
        echo "WRONG: $name: exit code $code, wanted \"$reason\", got \"$said\""
        failed=1
    fi
}

tree
compile_all
compiled "a tree in order" ""
add src/core/math/lu.c '#include "hci/host/solve/solve.h"'
expect "core/math includes a public header of host" "order-include: src/core/math/lu.c includes include/hci/host/solve/solve.h"
tree
add src/host/base/text.c '# include "../solve/newton.h"'
expect "a private header of a later folder" "order-include: src/host/base/text.c includes src/host/solve/newton.h"
tree
add include/hci/math/lu.h '#include <hci/host/solve/solve.h>'
sed -i '/lu.h/d' "$root/include/hci/host/solve/solve.h"
expect "a public header includes a later one" "order-include: include/hci/math/lu.h includes include/hci/host/solve/solve.h"
tree
add cli/words.h ''
add src/host/solve/solve.c '#include "cli/words.h"'
expect "host includes cli" "order-include: src/host/solve/solve.c includes cli/words.h"
tree
add src/core/math/lu.c 'int torque(void); int other(void) { return torque(); }'
sed -i 's/return lu()/return 0/' "$root/src/core/machine/torque.c"
compiled "core/math takes a symbol of core/machine" "order-symbol: core/math/lu takes torque from core/machine/torque" \
    src/core math/lu.c src/core machine/torque.c
tree
add src/host/solve/newton.c 'int solve(void); int again(void) { return solve(); }'
compiled "two objects in a circle" \
    "circle-symbol: host/solve/newton -> host/solve/solve (solve), host/solve/solve -> host/solve/newton (newton)" \
    src/host solve/newton.c
tree
add src/host/solve/newton.h 'extern const int limit;'
add src/host/solve/solve.c 'extern const int limit; const int limit = 1;'
add src/host/solve/newton.c 'int most(void) { return limit; }'
compiled "a constant closes the circle" \
    "circle-symbol: host/solve/newton -> host/solve/solve (limit), host/solve/solve -> host/solve/newton (newton)" \
    src/host solve/newton.c src/host solve/solve.c
tree
add src/host/solve/limits.h '#include "host/solve/newton.h"'
add src/host/solve/newton.c '#include "host/solve/limits.h"'
expect "two files include each other" \
    "circle-include: src/host/solve/limits -> src/host/solve/newton, src/host/solve/newton -> src/host/solve/limits"
tree
for k in $(seq 20); do add "src/host/base/file_$k.c" 'typedef int nothing;'; done
expect "21 files in a folder" "folder-size: host/base has 21 .c files, at most 20"
tree
mkdir "$root/src/host/attic"
add src/host/attic/old.c 'typedef int nothing;'
expect "a folder out of the order" "folder-unknown: tests/layers/order does not name host/attic"
tree
add tests/layers/order 'host/cellar: what is not there'
echo '`host/cellar`' >>"$root/DESIGN.md"
expect "a folder that is not there" "folder-unknown: there is no host/cellar, which tests/layers/order names"
tree
sed -i 's/`host.base`/the base/' "$root/DESIGN.md"
expect "a folder that DESIGN.md forgets" 'folder-unnamed: DESIGN.md does not name `host/base`'
tree
add include/hci/table.h '#include "hci/status.h"'
expect "table.h includes status.h" "table-include: include/hci/table.h includes include/hci/status.h"
tree
add include/hci/loop.h '#include "hci/table.h"' '#include "hci/status.h"'
expect "loop.h includes status.h" "table-include: include/hci/loop.h includes include/hci/status.h"
tree
mkdir "$work/none"
expect "no objects" "empty: no objects in $work/none" "$work/none"
rm -rf "$root/src" "$root/include" "$root/cli"
expect "no sources" "empty: no sources in $root" "$work/none"

exit $failed
