/* Where the current controllers of a motor get their references from: integers throughout. */
#ifndef CURRENT_REFERENCE_H
#define CURRENT_REFERENCE_H

#include <stdbool.h>
#include <stdint.h>

#include "hci/table_i16.h"

/* Once at start-up, while the rotor is held at half an electrical turn by a current of phase a: i_a = I, i_b
 * = i_c = −I/2. Do not run the motor when it says false. */
bool reference_start(uint16_t encoder_count);

/* In the interrupt of the current controllers: a free-running 16-bit counter of an encoder, the torque as a
 * share of the table's reference (32767 for all of it), and whether the motor is enabled. Units of the
 * table's unit_A. */
hci_units_abc reference_next(uint16_t encoder_count, int16_t torque_q15, bool enabled);

#endif
