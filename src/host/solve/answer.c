#include "host/solve/answer.h"

#include <string.h>

#include "host/base/memory.h"

hci_status hci_answer_reserve(size_t count, hci_answer *a)
{
    memset(a, 0, sizeof *a);
    a->set.component = hci_memory_new(count, sizeof *a->set.component);
    a->set.set = hci_memory_new(count, sizeof *a->set.set);
    a->x = hci_memory_new(4 * count, sizeof *a->x);
    a->set.count = count;
    return a->set.component && a->set.set && a->x ? HCI_OK : HCI_ERROR_MEMORY;
}

hci_status hci_answer_copy(const hci_answer *from, hci_answer *to)
{
    const size_t n = from->set.count;
    hci_status status;
    hci_answer_release(to);
    status = hci_answer_reserve(n, to);
    if (status) return status;
    memcpy(to->set.component, from->set.component, n * sizeof *to->set.component);
    memcpy(to->set.set, from->set.set, n * sizeof *to->set.set);
    memcpy(to->x, from->x, 4 * n * sizeof *to->x);
    return HCI_OK;
}

void hci_answer_release(hci_answer *answer)
{
    hci_component_set_release(&answer->set);
    hci_memory_free(answer->x);
    memset(answer, 0, sizeof *answer);
}

double hci_coordinate(const double *x, size_t n, double mean_Nm, size_t j)
{
    return mean_Nm * x[j] + x[n + j];
}
