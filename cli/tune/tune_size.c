#include "cli/tune/tune_size.h"

#include <math.h>
#include <stdio.h>

#include "cli/tune/tune_current.h"
#include "cli/tune/tune_waveforms.h"

/* Cogging torque, peak to peak, to the rated torque: motors have some percent. */
#define LARGE_COGGING 0.33
#define EXCESS_RATED  1.0

/* Times the largest current that is rated, wanted or recorded under load. */
#define EXCESS_CURRENT 10.0

/* Times the ripple of a plain sine: a bound that is more says nothing. */
#define BOUNDLESS 10.0

/* Where nothing is rated and no load recorded; what is solved for then, too. */
#define LEAST_A 1.0

double cli_tune_rated_Nm(const cli_tuning *t)
{
    if (t->declared.rated_torque_Nm > 0.0) return t->declared.rated_torque_Nm;
    return fmax(t->declared.rated_current_A * t->reading.run.torque_constant_Nm_per_A, 0.0);
}

/* The currents of a slow turn are those of the cogging torque, and tell no load. */
static double load_A(const cli_tuning *t)
{
    double most_A = 0.0;
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        if (r->torque_source != HCI_TORQUE_MEASURED || cli_tune_has_no_current(t, r)) continue;
        for (size_t n = 0; n < 3 * r->count; ++n)
            most_A = fmax(most_A, fabs(r->i_A[n]));
    }
    return most_A;
}

static double usual_A(const cli_tuning *t)
{
    const double rated_Nm = cli_tune_rated_Nm(t), wanted_A = t->solution.plain_amplitude_A;
    const double rated_A = t->declared.rated_current_A > 0.0
                               ? t->declared.rated_current_A
                               : rated_Nm / t->reading.run.torque_constant_Nm_per_A;
    return fmax(fmax(rated_A > 0.0 ? rated_A : LEAST_A, load_A(t)), wanted_A);
}

static double open_swing_Nm(const cli_tuning *t)
{
    double least_Nm = t->open_Nm[0], most_Nm = least_Nm;
    for (size_t k = 1; k < HCI_TUNING_POINTS; ++k)
        least_Nm = fmin(least_Nm, t->open_Nm[k]), most_Nm = fmax(most_Nm, t->open_Nm[k]);
    return most_Nm - least_Nm;
}

void cli_tune_judge_size(cli_tuning *t)
{
    const double rated_Nm = cli_tune_rated_Nm(t);
    if (!t->is_solved) return;
    t->open_swing_Nm = open_swing_Nm(t);
    t->usual_A = usual_A(t);
    if ((rated_Nm > 0.0 && t->open_swing_Nm > EXCESS_RATED * rated_Nm) ||
        t->solution.peak_phase_current_A > EXCESS_CURRENT * t->usual_A)
        t->size = CLI_TUNE_EXCESS;
    else if (rated_Nm > 0.0 && t->open_swing_Nm > LARGE_COGGING * rated_Nm)
        t->size = CLI_TUNE_LARGE;
}

void cli_tune_say_excess(const cli_tuning *t, char *text, size_t size)
{
    const double rated_Nm = cli_tune_rated_Nm(t);
    const char *unit = load_A(t) > 0.0 || t->runs.count == 0 ? "torque, currents and Kv" : "torque and Kv";
    for (size_t k = 0; k < t->runs.count; ++k)
        if (t->runs.run[k].torque_source != HCI_TORQUE_MEASURED) unit = "currents and Kv";
    if (rated_Nm > 0.0 && t->open_swing_Nm > EXCESS_RATED * rated_Nm)
        snprintf(text, size,
                 "A torque without current of %.3g N·m from peak to peak is %.3g times the rated torque of "
                 "%.3g N·m, which no motor has: are %s in the unit that they were read in (N·m, not N·cm, "
                 "lbf·in or N·mm; A, not mA; rpm/V)? No table was written",
                 t->open_swing_Nm, t->open_swing_Nm / rated_Nm, rated_Nm, unit);
    else
        snprintf(
            text, size,
            "The table would take a peak current of %.3g A for a torque without current of %.3g N·m from "
            "peak to peak, %.3g times the %.3g A that %s: are %s in the unit that they were read in "
            "(N·m, not N·cm, lbf·in or N·mm; A, not mA; rpm/V)? If they are, give --rated-current. No table "
            "was written",
            t->solution.peak_phase_current_A, t->open_swing_Nm, t->solution.peak_phase_current_A / t->usual_A,
            t->usual_A, rated_Nm > 0.0 ? "are rated" : "were taken for its load", unit);
}

bool cli_tune_is_unpromised(const cli_tuning *t)
{
    const hci_expected_ripple *e = &t->solution.expected;
    double before_Nm, after_Nm;
    if (!t->is_solved || e->state != HCI_RIPPLE_KNOWN || !hci_tuning_knows_ripple(&t->solution)) return false;
    hci_tuning_swing(&t->solution, &before_Nm, &after_Nm);
    return before_Nm >= t->solution.tolerance_Nm && e->peak_to_peak_Nm > BOUNDLESS * before_Nm;
}
