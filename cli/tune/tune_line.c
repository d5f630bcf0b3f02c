#include "cli/tune/tune_line.h"

#include <math.h>

#include "cli/tune/tune_recorded.h"
#include "hci/host/waveform/load_curve.h"
#include "hci/machine/frames.h"
#include "hci/math/harmonic.h"

/* ---- a line ---- */

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

static bool are_in_line(moments m)
{
    const double half = 0.5 * (m.dd + m.qq), spread = hypot(0.5 * (m.dd - m.qq), m.dq);
    return half > 0.0 && half - spread < ACROSS * (half + spread);
}

bool cli_tune_currents_are_in_line(const cli_tuning *t)
{
    return are_in_line(moments_of(t));
}

/* Currents further from i_q make less than half of the torque of the shortest, if the angle is right: a
 * torque that small beside them is none to go by. */
#define MOST_ANGLE_DEG 60.0

static double angle_of(moments m)
{
    return -0.5 * atan2(2.0 * m.dq, m.qq - m.dd) * 180.0 / HCI_PI;
}

bool cli_tune_line_is_kept(const cli_tuning *t, double *angle_deg)
{
    const double angle = angle_of(moments_of(t));
    *angle_deg = fabs(angle) < CLI_TUNE_LEAST_ANGLE_DEG ? 0.0 : angle;
    return cli_tune_currents_are_in_line(t) && fabs(angle) <= MOST_ANGLE_DEG;
}

/* ---- a curve ---- */

enum { MOST_LOADS = 64 };

static hci_load load_of(const cli_tuning *t, const hci_run *r)
{
    const bool is_measured = r->torque_source == HCI_TORQUE_MEASURED;
    hci_load x = {0.0, 0.0, 0.0};
    for (size_t n = 0; n < r->count; ++n) {
        const hci_dq i = hci_park(hci_clarke(r->i_A + 3 * n), r->pole_pairs * r->theta_m_rad[n]);
        const double share = 1.0 / (double)r->count;
        x.id_A += share * i.d;
        x.iq_A += share * i.q;
        x.torque_Nm +=
            share * (is_measured ? r->torque_Nm[n] : t->reading.run.torque_constant_Nm_per_A * i.q);
    }
    return x;
}

/* Of the recordings whose torque has the sign of the one that is wanted. Returns how many; 0 where the
 * current of one has no direction. */
static size_t loads_of(const cli_tuning *t, double mean_Nm, hci_load load[MOST_LOADS])
{
    size_t count = 0;
    for (size_t k = 0; k < t->runs.count && count < MOST_LOADS; ++k) {
        const hci_run *r = &t->runs.run[k];
        moments m = {0.0, 0.0, 0.0};
        if (cli_tune_has_no_current(t, r)) continue;
        add_moments(r, &m);
        if (!are_in_line(m)) return 0;
        load[count] = load_of(t, r);
        count += load[count].torque_Nm * mean_Nm > 0.0;
    }
    return count;
}

bool cli_tune_curve_is_kept(const cli_tuning *t, double mean_Nm, double *angle_deg)
{
    hci_load load[MOST_LOADS];
    if (cli_tune_line_is_kept(t, angle_deg)) return true;
    const size_t count = loads_of(t, mean_Nm, load);
    const bool is_curve = hci_loads_are_on_curve(load, count);
    if (is_curve) *angle_deg = hci_load_curve_angle_rad(load, count, mean_Nm) * 180.0 / HCI_PI;
    return is_curve;
}
