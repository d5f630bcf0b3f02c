#include "host/machine/torque_constant.h"

#include <math.h>
#include <string.h>

#include "hci/host/machine/machine.h"
#include "hci/machine/frames.h"

#define SMALL_A 1e-6 /* for which no machine saturates */

enum { SAMPLES_PER_PERIOD = 96 };

static double torque_at(const hci_machine *machine, const hci_effects *effects, double theta_m_rad,
                        double iq_A, double *by_value)
{
    hci_sample reading = {.theta_m_rad = theta_m_rad, .temperature_C = NAN};
    const hci_dq i = {0.0, iq_A, 0.0};
    hci_clarke_inverse(hci_park_inverse(i, machine->pole_pairs * theta_m_rad), reading.i_abc);
    return hci_effects_predict(machine, effects, &reading, by_value);
}

double hci_torque_constant(const hci_machine *machine, const hci_effects *effects)
{
    const int samples = SAMPLES_PER_PERIOD * machine->pole_pairs;
    double difference_Nm = 0.0;
    for (int k = 0; k < samples; ++k) {
        const double theta_m_rad = 2.0 * HCI_PI * k / samples;
        difference_Nm += torque_at(machine, effects, theta_m_rad, SMALL_A, NULL);
        difference_Nm -= torque_at(machine, effects, theta_m_rad, -SMALL_A, NULL);
    }
    return difference_Nm / (2.0 * SMALL_A * samples);
}

double hci_torque_constant_by_value(const hci_machine *machine, const hci_effects *effects, double *by_value,
                                    double *work)
{
    const size_t terms = hci_effects_terms(effects);
    const int samples = SAMPLES_PER_PERIOD * machine->pole_pairs;
    memset(by_value, 0, terms * sizeof *by_value);
    for (int k = 0; k < 2 * samples; ++k) {
        const double iq_A = k % 2 == 0 ? SMALL_A : -SMALL_A, theta_m_rad = 2.0 * HCI_PI * (k / 2) / samples;
        (void)torque_at(machine, effects, theta_m_rad, iq_A, work);
        for (size_t c = 0; c < terms; ++c)
            by_value[c] += work[c] / (2.0 * iq_A * samples);
    }
    return hci_torque_constant(machine, effects);
}

double hci_machine_torque_constant(const hci_machine_data *machine)
{
    const hci_effects none = {NULL, 0};
    return hci_torque_constant(&machine->model, &none);
}
