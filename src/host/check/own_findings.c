#include "host/check/own_findings.h"

#include "host/check/own_parts.h"

void hci_check_own_findings(const check_posterior *p, hci_check *check)
{
    hci_check_add_moved(p, check);
    hci_check_add_sequence(p->data, check);
    hci_check_add_scale(p->data, check);
    hci_check_add_constant(p->data, check);
    hci_check_add_dead_torque(p->data, check);
    hci_check_add_channel(p->data, check);
    hci_check_add_standing_currents(p->data, check);
    hci_check_add_exchanged_currents(p->data, check);
    hci_check_add_exchanged(p->data, check);
}
