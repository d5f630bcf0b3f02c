/* The torque sensor: τ ẏ + y = T and z̈ + 2ζω ż + ω² z = ω² y, by the classical Runge-Kutta method in steps
 * far below τ, 1/ω and the period of T. */
#include "rig.h"

#include <math.h>

bool rig_sensor_is_ideal(const rig_hidden *h)
{
    return h->time_constant_s <= 0.0 && h->natural_frequency_Hz <= 0.0;
}

/* The next stage may be missing, then it passes on what it gets. */
static rig_sensor rate(const rig_hidden *h, double input_Nm, const rig_sensor *s)
{
    const double omega = 2.0 * RIG_PI * h->natural_frequency_Hz;
    const bool lags = h->time_constant_s > 0.0, resonates = omega > 0.0;
    const double lagged = lags ? s->lag_Nm : input_Nm;
    rig_sensor d = {0.0, 0.0, 0.0};
    if (lags) d.lag_Nm = (input_Nm - s->lag_Nm) / h->time_constant_s;
    if (!resonates) return d;
    d.resonator_Nm = s->rate_Nm_per_s;
    d.rate_Nm_per_s =
        omega * omega * (lagged - s->resonator_Nm) - 2.0 * h->damping * omega * s->rate_Nm_per_s;
    return d;
}

static rig_sensor moved(const rig_sensor *s, const rig_sensor *d, double step_s)
{
    return (rig_sensor){s->lag_Nm + step_s * d->lag_Nm, s->resonator_Nm + step_s * d->resonator_Nm,
                        s->rate_Nm_per_s + step_s * d->rate_Nm_per_s};
}

void rig_sensor_step(const rig_hidden *h, const double input_Nm[3], double step_s, rig_sensor *s)
{
    const rig_sensor k1 = rate(h, input_Nm[0], s), s2 = moved(s, &k1, 0.5 * step_s);
    const rig_sensor k2 = rate(h, input_Nm[1], &s2), s3 = moved(s, &k2, 0.5 * step_s);
    const rig_sensor k3 = rate(h, input_Nm[1], &s3), s4 = moved(s, &k3, step_s);
    const rig_sensor k4 = rate(h, input_Nm[2], &s4);
    *s = moved(s, &k1, step_s / 6.0);
    *s = moved(s, &k2, step_s / 3.0);
    *s = moved(s, &k3, step_s / 3.0);
    *s = moved(s, &k4, step_s / 6.0);
    if (h->natural_frequency_Hz <= 0.0) s->resonator_Nm = h->time_constant_s > 0.0 ? s->lag_Nm : input_Nm[2];
}

int rig_sensor_steps(const rig_hidden *h, double span_s, double input_rad_per_s)
{
    double fastest = input_rad_per_s;
    if (h->time_constant_s > 0.0) fastest = fmax(fastest, 1.0 / h->time_constant_s);
    fastest = fmax(fastest, 2.0 * RIG_PI * h->natural_frequency_Hz);
    return (int)ceil(fabs(span_s) * fastest / 0.2) + 1;
}

static double input_at(const rig_case *c, const rig_run *run, double t_s)
{
    const rig_instant x = rig_run_at(c, run, t_s);
    return rig_torque_true(c, &x) + rig_torque_invented(c, run, t_s, &x);
}

void rig_sensor_follow(const rig_case *c, const rig_run *run, double from_s, double to_s, rig_sensor *s)
{
    const double electrical = c->machine.pole_pairs * fabs(run->omega_rad_per_s);
    const int steps = rig_sensor_steps(&c->hidden, to_s - from_s, 12.0 * electrical);
    const double step_s = (to_s - from_s) / steps;
    double input[3];
    if (rig_sensor_is_ideal(&c->hidden)) {
        s->resonator_Nm = input_at(c, run, to_s);
        return;
    }
    input[2] = input_at(c, run, from_s);
    for (int k = 0; k < steps; ++k) {
        input[0] = input[2];
        input[1] = input_at(c, run, from_s + (k + 0.5) * step_s);
        input[2] = input_at(c, run, from_s + (k + 1.0) * step_s);
        rig_sensor_step(&c->hidden, input, step_s, s);
    }
}

double rig_sensor_settling_s(const rig_hidden *h)
{
    const double omega = 2.0 * RIG_PI * h->natural_frequency_Hz;
    return 15.0 * h->time_constant_s + (omega > 0.0 ? 15.0 / (h->damping * omega) : 0.0);
}

rig_sensor rig_sensor_settled(const rig_case *c, const rig_run *run, double t_s)
{
    const double before_s = t_s - rig_sensor_settling_s(&c->hidden), start = input_at(c, run, before_s);
    rig_sensor s = {start, start, 0.0};
    rig_sensor_follow(c, run, before_s, t_s, &s);
    return s;
}
