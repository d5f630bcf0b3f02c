#include "host/fmu/controller_code.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/emit/emit_loop.h"
#include "host/base/memory.h"
#include "host/base/whole_file.h"
#include "host/fmu/data_code.h"

static const hci_fmu_variable LIST[] = {HCI_FMU_CONTROLLER_VARIABLES(HCI_FMU_ENTRY)};

/* Delays are counted in tenths of a sample, as `simulate` has it. */
enum { STEPS_OF_A_SAMPLE = 10 };

enum { FEEDFORWARD = 4 }; /* its place among the remedies, from 1: the last one */

/* ---- the table ---- */

/* "hci/loop.h" is hci_loop.h among the sources of an FMU. */
static void flatten_include(char *text)
{
    char *at = strstr(text, "#include \"hci/loop.h\"");
    if (at) *strchr(at, '/') = '_';
}

static hci_status read_text(const char *folder, const char *name, char **text, hci_note *note)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    *text = hci_whole_file(path);
    if (!*text && hci_memory_was_short()) return hci_note_memory(note, path, "reading it");
    if (!*text) return hci_note_set(note, HCI_ERROR_OUTPUT, "%s: cannot be read again", path);
    flatten_include(*text);
    return HCI_OK;
}

static hci_status emit_table(hci_fmu_controller_model *m, hci_note *note)
{
    const hci_fmu_request *r = m->request;
    hci_emit_loop_request request = {.name = "torque_table",
                                     .machine = r->machine,
                                     .drive = r->drive,
                                     .levels = r->levels,
                                     .level_count = r->level_count};
    memcpy(request.facts.machine, r->machine->identity.name, sizeof request.facts.machine);
    request.facts.pole_pairs = (size_t)r->machine->pole_pairs;
    hci_status status = hci_emit_loop(r->work_folder, &request, NULL, note);
    if (!status) status = read_text(r->work_folder, HCI_FMU_TABLE_H, &m->table_h, note);
    if (!status) status = read_text(r->work_folder, HCI_FMU_TABLE_C, &m->table_c, note);
    return status;
}

/* ---- what the controller is ---- */

static void fill_start(hci_fmu_controller_model *m)
{
    const hci_drive_data *d = m->request->drive;
    const double dead_time_V = d->dc_link_voltage_V * hci_drive_dead_share(d);
    m->start[HCI_FMU_CONTROLLER_REMEDY] = FEEDFORWARD;
    m->start[HCI_FMU_CONTROLLER_KP] = d->kp_ohm;
    m->start[HCI_FMU_CONTROLLER_KI] = d->ki_ohm_per_s;
    m->start[HCI_FMU_CONTROLLER_KP_Q] = d->kp_q_ohm;
    m->start[HCI_FMU_CONTROLLER_KI_Q] = d->ki_q_ohm_per_s;
    m->start[HCI_FMU_CONTROLLER_FILTER] = hci_drive_filter_share(d);
    m->start[HCI_FMU_CONTROLLER_DC_LINK] = d->dc_link_voltage_V;
    m->start[HCI_FMU_CONTROLLER_QUANTUM] = d->current_quantum_A;
    m->start[HCI_FMU_CONTROLLER_COUNTS] = d->encoder_counts;
    m->start[HCI_FMU_CONTROLLER_DEAD_TIME_VOLTAGE] = d->dead_time_compensation > 0.5 ? dead_time_V : 0.0;
    m->start[HCI_FMU_CONTROLLER_DEAD_TIME_CROSSING] = d->dead_time_crossing_A;
}

hci_status hci_fmu_controller_make(const hci_fmu_request *request, const hci_machine_data *machine,
                                   hci_fmu_controller_model *m, hci_note *note)
{
    const hci_drive_data *drive = request->drive;
    memset(m, 0, sizeof *m);
    m->request = request;
    hci_status status = drive->decoupling == HCI_DECOUPLING_TABLE
                            ? hci_machine_model_make(machine, &m->known, note)
                            : hci_machine_model_make_constant(machine, &m->known, note);
    if (!status) status = emit_table(m, note);
    if (status) return status;
    const double step_s = drive->sample_s / STEPS_OF_A_SAMPLE;
    m->delay_steps = (unsigned)floor(drive->computing_delay_s / step_s + 0.5);
    fill_start(m);
    return HCI_OK;
}

void hci_fmu_controller_release(hci_fmu_controller_model *m)
{
    hci_machine_model_release(&m->known);
    hci_memory_free(m->table_h);
    hci_memory_free(m->table_c);
    memset(m, 0, sizeof *m);
}

/* ---- its description ---- */

/* The references follow angle, speed and torque at a sample, the voltages all inputs where there is no delay.
 */
static bool feeds(const void *context, size_t input, size_t output)
{
    const hci_fmu_controller_model *m = context;
    const bool is_current = input >= HCI_FMU_CONTROLLER_IA && input <= HCI_FMU_CONTROLLER_IC;
    if (output == HCI_FMU_CONTROLLER_ID_REFERENCE || output == HCI_FMU_CONTROLLER_IQ_REFERENCE)
        return !is_current;
    return m->delay_steps == 0;
}

void hci_fmu_controller_describe(const hci_fmu_controller_model *m, hci_fmu_description *d)
{
    const double sample_s = m->request->drive->sample_s;
    d->what =
        "Controller of a permanent-magnet machine: torque table and PI current loop, with average phase "
        "voltages";
    d->list = LIST;
    d->count = HCI_FMU_CONTROLLER_COUNT;
    d->start = m->start;
    d->left_out = m->left_out;
    d->choices = FEEDFORWARD;
    d->feeds = feeds;
    d->context = m;
    d->step_s = m->delay_steps % STEPS_OF_A_SAMPLE == 0 ? sample_s : sample_s / STEPS_OF_A_SAMPLE;
}

/* ---- its code ---- */

static const char *const MODULATION[] = {[HCI_MODULATION_SPACE_VECTOR] = "HCI_MODULATION_SPACE_VECTOR",
                                         [HCI_MODULATION_SINUSOIDAL] = "HCI_MODULATION_SINUSOIDAL",
                                         [HCI_MODULATION_CIRCLE] = "HCI_MODULATION_CIRCLE"};

void hci_fmu_controller_code(const hci_fmu_controller_model *m, hci_long_text *text)
{
    const hci_drive_data *drive = m->request->drive;
    hci_long_text_add(text, "#include \"fmu_controller_data.h\"\n#include \"fmu_model.h\"\n"
                            "#include \"" HCI_FMU_TABLE_H "\"\n\n");
    hci_fmu_code_start(m->start, HCI_FMU_CONTROLLER_COUNT, text);
    hci_fmu_code_arrays("KNOWN", &m->known.machine, &m->known.inductance, text);
    hci_long_text_add(text, "const hci_fmu_controller_data hci_fmu_controller = {\n    ");
    hci_fmu_code_machine("KNOWN", &m->known.machine, text);
    hci_long_text_add(text, ",\n    ");
    hci_fmu_code_inductance("KNOWN", &m->known.inductance, text);
    hci_long_text_add(text, ",\n    %d, /* points */\n    &torque_table,\n    ", m->known.table.points);
    hci_long_text_number(text, drive->sample_s / STEPS_OF_A_SAMPLE);
    hci_long_text_add(
        text, ", /* step_s */\n    %du, %uu, /* steps of a sample, of the delay */\n    %s, %s\n};\n",
        STEPS_OF_A_SAMPLE, m->delay_steps, drive->decoupling != HCI_DECOUPLING_NONE ? "true" : "false",
        MODULATION[drive->modulation]);
}
