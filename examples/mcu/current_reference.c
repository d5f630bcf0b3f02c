#include "current_reference.h"

#include "currents_abc.h"
#include "currents_dq.h"
#include "currents_torque.h"

bool reference_good(void)
{
    return hci_table_f32_check(&currents_abc) == HCI_TABLE_GOOD &&
           hci_table_f32_check(&currents_dq) == HCI_TABLE_GOOD &&
           hci_table_f32_check(&currents_torque) == HCI_TABLE_GOOD;
}

hci_currents_abc reference_abc(uint32_t angle)
{
    return hci_table_f32_abc(&currents_abc, angle);
}

hci_currents_dq reference_dq(uint32_t angle)
{
    return hci_table_f32_dq(&currents_dq, angle);
}

hci_currents_abc reference_torque(uint32_t angle, float torque_Nm)
{
    return hci_table_f32_abc_torque(&currents_torque, angle, torque_Nm);
}
