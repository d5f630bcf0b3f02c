#include "host/fmu/machine_code.h"

#include <math.h>
#include <string.h>

#include "host/fmu/data_code.h"

static const hci_fmu_variable LIST[] = {HCI_FMU_MACHINE_VARIABLES(HCI_FMU_ENTRY)};

/* Longest internal step without a drive: a tenth of a sample at 10 kHz; as `simulate` has it. */
static const double STEP_s = 1e-5;
enum { STEPS_OF_A_SAMPLE = 10 };

/* ---- what the machine is ---- */

/* A scenario in which the set-up of `simulate` wants to know of the machine what the model needs, and no
 * more. */
static void fill_scenario(const hci_fmu_machine_model *m, hci_scenario *s)
{
    hci_scenario_init(s);
    s->current_control = m->request->imposed ? HCI_CURRENT_IDEAL : HCI_CURRENT_PI;
    s->duration_s = 1.0;
    s->step_s = m->step_s;
    s->current_sample_time_s = m->step_s;
    s->torque_reference_Nm = 0.0;
    s->dc_link_voltage_V = 1.0;
    if (isnan(m->machine->inertia_kgm2)) s->prescribed_speed_rad_per_s = 0.0;
}

/* The temperature at which the magnets are declared, NAN where nothing depends on it. */
static double reference_temperature_C(const hci_effects *effects)
{
    for (size_t k = 0; effects && k < effects->count; ++k) {
        const hci_effect_type *type = effects->effect[k].type;
        for (size_t j = 0; j < type->parameter_count; ++j)
            if ((type->needs & HCI_EFFECT_NEEDS_TEMPERATURE) && strcmp(type->parameter[j].unit, "C") == 0)
                return hci_effect_value(&effects->effect[k], j);
    }
    return NAN;
}

static double or_zero(double value)
{
    return isfinite(value) ? value : 0.0;
}

static void fill_start(hci_fmu_machine_model *m)
{
    const hci_fmu_request *r = m->request;
    const hci_machine_data *machine = m->machine;
    m->start[HCI_FMU_MACHINE_TEMPERATURE] = or_zero(reference_temperature_C(r->effects));
    m->start[HCI_FMU_MACHINE_RESISTANCE] = or_zero(machine->resistance_ohm);
    m->start[HCI_FMU_MACHINE_INERTIA] = or_zero(machine->inertia_kgm2);
    m->start[HCI_FMU_MACHINE_VISCOUS] = or_zero(machine->viscous_friction_Nms_per_rad);
    m->start[HCI_FMU_MACHINE_COULOMB] = or_zero(machine->coulomb_friction_Nm);
    m->start[HCI_FMU_MACHINE_IS_PRESCRIBED] = isnan(machine->inertia_kgm2);
    m->start[HCI_FMU_MACHINE_STEP] = m->step_s;
    if (!r->drive) return;
    m->start[HCI_FMU_MACHINE_DEAD_TIME_VOLTAGE] =
        r->drive->dc_link_voltage_V * hci_drive_dead_share(r->drive);
    m->start[HCI_FMU_MACHINE_DEAD_TIME_CROSSING] = r->drive->dead_time_crossing_A;
}

static void leave_out(hci_fmu_machine_model *m)
{
    const bool imposed = m->request->imposed;
    for (int k = 0; k < 3; ++k) {
        m->left_out[HCI_FMU_MACHINE_VA + k] = imposed;
        m->left_out[HCI_FMU_MACHINE_IA_IMPOSED + k] = !imposed;
    }
    m->left_out[HCI_FMU_MACHINE_RESISTANCE] = imposed;
    m->left_out[HCI_FMU_MACHINE_DEAD_TIME_VOLTAGE] = imposed;
    m->left_out[HCI_FMU_MACHINE_DEAD_TIME_CROSSING] = imposed;
    m->left_out[HCI_FMU_MACHINE_TEMPERATURE] = isnan(reference_temperature_C(m->request->effects));
}

hci_status hci_fmu_machine_make(const hci_fmu_request *request, const hci_machine_data *machine,
                                hci_fmu_machine_model *m, hci_note *note)
{
    static const hci_effects NONE = {NULL, 0};
    const hci_simulate_options options = {.effects = request->effects ? request->effects : &NONE};
    hci_scenario scenario;
    memset(m, 0, sizeof *m);
    m->request = request;
    m->machine = machine;
    m->step_s = request->drive ? request->drive->sample_s / STEPS_OF_A_SAMPLE : STEP_s;
    fill_scenario(m, &scenario);
    const hci_status status = hci_setup_make(machine, &options, &scenario, &m->setup, note);
    if (status) return status;
    fill_start(m);
    leave_out(m);
    return HCI_OK;
}

void hci_fmu_machine_release(hci_fmu_machine_model *m)
{
    hci_setup_release(&m->setup);
    memset(m, 0, sizeof *m);
}

/* ---- its description ---- */

/* Imposed currents flow at once, and the torque follows the current and the magnets. */
static bool feeds(const void *context, size_t input, size_t output)
{
    (void)context;
    const bool is_current = input >= HCI_FMU_MACHINE_IA_IMPOSED && input <= HCI_FMU_MACHINE_IC_IMPOSED;
    if (output == HCI_FMU_MACHINE_TORQUE) return is_current || input == HCI_FMU_MACHINE_TEMPERATURE;
    return is_current && output >= HCI_FMU_MACHINE_IA && output <= HCI_FMU_MACHINE_IQ;
}

void hci_fmu_machine_describe(const hci_fmu_machine_model *m, hci_fmu_description *d)
{
    d->what = m->request->imposed ? "Permanent-magnet machine on a shaft, with imposed phase currents"
                                  : "Permanent-magnet machine on a shaft, star without neutral, with phase "
                                    "voltages";
    d->list = LIST;
    d->count = HCI_FMU_MACHINE_COUNT;
    d->start = m->start;
    d->left_out = m->left_out;
    d->feeds = feeds;
    d->context = m;
    d->step_s = m->step_s;
}

/* ---- its code ---- */

static void add_terms(const hci_effects *effects, hci_long_text *text)
{
    hci_long_text_add(text, "/* parameter, order, value, standard error (not used) */\n"
                            "static const hci_effect_term TERMS[] = {\n");
    for (size_t k = 0; k < effects->count; ++k)
        for (size_t j = 0; j < effects->effect[k].count; ++j) {
            const hci_effect_term *t = &effects->effect[k].term[j];
            hci_long_text_add(text, "    {%zu, ", t->parameter);
            hci_long_text_number(text, t->order);
            hci_long_text_add(text, ", ");
            hci_long_text_number(text, t->value);
            hci_long_text_add(text, ", 0.0}, /* %s %s */\n", effects->effect[k].type->name,
                              effects->effect[k].type->parameter[t->parameter].name);
        }
    hci_long_text_add(text, "};\n\n");
}

static void add_effects(const hci_effects *effects, hci_long_text *text)
{
    size_t first = 0;
    if (!effects || effects->count == 0) return;
    add_terms(effects, text);
    hci_long_text_add(text, "static const hci_effect EFFECTS[] = {\n");
    for (size_t k = 0; k < effects->count; ++k) {
        hci_long_text_add(text, "    {&hci_effect_%s, TERMS + %zu, %zu},\n", effects->effect[k].type->name,
                          first, effects->effect[k].count);
        first += effects->effect[k].count;
    }
    hci_long_text_add(text, "};\n\n");
}

void hci_fmu_machine_code(const hci_fmu_machine_model *m, hci_long_text *text)
{
    const hci_machine *machine = &m->machine->model;
    const size_t effects = m->request->effects ? m->request->effects->count : 0;
    hci_long_text_add(text, "#include \"core_effects_type.h\"\n#include \"fmu_machine_data.h\"\n"
                            "#include \"fmu_model.h\"\n\n");
    hci_fmu_code_start(m->start, HCI_FMU_MACHINE_COUNT, text);
    hci_fmu_code_arrays("MACHINE", machine, &m->setup.inductance, text);
    add_effects(m->request->effects, text);
    hci_long_text_add(text, "const hci_fmu_machine_data hci_fmu_machine = {\n    ");
    hci_fmu_code_machine("MACHINE", machine, text);
    hci_long_text_add(text, ",\n    ");
    hci_fmu_code_inductance("MACHINE", &m->setup.inductance, text);
    hci_long_text_add(text, ",\n    {%s, %zu},\n    %d, /* points */\n    %s\n};\n",
                      effects ? "EFFECTS" : "0", effects, m->setup.drive.plant.table.points,
                      m->request->imposed ? "true" : "false");
}
