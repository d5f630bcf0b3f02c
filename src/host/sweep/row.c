/* One row: words of its kind and verdict, a row without results, and one with a reason. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/sweep/figures.h"

#define NAME_OF(value, word) [value] = word,

const char *hci_grid_kind_name(hci_grid_kind kind)
{
    static const char *const NAME[] = {HCI_GRID_KIND_NAMES(NAME_OF)};
    return NAME[kind];
}

const char *hci_grid_verdict_name(hci_grid_verdict verdict)
{
    static const char *const NAME[] = {HCI_GRID_VERDICT_NAMES(NAME_OF)};
    return NAME[verdict];
}

void hci_grid_row_begin(const hci_grid_point *point, hci_grid_row *row)
{
    memset(row, 0, sizeof *row);
    row->point = *point;
    row->best = row->most = row->sine = hci_grid_no_figures();
}

/* A line of a table: what would break it becomes a blank, and a long text ends between characters. */
void hci_grid_fail(const hci_grid_point *point, const char *reason, hci_grid_row *row)
{
    const hci_grid_point kept = *point;
    size_t length;
    hci_grid_row_begin(&kept, row);
    row->verdict = HCI_GRID_FAILED;
    length = (size_t)snprintf(row->reason, sizeof row->reason, "%s", reason);
    for (char *c = row->reason; *c; ++c)
        if (*c == '\n' || *c == '\r' || *c == '\t') *c = ' ';
    if (length < sizeof row->reason) return;
    length = sizeof row->reason - 1;
    while (length > 0 && ((unsigned char)row->reason[length] & 0xC0u) == 0x80u)
        --length;
    while (length > 0 && (unsigned char)row->reason[length - 1] >= 0x80u)
        --length;
    row->reason[length] = '\0';
}
