#include "host/drive/coarse_angle.h"

#include <math.h>

#include "hci/host/drive/drive.h"
#include "hci/machine/torque.h"
#include "host/base/memory.h"
#include "host/base/quote.h"
#include "host/machine/machine_plant.h"

bool hci_angle_is_coarse(double counts, int pole_pairs, double highest_order)
{
    return counts > 0.0 && counts < 2.0 * highest_order * pole_pairs;
}

enum { ANGLES_OF_COUNT = 16, LEAST_ANGLES = 4096 };

typedef struct {
    const hci_machine *machine;
    const hci_effects *effects; /* or NULL */
    hci_loop_tables tables;
    double counts, torque_Nm;
} coarse;

static double torque_at(const coarse *c, double theta_rad, const double abc[3])
{
    const hci_sample truth = {.theta_m_rad = theta_rad / c->machine->pole_pairs,
                              .i_abc = {abc[0], abc[1], abc[2]},
                              .temperature_C = (double)NAN};
    const double torque_Nm = hci_torque_at(c->machine, theta_rad, abc);
    if (!c->effects || c->effects->count == 0) return torque_Nm;
    return torque_Nm + hci_effects_torque(c->machine, c->effects, &truth, NULL).torque_Nm;
}

/* turn: share of a mechanical turn. */
static double held_torque(const coarse *c, double turn)
{
    const double pairs = c->machine->pole_pairs, read = floor(turn * c->counts + 0.5) / c->counts;
    const double periods = read * pairs / c->tables.loop->period_turns;
    const hci_loop_reference i = hci_loop_at(
        &c->tables, (uint32_t)((periods - floor(periods)) * 4294967295.0), (float)c->torque_Nm, 0.0f);
    double abc[3];
    hci_machine_plant_phases(2.0 * HCI_PI * pairs * read, (const double[2]){(double)i.id_A, (double)i.iq_A},
                             abc);
    return torque_at(c, 2.0 * HCI_PI * pairs * turn, abc);
}

double hci_coarse_mean_Nm(const hci_loop_f32 *loop, const hci_machine *machine, const hci_effects *effects,
                          double counts, double torque_Nm)
{
    const size_t angles = (size_t)counts * (ANGLES_OF_COUNT + (size_t)(LEAST_ANGLES / counts));
    coarse c = {.machine = machine, .effects = effects, .counts = counts, .torque_Nm = torque_Nm};
    double sum = 0.0;
    float *memory = hci_memory_new(hci_loop_floats(loop, HCI_LOOP_TABLE), sizeof *memory);
    if (!memory) return (double)NAN;
    hci_loop_start(&c.tables, loop, HCI_LOOP_TABLE, memory);
    hci_loop_make(&c.tables, 0.0f);
    for (size_t k = 0; k < angles; ++k)
        sum += held_torque(&c, ((double)k + 0.5) / (double)angles);
    hci_memory_free(memory);
    return sum / (double)angles;
}

/* ---- words ---- */

void hci_drive_remark_counts(const hci_drive_data *drive, int pole_pairs, double highest_order,
                             double torque_Nm, double mean_Nm, hci_note *remark)
{
    const double counts = drive->encoder_counts;
    char path[HCI_QUOTE_PATH_SIZE];
    if (!hci_angle_is_coarse(counts, pole_pairs, highest_order)) return;
    hci_note_add(
        remark,
        "%s: `encoder_counts` of %g are %.4g to an electrical turn, fewer than twice the highest order "
        "of the table, %.4g: its orders act as others, and on the mean; expected at least %.6g",
        drive->path[0] ? hci_quote_path(drive->path, path) : "drive.csv", counts, counts / pole_pairs,
        highest_order, ceil(2.0 * highest_order * pole_pairs));
    if (isfinite(mean_Nm))
        hci_note_add(remark,
                     "read in the middle of each count the table makes %.4g of %.4g N·m at low speed, and "
                     "with a remedy another mean at each speed",
                     mean_Nm, torque_Nm);
}
