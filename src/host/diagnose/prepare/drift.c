#include "host/diagnose/prepare/drift.h"

#include <math.h>
#include <string.h>

#include "hci/math/dense.h"
#include "hci/math/harmonic.h"
#include "host/recording/rotor_frame.h"

enum {
    PARTS = 8, /* of a turn, each a mean */
    LEAST_PARTS = 10,
    LEAST_OF_PART = 4, /* samples */
    OF_THE_EFFECT = 6, /* turns in which a straight line is an effect's */
    STEPS = 64         /* for the largest and the least */
};

#define STEEP     6.0  /* standard errors */
#define LIFT      0.2  /* of the scatter of a sample about its mean, that is worth it */
#define STEADY    0.05 /* of the speed, rms about its mean */
#define OF_OTHERS 0.3  /* of a drift, that a current or a speed makes or may have made */
#define STEADY_K  1.0

enum { OF_TORQUE, OF_CURRENT, OF_SPEED, CHANNELS };

/* Of the changes over one turn, each a mean over a part of a turn: normal equations of powers of the time. */
typedef struct {
    double gram[HCI_DRIFT_DEGREE * HCI_DRIFT_DEGREE];
    double moment[CHANNELS][HCI_DRIFT_DEGREE], square;
    double parts;
} changes;

typedef struct {
    const hci_run *run;
    double turn_rad, way, Nm_per_A, speed_Nm; /* speed_Nm: what counts as one of its changes by all of it */
    int pole_pairs;
    hci_drift time; /* its scale */
} question;

/* ---- changes over a turn ---- */

static double tau_at(const hci_drift *d, double time_s)
{
    return (time_s - d->middle_s) / d->half_s;
}

static void channels_at(const question *x, size_t k, double value[CHANNELS])
{
    const hci_run *r = x->run;
    value[OF_TORQUE] = r->torque_Nm[k];
    value[OF_CURRENT] = x->Nm_per_A * hci_run_dq(r, x->pole_pairs, k).q;
    value[OF_SPEED] = r->speed_rad_per_s ? x->speed_Nm * r->speed_rad_per_s[k] : 0.0;
}

/* Adds sample k less the line between two samples about one turn before, the first of which is `at`. */
static void change_add(const question *x, size_t k, size_t at, double row[], double value[CHANNELS])
{
    const hci_run *r = x->run;
    const double wanted = x->way * r->theta_m_rad[k] - x->turn_rad, from = x->way * r->theta_m_rad[at],
                 to = x->way * r->theta_m_rad[at + 1];
    const double share = to > from ? fmin(1.0, fmax(0.0, (wanted - from) / (to - from))) : 0.0;
    const double now = tau_at(&x->time, r->time_s[k]),
                 then = tau_at(&x->time, r->time_s[at] + share * (r->time_s[at + 1] - r->time_s[at]));
    double here[CHANNELS], before[CHANNELS], after[CHANNELS];
    channels_at(x, k, here);
    channels_at(x, at, before);
    channels_at(x, at + 1, after);
    for (int c = 0; c < CHANNELS; ++c)
        value[c] += here[c] - before[c] - share * (after[c] - before[c]);
    for (int j = 0; j < HCI_DRIFT_DEGREE; ++j)
        row[j] += pow(now, j + 1) - pow(then, j + 1);
}

static void part_add(const double row[], const double value[CHANNELS], double count, changes *c)
{
    const double share = 1.0 / count;
    for (int j = 0; j < HCI_DRIFT_DEGREE; ++j) {
        for (int k = 0; k < HCI_DRIFT_DEGREE; ++k)
            c->gram[j * HCI_DRIFT_DEGREE + k] += share * row[j] * share * row[k];
        for (int of = 0; of < CHANNELS; ++of)
            c->moment[of][j] += share * row[j] * share * value[of];
    }
    c->square += share * value[OF_TORQUE] * share * value[OF_TORQUE];
    c->parts += 1.0;
}

static changes changes_of(const question *x)
{
    const hci_run *r = x->run;
    double row[HCI_DRIFT_DEGREE] = {0.0}, value[CHANNELS] = {0.0}, count = 0.0, part = -1.0;
    changes c = {.parts = 0.0};
    for (size_t k = 1, at = 0; k < r->count; ++k) {
        const double gone = x->way * (r->theta_m_rad[k] - r->theta_m_rad[0]) - x->turn_rad;
        if (gone < 0.0) continue;
        while (at + 2 < k && x->way * (r->theta_m_rad[at + 1] - r->theta_m_rad[0]) <= gone)
            ++at;
        const double in = floor(gone / x->turn_rad * PARTS);
        if (in > part) {
            if (count >= LEAST_OF_PART) part_add(row, value, count, &c);
            memset(row, 0, sizeof row);
            memset(value, 0, sizeof value);
            count = 0.0, part = in;
        }
        change_add(x, k, at, row, value);
        count += 1.0;
    }
    return c;
}

/* ---- the polynomial ---- */

/* Of the first `degree` powers; what they explain. 0: they depend on each other. */
static double solve(const changes *c, int degree, int of, double coefficient[HCI_DRIFT_DEGREE])
{
    double gram[HCI_DRIFT_DEGREE * HCI_DRIFT_DEGREE], explained = 0.0;
    memset(coefficient, 0, HCI_DRIFT_DEGREE * sizeof *coefficient);
    for (int j = 0; j < degree; ++j) {
        coefficient[j] = c->moment[of][j];
        for (int k = 0; k < degree; ++k)
            gram[j * degree + k] = c->gram[j * HCI_DRIFT_DEGREE + k];
    }
    if (hci_cholesky_factor((size_t)degree, gram)) return 0.0;
    hci_cholesky_solve((size_t)degree, gram, coefficient);
    for (int j = 0; j < degree; ++j)
        explained += coefficient[j] * c->moment[of][j];
    return explained;
}

/* The highest power that what is below it leaves plainly. */
static int degree_of(const changes *c)
{
    double x[HCI_DRIFT_DEGREE], before = 0.0;
    int degree = 0;
    for (int n = 1; n <= HCI_DRIFT_DEGREE; ++n) {
        const double explained = solve(c, n, OF_TORQUE, x),
                     rest = fmax(0.0, c->square - explained) / (c->parts - n);
        if (!(explained - before > STEEP * STEEP * (n - degree) * rest)) continue;
        degree = n;
        before = explained;
    }
    return degree;
}

double hci_drift_at_Nm(const hci_drift *d, double time_s)
{
    double power = 1.0, sum = d->degree > 0 ? d->at_middle_Nm : 0.0;
    for (int j = 0; j < d->degree; ++j) {
        power *= tau_at(d, time_s);
        sum += d->coefficient_Nm[j] * power;
    }
    return sum;
}

double hci_drift_peak_to_peak_Nm(const hci_drift *d)
{
    double least = 0.0, most = 0.0;
    for (int k = 0; k <= STEPS && d->degree > 0; ++k) {
        const double x = hci_drift_at_Nm(d, d->middle_s + d->half_s * (2.0 * k / STEPS - 1.0));
        least = k > 0 ? fmin(least, x) : x;
        most = k > 0 ? fmax(most, x) : x;
    }
    return most - least;
}

/* Of one channel, 0 on average over the time. */
static hci_drift drift_of(const question *x, const changes *c, int degree, int of)
{
    hci_drift d = x->time;
    d.degree = degree;
    solve(c, degree, of, d.coefficient_Nm);
    d.at_middle_Nm = 0.0;
    for (int j = 1; j < degree; j += 2)
        d.at_middle_Nm -= d.coefficient_Nm[j] / (j + 2.0); /* the mean of τ^(j+1) */
    return d;
}

/* ---- all ---- */

static bool is_asked(const hci_run *r, const hci_run_statistics *f)
{
    return r->torque_source == HCI_TORQUE_MEASURED && r->time_s && r->theta_m_rad && !r->only_mean &&
           r->turn_known && r->count > 1 && r->time_s[r->count - 1] > r->time_s[0] &&
           f->speed_deviation <= STEADY * fabs(f->mean_speed_rad_per_s) &&
           !(f->hottest_C - f->coldest_C > STEADY_K);
}

/* Whether what the current makes, or the speed, creeps as well. */
static bool is_caused(const question *x, const changes *c, int degree, double swing_Nm)
{
    const hci_drift current = drift_of(x, c, degree, OF_CURRENT), speed = drift_of(x, c, degree, OF_SPEED);
    return hci_drift_peak_to_peak_Nm(&current) > OF_OTHERS * swing_Nm ||
           hci_drift_peak_to_peak_Nm(&speed) > OF_OTHERS * swing_Nm;
}

hci_drift hci_drift_find(const hci_run *r, const hci_run_statistics *f, int pole_pairs, double Nm_per_A)
{
    const hci_drift none = {.degree = 0};
    if (!is_asked(r, f)) return none;
    const double from = r->time_s[0], to = r->time_s[r->count - 1], last = r->theta_m_rad[r->count - 1];
    const question x = {r,
                        2.0 * HCI_PI,
                        last > r->theta_m_rad[0] ? 1.0 : -1.0,
                        fabs(f->current_A) > 0.0 ? Nm_per_A : 0.0,
                        f->rms_torque_Nm / fmax(fabs(f->mean_speed_rad_per_s), 1e-300),
                        pole_pairs,
                        {.middle_s = 0.5 * (from + to), .half_s = 0.5 * (to - from)}};
    const changes c = changes_of(&x);
    const int degree = c.parts >= LEAST_PARTS ? degree_of(&c) : 0;
    if (degree == 0) return none;
    const hci_drift found = drift_of(&x, &c, degree, OF_TORQUE);
    const double swing_Nm = hci_drift_peak_to_peak_Nm(&found);
    return swing_Nm > LIFT * f->repeat_Nm && !is_caused(&x, &c, degree, swing_Nm) ? found : none;
}

/* ---- all runs */

/* Of the mean rate, that one rate may differ by. */
#define ALIKE 0.2

static bool may_be_of_effect(const hci_run_statistics *f)
{
    return f->turns >= OF_THE_EFFECT;
}

/* Mean of the straight ones; 0: none. */
static double rate_of(const hci_run_statistics *statistics, size_t runs)
{
    double sum = 0.0, count = 0.0;
    for (size_t k = 0; k < runs; ++k) {
        const hci_drift *d = &statistics[k].drift;
        if (!may_be_of_effect(&statistics[k]) || d->degree != 1) continue;
        sum += d->coefficient_Nm[0] / d->half_s;
        count += 1.0;
    }
    return count > 0.0 ? sum / count : 0.0;
}

void hci_drifts_leave_to_effect(hci_run_statistics *statistics, size_t runs)
{
    const double rate = rate_of(statistics, runs);
    for (size_t k = 0; k < runs; ++k) {
        const hci_drift *d = &statistics[k].drift;
        const bool is_like =
            d->degree == 1 && fabs(d->coefficient_Nm[0] / d->half_s - rate) < ALIKE * fabs(rate);
        if (d->degree > 0 && !is_like) return;
    }
    for (size_t k = 0; k < runs; ++k)
        if (may_be_of_effect(&statistics[k])) statistics[k].drift.degree = 0;
}
