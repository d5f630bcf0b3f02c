/* What friction is more at low speed, where the film of the lubricant has not formed yet, in Gauss's form of
 * Stribeck's curve (B. Armstrong-Hélouvry, P. Dupont and C. Canudas de Wit, A survey of models, analysis
 * tools and compensation methods for the control of machines with friction, Automatica 30(7), 1994, p. 1083):
 *
 *     T = −T_s e^{−(ω/ω_s)²} sign ω
 *
 * on top of the constant and the viscous part, which are those of friction. A simulated shaft has constant
 * Coulomb friction and smooth drag: T_s is the former, −T_s (1 − e^{−(ω/ω_s)²}) sign ω the latter. */
#include "core/effects/type.h"

#include <string.h>

#include "hci/math/dense.h"

enum { EXCESS, SPEED };

static const hci_effect_parameter PARAMETER[] = {
    HCI_PLAIN("excess", "Nm", "at rest beyond the Coulomb friction", 0.0, 0.0,
              HCI_PARAMETER_LINEAR | HCI_PARAMETER_WITH_SPEED),
    HCI_PLAIN("speed", "rad_per_s", "mechanical speed at which it has fallen to 37 %", 1.0, 1e-6,
              HCI_PARAMETER_WITH_SPEED | HCI_PARAMETER_SCALE),
};

static double sign_of(double speed)
{
    return (speed > 0.0) - (speed < 0.0);
}

static double torque(const hci_effect *effect, const hci_effect_term *term, const hci_machine *machine,
                     const hci_sample *truth, hci_effect_torque *sum)
{
    const double of = hci_effect_value(effect, SPEED), u = truth->speed_rad_per_s / of;
    const double braking = exp(-u * u) * sign_of(truth->speed_rad_per_s);
    (void)machine;
    if (term->parameter == SPEED) return -hci_effect_value(effect, EXCESS) * braking * 2.0 * u * u / of;
    sum->torque_Nm -= term->value * braking;
    return -braking;
}

static double coulomb_Nm(const hci_effect *effect)
{
    return hci_effect_value(effect, EXCESS);
}

static double drag_Nm(const hci_effect *effect, const hci_plant_state *state)
{
    const double u = state->speed_rad_per_s / hci_effect_value(effect, SPEED);
    return hci_effect_value(effect, EXCESS) * expm1(-u * u) * sign_of(u);
}

static double modify(const hci_effect *effect, const hci_plant_state *plant, double step_s, double *memory,
                     double value, double theta_m_rad)
{
    (void)step_s;
    (void)memory;
    (void)theta_m_rad;
    if (!plant) return value;
    return value - coulomb_Nm(effect) * sign_of(plant->speed_rad_per_s) - drag_Nm(effect, plant);
}

/* ---- where to look for it ---- */

#define LEAST_RANGE 4.0 /* fastest over slowest */
#define STANDS_OUT                                                                                           \
    25.0             /* fall of χ² beside friction, that means of so many samples do not have by chance    \
                      */
#define REGULAR 1e-9 /* added to a diagonal of 1: laws that the speeds do not tell apart */

enum { LAWS = 5, LEAST_SPEEDS = 4, SPEEDS_TRIED = 16 };

/* Zero of the sensor, Coulomb, viscous and quadratic friction, and the excess. */
static void laws_at(double speed, double of, double law[LAWS])
{
    const double sign = sign_of(speed), u = speed / of;
    const double x[LAWS] = {1.0, -sign, -speed, -speed * fabs(speed), -sign * exp(-u * u)};
    memcpy(law, x, sizeof x);
}

static void sums_fill(const hci_effect_survey *survey, double of, double gram[LAWS * LAWS], double b[LAWS])
{
    double law[LAWS];
    memset(gram, 0, LAWS * LAWS * sizeof *gram);
    memset(b, 0, LAWS * sizeof *b);
    for (size_t k = 0; k < survey->of_speeds; ++k) {
        const hci_effect_speed_mean *m = &survey->of_speed[k];
        laws_at(m->speed_rad_per_s, of, law);
        for (int i = 0; i < LAWS; ++i) {
            b[i] += m->weight * law[i] * m->residual_Nm;
            for (int j = 0; j < LAWS; ++j)
                gram[i + j * LAWS] += m->weight * law[i] * law[j];
        }
    }
}

/* By how much the first laws lower χ²; last: out, the value of the last one. */
static double fall_of(const double gram[LAWS * LAWS], const double b[LAWS], size_t laws, double *last)
{
    double a[LAWS * LAWS], x[LAWS], fall = 0.0;
    for (size_t j = 0; j < laws; ++j) {
        x[j] = b[j] / sqrt(gram[j + j * LAWS]);
        for (size_t i = 0; i < laws; ++i)
            a[i + j * laws] =
                gram[i + j * LAWS] / sqrt(gram[i + i * LAWS] * gram[j + j * LAWS]) + (i == j ? REGULAR : 0.0);
    }
    if (hci_cholesky_factor(laws, a) != 0) return 0.0;
    hci_cholesky_solve(laws, a, x);
    for (size_t j = 0; j < laws; ++j)
        fall += x[j] * b[j] / sqrt(gram[j + j * LAWS]);
    *last = x[laws - 1];
    return fall;
}

/* By how much an excess that fades with a speed lowers χ² beside friction; 0 for one below 0. */
static double gain_of(const hci_effect_survey *survey, double of)
{
    double gram[LAWS * LAWS], b[LAWS], excess = 0.0, unused = 0.0;
    sums_fill(survey, of, gram, b);
    for (int j = 0; j < LAWS; ++j)
        if (!(gram[j + j * LAWS] > 0.0)) return 0.0;
    const double with = fall_of(gram, b, LAWS, &excess), without = fall_of(gram, b, LAWS - 1, &unused);
    return excess > 0.0 ? with - without : 0.0;
}

/* How many of them are there, and from which to which they go. */
static size_t speeds_of(const hci_effect_survey *survey, double *least, double *most)
{
    size_t count = 0;
    *least = INFINITY;
    *most = 0.0;
    for (size_t k = 0; k < survey->of_speeds; ++k) {
        const double speed = fabs(survey->of_speed[k].speed_rad_per_s);
        bool is_new = speed > 0.0;
        for (size_t j = 0; j < k && is_new; ++j)
            is_new = fabs(fabs(survey->of_speed[j].speed_rad_per_s) - speed) > 0.1 * speed;
        count += is_new;
        *least = speed > 0.0 ? fmin(*least, speed) : *least;
        *most = fmax(*most, speed);
    }
    return count;
}

/* No small step from nothing finds the speed: the best one of a row of them. */
static void propose(const hci_effect_survey *survey, const hci_effect_proposals *to)
{
    double least, most, best = STANDS_OUT, start[] = {0.0, 0.0};
    if (speeds_of(survey, &least, &most) < LEAST_SPEEDS || most < LEAST_RANGE * least) return;
    for (int k = 0; k < SPEEDS_TRIED; ++k) {
        const double of = 0.7 * least * pow(most / least, (double)k / (SPEEDS_TRIED - 1));
        const double gain = gain_of(survey, of);
        if (!(gain > best)) continue;
        best = gain;
        start[SPEED] = of;
    }
    const hci_effect_candidate x = {EXCESS, 2, 0.0, SPEEDS_TRIED, 0.0, 0, start};
    if (start[SPEED] > 0.0) to->add(to->context, &x);
}

const hci_effect_type hci_effect_stribeck_friction = {
    .name = "stribeck_friction",
    .title = "Stribeck's friction",
    .equation = "T = −T_s e^{−(ω/ω_s)²} sign ω",
    .signature = "mean only; with the sign of the speed, and gone above some speed",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .needs = HCI_EFFECT_NEEDS_SPEED,
    .without = "without a speed friction and delays are left out",
    .told_by = "four speeds, two of them below that at which the friction is least",
    .propose = propose,
    .torque = torque,
    .drag_Nm = drag_Nm,
    .coulomb_Nm = coulomb_Nm,
    .modify_torque = modify,
};
