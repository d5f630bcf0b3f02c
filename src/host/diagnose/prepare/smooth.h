/* Readings without their noise, for the regressors of a fit.
 *
 * In: a segment as it was read. Out, where it is steady: the angle as a parabola over the 21 samples around
 * each (a shaft turns smoothly between the steps of its encoder), and i_d, i_q and i_0 as Fourier series over
 * the mechanical angle, with their rates of change. A regression on noisy readings would explain their noise.
 */
#ifndef HCI_SRC_HOST_DIAGNOSE_PREPARE_SMOOTH_H
#define HCI_SRC_HOST_DIAGNOSE_PREPARE_SMOOTH_H

#include "host/diagnose/prepare/segment.h"

/* Smooths the readings of one segment in place where it is steady; where it is not they stay. turns: orders
 * of the mechanical turn are in it. currents: these too, and not the angle alone. series: out, whether the
 * currents are a Fourier series over the angle now, with their rate of change from that. False when memory is
 * out. O(samples). */
bool hci_segment_smooth(hci_binned_sample *sample, const hci_segment *segment, int pole_pairs, bool turns,
                        bool currents, bool *series);

#endif
