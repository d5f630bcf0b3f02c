#!/bin/sh
# labels: slow
# Runs every command that the documentation shows, page by page and in the order of the page, each page in a fresh copy of the data; compares what
# the pages show as output; looks for unknown options in command lines in prose, and for names of files and tests that do not exist.
#   docs_commands.sh SOURCE_DIR BUILD_DIR HCI_SOLVE [PAGE...]
#
# In a ```sh block, and in an indented block that begins with a command, every line is run:
#   - it has to answer 0, or what a comment in it says: `# exit code 1`;
#   - a ```text block behind it is what it prints: docs/shown.awk says how exactly;
#   - tests/docs/not_run lists what is not run, and why;
#   - what reads ../shared/measured, or what such a command has written, is left out where that folder does not exist;
#   - tests/docs/before/PAGE.sh makes the recordings that a page takes as given, PAGE being its path with _ for /. It may add to ../not_run, and
#     write into ../no_figures why what the page shows is not what is printed with them.
# tests/docs/controls are pages with one fault each, which must be found.
. "$1/tests/support/common.sh"
use_plain_build
shift 3
docs=$source_dir/tests/docs
rig=$built/tests/rig
[ -x "$rig" ] || rig=
mkdir "$work/bin" && ln -s "$hci_solve" "$work/bin/hci-solve" && PATH=$work/bin:$PATH || exit 1
unset HCI_JSON COLUMNS
export PATH source_dir rig

# ---- options

# known COMMAND: its options, one a line, from its help.
known() {
    [ -s "$work/options_$1" ] || hci-solve "$1" --help 2>/dev/null | grep -oE -e '(^|[ ,])--?[a-z][a-z-]*' | tr -d ' ,' >"$work/options_$1"
    cat "$work/options_$1"
}

# words_checked FILE: the command line in it has a command and options that exist.
words_checked() {
    words=$(tr '\n\\[](),|=' '          ' <"$1")
    command=$(echo "$words" | awk '{ print $2 }')
    echo "$commands" | grep -qx -e "$command" || {
        echo "no command $command: $words"
        return 1
    }
    for word in $words; do
        case $word in
            -h | --help | -[0-9]*) ;;
            -*) known "$command" | grep -qx -e "$word" || {
                echo "hci-solve $command has no option $word: $words"
                return 1
            } ;;
        esac
    done
}

# ---- one command

# The reason not to run the command in a file, if there is one.
reason_not_to_run() {
    awk 'NR == FNR { if ($0 !~ /^#/) { word[++n] = $1; $1 = ""; reason[n] = $0 } next }
        FNR == 1 { for (k = 1; k <= n; ++k) if ($1 == word[k] || (word[k] ~ /\/$/ && index($1, word[k]) == 1)) { print reason[k]; exit } }' "$here/not_run" "$1"
    for path in $absent; do
        tr ' =' '\n\n' <"$1" | awk -v path="$path" '$0 == path || index($0, path "/") == 1 { found = 1 } END { exit !found }' &&
            echo " needs $path, which is not here" && return
    done
}

# Where the command in a file writes: not there when it is not run.
written_by() {
    sed 's/>>*/ > /g' "$1" | tr ' ' '\n' | awk '/^(-o|--out|>)$/ { found = 1; next } found { print; found = 0 }'
}

# run_command FILE: its output in $here/output; returns its exit code. In this shell, so that `cd` and variables last to the end of the page. The
# diagnosis of the same data stands on many pages and takes long: what it wrote the first time is taken again.
run_command() {
    same=$(sed -n '1s/^\(hci-solve diagnose data[^|><;&#]*\) -o [^ ]*$/\1/p' "$1" | tr -c 'A-Za-z0-9.\n' _)
    into=$(written_by "$1")
    if [ -n "$same" ] && [ -d "$work/kept/$same" ] && [ ! -e "$into" ]; then
        mkdir -p "$(dirname "$into")" && cp -R "$work/kept/$same" "$into" && cp "$work/kept/$same.output" "$here/output"
        return
    fi
    . "$1" >"$here/output" 2>&1 </dev/null
    code=$?
    if [ -n "$same" ] && [ "$code" -eq 0 ]; then
        mkdir -p "$work/kept" && cp -R "$into" "$work/kept/$same" && cp "$here/output" "$work/kept/$same.output"
    fi
    return "$code"
}

# run_one LINE FILE: what it prints is added to $printed.
run_one() {
    reason=$(reason_not_to_run "$2" | head -n 1)
    if [ -n "$reason" ]; then
        note "left out:$reason: $(head -n 1 "$2")" "$1"
        left_out=$((left_out + 1))
        absent="$absent $(written_by "$2")"
        complete=
        return
    fi
    expected=$(sed -n 's/.*# exit code \([0-9][0-9]*\).*/\1/p' "$2" | head -n 1)
    ran=$((ran + 1))
    run_command "$2"
    code=$?
    cat "$here/output" >>"$printed"
    [ "$code" -eq "${expected:-0}" ] && return
    note "exit code $code, expected ${expected:-0}: $(cat "$2")" "$1"
    tail -n 5 "$here/output" | sed 's/^/    /'
    faults=$((faults + 1))
}

# ---- one page

note() {
    echo "$page:$2: $1"
}

fault() {
    note "$1" "$2"
    faults=$((faults + 1))
}

# A copy of the data in a folder of its own; beside it, as beside the source, what was measured.
scratch() {
    here=$work/page
    rm -rf "$here"
    mkdir -p "$here/project" "$here/blocks" "$here/home"
    export HOME="$here/home"
    cp -R "$source_dir/data" "$source_dir/docs" "$source_dir/examples" "$here/project"
    cp "$docs/not_run" "$here/not_run"
    printed=$here/printed
    absent=
    [ -d "$source_dir/../shared/measured" ] && ln -s "$(cd "$source_dir/../shared" && pwd)" "$here/shared" || absent=../shared/measured
    : >"$printed"
    cd "$here/project" || exit 1
}

# What a page takes as given; without it (exit code 77) its commands are left out.
prepare() {
    before=$docs/before/$(echo "${page%.md}" | tr / _).sh
    [ -f "$before" ] || return
    sh "$before" >"$here/output" 2>&1 && return
    code=$?
    [ "$code" -eq 77 ] || fault "${before#"$source_dir"/}: $(tail -n 1 "$here/output")" 1
    absent="$absent $(cat "$here/output")"
}

# page_checked PAGE FILE: prints what is wrong, and adds what was done to $work/counts. In a subshell.
page_checked() (
    page=$1 ran=0 left_out=0 compared=0 faults=0 complete=yes
    scratch
    prepare
    others=$(awk '!/^#/ { print $1 }' "$here/not_run" | tr '\n' ' ')
    awk -v folder="$here/blocks" -v others="$others" -f "$docs/blocks.awk" "$2" >"$here/list"
    while read -r kind line rest; do
        case $kind in
            block) : >"$printed" && complete=yes ;;
            run) run_one "$line" "$rest" ;;
            words) said=$(words_checked "$rest") || fault "$said" "$line" ;;
            wrong) fault "$rest" "$line" ;;
            text)
                [ -n "$complete" ] && [ ! -f "$here/no_figures" ] || continue
                compared=$((compared + 1))
                said=$(awk -f "$docs/shown.awk" "$rest" "$printed") || fault "not what is printed
$said" "$line"
                ;;
        esac
    done <"$here/list"
    [ ! -f "$here/no_figures" ] || note "what is shown is not compared: $(cat "$here/no_figures")" 1
    echo "$ran $left_out $compared" >>"$work/counts"
    [ "$faults" -eq 0 ]
)

# ---- all pages

commands=$(hci-solve --help | sed -n 's/^  \([a-z-]*\)  .*/\1/p')
check "no commands in the help" [ -n "$commands" ]
cd "$source_dir" || exit 1

# each control has a fault; what is to be said of it stands in its first line
if [ $# -eq 0 ]; then
    for page in "$docs"/controls/*.md; do
        wanted=$(sed -n '1s/<!-- said: \(.*\) -->/\1/p' "$page")
        page_checked "${page#"$source_dir"/}" "$page" >"$work/said"
        code=$?
        if [ "$(basename "$page")" = good.md ]; then
            check "$(cat "$work/said")" [ "$code" -eq 0 ]
        else
            check "control $(basename "$page") passes" [ "$code" -ne 0 ]
            check "control $(basename "$page") does not say: $wanted" grep -qE -e "$wanted" "$work/said"
        fi
    done
    check "names" sh "$docs/names.sh" "$source_dir"
    rm -f "$work/counts"
    set -- README.md CONTRIBUTING.md data/README.md data/*/README.md examples/*/README.md docs/*.md $(find docs/*/ -name '*.md' | sort)
fi
for page; do
    [ -f "$source_dir/$page" ] || continue
    start=$(date +%s)
    check "$page" page_checked "$page" "$source_dir/$page"
    seconds=$(($(date +%s) - start))
    [ "$seconds" -lt 5 ] || echo "$page: $seconds s"
done
awk '{ ran += $1; out += $2; compared += $3 } END { print ran " commands run, " out " left out, " compared " outputs compared" }' "$work/counts"
finish
