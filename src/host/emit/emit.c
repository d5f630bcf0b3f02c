#include "hci/host/emit/emit.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/base/utf8.h"
#include "host/base/memory.h"
#include "host/base/quote.h"
#include "host/emit/text.h"

enum { NAME_LENGTH = 48 };

/* ---- the request ---- */

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

static hci_status check_name(const char *name, hci_note *note)
{
    char shown[HCI_QUOTE_SIZE];
    const char *expected = NULL;
    if (name == NULL || !is_identifier(name)) {
        expected = "a C identifier: a letter, then letters, digits and underscores";
    } else if (strlen(name) > NAME_LENGTH) {
        expected = "at most 48 letters";
    } else if (is_taken(name)) {
        expected = "a name that is not a keyword, nor reserved (hci_, HCI_, __, _t)";
    }
    if (expected == NULL) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_ARGUMENT, "table name: found %s, expected %s; choose another name",
                        name != NULL ? hci_quote(name, shown) : "none", expected);
}

static hci_status check_format(const char *format, hci_note *note)
{
    char shown[HCI_QUOTE_SIZE];
    if (format != NULL && strcmp(format, "f32") == 0) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_ARGUMENT,
                        "table format: found %s, expected `f32`; this version writes no other format",
                        format != NULL ? hci_quote(format, shown) : "none");
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
    if (r->points > HCI_EMIT_MAX_POINTS)
        return hci_note_set(note, HCI_ERROR_ARGUMENT, "table points: found %zu, expected 1 to %d", r->points,
                            (int)HCI_EMIT_MAX_POINTS);
    if (r->per_Nm != NULL && r->reference_torque_Nm <= 0.0)
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
    for (size_t k = 0; k < count && status == HCI_OK; ++k)
        status = check_wave(r, &waves[k], note);
    return status;
}

static hci_status check_request(const hci_emit_request *r, hci_note *note)
{
    hci_status status = check_name(r->name, note);
    if (status == HCI_OK) status = check_format(r->format, note);
    if (status == HCI_OK) status = check_size(r, note);
    if (status == HCI_OK) status = check_provenance(r, note);
    if (status == HCI_OK) status = check_waves(r, r->currents, r->current_count, note);
    if (status == HCI_OK && r->per_Nm != NULL) status = check_waves(r, r->per_Nm, r->per_Nm_count, note);
    return status;
}

/* ---- the period ---- */

/* Orders given with six decimals are taken for fractions up to about 20 turns, finer ones for all. */
static const double WHOLE = 10.0 * HCI_ORDER_TOLERANCE;

static bool is_whole(const hci_wave *waves, size_t count, double turns)
{
    for (size_t k = 0; k < count; ++k) {
        const double cycles = waves[k].order * turns;
        if (fabs(cycles - floor(cycles + 0.5)) > WHOLE) return false;
    }
    return true;
}

/* The least number of electrical turns after which all waves repeat, or 0. */
static size_t find_period(const hci_wave *waves, size_t count)
{
    for (size_t turns = 1; turns <= HCI_EMIT_MAX_TURNS; ++turns) {
        if (is_whole(waves, count, (double)turns)) return turns;
    }
    return 0;
}

/* ---- the table ---- */

/* The order becomes an exact multiple of 1/turns; coordinates that are rounding dust become 0. */
static hci_wave clean_wave(hci_wave w, double turns)
{
    w.order = floor(w.order * turns + 0.5) / turns;
    w.sine = hci_tabulation_clean(w.sine);
    w.cosine = hci_tabulation_clean(w.cosine);
    return w;
}

/* One list of both parts. */
static hci_status take_waves(hci_emission *e, hci_note *note)
{
    const hci_emit_request *r = e->request;
    const size_t per_Nm = r->per_Nm != NULL ? r->per_Nm_count : 0, count = r->current_count + per_Nm;
    e->waves = hci_memory_new(count, sizeof *e->waves);
    if (e->waves == NULL) return hci_note_set(note, HCI_ERROR_MEMORY, "out of memory");
    for (size_t k = 0; k < count; ++k)
        e->waves[k] = k < r->current_count ? r->currents[k] : r->per_Nm[k - r->current_count];
    const size_t turns = find_period(e->waves, count);
    if (turns == 0)
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "the orders of the currents do not repeat within %d electrical turns; give fractional orders "
            "with more decimals",
            (int)HCI_EMIT_MAX_TURNS);
    for (size_t k = 0; k < count; ++k)
        e->waves[k] = clean_wave(e->waves[k], (double)turns);
    const hci_tabulation t = {.constant = e->waves,
                              .per_Nm = e->waves + r->current_count,
                              .constant_count = r->current_count,
                              .per_Nm_count = per_Nm,
                              .frame = r->frame,
                              .columns = r->frame == HCI_TABLE_ABC && r->has_neutral ? 3 : 2,
                              .parts = r->per_Nm != NULL ? 2 : 1,
                              .period_turns = turns,
                              .torque_Nm = r->per_Nm != NULL ? r->reference_torque_Nm : 0.0};
    e->tabulation = t;
    return HCI_OK;
}

static hci_status check_currents(const hci_emission *e, hci_note *note)
{
    const hci_tabulation *t = &e->tabulation;
    const double largest = (double)FLT_MAX / 8.0, sum_A = hci_tabulation_bound_A(t);
    if (!(sum_A < largest && t->torque_Nm < largest && (t->parts == 1 || sum_A / t->torque_Nm < largest)))
        return hci_note_set(note, HCI_ERROR_ARGUMENT, "currents of %g A do not fit single precision", sum_A);
    for (size_t k = 0; k < t->constant_count + t->per_Nm_count; ++k) {
        if (e->waves[k].order * (double)t->period_turns > 0.5 * HCI_EMIT_MAX_POINTS)
            return hci_note_set(
                note, HCI_ERROR_ARGUMENT,
                "current of order %g in a table of %zu electrical turns: %d points are too few for it; "
                "leave it out",
                e->waves[k].order, t->period_turns, (int)HCI_EMIT_MAX_POINTS);
    }
    return HCI_OK;
}

static hci_status fill_table(hci_emission *e, hci_note *note)
{
    const hci_emit_request *r = e->request;
    const hci_tabulation *t = &e->tabulation;
    const bool search = r->max_error_A > 0.0;
    const size_t points = r->points > 0 ? r->points : HCI_EMIT_POINTS;
    e->rows = hci_memory_new(((search ? HCI_EMIT_MAX_POINTS : points) + 1) * t->columns * t->parts,
                             sizeof *e->rows);
    if (e->rows == NULL) return hci_note_set(note, HCI_ERROR_MEMORY, "out of memory");
    if (!search) {
        hci_tabulate(t, points, e->rows, &e->table);
    } else if (!hci_tabulate_within(t, r->max_error_A, e->rows, &e->table)) {
        hci_tabulate(t, HCI_EMIT_MAX_POINTS, e->rows, &e->table);
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "largest error: found %g A, but %d points, the most there may be, keep %g A; allow that much",
            r->max_error_A, (int)HCI_EMIT_MAX_POINTS, (double)e->table.max_error_A);
    }
    return HCI_OK;
}

/* Angles spread by the golden ratio, at +T, −T and no torque. */
static void fill_probes(hci_emission *e)
{
    for (uint32_t k = 0; k < HCI_EMIT_PROBES; ++k) {
        hci_table_f32_probe *p = &e->probes[k];
        double exact[3];
        p->angle = k * 2654435769u;
        p->torque_Nm = k % 3 == 0   ? e->table.reference_torque_Nm
                       : k % 3 == 1 ? -e->table.reference_torque_Nm
                                    : 0.0f;
        p->torque_Nm += 0.0f; /* no −0 */
        hci_tabulation_exact(&e->tabulation, p->angle, (double)p->torque_Nm, exact, NULL);
        for (size_t s = 0; s < 3; ++s)
            p->expected[s] = (float)hci_tabulation_clean(exact[s]);
    }
    e->table.probes = e->probes;
    e->table.probe_count = HCI_EMIT_PROBES;
    e->table.crc32 = hci_table_f32_crc32(&e->table);
}

static hci_status write_file(const hci_emission *e, hci_output *out, const char *extension,
                             void (*write)(const hci_emission *, hci_output *), hci_note *note)
{
    char file[NAME_LENGTH + 8];
    snprintf(file, sizeof file, "%s.%s", e->request->name, extension);
    const hci_status status = hci_output_file(out, file, note);
    if (status == HCI_OK) write(e, out);
    return status;
}

static hci_status write_files(const hci_emission *e, const char *folder, hci_note *note)
{
    hci_output *out;
    hci_status status = hci_output_open(folder, &out, note);
    if (status != HCI_OK) return status;
    status = write_file(e, out, "h", hci_emission_write_header, note);
    if (status == HCI_OK) status = write_file(e, out, "c", hci_emission_write_source, note);
    if (status == HCI_OK) return hci_output_commit(out, note);
    hci_output_discard(out);
    return status;
}

static hci_emit_result result_of(const hci_table_f32 *t)
{
    const hci_emit_result result = {.points = t->points,
                                    .columns = t->columns,
                                    .parts = t->parts,
                                    .period_turns = t->period_turns,
                                    .bytes = ((size_t)t->points + 1) * t->columns * t->parts * 4,
                                    .max_error_A = (double)t->max_error_A,
                                    .peak_A = (double)t->peak_A,
                                    .crc32 = t->crc32};
    return result;
}

hci_status hci_emit(const char *folder, const hci_emit_request *request, hci_emit_result *result,
                    hci_note *note)
{
    hci_emission e = {.request = request};
    hci_status status = check_request(request, note);
    if (status == HCI_OK) status = take_waves(&e, note);
    if (status == HCI_OK) status = check_currents(&e, note);
    if (status == HCI_OK) status = fill_table(&e, note);
    if (status == HCI_OK) {
        fill_probes(&e);
        status = write_files(&e, folder, note);
    }
    if (status == HCI_OK && result != NULL) *result = result_of(&e.table);
    hci_memory_free(e.rows);
    hci_memory_free(e.waves);
    return status;
}
