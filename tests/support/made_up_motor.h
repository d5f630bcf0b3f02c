/* A motor whose every number is known, as `check` has it before anything is interpreted: 4 pole pairs, 24
 * slots, k_e = 0.1 N·m/A, R = 0.2 ohm, L_d = 1 mH, L_q = 2 mH, cogging 0.05 N·m at order 6; and recordings of
 * it, sample by sample from the equations of theory.md, without a file in between. */
#ifndef HCI_TESTS_SUPPORT_MADE_UP_MOTOR_H
#define HCI_TESTS_SUPPORT_MADE_UP_MOTOR_H

#include <math.h>
#include <string.h>

#include "hci/machine/frames.h"
#include "host/check/data/data.h"
#include "host/check/data/run_samples.h"
#include "support/draws.h"

enum { MOTOR_SAMPLES = 400 };

static const double MOTOR_p = 4.0, MOTOR_k_e = 0.1, MOTOR_R = 0.2, MOTOR_L_d = 1e-3, MOTOR_L_q = 2e-3,
                    MOTOR_speed = 50.0, MOTOR_i_d = -2.0, MOTOR_i_q = 10.0;

static check_run motor_run[2]; /* what `data` points to */

static inline double motor_torque_Nm(double i_d, double i_q)
{
    return 1.5 * (MOTOR_k_e * i_q + MOTOR_p * (MOTOR_L_d - MOTOR_L_q) * i_d * i_q);
}

/* Machine folder with all tables, and no recordings. */
static inline check_data motor_data(void)
{
    static double emf[] = {1.0, 0.1, 0.0}, cogging[] = {6.0, 0.05, 0.7};
    check_data data;
    memset(&data, 0, sizeof data);
    for (int k = 0; k < CHECK_VALUE_COUNT; ++k) {
        data.value[k] = NAN;
        data.cell[k].path = "machine.csv";
    }
    data.value[CHECK_pole_pairs] = MOTOR_p;
    data.value[CHECK_slots] = 24.0;
    data.value[CHECK_resistance_ohm] = MOTOR_R;
    data.value[CHECK_inductance_d_H] = MOTOR_L_d;
    data.value[CHECK_inductance_q_H] = MOTOR_L_q;
    data.value[CHECK_rated_current_A] = 10.0;
    data.value[CHECK_rated_torque_Nm] = 1.5;
    data.value[CHECK_rated_speed_rad_per_s] = MOTOR_speed;
    data.value[CHECK_dc_link_voltage_V] = 15.0;
    data.emf = (check_table){.count = 1, .order = &emf[0], .amplitude = &emf[1], .phase_rad = &emf[2]};
    data.emf.order_cell.path = data.emf.amplitude_cell.path = data.emf.phase_cell.path = "back_emf.csv";
    data.cogging =
        (check_table){.count = 1, .order = &cogging[0], .amplitude = &cogging[1], .phase_rad = &cogging[2]};
    data.cogging.most_phase_rad = cogging[2];
    data.cogging.order_cell.path = data.cogging.amplitude_cell.path = data.cogging.phase_cell.path =
        "cogging.csv";
    data.inductance = (check_inductance){
        .given = true, .are_slopes = true, .reluctance_Nm_per_A2 = 1.5 * MOTOR_p * (MOTOR_L_d - MOTOR_L_q)};
    data.inductance.cell.path = "inductance.csv";
    data.scales = CHECK_SCALES;
    for (int k = 0; k < CHECK_SCALES; ++k)
        data.scale[k] = (k % 3 == 0   ? 1.0
                         : k % 3 == 1 ? MOTOR_p
                                      : 0.5 * MOTOR_p) *
                        (k < 3   ? 1.0
                         : k < 6 ? REF_PI / 180.0
                         : k < 9 ? 2.0 * REF_PI
                                 : 180.0 / REF_PI);
    data.run = motor_run;
    return data;
}

/* Adds a recording of five mechanical turns: time, theta_m (or none), speed, three currents and voltages, and
 * the torque with its cogging. */
static inline void motor_record(check_data *data, double i_d, double i_q, bool with_angle)
{
    static double time[MOTOR_SAMPLES], theta[MOTOR_SAMPLES], speed[MOTOR_SAMPLES], torque[2][MOTOR_SAMPLES],
        angle[2][MOTOR_SAMPLES], i[3][MOTOR_SAMPLES], v[3][MOTOR_SAMPLES];
    static check_vector current[MOTOR_SAMPLES], voltage[MOTOR_SAMPLES];
    const double *const phase[] = {i[0], i[1], i[2]}, *const volt[] = {v[0], v[1], v[2]};
    const double reactance = MOTOR_p * MOTOR_speed;
    const hci_dq amperes = {.d = i_d, .q = i_q},
                 volts = {.d = MOTOR_R * i_d - reactance * MOTOR_L_q * i_q,
                          .q = MOTOR_R * i_q + reactance * MOTOR_L_d * i_d + MOTOR_k_e * MOTOR_speed};
    check_run *run = &motor_run[data->runs];
    memset(run, 0, sizeof *run);
    for (int k = 0; k < MOTOR_SAMPLES; ++k) {
        double x[3];
        theta[k] = 10.0 * REF_PI * k / MOTOR_SAMPLES;
        time[k] = theta[k] / MOTOR_speed;
        speed[k] = MOTOR_speed;
        torque[data->runs][k] = motor_torque_Nm(i_d, i_q) + 0.05 * sin(6.0 * MOTOR_p * theta[k] + 0.7);
        const hci_alpha_beta ab = hci_park_inverse(amperes, MOTOR_p * theta[k]),
                             uv = hci_park_inverse(volts, MOTOR_p * theta[k]);
        current[k] = (check_vector){ab.alpha, ab.beta};
        voltage[k] = (check_vector){uv.alpha, uv.beta};
        hci_clarke_inverse(ab, x);
        for (int s = 0; s < 3; ++s)
            i[s][k] = x[s];
        hci_clarke_inverse(uv, x);
        for (int s = 0; s < 3; ++s)
            v[s][k] = x[s];
    }
    memcpy(angle[data->runs], theta, sizeof theta);
    const check_samples samples = {.count = MOTOR_SAMPLES,
                                   .time = time,
                                   .theta = with_angle ? theta : NULL,
                                   .speed = speed,
                                   .torque = torque[data->runs],
                                   .phase = phase,
                                   .volt = volt,
                                   .current = current,
                                   .voltage = voltage};
    run->count = MOTOR_SAMPLES;
    run->has_abc = run->has_voltage = run->has_phase_voltage = true;
    run->current_cell.path = run->voltage_cell.path = run->torque_cell.path = run->speed_cell.path =
        "run.csv";
    run->time_cell.path = "run.csv";
    if (with_angle) run->theta_cell.path = "run.csv";
    hci_check_run_means(&samples, run);
    if (with_angle) hci_check_run_frames(data, &samples, run);
    run->theta = with_angle ? angle[data->runs] : NULL;
    run->torque = torque[data->runs];
    hci_check_run_ripple(run);
    data->no_current_A = 0.3;
    ++data->runs;
}

#endif
