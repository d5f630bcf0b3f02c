/* Whether a recording holds the currents of a solution and the smoothness that was promised of them. In:
 * both; out: how the currents lie to the table, by the comparison of `check --table`, the ripple that repeats
 * with the turn, and what follows for the promise. */
#include "hci/host/currents/played.h"

#include <math.h>

#include "host/base/memory.h"
#include "host/numeric/synchronous_average.h"

/* What sensors are off by, of which the promise is not broken: of the size, of what the table has beside its
 * fundamental, and of the rms of the currents, noise and offsets. */
static const double SIZE = 0.05, HARMONICS = 0.25, LEFT = 0.1;

/* Electrical order that has to be told for a ripple to be, and chance of an order that noise alone makes. */
static const double LEAST_ORDER = 12.0, CHANCE = 0.05, ERRORS = 2.0;

const char *hci_played_currents_name(hci_played_currents currents)
{
    static const char *const NAMES[] = {"not_known",    "as_solved", "turned",
                                        "another_size", "others",    "beside"};
    return NAMES[currents];
}

const char *hci_promise_name(hci_promise promise)
{
    static const char *const NAMES[] = {"not_judged", "kept", "not_kept", "not_told", "uncorrected"};
    return NAMES[promise];
}

bool hci_played_is_bad(const hci_played *played)
{
    return played->currents == HCI_PLAYED_TURNED || played->promise == HCI_PROMISE_NOT_KEPT ||
           played->promise == HCI_PROMISE_UNCORRECTED;
}

/* ---- the currents ---- */

/* A sine alone is that of any drive: that it is turned or of another size says nothing of a table. */
static hci_played_currents currents_of(const hci_table_rotation *x)
{
    const bool has_harmonics = x->of_index || x->harmonics_error > 0.0;
    if (!x->is_found || !x->is_seen) return HCI_PLAYED_OTHERS;
    if (x->is_rotated) return has_harmonics ? HCI_PLAYED_TURNED : HCI_PLAYED_OTHERS;
    if (x->left > LEFT) return HCI_PLAYED_OTHERS;
    if (fabs(x->gain - 1.0) > SIZE) return has_harmonics ? HCI_PLAYED_RESIZED : HCI_PLAYED_OTHERS;
    if (has_harmonics && fabs(x->harmonics - x->gain) > HARMONICS + 3.0 * x->harmonics_error)
        return HCI_PLAYED_OTHERS;
    return HCI_PLAYED_AS_SOLVED;
}

/* Standard errors by which what the table has beside its sine stands out of what else flows. */
static const double STANDS_OUT = 5.0;

/* Whether the harmonics are those of the table, whatever sine flows beside them; of a table that seems
 * turned, or of another size, only where they are not so, too. turned: harmonics at the angle by which it
 * seems so. */
static bool is_beside(const hci_played *p, double turned)
{
    const hci_table_beside *b = &p->beside;
    const double off = fabs(b->harmonics - 1.0);
    if (!(b->harmonics > STANDS_OUT * b->harmonics_error) || p->rotation.of_index || p->rotation.backwards)
        return false;
    if (off > HARMONICS + 3.0 * b->harmonics_error) return false;
    if (p->currents == HCI_PLAYED_TURNED) return turned < b->harmonics;
    return p->currents == HCI_PLAYED_OTHERS || off < fabs(b->harmonics - p->rotation.gain);
}

static hci_status currents_judge(const hci_solved_currents *solved, const hci_run *run, int pole_pairs,
                                 const hci_effects *effects, hci_played *p, hci_note *note)
{
    hci_note why = {{0}};
    const hci_status status = hci_table_rotation_of(&solved->table, run, pole_pairs, &p->rotation, &why);
    if (status == HCI_OK) {
        const double ahead_rad = p->rotation.rotation_rad;
        p->currents = currents_of(&p->rotation);
        p->beside = hci_table_beside_of(&solved->table, run, pole_pairs, 0.0, effects);
        if (p->currents != HCI_PLAYED_AS_SOLVED &&
            is_beside(p, hci_table_beside_of(&solved->table, run, pole_pairs, ahead_rad, NULL).harmonics))
            p->currents = HCI_PLAYED_BESIDE;
    }
    if (status != HCI_ERROR_MEMORY) return HCI_OK; /* without an angle or a current it is not known */
    *note = why;
    return status;
}

/* ---- the ripple ---- */

/* Orders that stand out of the noise, as a sum over the turn. */
static double peak_to_peak(const hci_average *a, const hci_order_estimate *order)
{
    const size_t points = 8 * (a->highest + 1);
    double low = 0.0, high = 0.0;
    for (size_t j = 0; j < points; ++j) {
        const double phi = 2.0 * HCI_PI * (double)j / (double)points;
        double sum = 0.0;
        for (size_t k = 1; k <= a->highest; ++k)
            if (order[k].freedom > 0.0)
                sum +=
                    order[k].mean.sine * sin((double)k * phi) + order[k].mean.cosine * cos((double)k * phi);
        low = j == 0 ? sum : fmin(low, sum);
        high = j == 0 ? sum : fmax(high, sum);
    }
    return high - low;
}

/* What noise may have made is marked by no degrees of freedom; its error counts. */
static hci_status ripple_take(const hci_average *a, hci_played *p, hci_note *note)
{
    double square = 0.0;
    hci_order_estimate *order = hci_memory_new(a->highest + 1, sizeof *order);
    if (!order) return hci_note_memory(note, NULL, "the measured ripple");
    for (size_t k = 1; k <= a->highest; ++k) {
        order[k] = hci_average_estimate(a, 0, k);
        square += order[k].std_error * order[k].std_error;
        if (!(hci_order_chance(&order[k]) * (double)a->highest < CHANCE)) order[k].freedom = 0.0;
    }
    p->ripple_Nm = peak_to_peak(a, order);
    p->ripple_error_Nm = sqrt(2.0 * square);
    hci_memory_free(order);
    return HCI_OK;
}

static bool has_torque(const hci_run *run)
{
    return run->theta_m_rad && run->torque_Nm && run->torque_source == HCI_TORQUE_MEASURED &&
           !run->torque_is_clipped && !run->only_mean;
}

/* Of the mechanical turn, or of the electrical one where that is not known. */
static hci_status ripple_judge(const hci_run *run, int pole_pairs, hci_played *p, hci_note *note)
{
    const double periods = run->turn_known ? pole_pairs : 1.0, scale = run->turn_known ? 1.0 : pole_pairs;
    const hci_average_orders orders = {(size_t)(HCI_USUAL_ORDER * periods), (size_t)(LEAST_ORDER * periods),
                                       (size_t)(LEAST_ORDER * periods)};
    hci_average average = {0};
    if (!has_torque(run)) return HCI_OK;
    double *angle_rad = hci_memory_new(run->count, sizeof *angle_rad);
    if (!angle_rad) return hci_note_memory(note, run->name, "%zu samples", run->count);
    for (size_t k = 0; k < run->count; ++k)
        angle_rad[k] = scale * run->theta_m_rad[k];
    hci_status status =
        hci_average_fit(&(hci_average_samples){angle_rad, run->torque_Nm, run->count, 1}, &orders, &average);
    if (!status) status = ripple_take(&average, p, note);
    if (!status) p->ripple_order = (double)average.highest / periods;
    hci_average_release(&average);
    hci_memory_free(angle_rad);
    if (status == HCI_ERROR_MEMORY) return hci_note_memory(note, run->name, "the measured ripple");
    return HCI_OK;
}

/* ---- the promise ---- */

/* Of the corrections, that are in the currents of a drive which makes none, and the error of that. */
static const double NONE = 0.25, TOLD = 0.1;

/* Readings that are the table as they stand are of currents that are not. */
static bool is_uncorrected(const hci_played *p)
{
    return p->beside.corrected_error < TOLD && p->beside.corrected < NONE;
}

static hci_promise promise_of(const hci_solved_currents *solved, const hci_played *p)
{
    const double error_Nm = ERRORS * p->ripple_error_Nm;
    if (p->currents != HCI_PLAYED_AS_SOLVED || !isfinite(p->ripple_Nm) || !isfinite(solved->promised_Nm))
        return HCI_PROMISE_NOT_JUDGED;
    if (p->ripple_Nm + error_Nm <= solved->promised_Nm) return HCI_PROMISE_KEPT;
    if (!(p->ripple_Nm - error_Nm > solved->promised_Nm)) return HCI_PROMISE_NOT_TOLD;
    return is_uncorrected(p) ? HCI_PROMISE_UNCORRECTED : HCI_PROMISE_NOT_KEPT;
}

hci_status hci_played_judge(const hci_solved_currents *solved, const hci_run *run, int pole_pairs,
                            const hci_effects *effects, hci_played *p, hci_note *note)
{
    *p = (hci_played){.is_of_control = run->torque_source == HCI_TORQUE_HOLDING,
                      .ripple_Nm = (double)NAN,
                      .ripple_error_Nm = (double)NAN,
                      .ripple_order = (double)NAN};
    if (!solved->folder[0]) return HCI_OK;
    hci_status status = currents_judge(solved, run, pole_pairs, effects, p, note);
    if (!status) status = ripple_judge(run, pole_pairs, p, note);
    p->promise = promise_of(solved, p);
    return status;
}
