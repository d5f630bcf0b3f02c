/* Where the current controllers of a motor get their references from. */
#ifndef CURRENT_REFERENCE_H
#define CURRENT_REFERENCE_H

#include <stdbool.h>
#include <stdint.h>

#include "hci/table.h"

/* Once at start-up. Do not run the motor when it says false. */
bool reference_good(void);

/* In the interrupt of the current controllers; angle as the tables have it, 2^32 per electrical turn. */
hci_currents_abc reference_abc(uint32_t angle);
hci_currents_dq reference_dq(uint32_t angle);
hci_currents_abc reference_torque(uint32_t angle, float torque_Nm);

#endif
