/* The line that tells of long work on a terminal: bar, share, times and rate. Uses terminal, text, bar and
 * estimate. */
#ifndef HCI_CLI_PROGRESS_H
#define HCI_CLI_PROGRESS_H

#include <stddef.h>

#include "cli/terminal/estimate.h"

/* What the rate of a job is counted in: `total` of `unit` make the whole. */
typedef struct {
    double total;
    const char *unit;
} cli_work;

/* Tells that a share, from 0 to 1, of what is under way is done; an hci_progress. Shown on a terminal without
 * --quiet, on work longer than a second, at most ten times a second. work: a cli_work, or NULL for percent.
 */
void cli_progress(void *work, const char *what, double share);

/* Erases the line; what comes next is another job. */
void cli_progress_end(void);

/* Time in s since any moment; never goes back. */
typedef double cli_clock(void);

/* Takes the time from another clock than the computer's; NULL: from that again. For tests. */
void cli_progress_use_clock(cli_clock *clock);

/* The line in at most so many columns: where they are few the rate goes first, then the bar, then the times.
 * work: or NULL. */
void cli_progress_text(const cli_estimate *estimate, const cli_work *work, const char *what, int columns,
                       char *text, size_t size);

#endif
