/* Any folder as a machine: it is refused with words, or its model gives finite torque and is the same each
 * time. */
#include "fuzzing.h"

#include <math.h>
#include <string.h>

#include "hci/host/emit/emit_facts.h"
#include "hci/host/machine/machine.h"
#include "hci/host/machine/uncertainty.h"

static void check_model(const hci_machine_data *machine)
{
    static const double i_A[3] = {1.0, -0.5, -0.5};
    fuzz_check_shown(machine->remark.text);
    fuzz_require(machine->model.pole_pairs >= 1 && machine->model.pole_pairs <= 1000, "pole pairs");
    fuzz_require(strlen(machine->identity.digest) == 16, "a digest");
    for (int k = 0; k < 8; ++k)
        fuzz_require(isfinite(hci_torque_at(&machine->model, 0.9 * k, i_A)), "finite torque");
}

static void check_same(const hci_machine_data *machine)
{
    hci_machine_data again;
    hci_note note = {{0}};
    memset(&again, 0, sizeof again);
    fuzz_require(hci_machine_read("machine", &again, &note) == HCI_OK, "read a second time");
    fuzz_require(strcmp(machine->identity.digest, again.identity.digest) == 0, "the same digest");
    hci_machine_release(&again);
}

static void check_facts(const hci_machine_data *machine)
{
    hci_emit_facts facts;
    hci_note note = {{0}};
    memset(&facts, 0, sizeof facts);
    fuzz_check_note(hci_emit_facts_read("machine", machine, &facts, &note), &note);
    fuzz_check_shown(facts.machine);
}

static void read_machine(void)
{
    hci_machine_data machine;
    hci_note note = {{0}};
    memset(&machine, 0, sizeof machine);
    fuzz_check_note(hci_machine_read("machine", &machine, &note), &note);
    if (note.text[0] == '\0') check_model(&machine), check_same(&machine), check_facts(&machine);
    hci_machine_release(&machine);
}

static void read_effects(void)
{
    hci_effects_data effects = {{NULL, 0}, NULL, NULL};
    hci_uncertainty uncertainty;
    hci_note note = {{0}}, unsure = {{0}};
    memset(&uncertainty, 0, sizeof uncertainty);
    fuzz_check_note(hci_effects_read_machine("machine", &effects, &note), &note);
    fuzz_check_note(hci_uncertainty_read_machine("machine", &uncertainty, &unsure), &unsure);
    hci_uncertainty_release(&uncertainty);
    hci_effects_release(&effects);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_unpack(data, size);
    read_machine();
    read_effects();
    return 0;
}
