# The commands of a page of the documentation, one file each in `folder`, and a list of them on standard output:
#
#     block LINE         a block of commands begins
#     run LINE FILE      one command: a line of a ```sh block, or of an indented block that begins with hci-solve or a word of `others`;
#                        with its continuation lines, its here-document or its loop
#     text LINE FILE     what is shown as the output of that block: a ```text block, before another block or heading comes
#     words LINE FILE    a command line in prose or in a synopsis, whose options are to be known
#     wrong LINE WHY     what a page must not have
#
#   awk -v folder=FOLDER -v others='WORD WORD ...' -f blocks.awk PAGE

function emit(kind, line, text, file) {
    file = sprintf("%s/%04d", folder, ++files)
    print text >file
    close(file)
    print kind, line, file
}

function parses(text, check, code) {
    check = "sh -n 2>/dev/null"
    print text | check
    code = close(check)
    return code == 0
}

function is_synopsis(text) {
    return index(text, "[") || index(text, "(") || index(text, "…") || index(text, "...")
}

# The word after << of a here-document, without quotes.
function here_word(text, word) {
    if (!match(text, /<<-?[ ]*["']?[A-Za-z_]+/)) return ""
    word = substr(text, RSTART, RLENGTH)
    sub(/^<<-?[ ]*["']?/, "", word)
    return word
}

# One line of a block of commands.
function command_line(text) {
    if (command == "" && here == "" && text ~ /^[ ]*(#|$)/) return
    if (command == "") command_at = NR
    command = command == "" ? text : command "\n" text
    if (here != "") {
        if (text == here) here = ""
        else return
    } else {
        here = here_word(text)
        if (here != "" || text ~ /\\$/) return
    }
    if (is_indented && is_synopsis(command)) emit("words", command_at, command)
    else if (parses(command)) emit("run", command_at, command)
    else return
    command = ""
}

function commands_begin() {
    print "block", NR
    command = here = ""
    has_output = 1
}

function commands_end() {
    if (command != "") print "wrong", command_at, "a command that does not end with its block"
    command = ""
}

# Code spans of a paragraph.
function paragraph_end(part, n, k) {
    n = split(paragraph, part, "`")
    for (k = 2; k <= n; k += 2)
        if (part[k] ~ /^hci-solve [a-z]/) emit("words", paragraph_at, part[k])
    paragraph = ""
}

BEGIN {
    n = split("hci-solve " others, word, " ")
    for (k = 1; k <= n; ++k)
        is_command[word[k]] = 1
}

# ---- inside a fence

fence != "" && $0 ~ "^ *" fence "[ ]*$" {
    if (language == "sh") commands_end()
    if (language == "text" && has_output) emit("text", fence_at, shown)
    if (language == "text") has_output = 0
    fence = ""
    next
}
fence != "" && language == "sh" { command_line($0); next }
fence != "" { shown = shown $0 "\n"; next }

# ---- outside

/^ *(```|~~~)/ {
    paragraph_end()
    match($0, /(```+|~~~+)/)
    fence = substr($0, RSTART, RLENGTH)
    language = substr($0, RSTART + RLENGTH)
    gsub(/ /, "", language)
    fence_at = NR
    shown = ""
    is_indented = in_block = 0
    if (language ~ /^(bash|shell|console|shell-session)$/) print "wrong", NR, "write ```sh instead of ```" language
    if (language == "sh") commands_begin()
    else if (language != "text") has_output = 0
    next
}
in_block && /^    / { command_line(substr($0, indent + 1)); next }
in_block && /^ *$/ { next }
in_block { commands_end(); in_block = 0 }

/^    / && is_blank_before && ($1 in is_command) {
    paragraph_end()
    match($0, /^ */)
    indent = RLENGTH
    is_indented = in_block = 1
    commands_begin()
    command_line(substr($0, indent + 1))
    next
}
{ is_blank_before = /^ *$/ }
/^#/ { has_output = 0 }
is_blank_before { paragraph_end(); next }
{
    if (paragraph == "") paragraph_at = NR
    paragraph = paragraph " " $0
}
END {
    paragraph_end()
    if (in_block || fence != "") commands_end()
    if (fence != "") print "wrong", fence_at, "a fence without an end"
}
