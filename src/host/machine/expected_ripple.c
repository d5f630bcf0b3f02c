#include "host/machine/expected_ripple.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hci/machine/frames.h"
#include "host/base/memory.h"
#include "host/numeric/fft.h"
#include "host/numeric/statistics.h"

#define EXCEEDED 0.05 /* share of the machines above a figure */
#define ROUNDING 1e-9 /* of a range of currents, by which one is not outside yet, and of the torque */

const char *hci_ripple_state_words(hci_ripple_state state)
{
    static const char *const WORDS[] = {
        "",
        "Ripple not known: no recordings that tell it (diagnose writes uncertainty.csv from three or more "
        "that it has explained, or from parts of a long one)",
        "Ripple not known: effects.csv is not the one that uncertainty.csv was found for; run diagnose "
        "again",
        "Ripple not known: the currents lie far outside of what one or two recordings show; record such a "
        "run",
        "Ripple not known: the recordings tell of no order of the torque, or of the lowest alone; record "
        "ones "
        "with more samples in an electrical turn",
        "Ripple not known: the diagnosis of this machine has not explained its recordings",
        "Ripple not known: what a load once or twice a turn makes with harmonics of the back-EMF is not told "
        "from cogging torque; record it without that load",
        "Ripple not known: no recording shows a torque under load; record three or more with a torque "
        "sensor"};
    return WORDS[state];
}

/* ---- torque of every machine ---- */

/* torque[machines][count]; by_value[terms] and value[machines]: of work. */
typedef struct {
    const hci_ripple_path *path;
    const hci_uncertainty *uncertainty;
    double *torque_Nm, *by_value, *value;
} machines;

static hci_status machines_make(const hci_ripple_path *path, const hci_uncertainty *u, machines *m,
                                hci_note *note)
{
    const size_t terms = hci_effects_terms(&u->effects.list), all = u->machines * path->count;
    *m = (machines){path, u, hci_memory_new(all + terms + u->machines, sizeof(double)), NULL, NULL};
    if (!m->torque_Nm) return hci_note_memory(note, NULL, "what to expect of the machine");
    m->by_value = m->torque_Nm + all;
    m->value = m->by_value + terms;
    return HCI_OK;
}

/* T + Σ ∂T/∂value · departure at one sample, of each machine. */
static void sample_fill(const machines *m, size_t at)
{
    const hci_ripple_path *path = m->path;
    const size_t terms = hci_effects_terms(&m->uncertainty->effects.list), count = m->uncertainty->machines;
    hci_effects_torque(path->machine, &m->uncertainty->effects.list, &path->sample[at], m->by_value);
    for (size_t k = 0; k < count; ++k)
        m->value[k] = path->torque_Nm[at];
    for (size_t t = 0; t < terms; ++t) {
        const double by = m->by_value[t], *departure = m->uncertainty->departure + t * count;
        for (size_t k = 0; k < count && by != 0.0; ++k)
            m->value[k] += by * departure[k];
    }
    for (size_t k = 0; k < count; ++k)
        m->torque_Nm[k * path->count + at] = m->value[k];
}

/* ---- figures ---- */

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The value that a share of all exceeds: the k-th of n with k = (1 − share)(n + 1), rounded up. Sorts them.
 */
static double exceeded_by(double *value, size_t n, double share)
{
    const double place = ceil((1.0 - share) * (double)(n + 1) - 1e-9);
    qsort(value, n, sizeof *value, by_size);
    return value[(size_t)fmax(0.0, fmin((double)n, place) - 1.0)];
}

static double peak_to_peak_of(const machines *m, size_t k)
{
    return hci_peak_to_peak(m->torque_Nm + k * m->path->count, m->path->count);
}

/* Of the torque less that of the model. */
static double error_peak_to_peak_of(const machines *m, size_t k)
{
    const double *torque_Nm = m->torque_Nm + k * m->path->count;
    double low = INFINITY, high = -INFINITY;
    for (size_t j = 0; j < m->path->count; ++j) {
        low = fmin(low, torque_Nm[j] - m->path->torque_Nm[j]);
        high = fmax(high, torque_Nm[j] - m->path->torque_Nm[j]);
    }
    return high - low;
}

static void fill_peaks(const machines *m, hci_expected_ripple *e)
{
    const size_t n = m->uncertainty->machines, count = m->path->count;
    for (size_t k = 0; k < n; ++k)
        m->value[k] = error_peak_to_peak_of(m, k);
    e->error_peak_to_peak_Nm = exceeded_by(m->value, n, EXCEEDED);
    for (size_t k = 0; k < n; ++k)
        m->value[k] = peak_to_peak_of(m, k);
    e->peak_to_peak_Nm = exceeded_by(m->value, n, EXCEEDED);
    for (size_t k = 0; k < n; ++k)
        m->value[k] = 100.0 * peak_to_peak_of(m, k) / fabs(hci_mean(m->torque_Nm + k * count, count));
    const double percent = exceeded_by(m->value, n, EXCEEDED);
    if (!isfinite(percent)) return;
    e->T_ripple_percent = percent;
    e->middle_percent = exceeded_by(m->value, n, 0.5);
}

/* The mean torque, apart from the ripple. */
static void fill_mean(const machines *m, hci_expected_ripple *e)
{
    const size_t n = m->uncertainty->machines, count = m->path->count;
    if (m->path->turns == 0) return;
    const double mean_Nm = hci_mean(m->path->torque_Nm, count);
    for (size_t k = 0; k < n; ++k)
        m->value[k] = fabs(hci_mean(m->torque_Nm + k * count, count) - mean_Nm);
    e->mean_Nm = mean_Nm;
    e->mean_error_Nm = exceeded_by(m->value, n, EXCEEDED);
}

/* In place: torque less what is wanted, to peak amplitudes of orders k/turns. */
static void to_amplitudes(const machines *m, size_t k, double *work)
{
    const hci_ripple_path *path = m->path;
    double *x = m->torque_Nm + k * path->count;
    memset(work, 0, path->count * sizeof *work);
    for (size_t j = 0; path->wanted_Nm && j < path->count; ++j)
        x[j] -= path->wanted_Nm[j];
    hci_fft(x, work, path->count, -1);
    for (size_t j = 0; j < path->count; ++j)
        x[j] = 2.0 * hypot(x[j], work[j]) / (double)path->count;
}

/* The order whose amplitude, exceeded by the share, is the largest; the mean left out. Spoils the torques. */
static hci_status fill_worst(const machines *m, hci_expected_ripple *e, hci_note *note)
{
    const size_t n = m->uncertainty->machines, count = m->path->count;
    if (m->path->turns == 0) return HCI_OK;
    double *work = hci_memory_new(count, sizeof *work);
    if (!work) return hci_note_memory(note, NULL, "what to expect of the machine");
    for (size_t k = 0; k < n; ++k)
        to_amplitudes(m, k, work);
    hci_memory_free(work);
    e->worst_order_Nm = -1.0;
    for (size_t j = 1; j < count / 2; ++j) {
        for (size_t k = 0; k < n; ++k)
            m->value[k] = m->torque_Nm[k * count + j];
        const double amplitude_Nm = exceeded_by(m->value, n, EXCEEDED);
        if (!(amplitude_Nm > e->worst_order_Nm)) continue;
        e->worst_order_Nm = amplitude_Nm;
        e->worst_order = (double)j / (double)m->path->turns;
    }
    return HCI_OK;
}

/* ---- what was measured ---- */

static void range_add(hci_measured_range *range, double value)
{
    range->least = fmin(range->least, value);
    range->most = fmax(range->most, value);
}

static double size_of(hci_measured_range range)
{
    return fmax(fabs(range.least), fabs(range.most));
}

/* How far a value is outside of a range; 0 inside, and where it is rounding beside what was recorded. */
static double beyond(hci_measured_range range, double value, double size)
{
    const double distance = fmax(range.least - value, value - range.most);
    return distance > ROUNDING * size ? distance : 0.0;
}

static void fill_currents(const hci_ripple_path *path, const hci_uncertainty *u, hci_expected_ripple *e)
{
    const hci_measured_run all = hci_uncertainty_measured(u);
    const double most_A = fmax(size_of(all.id_A), size_of(all.iq_A));
    size_t outside = 0;
    e->measured_id_A = all.id_A;
    e->measured_iq_A = all.iq_A;
    e->measured_speed_rad_per_s = all.speed_rad_per_s;
    e->outside_A = 0.0;
    e->recordings = u->runs;
    for (size_t k = 0; k < path->count; ++k) {
        const double theta_rad = path->machine->pole_pairs * path->sample[k].theta_m_rad;
        const hci_dq i = hci_park(hci_clarke(path->sample[k].i_abc), theta_rad);
        const double distance_A = hypot(beyond(all.id_A, i.d, most_A), beyond(all.iq_A, i.q, most_A));
        range_add(&e->id_A, i.d);
        range_add(&e->iq_A, i.q);
        outside += distance_A > 0.0;
        e->outside_A = fmax(e->outside_A, distance_A);
    }
    e->outside_share = (double)outside / (double)path->count;
    e->speed_outside = beyond(all.speed_rad_per_s, path->speed_rad_per_s, size_of(all.speed_rad_per_s)) > 0.0;
}

#define CHECKED 0.5 /* of the largest current recorded: how far outside the bound has been checked */

/* The largest i_d or i_q that was recorded. */
static double largest_measured_A(const hci_expected_ripple *e)
{
    const double d = fmax(fabs(e->measured_id_A.least), fabs(e->measured_id_A.most));
    return fmax(d, fmax(fabs(e->measured_iq_A.least), fabs(e->measured_iq_A.most)));
}

bool hci_expected_ripple_is_far(const hci_expected_ripple *e)
{
    return e->outside_A > CHECKED * largest_measured_A(e);
}

/* ---- the mean ---- */

enum { SIDES = 72 }; /* of a polygon around what was recorded: its corners are 0.1 % too far out */

/* How far the currents of a run go along a direction of the plane of i_d and i_q. */
static double reach_A(const hci_measured_run *r, hci_dq way)
{
    return fmax(way.d * r->id_A.least, way.d * r->id_A.most) +
           fmax(way.q * r->iq_A.least, way.q * r->iq_A.most);
}

/* The largest distance of the currents from what lies between those of the runs, and none. Two runs are a
 * line there, and not all of the box around them. */
static double beyond_runs_A(const hci_ripple_path *path, const hci_uncertainty *u)
{
    double most_A = 0.0;
    for (int side = 0; side < SIDES; ++side) {
        const hci_dq way = {cos(2.0 * HCI_PI * side / SIDES), sin(2.0 * HCI_PI * side / SIDES), 0.0};
        double reached_A = 0.0;
        for (size_t r = 0; r < u->runs; ++r)
            reached_A = fmax(reached_A, reach_A(&u->run[r], way));
        for (size_t k = 0; k < path->count; ++k) {
            const double theta_rad = path->machine->pole_pairs * path->sample[k].theta_m_rad;
            const hci_dq i = hci_park(hci_clarke(path->sample[k].i_abc), theta_rad);
            most_A = fmax(most_A, way.d * i.d + way.q * i.q - reached_A);
        }
    }
    return most_A;
}

#define LITTLE 0.2 /* of the largest current recorded: so far outside the mean torque is still bounded */

/* What the recordings bound is the mean torque of currents that they had: of others the torque per ampere is
 * that of the data sheet, and saturation makes it less. */
static void bound_mean(const hci_ripple_path *path, const hci_uncertainty *u, hci_expected_ripple *e)
{
    if (beyond_runs_A(path, u) > LITTLE * largest_measured_A(e)) e->mean_error_Nm = NAN;
}

/* ---- all of it ---- */

static hci_expected_ripple nothing(hci_ripple_state state)
{
    const hci_measured_range none = {NAN, NAN};
    return (hci_expected_ripple){state,
                                 NAN,
                                 NAN,
                                 NAN,
                                 NAN,
                                 NAN,
                                 NAN,
                                 none,
                                 none,
                                 none,
                                 none,
                                 none,
                                 NAN,
                                 NAN,
                                 false,
                                 0,
                                 {"", "", NAN, false, 0.0, 0.0, 0.0, 0.0},
                                 NAN,
                                 NAN,
                                 NAN,
                                 NAN,
                                 0.0,
                                 0.0,
                                 0.0,
                                 0.0,
                                 false};
}

static double largest_torque_Nm(const hci_ripple_path *path)
{
    double most_Nm = 0.0;
    for (size_t k = 0; k < path->count; ++k)
        most_Nm = fmax(most_Nm, fabs(path->torque_Nm[k]));
    return most_Nm;
}

/* The first but one that three phases make: a bound from recordings that end below it leaves most out. */
#define LEAST_ORDER 12.0

static bool ends_low(const hci_uncertainty *u)
{
    const hci_effects *list = &u->effects.list;
    double top = 0.0;
    for (size_t k = 0; k < list->count; ++k)
        for (size_t n = 0; n < list->effect[k].count; ++n)
            top = fmax(top, list->effect[k].term[n].order);
    return top < LEAST_ORDER - 1.0; /* a back-EMF of order 11 makes order 12 */
}

static hci_status find(const hci_ripple_path *path, const hci_uncertainty *u, hci_expected_ripple *expected,
                       hci_note *note)
{
    machines m;
    *expected = nothing(HCI_RIPPLE_NO_RECORDINGS);
    if (!u || u->machines == 0 || path->count == 0) return HCI_OK;
    expected->state = HCI_RIPPLE_OTHER_EFFECTS;
    if (!hci_uncertainty_is_of(u, path->effects)) return HCI_OK;
    expected->state = HCI_RIPPLE_UNTOLD;
    if (ends_low(u)) return HCI_OK;
    expected->state = HCI_RIPPLE_KNOWN;
    fill_currents(path, u, expected);
    if (u->runs < HCI_RIPPLE_LEAST_RECORDINGS && hci_expected_ripple_is_far(expected)) {
        *expected = nothing(HCI_RIPPLE_TOO_FAR);
        return HCI_OK;
    }
    hci_status status = machines_make(path, u, &m, note);
    for (size_t k = 0; k < path->count && !status; ++k)
        sample_fill(&m, k);
    if (!status) {
        fill_peaks(&m, expected);
        fill_mean(&m, expected);
        bound_mean(path, u, expected);
        status = fill_worst(&m, expected, note);
    }
    hci_memory_free(m.torque_Nm);
    if (!status && !(expected->error_peak_to_peak_Nm > ROUNDING * largest_torque_Nm(path)))
        *expected = nothing(HCI_RIPPLE_UNTOLD);
    return status;
}

/* ---- what nobody would believe ---- */

#define RECTANGLES                                                                                           \
    2.0 /* times the order that a wave of constant size has, from which on nobody believes it */

static double fundamental_of(const hci_ripple_path *path)
{
    double sine = 0.0, cosine = 0.0;
    for (size_t k = 0; k < path->machine->back_emf_count; ++k) {
        const hci_wave *w = &path->machine->back_emf[k];
        if (w->sequence == 1 && fabs(w->order - 1.0) < HCI_ORDER_TOLERANCE)
            sine += w->sine, cosine += w->cosine;
    }
    return hypot(sine, cosine);
}

static bool is_back_emf(const hci_effect_type *type)
{
    return strcmp(type->parameter[0].unit, "Nm_per_A") == 0;
}

/* Amplitude of an order of the back-EMF that an effect adds. */
static double added_of(const hci_effect *effect, double order)
{
    double square = 0.0;
    for (size_t j = 0; j < effect->count; ++j)
        if (fabs(effect->term[j].order - order) < HCI_ORDER_TOLERANCE)
            square += effect->term[j].value * effect->term[j].value;
    return sqrt(square);
}

/* A wave of constant size, as of magnets of one strength under full-pitch coils, has 1/n of its fundamental
 * at order n. */
static void fill_unbelievable(const hci_ripple_path *path, hci_expected_ripple *e)
{
    const double fundamental = fundamental_of(path);
    double most = 1.0;
    for (size_t k = 0; path->effects && k < path->effects->count; ++k) {
        const hci_effect *effect = &path->effects->effect[k];
        for (size_t j = 0; is_back_emf(effect->type) && j < effect->count; ++j) {
            const double order = effect->term[j].order, share = added_of(effect, order) / fundamental;
            const double beyond = order > 1.5 ? share * order / RECTANGLES : 0.0;
            if (!(beyond > most)) continue;
            most = beyond;
            e->unbelievable_order = order;
            e->unbelievable_share = share;
        }
    }
}

/* The largest amplitude of one order in a wave of that size, peak to peak: of a square wave. */
#define OF_SQUARE (2.0 / HCI_PI)

static void add(hci_expected_ripple *e, double more_Nm, double mean_Nm)
{
    const double percent = 100.0 * more_Nm / fabs(mean_Nm);
    e->peak_to_peak_Nm += more_Nm;
    e->error_peak_to_peak_Nm += more_Nm;
    e->worst_order_Nm += OF_SQUARE * more_Nm;
    e->T_ripple_percent += percent; /* NAN where there is no mean */
    e->middle_percent += percent;
}

/* What no machine that the recordings allow has: an order that may be of the current sensors, which is there
 * or not, and what the model leaves of the recordings, which is the least that its error may be. */
static void add_untold(const hci_ripple_path *path, const hci_machine_origin *origin, hci_expected_ripple *e)
{
    const double left_Nm = fmax(0.0, origin->left_Nm - e->error_peak_to_peak_Nm);
    const double more_Nm = 2.0 * origin->sensor_zero_Nm + left_Nm;
    if (!(more_Nm > 0.0)) return;
    e->left_peak_to_peak_Nm = left_Nm;
    if (origin->sensor_zero_Nm > e->worst_order_Nm) e->worst_order = 1.0;
    add(e, more_Nm, hci_mean(path->torque_Nm, path->count));
}

void hci_expected_ripple_add_table(hci_expected_ripple *e, double table_Nm, double mean_Nm)
{
    e->table_peak_to_peak_Nm += table_Nm;
    add(e, table_Nm, mean_Nm);
}

void hci_expected_ripple_add_loop(hci_expected_ripple *e, double loop_Nm, double mean_Nm)
{
    e->loop_peak_to_peak_Nm += loop_Nm;
    add(e, loop_Nm, mean_Nm);
}

void hci_expected_ripple_add_angle(hci_expected_ripple *e, double angle_Nm, double mean_Nm)
{
    e->angle_peak_to_peak_Nm += angle_Nm;
    add(e, angle_Nm, mean_Nm);
}

bool hci_expected_ripple_is_doubtful(const hci_expected_ripple *e)
{
    return hci_machine_origin_is_doubtful(&e->origin) || isfinite(e->unbelievable_order);
}

hci_status hci_expected_ripple_find(const hci_ripple_path *path, const hci_uncertainty *u,
                                    hci_expected_ripple *expected, hci_note *note)
{
    const hci_status status = find(path, u, expected, note);
    if (status) return status;
    if (expected->state == HCI_RIPPLE_KNOWN && u->origin.turning_load_Nm > 0.0)
        *expected = nothing(HCI_RIPPLE_SWAYED);
    if (expected->state == HCI_RIPPLE_KNOWN) add_untold(path, &u->origin, expected);
    if (u) expected->origin = u->origin;
    if (expected->origin.constant_is_declared) expected->mean_error_Nm = NAN; /* as good as the sheet */
    fill_unbelievable(path, expected);
    if (expected->state == HCI_RIPPLE_NO_RECORDINGS && hci_machine_origin_is_doubtful(&expected->origin))
        expected->state = HCI_RIPPLE_UNEXPLAINED;
    return HCI_OK;
}
