#include "host/diagnose/unconfirmed.h"

#include <math.h>
#include <string.h>

#include "host/diagnose/candidates/empirical_term.h"

#define SMALL 0.333 /* of what is explained: rms of what is not, beside which that stands */

/* Whether runs held out are left with more than their noise, and that is not small beside what is explained
 * of them. */
static bool is_much_held_out(const hci_diagnosis *d)
{
    const double after = d->holdout_after_Nm * d->holdout_after_Nm;
    const double left = after - d->holdout_noise_Nm * d->holdout_noise_Nm;
    const double explained = d->holdout_before_Nm * d->holdout_before_Nm - after;
    return isfinite(after) && left > SMALL * SMALL * fmax(0.0, explained);
}

static bool is_found_without_runs(const hci_verdict *v)
{
    return 3 * v->stays >= 2 * v->left_out;
}

/* Beside something unknown nothing is compared. */
static bool stands_out(const hci_attribution *a, const hci_verdict *v)
{
    return a->unknown ? a->unexplained_Nm < SMALL * v->explained_Nm : v->compared;
}

bool hci_is_unconfirmed(const hci_attribution *a, const hci_diagnosis *d, const hci_verdict *v)
{
    return a->ended == HCI_WORK_LIMITED && v->in && v->type != &hci_empirical_type && !v->established &&
           (a->unsettled || !is_found_without_runs(v) || !stands_out(a, v) || is_much_held_out(d));
}
