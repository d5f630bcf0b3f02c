#include "host/diagnose/candidates/candidate_orders.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/candidates/empirical_term.h"
#include "host/numeric/divisor.h"
#include "host/numeric/rotor.h"
#include "host/numeric/wide.h"
#include "host/recording/rotor_frame.h"

#define RESOLVED  0.48 /* orders for each sample of a turn */
#define APART     0.7  /* of the samples, that lie at places of their own: 0.885 of those at random */
#define LEAST_ARC 0.02 /* electrical turns: a shaft that is held moves as much, and tells no order */

enum {
    MOST_PERIODS = 1200 /* in a mechanical turn */,
    MOST_ELECTRICAL = 96,
    FEW_A_TURN = 4,
    CELLS_A_SAMPLE = 4
};

/* ---- sums ---- */

/* Where the samples of a segment lie. */
typedef struct {
    double least, range; /* of the angle in rad */
    size_t places;       /* in one turn at most, that are told apart */
} angles;

static angles angles_of(const hci_binned_samples *samples, const hci_segment *x)
{
    angles a = {INFINITY, 0.0, x->count};
    double most = -INFINITY;
    for (size_t k = x->first; k < x->first + x->count; ++k) {
        a.least = fmin(a.least, samples->sample[k].reading.theta_m_rad);
        most = fmax(most, samples->sample[k].reading.theta_m_rad);
    }
    a.range = most - a.least;
    return a;
}

/* Counts the cells of a turn, or of the part of it that is covered, in which samples lie, four for each: a
 * shaft that is read at the same places forward and back, or turn by turn, tells no more orders than once. */
static bool count_places(const hci_binned_samples *samples, const hci_segment *x, angles *a)
{
    const size_t cells = CELLS_A_SAMPLE * x->count;
    const double turn = 2.0 * HCI_PI, arc = fmin(a->range, turn);
    if (!(arc > 0.0)) return true;
    unsigned char *seen = hci_memory_new(cells, sizeof *seen);
    if (!seen) return false;
    a->places = 0;
    for (size_t k = x->first; k < x->first + x->count; ++k) {
        const double away = samples->sample[k].reading.theta_m_rad - a->least;
        const double place = fmod(away, turn) / arc * (double)cells;
        unsigned char *cell = &seen[(size_t)fmin(place, (double)(cells - 1))];
        a->places += !*cell;
        *cell = 1;
    }
    hci_memory_free(seen);
    return true;
}

/* Samples in a mechanical turn of a segment: by the way that it covers, or by its places where many fall
 * together. */
static double samples_a_turn(const angles *a, size_t count)
{
    const double by_way = (double)count * 2.0 * HCI_PI / a->range;
    const double by_place = (double)a->places * 2.0 * HCI_PI / fmin(a->range, 2.0 * HCI_PI);
    return (double)a->places < APART * (double)count ? fmin(by_way, by_place) : by_way;
}

/* Periods in a mechanical turn that the samples tell; false when memory is out. */
static bool resolved_periods(const hci_candidates_source *s, double *periods)
{
    double sum = 0.0, covered = 0.0;
    for (size_t k = 0; k < s->samples->segment_count; ++k) {
        const hci_segment *x = &s->samples->segment[k];
        angles a = angles_of(s->samples, x);
        if (a.range * s->machine->pole_pairs < LEAST_ARC * 2.0 * HCI_PI) continue;
        if (!count_places(s->samples, x, &a)) return false;
        sum += samples_a_turn(&a, x->count) * a.range;
        covered += a.range;
    }
    *periods = covered > 0.0 ? RESOLVED * sum / covered : (double)INFINITY;
    return true;
}

static size_t most_periods(const hci_candidates_source *s, double resolved)
{
    const double wanted = fmin(resolved, MOST_ELECTRICAL * (double)s->machine->pole_pairs);
    return isfinite(resolved) ? (size_t)fmax(1.0, fmin(wanted, MOST_PERIODS)) + 1 : 2;
}

/* Means of the residual of each run, by weight. */
static void means_of(const hci_candidates_source *s, double *mean, double *weight)
{
    for (size_t k = 0; k < s->samples->segment_count; ++k) {
        const hci_segment *x = &s->samples->segment[k];
        for (size_t j = x->first; j < x->first + x->count; ++j) {
            const double w = 1.0 / s->variance[j];
            mean[x->run] += w * s->residual_Nm[j];
            weight[x->run] += w;
        }
    }
    for (size_t r = 0; r < s->samples->run_count; ++r)
        if (weight[r] > 0.0) mean[r] /= weight[r];
}

/* Sums over all samples. */
typedef struct {
    double *with_current; /* [2][count]: with i_q; cosine and sine */
    double weight, weight_iq;
} sums;

/* residual: weighted. of_run: sums of the sample's run. */
HCI_WIDE static void sample_add(double angle_rad, double residual, double iq, size_t count,
                                double *with_current, double *of_run)
{
    hci_rotor r = hci_rotor_at(angle_rad);
    size_t k = 0;
    for (; k + HCI_ROTOR_LANES <= count; k += HCI_ROTOR_LANES) {
        hci_rotor_add(&r, residual, of_run + k, HCI_ROTOR_LANES, count);
        hci_rotor_add(&r, residual * iq, with_current + k, HCI_ROTOR_LANES, count);
        hci_rotor_turn(&r);
    }
    hci_rotor_add(&r, residual, of_run + k, count - k, count);
    hci_rotor_add(&r, residual * iq, with_current + k, count - k, count);
}

static void segment_add(const hci_candidates_source *s, const hci_segment *x, double mean,
                        hci_candidate_orders *lines, sums *sum)
{
    if (s->runs[x->run].only_mean) return; /* it has no angle */
    for (size_t j = x->first; j < x->first + x->count; ++j) {
        const hci_sample *reading = &s->samples->sample[j].reading;
        const double w = 1.0 / s->variance[j], theta = reading->theta_m_rad;
        const double iq = hci_sample_dq(reading, s->machine->pole_pairs).q;
        sample_add(theta * (double)lines->stride, w * (s->residual_Nm[j] - mean), iq, lines->count,
                   sum->with_current, lines->of_run + 2 * lines->count * x->run);
        lines->weight[x->run] += w;
        sum->weight += w;
        sum->weight_iq += w * iq * iq;
    }
}

/* What a wave with these sums of residual × cos and × sin would explain. */
static double explained(double cosine, double sine, double weight)
{
    return weight > 0.0 ? 2.0 * (cosine * cosine + sine * sine) / weight : 0.0;
}

static void lines_fill(const sums *sum, size_t runs, hci_candidate_orders *lines)
{
    for (size_t k = 0; k < lines->count; ++k) {
        double cosine = 0.0, sine = 0.0;
        for (size_t r = 0; r < runs; ++r) {
            cosine += lines->of_run[2 * lines->count * r + k];
            sine += lines->of_run[2 * lines->count * r + lines->count + k];
        }
        lines->still[k] = explained(cosine, sine, sum->weight);
        lines->with_current[k] =
            explained(sum->with_current[k], sum->with_current[lines->count + k], sum->weight_iq);
    }
}

/* Everything in one block, which begins at `still`. */
bool hci_candidate_orders_make(const hci_candidates_source *s, size_t stride, hci_candidate_orders *lines)
{
    double resolved;
    memset(lines, 0, sizeof *lines);
    if (!resolved_periods(s, &resolved)) return false;
    const size_t runs = s->samples->run_count, count = most_periods(s, resolved) / stride + 1;
    lines->resolved = resolved / s->machine->pole_pairs;
    lines->stride = stride;
    lines->slots = s->slots;
    lines->count = count;
    lines->still = hci_memory_new(4 * count + 2 * runs * count + 3 * runs, sizeof *lines->still);
    if (!lines->still) return false;
    lines->with_current = lines->still + count;
    lines->of_run = lines->with_current + count;
    lines->weight = lines->of_run + 2 * runs * count;
    double *mean = lines->weight + runs, *of_mean = mean + runs;
    sums sum = {of_mean + runs, 0.0, 0.0};
    means_of(s, mean, of_mean);
    for (size_t k = 0; k < s->samples->segment_count; ++k) {
        const hci_segment *x = &s->samples->segment[k];
        segment_add(s, x, mean[x->run], lines, &sum);
    }
    lines_fill(&sum, runs, lines);
    return true;
}

void hci_candidate_orders_release(hci_candidate_orders *lines)
{
    hci_memory_free(lines->still);
    memset(lines, 0, sizeof *lines);
}

/* ---- those that stand out ---- */

/* Whether a whole electrical order is one of slots and poles: teeth that differ make even ones, magnets whose
 * north poles differ from their south poles multiples of three, and both together any. But what is also few
 * times a turn, as a coupling or a load that is out of line makes it, is that. Where the turn is not known,
 * any order may be theirs. */
static bool is_of_poles(const hci_candidate_orders *lines, size_t periods, size_t pole_pairs)
{
    const size_t order = periods / pole_pairs;
    return order % 2 == 0 || order % 3 == 0 || periods > FEW_A_TURN || lines->stride > 1;
}

/* Whether an order of the mechanical turn is one of slots and poles: a whole electrical order, one of all the
 * slots, which magnets that differ make, or one that a group of the poles shares with a group of the slots.
 */
static bool is_of_slots(const hci_candidate_orders *lines, size_t periods, size_t pole_pairs)
{
    if (periods % pole_pairs == 0 && is_of_poles(lines, periods, pole_pairs)) return true;
    if (lines->slots > 1 && periods % lines->slots == 0) return true;
    return periods > pole_pairs && periods % 3 == 0 && hci_common_divisor(periods, pole_pairs) > 1;
}

/* At one current all that stands still grows with it as well. */
#define WITH_CURRENT 1.5 /* times what would be explained without */

static bool is_with_current(const hci_candidate_orders *lines, size_t k)
{
    return lines->with_current[k] > WITH_CURRENT * lines->still[k];
}

/* 0: not of this kind. */
static double strength(const hci_candidate_orders *lines, size_t k, size_t pole_pairs, hci_order_kind kind)
{
    const size_t periods = k * lines->stride;
    const bool of_slots = is_of_slots(lines, periods, pole_pairs);
    switch (kind) {
    case HCI_ORDERS_OF_SLOTS:
        return of_slots ? lines->still[k] : 0.0;
    case HCI_ORDERS_OF_TURN:
        return of_slots ? 0.0 : fmax(lines->still[k], lines->with_current[k]);
    case HCI_ORDERS_OF_LOAD:
        break;
    }
    const bool is_load = of_slots && periods % pole_pairs != 0 && is_with_current(lines, k);
    return is_load ? lines->with_current[k] : 0.0;
}

size_t hci_candidate_orders_next(const hci_candidate_orders *lines, size_t pole_pairs, hci_order_kind kind,
                                 double *under)
{
    size_t best = 0;
    double most = HCI_STANDS_OUT;
    for (size_t k = 1; k < lines->count; ++k) {
        const double x = strength(lines, k, pole_pairs, kind);
        if (x >= *under || x <= most) continue;
        most = x;
        best = k;
    }
    *under = most;
    return best * lines->stride;
}

bool hci_candidate_orders_poles_differ(const hci_candidate_orders *lines, size_t pole_pairs)
{
    bool differ = false;
    for (size_t k = 3 * pole_pairs / lines->stride; k < lines->count; k += 6 * pole_pairs / lines->stride)
        differ = differ || (lines->with_current[k] > HCI_STANDS_OUT && is_with_current(lines, k));
    return differ;
}

/* ---- those that grow as nothing known does ---- */

/* What a torque of one order and growth would explain. */
static double growth_gain(const hci_candidate_orders *lines, const hci_binned_samples *samples, size_t k,
                          size_t g)
{
    double cosine = 0.0, sine = 0.0, weight = 0.0;
    for (size_t r = 0; r < samples->run_count; ++r) {
        const hci_run_statistics *f = &samples->statistics[r];
        const double *sum = lines->of_run + 2 * lines->count * r + k;
        const double x = hci_growth_law_at(g, f->current_A, f->mean_speed_rad_per_s);
        cosine += x * sum[0];
        sine += x * sum[lines->count];
        weight += x * x * lines->weight[r];
    }
    return explained(cosine, sine, weight);
}

static bool is_among(size_t k, const size_t *list, size_t count)
{
    for (size_t j = 0; j < count; ++j)
        if (list[j] == k) return true;
    return false;
}

size_t hci_candidate_orders_empirical(const hci_candidate_orders *lines, const hci_binned_samples *samples,
                                      const size_t *taken, size_t count, size_t *growth)
{
    double most = 2.0 * HCI_STANDS_OUT; /* of many growths one fits by chance */
    size_t best = 0;
    for (size_t k = 1; k < lines->count; ++k) {
        if (is_among(k, taken, count)) continue;
        for (size_t g = 0; g < HCI_GROWTH_LAWS; ++g) {
            if (hci_growth_law_is_known(g, (double)k)) continue;
            const double gain = growth_gain(lines, samples, k, g);
            if (!(gain > most)) continue;
            most = gain;
            best = k;
            *growth = g;
        }
    }
    return best;
}
