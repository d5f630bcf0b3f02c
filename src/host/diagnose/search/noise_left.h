/* Whether what a model leaves of the recordings is noise: its variance against that of the noise under its
 * lines, whether its size is the same all along, and whether it follows the rate of the modelled torque. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_NOISE_LEFT_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_NOISE_LEFT_H

#include "host/diagnose/search/search.h"

/* Sums over the runs in use. */
typedef struct {
    double rows;                  /* samples that tell; 0: none */
    double square_Nm2, noise_Nm2; /* of what is left, and of the noise */
    bool wanders;                 /* long recordings leave what does not repeat, or is uneven */
    bool is_noise;
} hci_noise_left;

/* Finds the noise of the model anew. HCI_ERROR_MEMORY. O(samples). */
hci_status hci_noise_left_find(hci_search *search, const hci_candidates *model, hci_noise_left *left,
                               hci_note *note);

/* That alone. */
hci_status hci_search_is_noise(hci_search *search, const hci_candidates *model, bool *is_noise,
                               hci_note *note);

#endif
