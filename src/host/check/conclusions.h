/* What a check says: the slips of the probable readings, and how the relations stand with them. */
#ifndef HCI_SRC_HOST_CHECK_CONCLUSIONS_H
#define HCI_SRC_HOST_CHECK_CONCLUSIONS_H

#include "host/check/posterior.h"

/* Fills verdict, findings, evidence, gaps and untold. */
void hci_check_conclude(const check_posterior *p, hci_check *check);

#endif
