/* Random numbers that are the same on every computer: for samples of a distribution, not for secrets. */
#ifndef HCI_SRC_HOST_NUMERIC_DRAWS_H
#define HCI_SRC_HOST_NUMERIC_DRAWS_H

#include <stdint.h>

/* Start with any number. */
typedef struct {
    uint64_t state;
} hci_draws;

/* Above 0 and below 1, all alike (SplitMix64, Steele, Lea and Flood 2014). */
double hci_draws_uniform(hci_draws *draws);

/* Of mean 0 and variance 1 (Box and Muller 1958). */
double hci_draws_normal(hci_draws *draws);

/* √(ν/χ²) with χ² of ν degrees of freedom, ν from 1: what turns a normal number into one of Student's
 * distribution, whose standard deviation was estimated from ν + 1 values. */
double hci_draws_student_scale(hci_draws *draws, unsigned freedom);

#endif
