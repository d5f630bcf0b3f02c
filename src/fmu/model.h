/* What FMI needs of a model. An FMU has one, machine.c or controller.c, and the data of one machine, which
 * `hci-solve export-fmu` wrote into hci_data.c. */
#ifndef HCI_SRC_FMU_MODEL_H
#define HCI_SRC_FMU_MODEL_H

#include <stdbool.h>
#include <stddef.h>

#include "fmu/variable.h"

/* ---- hci_data.c ---- */

extern const char hci_fmu_token[];   /* GUID of FMI 2, instantiation token of FMI 3 */
extern const double hci_fmu_start[]; /* of each variable; of outputs not used */

/* ---- the model ---- */

enum { HCI_FMU_MOST_VARIABLES = 48, HCI_FMU_WORDS_SIZE = 200 };

/* What every model begins with. */
typedef struct {
    double value[HCI_FMU_MOST_VARIABLES]; /* inputs act from the next step on, parameters from the start on */
    bool has_begun;                       /* the initialization has ended */
    char words[HCI_FMU_WORDS_SIZE];       /* room for what is wrong */
} hci_fmu_head;

typedef struct hci_fmu_model hci_fmu_model;

extern const hci_fmu_variable hci_fmu_list[];
extern const size_t hci_fmu_count;      /* entries of hci_fmu_list */
extern const size_t hci_fmu_model_size; /* bytes of a hci_fmu_model */

/* Its memory; of a model that is all zero but for its values. False: memory is out. */
bool hci_fmu_make(hci_fmu_model *model);
/* Frees that memory. */
void hci_fmu_release(hci_fmu_model *model);

/* All of these return NULL, or in words what is wrong. */

/* With the values as they are now. */
const char *hci_fmu_to_initial_state(hci_fmu_model *model);
/* Moves on by a time; the inputs are held. */
const char *hci_fmu_step(hci_fmu_model *model, double duration_s);
/* Makes the outputs those of the present state and inputs; the initialization has ended. */
const char *hci_fmu_update(hci_fmu_model *model);

/* The state besides the head: its bytes, its copy to memory, and back into a model with the same values. */
size_t hci_fmu_state_size(const hci_fmu_model *model);
void hci_fmu_state_save(const hci_fmu_model *model, void *memory);
const char *hci_fmu_state_load(hci_fmu_model *model, const void *memory, size_t size);

#endif
