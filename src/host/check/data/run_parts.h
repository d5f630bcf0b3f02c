/* A shaft that turns forward and then backward: means over both would be sums of what has opposite signs, and
 * a mean speed of 0 divides nothing. So a recording is cut where the shaft turns round: what it says of
 * either direction is taken by itself, as if it stood in a file of its own. In: the samples of one file. Out:
 * those of each part. */
#ifndef HCI_SRC_HOST_CHECK_RUN_PARTS_H
#define HCI_SRC_HOST_CHECK_RUN_PARTS_H

#include "host/check/data/run_samples.h"

/* Forward or backward, and each with i_q of either sign. */
enum { CHECK_MOST_PARTS = 4 };

/* part: out, [count], to which part each sample belongs; -1: to one that is too short to be one. A shaft that
 * is held has one part, in which friction there and back has the mean 0. Returns how many parts there are, 1
 * to CHECK_MOST_PARTS, or 0: out of memory. O(count). */
int hci_check_parts_find(const check_samples *s, bool is_held, signed char *part);

/* The samples of a part, in memory of their own, to be released. False: out of memory. */
bool hci_check_part_take(const check_samples *s, const signed char *part, int which, check_samples *out);
void hci_check_part_release(check_samples *part);

/* Whether the angle goes so far from one sample to the next that its way cannot be followed. */
bool hci_check_angle_is_torn(const double *angle, size_t count);

#endif
