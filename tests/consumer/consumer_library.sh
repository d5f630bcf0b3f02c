#!/bin/sh
# labels: slow
# What an installed library promises to its users: it can be moved, found by CMake and by pkg-config, used from C and C++
# with warnings as errors, and a version that does not fit is refused.
#   consumer_library.sh SOURCE_DIR BUILD_DIR      BUILD_DIR/nested/all and nested/core are built, without sanitizers
set -eu
all=$2/nested/all core=$2/nested/core
consumer=$1/tests/consumer
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
strict='-std=c99 -Wall -Wextra -Wpedantic -Werror'

step() {
    echo "--- $*"
}

# refused REASON COMMAND...: the command fails and its output, line breaks aside, matches REASON.
refused() {
    reason=$1
    shift
    if "$@" >"$work/log" 2>&1; then
        echo "not refused: $*"
        exit 1
    fi
    tr -s '\n ' ' ' <"$work/log" | grep -q "$reason" || {
        cat "$work/log"
        echo "refused, but not because of: $reason"
        exit 1
    }
}

# configure PREFIX PROJECT BUILD [OPTION...]
configure() {
    prefix=$1 project=$2 build=$3
    shift 3
    cmake --log-level=NOTICE -G Ninja -S "$project" -B "$build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_C_FLAGS="$strict" "$@"
}

# A project that only asks for the package: asks PREFIX ARGUMENTS-OF-find_package
asks() {
    rm -rf "$work/asks"
    mkdir "$work/asks"
    printf 'cmake_minimum_required(VERSION 3.25)\nproject(asks LANGUAGES C)\nfind_package(hci %s)\n' "$2" \
        >"$work/asks/CMakeLists.txt"
    configure "$1" "$work/asks" "$work/asks/build"
}

# use_package PREFIX COMPONENT: builds and runs tests/consumer/COMPONENT.
use_package() {
    configure "$1" "$consumer/$2" "$work/build-$2"
    cmake --build "$work/build-$2"
    "$work/build-$2/consumer"
    rm -rf "$work/build-$2"
}

# One header after the other, alone, must compile.
compile_headers() {
    (cd "$1/include" && find hci -name '*.h' | sort) | while read -r header; do
        printf '#include <%s>\ntypedef int used;\n' "$header" | cc $strict -I"$1/include" -fsyntax-only -x c -
        printf '#include <%s>\ntypedef int used;\n' "$header" | c++ -std=c++20 -Wall -Wextra -Wpedantic -Werror -I"$1/include" -fsyntax-only -x c++ -
    done
}

pkg_config() {
    PKG_CONFIG_PATH=$(dirname "$(find "$work/moved" -name hci-core.pc)") pkg-config --static "$@"
}

step install, then move
cmake --install "$all" --prefix "$work/first"
mv "$work/first" "$work/moved"
if grep -rlF -e "$work/first" -e "$1" "$work/moved"; then
    echo "these files name the folder that they were built in or installed to"
    exit 1
fi

version=$(sed -n 's/.*HCI_VERSION_STRING "\(.*\)"/\1/p' "$work/moved/include/hci/version.h")

step the program
"$work/moved/bin/hci-solve" --version | grep -F "$version"

step CMake
use_package "$work/moved" core
use_package "$work/moved" host
asks "$work/moved" "0.1 REQUIRED"
incompatible='configuration file .* compatible with requested version'
# While it is 0.x, the interface may change with each minor version, so 0.1 stands in for no other.
refused "$incompatible .0\.0" asks "$work/moved" "0.0 REQUIRED COMPONENTS core"
refused "$incompatible .0\.2" asks "$work/moved" "0.2 REQUIRED COMPONENTS core"
refused "$incompatible .99" asks "$work/moved" "99 REQUIRED COMPONENTS core"
refused 'has no component nonsense' asks "$work/moved" "0.1 REQUIRED COMPONENTS nonsense"

step headers
compile_headers "$work/moved"

step pkg-config
[ "$(pkg_config --modversion hci-core hci-host)" = "$version
$version" ]
refused 'hci-core >= 99' pkg_config --print-errors --exists 'hci-core >= 99'
c++ -c "$consumer/core/torque.cpp" $(pkg_config --cflags hci-core) -o "$work/torque.o"
cc $strict "$consumer/core/main.c" "$work/torque.o" $(pkg_config --cflags --libs hci-core) -o "$work/core"
"$work/core"
cc $strict "$consumer/host/main.c" $(pkg_config --cflags --libs hci-host) -o "$work/host"
"$work/host"

step the programs of docs/api.md
api=$1/docs/api.md
# api_program N LIBRARY [ARGUMENT...]: the Nth program on the page prints what the page says.
api_program() {
    awk -v n="$1" '/^```c$/ { k++; on = 1; next } /^```$/ { on = 0 } on && k == n' "$api" >"$work/api$1.c"
    awk -v n="$1" '/^```c$/ { k++; p = 0 } /prints$/ { p = k } p == n && sub(/^    /, "")' "$api" >"$work/printed"
    [ -s "$work/printed" ] || { echo "docs/api.md does not say what its program $1 prints"; exit 1; }
    cc $strict "$work/api$1.c" $(pkg_config --cflags --libs "$2") -o "$work/api$1"
    (program=$work/api$1 && shift 2 && cd "$work" && "$program" "$@") | diff "$work/printed" -
}
api_program 1 hci-core
api_program 2 hci-host "$1/data/machine_a" "$1/data/scenarios/02/target.csv"
[ -s "$work/currents/currents.csv" ]

step core alone
cmake --install "$core" --prefix "$work/core-only"
use_package "$work/core-only" core
[ ! -e "$work/core-only/bin" ] && [ ! -e "$work/core-only/include/hci/host" ]
refused 'has no component host' asks "$work/core-only" "0.1 REQUIRED COMPONENTS host"

echo done
