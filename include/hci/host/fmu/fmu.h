/* A machine or its controller as an FMU (Functional Mock-up Unit, fmi-standard.org) for co-simulation: a
 * model description, sources, and a binary of them. */
#ifndef HCI_HOST_FMU_FMU_H
#define HCI_HOST_FMU_FMU_H

#include "hci/host/drive/drive.h"
#include "hci/host/machine/effects.h"
#include "hci/host/machine/machine.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Compiles sources to a shared library. context: as given. folder: where all files lie, without folders in
 * it. sources: names of the .c files, count of them. library: name of the result in that folder. */
typedef hci_status hci_fmu_compile(void *context, const char *folder, const char *const *sources,
                                   size_t count, const char *library, hci_note *note);

/* What is asked for. Start with {0}; the arrays and strings belong to the caller. */
typedef struct {
    int fmi_version;                 /* 2 or 3 */
    const hci_machine_data *machine; /* as read */
    const hci_effects *effects;      /* of the machine; NULL: none */
    bool imposed;                    /* its inputs are currents, not voltages */
    hci_drive_data *drive;           /* as read, or NULL; its defaults are filled in. Of a machine: the dead
                                        time of its inverter, and what machine.csv does not have */
    const hci_loop_level *levels;    /* of torque, as of hci_emit_loop: a controller with their table, which
                                        needs drive; NULL with count 0: the machine */
    size_t level_count;              /* entries of levels */
    hci_fmu_compile *compile;        /* NULL: without a binary */
    void *compile_context;           /* first argument of compile */
    const char *work_folder;         /* empty, for temporary files */
} hci_fmu_request;

/* What was made. */
typedef struct {
    char identifier[HCI_MACHINE_NAME + 24]; /* of the model: a C identifier */
    int fmi_version;                        /* 2 or 3 */
    size_t inputs, outputs, parameters;     /* how many variables */
    size_t effects;                         /* that the machine has */
    size_t sources;                         /* files in the folder sources */
    size_t binary_bytes;                    /* 0: without a binary */
    size_t bytes;                           /* of the FMU */
    hci_note remark;                        /* what a reader should know, or "" */
} hci_fmu_result;

/* Writes the FMU to a file, whole or not at all; same request and compiler, same bytes. HCI_ERROR_INPUT,
 * _ARGUMENT, _MEMORY, _OUTPUT, with a note. */
hci_status hci_fmu_export(const char *path, const hci_fmu_request *request, hci_fmu_result *result,
                          hci_note *note);

/* What was made of a request, as JSON: to be freed with hci_text_free; NULL when memory is out. */
char *hci_fmu_json(const hci_fmu_result *result);

#ifdef __cplusplus
}
#endif

#endif
