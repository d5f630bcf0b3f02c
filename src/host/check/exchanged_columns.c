#include "host/check/own_parts.h"

#include <stdio.h>

void hci_check_add_exchanged(const check_data *data, hci_check *check)
{
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        if (!r->is_exchanged) continue;
        hci_check_finding f = hci_check_finding_at("columns_exchanged", &r->torque_cell,
                                                   "how the two columns go on from row to row");
        snprintf(f.words, sizeof f.words,
                 "%.40s goes on evenly from row to row, as an angle does, and %.40s to and fro, as a torque "
                 "does: each is in the other's place",
                 r->torque_cell.column, r->theta_cell.column);
        snprintf(f.should_be, sizeof f.should_be, "the two names in the header the other way round");
        check->findings = 0; /* of an angle that is none */
        hci_check_put_first(check, &f);
        return;
    }
}
