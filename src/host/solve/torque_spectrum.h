/* The true torque of given currents, order by order. */
#ifndef HCI_SRC_HOST_SOLVE_TORQUE_SPECTRUM_H
#define HCI_SRC_HOST_SOLVE_TORQUE_SPECTRUM_H

#include "host/machine/torque_gradient.h"
#include "host/solve/task.h"

/* Star waves that belong to somebody else. */
typedef struct {
    const hci_wave *wave;
    size_t count;
} hci_wave_view;

/* Torque of two currents at the same orders: 0, what either makes, what is wanted, and what cogging has. */
typedef struct {
    double *order; /* ascending */
    size_t count;
    hci_harmonic *first, *second; /* count each; second NULL where there is no second current */
} hci_torque_spectra;

/* second: may have no waves. *spectra is to be released in any case. HCI_ERROR_MEMORY. */
hci_status hci_torque_spectra_make(const hci_task *task, hci_wave_view first, hci_wave_view second,
                                   hci_torque_spectra *spectra, hci_note *note);
void hci_torque_spectra_release(hci_torque_spectra *spectra);

/* The same for one current. *torque: out, to be freed with hci_memory_free; on failure empty. */
hci_status hci_torque_spectrum_evaluate(const hci_task *task, const hci_wave *wave, size_t count,
                                        hci_harmonic_list *torque, hci_note *note);

/* Weighted error of a torque: the largest peak amplitude at any order, and the sum of all squares in (N·m)².
 */
typedef struct {
    double worst_Nm, square_sum;
} hci_torque_error;

hci_status hci_torque_error_evaluate(const hci_task *task, const hci_wave *wave, size_t count,
                                     hci_torque_error *error, hci_note *note);

/* *swing_Nm: out, max − min over `turns` electrical turns, in which all orders are whole, ascending.
 * HCI_ERROR_MEMORY. */
hci_status hci_torque_swing(const hci_harmonic_list *torque, size_t turns, double *swing_Nm, hci_note *note);

/* 100 value/|mean|; NAN without a mean. */
double hci_percent_of_mean(double value_Nm, double mean_Nm);

/* |a − b| as a peak amplitude. */
double hci_torque_distance_Nm(hci_harmonic a, hci_harmonic b);

#endif
