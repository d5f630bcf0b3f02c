/* Which waves of the turn stand out of the noise of a series of values.
 *
 * In: values at the angles of a segment, such as what a smoothing took from the readings. Of a wave with k
 * periods in a turn the squared amplitude is |2/n Σ x exp(−jkθ_m)|². Most waves are noise alone, so that the
 * median of them tells how large noise makes one. Out: those that are larger than noise makes them once in
 * 2·10⁴ waves. */
#ifndef HCI_SRC_HOST_DIAGNOSE_PREPARE_STANDING_WAVES_H
#define HCI_SRC_HOST_DIAGNOSE_PREPARE_STANDING_WAVES_H

#include <stdbool.h>
#include <stddef.h>

/* Waves to look at, and values [axes] at [n] angles of the turn; of several axes the largest counts. */
typedef struct {
    const double *theta_m_rad, *const *value;
    size_t n, axes;
    size_t stride;       /* periods in a mechanical turn: multiples of this, from it on … */
    size_t most_periods; /* … to this */
    size_t apart;        /* waves that are taken are so many periods apart, the stronger ones first; 1: all */
    double least;        /* squared amplitude that is nothing, whatever the noise */
} hci_standing_waves;

/* periods: out, ascending, at most `most`, the strongest. count: out. False when memory is out.
 * O(n·most_periods/stride). */
bool hci_standing_waves_find(const hci_standing_waves *question, size_t most, size_t *periods, size_t *count);

#endif
