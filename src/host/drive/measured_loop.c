#include "host/drive/measured_loop.h"

#include <math.h>

#include "host/base/memory.h"
#include "host/currents/plain_sine.h"
#include "host/drive/response_curve.h"

static const double complex J = (double complex)I;

/* ---- from a measured answer to the controller ---- */

/* 1/(C H) at a measured frequency: (1/G − Fρ)/(R + jνL) of the current that flows, ρ(1/G − F)/(R + jνL) of
 * the samples; F the filter of the measured current, ρ what the samples read of the current at that
 * frequency. It changes by a share where G changes by 1 − FG times as much. */
static hci_curve_point point_of(const hci_drive_data *drive, const hci_machine_model *machine,
                                const hci_loop_point *p, int axis)
{
    const double nu = 2.0 * HCI_PI * p->frequency_Hz;
    const hci_loop_model model = hci_drive_loop(drive, machine, 0.0);
    const double complex filter = hci_loop_filter_at(&model, nu);
    const double complex inverse = cexp(-p->phase_rad[axis] * J) / p->gain[axis];
    const double complex read = hci_loop_sampling_at(&model, axis, nu);
    const bool of_samples = drive->response_of == HCI_RESPONSE_OF_SAMPLES;
    const double complex open = of_samples ? inverse - filter : inverse - filter * read;
    const double complex impedance = machine->resistance_ohm + nu * machine->inductance_H[axis] * J;
    return (hci_curve_point){nu, (of_samples ? read : 1.0) * open / impedance, cabs(open / inverse)};
}

/* ---- as a table ---- */

/* The points themselves where nothing better than straight lines was found. */
static size_t frequencies_of(const hci_response_curve curve[2], const hci_drive_data *drive,
                             double *rad_per_s)
{
    if (curve[0].kind != HCI_CURVE_STRAIGHT || curve[1].kind != HCI_CURVE_STRAIGHT)
        return hci_response_curve_grid(curve, hci_drive_highest_rad_per_s(drive), HCI_MEASURED_LOOP_MOST,
                                       rad_per_s);
    for (size_t k = 0; k < drive->response_count; ++k)
        rad_per_s[k] = curve[0].point[k].rad_per_s;
    return drive->response_count;
}

static void fill(const hci_response_curve curve[2], const double *rad_per_s, size_t count,
                 hci_loop_response *responses)
{
    for (size_t k = 0; k < count; ++k) {
        responses[k].frequency_rad_per_s = (float)rad_per_s[k];
        for (int a = 0; a < 2; ++a) {
            const double complex x = hci_response_curve_at(&curve[a], rad_per_s[k]);
            responses[k].re[a] = (float)creal(x);
            responses[k].im[a] = (float)cimag(x);
        }
    }
}

hci_status hci_measured_loop_make(const hci_drive_data *drive, const hci_machine_model *machine,
                                  hci_loop_response **responses, size_t *count, double error[2],
                                  hci_note *note)
{
    const size_t n = drive->response_count, most = n > HCI_MEASURED_LOOP_MOST ? n : HCI_MEASURED_LOOP_MOST;
    hci_curve_point *point = hci_memory_new(2 * n, sizeof *point);
    double *rad_per_s = hci_memory_new(most, sizeof *rad_per_s);
    *responses = hci_memory_new(most, sizeof **responses);
    const bool is_there = point && rad_per_s && *responses;
    if (is_there) {
        hci_response_curve curve[2];
        for (int a = 0; a < 2; ++a) {
            for (size_t k = 0; k < n; ++k)
                point[(size_t)a * n + k] = point_of(drive, machine, &drive->response[k], a);
            curve[a] = hci_response_curve_of(point + (size_t)a * n, n, drive->sample_s);
            error[a] = curve[a].error;
        }
        *count = frequencies_of(curve, drive, rad_per_s);
        fill(curve, rad_per_s, *count, *responses);
    }
    hci_memory_free(point);
    hci_memory_free(rad_per_s);
    return is_there ? HCI_OK : hci_note_memory(note, NULL, "%zu frequencies", n);
}

/* ---- what it leaves ---- */

static double complex number(hci_loop_pair x)
{
    return (double)x.c - J * (double)x.s;
}

/* Current that an axis misses in an order for each share that G is off, A: what is added to F i* is V/(C H),
 * of which the loop makes G V/(C H), and of 1/(C H) a share is off that is larger by 1/(1 − FG): V/(R + jνL).
 */
static double missed_A(const hci_loop_f32 *loop, const hci_loop_order *order, const hci_loop_wave *wave,
                       int axis, double speed_rad_per_s)
{
    const double nu = (double)order->nu_rad_per_s, ohm = (double)loop->resistance_ohm;
    const double complex late = (double)order->ahead_re - J * (double)order->ahead_im;
    const double complex lacks =
        ohm * number(wave->current_A[axis]) +
        speed_rad_per_s * (number(wave->voltage_Vs[axis]) - late * number(wave->own_Vs[axis]));
    return cabs(lacks / (ohm + nu * (double)loop->inductance_H[axis] * J));
}

double hci_measured_loop_swing_Nm(const hci_loop_f32 *loop, const hci_machine *machine, const double error[2],
                                  uint32_t level, double speed_rad_per_s)
{
    const hci_loop_wave *mean = &loop->waves[level];
    const hci_wave sine = hci_plain_sine(machine, 1.0);
    const double square = sine.sine * sine.sine + sine.cosine * sine.cosine;
    const double torque_per_iq = square > 0.0 ? 1.0 / sqrt(square) : 0.0; /* N·m/A */
    const double reluctance =
        1.5 * machine->pole_pairs * (double)(loop->inductance_H[0] - loop->inductance_H[1]);
    const double per_A[2] = {fabs(reluctance * (double)mean->current_A[1].c),
                             fabs(torque_per_iq + reluctance * (double)mean->current_A[0].c)};
    double swing_Nm = 0.0;
    for (uint32_t k = 1; k < loop->order_count; ++k) {
        const hci_loop_order order = hci_loop_order_at(loop, k, (float)speed_rad_per_s);
        for (int a = 0; a < 2; ++a)
            swing_Nm += 2.0 * (double)order.share * per_A[a] * error[a] *
                        missed_A(loop, &order, &loop->waves[k * loop->levels + level], a, speed_rad_per_s);
    }
    return swing_Nm;
}
