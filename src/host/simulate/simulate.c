/* The run: one step after another, each shown to the evaluation and to the observer. */
#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/currents/plain_sine.h"
#include "host/simulate/simulation.h"

typedef struct {
    hci_setup *setup;
    hci_evaluation *evaluation;
    const hci_simulation_observer *observer; /* or NULL */
} run;

static void start_sensors(hci_setup *setup)
{
    const hci_plant_state *plant = &setup->state.plant;
    const double first[HCI_SENSE_COUNT] = {0.0, 0.0, 0.0, plant->theta_m_rad, plant->speed_rad_per_s, 0.0};
    for (size_t k = 0; k < HCI_SENSE_COUNT; ++k)
        hci_sensor_start(&setup->sensor[k], &setup->state.sensors[k], setup->ring[k],
                         setup->seed * HCI_SENSE_COUNT + k, first[k]);
}

static double load_at(const hci_setup *setup, double time_s)
{
    return time_s >= setup->load_2_from_s - 0.5 * setup->drive.control.step_s ? setup->load_2_Nm
                                                                              : setup->load_Nm;
}

static hci_simulation_counts counts_of(const hci_control_state *control)
{
    return (hci_simulation_counts){control->hysteresis.switchings, control->unreached, control->limited,
                                   control->current.limited};
}

/* What held at the start of the step that has just been made; its counts are there already. */
static void fill_step(const hci_setup *setup, const hci_plant_state *before, double time_s, double load_Nm,
                      hci_simulation_step *step)
{
    const hci_drive *drive = &setup->drive;
    const bool imposed = drive->control.loop == HCI_CURRENT_IDEAL;
    hci_plant_state at = *before;
    for (int k = 0; k < 2; ++k) {
        at.i[k] = step->i_A[k] = imposed ? setup->state.control.reference[k] : before->i[k];
        step->v_V[k] = imposed ? setup->state.control.v[k] : setup->state.v[k];
    }
    step->time_s = time_s;
    step->theta_e_rad = drive->plant.table.pole_pairs * hci_plant_angle_rad(before);
    step->speed_rad_per_s = before->speed_rad_per_s;
    step->torque_Nm = setup->state.torque_Nm;
    step->load_Nm = load_Nm;
    step->point = hci_plant_at(&drive->plant, &at);
    step->state = &setup->state;
}

static bool is_finite(const hci_plant_state *s)
{
    return isfinite(s->i[0]) && isfinite(s->i[1]) && isfinite(s->speed_rad_per_s) && isfinite(s->theta_m_rad);
}

static hci_status make_step(const run *r, size_t k, hci_note *note)
{
    hci_setup *setup = r->setup;
    const double time_s = (double)k * setup->drive.control.step_s, load_Nm = load_at(setup, time_s);
    const bool evaluated = time_s >= setup->settle_s - 0.5 * setup->drive.control.step_s;
    const hci_plant_state before = setup->state.plant;
    hci_simulation_step step;
    step.counts = counts_of(&setup->state.control);
    hci_drive_step(&setup->drive, &setup->state, setup->set_point, load_Nm);
    if (!is_finite(&setup->state.plant))
        return hci_note_set(note, HCI_ERROR_NUMERIC,
                            "at %g s the state left the finite numbers; give a smaller `step`, or a "
                            "`speed_kp` or `current_kp` "
                            "that the step can follow",
                            time_s);
    if (!evaluated && !r->observer) return HCI_OK;
    fill_step(setup, &before, time_s, load_Nm, &step);
    if (evaluated) hci_evaluation_add(r->evaluation, &step);
    if (r->observer) r->observer->step(r->observer->context, &step);
    return HCI_OK;
}

static hci_status make_steps(const run *r, const hci_simulate_options *options, hci_note *note)
{
    const size_t steps = r->setup->steps, share = steps / 256 + 1;
    hci_status status = HCI_OK;
    start_sensors(r->setup);
    /* One step more than the duration has, for the values at its end. */
    for (size_t k = 0; k <= steps && !status; ++k) {
        status = make_step(r, k, note);
        if (k % share != 0 || status) continue;
        if (options->progress)
            options->progress(options->progress_context, "simulating", (double)k / (double)steps);
        if (options->stop && options->stop(options->stop_context))
            status = hci_note_set(note, HCI_ERROR_STOPPED, "the simulation was stopped at %g s",
                                  (double)k * r->setup->drive.control.step_s);
    }
    return status;
}

static hci_status begin_observer(const run *r, hci_note *note)
{
    const hci_setup *setup = r->setup;
    const hci_simulation_plan plan = {.step_s = setup->drive.control.step_s,
                                      .steps = setup->steps,
                                      .steps_per_row = setup->every,
                                      .settle_s = setup->settle_s,
                                      .temperature_C = setup->temperature_C,
                                      .pole_pairs = setup->drive.plant.table.pole_pairs,
                                      .has_voltage = setup->drive.control.loop != HCI_CURRENT_IDEAL,
                                      .has_command = setup->has_command,
                                      .has_sensors = setup->drive.sensors != NULL};
    if (!r->observer || !r->observer->begin) return HCI_OK;
    return r->observer->begin(r->observer->context, &plan, note);
}

/* What the ripple is compared with. A machine whose orders have no common period has nothing of the kind. */
static hci_status judge_plain(const hci_machine_data *machine, const hci_effects *effects, hci_simulation *s,
                              hci_note *note)
{
    const hci_target none = {NULL, 0};
    hci_note why = {{0}};
    hci_wave plain = hci_plain_sine(&machine->model, s->torque_Nm.mean);
    const hci_currents sine = {.wave = &plain, .count = 1};
    if (!(s->plain_amplitude_A > 0.0) || !isfinite(s->T_ripple_percent)) return HCI_OK;
    if (hci_evaluate_currents(machine, effects, &sine, &none, &s->plain, &why) != HCI_ERROR_MEMORY)
        return HCI_OK;
    *note = why;
    return HCI_ERROR_MEMORY;
}

static hci_status run_setup(const hci_machine_data *machine, const hci_simulate_options *options,
                            hci_setup *setup, hci_simulation *simulation, hci_note *note)
{
    const run r = {setup, hci_evaluation_new(setup), options->observer};
    hci_status status = HCI_OK;
    if (!r.evaluation) return hci_note_memory(note, NULL, "the evaluation");
    status = begin_observer(&r, note);
    if (!status) status = make_steps(&r, options, note);
    if (!status) status = hci_evaluation_finish(r.evaluation, simulation, note);
    if (!status) status = judge_plain(machine, options->effects, simulation, note);
    hci_evaluation_free(r.evaluation);
    return status;
}

hci_status hci_simulate(const hci_machine_data *machine, const hci_scenario *scenario,
                        const hci_simulate_options *options, hci_simulation *simulation, hci_note *note)
{
    hci_setup *setup = hci_memory_new(1, sizeof *setup);
    hci_status status;
    memset(simulation, 0, sizeof *simulation);
    if (!setup) return hci_note_memory(note, NULL, "the simulation");
    status = hci_setup_make(machine, options, scenario, setup, note);
    simulation->remark = setup->remark;
    simulation->imposed = scenario->currents[0] != '\0';
    if (!status) status = run_setup(machine, options, setup, simulation, note);
    if (status) hci_simulation_release(simulation);
    hci_setup_release(setup);
    hci_memory_free(setup);
    return status;
}

void hci_simulation_release(hci_simulation *simulation)
{
    hci_memory_free(simulation->spectrum_Nm);
    hci_torque_evaluation_release(&simulation->plain);
    memset(simulation, 0, sizeof *simulation);
}
