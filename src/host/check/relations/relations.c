#include "host/check/relations/relations.h"

static const check_relation_list *const LISTS[] = {&HCI_CHECK_TABLE_RELATIONS,  &HCI_CHECK_WAVE_RELATIONS,
                                                   &HCI_CHECK_TORQUE_RELATIONS, &HCI_CHECK_COGGING_RELATIONS,
                                                   &HCI_CHECK_PHASE_RELATIONS,  &HCI_CHECK_POLE_RELATIONS};
enum { LIST_COUNT = sizeof LISTS / sizeof *LISTS };

size_t hci_check_relation_count(void)
{
    size_t count = 0;
    for (int k = 0; k < LIST_COUNT; ++k)
        count += LISTS[k]->count;
    return count;
}

const check_relation *hci_check_relation(size_t k)
{
    int list = 0;
    for (; k >= LISTS[list]->count; ++list)
        k -= LISTS[list]->count;
    return &LISTS[list]->relation[k];
}
