#include "host/recording/row_direction.h"

#include <math.h>

#include "hci/host/base/note.h"
#include "host/base/memory.h"

#define SLOWLY_RAD_PER_S 0.1
#define REVERSALS        0.05 /* of the rows, at which a shaft may turn back */

enum { LEAST = 16 };

/* −1, 0 or 1: how the angle goes from a row to the next. */
static int step_of(const hci_run *run, size_t k)
{
    const double step = run->theta_m_rad[k + 1] - run->theta_m_rad[k];
    return (step > 0.0) - (step < 0.0);
}

static size_t reversals_of(const hci_run *run)
{
    size_t reversals = 0;
    int before = 0;
    for (size_t k = 0; k + 1 < run->count; ++k) {
        const int step = step_of(run, k);
        reversals += step * before < 0;
        before = step ? step : before;
    }
    return reversals;
}

bool hci_row_direction_set(hci_run *run)
{
    if (run->time_s || run->speed_rad_per_s || !run->theta_m_rad || run->count < LEAST) return true;
    if ((double)reversals_of(run) > REVERSALS * (double)run->count) return true;
    run->speed_rad_per_s = hci_memory_new(run->count, sizeof *run->speed_rad_per_s);
    if (!run->speed_rad_per_s) return false;
    for (size_t k = 0, before = 0; k < run->count; before = k++) {
        const int step = step_of(run, k + 1 < run->count ? k : k - 1);
        run->speed_rad_per_s[k] = step ? step * SLOWLY_RAD_PER_S : run->speed_rad_per_s[before];
    }
    hci_note_add(&run->remark,
                 "no time and no speed: the shaft turned slowly, the way the angle goes from row to row");
    return true;
}
