/* The variables of an FMU, as the model description lists them and the model keeps them. */
#ifndef HCI_SRC_FMU_VARIABLE_H
#define HCI_SRC_FMU_VARIABLE_H

/* How a value is read and set; all are kept as double. */
typedef enum { HCI_FMU_REAL, HCI_FMU_BOOLEAN, HCI_FMU_INTEGER } hci_fmu_type;

typedef enum {
    HCI_FMU_PARAMETER, /* set before the initialization ends */
    HCI_FMU_INPUT,
    HCI_FMU_OUTPUT
} hci_fmu_causality;

/* Its value reference is its place in the list of its model. */
typedef struct {
    const char *name;
    hci_fmu_type type;
    hci_fmu_causality causality;
    const char *unit; /* "" for none */
    const char *description;
} hci_fmu_variable;

/* Entries of the lists X(KEY, name, type, causality, unit, description). */
#define HCI_FMU_ENTRY(key, name, type, causality, unit, description)                                         \
    {name, HCI_FMU_##type, HCI_FMU_##causality, unit, description},

#endif
