/* measure_next.csv: operating points that a drive can play, for the recordings that would tell most. */
#include <math.h>

#include "host/csv/write.h"
#include "host/report/write_next.h"

hci_status hci_next_points_write(hci_output *out, const hci_diagnosis *d, hci_note *note)
{
    if (d->next_points == 0) return hci_output_without(out, "measure_next.csv", note);
    const hci_status status = hci_output_file(out, "measure_next.csv", note);
    if (status) return status;
    hci_output_text(out, "id_A,iq_A,speed_rad_per_s,turns,why,test\n");
    for (size_t k = 0; k < d->next_points; ++k) {
        const hci_next_point *p = &d->next[k];
        hci_output_number(out, p->id_A, ',');
        if (isfinite(p->iq_A))
            hci_output_number(out, p->iq_A, ',');
        else
            hci_output_text(out, ",");
        hci_output_number(out, p->speed_rad_per_s, ',');
        hci_output_number(out, p->turns, ',');
        hci_csv_write_cell(out, p->why, false);
        hci_output_text(out, "%s\n", hci_next_test_name(p->source));
    }
    return HCI_OK;
}
