#include "cli/emit/emit_foreign.h"

#include <string.h>

#include "cli/command/command.h"
#include "cli/command/parse.h"
#include "cli/emit/emit_currents.h"
#include "cli/emit/emit_options.h"
#include "cli/emit/emit_words.h"
#include "cli/terminal/say.h"
#include "cli/terminal/terminal.h"
#include "hci/host/report/summary.h"

typedef struct {
    cli_emit_currents currents;
    hci_emit_foreign_request request;
} foreign_inputs;

static hci_status read_foreign_inputs(const cli_arguments *a, foreign_inputs *in, hci_note *note)
{
    const hci_emit_request *currents = &in->currents.request;
    hci_status status = cli_emit_currents_read(a, &in->currents, note);
    in->request =
        (hci_emit_foreign_request){.name = currents->name,
                                   .target = (hci_foreign_name)a->choice[EMIT_FOR],
                                   .machine_folder = a->value[EMIT_MACHINE],
                                   .machine = &in->currents.machine,
                                   .currents = currents->currents,
                                   .current_count = currents->current_count,
                                   .per_Nm = currents->per_Nm,
                                   .per_Nm_count = currents->per_Nm_count,
                                   .reference_torque_Nm = currents->reference_torque_Nm,
                                   .points = currents->points,
                                   .torque_constant_Nm_per_A = cli_number_or(a, EMIT_TORQUE_CONSTANT, 0.0),
                                   .wave = (hci_foreign_wave)a->choice[EMIT_WAVE],
                                   .counts_per_A = cli_number_or(a, EMIT_COUNTS, 0.0),
                                   .encoder_offset_deg = cli_number_or(a, EMIT_ENCODER_OFFSET, 0.0),
                                   .encoder_direction = a->choice[EMIT_ENCODER_DIRECTION] == 1 ? -1 : 1,
                                   .expected_ripple_Nm = currents->expected_ripple_Nm,
                                   .input_hash = currents->input_hash};
    return status;
}

int cli_emit_for_foreign(const cli_arguments *a)
{
    const char *folder = cli_emit_folder(a);
    hci_emit_foreign_result result;
    hci_note note = {{0}};
    foreign_inputs in;
    memset(&in, 0, sizeof in);
    hci_status status = read_foreign_inputs(a, &in, &note);
    if (!status) status = hci_emit_foreign(folder, &in.request, &result, &note);
    if (!status && cli_is_wordy()) cli_show_foreign(&in.request, &result, folder);
    if (!status) cli_emit_remark(a, &in.currents.machine);
    if (!status) cli_emit_remark_zero(a);
    if (!status) cli_remark_foreign(&result);
    if (!status && cli_emit_wants_json(a))
        status = cli_print_json(hci_emit_foreign_json(&in.request, &result), &note);
    cli_emit_currents_release(&in.currents);
    return status ? cli_fail(status, &note) : 0;
}
