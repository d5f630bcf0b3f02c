/* loop.csv as hci/loop.h takes it, and what it does not tell. */
#ifndef HCI_SRC_HOST_DRIVE_MEASURED_LOOP_H
#define HCI_SRC_HOST_DRIVE_MEASURED_LOOP_H

#include "hci/loop.h"
#include "host/drive/machine_model.h"

enum { HCI_MEASURED_LOOP_MOST = 256 };

/* The responses of a fitted drive that was measured. error: out, of d and q, what the points tell of one
 * another (hci_response_curve). responses: out, count of them, to be freed with hci_memory_free.
 * HCI_ERROR_MEMORY. */
hci_status hci_measured_loop_make(const hci_drive_data *drive, const hci_machine_model *machine,
                                  hci_loop_response **responses, size_t *count, double error[2],
                                  hci_note *note);

/* Swing of the torque, peak to peak, that is left with HCI_LOOP_COMPENSATION where the measured answer is off
 * by `error` at all frequencies and all orders add up: the currents that are then missed, by the fundamental
 * of the back-EMF and L_d − L_q. level: of the torque. speed: electrical. */
double hci_measured_loop_swing_Nm(const hci_loop_f32 *loop, const hci_machine *machine, const double error[2],
                                  uint32_t level, double speed_rad_per_s);

#endif
