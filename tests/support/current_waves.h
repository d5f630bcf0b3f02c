/* Currents of known waves, and what they are in both frames by the sine formula in double. Prefix of none:
 * the names are those of the tests of tables. */
#ifndef CURRENT_WAVES_H
#define CURRENT_WAVES_H

#include <math.h>

#include "hci/math/harmonic.h"
#include "hci/table.h"
#include "support/reference.h"

enum { MOST_WAVES = 8 };

/* The shift of a wave is its sequence. */
typedef struct {
    ref_wave ref[MOST_WAVES];
    hci_wave wave[MOST_WAVES];
    size_t count;
} currents;

static inline void add(currents *c, double order, int sequence, double amplitude, double phase)
{
    const ref_wave r = {order, sequence, amplitude, phase};
    const hci_wave w = {order, sequence, amplitude * cos(phase), amplitude * sin(phase)};
    c->ref[c->count] = r;
    c->wave[c->count++] = w;
}

static inline currents injected(void)
{
    currents c = {.count = 0};
    add(&c, 1, 1, 12.0, 0.2);
    add(&c, 5, -1, 1.3, 2.9);
    add(&c, 7, 1, -0.8, 0.1);
    add(&c, 11, -1, 1.9, -2.2);
    add(&c, 13, 1, 0.7, 1.0);
    return c;
}

static inline currents cogging_part(void)
{
    currents c = {.count = 0};
    add(&c, 0, 1, 0.3, 0.4);
    add(&c, 11, -1, 1.1, 1.5);
    add(&c, 13, 1, 0.9, -0.5);
    return c;
}

/* ia, ib, ic, or id, iq by the projections of theory on the rotor axes. */
static inline void reference_currents(const currents *c, hci_table_frame frame, double theta, double out[3])
{
    double abc[3], d = 0.0, q = 0.0;
    for (int s = 0; s < 3; ++s) {
        abc[s] = ref_waves_at(c->ref, c->count, s, theta);
        q += 2.0 / 3.0 * abc[s] * sin(theta - 2.0 * REF_PI * s / 3.0);
        d -= 2.0 / 3.0 * abc[s] * cos(theta - 2.0 * REF_PI * s / 3.0);
    }
    out[0] = frame == HCI_TABLE_ABC ? abc[0] : d;
    out[1] = frame == HCI_TABLE_ABC ? abc[1] : q;
    out[2] = frame == HCI_TABLE_ABC ? abc[2] : 0.0;
}

#endif
