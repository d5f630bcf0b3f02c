/* modelDescription.xml of an FMU. */
#ifndef HCI_SRC_HOST_FMU_DESCRIPTION_H
#define HCI_SRC_HOST_FMU_DESCRIPTION_H

#include <stdbool.h>
#include <stddef.h>

#include "fmu/variable.h"
#include "host/fmu/long_text.h"

/* What is said of a model. Texts and arrays are the caller's. */
typedef struct hci_fmu_description {
    const char *identifier; /* a C identifier */
    const char *name;       /* for people */
    const char *what;       /* one sentence */
    const char *token;
    const hci_fmu_variable *list;
    size_t count;
    const double *start;  /* of each variable */
    const bool *left_out; /* variables that this model does not have */
    int choices;          /* an integer is one of 1 … choices */
    bool (*feeds)(const void *context, size_t input, size_t output); /* whether it acts at once */
    const void *context;
    double step_s; /* of communication, to begin with */
    const char *const *sources;
    size_t source_count;
} hci_fmu_description;

/* The text of the standard's version. Memory out: text->failed. */
void hci_fmu_describe_2(const hci_fmu_description *d, hci_long_text *text);
void hci_fmu_describe_3(const hci_fmu_description *d, hci_long_text *text);

/* sources/buildDescription.xml of FMI 3. */
void hci_fmu_describe_build(const hci_fmu_description *d, hci_long_text *text);

#endif
