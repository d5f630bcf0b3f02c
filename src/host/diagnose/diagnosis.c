/* Names of what a diagnosis has, and its memory. */
#include <string.h>

#include "hci/host/diagnose/diagnose.h"
#include "host/base/memory.h"

const char *hci_finding_verdict_name(hci_finding_verdict verdict)
{
    static const char *const NAMES[] = {"added", "ambiguous", "rejected"};
    return NAMES[verdict];
}

const char *hci_diagnosis_verdict_name(hci_diagnosis_verdict verdict)
{
    static const char *const NAMES[] = {"complete", "explained", "ambiguous", "partly explained", "unknown"};
    return NAMES[verdict];
}

const char *hci_diagnosis_search_name(hci_work_end end)
{
    static const char *const NAMES[] = {"complete", "interrupted", "limited"};
    return NAMES[end];
}

void hci_diagnosis_release(hci_diagnosis *d)
{
    hci_effects_release(&d->effects);
    hci_uncertainty_release(&d->uncertainty);
    hci_memory_free(d->run);
    hci_memory_free(d->line);
    memset(d, 0, sizeof *d);
}
