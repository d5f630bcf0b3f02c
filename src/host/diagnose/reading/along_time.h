/* What a torque sensor with a lag or a resonance makes of the torques along a segment.
 *
 * The rows of a predicted reading are those of its samples, or where its steps are taken in parts those
 * between them as well. Before a steady turn the turns before it are run through, before other samples their
 * first period, since the sensor answered to the torque before as well. */
#ifndef HCI_SRC_HOST_DIAGNOSE_READING_ALONG_TIME_H
#define HCI_SRC_HOST_DIAGNOSE_READING_ALONG_TIME_H

#include "host/diagnose/reading/predicted_reading.h"

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
