#include "host/drive/machine_model.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/drive/effect_winding.h"

enum { POINTS_PER_TURN = 4096 };

static hci_status need(double value, const char *name, const char *unit, hci_note *note)
{
    if (value > 0.0) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_INPUT,
                        "machine.csv: no `%s` above zero, which a current loop needs; add a row "
                        "`%s,VALUE,%s,SOURCE` there or in drive.csv",
                        name, name, unit);
}

/* L(θ) of inductance.csv, or L_d and L_q. */
static hci_status take_inductance(const hci_machine_data *m, hci_plant_inductance *given, hci_note *note)
{
    *given = (hci_plant_inductance){m->inductance, m->inductance_count, m->inductance_d_H, m->inductance_q_H};
    if (m->inductance_count > 0) {
        given->d_H = given->q_H = 0.0;
        return HCI_OK;
    }
    if (m->model.slope_count > 0)
        return hci_note_set(note, HCI_ERROR_INPUT,
                            "inductance.csv: slopes only, but a current loop needs the inductances; give the "
                            "columns La_H … Mca_H");
    const hci_status status = need(m->inductance_d_H, "inductance_d", "H", note);
    return status ? status : need(m->inductance_q_H, "inductance_q", "H", note);
}

static hci_status fill(const hci_machine *machine, const hci_plant_inductance *given, hci_machine_model *m,
                       hci_note *note)
{
    const int turns = hci_plant_table_turns(machine, given);
    if (turns == 0)
        return hci_note_set(
            note, HCI_ERROR_INPUT,
            "the tables of the machine: an order is no multiple of 1/pole_pairs, so that nothing "
            "repeats after a mechanical turn; check the orders, which are electrical");
    const size_t points = (size_t)turns * POINTS_PER_TURN;
    m->machine = *machine;
    m->inductance = *given;
    m->rows = hci_memory_new(hci_plant_table_size(points), sizeof *m->rows);
    if (!m->rows) return hci_note_memory(note, NULL, "a table of %zu angles", points);
    const hci_status status = hci_plant_table_fill(machine, given, points, m->rows, &m->table);
    if (!status) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_INPUT,
                        "the inductances are not positive definite at every angle; check inductance.csv, or "
                        "inductance_d and inductance_q");
}

/* Means of L seen from the rotor: d = (−cos θ, −sin θ), q = (sin θ, −cos θ). */
static void take_means(hci_machine_model *m)
{
    m->inductance_H[0] = m->inductance_H[1] = 0.0;
    for (int k = 0; k < m->table.points; ++k) {
        const double theta = 2.0 * HCI_PI * m->table.turns * k / m->table.points, s = sin(theta),
                     c = cos(theta);
        const hci_plant_point p = hci_plant_table_at(&m->table, theta / m->table.pole_pairs);
        const double *l = p.inductance_H;
        m->inductance_H[0] += (c * c * l[0] + 2.0 * s * c * l[1] + s * s * l[2]) / m->table.points;
        m->inductance_H[1] += (s * s * l[0] - 2.0 * s * c * l[1] + c * c * l[2]) / m->table.points;
    }
}

hci_status hci_machine_model_make_whole(const hci_machine_data *machine, const hci_effects *effects,
                                        hci_machine_model *m, hci_note *note)
{
    hci_plant_inductance given;
    hci_status status = need(machine->resistance_ohm, "resistance", "ohm", note);
    memset(m, 0, sizeof *m);
    if (!status) status = take_inductance(machine, &given, note);
    if (!status && given.count == 0)
        hci_effects_take_saliency(&machine->model, effects, &given.d_H, &given.q_H);
    if (!status) status = fill(&machine->model, &given, m, note);
    if (status) {
        hci_machine_model_release(m);
        return status;
    }
    m->resistance_ohm = machine->resistance_ohm;
    m->effects = effects;
    take_means(m);
    return HCI_OK;
}

hci_status hci_machine_model_make(const hci_machine_data *machine, hci_machine_model *m, hci_note *note)
{
    return hci_machine_model_make_whole(machine, NULL, m, note);
}

hci_status hci_machine_model_make_constant(const hci_machine_data *machine, hci_machine_model *m,
                                           hci_note *note)
{
    hci_machine_model whole;
    hci_machine plain = {.pole_pairs = machine->model.pole_pairs};
    hci_status status = hci_machine_model_make(machine, &whole, note);
    memset(m, 0, sizeof *m);
    if (status) return status;
    const hci_plant_inductance given = {NULL, 0, whole.inductance_H[0], whole.inductance_H[1]};
    for (size_t k = 0; k < machine->model.back_emf_count; ++k)
        if (fabs(machine->model.back_emf[k].order - 1.0) < HCI_ORDER_TOLERANCE &&
            machine->model.back_emf[k].sequence == 1) {
            plain.back_emf = &machine->model.back_emf[k];
            plain.back_emf_count = 1;
        }
    status = fill(&plain, &given, m, note);
    m->resistance_ohm = machine->resistance_ohm;
    memcpy(m->inductance_H, whole.inductance_H, sizeof m->inductance_H);
    hci_machine_model_release(&whole);
    if (status) hci_machine_model_release(m);
    return status;
}

void hci_machine_model_release(hci_machine_model *m)
{
    hci_memory_free(m->rows);
    memset(m, 0, sizeof *m);
}

hci_loop_model hci_drive_loop(const hci_drive_data *drive, const hci_machine_model *machine,
                              double speed_rad_per_s)
{
    return (hci_loop_model){.resistance_ohm = machine->resistance_ohm,
                            .inductance_H = {machine->inductance_H[0], machine->inductance_H[1]},
                            .kp_ohm = {drive->kp_ohm, drive->kp_q_ohm},
                            .ki_ohm_per_s = {drive->ki_ohm_per_s, drive->ki_q_ohm_per_s},
                            .filter = hci_drive_filter_share(drive),
                            .sample_s = drive->sample_s,
                            .delay_s = drive->computing_delay_s,
                            .speed_rad_per_s = speed_rad_per_s,
                            .decoupled = drive->decoupling != HCI_DECOUPLING_NONE};
}
