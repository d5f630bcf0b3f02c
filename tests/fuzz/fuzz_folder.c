/* Any files in a folder of results, with summary.json and the journal of a set that was interrupted: it is
 * read or refused with words, and nothing outside of the folder is touched. */
#include "fuzzing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hci/host/base/output.h"
#include "hci/host/currents/solution_folder.h"
#include "hci/host/report/summary.h"

static void read_parts(void)
{
    for (hci_solution_file part = HCI_SOLUTION_CURRENTS; part <= HCI_SOLUTION_CURRENTS_CONSTANT; ++part) {
        hci_currents currents;
        hci_note note = {{0}};
        memset(&currents, 0, sizeof currents);
        fuzz_check_note(hci_solution_read_currents("results", part, &currents, &note), &note);
        hci_currents_release(&currents);
    }
}

static void read_torques(void)
{
    double torque_Nm = 0.0;
    hci_note mean = {{0}}, wanted = {{0}}, remark = {{0}};
    const hci_status status = hci_solution_read_mean_torque("results", &torque_Nm, &mean);
    fuzz_check_note(status, &mean);
    fuzz_require(isfinite(torque_Nm), "a finite torque");
    fuzz_check_note(hci_solution_read_wanted_torque("results", &torque_Nm, &wanted), &wanted);
    fuzz_require(isfinite(torque_Nm), "a finite torque");
    hci_solution_remark("results", NULL, &remark);
    fuzz_check_shown(remark.text);
    char words[HCI_SOLUTION_WORDS];
    hci_solution_verdict_words("results", words, sizeof words);
    fuzz_check_shown(words);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_unpack(data, size);
    hci_output_finish_interrupted("results");
    read_parts();
    read_torques();
    char *summary = hci_summary_read("results");
    if (summary != NULL) hci_text_free(summary);
    return 0;
}
