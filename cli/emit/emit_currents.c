#include "cli/emit/emit_currents.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/command/parse.h"
#include "cli/emit/emit_options.h"
#include "cli/terminal/say.h"
#include "cli/terminal/terminal.h"
#include "hci/host/currents/solution_folder.h"

/* What header and blob say of the machine, and the torque of a folder that was solved for one. */
static hci_status read_facts(const cli_arguments *a, cli_emit_currents *in, hci_note *note)
{
    hci_emit_facts *facts = &in->request.facts;
    hci_status status = HCI_OK;
    in->request.blob = a->given[EMIT_BLOB];
    facts->angle_of_logs = a->given[EMIT_ANGLE_OF_LOGS];
    facts->angle_offset_deg = cli_number_or(a, EMIT_ANGLE_OFFSET, 0.0);
    if (hci_solution_is_folder(a->word[0]) && hci_solution_has_spectrum(a->word[0]))
        status = hci_solution_read_wanted_torque(a->word[0], &facts->mean_torque_Nm, note);
    if (status) return status;
    if (facts->mean_torque_Nm != 0.0 && hci_solution_read_made_torque(a->word[0]) != 0.0)
        facts->mean_torque_Nm = hci_solution_read_made_torque(a->word[0]);
    if (!a->given[EMIT_MACHINE]) return HCI_OK;
    status = hci_machine_read_orders(a->value[EMIT_MACHINE], (hci_order_base)a->choice[EMIT_ORDER_BASE],
                                     &in->machine, note);
    in->request.machine = &in->machine;
    in->request.machine_folder = a->value[EMIT_MACHINE];
    in->request.expected_ripple_Nm = hci_solution_read_expected_ripple(a->word[0]);
    return status ? status : hci_emit_facts_read(a->value[EMIT_MACHINE], &in->machine, facts, note);
}

static hci_status read_parts(const cli_arguments *a, cli_emit_currents *in, hci_note *note)
{
    const char *from = a->word[0];
    hci_status status;
    if (!hci_solution_is_folder(from))
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "--per-torque needs the folder that `solve` wrote, not one file: %s", from);
    status = hci_solution_check_folder(from, note);
    if (status) return status;
    if (!hci_solution_has_parts(from))
        return hci_note_set(
            note, HCI_ERROR_INPUT,
            "%s: no currents_per_Nm.csv: these currents are not linear in the mean torque (a held "
            "fundamental, or reluctance torque); leave out --per-torque",
            from);
    status = hci_solution_read_currents(from, HCI_SOLUTION_CURRENTS_CONSTANT, &in->current, note);
    if (!status) status = hci_solution_read_currents(from, HCI_SOLUTION_CURRENTS_PER_NM, &in->per_Nm, note);
    in->request.reference_torque_Nm = cli_number_or(a, EMIT_REFERENCE, 0.0);
    if (!status && !a->given[EMIT_REFERENCE])
        status = hci_solution_read_mean_torque(from, &in->request.reference_torque_Nm, note);
    in->request.reference_torque_Nm = fabs(in->request.reference_torque_Nm);
    in->request.per_Nm = in->per_Nm.wave;
    in->request.per_Nm_count = in->per_Nm.count;
    return status;
}

static hci_status read_options(const cli_arguments *a, hci_emit_request *r, hci_note *note)
{
    r->name = a->value[EMIT_NAME];
    r->format = (hci_emit_format)a->choice[EMIT_FORMAT];
    r->shape = (hci_emit_shape)a->choice[EMIT_SHAPE];
    r->frame = (hci_table_frame)a->choice[EMIT_FRAME];
    r->points = (size_t)cli_number_or(a, EMIT_POINTS, 0.0);
    r->max_error_A = cli_number_or(a, EMIT_MAX_ERROR, 0.0);
    r->max_bytes = (size_t)cli_number_or(a, EMIT_MAX_BYTES, 0.0);
    r->max_instructions = (size_t)cli_number_or(a, EMIT_MAX_INSTRUCTIONS, 0.0);
    return cli_emit_check(a, note);
}

static bool has_zero_sequence(const hci_currents *c)
{
    for (size_t k = 0; k < c->count; ++k)
        if (c->wave[k].sequence == 0) return true;
    return false;
}

/* The waves, and where they are from. */
static hci_status read_waves(const cli_arguments *a, cli_emit_currents *in, hci_note *note)
{
    hci_status status;
    if (a->given[EMIT_PER_TORQUE])
        status = read_parts(a, in, note);
    else
        status = hci_solution_read_currents(a->word[0], HCI_SOLUTION_CURRENTS, &in->current, note);
    if (status) return status;
    in->request.currents = in->current.wave;
    in->request.current_count = in->current.count;
    in->request.has_neutral = has_zero_sequence(&in->current) || has_zero_sequence(&in->per_Nm);
    in->request.input_hash = in->current.hash ^ (in->per_Nm.hash * 31u);
    snprintf(in->provenance[0], sizeof in->provenance[0], "%zu current components, solved by hci-solve",
             in->current.count);
    in->lines[0] = in->provenance[0];
    hci_solution_verdict_words(a->word[0], in->provenance[1], sizeof in->provenance[1]);
    in->lines[1] = in->provenance[1];
    in->request.provenance = in->lines;
    in->request.provenance_count = in->lines[1][0] != '\0' ? 2 : 1;
    return HCI_OK;
}

hci_status cli_emit_currents_read(const cli_arguments *a, cli_emit_currents *in, hci_note *note)
{
    hci_status status = read_options(a, &in->request, note);
    if (!status) status = read_waves(a, in, note);
    if (!status) status = read_facts(a, in, note);
    return status;
}

void cli_emit_currents_release(cli_emit_currents *in)
{
    hci_machine_release(&in->machine);
    hci_currents_release(&in->current);
    hci_currents_release(&in->per_Nm);
}

void cli_emit_remark(const cli_arguments *a, const hci_machine_data *machine)
{
    for (size_t k = 0; k < a->words; ++k) {
        hci_note remark = {{0}};
        hci_solution_remark(a->word[k], machine, &remark);
        cli_remark(&remark);
    }
}

void cli_emit_remark_zero(const cli_arguments *a)
{
    hci_note remark = {{0}};
    if (!a->given[EMIT_ANGLE_OF_LOGS]) return;
    hci_note_set(
        &remark, HCI_OK,
        "the angle is that of the logs, which do not tell where the electrical zero is: harmonics of the "
        "back-EMF need it (docs/tutorials/zero.md)");
    cli_remark(&remark);
}
