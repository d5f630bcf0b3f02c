/* Which rows of a long table are shown. Uses nothing of cli. */
#ifndef HCI_CLI_ROWS_H
#define HCI_CLI_ROWS_H

#include <stddef.h>

enum { CLI_MOST_ROWS = 20 };

/* The largest of `count` values, at most CLI_MOST_ROWS, in their order; those below `least` of the largest
 * do not count. Returns how many. left_out: how many more there are, or NULL. */
size_t cli_pick(double (*value)(const void *context, size_t k), const void *context, size_t count,
                double least, size_t pick[CLI_MOST_ROWS], size_t *left_out);

#endif
