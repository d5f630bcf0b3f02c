/* The rows of waveform.csv of a solution. */
#ifndef HCI_SRC_HOST_SAMPLES_WAVEFORM_ROWS_H
#define HCI_SRC_HOST_SAMPLES_WAVEFORM_ROWS_H

#include "hci/host/solve/solve.h"

#define HCI_WAVEFORM_NAMES "theta_e_rad,ia_A,ib_A,ic_A,id_A,iq_A,torque_Nm"
enum { HCI_WAVEFORM_COLUMNS = 7 };

/* Enough points to draw the highest order that flows or is made, at least one a degree. */
size_t hci_waveform_points_per_turn(const hci_solution *solution);

/* The row of one electrical angle. */
void hci_waveform_row(const hci_machine_data *machine, const hci_solution *solution, double theta_rad,
                      double row[HCI_WAVEFORM_COLUMNS]);

#endif
