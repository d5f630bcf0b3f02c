#include "cli/tune/tune_recorded.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hci/machine/frames.h"
#include "hci/math/harmonic.h"

/* ---- currents ---- */

/* Of the phase currents, beside those that another recording has or the machine is rated for. */
#define NO_CURRENT 0.01

/* Times what noise alone makes of a mean. */
#define NOISE_OF_MEAN 5.0

double cli_tune_rms_A(const hci_run *r)
{
    double sum = 0.0;
    for (size_t k = 0; k < 3 * r->count; ++k)
        sum += r->i_A[k] * r->i_A[k];
    return sqrt(sum / (3.0 * (double)r->count));
}

/* Of phase currents in the plane that turns with the angle: what a drive makes stands still there, and noise
 * and the offsets of sensors go to 0. */
static double mean_vector(const hci_run *r)
{
    double along = 0.0, across = 0.0;
    for (size_t k = 0; k < r->count && r->theta_m_rad; ++k)
        for (int s = 0; s < 3; ++s) {
            const double x = r->pole_pairs * r->theta_m_rad[k] - 2.0 * HCI_PI * s / 3.0;
            along += r->i_A[3 * k + (size_t)s] * cos(x);
            across += r->i_A[3 * k + (size_t)s] * sin(x);
        }
    return 2.0 / 3.0 * hypot(along, across) / (double)r->count;
}

/* Against a brake, whose current turns round with the motion, its mean may be 0. */
static bool is_braked(const hci_run *r)
{
    return r->torque_source == HCI_TORQUE_HOLDING && hci_run_is_loaded(r, r->pole_pairs);
}

bool cli_tune_has_no_current(const cli_tuning *t, const hci_run *r)
{
    const double rms_A = cli_tune_rms_A(r);
    double most_A = t->declared.rated_current_A > 0.0 ? t->declared.rated_current_A : 0.0;
    for (size_t k = 0; k < t->runs.count; ++k)
        most_A = fmax(most_A, cli_tune_rms_A(&t->runs.run[k]));
    if (rms_A <= NO_CURRENT * most_A) return true;
    return r->theta_m_rad && !is_braked(r) && mean_vector(r) < NOISE_OF_MEAN * rms_A / sqrt((double)r->count);
}

/* Of the mean square along a line, that noise makes across it. */
#define ACROSS 0.0025

/* Mean squares of i_d and i_q, and of their product, over all samples. */
typedef struct {
    double dd, dq, qq;
} moments;

static void add_moments(const hci_run *r, moments *m)
{
    for (size_t k = 0; k < r->count && r->theta_m_rad; ++k) {
        const hci_dq i = hci_park(hci_clarke(r->i_A + 3 * k), r->pole_pairs * r->theta_m_rad[k]);
        m->dd += i.d * i.d;
        m->dq += i.d * i.q;
        m->qq += i.q * i.q;
    }
}

static moments moments_of(const cli_tuning *t)
{
    moments m = {0.0, 0.0, 0.0};
    for (size_t k = 0; k < t->runs.count; ++k)
        if (!cli_tune_has_no_current(t, &t->runs.run[k])) add_moments(&t->runs.run[k], &m);
    return m;
}

bool cli_tune_currents_are_in_line(const cli_tuning *t)
{
    const moments m = moments_of(t);
    const double half = 0.5 * (m.dd + m.qq), spread = hypot(0.5 * (m.dd - m.qq), m.dq);
    return half > 0.0 && half - spread < ACROSS * (half + spread);
}

/* An angle of currents that a drive means to have at 0, and of sensors that differ. */
#define LEAST_ANGLE_DEG 1.0

/* Currents further from i_q make less than half of the torque of the shortest, if the angle is right: a
 * torque that small beside them is none to go by. */
#define MOST_ANGLE_DEG 60.0

bool cli_tune_line_is_kept(const cli_tuning *t, double *angle_deg)
{
    const moments m = moments_of(t);
    const double angle = -0.5 * atan2(2.0 * m.dq, m.qq - m.dd) * 180.0 / HCI_PI;
    *angle_deg = fabs(angle) < LEAST_ANGLE_DEG ? 0.0 : angle;
    return cli_tune_currents_are_in_line(t) && fabs(angle) <= MOST_ANGLE_DEG;
}

/* ---- ripple ---- */

/* Parts of the turn at most, samples in each of them at least, on average, and those of which the median is
 * taken. */
enum { MOST_PARTS = 480, IN_A_PART = 8, LEAST_PARTS = 12, KEPT = 15 };

typedef struct {
    double kept_Nm[MOST_PARTS][KEPT]; /* the last ones */
    size_t count[MOST_PARTS], parts, samples;
} part_samples;

static double torque_of(const cli_tuning *t, const hci_run *r, size_t n)
{
    return r->torque_source == HCI_TORQUE_HOLDING
               ? t->reading.run.torque_constant_Nm_per_A *
                     hci_park(hci_clarke(r->i_A + 3 * n), r->pole_pairs * r->theta_m_rad[n]).q
               : r->torque_Nm[n];
}

static bool goes(const hci_run *r, size_t n, int way)
{
    return !r->speed_rad_per_s || (way > 0 ? r->speed_rad_per_s[n] >= 0.0 : r->speed_rad_per_s[n] < 0.0);
}

static void add_all(const cli_tuning *t, const hci_run *r, int way, part_samples *m)
{
    const double turn_rad = 2.0 * HCI_PI / (r->turn_known ? 1.0 : r->pole_pairs);
    for (size_t n = 0; n < r->count; ++n) {
        const double turns = r->theta_m_rad[n] / turn_rad;
        const size_t part = (size_t)((turns - floor(turns)) * (double)m->parts) % m->parts;
        if (goes(r, n, way)) m->kept_Nm[part][m->count[part]++ % KEPT] = torque_of(t, r, n);
    }
}

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* A few rows in which the shaft speeds up or turns round do not move it. */
static double median_of(part_samples *m, size_t part)
{
    const size_t count = m->count[part] < KEPT ? m->count[part] : KEPT;
    qsort(m->kept_Nm[part], count, sizeof(double), by_value);
    return 0.5 * (m->kept_Nm[part][(count - 1) / 2] + m->kept_Nm[part][count / 2]);
}

/* In one direction, since friction and a brake turn with it. 0: too few samples. */
static double swing_of(const cli_tuning *t, const hci_run *r, int way)
{
    static part_samples m;
    double least_Nm = HUGE_VAL, most_Nm = -HUGE_VAL;
    memset(&m, 0, sizeof m);
    for (size_t n = 0; n < r->count; ++n)
        m.samples += goes(r, n, way);
    m.parts = m.samples / IN_A_PART < MOST_PARTS ? m.samples / IN_A_PART : MOST_PARTS;
    if (m.parts < LEAST_PARTS) return 0.0;
    add_all(t, r, way, &m);
    for (size_t k = 0; k < m.parts; ++k) {
        if (2 * m.count[k] < IN_A_PART) continue;
        const double median_Nm = median_of(&m, k);
        least_Nm = fmin(least_Nm, median_Nm);
        most_Nm = fmax(most_Nm, median_Nm);
    }
    return fmax(most_Nm - least_Nm, 0.0);
}

cli_tune_ripple cli_tune_recorded_ripple(const cli_tuning *t)
{
    cli_tune_ripple x = {t->runs.count, 0.0, 0.0};
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        if ((r->torque_source != HCI_TORQUE_MEASURED && r->torque_source != HCI_TORQUE_HOLDING) ||
            !r->torque_Nm || !r->theta_m_rad)
            continue;
        const double swing_Nm = fmax(swing_of(t, r, 1), r->speed_rad_per_s ? swing_of(t, r, -1) : 0.0);
        if (!(swing_Nm > x.peak_to_peak_Nm)) continue;
        x.run = k;
        x.peak_to_peak_Nm = swing_Nm;
        x.current_A = cli_tune_has_no_current(t, r) ? 0.0 : sqrt(2.0) * cli_tune_rms_A(r);
    }
    return x;
}
