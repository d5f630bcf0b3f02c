/* Up to which order the torque of recordings varies. */
#ifndef HCI_SRC_HOST_DIAGNOSE_FIT_SHOWN_ORDERS_H
#define HCI_SRC_HOST_DIAGNOSE_FIT_SHOWN_ORDERS_H

#include "host/diagnose/reading/regression.h"

/* The highest multiple of `stride` in electrical orders, at most `most`, of which the measured torque of a
 * run in use has more than least_Nm of amplitude and more than its noise makes once in 10⁶; 0: none has. Of
 * segments that cover an electrical turn; where there is none, `most`. O(samples·most / stride). */
int hci_highest_order_shown(const hci_regression *regression, int stride, int most, double least_Nm);

#endif
