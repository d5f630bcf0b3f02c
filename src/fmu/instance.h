/* An instance of an FMU: its model, and the rules that both versions of FMI share. */
#ifndef HCI_SRC_FMU_INSTANCE_H
#define HCI_SRC_FMU_INSTANCE_H

#include <stddef.h>
#include <stdint.h>

#include "fmu/model.h"

/* A state that was taken; its bytes follow it. */
typedef struct {
    size_t size;
} hci_fmu_saved;

/* All of these return NULL, or in words what is wrong. */

/* Values by reference, of one type. */
const char *hci_fmu_get(hci_fmu_model *model, hci_fmu_type type, const uint32_t *reference, size_t count,
                        double *value);
const char *hci_fmu_set(hci_fmu_model *model, hci_fmu_type type, const uint32_t *reference, size_t count,
                        const double *value);

/* Takes a state; *saved: one that was taken before, whose memory is used again, or NULL. */
const char *hci_fmu_take(const hci_fmu_model *model, hci_fmu_saved **saved);
const char *hci_fmu_return(hci_fmu_model *model, const hci_fmu_saved *saved);

/* A state as bytes: those that hci_fmu_bytes points to. */
const void *hci_fmu_bytes(const hci_fmu_saved *saved);
const char *hci_fmu_from_bytes(const void *bytes, size_t size, hci_fmu_saved **saved);

#endif
