/* The plant: the machine as a table over the angle, the winding, and the shaft. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/machine/frames.h"
#include "host/base/memory.h"
#include "host/drive/effect_winding.h"
#include "host/simulate/setup_task.h"

enum { POINTS_PER_TURN = 4096 };

/* L from its slopes but for its mean: S = C'/(p m), C = −S'/(p m). The mean is a placeholder that makes L
 * positive definite. */
static hci_status integrate_slopes(const hci_setup_task *b, hci_plant_inductance *given)
{
    const hci_machine *m = &b->machine->model;
    hci_inductance *terms = hci_memory_new(m->slope_count + 1, sizeof *terms);
    double sum = 0.0;
    if (!terms) return hci_note_memory(b->note, NULL, "%zu inductance orders", m->slope_count);
    for (size_t k = 0; k < m->slope_count; ++k) {
        const double scale = m->pole_pairs * m->slope[k].order;
        terms[k + 1].order = m->slope[k].order;
        for (size_t q = 0; q < HCI_PHASE_MATRIX && scale > 0.0; ++q) {
            terms[k + 1].sine[q] = m->slope[k].cosine[q] / scale;
            terms[k + 1].cosine[q] = -m->slope[k].sine[q] / scale;
            sum += hypot(terms[k + 1].sine[q], terms[k + 1].cosine[q]);
        }
    }
    for (size_t q = HCI_AA; q <= HCI_CC; ++q)
        terms[0].cosine[q] = 4.0 * sum + 1e-3;
    b->setup->terms = terms;
    *given = (hci_plant_inductance){terms, m->slope_count + 1, 0.0, 0.0};
    return HCI_OK;
}

/* Rows of machine.csv that currents driven by a voltage need, all that are missing at once. */
static hci_status need_winding(const hci_setup_task *b)
{
    const hci_machine_data *m = b->machine;
    const bool has_table = m->inductance_count > 0 || m->model.slope_count > 0;
    const struct {
        const char *row;
        bool missing;
    } need[] = {{"resistance,VALUE,ohm,SOURCE", isnan(m->resistance_ohm)},
                {"inductance_d,VALUE,H,SOURCE", isnan(m->inductance_d_H) && !has_table},
                {"inductance_q,VALUE,H,SOURCE", isnan(m->inductance_q_H) && !has_table}};
    char rows[160] = "";
    for (size_t k = 0; k < sizeof need / sizeof *need; ++k)
        if (need[k].missing)
            snprintf(rows + strlen(rows), sizeof rows - strlen(rows), "%s`%s`", rows[0] ? ", " : "",
                     need[k].row);
    if (!rows[0]) return HCI_OK;
    return hci_note_set(
        b->note, HCI_ERROR_INPUT,
        "machine.csv: currents that a voltage drives need a resistance and inductances; add %s", rows);
}

/* Says whose the reluctance torque of L_d and L_q that differ is. */
static void take_difference(const hci_setup_task *b, hci_plant_inductance *given)
{
    if (fabs(given->d_H - given->q_H) <= 1e-9 * given->q_H) return;
    const double left_H = hci_effects_take_saliency(&b->machine->model, b->effects, &given->d_H, &given->q_H);
    if (left_H == 0.0)
        hci_note_add(&b->setup->remark,
                     "inductance_d and inductance_q differ, and the reluctance torque that follows is in "
                     "this simulation; `solve` reads inductance.csv only");
    else
        hci_note_add(
            &b->setup->remark,
            "inductance_d and inductance_q differ, and effects.csv has the reluctance torque: their mean "
            "is taken, and a difference of %.4g H from effects.csv",
            left_H);
}

/* L_d and L_q of machine.csv; where imposed currents do without them, placeholders. */
static hci_status take_d_and_q(const hci_setup_task *b, hci_plant_inductance *given)
{
    static const char WHO[] = "the change of currents needs";
    const hci_machine_data *m = b->machine;
    if (isnan(m->inductance_d_H) != isnan(m->inductance_q_H)) {
        hci_status status = hci_setup_need(b, m->inductance_d_H, "inductance_d", "H", WHO);
        if (!status) status = hci_setup_need(b, m->inductance_q_H, "inductance_q", "H", WHO);
        return status;
    }
    b->setup->has_inductance = !isnan(m->inductance_d_H);
    given->d_H = hci_value_or(m->inductance_d_H, 1e-3);
    given->q_H = hci_value_or(m->inductance_q_H, 1e-3);
    take_difference(b, given);
    return HCI_OK;
}

static hci_status choose_inductance(const hci_setup_task *b, hci_plant_inductance *given)
{
    const hci_machine_data *m = b->machine;
    const bool is_imposed = b->scenario->current_control == HCI_CURRENT_IDEAL;
    b->setup->has_inductance = true;
    *given = (hci_plant_inductance){m->inductance, m->inductance_count, 0.0, 0.0};
    if (m->inductance_count > 0) return HCI_OK;
    if (m->model.slope_count > 0 && !is_imposed)
        return hci_note_set(b->note, HCI_ERROR_INPUT,
                            "inductance.csv: slopes only, but currents that a voltage drives need the "
                            "inductances; give the columns "
                            "La_H … Mca_H, or `current_control,ideal` in the scenario");
    if (m->model.slope_count == 0) return take_d_and_q(b, given);
    b->setup->has_inductance = false;
    return integrate_slopes(b, given);
}

static hci_status fill_table(const hci_setup_task *b)
{
    hci_setup *p = b->setup;
    size_t points;
    int turns;
    hci_status status = b->scenario->current_control == HCI_CURRENT_IDEAL ? HCI_OK : need_winding(b);
    if (!status) status = choose_inductance(b, &p->inductance);
    if (status) return status;
    turns = hci_plant_table_turns(&b->machine->model, &p->inductance);
    if (turns == 0)
        return hci_note_set(b->note, HCI_ERROR_INPUT,
                            "cogging.csv: an order is no multiple of 1/pole_pairs, so that nothing repeats "
                            "after a mechanical turn; "
                            "check the orders, which are electrical");
    points = (size_t)turns * POINTS_PER_TURN;
    p->period_turns = (size_t)turns;
    p->rows = hci_memory_new(hci_plant_table_size(points), sizeof *p->rows);
    if (!p->rows) return hci_note_memory(b->note, NULL, "a table of %zu angles", points);
    status = hci_plant_table_fill(&b->machine->model, &p->inductance, points, p->rows, &p->drive.plant.table);
    p->drive.control.table = &p->drive.plant.table;
    if (status == HCI_ERROR_SINGULAR)
        return hci_note_set(b->note, HCI_ERROR_INPUT,
                            "the inductances are not positive definite at every angle; check inductance.csv, "
                            "or inductance_d and "
                            "inductance_q of machine.csv, which must be above zero");
    return status ? hci_note_set(b->note, status, "the tables of the machine: %s", hci_status_text(status))
                  : HCI_OK;
}

/* Friction of the shaft is the sum of what both say. */
static void remark_friction(const hci_setup_task *b, double declared_Nm)
{
    const double found_Nm = b->effects ? hci_effects_coulomb_Nm(b->effects) : 0.0;
    if (!(declared_Nm > 0.0) || !(found_Nm > 0.0)) return;
    hci_note_add(&b->setup->remark,
                 "coulomb_friction, %.4g N·m, and the friction of effects.csv, %.4g N·m, both act: %.4g N·m",
                 declared_Nm, found_Nm, declared_Nm + found_Nm);
}

static hci_status set_shaft(const hci_setup_task *b)
{
    const hci_scenario *s = b->scenario;
    const hci_machine_data *m = b->machine;
    hci_plant *plant = &b->setup->drive.plant;
    const double inertia = hci_value_or(s->inertia_kgm2, m->inertia_kgm2);
    plant->inertia_kgm2 = HUGE_VAL;
    hci_plant_state *start = &b->setup->state.plant;
    start->speed_rad_per_s =
        hci_value_or(s->prescribed_speed_rad_per_s, hci_value_or(s->initial_speed_rad_per_s, 0.0));
    start->theta_m_rad = fmod(hci_value_or(s->initial_angle_rad, 0.0) / m->pole_pairs, 2.0 * HCI_PI);
    if (start->theta_m_rad < 0.0) start->theta_m_rad += 2.0 * HCI_PI;
    if (b->setup->prescribed) return HCI_OK;
    plant->viscous_Nms =
        hci_value_or(s->viscous_friction_Nms_per_rad, hci_value_or(m->viscous_friction_Nms_per_rad, 0.0));
    plant->coulomb_Nm = hci_value_or(s->coulomb_friction_Nm, hci_value_or(m->coulomb_friction_Nm, 0.0));
    plant->inertia_kgm2 = inertia;
    remark_friction(b, plant->coulomb_Nm);
    if (inertia <= 0.0 || plant->viscous_Nms < 0.0 || plant->coulomb_Nm < 0.0)
        return hci_note_set(b->note, HCI_ERROR_INPUT,
                            "machine.csv: expected `inertia` above zero and friction of zero or more");
    return hci_setup_need(
        b, inertia, "inertia", "kgm2",
        "a rotor that turns freely needs (or give it, or `prescribed_speed`, in the scenario)");
}

static hci_status set_resistance(const hci_setup_task *b)
{
    const double resistance = b->machine->resistance_ohm;
    b->setup->drive.plant.resistance_ohm = resistance;
    if (resistance < 0.0)
        return hci_note_set(b->note, HCI_ERROR_INPUT, "machine.csv: expected `resistance` of zero or more");
    return HCI_OK;
}

hci_status hci_setup_plant(const hci_setup_task *b)
{
    hci_status status = HCI_OK;
    b->setup->machine = &b->machine->model;
    if (b->machine->has_neutral)
        status = hci_note_set(b->note, HCI_ERROR_INPUT,
                              "machine.csv: connection `star-neutral`, but only a star without neutral "
                              "conductor can be simulated; set "
                              "it to `star` to do without the neutral");
    if (!status) status = fill_table(b);
    if (!status) status = set_resistance(b);
    return status ? status : set_shaft(b);
}
