#include "cli/command/reading.h"

#include <math.h>
#include <string.h>

hci_status cli_reading_take(const cli_arguments *a, bool strict, cli_reading *reading, hci_note *note)
{
    hci_status status = HCI_OK;
    memset(reading, 0, sizeof *reading);
    reading->run.inertia_kgm2 = NAN;
    reading->run.strict = strict;
    reading->run.columns = &reading->columns;
    for (size_t k = 0; k < a->repeats && !status; ++k)
        status = hci_column_names_add(&reading->columns, a->repeated[k], note);
    return status;
}

void cli_reading_release(cli_reading *reading)
{
    hci_column_names_release(&reading->columns);
}
