#include "cli/emit/emit_drive.h"

#include <string.h>

#include "cli/command/command.h"
#include "cli/command/parse.h"
#include "cli/command/reading.h"
#include "cli/emit/emit_currents.h"
#include "cli/emit/emit_options.h"
#include "cli/emit/emit_words.h"
#include "cli/terminal/say.h"
#include "cli/terminal/terminal.h"
#include "hci/host/report/summary.h"

typedef struct {
    hci_machine_data machine;
    hci_drive_data drive;
    hci_loop_levels levels;
    hci_emit_loop_request request;
} drive_inputs;

static hci_status read_drive_inputs(const cli_arguments *a, drive_inputs *in, hci_note *note)
{
    hci_status status = cli_emit_check(a, note);
    if (!status)
        status = hci_machine_read_orders(a->value[EMIT_MACHINE], (hci_order_base)a->choice[EMIT_ORDER_BASE],
                                         &in->machine, note);
    if (!status) status = hci_drive_read(a->value[EMIT_DRIVE], &in->drive, note);
    if (!status)
        status = hci_loop_levels_read(a->word, a->words, a->given[EMIT_PER_TORQUE], &in->levels, note);
    in->request =
        (hci_emit_loop_request){.name = a->value[EMIT_NAME],
                                .machine = &in->machine,
                                .machine_folder = a->value[EMIT_MACHINE],
                                .drive = &in->drive,
                                .levels = in->levels.level,
                                .level_count = in->levels.count,
                                .max_error_A = cli_number_or(a, EMIT_MAX_ERROR, 0.0),
                                .speed_rad_per_s = cli_number_or(a, EMIT_SPEED, 0.0) * HCI_PI / 30.0,
                                .blob = a->given[EMIT_BLOB],
                                .input_hash = in->levels.hash};
    if (!status) status = hci_emit_facts_read(a->value[EMIT_MACHINE], &in->machine, &in->request.facts, note);
    return status;
}

int cli_emit_for_drive(const cli_arguments *a)
{
    const char *folder = cli_emit_folder(a);
    hci_emit_loop_result result;
    hci_note note = {{0}};
    drive_inputs in;
    memset(&in, 0, sizeof in);
    hci_drive_init(&in.drive);
    hci_status status = read_drive_inputs(a, &in, &note);
    if (!status) status = hci_emit_loop(folder, &in.request, &result, &note);
    if (!status && cli_is_wordy()) cli_show_loop(&in.request, &result, folder);
    if (!status) cli_remark_drive(&in.drive, &in.machine, a->value[EMIT_MACHINE]);
    if (!status) cli_remark_response(&in.drive, &in.machine);
    if (!status)
        cli_remark_counts(&in.drive, &in.machine, result.highest_order, result.torque_high_Nm,
                          result.coarse_mean_Nm);
    if (!status) cli_emit_remark(a, &in.machine);
    if (!status) cli_remark_period(result.period_turns, in.machine.model.pole_pairs);
    if (!status) cli_emit_remark_zero(a);
    if (!status && cli_emit_wants_json(a))
        status = cli_print_json(hci_emit_loop_json(&in.request, &result), &note);
    hci_loop_levels_release(&in.levels);
    hci_drive_release(&in.drive);
    hci_machine_release(&in.machine);
    return status ? cli_fail(status, &note) : 0;
}
