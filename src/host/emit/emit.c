/* Current waves to C. In: waves and what is wanted of a table; out: NAME.h and NAME.c, which a
 * microcontroller reads through hci/table.h or hci/table_i16.h. The waves become rows (tabulate.c) or the
 * knots of a spline (spline.c) over the period that all of them have, the shape is chosen by error and cost
 * (choose.c), probes are taken by which a device can check itself, and all of it is written as text (text.c).
 */
#include "hci/host/emit/emit.h"

#include <float.h>
#include <math.h>
#include <stdio.h>

#include "host/base/memory.h"
#include "host/emit/request.h"
#include "host/emit/table_ripple.h"
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
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "currents of %g A do not fit single precision; check the unit of the back-EMF of the machine",
            sum_A);
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

static hci_status take_samples(hci_tabulation *t, hci_note *note)
{
    const bool made =
        hci_wave_samples_make(t->constant, t->constant_count, t->period_turns, &t->constant_samples) &&
        hci_wave_samples_make(t->per_Nm, t->per_Nm_count, t->period_turns, &t->per_Nm_samples);
    return made ? HCI_OK : hci_note_memory(note, NULL, "the table");
}

/* Angles spread by the golden ratio, at +T, −T and no torque. */
static uint32_t probe_angle(uint32_t k)
{
    return k * 2654435769u;
}

static int probe_sign(uint32_t k)
{
    return k % 3 == 0 ? 1 : k % 3 == 1 ? -1 : 0;
}

static void fill_probes(hci_emission *e)
{
    for (uint32_t k = 0; k < HCI_EMIT_PROBES; ++k) {
        hci_table_f32_probe *p = &e->probes[k];
        double exact[3];
        p->angle = probe_angle(k);
        p->torque_Nm = (float)probe_sign(k) * e->table.reference_torque_Nm + 0.0f; /* no −0 */
        hci_tabulation_exact(&e->tabulation, p->angle, (double)p->torque_Nm, exact, NULL);
        for (size_t s = 0; s < 3; ++s)
            p->expected[s] = (float)hci_tabulation_clean(exact[s]);
    }
    e->table.probes = e->probes;
    e->table.probe_count = HCI_EMIT_PROBES;
    e->table.sum32 = hci_table_f32_sum32(&e->table);
    e->result.crc32 = hci_table_f32_crc32(&e->table);
}

static void fill_spline_probes(hci_emission *e)
{
    for (uint32_t k = 0; k < HCI_EMIT_PROBES; ++k) {
        hci_table_i16_probe *p = &e->spline_probes[k];
        p->angle = probe_angle(k);
        p->torque_q15 = e->spline.parts == 2 ? (int16_t)(probe_sign(k) * 32767) : (int16_t)0;
        hci_table_i16_currents_q15(&e->spline, p->angle, p->torque_q15, p->expected);
    }
    e->spline.probes = e->spline_probes;
    e->spline.probe_count = HCI_EMIT_PROBES;
    e->result.crc32 = e->spline.crc32 = hci_table_i16_crc32(&e->spline);
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

/* One that an earlier run left holds another table. */
static hci_status without_blob(const hci_emission *e, hci_output *out, hci_note *note)
{
    char file[HCI_EMIT_NAME_LENGTH + 8];
    snprintf(file, sizeof file, "%s.bin", e->request->name);
    return hci_output_without(out, file, note);
}

static hci_status write_c(const hci_emission *e, hci_output *out, hci_note *note)
{
    const bool rows = hci_emit_has_rows(e->request->format);
    hci_status status =
        write_file(e, out, "h", rows ? hci_emission_write_header : hci_emission_write_spline_header, note);
    if (!status)
        status = write_file(e, out, "c", rows ? hci_emission_write_source : hci_emission_write_spline_source,
                            note);
    if (status) return status;
    return e->request->blob ? write_file(e, out, "bin", hci_emission_write_blob, note)
                            : without_blob(e, out, note);
}

static hci_status write_files(const hci_emission *e, const char *folder, hci_note *note)
{
    hci_output *out;
    hci_status status = hci_output_open(folder, &out, note);
    if (status) return status;
    switch (e->request->format) {
    case HCI_EMIT_CSV:
        status = write_file(e, out, "csv", hci_emission_write_csv, note);
        break;
    case HCI_EMIT_JSON:
        status = write_file(e, out, "json", hci_emission_write_json, note);
        break;
    default:
        status = write_c(e, out, note);
    }
    if (!status) return hci_output_commit(out, note);
    hci_output_discard(out);
    return status;
}

static void finish_result(hci_emission *e)
{
    const bool f32 = hci_emit_has_rows(e->request->format);
    hci_emit_result *x = &e->result;
    x->columns = e->tabulation.columns;
    x->parts = e->tabulation.parts;
    x->period_turns = e->tabulation.period_turns;
    x->sectors = f32 ? 1 : e->spline.sectors;
    x->unit_A = f32 ? (double)NAN : (double)e->spline.unit_A;
    x->peak_A = (double)(f32 ? e->table.peak_A : e->spline.peak_A);
}

/* What can be known before a file is opened: waves, rows or knots, error, probes. */
static hci_status make_table(hci_emission *e, hci_note *note)
{
    hci_status status = take_waves(e, note);
    if (!status) status = check_currents(e, note);
    if (!status) status = take_samples(&e->tabulation, note);
    if (!status) status = hci_emission_choose(e, note);
    if (status) return status;
    if (hci_emit_has_rows(e->request->format))
        fill_probes(e);
    else
        fill_spline_probes(e);
    finish_result(e);
    if (e->plant) hci_table_ripples(e);
    return HCI_OK;
}

static hci_status take_machine(hci_emission *e, hci_machine_plant *plant, hci_note *note)
{
    const hci_emit_request *r = e->request;
    if (!r->machine) return HCI_OK;
    e->plant = plant;
    return hci_machine_plant_make(r->machine_folder, r->machine, plant, note);
}

hci_status hci_emit(const char *folder, const hci_emit_request *request, hci_emit_result *result,
                    hci_note *note)
{
    hci_emission e = {.request = request};
    hci_machine_plant plant = {0};
    hci_status status = hci_emit_request_check(request, note);
    if (!status) status = take_machine(&e, &plant, note);
    if (!status) status = make_table(&e, note);
    if (!status) status = write_files(&e, folder, note);
    if (!status && result) *result = e.result;
    hci_emission_release(&e);
    hci_memory_free(e.waves);
    hci_machine_plant_release(&plant);
    return status;
}
