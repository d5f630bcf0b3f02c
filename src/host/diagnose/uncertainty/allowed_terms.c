#include "host/diagnose/uncertainty/allowed_terms.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/candidates/coenergy_terms.h"
#include "host/recording/rotor_frame.h"

/* How far the series of the co-energy goes: the powers of a machine in which saturation was found and of one
 * without, the orders of recordings that tell all terms of it and of those that tell single ones. */
enum { MOST_POWER = 8, PLAIN_POWER = 4, MOST_ORDER = 96, PLAIN_ORDER = 48 };

enum { OF_I_Q_CUBED = 3 }; /* power of the currents in the co-energy, whose torque that is */

#define FIRST_OF_SLOTS 5.0  /* order of a back-EMF beside 6, the first of cogging torque and co-energy */
#define WHOLE_TURN     0.9  /* electrical, of a run that tells orders by its samples */
#define SATURATES      0.02 /* of the torque per ampere, at the largest current that was recorded */
#define NO_TORQUE      1e-9 /* N·m, of a coefficient of 1 at 1 A */
#define HALF           1e-6 /* of an order: half as many orders as samples is one too many */

/* ---- how far ---- */

/* The highest order that the samples of a segment tell; two samples a period always read 0 of some phase. */
static double order_told(const hci_regression *e, const hci_segment *s)
{
    const hci_binned_sample *first = e->samples->sample + s->first, *last = first + s->count - 1;
    const double span = fabs(last->reading.theta_m_rad - first->reading.theta_m_rad);
    const double turns = span * e->machine->pole_pairs / (2.0 * HCI_PI);
    if (!(turns > WHOLE_TURN)) return INFINITY;
    return ceil(0.5 * (double)(s->count - 1) / turns - HALF) - 1.0;
}

static double current_of(const hci_regression *e)
{
    double current_A = 0.0;
    for (size_t r = 0; r < e->samples->run_count; ++r)
        if (e->use[r]) current_A = fmax(current_A, e->samples->statistics[r].current_A);
    return current_A;
}

static bool has_whole_coenergy(const hci_candidates *fitted)
{
    for (size_t k = 0; k < fitted->count; ++k)
        if (fitted->candidate[k].in && fitted->candidate[k].coenergy_unit > 0.0) return true;
    return false;
}

static bool saturates(const hci_candidates *fitted)
{
    for (size_t k = 0; k < fitted->count; ++k)
        if (fitted->candidate[k].in && fitted->candidate[k].type->beyond_quadratic) return true;
    return false;
}

static hci_effect_coenergy_series series_of(const hci_regression *e, const hci_candidates *fitted)
{
    const bool whole = has_whole_coenergy(fitted);
    double order = whole ? MOST_ORDER : PLAIN_ORDER, reference_A = fitted->reference_current_A;
    for (const hci_segment *s = NULL; (s = hci_regression_next(e, s)) != NULL;)
        order = fmin(order, order_told(e, s));
    if (!(reference_A > 0.0)) reference_A = current_of(e);
    if (!(reference_A > 0.0)) reference_A = 1.0;
    return (hci_effect_coenergy_series){e->machine->pole_pairs, saturates(fitted) ? MOST_POWER : PLAIN_POWER,
                                        (int)fmax(0.0, order), reference_A, false, 0};
}

/* ---- terms ---- */

/* A value that the machine has declared, and that no candidate of the model replaces. */
static double declared_value(const hci_regression *e, const hci_effect_type *type,
                             const hci_effect_term *term)
{
    for (size_t k = 0; k < e->declared->count; ++k)
        for (size_t j = 0; e->declared->effect[k].type == type && j < e->declared->effect[k].count; ++j) {
            const hci_effect_term *x = &e->declared->effect[k].term[j];
            if (x->parameter == term->parameter && fabs(x->order - term->order) <= HCI_ORDER_TOLERANCE)
                return x->value;
        }
    return 0.0;
}

static double noise_rms(const hci_regression *e)
{
    double sum = 0.0, count = 0.0;
    for (const hci_segment *s = NULL; (s = hci_regression_next(e, s)) != NULL;) {
        const double rms = hci_regression_noise(e, s)->rms;
        sum += hci_segment_joined(s) * rms * rms * (double)s->count;
        count += (double)s->count;
    }
    return count > 0.0 ? sqrt(sum / count) : 0.0;
}

/* Whether a term is expected by the width: those that the model does not have, those that it has from a
 * series with such expectations, and where iron saturates all that iron does: a law that is no polynomial has
 * every power, and the ones that were found are those that stood out. */
static bool is_by_width(const hci_candidates *fitted, const hci_candidate *known, const hci_candidate *x)
{
    if (!known || (known->coenergy_unit > 0.0 && known->deviation > 0.0)) return true;
    return saturates(fitted) && x->coenergy_unit > 0.0 && x->power >= 2;
}

/* Root of the mean square over the orders where something was found; one by itself may be the difference of
 * two that are larger. */
static double usual_size(const double size[HCI_COENERGY_ORDERS])
{
    double sum = 0.0, count = 0.0;
    for (size_t k = 1; k < HCI_COENERGY_ORDERS; ++k) {
        sum += size[k] * size[k];
        count += size[k] > 0.0;
    }
    return count > 0.0 ? sqrt(sum / count) : 0.0;
}

/* What is expected of order 0 before anything is recorded, as the coefficient of i_d²: saliency, 3/4 ΔL I².
 */
static double usual_of_mean(const hci_regression *e, double reference_A)
{
    const double difference_H = e->saliency.inductance_H + e->saliency.flux_Wb / reference_A;
    return 0.75 * difference_H * reference_A * reference_A;
}

/* The same of the coefficient of i_d i_q²: what iron takes of the torque per ampere, T = p c (i_q/I)³. */
static double usual_along_q(const hci_regression *e, double reference_A)
{
    return SATURATES * fabs(e->declared_constant) * reference_A / e->machine->pole_pairs;
}

/* As large as squares and higher powers were found, where any were; where none, as all that was. */
static double size_of_power(const hci_coenergy_sizes *found, const hci_candidate *x)
{
    const double squares =
        x->power > 1 ? usual_size(x->unlike ? found->unlike_squares : found->usual_squares) : 0.0;
    return squares > 0.0 ? squares : usual_size(x->unlike ? found->unlike : found->usual);
}

/* What was found at an order may be another term that makes the same torque in the recordings: as large as
 * that is likely. What no recording varies is as large as rotors are: of order 0, that of i_d i_q. */
static double twin_of(const hci_coenergy_sizes *found, const hci_candidate *x)
{
    const size_t place = hci_coenergy_place(x->term[0].order);
    const double *size = x->unlike ? found->unlike : found->usual;
    const double of_mean = x->power == 2 && !x->unlike ? fmax(size[0], found->mean) : size[0];
    if (place == 0) return x->coenergy_unit * of_mean;
    return size[place] > 0.0 ? x->coenergy_unit * size_of_power(found, x) : 0.0;
}

/* Whether a term of the co-energy makes no torque where the current is all i_q: looked at over a period of
 * the lowest order. */
static bool needs_direct(const hci_machine *machine, const hci_candidate *x, size_t j)
{
    enum { ANGLES = 7 };
    hci_effect_term term = x->term[j];
    const hci_effect effect = {x->type, &term, 1};
    const hci_effects one = {&effect, 1};
    term.value = 1.0;
    for (int k = 0; x->coenergy_unit > 0.0 && k < ANGLES; ++k) {
        const double theta_rad = 1.0 + k; /* no order has the same phase at all of them */
        hci_sample sample = {.theta_m_rad = theta_rad / machine->pole_pairs, .temperature_C = NAN};
        hci_phases_of_dq((hci_dq){.q = 1.0}, theta_rad, sample.i_abc);
        if (fabs(hci_effects_torque(machine, &one, &sample, NULL).torque_Nm) > NO_TORQUE) return false;
    }
    return x->coenergy_unit > 0.0;
}

/* A term that was found is about as large as what was found is: where the recordings tell it, that does not
 * matter, and where a run that alone tells it from another is left out, it cannot be anything. */
static void known_narrow(const hci_coenergy_sizes *found, const hci_candidate *x, size_t j,
                         hci_allowed_terms *t, size_t at)
{
    const size_t place = hci_coenergy_place(x->term[j].order);
    const double size = fmax(found->usual[place], found->unlike[place]);
    const double departure = hci_candidate_departure(x, j);
    const double deviation = fmax(fabs(departure), x->coenergy_unit * size);
    if (isnan(t->fixed[at]) || !(x->coenergy_unit > 0.0 && deviation > 0.0)) return;
    t->known[at] = deviation;
    t->centre[at] = -departure;
}

/* One over the variance of terms of the mean where means tell nothing: none of them is another one, and how
 * far the mean is open is said by the torque per ampere. */
#define UNTOLD 1e30

/* One term of a candidate: a term of the model keeps what was expected of it, unless that is by the width;
 * all others are expected where they are. */
static void term_fill(const hci_regression *e, const hci_candidates *fitted, const hci_coenergy_sizes *found,
                      hci_candidate *x, size_t j, hci_allowed_terms *t)
{
    const hci_candidate *known = hci_candidates_find_in(fitted, x);
    const double deviation = known ? known->deviation : 0.0;
    const bool by_width = is_by_width(fitted, known, x);
    const double own = deviation > 0.0 ? deviation : x->term[j].std_error;
    const double unit = x->coenergy_unit > 0.0 ? x->coenergy_unit * noise_rms(e) : own;
    const size_t at = t->count++;
    if (!known) x->term[j].value = declared_value(e, x->type, &x->term[j]);
    t->unit[at] = unit > 0.0 ? unit : 1.0;
    t->fixed[at] = by_width ? (double)NAN : deviation > 0.0 ? 1.0 / (deviation * deviation) : 0.0;
    t->centre[at] = known ? -x->term[j].value : 0.0;
    t->twin[at] = isnan(t->fixed[at]) && x->coenergy_unit > 0.0 ? twin_of(found, x) : 0.0;
    if (known) known_narrow(found, x, j, t, at);
    t->of_mean[at] = x->coenergy_unit > 0.0 && x->term[j].order < FIRST_OF_SLOTS;
    t->by_direct[at] = needs_direct(e->machine, x, j);
    t->power[at] = x->coenergy_unit > 0.0 ? x->power : 0;
    const bool along_q = t->of_mean[at] && !t->by_direct[at] && x->power == OF_I_Q_CUBED && !x->unlike;
    t->iron[at] = along_q && isnan(t->fixed[at]) ? found->along_q : 0.0;
    if (e->free_means && t->of_mean[at] && !known) t->fixed[at] = UNTOLD;
}

/* Room for so many terms; on failure what there is waits for release. */
static hci_status terms_reserve(hci_allowed_terms *t, size_t terms, hci_note *note)
{
    t->unit = hci_memory_new(6 * terms + 1, sizeof *t->unit);
    t->of_mean = hci_memory_new(terms + 1, sizeof *t->of_mean);
    t->by_direct = hci_memory_new(terms + 1, sizeof *t->by_direct);
    t->power = hci_memory_new(terms + 1, sizeof *t->power);
    if (!t->unit || !t->of_mean || !t->power || !t->by_direct)
        return hci_note_memory(note, NULL, "what recordings leave open");
    t->fixed = t->unit + terms;
    t->centre = t->fixed + terms;
    t->twin = t->centre + terms;
    t->known = t->twin + terms;
    t->iron = t->known + terms;
    return HCI_OK;
}

static void terms_fill(const hci_regression *e, const hci_candidates *fitted, const hci_coenergy_sizes *found,
                       hci_allowed_terms *t)
{
    for (size_t k = 0; k < t->candidates.count; ++k) {
        hci_candidate *x = &t->candidates.candidate[k];
        for (size_t j = 0; j < x->count; ++j)
            term_fill(e, fitted, found, x, j, t);
        x->deviation = 0.0;
    }
}

hci_status hci_allowed_terms_make(const hci_regression *regression, const hci_candidates *fitted,
                                  hci_allowed_terms *t, hci_note *note)
{
    const hci_effect_coenergy_series series = series_of(regression, fitted);
    hci_coenergy_sizes found;
    memset(t, 0, sizeof *t);
    hci_coenergy_sizes_of(fitted, &series, &found);
    found.mean = usual_of_mean(regression, series.reference_current_A);
    found.along_q = usual_along_q(regression, series.reference_current_A);
    hci_status status = hci_coenergy_terms(fitted, &series, &t->candidates, note);
    if (!status) status = hci_coenergy_terms_unlike(&found, &series, &t->candidates, note);
    if (status) return status;
    t->candidates.reference_current_A = series.reference_current_A;
    t->largest_current_A = current_of(regression);
    status = terms_reserve(t, hci_candidates_terms_in(&t->candidates), note);
    if (status)
        hci_allowed_terms_release(t);
    else
        terms_fill(regression, fitted, &found, t);
    return status;
}

void hci_allowed_terms_release(hci_allowed_terms *t)
{
    hci_candidates_release(&t->candidates);
    hci_memory_free(t->unit);
    hci_memory_free(t->of_mean);
    hci_memory_free(t->by_direct);
    hci_memory_free(t->power);
    memset(t, 0, sizeof *t);
}

/* By how much less than what was found a term is expected to be for its power of the currents. */
static double of_power(const hci_allowed_terms *t, size_t k, hci_allowed_width width)
{
    return t->power[k] > 2 ? width.beyond : 1.0;
}

void hci_allowed_terms_precision(const hci_allowed_terms *t, hci_allowed_width width, double *precision)
{
    for (size_t k = 0; k < t->count; ++k) {
        const double by_width = width.orders * (t->of_mean[k] ? width.mean_times : 1.0) * t->unit[k];
        const double twin = fmax(of_power(t, k, width) * t->twin[k], t->iron[k]);
        const double deviation = fmax(by_width, width.twins * twin);
        precision[k] = isnan(t->fixed[k]) ? 1.0 / (deviation * deviation) : t->fixed[k];
        if (!(t->known[k] > 0.0)) continue;
        const double known = t->known[k] * (width.twins > 0.0 ? width.twins : 1.0);
        precision[k] = fmax(precision[k], 1.0 / (known * known));
    }
}
