/* Zeros of the current sensors in place of a cogging torque once an electrical turn.
 *
 * A current loop that runs makes the current that is read the wanted one, also where none is wanted: what
 * flows then is minus the zeros of the sensors, and makes a torque of the orders of the back-EMF, whatever
 * the load. As much is cogging torque of order 1, which needs poles of a pair that differ. It comes in first,
 * being one step where the zeros are three. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_SENSOR_ZEROS_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_SENSOR_ZEROS_H

#include "host/diagnose/search/search.h"

/* Where zeros of all phases describe the recordings as well, they take the place of a torque of order 1 that
 * needs no current; of recordings with a sensor of torque. changed: out, whether the model has been replaced.
 * HCI_ERROR_MEMORY. */
hci_status hci_search_sensor_zeros(hci_search *search, hci_fitted_model *model, bool *changed,
                                   hci_note *note);

/* Where runs without a current have shown the zeros, and the offsets of the model contradict them, they have
 * taken the place of something else, such as cogging torque of order 1: adds what explains what is left with
 * the zeros as they were read, if the model is then the better one. changed: out, whether it has been.
 * HCI_ERROR_MEMORY. */
hci_status hci_search_beside_zeros(hci_search *search, hci_fitted_model *model, bool *changed,
                                   hci_note *note);

#endif
