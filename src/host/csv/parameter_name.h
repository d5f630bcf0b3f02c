/* Columns named by the number of a drive's parameter, as the trace of SINAMICS drives writes them. */
#ifndef HCI_SRC_HOST_CSV_PARAMETER_NAME_H
#define HCI_SRC_HOST_CSV_PARAMETER_NAME_H

#include "host/base/unit_lookup.h"
#include "host/csv/alias.h"

/* What a parameter as "r0078[1] Current actual value" holds, whatever its words and the device before it;
 * NULL: no such name, or none of the parameters that are read. unit: out, that behind it, NULL: none. Source:
 * List Manual SINAMICS S120/S150, parameters r0061 to r0093. */
const hci_alias *hci_parameter_name(const char *header, const hci_unit **unit);

/* The k-th number that is read and what it is; false: there are no more. */
bool hci_parameter_known(size_t k, char name[16], const hci_alias **said);

#endif
