#include "host/sweep/columns.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

void hci_grid_put(hci_output *out, double value, char end)
{
    if (isfinite(value))
        hci_output_number(out, value, end);
    else
        hci_output_text(out, "%c", end);
}

void hci_grid_put_text(hci_output *out, const char *text, char end)
{
    const bool quoted = strpbrk(text, ",;\"#") != NULL;
    if (quoted) hci_output_text(out, "\"");
    for (const char *c = text; *c != '\0'; ++c)
        hci_output_text(out, "%s%c", *c == '"' ? "\"" : "", *c);
    hci_output_text(out, "%s%c", quoted ? "\"" : "", end);
}

void hci_grid_put_names(hci_output *out, const char *prefix)
{
#define PUT(field, column) hci_output_text(out, "%s" column ",", prefix);
    HCI_GRID_FIGURES(PUT)
#undef PUT
    hci_output_text(out, "%sbinds,", prefix);
}

void hci_grid_put_figures(hci_output *out, const hci_grid_figures *f)
{
    char binds[HCI_GRID_BINDS_SIZE];
#define PUT(field, column) hci_grid_put(out, f->field, ',');
    HCI_GRID_FIGURES(PUT)
#undef PUT
    hci_grid_binds_text(f, binds);
    hci_output_text(out, "%s,", binds);
}

void hci_grid_binds_text(const hci_grid_figures *f, char text[HCI_GRID_BINDS_SIZE])
{
    text[0] = '\0';
    for (int k = 0; k <= HCI_LIMIT_COPPER; ++k) {
        const size_t used = strlen(text);
        if (f->binds[k])
            snprintf(text + used, HCI_GRID_BINDS_SIZE - used, "%s%s", used > 0 ? "+" : "",
                     hci_limit_kind_name((hci_limit_kind)k));
    }
}
