/* Anderson's acceleration of a fixed-point iteration x ← g(x). */
#ifndef HCI_SRC_HOST_NUMERIC_ANDERSON_H
#define HCI_SRC_HOST_NUMERIC_ANDERSON_H

#include "hci/host/base/note.h"

#include <stddef.h>

/* The last few steps. Start with {0}. */
typedef struct {
    double *x, *f;        /* of the last step, n each; f = g(x) − x */
    double *dx, *df;      /* changes from step to step, n × 5, a ring */
    double *a, *b, *work; /* least squares */
    size_t n, steps;
} hci_anderson;

/* Memory for n coordinates; forgets what went before. HCI_ERROR_MEMORY, without a note. */
hci_status hci_anderson_reset(hci_anderson *mixing, size_t n);

/* x (n): in the point, out the next one; g (n): the answer g(x) of the step from x. The first step goes to g.
 * O(n). */
void hci_anderson_step(hci_anderson *mixing, double *x, const double *g);

void hci_anderson_release(hci_anderson *mixing);

#endif
