/* Sine and cosine of many multiples of one angle, one after the other. */
#ifndef HCI_SRC_CORE_MATH_TURNING_H
#define HCI_SRC_CORE_MATH_TURNING_H

#include "core/math/sine_cosine.h"

/* sin and cos of k × angle. From one k to the next a rotation that was met before is used again: orders 1, 5,
 * 7, 11, 13 … need three sines and cosines, the others four multiplications. Each rotation adds the rounding
 * of one, some 3·10⁻¹⁶, and that of a step of k that is no binary number, such as 1/5. Start with
 * HCI_TURNING.
 */
typedef struct {
    double k, s, c;
    struct {
        double k, s, c;
    } step[2];  /* the last two kinds of step that were met */
    int next;   /* of both, to be replaced */
    int turned; /* rotations since s and c were taken by themselves */
} hci_turning;

#define HCI_TURNING                                                                                          \
    {                                                                                                        \
        0.0, 0.0, 1.0, {{0.0, 0.0, 1.0}, {0.0, 0.0, 1.0}}, 0, 0                                              \
    }

/* Steps of orders below 1000 that differ by the rounding of the orders alone. */
static inline int hci_turning_is(double by, double step)
{
    return fabs(by - step) < 1e-12;
}

static inline void hci_turning_step(hci_turning *t, int j, double k)
{
    const double s = t->s, c = t->c;
    t->s = s * t->step[j].c + c * t->step[j].s;
    t->c = c * t->step[j].c - s * t->step[j].s;
    t->k = k;
    ++t->turned;
}

/* The rotation to s and c, from where no error of others is in it: it is used again and again. */
static inline void hci_turning_learn(hci_turning *t, double by, double angle_rad, double s, double c)
{
    const int j = t->next;
    t->next = 1 - j;
    t->step[j].k = by;
    t->step[j].s = s * t->c - c * t->s;
    t->step[j].c = c * t->c + s * t->s;
    if (t->turned > 0) hci_sine_cosine(by * angle_rad, &t->step[j].s, &t->step[j].c);
}

static inline void hci_turning_to(hci_turning *t, double k, double angle_rad)
{
    const double by = k - t->k;
    if (by == 0.0) return;
    if (hci_turning_is(by, t->step[0].k) || hci_turning_is(by, t->step[1].k)) {
        hci_turning_step(t, hci_turning_is(by, t->step[1].k), k);
        return;
    }
    double s, c;
    hci_sine_cosine(k * angle_rad, &s, &c);
    hci_turning_learn(t, by, angle_rad, s, c);
    t->k = k;
    t->s = s;
    t->c = c;
    t->turned = 0;
}

#endif
