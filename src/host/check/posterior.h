/* All readings of the files with up to three slips, and how probable each is. */
#ifndef HCI_SRC_HOST_CHECK_POSTERIOR_H
#define HCI_SRC_HOST_CHECK_POSTERIOR_H

#include "host/check/convention_errors.h"
#include "host/check/relations.h"

enum { CHECK_MOST_SLIPS = 3 };

typedef struct {
    int choice[CHECK_MOST_SLIPS]; /* indices, ascending; −1: none */
    double weight;                /* ln of prior × likelihood, then the probability */
} check_reading;

typedef struct {
    const check_figures *figures;
    bool used[HCI_CHECK_MOST_EVIDENCE]; /* of each relation */
    check_reading *list;                /* [0]: nothing is read wrongly */
    size_t count, room;
    size_t best; /* the most probable */
} check_posterior;

/* Starts from {0}; what it leaves is to be released even after a failure. HCI_ERROR_MEMORY. */
hci_status hci_check_posterior(const check_figures *f, check_posterior *p, hci_note *note);
void hci_check_posterior_release(check_posterior *p);

check_view hci_check_view_of(const check_reading *r);
check_value hci_check_relation_value(const check_figures *f, const check_relation *relation,
                                     const check_view *view);

#endif
