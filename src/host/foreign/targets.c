/* The list of targets, one file each. */
#include "host/foreign/map.h"

const hci_foreign_type *const hci_foreign_types[HCI_FOREIGN_TARGET_COUNT] = {
    [HCI_FOREIGN_SIMPLEFOC] = &hci_foreign_simplefoc,
    [HCI_FOREIGN_MCSDK] = &hci_foreign_mcsdk,
    [HCI_FOREIGN_MOTEUS] = &hci_foreign_moteus,
    [HCI_FOREIGN_NOVANTA] = &hci_foreign_novanta,
    [HCI_FOREIGN_BECKHOFF] = &hci_foreign_beckhoff,
    [HCI_FOREIGN_OPENFFBOARD] = &hci_foreign_openffboard,
    [HCI_FOREIGN_CSV] = &hci_foreign_csv,
};

const char *hci_foreign_word(hci_foreign_name name)
{
    return hci_foreign_types[name]->word;
}

bool hci_foreign_is_torque(hci_foreign_name name)
{
    return hci_foreign_types[name]->kind == HCI_FOREIGN_TORQUE;
}
