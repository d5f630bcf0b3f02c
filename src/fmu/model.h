/* What fmi2.c and fmi3.c need of a model. An FMU has one model, machine.c or controller.c, and the data of
 * one machine, which `hci-solve export-fmu` wrote into hci_data.c. */
#ifndef HCI_SRC_FMU_MODEL_H
#define HCI_SRC_FMU_MODEL_H

#include <stdbool.h>
#include <stddef.h>

#include "fmu/variable.h"

/* ---- hci_data.c ---- */

extern const char hci_fmu_token[];   /* GUID of FMI 2, instantiation token of FMI 3 */
extern const double hci_fmu_start[]; /* of each variable; of outputs not used */

/* ---- the model ---- */

extern const hci_fmu_variable hci_fmu_list[];
extern const size_t hci_fmu_count; /* entries of hci_fmu_list */

typedef struct hci_fmu_model hci_fmu_model;

/* With the start values; NULL when memory is out. */
hci_fmu_model *hci_fmu_new(void);
void hci_fmu_free(hci_fmu_model *model);

/* The value of each variable. What is set acts from the next step on, of a parameter from the start on. */
double *hci_fmu_values(hci_fmu_model *model);

/* Whether hci_fmu_begin was called. */
bool hci_fmu_has_begun(const hci_fmu_model *model);

/* All of these return NULL, or in words what is wrong. */

/* To the initial state, with the parameters as they are now. */
const char *hci_fmu_begin(hci_fmu_model *model);
/* Back to before hci_fmu_begin, and to the start values. */
void hci_fmu_reset(hci_fmu_model *model);
/* Moves on by a time; the inputs are held. */
const char *hci_fmu_step(hci_fmu_model *model, double duration_s);
/* Makes the outputs those of the present state and inputs. */
const char *hci_fmu_update(hci_fmu_model *model);

/* Bytes of a whole state, and its copy to memory and back, also into another instance of the FMU. */
size_t hci_fmu_state_size(const hci_fmu_model *model);
void hci_fmu_state_save(const hci_fmu_model *model, void *memory);
const char *hci_fmu_state_load(hci_fmu_model *model, const void *memory, size_t size);

#endif
