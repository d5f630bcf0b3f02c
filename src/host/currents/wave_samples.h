/* Many waves at many angles: their samples over a period once, and polynomials between them. */
#ifndef HCI_SRC_HOST_CURRENTS_WAVE_SAMPLES_H
#define HCI_SRC_HOST_CURRENTS_WAVE_SAMPLES_H

#include <stdbool.h>
#include <stddef.h>

#include "hci/math/harmonic.h"

/* value: [3][count], x_a, x_b, x_c over `turns` electrical turns; count 0: none, since the waves are few or
 * their orders too high for it. Start with {0}. */
typedef struct {
    double *value;
    size_t count;
} hci_wave_samples;

/* waves: count entries, of which every order is a whole multiple of 1/turns. False when memory is out. O(n
 * log n) with n at most 128 for each period of the highest order. */
bool hci_wave_samples_make(const hci_wave *waves, size_t count, size_t turns, hci_wave_samples *samples);

/* abc: out, at a share of the period from 0 to 1, within 1e-11 of the sum of all amplitudes. O(1). */
void hci_wave_samples_at(const hci_wave_samples *samples, double share, double abc[3]);

void hci_wave_samples_release(hci_wave_samples *samples);

#endif
