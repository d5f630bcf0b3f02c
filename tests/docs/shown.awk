# Whether what a page shows is what the program printed. Blanks, blank lines and colours do not count; a number counts to the digits
# that are shown, and one below 1e-9 is rounding; a line `…` stands for any lines and … within a line for any text.
#
#   awk -f shown.awk SHOWN PRINTED        exit code 1 and the line that is not found

function squeeze(text) {
    gsub(/\033\[[0-9;]*m/, "", text)
    gsub(/[ \t\r]+/, " ", text)
    sub(/^ /, "", text)
    sub(/ $/, "", text)
    return text
}

function number_length(text) {
    return match(text, /^[0-9]+(\.[0-9]+)?([eE][-+]?[0-9]+)?/) ? RLENGTH : 0
}

function is_same_number(shown, printed, digits, power) {
    if (shown + 0 < 1e-9 && printed + 0 < 1e-9 && shown ~ /[.eE]/) return 1
    power = 0
    if (match(shown, /[eE]/)) {
        power = substr(shown, RSTART + 1) + 0
        digits = substr(shown, 1, RSTART - 1)
    } else
        digits = shown
    power -= index(digits, ".") ? length(digits) - index(digits, ".") : 0
    digits = shown - printed
    return (digits < 0 ? -digits : digits) <= 0.50001 * 10 ^ power
}

function is_same(shown, printed, n, m, k) {
    while (shown != "") {
        if (substr(shown, 1, ANY_LENGTH) == ANY) {
            shown = substr(shown, ANY_LENGTH + 1)
            for (k = 1; k <= length(printed) + 1; ++k)
                if (is_same(shown, substr(printed, k))) return 1
            return 0
        }
        n = number_length(shown)
        m = number_length(printed)
        if (n && m) {
            if (!is_same_number(substr(shown, 1, n), substr(printed, 1, m))) return 0
        } else {
            n = m = 1
            if (substr(shown, 1, 1) != substr(printed, 1, 1)) return 0
        }
        shown = substr(shown, n + 1)
        printed = substr(printed, m + 1)
    }
    return printed == ""
}

# How many of the lines from shown[first] on, up to the next `…`, stand in a row at printed[at].
function in_a_row(first, at, n) {
    for (n = 0; first + n <= shown_count && shown[first + n] != ANY; ++n)
        if (at + n > printed_count || !is_same(shown[first + n], printed[at + n])) break
    return n
}

function rest_of(first, n) {
    for (n = 0; first + n <= shown_count && shown[first + n] != ANY; ++n)
        ;
    return n
}

# The printed line that begins most alike.
function nearest(text, k, n, most, near) {
    near = "nothing"
    for (k = 1; k <= printed_count; ++k) {
        for (n = 0; n < length(text) && substr(text, n + 1, 1) == substr(printed[k], n + 1, 1); ++n)
            ;
        if (n > most) {
            most = n
            near = printed[k]
        }
    }
    return near
}

BEGIN {
    ANY = "…"
    ANY_LENGTH = length(ANY)
}
{
    line = squeeze($0)
    if (line == "") next
    if (FILENAME == ARGV[1]) shown[++shown_count] = line == "..." ? ANY : line
    else printed[++printed_count] = line
}
END {
    at = 1
    for (first = 1; first <= shown_count;) {
        if (shown[first] == ANY) {
            ++first
            continue
        }
        most = 0
        wanted = rest_of(first)
        for (k = at; k <= printed_count; ++k) {
            found = in_a_row(first, k)
            if (found > most) {
                most = found
                near = k + found
            }
            if (found == wanted) break
        }
        if (k > printed_count) {
            print "shown:   " shown[first + most]
            print "printed: " (most ? printed[near] : nearest(shown[first]))
            exit 1
        }
        first += wanted
        at = k + wanted
    }
}
