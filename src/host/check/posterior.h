/* How probable each interpretation of the files is. In: the data. Out: all combinations of up to three
 * convention errors that can stand in these files, each with its probability a posteriori: the prior of its
 * errors times the likelihood that the relations give to the interpretation which it makes. Combinations that
 * do the same to these files come out as probable as their priors, so that no choice is made which the files
 * do not justify. */
#ifndef HCI_SRC_HOST_CHECK_POSTERIOR_H
#define HCI_SRC_HOST_CHECK_POSTERIOR_H

#include "hci/host/check/check.h"
#include "host/check/convention_errors.h"
#include "host/check/relations/relation.h"

enum { CHECK_MOST_ERRORS = 3 };

/* A combination of convention errors, no two about the same thing. */
typedef struct {
    int error[CHECK_MOST_ERRORS]; /* indices, ascending; −1: none */
    double probability;
} check_error_set;

typedef struct {
    const check_data *data;
    bool used[HCI_CHECK_MOST_EVIDENCE]; /* of each relation: the data have what it needs */
    check_error_set *list;              /* [count]; [0] has no error */
    size_t count, capacity;
    size_t best; /* the most probable */
} check_posterior;

/* *p starts from {0}; what it leaves is to be released even after a failure. data must outlive *p.
 * HCI_ERROR_MEMORY. O(combinations × relations), some thousands times thirty. */
hci_status hci_check_posterior(const check_data *data, check_posterior *p, hci_note *note);
void hci_check_posterior_release(check_posterior *p);

/* What is supposed where these errors were made. */
check_interpretation hci_check_interpretation_of(const check_data *data, const check_error_set *set);

#endif
