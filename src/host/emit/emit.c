/* Current waves to C. In: waves and the shape of a table; out: NAME.h and NAME.c, whose rows a
 * microcontroller reads through hci/table.h. The waves are sampled over the period that all of them have
 * (tabulate.c), the error of interpolating is measured, probes are taken by which a device can check itself,
 * and all of it is written as text (text.c). */
#include "hci/host/emit/emit.h"

#include <float.h>
#include <math.h>
#include <stdio.h>

#include "host/base/memory.h"
#include "host/emit/request.h"
#include "host/emit/text.h"

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

static hci_tabulation tabulation_of(const hci_emit_request *r, const hci_wave *waves, size_t turns)
{
    const bool has_parts = r->per_Nm;
    return (hci_tabulation){.constant = waves,
                            .per_Nm = waves + r->current_count,
                            .constant_count = r->current_count,
                            .per_Nm_count = has_parts ? r->per_Nm_count : 0,
                            .frame = r->frame,
                            .columns = r->frame == HCI_TABLE_ABC && r->has_neutral ? 3 : 2,
                            .parts = has_parts ? 2 : 1,
                            .period_turns = turns,
                            .torque_Nm = has_parts ? r->reference_torque_Nm : 0.0};
}

/* One list of both parts, cleaned, and the period in which all of them repeat. */
static hci_status take_waves(hci_emission *e, hci_note *note)
{
    const hci_emit_request *r = e->request;
    const size_t count = r->current_count + (r->per_Nm ? r->per_Nm_count : 0);
    size_t turns;
    e->waves = hci_memory_new(count, sizeof *e->waves);
    if (!e->waves) return hci_note_memory(note, NULL, "the table");
    for (size_t k = 0; k < count; ++k)
        e->waves[k] = k < r->current_count ? r->currents[k] : r->per_Nm[k - r->current_count];
    turns = find_period(e->waves, count);
    if (turns == 0)
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "the orders of the currents do not repeat within %d electrical turns; give fractional orders "
            "with more decimals",
            (int)HCI_EMIT_MAX_TURNS);
    for (size_t k = 0; k < count; ++k)
        e->waves[k] = clean_wave(e->waves[k], (double)turns);
    e->tabulation = tabulation_of(r, e->waves, turns);
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
    if (!e->rows) return hci_note_memory(note, NULL, "the table");
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
    char file[HCI_EMIT_NAME_LENGTH + 8];
    snprintf(file, sizeof file, "%s.%s", e->request->name, extension);
    const hci_status status = hci_output_file(out, file, note);
    if (!status) write(e, out);
    return status;
}

static hci_status write_files(const hci_emission *e, const char *folder, hci_note *note)
{
    hci_output *out;
    hci_status status = hci_output_open(folder, &out, note);
    if (status) return status;
    status = write_file(e, out, "h", hci_emission_write_header, note);
    if (!status) status = write_file(e, out, "c", hci_emission_write_source, note);
    if (!status) return hci_output_commit(out, note);
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

/* What can be known before a file is opened: waves, rows, error, probes. */
static hci_status make_table(hci_emission *e, hci_note *note)
{
    hci_status status = take_waves(e, note);
    if (!status) status = check_currents(e, note);
    if (!status) status = fill_table(e, note);
    if (!status) fill_probes(e);
    return status;
}

hci_status hci_emit(const char *folder, const hci_emit_request *request, hci_emit_result *result,
                    hci_note *note)
{
    hci_emission e = {.request = request};
    hci_status status = hci_emit_request_check(request, note);
    if (!status) status = make_table(&e, note);
    if (!status) status = write_files(&e, folder, note);
    if (!status && result) *result = result_of(&e.table);
    hci_memory_free(e.rows);
    hci_memory_free(e.waves);
    return status;
}
