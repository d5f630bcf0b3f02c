/* From which speed on which orders are worth their voltage, where there is not enough of it for all. */
#ifndef HCI_SRC_HOST_DRIVE_VOLTAGE_FADE_H
#define HCI_SRC_HOST_DRIVE_VOLTAGE_FADE_H

#include "host/drive/sampled_run.h"

/* A voltage that is cut leaves some ripple, and an order that is left out leaves its own. At speeds above the
 * one up to which the voltage does, both are simulated, with all orders and with the lowest ones alone, and
 * those are kept that leave least, fewer with each speed. ranges: in, of the orders as the rest leaves them;
 * out, ended by that. from_rad_per_s: electrical, >= 0; to_rad_per_s: up to which is looked. direction: 1, or
 * -1 to turn backwards. The ranges of drive->loop are not read. */
void hci_voltage_fade(const hci_sampled_drive *drive, double from_rad_per_s, double to_rad_per_s,
                      int direction, hci_loop_range *ranges);

#endif
