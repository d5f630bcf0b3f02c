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

/* A speed in rpm with the digits that it was given with, for people and files: to 12 of them. */
double hci_rpm(double speed_rad_per_s);

#ifdef __cplusplus
}
#endif

#endif
