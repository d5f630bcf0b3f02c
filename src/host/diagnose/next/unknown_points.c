#include "host/diagnose/next/unknown_points.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "hci/math/dense.h"
#include "host/base/memory.h"
#include "host/diagnose/candidates/empirical_term.h"
#include "host/diagnose/next/tell_apart.h"
#include "host/diagnose/next/trial_run.h"

/* ---- one order in each recording ---- */

/* Amplitudes of one order in a run, with the weight of each in χ². */
typedef struct {
    double sine_Nm, cosine_Nm, weight;
    double current_A, speed_rad_per_s;
} amplitude;

/* Whether a run tells at which angle a torque is; all tell a mean. */
static bool has_angle(const hci_run *run)
{
    return !run->only_mean && !run->zero_is_unknown;
}

/* By order 0 the mean is in the cosine. */
static amplitude amplitude_of(const hci_regression *e, size_t run, const double *residual_Nm, double order)
{
    const hci_run_statistics *f = &e->samples->statistics[run];
    amplitude a = {0.0, 0.0, 0.0, f->current_A, f->mean_speed_rad_per_s};
    double count = 0.0, noise = 0.0;
    for (const hci_segment *s = NULL; (s = hci_segment_next(e->samples, run, s)) != NULL;) {
        const double rms = hci_regression_noise(e, s)->rms;
        for (size_t j = s->first; j < s->first + s->count; ++j) {
            const double x = order * e->machine->pole_pairs * e->samples->sample[j].reading.theta_m_rad;
            a.sine_Nm += residual_Nm[j] * sin(x);
            a.cosine_Nm += residual_Nm[j] * cos(x);
            noise += rms * rms;
            count += 1.0;
        }
    }
    const double scale = count > 0.0 ? (order > 0.0 ? 2.0 : 1.0) / count : 0.0;
    a.sine_Nm *= scale;
    a.cosine_Nm *= scale;
    if (noise > 0.0) a.weight = count / (scale * noise);
    return a;
}

/* ---- laws of growth that describe it ---- */

/* (S, C) of each law, and how far it is to be believed; the latter sum to 1. */
typedef struct {
    double sine_Nm[HCI_GROWTH_LAWS], cosine_Nm[HCI_GROWTH_LAWS], belief[HCI_GROWTH_LAWS];
} growth;

/* Least squares. Returns χ². */
static double law_fit(const amplitude *a, size_t runs, size_t g, double *sine_Nm, double *cosine_Nm)
{
    double s = 0.0, c = 0.0, weight = 0.0, square = 0.0;
    for (size_t r = 0; r < runs; ++r) {
        const double by = hci_growth_law_at(g, a[r].current_A, a[r].speed_rad_per_s);
        s += a[r].weight * by * a[r].sine_Nm;
        c += a[r].weight * by * a[r].cosine_Nm;
        weight += a[r].weight * by * by;
    }
    *sine_Nm = weight > 0.0 ? s / weight : 0.0;
    *cosine_Nm = weight > 0.0 ? c / weight : 0.0;
    for (size_t r = 0; r < runs; ++r) {
        const double by = hci_growth_law_at(g, a[r].current_A, a[r].speed_rad_per_s);
        const double x = a[r].sine_Nm - by * *sine_Nm, y = a[r].cosine_Nm - by * *cosine_Nm;
        square += a[r].weight * (x * x + y * y);
    }
    return square;
}

/* The best law is an approximation too: what it leaves is how exactly a law is known to hold. */
static void laws_weigh(const amplitude *a, size_t runs, growth *laws)
{
    double square[HCI_GROWTH_LAWS], best = INFINITY, sum = 0.0;
    for (size_t g = 0; g < HCI_GROWTH_LAWS; ++g) {
        square[g] = law_fit(a, runs, g, &laws->sine_Nm[g], &laws->cosine_Nm[g]);
        best = fmin(best, square[g]);
    }
    const double scale = fmax(1.0, best / fmax(1.0, 2.0 * (double)runs - 2.0));
    for (size_t g = 0; g < HCI_GROWTH_LAWS; ++g)
        sum += laws->belief[g] = exp(-0.5 * (square[g] - best) / scale);
    for (size_t g = 0; g < HCI_GROWTH_LAWS; ++g)
        laws->belief[g] /= sum;
}

/* ---- where they differ ---- */

/* Departures of the laws from their mean at each point, √χ²: [point][order][law][2]. */
typedef struct {
    double *departure;
    size_t orders, length; /* of a point */
} spread;

static double scalar_product(const double *x, const double *y, size_t n)
{
    double sum = 0.0;
    for (size_t k = 0; k < n; ++k)
        sum += x[k] * y[k];
    return sum;
}

static void departures_fill(const growth *laws, const hci_operating_point *at, double unit, double *x)
{
    const double current_A = hypot(at->id_A, isfinite(at->iq_A) ? at->iq_A : 0.0);
    double mean[2] = {0.0, 0.0};
    for (size_t g = 0; g < HCI_GROWTH_LAWS; ++g) {
        const double by = hci_growth_law_at(g, current_A, at->speed_rad_per_s);
        x[2 * g] = by * laws->sine_Nm[g];
        x[2 * g + 1] = by * laws->cosine_Nm[g];
        for (size_t j = 0; j < 2; ++j)
            mean[j] += laws->belief[g] * x[2 * g + j];
    }
    for (size_t g = 0; g < HCI_GROWTH_LAWS; ++g)
        for (size_t j = 0; j < 2; ++j)
            x[2 * g + j] = unit * sqrt(laws->belief[g]) * (x[2 * g + j] - mean[j]);
}

/* χ² of one unit of amplitude in HCI_LEAST_TURNS turns. */
static double square_per_Nm2(const hci_regression *e, const hci_playable *x, double order)
{
    const double samples = HCI_LEAST_TURNS * (double)hci_trial_run_samples(e->machine->pole_pairs);
    return samples / (x->noise_Nm * x->noise_Nm) * (order > 0.0 ? 0.5 : 1.0);
}

static hci_status spread_fill(const hci_regression *e, const hci_open_orders *open,
                              const hci_playable *playable, const hci_point_choice *choice, spread *s,
                              hci_note *note)
{
    const double *order = open->order;
    const size_t runs = e->samples->run_count, part = 2 * HCI_GROWTH_LAWS;
    amplitude *a = hci_memory_new(runs + 1, sizeof *a);
    growth laws;
    if (!a) return hci_note_memory(note, NULL, "what to measure next");
    for (size_t n = 0; n < s->orders; ++n) {
        size_t used = 0;
        for (size_t r = 0; r < runs; ++r)
            if (e->use[r] && hci_segment_next(e->samples, r, NULL) &&
                (order[n] == 0.0 || has_angle(&e->runs[r])))
                a[used++] = amplitude_of(e, r, open->residual_Nm, order[n]);
        laws_weigh(a, used, &laws);
        const double unit = sqrt(square_per_Nm2(e, playable, order[n]));
        for (size_t k = 0; k < choice->count; ++k)
            departures_fill(&laws, &choice->point[k], unit, s->departure + k * s->length + n * part);
    }
    hci_memory_free(a);
    return HCI_OK;
}

/* ---- the choice ---- */

static size_t largest(const spread *s, size_t count, double *square)
{
    size_t best = 0;
    *square = -1.0;
    for (size_t k = 0; k < count; ++k) {
        const double *x = s->departure + k * s->length, x2 = scalar_product(x, x, s->length);
        if (x2 > *square * (1.0 + 1e-9)) {
            best = k;
            *square = x2;
        }
    }
    return best;
}

/* What is left open once a point has been recorded, with noise of 1. */
static void known_take(spread *s, size_t count, size_t known)
{
    const double *x = s->departure + known * s->length, whole = scalar_product(x, x, s->length) + 1.0;
    for (size_t k = 0; k < count; ++k) {
        double *y = s->departure + k * s->length;
        const double share = scalar_product(x, y, s->length) / whole;
        for (size_t j = 0; j < s->length && k != known; ++j)
            y[j] -= share * x[j];
    }
    memset(s->departure + known * s->length, 0, s->length * sizeof *s->departure);
}

static void worst_order(const spread *s, const hci_regression *e, const hci_playable *playable,
                        const double *order, hci_telling_point *t)
{
    const size_t part = 2 * HCI_GROWTH_LAWS;
    for (size_t n = 0; n < s->orders; ++n) {
        const double *x = s->departure + t->point * s->length + n * part;
        const double spread_Nm = sqrt(scalar_product(x, x, part) / square_per_Nm2(e, playable, order[n]));
        if (n > 0 && spread_Nm <= t->spread_Nm) continue;
        t->order = order[n];
        t->spread_Nm = spread_Nm;
    }
}

hci_status hci_points_of_growth(const hci_regression *e, const hci_open_orders *open,
                                const hci_playable *playable, const hci_point_choice *choice, size_t *found,
                                hci_note *note)
{
    spread s = {NULL, open->orders, open->orders * 2 * HCI_GROWTH_LAWS};
    *found = 0;
    if (!(playable->noise_Nm > 0.0)) return HCI_OK;
    s.departure = hci_memory_new(choice->count * s.length + 1, sizeof *s.departure);
    if (!s.departure) return hci_note_memory(note, NULL, "what to measure next");
    const hci_status status = spread_fill(e, open, playable, choice, &s, note);
    while (!status && *found < choice->most) {
        hci_telling_point t = {0, 0.0, NAN, 0.0};
        t.point = largest(&s, choice->count, &t.chi_square);
        if (!(t.chi_square > HCI_NOTHING)) break;
        worst_order(&s, e, playable, open->order, &t);
        choice->chosen[(*found)++] = t;
        known_take(&s, choice->count, t.point);
    }
    hci_memory_free(s.departure);
    return status;
}

/* ---- far from what was recorded ---- */

/* Currents as a share of the largest, the logarithm of the speed as a share of its range, and the direction.
 */
typedef struct {
    double x[4];
} place;

static place place_of(const hci_playable *p, double id_A, double iq_A, double speed_rad_per_s, double way)
{
    const double unit_A = p->most_A > 0.0 ? p->most_A : 1.0;
    const double range = log(p->most_rad_per_s / p->least_rad_per_s);
    const double speed = fmax(p->least_rad_per_s, fabs(speed_rad_per_s)) / p->least_rad_per_s;
    return (place){{id_A / unit_A, iq_A / unit_A, range > 0.0 ? log(speed) / range : 0.0, way}};
}

static double distance(const place *a, const place *b)
{
    double sum = 0.0;
    for (int j = 0; j < 4; ++j)
        sum += (a->x[j] - b->x[j]) * (a->x[j] - b->x[j]);
    return sqrt(sum);
}

static double sign_of(double x)
{
    return (x > 0.0) - (x < 0.0);
}

/* How far points are from the nearest run; one that stands, or turns both ways, is in any direction. */
static void nearest_runs(const hci_regression *e, const hci_playable *p, const place *at, size_t count,
                         double *nearest)
{
    for (size_t k = 0; k < count; ++k)
        nearest[k] = INFINITY;
    for (size_t r = 0; r < e->samples->run_count; ++r) {
        const hci_run_statistics *f = &e->samples->statistics[r];
        if (!hci_segment_next(e->samples, r, NULL)) continue;
        const bool stands = f->both_ways || fabs(f->mean_speed_rad_per_s) < 0.5 * p->least_rad_per_s;
        place run = place_of(p, f->mean_id_A, f->no_current ? 0.0 : f->mean_iq_A, hci_run_speed(e, r),
                             sign_of(f->mean_speed_rad_per_s));
        for (size_t k = 0; k < count; ++k) {
            if (stands) run.x[3] = at[k].x[3];
            nearest[k] = fmin(nearest[k], distance(&at[k], &run));
        }
    }
}

static place place_at(const hci_playable *p, const hci_operating_point *x)
{
    return place_of(p, x->id_A, isfinite(x->iq_A) ? x->iq_A : 0.0, x->speed_rad_per_s,
                    sign_of(x->speed_rad_per_s));
}

/* The one whose distance is the largest; count where all are 0. */
static size_t furthest_of(const double *distance_of, size_t count)
{
    double furthest = 0.0;
    size_t best = count;
    for (size_t k = 0; k < count; ++k) {
        if (distance_of[k] <= furthest * (1.0 + 1e-9)) continue;
        furthest = distance_of[k];
        best = k;
    }
    return best;
}

size_t hci_points_not_recorded(const hci_regression *e, const hci_playable *p, const hci_point_choice *c)
{
    place at[HCI_OPERATING_POINTS];
    double nearest[HCI_OPERATING_POINTS]; /* from a run, or a point that was chosen */
    size_t found = 0;
    assert(c->count <= HCI_OPERATING_POINTS);
    for (size_t k = 0; k < c->count; ++k)
        at[k] = place_at(p, &c->point[k]);
    nearest_runs(e, p, at, c->count, nearest);
    for (size_t best; found < c->most && (best = furthest_of(nearest, c->count)) < c->count; ++found) {
        c->chosen[found] = (hci_telling_point){best, NAN, NAN, NAN};
        for (size_t k = 0; k < c->count; ++k)
            nearest[k] = fmin(nearest[k], distance(&at[k], &at[best]));
    }
    return found;
}
