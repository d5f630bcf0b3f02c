#include "fmu/instance.h"

#include <stdlib.h>
#include <string.h>

static const char *check(hci_fmu_type type, uint32_t reference)
{
    if (reference >= hci_fmu_count) return "a value reference that the model description does not have";
    if (hci_fmu_list[reference].type != type) return "a value reference of another type";
    return NULL;
}

const char *hci_fmu_get(hci_fmu_model *model, hci_fmu_type type, const uint32_t *reference, size_t count,
                        double *value)
{
    const char *words = hci_fmu_update(model);
    const double *values = hci_fmu_values(model);
    for (size_t k = 0; k < count && !words; ++k) {
        words = check(type, reference[k]);
        if (!words) value[k] = values[reference[k]];
    }
    return words;
}

const char *hci_fmu_set(hci_fmu_model *model, hci_fmu_type type, const uint32_t *reference, size_t count,
                        const double *value)
{
    const char *words = NULL;
    for (size_t k = 0; k < count && !words; ++k) {
        words = check(type, reference[k]);
        if (words) continue;
        const hci_fmu_causality causality = hci_fmu_list[reference[k]].causality;
        if (causality == HCI_FMU_OUTPUT) words = "an output cannot be set";
        if (causality == HCI_FMU_PARAMETER && hci_fmu_has_begun(model))
            words = "parameters are fixed: set them before the initialization ends";
        if (!words) hci_fmu_values(model)[reference[k]] = value[k];
    }
    return words;
}

/* ---- states ---- */

static hci_fmu_saved *new_saved(hci_fmu_saved *old, size_t size)
{
    hci_fmu_saved *saved = realloc(old, sizeof *saved + size);
    if (saved) saved->size = size;
    return saved;
}

const char *hci_fmu_take(const hci_fmu_model *model, hci_fmu_saved **saved)
{
    hci_fmu_saved *s = new_saved(*saved, hci_fmu_state_size(model));
    if (!s) return "memory is out";
    hci_fmu_state_save(model, s + 1);
    *saved = s;
    return NULL;
}

const char *hci_fmu_return(hci_fmu_model *model, const hci_fmu_saved *saved)
{
    return saved ? hci_fmu_state_load(model, saved + 1, saved->size) : "no state was given";
}

const void *hci_fmu_bytes(const hci_fmu_saved *saved)
{
    return saved + 1;
}

const char *hci_fmu_from_bytes(const void *bytes, size_t size, hci_fmu_saved **saved)
{
    hci_fmu_saved *s = new_saved(*saved, size);
    if (!s) return "memory is out";
    memcpy(s + 1, bytes, size);
    *saved = s;
    return NULL;
}
