#include "host/check/own_parts.h"

#include <stdio.h>
#include <string.h>

/* Of what is proved. */
#define PROVED 0.999

const char *hci_check_name_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

void hci_check_put_first(hci_check *check, const hci_check_finding *finding)
{
    if (check->findings == HCI_CHECK_MOST_FINDINGS) --check->findings;
    memmove(&check->finding[1], &check->finding[0], check->findings * sizeof check->finding[0]);
    check->finding[0] = *finding;
    ++check->findings;
    check->probability_as_declared *= 1.0 - PROVED;
}

hci_check_finding hci_check_finding_at(const char *slip, const check_place *place, const char *told_by)
{
    hci_check_finding f = {
        .slip = slip, .line = place->line, .probability = PROVED, .is_no_effect = true, .told_by = told_by};
    snprintf(f.file, sizeof f.file, "%s", place->path);
    memcpy(f.column, place->column, sizeof f.column);
    memcpy(f.found, place->text, sizeof f.found);
    return f;
}
