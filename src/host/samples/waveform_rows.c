#include "host/samples/waveform_rows.h"

#include <math.h>

#include "hci/machine/frames.h"

size_t hci_waveform_points_per_turn(const hci_solution *s)
{
    double top = 0.0;
    for (size_t k = 0; k < s->current.count; ++k)
        top = fmax(top, s->current.wave[k].order);
    for (size_t k = 0; k < s->order_count; ++k)
        top = fmax(top, s->order[k].torque_Nm.order);
    return (size_t)fmax(360.0, 8.0 * ceil(top));
}

/* With effects the spectrum, which holds every order, is all that says the torque without them at hand. */
static double torque_at(const hci_machine_data *m, const hci_solution *s, double theta_rad,
                        const double abc[3])
{
    double sum_Nm = 0.0;
    if (!s->with_effects) return hci_torque_at(&m->model, theta_rad, abc);
    for (size_t k = 0; k < s->order_count; ++k)
        sum_Nm += hci_harmonics_at(&s->order[k].torque_Nm, 1, theta_rad);
    return sum_Nm;
}

void hci_waveform_row(const hci_machine_data *machine, const hci_solution *solution, double theta_rad,
                      double row[HCI_WAVEFORM_COLUMNS])
{
    double *abc = row + 1;
    hci_waves_at(solution->current.wave, solution->current.count, theta_rad, abc);
    const hci_dq dq = hci_park(hci_clarke(abc), theta_rad);
    row[0] = theta_rad;
    row[4] = dq.d;
    row[5] = dq.q;
    row[6] = torque_at(machine, solution, theta_rad, abc);
}
