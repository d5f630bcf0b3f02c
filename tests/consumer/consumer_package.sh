#!/bin/sh
# labels: slow
# The packages that cpack makes, as a user has them: unpacked somewhere, with a clean environment and in a folder of their own. Program, man
# page, completion, libraries, headers, CMake package, pkg-config, documents with their commands, and nothing that names the folder it
# was built in.
#   consumer_package.sh SOURCE_DIR BUILD_DIR      BUILD_DIR/nested/all is built, without sanitizers
set -eu
source_dir=$(cd "$1" && pwd)
tests=$source_dir/tests
build=$(cd "$2" && pwd)
built=$build/nested/all
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

step() {
    echo "--- $*"
}

fail() {
    echo "consumer_package: $*"
    exit 1
}

for tool in dpkg-deb dpkg-shlibdeps file cpack; do
    command -v $tool >/dev/null || { echo "skipped: no $tool here"; exit 77; }
done

# ---- made twice, with the same bytes

make_packages() {
    (cd "$built" && SOURCE_DATE_EPOCH=1000000000 cpack -B "$1") >"$work/log" 2>&1 || { cat "$work/log"; fail "cpack"; }
}
step cpack
make_packages "$work/first"
sleep 1
make_packages "$work/second"
for package in "$work"/first/*.deb "$work"/first/*.tar.gz; do
    cmp "$package" "$work/second/$(basename "$package")" || fail "$(basename "$package") is not reproducible"
done
rm -r "$work/second"
mkdir "$work/deb" "$work/tar"
dpkg-deb -x "$work"/first/*.deb "$work/deb"
tar -xf "$work"/first/*.tar.gz -C "$work/tar"

# ---- what the .deb says of itself

step control
field() {
    dpkg-deb -f "$work"/first/*.deb "$1"
}
version=$(sed -n 's/^#define HCI_VERSION_STRING "\(.*\)"/\1/p' "$source_dir/include/hci/version.h")
[ "$(field Package) $(field Version)" = "hci-solve $version" ] || fail "control: $(field Package) $(field Version)"
for library in libc6 libcholmod libcjson libsqlite3- libspqr libumfpack; do
    field Depends | grep -q "$library[0-9]* (>= " || fail "does not depend on $library: $(field Depends)"
done
for name in Maintainer Section Description Architecture Installed-Size; do
    [ -n "$(field $name)" ] || fail "control has no $name"
done
gzip -dc "$work/deb/usr/share/man/man1/hci-solve.1.gz" | grep -q '^\.TH' || fail "man page is not compressed"
dpkg-deb -e "$work"/first/*.deb "$work/control"
(cd "$work/deb" && md5sum --quiet -c "$work/control/md5sums") || fail "md5sums"
if command -v lintian >/dev/null; then
    lintian --allow-root --fail-on error "$work"/first/*.deb >"$work/log" 2>&1 || { cat "$work/log"; fail "lintian"; }
fi

# ---- used

# clean WORD...: with nothing of this environment, in the folder `here`
clean() {
    (cd "$work/here" && env -i PATH="$root/bin:/usr/bin:/bin" HOME="$work/home" LC_ALL=C.UTF-8 "$@") || fail "$*"
}

says_nothing_of_the_build() {
    for place in "$built" "$build" "$source_dir" "$work/first"; do
        # as a path of its own: the last part of a short one, such as /src, stands in many words
        if grep -rlE -e "(^|[^A-Za-z0-9_./-])$place(/|[^A-Za-z0-9_.-]|\$)" "$1"; then
            fail "the files above name $place"
        fi
    done
    strings "$1/bin/hci-solve" | grep -E '^/(home|root|tmp)/' && fail "the program names a folder"
    find "$1" -name '*.gz' -exec gzip -dc {} + | grep -E -e "(^|[^A-Za-z0-9_./-])($source_dir|$built)/" && fail "a compressed file names the build"
    return 0
}

use_program() {
    clean hci-solve --version | grep -Fqx "hci-solve $version" || fail "not hci-solve $version"
    clean cp -R "$doc/data" .
    clean hci-solve solve data/machine_a --target data/scenarios/02/target.csv --auto -o out --quiet
    clean hci-solve emit out --name table --frame dq --points 512 -o out --quiet
    printf '%s\n' '#include "table.h"' '#include <stdio.h>' 'int main(void)' '{' \
        '    const hci_currents_dq i = hci_table_f32_dq(&table, 0u);' \
        '    return hci_table_f32_check(&table) == HCI_TABLE_GOOD && printf("%g A\n", (double)i.iq_A) > 0 ? 0 : 1;' '}' >"$work/here/use.c"
    clean cc -std=c99 -Wall -Wextra -Wpedantic -Werror -I"$root/include" -Iout use.c out/table.c -o use
    clean ./use
}

use_shell() {
    page=$(ls "$root"/share/man/man1/hci-solve.1*)
    if command -v mandoc >/dev/null; then
        clean mandoc -Tutf8 "$page" >"$work/page"
    elif command -v man >/dev/null; then
        clean man -l "$page" >"$work/page"
    else
        gzip -dcf "$page" >"$work/page"
    fi
    grep -q 'machine_a' "$work/page" || fail "the man page is empty"
    clean bash -c 'source "$0/share/bash-completion/completions/hci-solve" && complete -p hci-solve &&
        COMP_WORDS=(hci-solve solve --method poi) COMP_CWORD=3 && _hci_solve && [[ ${COMPREPLY[*]} == pointwise ]]' "$root"
    head -n 1 "$root/share/zsh/site-functions/_hci-solve" | grep -qx '#compdef hci-solve' || fail "no completion for zsh"
}

use_libraries() {
    for component in core host; do
        clean cmake --log-level=NOTICE -G "${CMAKE_GENERATOR:-Ninja}" -S "$tests/consumer/$component" -B "build-$component" -DCMAKE_PREFIX_PATH="$root"
        clean cmake --build "build-$component"
        clean "./build-$component/consumer"
    done
    clean env PKG_CONFIG_PATH="$root/lib/pkgconfig" sh -c \
        'cc -std=c99 "$0" $(pkg-config --static --cflags --libs hci-host) -o host && ./host' "$tests/consumer/host/main.c"
}

# The project for a microcontroller, built where it was installed to.
use_firmware() {
    command -v arm-none-eabi-gcc >/dev/null || { echo "left out: firmware, no arm-none-eabi-gcc here"; return; }
    clean cmake --log-level=NOTICE -G "${CMAKE_GENERATOR:-Ninja}" -S "$doc/examples/mcu" -B firmware --toolchain "$doc/cmake/cortex-m4.cmake" \
        -DHCI_CURRENTS="$work/here/out"
    clean cmake --build firmware
}

# The commands of README and two tutorials, in the documents, data and examples that were installed.
use_documents() {
    mkdir "$work/used"
    ln -s "$tests" "$work/used/tests"
    for name in README.md docs data examples; do
        ln -s "$doc/$name" "$work/used/$name"
    done
    # shellcheck disable=SC2046
    clean sh "$tests/docs/docs_commands.sh" "$work/used" "$build" "$root/bin/hci-solve" README.md $(cd "$doc" && ls docs/tutorials/gimbal.md docs/tutorials/mn4004.md)
    for name in copyright CITATION.cff DESIGN.md docs/reference/solve.md; do
        [ -s "$doc/$name" ] || fail "no $name"
    done
    (cd "$doc" && find . -name '*.md' -exec grep -oH '](\.*[a-zA-Z/][^):#]*' {} +) | sed 's/:](/ /' | while read -r from to; do
        case $to in http | https) continue ;; esac # a page elsewhere
        [ -e "$doc/$(dirname "$from")/$to" ] || fail "$from: no $to"
    done
}

# Both packages have the same files, but for the page, licence and changes, which each has in its own way. So libraries and
# firmware are built with one of them.
files_of() {
    (cd "$1" && find . -type f ! -name 'hci-solve.1*' ! -iname 'changelog*' ! -name LICENSE -exec md5sum {} + | sort -k 2)
}
step files
[ "$(files_of "$work"/tar/*)" = "$(files_of "$work/deb/usr")" ] || fail "the .deb and the .tar.gz have other files"

for root in "$work/deb/usr" "$work"/tar/*; do
    step "${root#"$work/"}"
    doc=$root/share/doc/hci-solve
    rm -rf "$work/here" "$work/home"
    mkdir "$work/here" "$work/home"
    says_nothing_of_the_build "$root"
    use_program
    use_shell
done
use_libraries
use_firmware
step documents
use_documents
echo done
