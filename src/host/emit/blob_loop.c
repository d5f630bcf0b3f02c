#include "host/emit/blob_loop.h"

#include "hci/loop_blob.h"
#include "host/emit/blob_bytes.h"

static void put_numbers(hci_blob_sink *s, const hci_loop_f32 *x)
{
    const uint32_t count[] = {x->order_count, x->response_count, x->levels,
                              x->points,      x->repeats,        x->period_turns};
    const float value[] = {x->torque_low_Nm,         x->torque_high_Nm,  x->resistance_ohm,
                           x->inductance_H[0],       x->inductance_H[1], x->proportional_ohm[0],
                           x->integral_ohm_per_s[0], x->sample_s,        x->delay_s,
                           x->whole_rad_per_s,       x->lead_s};
    for (size_t k = 0; k < sizeof count / sizeof *count; ++k)
        hci_blob_put(s, count[k], 4);
    for (size_t k = 0; k < sizeof value / sizeof *value; ++k)
        hci_blob_put_float(s, value[k]);
}

static void put_pairs(hci_blob_sink *s, const hci_loop_pair pair[2])
{
    for (int a = 0; a < 2; ++a) {
        hci_blob_put_float(s, pair[a].c);
        hci_blob_put_float(s, pair[a].s);
    }
}

static void put_arrays(hci_blob_sink *s, const hci_loop_f32 *x)
{
    for (uint32_t k = 0; k < x->order_count * x->levels; ++k) {
        put_pairs(s, x->waves[k].current_A);
        put_pairs(s, x->waves[k].voltage_Vs);
        put_pairs(s, x->waves[k].own_Vs);
    }
    for (uint32_t k = 0; k < x->order_count; ++k) {
        hci_blob_put_float(s, x->ranges[k].whole_rad_per_s);
        hci_blob_put_float(s, x->ranges[k].none_rad_per_s);
    }
    for (uint32_t k = 0; k < x->response_count; ++k) {
        const hci_loop_response *r = &x->responses[k];
        const float value[] = {r->frequency_rad_per_s, r->re[0], r->re[1], r->im[0], r->im[1]};
        for (size_t n = 0; n < sizeof value / sizeof *value; ++n)
            hci_blob_put_float(s, value[n]);
    }
    for (uint32_t k = 0; k < x->order_count; ++k)
        hci_blob_put(s, x->orders[k], 2);
    hci_blob_fill(s);
    hci_blob_put_float(s, x->proportional_ohm[1]);
    hci_blob_put_float(s, x->integral_ohm_per_s[1]);
    hci_blob_put_float(s, x->filter);
}

void hci_emit_loop_blob(const hci_loop_f32 *x, const hci_emit_loop_request *r, hci_output *out)
{
    hci_blob_sink s = {out, 0xFFFFFFFFu, 0};
    const size_t orders = (x->order_count * 2u + 3u) & ~3u,
                 bytes = HCI_BLOB_HEAD + (size_t)x->order_count * (x->levels * 48u + 8u) +
                         x->response_count * 20u + orders + 12u + 4u;
    hci_blob_put_start(&s, HCI_BLOB_LOOP, bytes, r->input_hash, r->facts.pole_pairs);
    put_numbers(&s, x);
    hci_blob_put_name(&s, r->facts.machine);
    put_arrays(&s, x);
    hci_blob_put_crc(&s);
}
