/* The torque that a model has the sensor read along a stretch of a recording. */
#ifndef HCI_SRC_HOST_DIAGNOSE_FIT_PREDICTED_READING_H
#define HCI_SRC_HOST_DIAGNOSE_FIT_PREDICTED_READING_H

#include "host/diagnose/fit/evidence.h"

/* The mean of a steady turn is run through so many times, so that a slow sensor settles. */
enum { HCI_LAPS = 4 };

/* Room for the longest stretch in laps. Start with {0}. */
typedef struct {
    double *torque_Nm;
    double *by_value; /* [cells][terms], derivatives by the values of all terms; NULL: not wanted */
    double *time_s;
    size_t terms;
} hci_observation;

/* False when memory is out, and then there is nothing to release. */
bool hci_observation_make(const hci_evidence *evidence, const hci_effects *effects, bool derivatives,
                          hci_observation *observation);
void hci_observation_release(hci_observation *observation);

/* Fills torque_Nm and by_value for the cells of a stretch. O(cells·terms). */
void hci_observe(const hci_evidence *evidence, const hci_effects *effects, const hci_stretch *stretch,
                 hci_observation *observation);

/* Whether a torque sensor and a clock stood beside each other, so that its lag shows. */
bool hci_observation_is_dynamic(const hci_evidence *evidence, const hci_stretch *stretch);

#endif
