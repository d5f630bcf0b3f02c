#include "cli/tune/tune_current.h"

#include <math.h>

#include "hci/machine/frames.h"
#include "hci/math/harmonic.h"

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
    double d_A = 0.0, q_A = 0.0;
    for (size_t k = 0; k < r->count && r->theta_m_rad; ++k) {
        const hci_dq i = hci_park(hci_clarke(r->i_A + 3 * k), r->pole_pairs * r->theta_m_rad[k]);
        d_A += i.d / (double)r->count;
        q_A += i.q / (double)r->count;
    }
    return hypot(d_A, q_A);
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

bool cli_tune_currents_are_in_line(const cli_tuning *t)
{
    moments m = {0.0, 0.0, 0.0};
    for (size_t k = 0; k < t->runs.count; ++k)
        if (!cli_tune_has_no_current(t, &t->runs.run[k])) add_moments(&t->runs.run[k], &m);
    const double half = 0.5 * (m.dd + m.qq), spread = hypot(0.5 * (m.dd - m.qq), m.dq);
    return half > 0.0 && half - spread < ACROSS * (half + spread);
}
