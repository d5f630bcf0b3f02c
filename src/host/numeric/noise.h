/* The noise of a recording, found in what a model leaves: its spectrum between the orders. */
#ifndef HCI_SRC_HOST_NUMERIC_NOISE_H
#define HCI_SRC_HOST_NUMERIC_NOISE_H

#include <stdbool.h>
#include <stddef.h>

enum {
    HCI_NOISE_MEMORY = 6,
    HCI_NOISE_LEAST = 128 /* samples to tell a colour from */,
    HCI_NOISE_FEWEST = 8
};

/* x_k = Σ_j prediction_j x_{k−j} + innovation */
typedef struct {
    double prediction[HCI_NOISE_MEMORY];
    double innovation; /* rms, in the unit of x */
    double rms;        /* of x */
} hci_noise;

/* Finds the noise under the lines of a residual of n ≥ HCI_NOISE_LEAST samples: the median of the periodogram
 * over neighbouring frequencies, smoothed to an autoregression. closed: the samples are whole periods, so
 * that lines are sharp. floor: rms of white noise that is added. work: hci_noise_workspace(n) doubles. */
size_t hci_noise_workspace(size_t n);
void hci_noise_find(const double *residual, size_t n, bool closed, double floor, hci_noise *noise,
                    double *work);

/* rms of white noise in a residual of fewer samples, from how each differs from the mean of its neighbours:
 *
 *     σ² = ⅔ mean (x_k − ½(x_{k−1} + x_{k+1}))²
 *
 * What varies slowly from sample to sample is none of it. NAN of less than HCI_NOISE_FEWEST samples. */
double hci_noise_of_neighbours(const double *residual, size_t n);

/* White noise of a known size. */
hci_noise hci_noise_white(double rms);

/* In place: samples x[n][columns], one after the other in time, to rows of variance 1 that do not depend on
 * each other. innovation and rms must not be 0. O(n·columns). */
void hci_noise_whiten(const hci_noise *noise, double *x, size_t n, size_t columns);

#endif
