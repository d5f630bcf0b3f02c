/* The command `check`: reads, weighs, concludes. */
#include "hci/host/check/check.h"

#include <string.h>

#include "host/check/conclusions.h"
#include "host/check/relations/pole_pairs.h"

const char *hci_check_verdict_name(hci_check_verdict verdict)
{
    static const char *const NAME[] = {"consistent", "slips", "ambiguous", "not_understood"};
    return NAME[verdict];
}

const char *hci_check_state_name(hci_check_state state)
{
    static const char *const NAME[] = {"consistent",     "mended", "better",  "mendable",
                                       "not_understood", "worse",  "unjudged"};
    return NAME[state];
}

const hci_check_finding *hci_check_sure_slip(const hci_check *check)
{
    for (size_t k = 0; k < check->findings; ++k)
        if (check->finding[k].is_no_effect && check->finding[k].probability >= HCI_CHECK_SURE)
            return &check->finding[k];
    return NULL;
}

hci_status hci_check_files(const char *machine, const char *const *run, size_t runs,
                           const hci_run_options *reading, hci_check *check, hci_note *note)
{
    check_data data;
    check_posterior posterior = {0};
    hci_status status;
    memset(check, 0, sizeof *check);
    memset(&data, 0, sizeof data);
    if (runs > HCI_CHECK_MOST_RUNS)
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "found %zu recordings, expected at most %d; leave some out", runs,
                            HCI_CHECK_MOST_RUNS);
    data.order_base = reading->order_base;
    check->machine = machine;
    check->run = run;
    check->runs = runs;
    status = hci_check_machine_read(machine, &data, &check->machine_remark, note);
    if (!status) status = hci_check_runs_read(run, runs, reading, &data, check->remark, note);
    if (!status && !hci_check_pole_pairs_count(&data))
        status = hci_note_memory(note, NULL, "the orders of a turn");
    if (!status) status = hci_check_posterior(&data, &posterior, note);
    if (!status) hci_check_conclude(&posterior, check);
    hci_check_posterior_release(&posterior);
    hci_check_data_release(&data);
    if (status) return status;
    return check->verdict == HCI_CHECK_CONSISTENT ? HCI_OK : HCI_NOT_REACHED;
}
