/* hci_data.c of a controller, for fmu/controller.c, the emitted table beside it, and what its model
 * description says. */
#ifndef HCI_SRC_HOST_FMU_CONTROLLER_CODE_H
#define HCI_SRC_HOST_FMU_CONTROLLER_CODE_H

#include "fmu/controller_variables.h"
#include "hci/host/fmu/fmu.h"
#include "host/drive/machine_model.h"
#include "host/fmu/description.h"

/* To be released. */
typedef struct {
    const hci_fmu_request *request;
    hci_machine_model known; /* the machine as the decoupling knows it */
    char *table_h, *table_c; /* as `emit --drive` writes them */
    unsigned delay_steps;    /* from a sample to the use of its voltage */
    double start[HCI_FMU_CONTROLLER_COUNT];
    bool left_out[HCI_FMU_CONTROLLER_COUNT];
} hci_fmu_controller_model;

/* The names of those files among the sources of an FMU. */
#define HCI_FMU_TABLE_H "torque_table.h"
#define HCI_FMU_TABLE_C "torque_table.c"

/* machine: joined with the drive. HCI_ERROR_INPUT, _ARGUMENT, _OUTPUT, _MEMORY. */
hci_status hci_fmu_controller_make(const hci_fmu_request *request, const hci_machine_data *machine,
                                   hci_fmu_controller_model *model, hci_note *note);
void hci_fmu_controller_release(hci_fmu_controller_model *model);

/* list, start, choices and dependencies. */
void hci_fmu_controller_describe(const hci_fmu_controller_model *model, hci_fmu_description *description);

/* All of hci_data.c but for the token. */
void hci_fmu_controller_code(const hci_fmu_controller_model *model, hci_long_text *text);

#endif
