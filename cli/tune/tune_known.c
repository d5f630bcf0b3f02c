#include "cli/tune/tune_known.h"

#include <math.h>

#include "cli/tune/tune_recorded.h"
#include "hci/machine/frames.h"

bool cli_tune_has_zero_of_voltages(const cli_tuning *t)
{
    return t->has_emf && !t->emf_is_size_alone;
}

static hci_dq mean_of(const hci_run *r)
{
    hci_dq mean = {0.0, 0.0, 0.0};
    for (size_t k = 0; k < r->count && r->theta_m_rad; ++k) {
        const hci_dq i = hci_park(hci_clarke(r->i_A + 3 * k), r->pole_pairs * r->theta_m_rad[k]);
        mean.d += i.d / (double)r->count;
        mean.q += i.q / (double)r->count;
    }
    return mean;
}

static bool is_load(const cli_tuning *t, const hci_run *r)
{
    return r->torque_source == HCI_TORQUE_MEASURED && r->theta_m_rad && !cli_tune_has_no_current(t, r);
}

#define ALONG_Q 0.05 /* i_d to i_q, three degrees */

bool cli_tune_has_load_along_q(const cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count; ++k) {
        if (!is_load(t, &t->runs.run[k])) continue;
        const hci_dq i = mean_of(&t->runs.run[k]);
        if (fabs(i.d) < ALONG_Q * fabs(i.q)) return true;
    }
    return false;
}

#define BESIDE_Q 0.1 /* i_d to the current */

bool cli_tune_has_both_id(const cli_tuning *t)
{
    bool has[2] = {false, false};
    for (size_t k = 0; k < t->runs.count; ++k) {
        if (!is_load(t, &t->runs.run[k])) continue;
        const hci_dq i = mean_of(&t->runs.run[k]);
        if (fabs(i.d) > BESIDE_Q * hypot(i.d, i.q)) has[i.d > 0.0] = true;
    }
    return has[0] && has[1];
}

#define ALONG_D 0.1 /* i_q to i_d */

bool cli_tune_lies_along_d(const cli_tuning *t)
{
    size_t loads = 0;
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        if (!is_load(t, r)) continue;
        const hci_dq i = mean_of(r);
        if (r->has_sum || r->computed_phase > 0 || !(fabs(i.q) < ALONG_D * fabs(i.d))) return false;
        ++loads;
    }
    return loads > 0;
}

const char *cli_tune_turn_told_by(const cli_tuning *t)
{
    const bool has_both = !t->turn_is_of_dq && cli_tune_has_both_id(t);
    if (cli_tune_has_zero_of_voltages(t))
        return has_both ? "these loads do not tell it better"
                        : "runs with i_d of both signs at two currents tell it";
    if (has_both) return "voltages of the open machine tell them apart";
    return t->turn_is_of_dq
               ? "phase currents with i_d of both signs at two currents, or voltages of the open "
                 "machine, tell them apart"
               : "runs with i_d of both signs at two currents, or voltages of the open machine, "
                 "tell them apart";
}

#define APART 1.2 /* times */

/* Whether no recording before it has a load of the same size. */
static bool is_other_size(const cli_tuning *t, size_t run)
{
    const hci_dq i = mean_of(&t->runs.run[run]);
    for (size_t k = 0; k < run; ++k) {
        if (!is_load(t, &t->runs.run[k])) continue;
        const hci_dq j = mean_of(&t->runs.run[k]);
        const double ratio = hypot(i.d, i.q) / hypot(j.d, j.q);
        if (ratio < APART && ratio > 1.0 / APART) return false;
    }
    return true;
}

size_t cli_tune_load_sizes(const cli_tuning *t)
{
    size_t sizes = 0;
    for (size_t k = 0; k < t->runs.count; ++k)
        sizes += is_load(t, &t->runs.run[k]) && is_other_size(t, k);
    return sizes;
}

/* Way of the shaft over a recording, rad; 0: it has no angle. */
static double way_rad(const hci_run *r)
{
    return r->theta_m_rad && r->count > 1 ? r->theta_m_rad[r->count - 1] - r->theta_m_rad[0] : 0.0;
}

static double sum_of(const double *x, size_t count)
{
    double sum = 0.0;
    for (size_t k = 0; k < count; ++k)
        sum += x[k];
    return sum;
}

bool cli_tune_loads_drive_alone(const cli_tuning *t)
{
    bool any = false;
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        if (r->torque_source != HCI_TORQUE_MEASURED || !is_load(t, r)) continue;
        if (!(sum_of(r->torque_Nm, r->count) * way_rad(r) > 0.0)) return false;
        any = true;
    }
    return any;
}

bool cli_tune_has_free_turn(const cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count; ++k)
        if (t->runs.run[k].needs_inertia || (t->runs.run[k].torque_source == HCI_TORQUE_HOLDING &&
                                             !hci_run_is_loaded(&t->runs.run[k], t->runs.run[k].pole_pairs)))
            return true;
    return false;
}
