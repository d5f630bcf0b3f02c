/* Fourier sums at the orders 0, 1, 2 … of samples that are anywhere: cosines and sines of so many orders side
 * by side by turning those before, for loops in functions of HCI_WIDE. Error: some rounding units an order.
 */
#ifndef HCI_SRC_HOST_NUMERIC_ROTOR_H
#define HCI_SRC_HOST_NUMERIC_ROTOR_H

#include <math.h>
#include <stddef.h>

enum { HCI_ROTOR_LANES = 8 }; /* orders side by side */

/* cos and sin of HCI_ROTOR_LANES orders, and of a step of as many. */
typedef struct {
    double x[HCI_ROTOR_LANES], y[HCI_ROTOR_LANES], cosine, sine;
} hci_rotor;

/* At order 0. */
static inline hci_rotor hci_rotor_at(double angle_rad)
{
    const double cs = cos(angle_rad), sn = sin(angle_rad);
    hci_rotor r = {{1.0}, {0.0}, 1.0, 0.0};
    for (size_t k = 0; k < HCI_ROTOR_LANES; ++k) {
        r.x[k] = r.cosine;
        r.y[k] = r.sine;
        r.cosine = cs * r.x[k] - sn * r.y[k];
        r.sine = sn * r.x[k] + cs * r.y[k];
    }
    return r;
}

/* Adds a value times so many lanes. to: cosines, and `count` further on the sines. */
static inline void hci_rotor_add(const hci_rotor *r, double value, double *restrict to, size_t lanes,
                                 size_t count)
{
    for (size_t j = 0; j < lanes; ++j) {
        to[j] += value * r->x[j];
        to[count + j] += value * r->y[j];
    }
}

/* To the orders after these. */
static inline void hci_rotor_turn(hci_rotor *r)
{
    for (size_t j = 0; j < HCI_ROTOR_LANES; ++j) {
        const double x = r->x[j];
        r->x[j] = r->cosine * x - r->sine * r->y[j];
        r->y[j] = r->sine * x + r->cosine * r->y[j];
    }
}

/* Adds a value times cosine and sine of the orders 0 … count − 1. to: [2][count]. */
static inline void hci_rotor_sum(double angle_rad, double value, size_t count, double *restrict to)
{
    hci_rotor r = hci_rotor_at(angle_rad);
    size_t k = 0;
    for (; k + HCI_ROTOR_LANES <= count; k += HCI_ROTOR_LANES) {
        hci_rotor_add(&r, value, to + k, HCI_ROTOR_LANES, count);
        hci_rotor_turn(&r);
    }
    hci_rotor_add(&r, value, to + k, count - k, count);
}

#endif
