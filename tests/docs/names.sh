#!/bin/sh
# Names in the documentation: files of the project in code spans exist, links lead somewhere, docs/README.md has every page, and docs/theory.md names for each group of formulas
# the source and the test, with test functions that are there.
#   names.sh SOURCE_DIR
set -u
export LC_ALL=C
cd "$1" || exit 1
faults=0
work=$(mktemp) || exit 1
trap 'rm -f "$work"' EXIT

fault() {
    echo "$*"
    faults=$((faults + 1))
}

# PAGE: its code spans, one a line, fenced blocks left out; NAMES for what a reader is to put in are not files.
spans() {
    awk '/^ *```/ { fenced = !fenced; next }
        !fenced { n = split($0, part, "`"); for (k = 2; k <= n; k += 2) print part[k] }' "$1"
}

files_named() {
    spans "$1" | grep -E '^(src|include|tests|docs|cli|cmake|scripts|examples|bench|data)/[A-Za-z0-9_./-]+$' | grep -vE 'NAME|COMMAND' | sort -u
}

# The way to a heading, as GitHub makes it.
anchors() {
    awk '/^ *```/ { fenced = !fenced } !fenced && /^#+ / {
        sub(/^#+ /, ""); gsub(/`/, ""); text = tolower($0); gsub(/[^a-z0-9 _-]/, "", text); gsub(/ /, "-", text); print text }' "$1"
}

links() {
    awk '/^ *```/ { fenced = !fenced } !fenced' "$1" | grep -oE '\]\([^)# ]*(#[^) ]*)?\)' | sed 's/^](//;s/)$//' | grep -vE '^[a-z]+:' | sort -u
}

for page in README.md DESIGN.md CONTRIBUTING.md data/README.md data/*/README.md examples/*/README.md docs/*.md docs/*/*.md; do
    [ -f "$page" ] || continue
    for name in $(files_named "$page"); do
        [ -e "$name" ] || fault "$page: there is no $name"
    done
    for link in $(links "$page"); do
        path=${link%%#*}
        target=$(dirname "$page")/$path
        [ -n "$path" ] || target=$page
        [ -e "$target" ] || { fault "$page: the link $link leads nowhere"; continue; }
        case $link in
            *#*) anchors "$target" | grep -qx -e "${link#*#}" || fault "$page: no heading for the link $link" ;;
        esac
    done
done

for page in docs/*.md; do
    [ "$page" = docs/README.md ] || grep -qF -e "(${page#docs/})" docs/README.md || fault "docs/README.md does not name $page"
done

# Lines `In `source`, …; checked in `test_x`: `function`, …` of the theory: each section with formulas has one.
theory=docs/theory.md
[ -f "$theory" ] || { fault "there is no $theory"; exit 1; }
awk '/^## / { if (formulas && !named) print title; title = $0; formulas = named = 0 }
    /^ *```/ { fenced = !fenced; formulas = formulas || /^ *```$/ }
    /^In `/ { named = 1 }
    END { if (formulas && !named) print title }' "$theory" >"$work"
while read -r title; do
    fault "$theory: \"$title\" has formulas and no line \"In \`file\`; checked in \`test\`\""
done <"$work"
awk '/^In `/ { on = 1 } /^$/ { on = 0 } on { n = split($0, part, "`"); for (k = 2; k <= n; k += 2) print part[k] }' "$theory" >"$work"
test=
while read -r name; do
    case $name in
        */*) [ -e "$name" ] || fault "$theory: there is no $name" ;;
        hci_*) grep -rqw -e "$name" include src || fault "$theory: there is no $name" ;;
        test_*) file=$(find tests -name "$name.c")
                if [ -n "$file" ]; then test=$file; else grep -qw -e "RUN_TEST($name)" "$test" || fault "$theory: $test has no $name"; fi ;;
    esac
done <"$work"
[ "$faults" -eq 0 ]
