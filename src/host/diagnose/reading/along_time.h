/* What a torque sensor with a lag or a resonance makes of the torques along a segment.
 *
 * The rows of a predicted reading are those of its samples, or where its steps are taken in parts those
 * between them as well. Before a steady turn the turns before it are run through, before other samples their
 * first period, since the sensor answered to the torque before as well. */
#ifndef HCI_SRC_HOST_DIAGNOSE_READING_ALONG_TIME_H
#define HCI_SRC_HOST_DIAGNOSE_READING_ALONG_TIME_H

#include "host/diagnose/reading/predicted_rows.h"

/* The mean of a steady turn is run through so many times at most, so that a slow sensor settles. */
enum { HCI_SETTLING_TURNS = 4 };

#define HCI_SETTLED 16.0 /* time constants, after which 1e-7 is left */

/* How long a sensor with such dynamics takes to settle; 0 without any, INFINITY where it never does. */
double hci_settling_s(const hci_effects *effects);

/* Samples of the turns before the mean of a steady one that take so long, at most all but one of
 * HCI_SETTLING_TURNS. sample: of the segment. */
size_t hci_settling_samples(const hci_binned_sample *sample, const hci_segment *segment, double settling_s);

unsigned hci_effect_traits(const hci_effect *effect, size_t term);

/* Whether there is a lag or a resonance; a time constant of 0 is none. */
bool hci_has_dynamics(const hci_effects *effects);

/* Rows of a segment whose steps are taken in so many parts. */
size_t hci_rows_in(const hci_segment *segment, size_t parts);

/* Writes the first turn n rows long again behind it. */
void hci_turn_repeat(hci_predicted_reading *reading, size_t n, size_t turn, double period_s);

/* Keeps n rows from one on: of the last turn, in which a sensor has settled, or of one between others. */
void hci_turn_keep(hci_predicted_reading *reading, size_t n, size_t first);

/* Keeps those of n samples, `parts` apart from one on. */
void hci_samples_keep(hci_predicted_reading *reading, size_t n, size_t first, size_t parts);

/* Sends the rows through the sensor. Returns how many rows are before the first one then. O(rows·terms). */
size_t hci_reading_along_time(const hci_regression *regression, const hci_effects *effects,
                              const hci_segment *segment, size_t parts, hci_predicted_reading *reading);

#endif
