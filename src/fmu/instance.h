/* An instance of an FMU: its model, and all that both versions of FMI share. */
#ifndef HCI_SRC_FMU_INSTANCE_H
#define HCI_SRC_FMU_INSTANCE_H

#include <stddef.h>
#include <stdint.h>

#include "fmu/model.h"

/* With the numbers of fmi2Status and fmi3Status. */
typedef enum {
    HCI_FMU_OK,
    HCI_FMU_DISCARD = 2, /* nothing was done, and the simulation may go on */
    HCI_FMU_ERROR = 3
} hci_fmu_status;

/* What an instance of either version begins with. Start with {0}, and fill the last two in. */
typedef struct hci_fmu_instance {
    hci_fmu_model *model;
    double time_s; /* up to which it has come */
    bool logs;     /* says why it discards; errors are always said */
    void (*say)(const struct hci_fmu_instance *instance, hci_fmu_status status, const char *words);
} hci_fmu_instance;

/* An error, if there are words. */
hci_fmu_status hci_fmu_tell(const hci_fmu_instance *instance, const char *words);

/* Whatever this FMU does not have: fine where nothing is asked of it. */
hci_fmu_status hci_fmu_none(const hci_fmu_instance *instance, size_t asked);

/* Makes the model, unless the words say what is wrong, or the token is that of another description. */
hci_fmu_status hci_fmu_open(hci_fmu_instance *instance, const char *token, const char *words);
/* Frees the model. */
void hci_fmu_close(hci_fmu_instance *instance);

/* The initialization ends. */
hci_fmu_status hci_fmu_begin(hci_fmu_instance *instance);
/* Back to before that, and to the start values. */
hci_fmu_status hci_fmu_reset(hci_fmu_instance *instance);
hci_fmu_status hci_fmu_do_step(hci_fmu_instance *instance, double from_s, double duration_s);

/* Values by reference, of one type; the reference behind those of the list is the time. Set is all or
 * nothing. */
hci_fmu_status hci_fmu_get(hci_fmu_instance *instance, hci_fmu_type type, const uint32_t *reference,
                           size_t count, double *value);
hci_fmu_status hci_fmu_set(hci_fmu_instance *instance, hci_fmu_type type, const uint32_t *reference,
                           size_t count, const double *value);

/* Functions get_NAME and set_NAME for values of an integer or truth type of C. */
#define HCI_FMU_WHOLE(name, c_type)                                                                          \
    static hci_fmu_status get_##name(hci_fmu_instance *x, hci_fmu_type type, const uint32_t *reference,      \
                                     size_t count, c_type *value)                                            \
    {                                                                                                        \
        hci_fmu_status status = HCI_FMU_OK;                                                                  \
        for (size_t k = 0; k < count && !status; ++k) {                                                      \
            double number = 0.0;                                                                             \
            status = hci_fmu_get(x, type, &reference[k], 1, &number);                                        \
            value[k] = (c_type)number;                                                                       \
        }                                                                                                    \
        return status;                                                                                       \
    }                                                                                                        \
    static hci_fmu_status set_##name(hci_fmu_instance *x, hci_fmu_type type, const uint32_t *reference,      \
                                     size_t count, const c_type *value)                                      \
    {                                                                                                        \
        hci_fmu_status status = HCI_FMU_OK;                                                                  \
        for (size_t k = 0; k < count && !status; ++k) {                                                      \
            const double number = (double)value[k];                                                          \
            status = hci_fmu_set(x, type, &reference[k], 1, &number);                                        \
        }                                                                                                    \
        return status;                                                                                       \
    }

/* Takes a state; *state: one that was taken before, whose memory is used again, or NULL. */
hci_fmu_status hci_fmu_take(const hci_fmu_instance *instance, void **state);
hci_fmu_status hci_fmu_return(hci_fmu_instance *instance, const void *state);
void hci_fmu_drop(void **state);

/* The same state as bytes, which another instance may take. */
hci_fmu_status hci_fmu_bytes_size(const hci_fmu_instance *instance, const void *state, size_t *size);
hci_fmu_status hci_fmu_to_bytes(const hci_fmu_instance *instance, const void *state, void *bytes,
                                size_t size);
hci_fmu_status hci_fmu_from_bytes(const hci_fmu_instance *instance, const void *bytes, size_t size,
                                  void **state);

#endif
