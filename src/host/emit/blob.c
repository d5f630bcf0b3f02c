/* A table as the bytes that hci/blob.h reads: a head, rows or knots, probes, CRC-32, low bytes first. */
#include "hci/blob.h"
#include "host/emit/blob_bytes.h"
#include "host/emit/text.h"

/* Both kinds have these, in this order. */
typedef struct {
    hci_blob_kind kind;
    uint32_t columns, parts, period_turns, points, sum;
    float peak_A, reference_torque_Nm, max_error_A;
    size_t row_bytes, probe_bytes;
} figures;

static figures figures_of(const hci_emission *e)
{
    const hci_table_f32 *t = &e->table;
    const hci_table_i16 *x = &e->spline;
    const size_t values = e->tabulation.columns * e->tabulation.parts;
    if (e->request->format == HCI_EMIT_F32)
        return (figures){HCI_BLOB_F32,
                         t->columns,
                         t->parts,
                         t->period_turns,
                         t->points,
                         t->sum32,
                         t->peak_A,
                         t->reference_torque_Nm,
                         t->max_error_A,
                         (t->points + 1) * values * 4,
                         HCI_EMIT_PROBES * 20};
    return (figures){x->knot_bits == 8 ? HCI_BLOB_I8 : HCI_BLOB_I16,
                     x->columns,
                     x->parts,
                     x->period_turns,
                     x->intervals,
                     x->crc32,
                     x->peak_A,
                     x->reference_torque_Nm,
                     x->max_error_A,
                     ((x->intervals + x->degree) * values * (x->knot_bits / 8) + 3) / 4 * 4,
                     HCI_EMIT_PROBES * 12};
}

static void put_head(hci_blob_sink *s, const hci_emission *e, const figures *f)
{
    const hci_emit_request *r = e->request;
    hci_blob_put_start(s, (int)f->kind, HCI_BLOB_HEAD + f->row_bytes + f->probe_bytes + 4, r->input_hash,
                       r->facts.pole_pairs);
    hci_blob_put(s, r->frame == HCI_TABLE_ABC ? 0 : 1, 4);
    hci_blob_put(s, f->columns, 4);
    hci_blob_put(s, f->parts, 4);
    hci_blob_put(s, f->period_turns, 4);
    hci_blob_put_float(s, f->peak_A);
    hci_blob_put_float(s, f->reference_torque_Nm);
    hci_blob_put_float(s, f->max_error_A);
    hci_blob_put_float(s, (float)r->facts.mean_torque_Nm);
    hci_blob_put(s, f->points, 4);
    hci_blob_put(s, HCI_EMIT_PROBES, 4);
    hci_blob_put(s, f->sum, 4);
}

/* The fields of knots, or zeros. */
static void put_shape(hci_blob_sink *s, const hci_emission *e)
{
    const hci_table_i16 none = {0}, *x = e->request->format == HCI_EMIT_F32 ? &none : &e->spline;
    hci_blob_put(s, x->degree, 4);
    hci_blob_put(s, x->sectors, 4);
    hci_blob_put(s, x->rotation, 4);
    hci_blob_put(s, x->alternates, 4);
    hci_blob_put_float(s, x->unit_A);
    hci_blob_put_float(s, x->max_error_q15_A);
    hci_blob_put_name(s, e->request->facts.machine);
}

static void put_rows(hci_blob_sink *s, const hci_emission *e)
{
    const hci_table_f32 *t = &e->table;
    for (size_t k = 0; k < (size_t)(t->points + 1) * t->columns * t->parts; ++k)
        hci_blob_put_float(s, e->rows[k]);
    for (size_t k = 0; k < HCI_EMIT_PROBES; ++k) {
        hci_blob_put(s, e->probes[k].angle, 4);
        hci_blob_put_float(s, e->probes[k].torque_Nm);
        for (int c = 0; c < 3; ++c)
            hci_blob_put_float(s, e->probes[k].expected[c]);
    }
}

static void put_knots(hci_blob_sink *s, const hci_emission *e)
{
    const hci_table_i16 *x = &e->spline;
    const size_t values = (size_t)(x->intervals + x->degree) * x->columns * x->parts;
    const int bytes = (int)x->knot_bits / 8;
    for (size_t k = 0; k < values; ++k)
        hci_blob_put(s, bytes == 1 ? (uint32_t)x->knots_i8[k] & 0xFFu : (uint32_t)x->knots[k] & 0xFFFFu,
                     bytes);
    hci_blob_fill(s);
    for (size_t k = 0; k < HCI_EMIT_PROBES; ++k) {
        const hci_table_i16_probe *p = &e->spline_probes[k];
        hci_blob_put(s, p->angle, 4);
        hci_blob_put(s, (uint32_t)p->torque_q15 & 0xFFFFu, 2);
        for (int c = 0; c < 3; ++c)
            hci_blob_put(s, (uint32_t)p->expected[c] & 0xFFFFu, 2);
    }
}

void hci_emission_write_blob(const hci_emission *e, hci_output *out)
{
    const figures f = figures_of(e);
    hci_blob_sink s = {out, 0xFFFFFFFFu, 0};
    put_head(&s, e, &f);
    put_shape(&s, e);
    if (e->request->format == HCI_EMIT_F32)
        put_rows(&s, e);
    else
        put_knots(&s, e);
    hci_blob_put_crc(&s);
}
