/* The zero of a torque sensor that creeps during a run, as strain gauges do while they warm up: straight in
 * time as far as a run is short beside the warming up.
 *
 *     T_read = T + D (t − t_0)        t_0: the start of the run
 */
#include "core/effects/type.h"

enum { RATE };

static const hci_effect_parameter PARAMETER[] = {
    HCI_PLAIN("rate", "Nm_per_s", "read more with every second of a run", 0.0, -DBL_MAX,
              HCI_PARAMETER_LINEAR | HCI_PARAMETER_OF_TRANSDUCER | HCI_PARAMETER_ALONG_TIME),
};

/* A step back in time is the start of another run. */
static void filter(const hci_effect *effect, const hci_effect_run *run)
{
    const double rate = hci_effect_value(effect, RATE);
    double start_s = 0.0;
    for (size_t k = 0; k < run->count; ++k) {
        if (k == 0 || run->time_s[k] < run->time_s[k - 1]) start_s = run->time_s[k];
        run->torque_Nm[k] += rate * (run->time_s[k] - start_s);
        for (size_t j = 0; run->by_value && j < effect->count; ++j)
            run->by_value[k * run->columns + run->own_column + j] += run->time_s[k] - start_s;
    }
}

/* memory: time since the start. */
static double modify(const hci_effect *effect, const hci_plant_state *plant, double step_s, double *memory,
                     double value, double theta_m_rad)
{
    const double drift_Nm = hci_effect_value(effect, RATE) * memory[0];
    (void)plant;
    (void)theta_m_rad;
    memory[0] += step_s;
    return value + drift_Nm;
}

static void simulate(const hci_effect *effect, int pole_pairs, hci_sensor *sensors,
                     hci_effect_channel *channels)
{
    const hci_effect_link link = {modify, effect, {0.0}};
    (void)pole_pairs;
    (void)sensors;
    hci_effect_link_add(&channels[HCI_SENSE_TORQUE], &link);
}

const hci_effect_type hci_effect_torque_drift = {
    .name = "torque_drift",
    .equation = "T_read = T + D (t − t_0)",
    .signature = "follows the time of a run, not the angle",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .needs = HCI_EFFECT_NEEDS_TIME,
    .without = "without time the drift of the torque sensor's zero is left out",
    .told_by = "the same point again at its end as at its beginning",
    .simulate = simulate,
    .filter = filter,
};
