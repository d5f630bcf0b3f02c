/* A drive's controller as a model: the emitted orders, read by the code of a target, and the PI current loop
 * of the simulated drive.
 *
 * Outputs are those that act from the present instant on. So the next step of the control is made ahead, on a
 * copy, from the inputs as they are; a communication step then takes it over. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/drive/table_code.h"
#include "fmu/controller_data.h"
#include "fmu/controller_variables.h"
#include "fmu/model.h"
#include "hci/drive/control.h"
#include "hci/machine/frames.h"

#define VALUE(key) (m->head.value[HCI_FMU_CONTROLLER_##key])

const hci_fmu_variable hci_fmu_list[] = {HCI_FMU_CONTROLLER_VARIABLES(HCI_FMU_ENTRY)};
const size_t hci_fmu_count = HCI_FMU_CONTROLLER_COUNT;

struct hci_fmu_model {
    hci_fmu_head head;
    double *rows;  /* of the known machine's table over the angle */
    float *memory; /* of the tables that are made of the orders */
    hci_plant_table table;
    hci_table_code code;
    hci_reference_code asked;
    hci_current_source source;
    hci_control control;
    hci_control_state state;
};
const size_t hci_fmu_model_size = sizeof(hci_fmu_model);

typedef struct {
    hci_control_state state;
    float made_rad_per_s; /* speed for which the tables were made */
} saved_state;

/* ---- its memory ---- */

bool hci_fmu_make(hci_fmu_model *m)
{
    const hci_fmu_controller_data *d = &hci_fmu_controller;
    m->rows = calloc(hci_plant_table_size(d->points), sizeof *m->rows);
    m->memory = calloc(hci_loop_floats(d->loop, HCI_LOOP_FEEDFORWARD), sizeof *m->memory);
    return m->rows && m->memory &&
           hci_plant_table_fill(&d->known, &d->inductance, d->points, m->rows, &m->table) == HCI_OK;
}

void hci_fmu_release(hci_fmu_model *m)
{
    free(m->rows);
    free(m->memory);
}

/* ---- parameters ---- */

static const char *check_parameters(hci_fmu_model *m)
{
    if (!(VALUE(REMEDY) >= 1.0 && VALUE(REMEDY) <= 4.0)) return "remedy is none of the four";
    if (!(VALUE(DC_LINK) > 0.0)) return "dc_link_voltage has to be above 0";
    if (!(VALUE(KP) >= 0.0 && VALUE(KI) >= 0.0)) return "current_kp and current_ki have to be 0 or more";
    if (!(VALUE(KP_Q) >= 0.0 && VALUE(KI_Q) >= 0.0))
        return "current_kp_q and current_ki_q have to be 0 or more";
    if (!(VALUE(FILTER) >= 0.0 && VALUE(FILTER) <= 1.0)) return "current_filter has to be 0 to 1";
    if (!(VALUE(QUANTUM) >= 0.0)) return "current_quantum has to be 0 or more";
    if (!(VALUE(COUNTS) >= 0.0 && VALUE(COUNTS) <= 1e9)) return "encoder_counts has to be 0 to 1e9";
    return NULL;
}

static void set_loop(hci_fmu_model *m)
{
    const hci_fmu_controller_data *d = &hci_fmu_controller;
    hci_current_pi *pi = &m->control.current;
    pi->pi[0] = (hci_pi){VALUE(KP), VALUE(KI)};
    pi->pi[1] = (hci_pi){VALUE(KP_Q), VALUE(KI_Q)};
    pi->filter = VALUE(FILTER);
    pi->decoupled = d->decoupled;
    pi->delay_steps = d->delay_steps;
    pi->modulation = d->modulation;
    pi->dead_time = (hci_dead_time){VALUE(DEAD_TIME_VOLTAGE), VALUE(DEAD_TIME_CROSSING)};
}

static void set_control(hci_fmu_model *m)
{
    const hci_fmu_controller_data *d = &hci_fmu_controller;
    hci_control *c = &m->control;
    memset(c, 0, sizeof *c);
    c->table = &m->table;
    c->step_s = d->step_s;
    c->dc_link_V = VALUE(DC_LINK);
    c->speed_every = c->current_every = d->every;
    c->torque_limit_Nm = c->id_limit = c->iq_limit = c->peak_limit_A = HUGE_VAL;
    c->sources = &m->source;
    c->source_count = 1;
    c->loop = HCI_CURRENT_PI;
    set_loop(m);
}

static void set_code(hci_fmu_model *m)
{
    memset(&m->code, 0, sizeof m->code);
    memset(&m->source, 0, sizeof m->source);
    m->code.pole_pairs = (uint32_t)m->table.pole_pairs;
    m->code.counts = (uint32_t)VALUE(COUNTS);
    hci_loop_start(&m->code.tables, hci_fmu_controller.loop, (hci_loop_remedy)(VALUE(REMEDY) - 1.0),
                   m->memory);
    m->asked = (hci_reference_code){hci_table_code_at, &m->code};
    m->source.code = &m->asked;
}

/* ---- the start ---- */

static float electrical_speed(const hci_fmu_model *m)
{
    return (float)(VALUE(SPEED) * m->table.pole_pairs);
}

const char *hci_fmu_to_initial_state(hci_fmu_model *m)
{
    const char *words = check_parameters(m);
    memset(&m->state, 0, sizeof m->state);
    if (words) return words;
    set_control(m);
    set_code(m);
    hci_loop_make(&m->code.tables, electrical_speed(m));
    return NULL;
}

/* ---- a step ---- */

static double to_nearest(double value, double quantum)
{
    return quantum > 0.0 ? quantum * floor(value / quantum + 0.5) : value;
}

static void make_step(const hci_fmu_model *m, hci_control_state *state)
{
    const double quantum_A = VALUE(QUANTUM), counts = VALUE(COUNTS);
    const hci_measurement measured = {{to_nearest(VALUE(IA), quantum_A), to_nearest(VALUE(IB), quantum_A),
                                       to_nearest(VALUE(IC), quantum_A)},
                                      to_nearest(VALUE(ANGLE), counts > 0.0 ? 2.0 * HCI_PI / counts : 0.0),
                                      VALUE(SPEED)};
    hci_control_step(&m->control, state, &measured, VALUE(TORQUE_REFERENCE));
}

/* Longer than a sample the control would not see what its voltages do. */
static const char *check_step(hci_fmu_model *m, double duration_s, double steps)
{
    const double step_s = hci_fmu_controller.step_s, most = hci_fmu_controller.every;
    if (steps >= 1.0 && steps <= most && fabs(duration_s - steps * step_s) <= 1e-6 * step_s) return NULL;
    snprintf(m->head.words, sizeof m->head.words,
             "a communication step of %g s, expected a multiple of %g s, in which the controller counts its "
             "delays, up to its sample of %g s",
             duration_s, step_s, most * step_s);
    return m->head.words;
}

const char *hci_fmu_step(hci_fmu_model *m, double duration_s)
{
    const double steps = floor(duration_s / hci_fmu_controller.step_s + 0.5);
    const char *words = check_step(m, duration_s, steps);
    if (words) return words;
    if (hci_loop_is_old(&m->code.tables, electrical_speed(m)))
        hci_loop_make(&m->code.tables, electrical_speed(m));
    for (double k = 0.0; k < steps; k += 1.0)
        make_step(m, &m->state);
    return NULL;
}

/* ---- outputs ---- */

const char *hci_fmu_update(hci_fmu_model *m)
{
    double reference_A[3];
    hci_control_state ahead = m->state;
    make_step(m, &ahead);
    hci_plane_to_abc(ahead.v, &VALUE(VA));
    hci_plane_to_abc(ahead.reference, reference_A);
    const hci_dq dq = hci_park(hci_clarke(reference_A), m->table.pole_pairs * VALUE(ANGLE));
    VALUE(ID_REFERENCE) = dq.d;
    VALUE(IQ_REFERENCE) = dq.q;
    return NULL;
}

/* ---- saved states ---- */

size_t hci_fmu_state_size(const hci_fmu_model *m)
{
    (void)m;
    return sizeof(saved_state);
}

void hci_fmu_state_save(const hci_fmu_model *m, void *memory)
{
    saved_state s;
    memset(&s, 0, sizeof s);
    s.state = m->state;
    s.made_rad_per_s = m->code.tables.made_rad_per_s;
    memcpy(memory, &s, sizeof s);
}

const char *hci_fmu_state_load(hci_fmu_model *m, const void *memory, size_t size)
{
    saved_state s;
    if (size != sizeof s) return "these bytes are no state of this FMU";
    const char *words = hci_fmu_to_initial_state(m);
    if (words) return words;
    memcpy(&s, memory, sizeof s);
    m->state = s.state;
    hci_loop_make(&m->code.tables, s.made_rad_per_s);
    return NULL;
}
