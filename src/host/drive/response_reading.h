/* A measured response beside that of the gains: how far off it is, and which slip would explain that. */
#ifndef HCI_SRC_HOST_DRIVE_RESPONSE_READING_H
#define HCI_SRC_HOST_DRIVE_RESPONSE_READING_H

#include "hci/host/drive/drive_facts.h"
#include "host/drive/loop_model.h"

/* Fills the facts of the response of a fitted drive; m: its loop at standstill. */
void hci_response_compare(const hci_drive_data *drive, const hci_loop_model *m, hci_drive_facts *facts);

#endif
