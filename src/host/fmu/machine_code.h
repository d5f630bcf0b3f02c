/* hci_data.c of a machine, for fmu/machine.c, and what its model description says. */
#ifndef HCI_SRC_HOST_FMU_MACHINE_CODE_H
#define HCI_SRC_HOST_FMU_MACHINE_CODE_H

#include "fmu/machine_variables.h"
#include "hci/host/fmu/fmu.h"
#include "host/fmu/description.h"
#include "host/simulate/simulation.h"

/* To be released. */
typedef struct {
    const hci_fmu_request *request;
    const hci_machine_data *machine; /* joined with the drive */
    double step_s;                   /* internal, to begin with */
    hci_setup setup; /* of a simulated drive with this machine: plant, table, and the effects on both */
    double start[HCI_FMU_MACHINE_COUNT];
    bool left_out[HCI_FMU_MACHINE_COUNT];
} hci_fmu_machine_model;

/* machine: joined with the drive. HCI_ERROR_INPUT where the machine lacks what the model needs,
 * HCI_ERROR_MEMORY. Not to be moved. */
hci_status hci_fmu_machine_make(const hci_fmu_request *request, const hci_machine_data *machine,
                                hci_fmu_machine_model *model, hci_note *note);
void hci_fmu_machine_release(hci_fmu_machine_model *model);

/* list, start, left_out and dependencies. */
void hci_fmu_machine_describe(const hci_fmu_machine_model *model, hci_fmu_description *description);

/* All of hci_data.c but for the token. */
void hci_fmu_machine_code(const hci_fmu_machine_model *model, hci_long_text *text);

#endif
