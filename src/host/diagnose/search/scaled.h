/* Beside means that are off by something unknown: effects that this may make as well. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_SCALED_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_SCALED_H

#include "host/diagnose/search/search.h"

/* The mean that a model leaves of each segment in use, as a share of the measured mean torque: rms over rms.
 * share: out; 0 without a mean torque. HCI_ERROR_MEMORY. */
hci_status hci_search_mean_share(hci_search *search, const hci_candidates *model, double *share,
                                 hci_note *note);

/* Takes out the effects that explain no more than such a share of the torque of the runs in use, of its
 * ripple where means are free: what is wrong with the means may be wrong with all torque, as where a sensor
 * answers otherwise in one direction. share: 0 … HCI_ERROR_MEMORY. */
hci_status hci_search_scaled_leave(hci_search *search, hci_fitted_model *model, double share, hci_note *note);

#endif
