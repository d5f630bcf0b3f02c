/* Sine and cosine of many multiples of one angle, one after the other. */
#ifndef HCI_SRC_CORE_MATH_TURNING_H
#define HCI_SRC_CORE_MATH_TURNING_H

#include "core/math/sine_cosine.h"

/* sin and cos of k × angle. From one k to the next a rotation that was met before is used again: orders 1, 5,
 * 7, 11, 13 … need three sines and cosines, the others four multiplications. Each rotation adds the rounding
 * of one, some 3·10⁻¹⁶. Start with HCI_TURNING. */
typedef struct {
    double k, s, c;
    struct {
        double k, s, c;
    } step[2]; /* the last two kinds of step that were met */
    int next;  /* of both, to be replaced */
} hci_turning;

#define HCI_TURNING                                                                                          \
    {                                                                                                        \
        0.0, 0.0, 1.0, {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}, 0                                                 \
    }

static inline void hci_turning_step(hci_turning *t, int j, double k)
{
    const double s = t->s, c = t->c;
    t->s = s * t->step[j].c + c * t->step[j].s;
    t->c = c * t->step[j].c - s * t->step[j].s;
    t->k = k;
}

static inline void hci_turning_to(hci_turning *t, double k, double angle_rad)
{
    const double by = k - t->k;
    if (by == 0.0) return;
    if (by == t->step[0].k || by == t->step[1].k) {
        hci_turning_step(t, by == t->step[1].k, k);
        return;
    }
    double s, c;
    hci_sine_cosine(k * angle_rad, &s, &c);
    t->step[t->next].k = by;
    t->step[t->next].s = s * t->c - c * t->s;
    t->step[t->next].c = c * t->c + s * t->s;
    t->next = 1 - t->next;
    t->k = k;
    t->s = s;
    t->c = c;
}

#endif
