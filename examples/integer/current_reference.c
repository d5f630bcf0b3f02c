#include "current_reference.h"

#include "hci/counter.h"
#include "hci/guard.h"
#include "smooth.h"

enum { COUNTS_PER_TURN = 4000, MOST_UNITS = 30000, RISE_SAMPLES = 5000 };

static hci_counter encoder;
static uint32_t rise; /* samples since it was enabled */

bool reference_start(uint16_t encoder_count)
{
    hci_counter_start(&encoder, hci_counter_range(16u), COUNTS_PER_TURN, 1, encoder_count);
    hci_counter_align(&encoder, 0x80000000u, smooth_POLE_PAIRS);
    rise = 0u;
    return hci_table_i16_check(&smooth) == HCI_TABLE_GOOD;
}

hci_units_abc reference_next(uint16_t encoder_count, int16_t torque_q15, bool enabled)
{
    const uint32_t rotor = hci_counter_angle(&encoder, encoder_count);
    const uint32_t angle = hci_angle_from_mechanical(rotor, smooth_PERIODS);
    hci_units_abc i = hci_table_i16_abc_torque_q15(&smooth, angle, torque_q15);
    if (enabled && rise < RISE_SAMPLES) ++rise;
    if (!enabled && rise > 0u) --rise;
    if (rise < RISE_SAMPLES) {
        const uint32_t share = (rise << 15) / RISE_SAMPLES;
        i.ia = hci_guard_scaled(i.ia, share);
        i.ib = hci_guard_scaled(i.ib, share);
        i.ic = hci_guard_scaled(i.ic, share);
    }
    return hci_guard_units_abc(i, MOST_UNITS);
}
