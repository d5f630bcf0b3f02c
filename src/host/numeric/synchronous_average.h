/* What repeats with the turn: a recording cut into turns, a trigonometric polynomial for each, their mean and
 * how far they agree. */
#ifndef HCI_SRC_HOST_NUMERIC_SYNCHRONOUS_AVERAGE_H
#define HCI_SRC_HOST_NUMERIC_SYNCHRONOUS_AVERAGE_H

#include <stdbool.h>
#include <stddef.h>

#include "hci/status.h"

/* Samples along a path of the angle. value: [count][channels]. */
typedef struct {
    const double *angle_rad; /* unwrapped, of the turn that is looked at: mechanical or electrical */
    const double *value;
    size_t count, channels;
} hci_average_samples;

/* A part of the path in one direction: one turn, or several where one has too few samples. */
typedef struct {
    size_t first, count;
    int direction; /* +1, −1; 0: all samples, which are in no order */
} hci_average_pass;

/* S and C of S sin kφ + C cos kφ; at k = 0 C is the mean. */
typedef struct {
    double sine, cosine;
} hci_average_harmonic;

/* Start with {0}. */
typedef struct {
    size_t highest; /* M: orders 0 … M of the turn */
    size_t channels, count;
    size_t turns_each;          /* turns of a pass */
    hci_average_pass *pass;     /* count */
    hci_average_harmonic *wave; /* [count][channels][highest + 1] */
} hci_average;

/* Orders of the turn that are asked for. */
typedef struct {
    size_t wanted; /* highest; lower ones where the gaps between samples do not allow it, so that M·gap < 0.8
                      π */
    size_t enough; /* passes are made of several turns until they bear this order */
    size_t least;  /* without it there is no average */
} hci_average_orders;

/* Cuts the path into passes and fits each by weighted least squares (adaptive weights, conjugate gradients on
 * the Toeplitz matrix: Feichtinger, Gröchenig, Strohmer 1995). HCI_ERROR_SINGULAR: no pass goes round the
 * turn with the least of the orders; HCI_ERROR_MEMORY. O(samples·M + passes·M²). */
hci_status hci_average_fit(const hci_average_samples *samples, const hci_average_orders *orders,
                           hci_average *average);
void hci_average_release(hci_average *average);

/* The passes of one direction alone; part: released by the caller. HCI_ERROR_MEMORY. */
hci_status hci_average_of_direction(const hci_average *average, int direction, hci_average *part);

hci_average_harmonic *hci_average_at(const hci_average *average, size_t pass, size_t channel, size_t order);

/* Passes of a direction. */
size_t hci_average_passes(const hci_average *average, int direction);

typedef struct {
    hci_average_harmonic mean;
    double std_error; /* of each coordinate */
    double freedom;   /* degrees of freedom of the standard error */
} hci_order_estimate;

/* Whether there are turns enough for the error to come from how they differ; else it is that of the orders
 * around, by the median of their squares. */
bool hci_average_has_repeats(const hci_average *average);

/* The mean over the passes of each direction, and over the directions. Between turns the error allows for
 * neighbours that resemble each other (a factor from the correlation with the next turn). */
hci_order_estimate hci_average_estimate(const hci_average *average, size_t channel, size_t order);

/* The chance that noise alone makes an order as large as this: F with 2 and `freedom` degrees. */
double hci_order_chance(const hci_order_estimate *estimate);

/* The same by what tells more, the noise of the orders around or that between turns: twice the lesser of the
 * two, since there are two to choose from. */
double hci_average_chance(const hci_average *average, size_t channel, size_t order);

/* Half the difference of the means of the two directions (backward − forward), and its standard error; NAN
 * without both. */
double hci_average_half_difference(const hci_average *average, size_t channel, double *std_error);

#endif
