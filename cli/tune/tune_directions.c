#include "cli/tune/tune_directions.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "cli/tune/tune_read.h"
#include "cli/tune/tune_recorded.h"
#include "hci/math/harmonic.h"

#define REACH_RAD (HCI_PI / 12.0)
#define LOADED    0.2 /* of the largest current, in which a direction is told */

/* Of a braking current that of the driving one at the same i_d; NAN: no load. */
static double direction_rad(const cli_tuning *t, const hci_run *r)
{
    double d = 0.0, q = 0.0;
    if (!r->i_A || !r->theta_m_rad || cli_tune_has_no_current(t, r)) return (double)NAN;
    for (size_t k = 0; k < r->count; ++k)
        for (int s = 0; s < 3; ++s) {
            const double x = r->pole_pairs * r->theta_m_rad[k] - 2.0 * HCI_PI * s / 3.0;
            d -= r->i_A[3 * k + (size_t)s] * cos(x);
            q += r->i_A[3 * k + (size_t)s] * sin(x);
        }
    return hypot(d, q) > 0.0 ? atan2(-d, fabs(q)) : (double)NAN;
}

static void loads_only(const cli_tuning *t, double *direction)
{
    double most_A = 0.0;
    for (size_t k = 0; k < t->runs.count; ++k)
        if (isfinite(direction[k])) most_A = fmax(most_A, cli_tune_rms_A(&t->runs.run[k]));
    for (size_t k = 0; k < t->runs.count; ++k)
        if (!(cli_tune_rms_A(&t->runs.run[k]) > LOADED * most_A)) direction[k] = (double)NAN;
}

static size_t beside(const double *direction, size_t count, double of)
{
    size_t n = 0;
    for (size_t k = 0; k < count; ++k)
        n += fabs(direction[k] - of) < REACH_RAD;
    return n;
}

/* The direction of most loads; NAN: none has two, or another one as many. */
static double direction_of_most(const double *direction, size_t count)
{
    size_t most = 1;
    double of_most = (double)NAN;
    for (size_t k = 0; k < count; ++k) {
        const size_t n = isfinite(direction[k]) ? beside(direction, count, direction[k]) : 0;
        if (n < most || n < 2) continue;
        if (n == most && fabs(direction[k] - of_most) >= REACH_RAD) of_most = (double)NAN;
        if (n > most) of_most = direction[k];
        most = n;
    }
    return of_most;
}

static void names_fill(const cli_tuning *t, const double *direction, double of_most, char *names, size_t size)
{
    size_t count = 0, said = 0, used = 0;
    for (size_t k = 0; k < t->runs.count; ++k)
        count += fabs(direction[k] - of_most) >= REACH_RAD;
    for (size_t k = 0; k < t->runs.count && used < size; ++k) {
        if (!(fabs(direction[k] - of_most) >= REACH_RAD)) continue;
        const char *between = said == 0 ? "" : said + 1 == count ? " and " : ", ";
        used += (size_t)snprintf(names + used, size - used, "%s%s", between, cli_tune_name_of(t, k));
        ++said;
    }
}

bool cli_tune_other_directions(const cli_tuning *t, char *names, size_t size)
{
    double *direction = malloc((t->runs.count + 1) * sizeof *direction);
    names[0] = '\0';
    if (!direction) return false;
    for (size_t k = 0; k < t->runs.count; ++k)
        direction[k] = direction_rad(t, &t->runs.run[k]);
    loads_only(t, direction);
    names_fill(t, direction, direction_of_most(direction, t->runs.count), names, size);
    free(direction);
    return names[0] != '\0';
}
