#include "cli/tune/tune_duration.h"

#include <stdio.h>

#include "cli/tune/tune_read.h"
#include "cli/tune/tune_suspect.h"

#define LONG_s 1200.0 /* few turn a motor on the bench for so long … */
#define RARE_s 0.05   /* … with rows so far apart */

bool cli_tune_say_long(const cli_tuning *t, char *text, size_t size)
{
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        if (!r->time_s || r->count < 2 || r->speed_window == 0)
            continue; /* a speed that was recorded tells it */
        const double span_s = r->time_s[r->count - 1] - r->time_s[0],
                     step_s = span_s / (double)(r->count - 1);
        if (span_s < LONG_s || step_s < RARE_s) continue;
        char column[CLI_TUNE_COLUMN_WORDS];
        cli_tune_say_column("time_ms", r->time_column, column);
        snprintf(text, size,
                 "the rows of %.80s are %.3g s apart, so that it took %.3g hours: are these milliseconds? "
                 "%.120s reads them so",
                 cli_tune_name_of(t, k), step_s, span_s / 3600.0, column);
        return true;
    }
    return false;
}
