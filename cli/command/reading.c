#include "cli/command/reading.h"

#include <math.h>
#include <string.h>

#include "cli/terminal/say.h"

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

void cli_remark_each(const hci_note *(*remark)(const void *context, size_t k), const void *context,
                     size_t count)
{
    for (size_t k = 0; k < count; ++k) {
        const hci_note *one = remark(context, k);
        size_t before = 0, alike = 0;
        for (size_t j = 0; j < count; ++j) {
            const bool is_same = strcmp(remark(context, j)->text, one->text) == 0;
            before += is_same && j < k;
            alike += is_same;
        }
        hci_note many = {{0}};
        if (alike > 1 && one->text[0])
            hci_note_set(&many, HCI_OK, "%zu of %zu recordings: %s", alike, count, one->text);
        if (before == 0) cli_remark(many.text[0] ? &many : one);
    }
}
