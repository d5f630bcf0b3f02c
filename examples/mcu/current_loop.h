/* References that follow the torque and are read ahead by the delay of the current loop. */
#ifndef CURRENT_LOOP_H
#define CURRENT_LOOP_H

#include <stdbool.h>

#include "hci/loop.h"

/* Once at start-up. Do not run the motor when it says false. */
bool current_loop_start(void);

/* In the interrupt of the current controllers: angle of the sample, 2^32 per electrical turn, and electrical
 * speed. The torque is limited to that of the table, and the currents' vector to the most that the inverter
 * may carry. */
hci_currents_dq current_loop_reference(uint32_t angle, float torque_Nm, float speed_rad_per_s);

#endif
