/* In: a table with levels of torque, and the plant; out: how far the torque between them is from what is
 * asked for. Wanted between two levels is the straight line between what these make, angle by angle, so that
 * a ripple of the levels themselves does not count. */
#include "host/drive/between_levels.h"

#include <math.h>

#include "hci/loop.h"
#include "host/base/memory.h"

enum { ANGLES_OF_TURN = 1021, PARTS = 4 };

typedef struct {
    const hci_machine_plant *plant;
    const hci_loop_f32 *loop;
    hci_loop_tables tables;
    size_t angles; /* of all turns of the table */
} reading;

static double torque_at(const reading *r, size_t k, double torque_Nm)
{
    const double share = (double)k / (double)r->angles;
    const double theta_rad = 2.0 * HCI_PI * share * (double)r->loop->period_turns;
    const hci_loop_reference i =
        hci_loop_at(&r->tables, (uint32_t)(share * 4294967296.0), (float)torque_Nm, 0.0f);
    double abc[3];
    hci_machine_plant_phases(theta_rad, (const double[2]){(double)i.id_A, (double)i.iq_A}, abc);
    return hci_machine_plant_torque_at(r->plant, theta_rad, abc, NULL);
}

/* At a share of the way between two levels. */
static void look(const reading *r, double low_Nm, double high_Nm, double share, hci_between_levels *x)
{
    const double asked_Nm = low_Nm + share * (high_Nm - low_Nm);
    double mean = 0.0, least = HUGE_VAL, most = -HUGE_VAL;
    for (size_t k = 0; k < r->angles; ++k) {
        const double off_Nm = torque_at(r, k, asked_Nm) - (1.0 - share) * torque_at(r, k, low_Nm) -
                              share * torque_at(r, k, high_Nm);
        mean += off_Nm / (double)r->angles;
        least = fmin(least, off_Nm);
        most = fmax(most, off_Nm);
    }
    if (fabs(mean) > fabs(x->mean_off_Nm)) {
        x->mean_off_Nm = mean;
        x->mean_at_Nm = asked_Nm;
    }
    if (most - least > x->ripple_Nm) {
        x->ripple_Nm = most - least;
        x->ripple_at_Nm = asked_Nm;
    }
}

hci_status hci_between_levels_find(const hci_loop_set *set, const hci_machine_plant *plant,
                                   hci_between_levels *found, hci_note *note)
{
    const hci_loop_f32 *loop = &set->loop;
    const double low_Nm = (double)loop->torque_low_Nm, high_Nm = (double)loop->torque_high_Nm;
    reading r = {plant, loop, {0}, ANGLES_OF_TURN * (size_t)loop->period_turns};
    float *memory = hci_memory_new(hci_loop_floats(loop, HCI_LOOP_TABLE), sizeof *memory);
    *found = (hci_between_levels){0.0, 0.0, 0.0, 0.0};
    if (!memory) return hci_note_memory(note, NULL, "a table");
    hci_loop_start(&r.tables, loop, HCI_LOOP_TABLE, memory);
    hci_loop_make(&r.tables, 0.0f);
    for (uint32_t k = 0; k + 1 < loop->levels; ++k) {
        const double step_Nm = (high_Nm - low_Nm) / (double)(loop->levels - 1);
        for (int part = 1; part < PARTS; ++part)
            look(&r, low_Nm + k * step_Nm, low_Nm + (k + 1) * step_Nm, (double)part / PARTS, found);
    }
    hci_memory_free(memory);
    return HCI_OK;
}
