#include "advise.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/dense.h"
#include "hci/frames.h"
#include "memory.h"

enum { SAMPLES_PER_PERIOD = 96, MOST_SAMPLES = 1024 };

#define DECISIVE 20.0 /* χ² */

/* A steady run. */
typedef struct {
    double current_A, angle_rad, speed_rad_per_s; /* angle: of the current ahead of the q axis */
} operating_point;

typedef struct {
    double most_A, least_speed, most_speed, noise_Nm, temperature_C;
} range;

static range range_of(const hci_evidence *e)
{
    range x = {0.0, INFINITY, 0.0, 0.0, NAN};
    double count = 0.0;
    for (size_t r = 0; r < e->cells->run_count; ++r) {
        const hci_run_figures *f = &e->cells->figures[r];
        const double speed = fabs(f->mean_speed_rad_per_s);
        x.most_A = fmax(x.most_A, f->current_A);
        if (speed > 0.0) x.least_speed = fmin(x.least_speed, speed);
        x.most_speed = fmax(x.most_speed, speed);
        if (isfinite(f->temperature_C)) x.temperature_C = f->temperature_C;
    }
    for (size_t k = 0; k < e->cells->stretch_count; ++k) {
        if (!e->use[e->cells->stretch[k].run]) continue;
        x.noise_Nm += e->noise[k].rms;
        count += 1.0;
    }
    x.noise_Nm /= fmax(1.0, count);
    if (!isfinite(x.least_speed)) x.least_speed = x.most_speed = 10.0;
    if (x.most_speed < 2.0 * x.least_speed) x.most_speed = 4.0 * x.least_speed;
    return x;
}

/* One turn, as a bench would read it with the sensors of `right`: the reading itself is where both are
 * compared. */
static void turn_fill(const operating_point *at, int pole_pairs, double temperature_C, hci_cell *cell,
                      size_t n)
{
    const double turn = at->speed_rad_per_s < 0.0 ? -2.0 * HCI_PI : 2.0 * HCI_PI;
    for (size_t k = 0; k < n; ++k) {
        hci_sample *x = &cell[k].reading;
        memset(&cell[k], 0, sizeof cell[k]);
        x->theta_m_rad = turn * (double)k / (double)n;
        x->speed_rad_per_s = at->speed_rad_per_s;
        x->temperature_C = temperature_C;
        const hci_dq i = {-at->current_A * sin(at->angle_rad), at->current_A * cos(at->angle_rad), 0.0};
        hci_clarke_inverse(hci_park_inverse(i, pole_pairs * x->theta_m_rad), x->i_abc);
        cell[k].time_s = fabs(x->theta_m_rad / at->speed_rad_per_s);
        cell[k].sum_A = NAN;
        cell[k].count = 1.0;
        cell[k].raw = *x;
    }
}

/* A bench of one run. */
typedef struct {
    hci_cell *cell;
    hci_stretch stretch;
    hci_run_figures figures;
    hci_run run;
    hci_cells cells;
    hci_noise noise;
    double sum_deviation_A;
    bool use;
    hci_evidence evidence;
} trial_bench;

static bool bench_make(const hci_evidence *e, double noise_Nm, trial_bench *b)
{
    const size_t wanted = (size_t)(SAMPLES_PER_PERIOD * e->machine->pole_pairs);
    const size_t n = wanted < MOST_SAMPLES ? wanted : MOST_SAMPLES;
    memset(b, 0, sizeof *b);
    b->cell = hci_memory_new(n, sizeof *b->cell);
    b->stretch = (hci_stretch){0, 0, n, 1, 1.0, true};
    b->run.torque_source = HCI_TORQUE_MEASURED;
    b->run.turn_known = true;
    b->cells = (hci_cells){b->cell, n, &b->stretch, 1, &b->figures, 1};
    b->noise = hci_noise_white(noise_Nm);
    b->sum_deviation_A = NAN;
    b->use = true;
    b->evidence = (hci_evidence){e->machine, e->declared, &b->cells, &b->run,
                                 &b->use,    false,       &b->noise, &b->sum_deviation_A};
    return b->cell != NULL;
}

/* What is left of |right − wrong|² after a fit of wrong to it with the knowledge `known` of its parameters.
 */
static double remaining(const hci_normal *difference, const hci_normal *known, double *work)
{
    const size_t n = known->n;
    double *step = work + n * n, fall = 0.0;
    for (size_t j = 0; j < n; ++j)
        for (size_t i = 0; i < n; ++i)
            work[i + j * n] = known->gram[i + j * n] + difference->gram[i + j * n] +
                              (i == j ? 1e-9 * known->gram[i + j * n] + 1e-300 : 0.0);
    if (hci_cholesky_factor(n, work)) return 0.0;
    memcpy(step, difference->moment, n * sizeof *step);
    hci_cholesky_solve(n, work, step);
    for (size_t k = 0; k < n; ++k)
        fall += step[k] * difference->moment[k];
    return difference->square - fall;
}

static hci_status point_score(const hci_evidence *e, trial_bench *b, const operating_point *at,
                              double temperature_C, const hci_effects *right, const hci_suspects *wrong,
                              const hci_normal *known, double *residual, double *work, double *score,
                              hci_note *note)
{
    hci_normal difference;
    hci_status status;
    turn_fill(at, e->machine->pole_pairs, temperature_C, b->cell, b->cells.count);
    b->stretch.period_s = 2.0 * HCI_PI / fabs(at->speed_rad_per_s);
    status = hci_evidence_residual(&b->evidence, right, residual, note);
    for (size_t k = 0; k < b->cells.count && !status; ++k)
        b->cell[k].torque_Nm = -residual[k];
    if (!status) status = hci_evidence_normal(&b->evidence, wrong, false, &difference, note);
    if (status) return status;
    *score = remaining(&difference, known, work);
    hci_normal_release(&difference);
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

enum { POINTS = 64 };

static void words(const operating_point *p, double score, const char *right, const char *wrong, char *text,
                  size_t size)
{
    if (score < 4.0) {
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

hci_status hci_advise(const hci_evidence *evidence, const hci_suspects *right, const hci_suspects *wrong,
                      const char *right_name, const char *wrong_name, char *text, size_t size, hci_note *note)
{
    const range r = range_of(evidence);
    hci_normal known;
    hci_model model;
    trial_bench b;
    operating_point best = {0.0, 0.0, 0.0};
    double *work = NULL, most = 0.0;
    hci_status status = hci_evidence_normal(evidence, wrong, false, &known, note);
    if (status) return status;
    status = hci_model_make(evidence->declared, right, false, &model, note);
    if (!status && bench_make(evidence, r.noise_Nm, &b)) {
        work = hci_memory_new(known.n * known.n + known.n + b.cells.count + 1, sizeof *work);
        for (int k = 0; work && k < POINTS && most < DECISIVE && !status; ++k) {
            const operating_point p = point_at(&r, k);
            double score = 0.0;
            status = point_score(evidence, &b, &p, r.temperature_C, &model.list, wrong, &known,
                                 work + known.n * known.n + known.n, work, &score, note);
            if (score > most) {
                most = score;
                best = p;
            }
        }
        hci_memory_free(b.cell);
    }
    if (!status && !work) status = hci_note_set(note, HCI_ERROR_MEMORY, "out of memory for the advice");
    if (!status) words(&best, most, right_name, wrong_name, text, size);
    hci_memory_free(work);
    hci_model_release(&model);
    hci_normal_release(&known);
    return status;
}
