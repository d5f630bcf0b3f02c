/* A few effects of few values in place of one of many: of a series in the currents, of waves that are
 * turned, or of a scale of all that the machine makes.
 *
 * A series describes nearly anything a little, so that one step takes it before two or three effects that
 * describe the recordings better together and each alone worse. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_FEW_VALUES_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_FEW_VALUES_H

#include "host/diagnose/search/search.h"

/* Looks for effects that make the series in a model superfluous. changed: out, whether it has been replaced.
 * HCI_ERROR_MEMORY. */
hci_status hci_search_few_values(hci_search *search, hci_fitted_model *model, bool *changed, hci_note *note);

/* Puts a zero of the angle in place of a back-EMF that is turned, and of the cogging torque beside it, where
 * the recordings are described as well by that, with further effects of few values where these are needed.
 * changed: out. Also where the search is over: a single fit then. HCI_ERROR_MEMORY. */
hci_status hci_search_angle_zero(hci_search *search, hci_fitted_model *model, bool *changed, hci_note *note);

/* Of the delays of the channels only differences show. Where all but that of the torque are early by the same
 * time, within three standard errors, it is late by that, which is one value. changed: out. O(samples·terms).
 * HCI_ERROR_MEMORY. */
hci_status hci_search_late_channel(hci_search *search, hci_fitted_model *model, bool *changed,
                                   hci_note *note);

/* Puts a gain of the torque sensor in place of a scale of the torque per ampere and of the orders of the
 * cogging torque that are off by the same, where that is decisively better: fewer values that say as much. It
 * competes from then on. changed: out. Also where the search is over: a single fit then. HCI_ERROR_MEMORY. */
hci_status hci_search_torque_gain(hci_search *search, hci_fitted_model *model, bool *changed, hci_note *note);

#endif
