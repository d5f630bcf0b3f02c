/* In: machine and recordings of a diagnosis; out: what check says of them, made where it is asked for. */
#include "hci/host/check/check.h"

const hci_check *hci_check_ask(hci_check_inquiry *q)
{
    hci_run_options reading = q->reading;
    hci_note note = {{0}};
    const size_t runs = q->runs < HCI_CHECK_MOST_RUNS ? q->runs : HCI_CHECK_MOST_RUNS;
    reading.holding = false;
    if (!q->is_made && runs > 0)
        q->has_check =
            hci_check_files(q->machine, q->run, runs, &reading, &q->check, &note) <= HCI_NOT_REACHED;
    q->is_made = true;
    return q->has_check ? &q->check : NULL;
}

const char *hci_check_slip(void *inquiry)
{
    const hci_check *check = hci_check_ask(inquiry);
    const hci_check_finding *slip = check ? hci_check_sure_slip(check) : NULL;
    return slip ? slip->words : NULL;
}
