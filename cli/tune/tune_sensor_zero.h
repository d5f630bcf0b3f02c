/* The zero of a torque sensor that nobody tared. */
#ifndef HCI_CLI_TUNE_SENSOR_ZERO_H
#define HCI_CLI_TUNE_SENSOR_ZERO_H

#include "cli/tune/tune_steps.h"

/* Where a torque without current drives the shaft on average in the one direction that was recorded, and no
 * other torque was measured, declares that mean as the offset of the sensor in the machine's effects.csv: a
 * friction that drives explains nothing, and beside a mean that nothing explains no ripple is found. Sets
 * has_sensor_zero. HCI_ERROR_OUTPUT, _MEMORY. */
hci_status cli_tune_take_sensor_zero(cli_tuning *tune, hci_note *note);

#endif
