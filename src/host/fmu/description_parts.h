/* What the model descriptions of FMI 2 and 3 share. */
#ifndef HCI_SRC_HOST_FMU_DESCRIPTION_PARTS_H
#define HCI_SRC_HOST_FMU_DESCRIPTION_PARTS_H

#include "host/fmu/description.h"

/* ` name="value"`, with the letters escaped that XML needs. */
void hci_fmu_attribute(hci_long_text *text, const char *name, const char *value);

/* From the first line to the attributes of CoSimulation; token: the name that the version has for it; more:
 * attributes that it has besides. */
void hci_fmu_head(const hci_fmu_description *d, int version, const char *token, const char *more,
                  hci_long_text *text);

/* unit, range and start of a variable, as far as it has them. */
void hci_fmu_value_attributes(const hci_fmu_description *d, size_t variable, hci_long_text *text);

/* UnitDefinitions; times: the second is among them. */
void hci_fmu_units(const hci_fmu_description *d, hci_long_text *text);

/* LogCategories and DefaultExperiment. */
void hci_fmu_experiment(const hci_fmu_description *d, hci_long_text *text);

/* causality, variability and initial of a variable. */
void hci_fmu_causality_attributes(const hci_fmu_variable *variable, hci_long_text *text);

/* ` dependencies="..."` of an output: what `reference` makes of each input that acts at once. */
void hci_fmu_dependencies(const hci_fmu_description *d, size_t output,
                          size_t (*reference)(const hci_fmu_description *, size_t), hci_long_text *text);

#endif
