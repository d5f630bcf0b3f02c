#!/bin/sh
# labels: slow
# The README's two commands work in a fresh copy: the first leaves the results that the README names, the second is what
# .ci/run calls and passes.
#   readme.sh SOURCE_DIR
set -eu
cd "$1"
readme=$PWD/README.md
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() {
    echo "readme: $*"
    exit 1
}

# The first fenced block after the heading or line TITLE, which may go on with "(remark)" and a colon.
command_after() {
    awk -v title="$1" '
        { text = $0; sub(/^#+ */, "", text); sub(/ *(\(.*\))?:? *$/, "", text) }
        fenced && /^```/ { exit }
        fenced { print }
        found && /^```/ { fenced = 1 }
        text == title { found = 1 }' "$readme"
}

# What a clone of the working tree would hold; all but build products where git cannot tell.
fresh_copy() {
    if git ls-files -co --exclude-standard >"$work/listed" 2>/dev/null && [ -s "$work/listed" ]; then
        while read -r file; do [ ! -e "$file" ] || echo "$file"; done <"$work/listed" >"$work/files"
        tar -cf - -T "$work/files"
    else
        tar -cf - --exclude=./.git --exclude=./.deps --exclude='./build*' --exclude=./out .
    fi | tar -xf - -C "$work/copy"
}

[ -f "$readme" ] || fail "no README.md"
start=$(command_after "Set up and run")
test=$(command_after "Test")
[ "$(echo "$start" | grep -c .)" -eq 1 ] || fail 'not one command after "Set up and run"'
[ "$(echo "$test" | grep -c .)" -eq 1 ] || fail 'not one command after "Test"'
[ "$(tail -n 1 .ci/run)" = "$test" ] || fail ".ci/run does not end with the README's test command: $test"

mkdir "$work/copy"
fresh_copy
[ ! -d .deps ] || cp -R .deps "$work/copy/.deps"
cd "$work/copy"
# Paths from here on, so that ccache has what was built in another folder. Tests of host are not run below, and not built.
export CCACHE_BASEDIR="$PWD" CCACHE_NOHASHDIR=1
find tests/host -name 'test_*.c' -delete
# So that it has build/release too, which tests/CMakeLists.txt has built in build/dev/nested/all: as deep, with the same flags.
mkdir -p build/dev/nested/release
ln -s dev/nested/release build/release
sed -i '/"Optimised, as installed"/,/}/s/"HCI_BUILD_HOST": "ON"/&, "HCI_WERROR": "ON", "CMAKE_POSITION_INDEPENDENT_CODE": "ON"/' CMakePresets.json

echo "--- $start"
LC_ALL=${LC_ALL-} LC_MESSAGES=${LC_MESSAGES-} sh -c "$start" # set, if to nothing, as `ctest --build-and-test` has them: ccache tells that apart
named=$(grep -o 'out/machine_a/[A-Za-z0-9_.]*[A-Za-z0-9]' "$readme" || true)
always='currents.csv waveform.csv spectrum.csv summary.json machine_a.h machine_a.c'
for result in $named $(printf 'out/machine_a/%s ' $always); do
    [ -s "$result" ] || fail "$start did not write $result"
done
# The picture that the README shows says what the command's says; its coordinates may differ in the last digit.
for picture in docs/pictures/machine_a.svg out/machine_a/solution.svg; do
    grep '<title id\|<desc' "$picture" >"$work/$(basename "$picture")" || fail "$picture has no title"
done
cmp "$work/machine_a.svg" "$work/solution.svg" || fail "docs/pictures/machine_a.svg is not what $start makes"

echo "--- $test"
# All of them run where this test does: here some will do.
HCI_TEST_EXCLUDE='slow|script|host|docs|layers' sh -c "$test" | tee "$work/log"
grep -q '^100% tests passed' "$work/log" || fail "$test did not pass"
