/* Saturated iron: all of the co-energy at once in place of single terms.
 *
 * In: a model that has saturation, found term by term. Out: the model with every term of the co-energy
 * (coenergy_terms.h), each with an expectation, if that describes recordings that are left out better. How
 * wide the expectation is and how high the power of the currents goes is chosen by the same test: fit to all
 * runs but one, judge by that one, each in turn. So one recording more changes the values a little, and never
 * the choice of terms. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_COENERGY_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_COENERGY_H

#include "host/diagnose/search/search.h"

/* Whether saturation is in a model. */
bool hci_search_saturates(const hci_candidates *candidates);

/* Sets search->whole_coenergy where that was done. Nothing is changed without saturation, and with fewer than
 * five runs. HCI_ERROR_MEMORY. O(runs·terms³/3), some ten times. */
hci_status hci_search_coenergy(hci_search *search, hci_fitted_model *model, hci_note *note);

#endif
