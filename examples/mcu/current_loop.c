#include "current_loop.h"

#include "currents_drive.h"
#include "hci/guard.h"

static const float MOST_A = 40.0f;

static float memory[currents_drive_FLOATS];
static hci_loop_tables tables;

bool current_loop_start(void)
{
    if (hci_loop_check(&currents_drive) != HCI_TABLE_GOOD) return false;
    hci_loop_start(&tables, &currents_drive, HCI_LOOP_LEAD, memory);
    hci_loop_make(&tables, 0.0f);
    return true;
}

hci_currents_dq current_loop_reference(uint32_t angle, float torque_Nm, float speed_rad_per_s)
{
    const hci_loop_reference r = hci_loop_at(&tables, angle, torque_Nm, speed_rad_per_s);
    const hci_currents_dq i = {r.id_A, r.iq_A};
    return hci_guard_dq(i, MOST_A);
}
