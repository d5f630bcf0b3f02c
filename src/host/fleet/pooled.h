/* Values of many motors, each with its own standard error, as one distribution of motors. */
#ifndef HCI_SRC_HOST_FLEET_POOLED_H
#define HCI_SRC_HOST_FLEET_POOLED_H

#include <stddef.h>

/* v_i = μ + b_i + e_i, b_i of variance τ² among motors, e_i of variance s_i² by the noise of the recordings.
 */
typedef struct {
    double mean, mean_std_error; /* μ */
    double between;              /* τ */
} hci_pooled;

/* The restricted maximum of likelihood over τ, and μ by the weights 1/(τ² + s_i²). n: from 1; of one motor τ
 * is 0. O(n). */
hci_pooled hci_pooled_find(const double *value, const double *std_error, size_t n);

/* The logarithm of the restricted likelihood, but for a constant. O(n). */
double hci_pooled_likelihood(const double *value, const double *std_error, size_t n, double between);

/* What a motor has beside the mean, by all motors and by its own recordings: τ²/(τ² + s²) (v − μ); std_error:
 * out, what stays open. */
double hci_pooled_shrunken(const hci_pooled *pooled, double value, double own_std_error, double *std_error);

/* The deviation that |x| of a normal distribution of deviation 1 exceeds with this probability, 1e-15 … 1. */
double hci_normal_limit(double probability);

#endif
