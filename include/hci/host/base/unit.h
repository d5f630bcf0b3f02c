/* Conversion between units as they are spelt in files. */
#ifndef HCI_HOST_BASE_UNIT_H
#define HCI_HOST_BASE_UNIT_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Factor from `unit` to `wanted_unit` ("deg" → "rad"); both spelt as suffixes or as in a row of units ("N·m",
 * "Nm", "rad/s", "rad_per_s"). False when unknown or of another dimension. */
bool hci_unit_factor(const char *unit, const char *wanted_unit, double *factor);

#ifdef __cplusplus
}
#endif

#endif
