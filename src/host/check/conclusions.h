/* The result of a check. In: the probabilities of all combinations of convention errors. Out: the errors that
 * are found or possible, how each relation stands before and after, what could not be checked, and which
 * errors would change nothing in these files. */
#ifndef HCI_SRC_HOST_CHECK_CONCLUSIONS_H
#define HCI_SRC_HOST_CHECK_CONCLUSIONS_H

#include "hci/host/check/check.h"
#include "host/check/posterior.h"

/* Fills verdict, probability_as_declared, findings, evidence, gaps and untold. */
void hci_check_conclude(const check_posterior *p, hci_check *check);

#endif
