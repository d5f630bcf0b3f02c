/* Parts of hci_data.c: constants as C. */
#ifndef HCI_SRC_HOST_FMU_DATA_CODE_H
#define HCI_SRC_HOST_FMU_DATA_CODE_H

#include "hci/drive/plant.h"
#include "host/fmu/long_text.h"

/* `static const hci_wave PREFIX_BACK_EMF[]`, _COGGING, _SLOPE and _INDUCTANCE, those that are not empty. */
void hci_fmu_code_arrays(const char *prefix, const hci_machine *machine,
                         const hci_plant_inductance *inductance, hci_long_text *text);

/* Initialisers `{...}` of an hci_machine and of an hci_plant_inductance with these arrays. */
void hci_fmu_code_machine(const char *prefix, const hci_machine *machine, hci_long_text *text);
void hci_fmu_code_inductance(const char *prefix, const hci_plant_inductance *inductance, hci_long_text *text);

/* `const double hci_fmu_start[]`. */
void hci_fmu_code_start(const double *start, size_t count, hci_long_text *text);

#endif
