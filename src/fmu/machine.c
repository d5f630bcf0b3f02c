/* The machine with its effects as a model: the plant of the simulated drive, and its sensors. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmu/machine_data.h"
#include "fmu/machine_variables.h"
#include "fmu/model.h"
#include "hci/effects/attach.h"
#include "hci/machine/frames.h"

#define VALUE(key) (m->head.value[HCI_FMU_MACHINE_##key])

const hci_fmu_variable hci_fmu_list[] = {HCI_FMU_MACHINE_VARIABLES(HCI_FMU_ENTRY)};
const size_t hci_fmu_count = HCI_FMU_MACHINE_COUNT;

struct hci_fmu_model {
    hci_fmu_head head;
    double *rows; /* of the table over the angle */
    double *ring; /* readings that are on their way, of all sensors */
    size_t ring_size;
    hci_drive drive; /* its plant and its sensors */
    hci_drive_state state;
    hci_sensor sensor[HCI_SENSE_COUNT];
    hci_effects_attachment effects;
};
const size_t hci_fmu_model_size = sizeof(hci_fmu_model);

/* What a saved state consists of; the ring follows it. */
typedef struct {
    hci_plant_state plant;
    hci_measurement measured;
    double torque_measured_Nm;
    hci_sensor_state sensor[HCI_SENSE_COUNT]; /* but for its pointer */
    double memory[HCI_SENSE_COUNT][HCI_EFFECT_LINKS][8];
} saved_state;

/* ---- its memory ---- */

bool hci_fmu_make(hci_fmu_model *m)
{
    const hci_fmu_machine_data *d = &hci_fmu_machine;
    m->rows = calloc(hci_plant_table_size(d->points), sizeof *m->rows);
    return m->rows && hci_plant_table_fill(&d->machine, &d->inductance, d->points, m->rows,
                                           &m->drive.plant.table) == HCI_OK;
}

void hci_fmu_release(hci_fmu_model *m)
{
    free(m->rows);
    free(m->ring);
}

/* ---- parameters ---- */

static const char *wrong(hci_fmu_model *m, const char *what, double value, const char *expected)
{
    snprintf(m->head.words, sizeof m->head.words, "%s is %g, expected %s", what, value, expected);
    return m->head.words;
}

static const char *check_parameters(hci_fmu_model *m)
{
    if (!(VALUE(STEP) > 0.0)) return wrong(m, "step", VALUE(STEP), "a time above 0");
    if (!(VALUE(RESISTANCE) >= 0.0)) return wrong(m, "resistance", VALUE(RESISTANCE), "0 or more");
    if (!(VALUE(VISCOUS) >= 0.0)) return wrong(m, "viscous_friction", VALUE(VISCOUS), "0 or more");
    if (!(VALUE(COULOMB) >= 0.0)) return wrong(m, "coulomb_friction", VALUE(COULOMB), "0 or more");
    if (!(VALUE(INERTIA) > 0.0) && !(VALUE(IS_PRESCRIBED) > 0.0))
        return wrong(m, "inertia", VALUE(INERTIA), "above 0, or speed_is_prescribed true");
    return NULL;
}

static void set_plant(hci_fmu_model *m)
{
    const bool is_prescribed = VALUE(IS_PRESCRIBED) > 0.0;
    hci_plant *plant = &m->drive.plant;
    plant->resistance_ohm = VALUE(RESISTANCE);
    plant->inertia_kgm2 = is_prescribed ? HUGE_VAL : VALUE(INERTIA);
    plant->viscous_Nms = is_prescribed ? 0.0 : VALUE(VISCOUS);
    plant->coulomb_Nm = is_prescribed ? 0.0 : VALUE(COULOMB);
    plant->effects = NULL;
    plant->effect_count = 0;
    m->drive.control.step_s = VALUE(STEP);
    m->drive.dead_time.voltage_V = VALUE(DEAD_TIME_VOLTAGE);
    m->drive.dead_time.crossing_A = VALUE(DEAD_TIME_CROSSING);
    m->drive.sensors = NULL;
}

static const char *put_effects(hci_fmu_model *m)
{
    const hci_effects_plant plant = {&hci_fmu_machine.machine, &hci_fmu_machine.effects, VALUE(TEMPERATURE)};
    hci_effects_refusal refusal;
    memset(m->sensor, 0, sizeof m->sensor);
    if (hci_fmu_machine.effects.count == 0) return NULL;
    if (hci_effects_put(&plant, &m->state.plant, &m->drive, m->sensor, &m->effects, &refusal) == HCI_OK)
        return NULL;
    if (refusal.reason == HCI_EFFECTS_DRIVING)
        return wrong(m, "Coulomb friction with that of the effects", refusal.value, "0 N.m or more");
    return wrong(m, "the delay of a sensor", refusal.value, "0 s to a million times the parameter step");
}

/* Memory for the delays; its pointers into the sensors. */
static const char *make_ring(hci_fmu_model *m)
{
    size_t size = 0, at = 0;
    for (int k = 0; k < HCI_SENSE_COUNT; ++k)
        size += hci_sensor_workspace(&m->sensor[k]);
    double *ring = calloc(size + 1, sizeof *ring);
    if (!ring) return "memory is out";
    free(m->ring);
    m->ring = ring;
    m->ring_size = size;
    for (int k = 0; k < HCI_SENSE_COUNT; ++k) {
        m->state.sensors[k].ring = m->ring + at;
        at += hci_sensor_workspace(&m->sensor[k]);
    }
    return NULL;
}

static const char *make_drive(hci_fmu_model *m)
{
    const char *words = check_parameters(m);
    memset(&m->state, 0, sizeof m->state);
    if (words) return words;
    set_plant(m);
    words = put_effects(m);
    return words ? words : make_ring(m);
}

/* ---- the start ---- */

static void start_sensors(hci_fmu_model *m)
{
    const hci_plant_state *plant = &m->state.plant;
    const double first[HCI_SENSE_COUNT] = {0.0, 0.0, 0.0, plant->theta_m_rad, plant->speed_rad_per_s, 0.0};
    for (int k = 0; k < HCI_SENSE_COUNT; ++k)
        hci_sensor_start(&m->sensor[k], &m->state.sensors[k], m->state.sensors[k].ring,
                         HCI_SENSE_COUNT + (uint64_t)k, first[k]);
}

const char *hci_fmu_to_initial_state(hci_fmu_model *m)
{
    const double turn = 2.0 * HCI_PI;
    const char *words = make_drive(m);
    if (words) return words;
    hci_plant_state *plant = &m->state.plant;
    plant->theta_m_rad = fmod(VALUE(ANGLE_START), turn);
    if (plant->theta_m_rad < 0.0) plant->theta_m_rad += turn;
    plant->speed_rad_per_s = VALUE(IS_PRESCRIBED) > 0.0 ? VALUE(SPEED_PRESCRIBED) : VALUE(SPEED_START);
    start_sensors(m);
    hci_drive_measure(&m->drive, &m->state);
    return NULL;
}

/* ---- a step ---- */

#define MOST_PARTS 1e9

/* A delay is so many internal steps; where there is one, these have to be as long as the parameter says. */
static const char *check_step(hci_fmu_model *m, double parts, double step_s)
{
    if (!(parts <= MOST_PARTS))
        return "a communication step of more than 1e9 internal steps, which would take a quarter of an hour; "
               "give a shorter one, or a longer parameter step";
    if (m->ring_size == 0 || fabs(step_s - VALUE(STEP)) <= 1e-6 * VALUE(STEP)) return NULL;
    snprintf(m->head.words, sizeof m->head.words,
             "sensors of this machine have a delay, so that a communication step has to be a multiple of "
             "the parameter step, %g s",
             VALUE(STEP));
    return m->head.words;
}

static void hold_inputs(hci_fmu_model *m, double held[2])
{
    hci_plane_from_abc(hci_fmu_machine.imposed ? &VALUE(IA_IMPOSED) : &VALUE(VA), held);
    if (VALUE(IS_PRESCRIBED) > 0.0) m->state.plant.speed_rad_per_s = VALUE(SPEED_PRESCRIBED);
    m->effects.plant.temperature_C = VALUE(TEMPERATURE);
}

static void make_step(hci_fmu_model *m, const double held[2], double step_s)
{
    hci_plant_state *plant = &m->state.plant;
    const double theta_m_rad = plant->theta_m_rad, load_Nm = VALUE(LOAD_TORQUE);
    double v[2] = {held[0], held[1]};
    if (hci_fmu_machine.imposed) {
        m->state.torque_Nm = hci_plant_step_imposed(&m->drive.plant, plant, held, load_Nm, step_s);
    } else {
        hci_inverter_dead_time(&m->drive.dead_time, plant->i, -1.0, v);
        m->state.torque_Nm = hci_plant_step(&m->drive.plant, plant, v, load_Nm, step_s);
    }
    m->state.torque_measured_Nm = hci_sensor_read(
        &m->sensor[HCI_SENSE_TORQUE], &m->state.sensors[HCI_SENSE_TORQUE], m->state.torque_Nm, theta_m_rad);
    hci_drive_measure(&m->drive, &m->state);
}

static bool is_finite(const hci_plant_state *s)
{
    return isfinite(s->i[0]) && isfinite(s->i[1]) && isfinite(s->speed_rad_per_s) && isfinite(s->theta_m_rad);
}

const char *hci_fmu_step(hci_fmu_model *m, double duration_s)
{
    const double parts = fmax(ceil(duration_s / VALUE(STEP) - 1e-6), 1.0), step_s = duration_s / parts;
    const char *words = check_step(m, parts, step_s);
    double held[2];
    if (words) return words;
    hold_inputs(m, held);
    for (int k = 0; k < HCI_SENSE_COUNT; ++k)
        m->effects.probe[k].step_s = step_s;
    for (double k = 0.0; k < parts; k += 1.0)
        make_step(m, held, step_s);
    return is_finite(&m->state.plant) ? NULL
                                      : "the state left the finite numbers; give a smaller parameter step";
}

/* ---- outputs ---- */

static void update_currents(hci_fmu_model *m, double theta_rad, double i[2])
{
    if (hci_fmu_machine.imposed)
        hci_plane_from_abc(&VALUE(IA_IMPOSED), i);
    else
        memcpy(i, m->state.plant.i, sizeof m->state.plant.i);
    hci_plane_to_abc(i, &VALUE(IA));
    const hci_dq dq = hci_park(hci_clarke(&VALUE(IA)), theta_rad);
    VALUE(ID) = dq.d;
    VALUE(IQ) = dq.q;
}

const char *hci_fmu_update(hci_fmu_model *m)
{
    hci_plant_state at = m->state.plant;
    const double turn = 2.0 * HCI_PI, theta_rad = m->drive.plant.table.pole_pairs * at.theta_m_rad;
    update_currents(m, theta_rad, at.i);
    m->effects.plant.temperature_C = VALUE(TEMPERATURE);
    VALUE(TORQUE) = hci_plant_torque_Nm(&m->drive.plant, &at);
    VALUE(SPEED) = at.speed_rad_per_s;
    VALUE(ANGLE) = hci_plant_angle_rad(&at);
    VALUE(ANGLE_ELECTRICAL) = fmod(theta_rad, turn);
    memcpy(&VALUE(IA_MEASURED), m->state.measured.i_abc, sizeof m->state.measured.i_abc);
    VALUE(ANGLE_MEASURED) = m->state.measured.theta_m_rad;
    VALUE(SPEED_MEASURED) = m->state.measured.speed_rad_per_s;
    VALUE(TORQUE_MEASURED) = m->state.torque_measured_Nm;
    return NULL;
}

/* ---- saved states ---- */

size_t hci_fmu_state_size(const hci_fmu_model *m)
{
    return sizeof(saved_state) + m->ring_size * sizeof *m->ring;
}

void hci_fmu_state_save(const hci_fmu_model *m, void *memory)
{
    saved_state s;
    memset(&s, 0, sizeof s);
    s.plant = m->state.plant;
    s.measured = m->state.measured;
    s.torque_measured_Nm = m->state.torque_measured_Nm;
    for (int k = 0; k < HCI_SENSE_COUNT; ++k) {
        s.sensor[k] = m->state.sensors[k];
        s.sensor[k].ring = NULL;
        for (size_t j = 0; j < m->effects.probe[k].channel.count; ++j)
            memcpy(s.memory[k][j], m->effects.probe[k].channel.link[j].memory, sizeof s.memory[k][j]);
    }
    memcpy(memory, &s, sizeof s);
    if (m->ring_size > 0) memcpy((char *)memory + sizeof s, m->ring, m->ring_size * sizeof *m->ring);
}

static void restore_sensors(hci_fmu_model *m, const saved_state *s)
{
    for (int k = 0; k < HCI_SENSE_COUNT; ++k) {
        double *const ring = m->state.sensors[k].ring;
        m->state.sensors[k] = s->sensor[k];
        m->state.sensors[k].ring = ring;
        for (size_t j = 0; j < m->effects.probe[k].channel.count; ++j)
            memcpy(m->effects.probe[k].channel.link[j].memory, s->memory[k][j], sizeof s->memory[k][j]);
    }
}

const char *hci_fmu_state_load(hci_fmu_model *m, const void *memory, size_t size)
{
    saved_state s;
    const char *words = make_drive(m);
    if (words) return words;
    if (size != hci_fmu_state_size(m)) return "these bytes are no state of this FMU";
    memcpy(&s, memory, sizeof s);
    m->state.plant = s.plant;
    m->state.measured = s.measured;
    m->state.torque_measured_Nm = s.torque_measured_Nm;
    restore_sensors(m, &s);
    if (m->ring_size > 0) memcpy(m->ring, (const char *)memory + sizeof s, m->ring_size * sizeof *m->ring);
    return NULL;
}
