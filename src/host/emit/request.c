/* Whether a request can become a table. In: what the caller asks for; out: HCI_OK, or the first thing in it
 * that C, C++, the table's format or the machine's connection forbids, with a remedy. */
#include "host/emit/request.h"

#include <math.h>
#include <string.h>

#include "hci/host/base/utf8.h"
#include "host/base/quote.h"

/* Keywords of C99 … C23 and C++, and words that compilers or <stdint.h> define. */
static const char *const TAKEN[] = {"alignas",      "alignof",
                                    "and",          "and_eq",
                                    "asm",          "auto",
                                    "bitand",       "bitor",
                                    "bool",         "break",
                                    "case",         "catch",
                                    "char",         "class",
                                    "co_await",     "co_return",
                                    "co_yield",     "compl",
                                    "concept",      "const",
                                    "const_cast",   "consteval",
                                    "constexpr",    "constinit",
                                    "continue",     "decltype",
                                    "default",      "delete",
                                    "do",           "double",
                                    "dynamic_cast", "else",
                                    "enum",         "explicit",
                                    "export",       "extern",
                                    "false",        "float",
                                    "for",          "friend",
                                    "goto",         "if",
                                    "inline",       "int",
                                    "linux",        "long",
                                    "main",         "mutable",
                                    "namespace",    "new",
                                    "noexcept",     "not",
                                    "not_eq",       "nullptr",
                                    "operator",     "or",
                                    "or_eq",        "private",
                                    "protected",    "public",
                                    "register",     "reinterpret_cast",
                                    "requires",     "restrict",
                                    "return",       "short",
                                    "signed",       "sizeof",
                                    "static",       "static_assert",
                                    "static_cast",  "struct",
                                    "switch",       "template",
                                    "this",         "thread_local",
                                    "throw",        "true",
                                    "try",          "typedef",
                                    "typeid",       "typename",
                                    "typeof",       "typeof_unqual",
                                    "union",        "unix",
                                    "unsigned",     "using",
                                    "virtual",      "void",
                                    "volatile",     "while",
                                    "xor",          "xor_eq"};

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

static bool is_identifier(const char *name)
{
    if (!is_letter(*name)) return false;
    for (; *name != '\0'; ++name) {
        if (!is_letter(*name) && *name != '_' && !(*name >= '0' && *name <= '9')) return false;
    }
    return true;
}

/* Words that are, or may be, somebody else's in a C or C++ program. */
static bool is_taken(const char *name)
{
    const size_t length = strlen(name);
    for (size_t k = 0; k < sizeof TAKEN / sizeof *TAKEN; ++k) {
        if (strcmp(name, TAKEN[k]) == 0) return true;
    }
    return strncmp(name, "hci_", 4) == 0 || strncmp(name, "HCI_", 4) == 0 || strstr(name, "__") != NULL ||
           (length > 2 && strcmp(name + length - 2, "_t") == 0);
}

hci_status hci_emit_check_name(const char *name, hci_note *note)
{
    char shown[HCI_QUOTE_SIZE];
    const char *expected = NULL;
    if (!name || !is_identifier(name)) {
        expected = "a C identifier: a letter, then letters, digits and underscores";
    } else if (strlen(name) > HCI_EMIT_NAME_LENGTH) {
        expected = "at most 48 letters";
    } else if (is_taken(name)) {
        expected = "a name that is not a keyword, nor reserved (hci_, HCI_, __, _t)";
    }
    if (!expected) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_ARGUMENT, "table name: found %s, expected %s; choose another name",
                        name ? hci_quote(name, shown) : "none", expected);
}

const char *hci_emit_format_name(hci_emit_format format)
{
#define WORD(value, word) [value] = word,
    static const char *const words[] = {HCI_EMIT_FORMAT_NAMES(WORD)};
    return words[format];
}

const char *hci_emit_shape_name(hci_emit_shape shape)
{
    static const char *const words[] = {HCI_EMIT_SHAPE_NAMES(WORD)};
#undef WORD
    return words[shape];
}

static hci_status check_shape(const hci_emit_request *r, hci_note *note)
{
    if (!hci_emit_has_rows(r->format) || r->shape <= HCI_EMIT_LINEAR) return HCI_OK;
    return hci_note_set(
        note, HCI_ERROR_ARGUMENT,
        "table shape: found `%s` with format `%s`, which is linear; use format `i16`, `q15` or `i8`",
        hci_emit_shape_name(r->shape), hci_emit_format_name(r->format));
}

static hci_status check_blob(const hci_emit_request *r, hci_note *note)
{
    if (!r->blob || (r->format != HCI_EMIT_CSV && r->format != HCI_EMIT_JSON)) return HCI_OK;
    return hci_note_set(
        note, HCI_ERROR_ARGUMENT,
        "blob: found with format `%s`, expected `f32`, `i16`, `q15` or `i8`, which devices read",
        hci_emit_format_name(r->format));
}

static hci_status check_size(const hci_emit_request *r, hci_note *note)
{
    if (!isfinite(r->max_error_A) || !isfinite(r->reference_torque_Nm))
        return hci_note_set(note, HCI_ERROR_NOT_FINITE,
                            "largest error and reference torque must be finite numbers");
    if (r->max_error_A < 0.0)
        return hci_note_set(note, HCI_ERROR_ARGUMENT, "largest error: found %g A, expected more than 0",
                            r->max_error_A);
    if (r->points > 0 && r->max_error_A > 0.0)
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "found both points and a largest error; give one of them");
    const int most = hci_emit_has_rows(r->format) ? HCI_EMIT_MAX_POINTS : (int)HCI_TABLE_I16_MOST_INTERVALS;
    if (r->points > (size_t)most)
        return hci_note_set(note, HCI_ERROR_ARGUMENT, "table points: found %zu, expected 1 to %d", r->points,
                            most);
    if (r->per_Nm && r->reference_torque_Nm <= 0.0)
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "found currents per N·m and the reference torque %g N·m, expected more than 0; name the "
            "largest torque that will be asked for",
            r->reference_torque_Nm);
    return HCI_OK;
}

/* A line of text that cannot end the comment it stands in. */
static bool is_comment_text(const char *text)
{
    for (const char *c = text; *c != '\0'; ++c) {
        if ((unsigned char)*c < 0x20 || *c == 0x7F) return false;
    }
    return hci_utf8_valid(text) && strstr(text, "*/") == NULL && strstr(text, "/*") == NULL;
}

hci_status hci_emit_check_facts(const hci_emit_facts *facts, hci_note *note)
{
    char shown[HCI_QUOTE_SIZE];
    if (is_comment_text(facts->machine)) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_ARGUMENT,
                        "machine: found %s, expected one line of UTF-8 text without comment marks",
                        hci_quote(facts->machine, shown));
}

static hci_status check_provenance(const hci_emit_request *r, hci_note *note)
{
    char shown[HCI_QUOTE_SIZE];
    for (size_t k = 0; k < r->provenance_count; ++k) {
        if (!is_comment_text(r->provenance[k]))
            return hci_note_set(note, HCI_ERROR_ARGUMENT,
                                "provenance: found %s, expected one line of UTF-8 text without comment marks",
                                hci_quote(r->provenance[k], shown));
    }
    return HCI_OK;
}

static hci_status check_wave(const hci_emit_request *r, const hci_wave *w, hci_note *note)
{
    if (!isfinite(w->order) || !isfinite(w->sine) || !isfinite(w->cosine))
        return hci_note_set(note, HCI_ERROR_NOT_FINITE, "current of order %g: not a finite number", w->order);
    if (w->order < 0.0 || w->sequence < -1 || w->sequence > 1)
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "current of order %g and sequence %d: expected an order of at "
                            "least 0 and a sequence of -1, 0 or 1",
                            w->order, w->sequence);
    if (w->sequence == 0 && !r->has_neutral)
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "current of order %g: a star connection carries no zero sequence; leave it out, or declare "
            "the connection star-neutral",
            w->order);
    if (w->sequence == 0 && r->frame == HCI_TABLE_DQ)
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "current of order %g: the dq frame has no place for a zero sequence; use frame abc", w->order);
    return HCI_OK;
}

static hci_status check_waves(const hci_emit_request *r, const hci_wave *waves, size_t count, hci_note *note)
{
    hci_status status = HCI_OK;
    for (size_t k = 0; k < count && !status; ++k)
        status = check_wave(r, &waves[k], note);
    return status;
}

hci_status hci_emit_request_check(const hci_emit_request *r, hci_note *note)
{
    hci_status status = hci_emit_check_name(r->name, note);
    if (!status) status = check_shape(r, note);
    if (!status) status = check_blob(r, note);
    if (!status) status = check_size(r, note);
    if (!status) status = hci_emit_check_facts(&r->facts, note);
    if (!status) status = check_provenance(r, note);
    if (!status) status = check_waves(r, r->currents, r->current_count, note);
    if (!status && r->per_Nm) status = check_waves(r, r->per_Nm, r->per_Nm_count, note);
    return status;
}
