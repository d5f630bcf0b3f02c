#include "host/diagnose/candidates/empirical_term.h"

#include <float.h>
#include <math.h>

#include "host/recording/rotor_frame.h"

static const double OF_CURRENT[] = {0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0};
static const double OF_SPEED[] = {0.0, 0.5, 1.0, 2.0};

hci_growth_law hci_growth_law_of(size_t g)
{
    enum { CURRENTS = sizeof OF_CURRENT / sizeof *OF_CURRENT, SPEEDS = sizeof OF_SPEED / sizeof *OF_SPEED };
    const hci_growth_law x = {OF_CURRENT[g % CURRENTS], OF_SPEED[g / CURRENTS % SPEEDS],
                              g / (CURRENTS * SPEEDS) > 0};
    return x;
}

bool hci_growth_law_is_known(size_t g, double order)
{
    const hci_growth_law x = hci_growth_law_of(g);
    if (order > 0.0) return x.speed == 0.0 && !x.turns_sign && x.current == floor(x.current);
    return !x.turns_sign || (x.current == 0.0 && x.speed != 0.5);
}

/* x^exponent of a whole number of quarters, x >= 0, from the fourth root: no exponent here is large. */
static double power(double x, double exponent)
{
    const int quarters = (int)(4.0 * exponent + 0.5);
    const double root = quarters % 2 == 1 ? sqrt(sqrt(x)) : quarters % 4 == 2 ? sqrt(x) : x;
    const int times = quarters % 2 == 1 ? quarters : quarters % 4 == 2 ? quarters / 2 : quarters / 4;
    double product = 1.0;
    for (int k = 0; k < times; ++k)
        product *= root;
    return product;
}

double hci_growth_law_at(size_t g, double current_A, double speed_rad_per_s)
{
    const hci_growth_law x = hci_growth_law_of(g);
    const double sign = x.turns_sign ? (speed_rad_per_s > 0.0) - (speed_rad_per_s < 0.0) : 1.0;
    return sign * power(current_A, x.current) * power(fabs(speed_rad_per_s), x.speed);
}

static void torque_of_all(const hci_effect *effect, const hci_machine *machine, const hci_sample *truth,
                          hci_effect_torque *sum, double *by_value)
{
    const hci_dq i = hci_sample_dq(truth, machine->pole_pairs);
    const double current_A = sqrt(i.d * i.d + i.q * i.q);
    for (size_t k = 0; k < effect->count; ++k) {
        const hci_effect_term *term = &effect->term[k];
        const double angle = term->order * machine->pole_pairs * truth->theta_m_rad;
        const double wave = term->parameter % 2 == 1 ? cos(angle) : sin(angle);
        const double by = wave * hci_growth_law_at(term->parameter / 2, current_A, truth->speed_rad_per_s);
        sum->torque_Nm += term->value * by;
        if (by_value) by_value[k] = by;
    }
}

#define WAVE                                                                                                 \
    {                                                                                                        \
        "wave", "Nm", "of one growth", 0.0, -DBL_MAX, true, false, 0.0,                                      \
            HCI_PARAMETER_LINEAR | HCI_PARAMETER_WITH_CURRENT                                                \
    }
#define WAVES_4  WAVE, WAVE, WAVE, WAVE
#define WAVES_16 WAVES_4, WAVES_4, WAVES_4, WAVES_4
#define WAVES_64 WAVES_16, WAVES_16, WAVES_16, WAVES_16

static const hci_effect_parameter PARAMETER[2 * HCI_GROWTH_LAWS] = {WAVES_64, WAVES_64};

const hci_effect_type hci_empirical_type = {
    .name = "unknown",
    .equation = "T = (S sin nθ + C cos nθ) |i|^a |ω|^b (sign ω)^c",
    .signature = "grows in a way that no known effect does",
    .parameter = PARAMETER,
    .parameter_count = 2 * HCI_GROWTH_LAWS,
    .in_machine = true,
    .torque_of_all = torque_of_all,
};
