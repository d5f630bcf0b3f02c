#include "host/diagnose/advise.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/math/dense.h"
#include "host/base/memory.h"
#include "host/diagnose/fit/linearise.h"
#include "host/diagnose/fit/model.h"
#include "host/diagnose/fit/predicted_reading.h"
#include "host/numeric/normal_equations.h"
#include "host/recording/rotor_frame.h"

enum { SAMPLES_PER_PERIOD = 96, MOST_SAMPLES = 1024, POINTS = 64 };

/* In units of χ². */
#define DECISIVE 20.0
#define NOTHING  4.0 /* less would be chance */

#define REGULAR             1e-9 /* share of a diagonal that is added to it, so that rounding makes no pivot negative */
#define ANY_SPEED_RAD_PER_S 10.0 /* where the recordings have none */

/* A steady run. */
typedef struct {
    double current_A, angle_rad, speed_rad_per_s; /* angle: of the current ahead of the q axis */
} operating_point;

typedef struct {
    double most_A, least_speed, most_speed, noise_Nm, temperature_C;
} range;

static double mean_noise_Nm(const hci_regression *e)
{
    double sum = 0.0, count = 0.0;
    for (const hci_segment *s = NULL; (s = hci_regression_next(e, s)) != NULL; count += 1.0)
        sum += hci_regression_noise(e, s)->rms;
    return sum / fmax(1.0, count);
}

static range range_of(const hci_regression *e)
{
    range x = {0.0, INFINITY, 0.0, mean_noise_Nm(e), NAN};
    for (size_t r = 0; r < e->samples->run_count; ++r) {
        const hci_run_statistics *f = &e->samples->statistics[r];
        const double speed = fabs(f->mean_speed_rad_per_s);
        x.most_A = fmax(x.most_A, f->current_A);
        if (speed > 0.0) x.least_speed = fmin(x.least_speed, speed);
        x.most_speed = fmax(x.most_speed, speed);
        if (isfinite(f->temperature_C)) x.temperature_C = f->temperature_C;
    }
    if (!isfinite(x.least_speed)) x.least_speed = x.most_speed = ANY_SPEED_RAD_PER_S;
    if (x.most_speed < 2.0 * x.least_speed) x.most_speed = 4.0 * x.least_speed;
    return x;
}

/* One turn, as a dataset would read it with the sensors of `right`: the reading itself is where both are
 * compared. */
static void turn_fill(const operating_point *at, int pole_pairs, double temperature_C,
                      hci_binned_sample *sample, size_t n)
{
    const double turn = at->speed_rad_per_s < 0.0 ? -2.0 * HCI_PI : 2.0 * HCI_PI;
    for (size_t k = 0; k < n; ++k) {
        hci_sample *x = &sample[k].reading;
        memset(&sample[k], 0, sizeof sample[k]);
        x->theta_m_rad = turn * (double)k / (double)n;
        x->speed_rad_per_s = at->speed_rad_per_s;
        x->temperature_C = temperature_C;
        const hci_dq i = {-at->current_A * sin(at->angle_rad), at->current_A * cos(at->angle_rad), 0.0};
        hci_phases_of_dq(i, pole_pairs * x->theta_m_rad, x->i_abc);
        sample[k].time_s = fabs(x->theta_m_rad / at->speed_rad_per_s);
        sample[k].sum_A = NAN;
        sample[k].count = 1.0;
        sample[k].raw = *x;
    }
}

/* A dataset of one run. */
typedef struct {
    hci_binned_sample *sample;
    hci_segment segment;
    hci_run_statistics statistics;
    hci_run run;
    hci_binned_samples samples;
    hci_noise noise;
    double sum_deviation_A;
    bool use;
    hci_regression regression;
} trial_dataset;

static bool dataset_make(const hci_regression *e, double noise_Nm, trial_dataset *b)
{
    const size_t wanted = (size_t)(SAMPLES_PER_PERIOD * e->machine->pole_pairs);
    const size_t n = wanted < MOST_SAMPLES ? wanted : MOST_SAMPLES;
    memset(b, 0, sizeof *b);
    b->sample = hci_memory_new(n, sizeof *b->sample);
    b->segment = (hci_segment){0, 0, n, 1, 1.0, true, true};
    b->run.torque_source = HCI_TORQUE_MEASURED;
    b->run.turn_known = true;
    b->samples = (hci_binned_samples){b->sample, n, &b->segment, 1, &b->statistics, 1};
    b->noise = hci_noise_white(noise_Nm);
    b->sum_deviation_A = NAN;
    b->use = true;
    b->regression = (hci_regression){e->machine, e->declared, &b->samples,         &b->run, &b->use,
                                     false,      &b->noise,   &b->sum_deviation_A, NULL,    NULL};
    return b->sample != NULL;
}

/* What is left of |right − wrong|² after a fit of wrong to it with the prior information `known` on its
 * parameters.
 */
static double remaining(const hci_normal_equations *difference, const hci_normal_equations *known,
                        double *work)
{
    const size_t n = known->n;
    double *step = work + n * n, fall = 0.0;
    for (size_t j = 0; j < n; ++j)
        for (size_t i = 0; i < n; ++i)
            work[i + j * n] = known->gram[i + j * n] + difference->gram[i + j * n] +
                              (i == j ? REGULAR * known->gram[i + j * n] + 1e-300 : 0.0);
    if (hci_cholesky_factor(n, work)) return 0.0;
    memcpy(step, difference->moment, n * sizeof *step);
    hci_cholesky_solve(n, work, step);
    for (size_t k = 0; k < n; ++k)
        fall += step[k] * difference->moment[k];
    return difference->square - fall;
}

/* What the points are compared with. */
typedef struct {
    const hci_candidates *wrong;
    hci_model right;
    hci_normal_equations known; /* the recordings' normal equations in the parameters of `wrong` */
    range range;
    trial_dataset dataset;
    double *residual_Nm, *work; /* [samples], [n² + n] */
} comparison;

static hci_status point_score(comparison *c, const operating_point *at, double *score, hci_note *note)
{
    hci_normal_equations difference;
    trial_dataset *b = &c->dataset;
    turn_fill(at, b->regression.machine->pole_pairs, c->range.temperature_C, b->sample, b->samples.count);
    b->segment.period_s = 2.0 * HCI_PI / fabs(at->speed_rad_per_s);
    hci_status status = hci_regression_residual(&b->regression, &c->right.list, c->residual_Nm, note);
    for (size_t k = 0; k < b->samples.count && !status; ++k)
        b->sample[k].torque_Nm = -c->residual_Nm[k];
    if (!status) status = hci_regression_normal(&b->regression, c->wrong, false, &difference, note);
    if (status) return status;
    *score = remaining(&difference, &c->known, c->work);
    hci_normal_equations_release(&difference);
    return HCI_OK;
}

/* From the least effort to the largest: current, then speed, then angle and direction. */
static operating_point point_at(const range *r, int k)
{
    static const double CURRENT[] = {0.0, 0.25, 0.5, 1.0}, ANGLE[] = {0.0, 0.6, -0.6, 3.14159265358979};
    const int direction = k % 2, angle = k / 2 % 4, speed = k / 8 % 2, current = k / 16;
    const operating_point p = {CURRENT[current] * r->most_A, ANGLE[angle],
                               (direction ? -1.0 : 1.0) * (speed ? r->most_speed : r->least_speed)};
    return p;
}

static void words(const operating_point *p, double score, const char *right, const char *wrong, char *text,
                  size_t size)
{
    if (score < NOTHING) {
        snprintf(text, size,
                 "no steady run within these currents and speeds tells %s from %s; it takes another kind of "
                 "measurement",
                 right, wrong);
        return;
    }
    snprintf(text, size,
             "%s or %s: one turn at %.3g A, current angle %.2g rad%s, %.3g rad/s (mechanical) would tell "
             "them apart "
             "(χ² %.3g%s)",
             right, wrong, p->current_A, fabs(p->angle_rad) > 3.0 ? 0.0 : p->angle_rad,
             fabs(p->angle_rad) > 3.0 ? " braking" : "", p->speed_rad_per_s, score,
             score < DECISIVE ? ", so several turns" : "");
}

/* The first point that is decisive, or the best one. */
static hci_status point_find(comparison *c, operating_point *best, double *most, hci_note *note)
{
    hci_status status = HCI_OK;
    *best = (operating_point){0.0, 0.0, 0.0};
    *most = 0.0;
    for (int k = 0; k < POINTS && *most < DECISIVE && !status; ++k) {
        const operating_point p = point_at(&c->range, k);
        double score = 0.0;
        status = point_score(c, &p, &score, note);
        if (score > *most) {
            *most = score;
            *best = p;
        }
    }
    return status;
}

static hci_status comparison_make(const hci_regression *e, const hci_advice_request *request, comparison *c,
                                  hci_note *note)
{
    memset(c, 0, sizeof *c);
    c->wrong = request->wrong;
    c->range = range_of(e);
    hci_status status = hci_model_make(e->declared, request->right, false, &c->right, note);
    if (!status) status = hci_regression_normal(e, request->wrong, false, &c->known, note);
    if (status) return status;
    const size_t n = c->known.n;
    if (dataset_make(e, c->range.noise_Nm, &c->dataset))
        c->work = hci_memory_new(n * n + n + c->dataset.samples.count + 1, sizeof *c->work);
    if (!c->work) return hci_note_memory(note, NULL, "the advice");
    c->residual_Nm = c->work + n * n + n;
    return HCI_OK;
}

static void comparison_release(comparison *c)
{
    hci_memory_free(c->dataset.sample);
    hci_memory_free(c->work);
    hci_model_release(&c->right);
    hci_normal_equations_release(&c->known);
}

hci_status hci_advise(const hci_regression *regression, const hci_advice_request *request, char *text,
                      size_t size, hci_note *note)
{
    comparison c;
    operating_point best;
    double most;
    hci_status status = comparison_make(regression, request, &c, note);
    if (!status) status = point_find(&c, &best, &most, note);
    if (!status) words(&best, most, request->right_name, request->wrong_name, text, size);
    comparison_release(&c);
    return status;
}
