/* What the declared machine lacks, by the equations of docs/effects.md, and what no page lists. */
#include "rig.h"

#include <math.h>

#define THIRD (2.0 * RIG_PI / 3.0)

const char *const RIG_EFFECT_NAME[RIG_EFFECTS] = {"cogging",         "back_emf",
                                                  "phase_imbalance", "reluctance",
                                                  "saturation",      "magnet_temperature",
                                                  "current_offset",  "current_gain",
                                                  "position_offset", "position_eccentricity",
                                                  "channel_delay",   "friction",
                                                  "torque_sensor",   "mechanical_order"};

const char *const RIG_INVENTION_NAME[RIG_INVENTIONS] = {
    "",
    "unknown_sqrt_current",
    "unknown_loose_part",
    "unknown_drift",
    "unknown_belt",
    "unknown_hysteresis",
    "unknown_speed_order",
    "unknown_tanh_current",
    "unknown_stick",
    "unknown_burst",
};

static double sign(double x)
{
    return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0;
}

/* Σ_s i_s of what goes with the back-EMF: its own correction, unequal phases, warm magnets. */
static double emf_torque(const rig_case *c, const rig_instant *x, double theta_e_rad)
{
    const rig_hidden *h = &c->hidden;
    const double warm = h->emf_per_kelvin * (x->temperature_C - 20.0);
    double sum = 0.0;
    for (int s = 0; s < 3; ++s) {
        const double theta_s = theta_e_rad - THIRD * s;
        sum += x->i_A[s] *
               ((h->imbalance[s] + warm) * rig_waves_at(c->machine.emf, c->machine.emf_count, theta_s) +
                rig_waves_at(h->emf, 1, theta_s));
    }
    return sum;
}

/* T = p (i_q ∂W'/∂i_d − i_d ∂W'/∂i_q + ∂W'/∂θ) */
static double coenergy_torque(const rig_case *c, double theta_e_rad, double d, double q)
{
    const rig_hidden *h = &c->hidden;
    const double c6 = cos(6.0 * theta_e_rad), s6 = sin(6.0 * theta_e_rad), p = c->machine.pole_pairs;
    const double x = d / c->machine.rated_current_A, y = q / c->machine.rated_current_A;
    const double by_d = 1.5 * h->dd_cosine_0 * d, by_q = 1.5 * h->qq_cosine_6 * c6 * q;
    const double by_theta = -6.0 * s6 * 0.75 * h->qq_cosine_6 * q * q;
    const double by_x = h->d1q2_cosine_0 * y * y + 3.0 * h->d3q0_cosine_0 * x * x;
    const double by_y = 2.0 * h->d1q2_cosine_0 * x * y + 3.0 * h->d0q3_sine_6 * s6 * y * y;
    return p * (q * by_d - d * by_q + by_theta + y * by_x - x * by_y + 6.0 * h->d0q3_sine_6 * c6 * y * y * y);
}

static double friction_torque(const rig_hidden *h, double omega)
{
    return -(h->coulomb * sign(omega) + h->viscous * omega + h->quadratic * omega * fabs(omega));
}

double rig_torque_true(const rig_case *c, const rig_instant *x)
{
    const rig_hidden *h = &c->hidden;
    const double theta_e_rad = c->machine.pole_pairs * x->theta_m_rad;
    double d, q;
    rig_dq_of(theta_e_rad, x->i_A, &d, &q);
    return rig_torque_declared(&c->machine, x->theta_m_rad, x->i_A) +
           rig_waves_at(h->cogging, 2, theta_e_rad) + emf_torque(c, x, theta_e_rad) +
           coenergy_torque(c, theta_e_rad, d, q) + friction_torque(h, x->omega_rad_per_s) +
           rig_waves_at(h->turn, 1, x->theta_m_rad) + q * rig_waves_at(h->turn_iq, 1, x->theta_m_rad);
}

/* Rattles for some part of the time, each time anew. */
static double loose_part(const rig_invented *h, const rig_run *run, double t_s, double theta_m_rad)
{
    const int64_t slot = (int64_t)floor(t_s / run->duration_s * h->scale);
    if (rig_hash(run->seed, slot, 1) < 0.5) return 0.0;
    return sin(h->order * theta_m_rad + 2.0 * RIG_PI * rig_hash(run->seed, slot, 2));
}

/* One knock at some angle in each `scale` turns. */
static double burst(const rig_invented *h, const rig_run *run, double theta_m_rad)
{
    const double turns = theta_m_rad / (2.0 * RIG_PI) / h->scale, block = floor(turns);
    const double at = 0.2 + 0.6 * rig_hash(run->seed, (int64_t)block, 3);
    const double side = rig_hash(run->seed, (int64_t)block, 4) < 0.5 ? -1.0 : 1.0;
    const double distance = (turns - block - at) * h->scale / 0.04;
    return side * exp(-0.5 * distance * distance);
}

/* How the wave of an electrical order grows with current, direction or speed, by laws that no power of the
 * current and no delay follows. */
static double law(const rig_case *c, const rig_instant *x, double theta_e_rad)
{
    const rig_invented *h = &c->invented;
    double d, q;
    rig_dq_of(theta_e_rad, x->i_A, &d, &q);
    const double current = hypot(d, q) / c->machine.rated_current_A;
    switch (h->kind) {
    case RIG_SQRT_CURRENT:
        return sqrt(current);
    case RIG_TANH_CURRENT:
        return tanh(current / h->scale);
    case RIG_HYSTERESIS:
        return sign(x->omega_rad_per_s);
    case RIG_SPEED_ORDER:
        return fabs(x->omega_rad_per_s) / c->machine.rated_speed_rad_per_s;
    default:
        return 0.0;
    }
}

/* Once a turn it goes hard, and the less hard for the rest: the mean of max(0, cos)⁶ is 5/32. */
static double stick(const rig_invented *h, const rig_instant *x)
{
    return sign(x->omega_rad_per_s) * (pow(fmax(0.0, cos(x->theta_m_rad - h->phase_rad)), 6.0) - 5.0 / 32.0);
}

/* From one side to the other of the mean. */
static double drift(const rig_run *run, double t_s)
{
    return (rig_hash(run->seed, 0, 5) < 0.5 ? -1.0 : 1.0) * cos(RIG_PI * t_s / run->duration_s);
}

/* Not in step with the turn, and slipped between one run and the next. */
static double belt(const rig_invented *h, const rig_run *run, double theta_m_rad)
{
    return sin(h->order * theta_m_rad + 2.0 * RIG_PI * rig_hash(run->seed, 0, 6));
}

double rig_torque_invented(const rig_case *c, const rig_run *run, double t_s, const rig_instant *x)
{
    const rig_invented *h = &c->invented;
    const double theta_e_rad = c->machine.pole_pairs * x->theta_m_rad;
    switch (h->kind) {
    case RIG_KNOWN:
        return 0.0;
    case RIG_LOOSE_PART:
        return h->amplitude_Nm * loose_part(h, run, t_s, x->theta_m_rad);
    case RIG_DRIFT:
        return h->amplitude_Nm * drift(run, t_s);
    case RIG_BELT:
        return h->amplitude_Nm * belt(h, run, x->theta_m_rad);
    case RIG_STICK:
        return h->amplitude_Nm * stick(h, x);
    case RIG_BURST:
        return h->amplitude_Nm * burst(h, run, x->theta_m_rad);
    default:
        return h->amplitude_Nm * law(c, x, theta_e_rad) * sin(h->order * theta_e_rad + h->phase_rad);
    }
}
