/* Sensors: what they read beside the truth, and when. */
#include <math.h>

#include "host/base/memory.h"
#include "host/simulate/setup_task.h"

static void set_errors(const hci_setup_task *b)
{
    const hci_scenario *s = b->scenario;
    hci_sensor *sensor = b->setup->sensor;
    const double pole_pairs = b->machine->pole_pairs, counts = hci_value_or(s->encoder_counts, 0.0);
    const double offset[3] = {s->current_offset_a_A, s->current_offset_b_A, s->current_offset_c_A};
    const double gain[3] = {s->current_gain_a, s->current_gain_b, s->current_gain_c};
    for (int k = 0; k < 3; ++k) {
        sensor[HCI_SENSE_IA + k].offset = hci_value_or(offset[k], 0.0);
        sensor[HCI_SENSE_IA + k].gain_error = hci_value_or(gain[k], 0.0);
        sensor[HCI_SENSE_IA + k].noise = hci_value_or(s->current_noise_A, 0.0);
        sensor[HCI_SENSE_IA + k].quantum = hci_value_or(s->current_quantum_A, 0.0);
    }
    sensor[HCI_SENSE_ANGLE].offset = hci_value_or(s->angle_offset_rad, 0.0) / pole_pairs;
    sensor[HCI_SENSE_ANGLE].noise = hci_value_or(s->angle_noise_rad, 0.0) / pole_pairs;
    sensor[HCI_SENSE_ANGLE].quantum = counts > 0.0 ? 2.0 * HCI_PI / counts : 0.0;
    sensor[HCI_SENSE_SPEED].noise = hci_value_or(s->speed_noise_rad_per_s, 0.0);
    sensor[HCI_SENSE_TORQUE].noise = hci_value_or(s->torque_noise_Nm, 0.0);
    if (counts > 0.0 && fmod(counts, pole_pairs) != 0.0) b->setup->period_turns = (size_t)pole_pairs;
}

static hci_status set_delays(const hci_setup_task *b)
{
    static const char *const NAME[HCI_SENSE_COUNT] = {"current_delay", "current_delay", "current_delay",
                                                      "angle_delay",   "speed_delay",   "torque_delay"};
    const hci_scenario *s = b->scenario;
    const double delay_s[HCI_SENSE_COUNT] = {s->current_delay_s, s->current_delay_s, s->current_delay_s,
                                             s->angle_delay_s,   s->speed_delay_s,   s->torque_delay_s};
    hci_setup *p = b->setup;
    for (int k = 0; k < HCI_SENSE_COUNT; ++k) {
        unsigned steps = 0;
        if (hci_setup_count_steps(b, NAME[k], hci_value_or(delay_s[k], 0.0), 0, &steps))
            return HCI_ERROR_INPUT;
        p->sensor[k].delay_steps = steps;
    }
    return HCI_OK;
}

static bool is_ideal(const hci_sensor *s)
{
    return s->gain_error == 0.0 && s->offset == 0.0 && s->noise == 0.0 && s->quantum == 0.0 &&
           s->delay_steps == 0 && !s->modify;
}

static void use_sensors(hci_setup *setup)
{
    for (int k = 0; k < HCI_SENSE_COUNT; ++k)
        if (!is_ideal(&setup->sensor[k])) setup->drive.sensors = setup->sensor;
}

hci_status hci_setup_sensors(const hci_setup_task *b)
{
    hci_status status;
    set_errors(b);
    status = set_delays(b);
    use_sensors(b->setup);
    return status;
}

hci_status hci_setup_delay_lines(const hci_setup_task *b)
{
    hci_setup *p = b->setup;
    for (int k = 0; k < HCI_SENSE_COUNT; ++k) {
        const size_t size = hci_sensor_workspace(&p->sensor[k]);
        p->ring[k] = size > 0 ? hci_memory_new(size, sizeof *p->ring[k]) : NULL;
        if (size > 0 && !p->ring[k]) return hci_note_memory(b->note, NULL, "a delay of %zu steps", size);
    }
    return HCI_OK;
}
