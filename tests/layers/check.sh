#!/bin/sh
# The rules that keep the layers apart, on archives and on sources.
#   check.sh core ARCHIVE      only libm and memory moves are called; nothing writable is kept
#   check.sh host ARCHIVE      allocates in memory.c alone, never prints, never ends the program
#   check.sh includes ROOT     who may include what
# Each offence is one line "RULE: ..." on standard output; the exit code is 1 if there is any. NM and SIZE name the tools.
set -eu
export LC_ALL=C

NM=${NM:-nm}
SIZE=${SIZE:-size}

# $work/symbols: lines "member symbol type" of an archive; $work/undefined: "member symbol" of what it takes from
# elsewhere. An archive without any symbol would pass every rule, so it is refused.
read_archive() {
    "$NM" -A -P "$1" 2>/dev/null | sed -n 's/^.*\[\(.*\)\]: \([^ ]*\) \([A-Za-z]\).*/\1 \2 \3/p' >"$work/symbols"
    [ -s "$work/symbols" ] || { echo "empty: no symbols in $1"; exit 1; }
    awk '$3 ~ /[Uw]/ { use[$1 " " $2] = $2; next }
         { defined[$2] }
         END { for (u in use) if (!(use[u] in defined)) print u }' "$work/symbols" | sort >"$work/undefined"
}

# offences RULE CONDITION: an awk condition on $1, the member, and $2, the symbol it takes.
offences() {
    awk -v rule="$1" "$2"' { print rule ": " $1 " uses " $2 }' "$work/undefined"
}

# The functions of C99 <math.h>, with the helpers behind its classification macros.
libm='a?(cos|sin|tan)h?|atan2|exp2?|expm1|log(2|10|1p|b)?|frexp|ldexp|modf|ilogb|scalbl?n|pow|sqrt|cbrt|hypot|fabs|erfc?|[lt]gamma|ceil|floor|trunc|round|nearbyint|l?l?rint|l?lround|fmod|remainder|remquo|copysign|nan|nextafter|nexttoward|fdim|fmax|fmin|fma'
libm="^(($libm)[fl]?|__(fpclassify|isnan|isinf|isfinite|finite|signbit)[fdl]?)\$"
memory='^mem(cpy|move|set|cmp)$'
compiler='^(__aeabi_[a-z0-9_]+|__(mul|div)[sdx]c3|__powi[sdx]f2|__stack_chk_(fail|guard)|_GLOBAL_OFFSET_TABLE_)$'

check_core() {
    read_archive "$1"
    offences core-symbol "\$2 !~ /$libm/ && \$2 !~ /$memory/ && \$2 !~ /$compiler/"
    # Constants that hold addresses sit in .data.rel.ro, which nobody can write once the program is loaded.
    "$SIZE" -A "$1" | awk '
        /\(ex / { member = $1 }
        $1 ~ /^\.(data|bss|tdata|tbss)/ && $1 !~ /^\.data\.rel\.ro/ && $2 > 0 {
            print "core-writable: " member " has " $2 " bytes of " $1 }'
    awk '$3 == "C" { print "core-writable: " $1 " has the common symbol " $2 }' "$work/symbols"
}

prints='^_*(std(out|err)|v?printf|puts|putchar|putchar_unlocked|perror|psignal|umfpack_.*_report_.*|cholmod_.*print.*)(_chk)?$'
ends='^(_*exit|_Exit|quick_exit|at_quick_exit|atexit|abort|raise|kill|signal|sigaction|longjmp|system|popen|fork|exec[lv]p?e?)$'
allocates='^(malloc|calloc|realloc|reallocarray|free|strn?dup|v?asprintf|getline|getdelim|open_memstream|aligned_alloc|posix_memalign|alloca)$'

check_host() {
    read_archive "$1"
    offences host-prints "\$2 ~ /$prints/"
    offences host-ends "\$2 ~ /$ends/"
    offences host-allocates "\$2 ~ /$allocates/ && \$1 !~ /^memory\\./"
}

freestanding=' assert.h float.h limits.h math.h stdbool.h stddef.h stdint.h string.h '
standard="$freestanding ctype.h errno.h inttypes.h locale.h setjmp.h signal.h stdarg.h stdio.h stdlib.h time.h "
posix=' dirent.h fcntl.h sys/stat.h sys/types.h unistd.h '

# Lines "file header" of the folders that exist; the header with its angle brackets or quotes.
includes_of() {
    for folder in "$@"; do
        [ ! -d "$folder" ] || find "$folder" -name '*.[ch]'
    done | sort | xargs -r sed -nE 's/^[[:space:]]*#[[:space:]]*include[[:space:]]*(<[^>]+>|"[^"]+").*/\1/;T;F;p' | paste -d ' ' - -
}

check_includes() {
    cd "$1"
    [ -d src/core ] && [ -d include/hci ] || { echo "empty: no src/core or include/hci in $1"; exit 1; }

    includes_of src/core include/hci | awk -v allowed="$freestanding" '
        $1 ~ /^include\/hci\/host\// { next }
        $2 ~ /^</ { header = substr($2, 2, length($2) - 2)
                    if (!index(allowed, " " header " ")) print "core-include: " $1 " includes " $2
                    next }
        $2 ~ /(host|cli)\// { print "core-include: " $1 " includes " $2 }'

    includes_of src include/hci/host | awk -v allowed="$standard" '
        $2 ~ /cli\// { print "host-include: " $1 " includes " $2 }
        $1 ~ /^include/ && $2 ~ /^</ { header = substr($2, 2, length($2) - 2)
                    if (!index(allowed, " " header " ")) print "host-include: public " $1 " includes " $2 }'

    # One file includes each outside library, that is, whatever neither C, nor the operating system, nor this project provides.
    includes_of src | awk -v allowed="$standard$posix" '
        { header = substr($2, 2, length($2) - 2) }
        $2 ~ /^"/ && header !~ /(umfpack|SuiteSparseQR_C|cholmod|cJSON|sqlite3)\.h$/ { next }
        index(allowed, " " header " ") { next }
        { sub(/^.*\//, "", header)
          if (header in owner && owner[header] != $1) print "one-owner: " header " in " $1 " and in " owner[header]
          owner[header] = $1 }'
    includes_of cli include | awk '
        $2 ~ /(umfpack|SuiteSparseQR_C|cholmod|cJSON|sqlite3)\.h[>"]$/ { print "one-owner: " $2 " in " $1 }'
}

[ $# -eq 2 ] || { echo "usage: check.sh core|host|includes PATH" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
case $1 in
core)     (check_core "$2") ;;
host)     (check_host "$2") ;;
includes) (check_includes "$2") ;;
*)        echo "check.sh: no rule set $1" >&2; exit 2 ;;
esac >"$work/offences" || { cat "$work/offences"; exit 1; }
cat "$work/offences"
[ ! -s "$work/offences" ]
