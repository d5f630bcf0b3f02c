/* From machine and scenario to a drive: what it is to do, its time, and all of its parts. */
#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/simulate/setup_task.h"

enum { IDEAL_STEPS_PER_TURN = 2048, ROWS_WANTED = 20000 };

#define MOST_STEPS 4e9

/* ---- what the drive is to do ---- */

static hci_status check_set_points(const hci_setup_task *b)
{
    const hci_scenario *s = b->scenario;
    const bool speed = !isnan(s->speed_reference_rad_per_s), torque = !isnan(s->torque_reference_Nm);
    const bool imposed = s->currents[0] != '\0', prescribed = !isnan(s->prescribed_speed_rad_per_s);
    if (isnan(s->duration_s)) return hci_setup_wrong(b, "no `duration`; add a row `duration,VALUE,s`");
    if (prescribed && speed)
        return hci_setup_wrong(
            b, "`prescribed_speed` leaves a speed loop nothing to do; delete it or `speed_reference`");
    if (prescribed && !isnan(s->initial_speed_rad_per_s))
        return hci_setup_wrong(b,
                               "`prescribed_speed` is the speed from the start on; delete `initial_speed`");
    if (speed && torque)
        return hci_setup_wrong(
            b, "`speed_reference` and `torque_reference` are two set points; delete one of them");
    if (!speed && !torque && !imposed)
        return hci_setup_wrong(b,
                               "no set point; add a row `speed_reference`, `torque_reference` or `currents`");
    if (isnan(s->load_torque_2_Nm) != isnan(s->load_torque_2_from_s))
        return hci_setup_wrong(b, "`load_torque_2` and `load_torque_2_from` go together; add the other row");
    return HCI_OK;
}

static void set_times_and_loads(const hci_setup_task *b)
{
    const hci_scenario *s = b->scenario;
    hci_setup *p = b->setup;
    p->prescribed = !isnan(s->prescribed_speed_rad_per_s);
    p->drive.control.speed_controlled = !isnan(s->speed_reference_rad_per_s);
    p->has_command = p->drive.control.speed_controlled || !isnan(s->torque_reference_Nm);
    p->set_point = p->drive.control.speed_controlled ? s->speed_reference_rad_per_s
                                                     : hci_value_or(s->torque_reference_Nm, 0.0);
    p->load_Nm = hci_value_or(s->load_torque_Nm, 0.0);
    p->load_2_Nm = hci_value_or(s->load_torque_2_Nm, 0.0);
    p->load_2_from_s = hci_value_or(s->load_torque_2_from_s, HUGE_VAL);
    p->seed = (uint64_t)hci_value_or(s->seed, 1.0);
    p->highest_order = (size_t)hci_value_or(s->highest_order, 60.0);
}

/* ---- time ---- */

static double default_step_s(const hci_setup_task *b)
{
    const hci_scenario *s = b->scenario;
    const double speed = fabs(hci_value_or(s->prescribed_speed_rad_per_s, 0.0));
    if (s->current_control == HCI_CURRENT_HYSTERESIS) return 1e-6;
    if (s->current_control == HCI_CURRENT_PI) return 0.1 * hci_value_or(s->current_sample_time_s, 1e-4);
    if (speed > 0.0) return 2.0 * HCI_PI / (b->machine->pole_pairs * speed * IDEAL_STEPS_PER_TURN);
    return 1e-5;
}

/* What is the same from beginning to end has no transient; else half of the time from the last change on is
 * left to it. */
static double default_settle_s(const hci_setup_task *b)
{
    const hci_scenario *s = b->scenario;
    const double last_s =
        fmax(hci_value_or(s->strategy_2_from_s, 0.0), hci_value_or(s->load_torque_2_from_s, 0.0));
    if (b->setup->prescribed && s->current_control == HCI_CURRENT_IDEAL)
        return hci_value_or(s->strategy_2_from_s, 0.0);
    return last_s + 0.5 * (s->duration_s - last_s);
}

/* A control that samples takes its samples at steps: as many to a sample as makes the step no longer than was
 * asked for. */
static double step_of(const hci_setup_task *b)
{
    const hci_scenario *s = b->scenario;
    const double step_s = hci_value_or(s->step_s, default_step_s(b));
    const double sample_s = hci_value_or(s->current_sample_time_s, 1e-4);
    return s->current_control == HCI_CURRENT_PI ? sample_s / ceil(sample_s / step_s * (1.0 - 1e-9)) : step_s;
}

static hci_status set_steps(const hci_setup_task *b)
{
    const hci_scenario *s = b->scenario;
    hci_setup *p = b->setup;
    const double step_s = step_of(b), steps = ceil(s->duration_s / step_s * (1.0 - 1e-12) - 1e-6);
    p->drive.control.step_s = step_s;
    p->settle_s = hci_value_or(s->settle_s, default_settle_s(b));
    if (steps < 2.0)
        return hci_setup_wrong(b, "`duration` is shorter than two steps of %g s; give a smaller `step`",
                               step_s);
    if (steps > MOST_STEPS)
        return hci_setup_wrong(
            b, "`duration` has %.3g steps of %g s; give a larger `step` or a shorter `duration`", steps,
            step_s);
    if (!(p->settle_s + 2.0 * step_s <= s->duration_s))
        return hci_setup_wrong(
            b,
            "`settle` (%g s) leaves nothing of `duration` (%g s) to evaluate; make one of them "
            "smaller or larger",
            p->settle_s, s->duration_s);
    p->steps = (size_t)steps;
    p->every = (size_t)hci_value_or(s->trajectory_every, ceil(steps / ROWS_WANTED));
    return HCI_OK;
}

/* ---- all of it ---- */

/* What effects.csv adds to the plant and to the sensors; all of it repeats after a mechanical turn. */
static hci_status add_effects(const hci_setup_task *b)
{
    hci_setup *p = b->setup;
    p->temperature_C = b->scenario->magnet_temperature_C;
    if (!b->effects && b->machine->has_effects)
        return hci_note_set(b->note, HCI_ERROR_INPUT,
                            "effects.csv: the machine has effects, and without them it is another one");
    if (!b->effects || b->effects->count == 0) return HCI_OK;
    p->period_turns = (size_t)b->machine->model.pole_pairs;
    const hci_effects_plant plant = {&b->machine->model, b->effects, p->temperature_C};
    return hci_effects_attach(&plant, &p->state.plant, &p->drive, p->sensor, &p->attachment, b->note);
}

hci_status hci_setup_make(const hci_machine_data *machine, const hci_simulate_options *options,
                          const hci_scenario *scenario, hci_setup *setup, hci_note *note)
{
    const hci_setup_task b = {machine, options->effects, options->loop, scenario, setup, note};
    hci_status status;
    memset(setup, 0, sizeof *setup);
    status = check_set_points(&b);
    if (status) return status;
    set_times_and_loads(&b);
    status = hci_setup_plant(&b);
    if (!status) status = set_steps(&b);
    if (!status) status = hci_setup_control(&b);
    if (!status) status = hci_setup_sources(&b);
    if (!status) status = hci_setup_sensors(&b);
    if (!status) status = add_effects(&b);
    return status ? status : hci_setup_delay_lines(&b);
}

void hci_setup_release(hci_setup *setup)
{
    hci_effects_detach(setup->attachment);
    hci_memory_free(setup->rows);
    hci_memory_free(setup->terms);
    hci_currents_release(&setup->fixed);
    hci_currents_release(&setup->per_Nm);
    for (int k = 0; k < HCI_SENSE_COUNT; ++k)
        hci_memory_free(setup->ring[k]);
}
