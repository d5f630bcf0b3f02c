#include "host/fleet/voltages.h"

#include <math.h>

#include "hci/machine/frames.h"
#include "host/numeric/normal_equations.h"

enum { EMF = HCI_VOLTAGES_MOST, EMF_ACROSS, COLUMNS };

#define TOLD 0.2 /* standard error over the value */

static bool is_usable(const hci_runs *runs, size_t k)
{
    const hci_run *r = &runs->run[k];
    return runs->role[k] == HCI_ROLE_FIT && r->v_V && r->i_A && r->theta_m_rad && r->speed_rad_per_s;
}

/* Sums over an electrical turn, in which what the currents change by has none. */
typedef struct {
    double row[2 * COLUMNS], known[2], samples;
} turn;

/* Adds the equations of u_d and u_q at a sample. */
static void add_sample(const hci_machine *machine, const hci_run *run, size_t k, turn *to)
{
    const double theta_rad = machine->pole_pairs * run->theta_m_rad[k], speed = run->speed_rad_per_s[k];
    const double omega = machine->pole_pairs * speed;
    double e_abc[3], slope[3];
    hci_torque_back_emf_at(machine, theta_rad, e_abc, slope);
    const hci_dq e = hci_park(hci_clarke(e_abc), theta_rad);
    const hci_dq i = hci_park(hci_clarke(&run->i_A[3 * k]), theta_rad);
    const hci_dq u = hci_park(hci_clarke(&run->v_V[3 * k]), theta_rad);
    const double row[2 * COLUMNS] = {i.d, 0.0,         -omega * i.q, speed * e.d, speed * e.q, //
                                     i.q, omega * i.d, 0.0,          speed * e.q, -speed * e.d};
    for (size_t j = 0; j < 2 * COLUMNS; ++j)
        to->row[j] += row[j];
    to->known[0] += u.d;
    to->known[1] += u.q;
    to->samples += 1.0;
}

static void end_turn(turn *x, hci_normal_equations *to)
{
    for (size_t j = 0; j < 2 * COLUMNS; ++j)
        x->row[j] /= x->samples;
    x->known[0] /= x->samples;
    x->known[1] /= x->samples;
    hci_normal_equations_add(to, x->row, x->known, 2);
    *x = (turn){.samples = 0.0};
}

/* Whole turns; what is left at the end is not used. */
static void add_run(const hci_machine *machine, const hci_run *run, hci_normal_equations *to)
{
    const double around_rad = 2.0 * HCI_PI / machine->pole_pairs;
    turn x = {.samples = 0.0};
    for (size_t k = 0, first = 0; k < run->count; ++k) {
        if (x.samples > 0.0 && fabs(run->theta_m_rad[k] - run->theta_m_rad[first]) >= around_rad) {
            end_turn(&x, to);
            first = k;
        }
        add_sample(machine, run, k, &x);
    }
}

static void take(const hci_normal_equations *normal, const hci_sweep *sweep, double value[],
                 double std_error[])
{
    const double variance = fmax(sweep->square, 0.0) / fmax(normal->rows - COLUMNS, 1.0);
    for (size_t k = 0; k < HCI_VOLTAGES_MOST; ++k) {
        const double error = sqrt(variance * sweep->a[k * COLUMNS + k]);
        if (!sweep->in[k] || !(error < TOLD * sweep->b[k])) continue;
        value[k] = sweep->b[k];
        std_error[k] = error;
    }
}

bool hci_voltages_fit(const hci_machine *machine, const hci_runs *runs, double value[HCI_VOLTAGES_MOST],
                      double std_error[HCI_VOLTAGES_MOST])
{
    hci_normal_equations normal = {0};
    hci_sweep sweep = {0};
    for (size_t k = 0; k < HCI_VOLTAGES_MOST; ++k)
        value[k] = std_error[k] = NAN;
    if (!hci_normal_equations_start(&normal, COLUMNS)) return false;
    for (size_t r = 0; r < runs->count; ++r)
        if (is_usable(runs, r)) add_run(machine, &runs->run[r], &normal);
    hci_normal_equations_finish(&normal);
    const bool has_memory = hci_sweep_start(&sweep, &normal);
    for (size_t k = COLUMNS; has_memory && k-- > 0;)
        (void)hci_sweep_in(&sweep, k); /* the back-EMF first: what depends on it is not told */
    if (has_memory) take(&normal, &sweep, value, std_error);
    hci_sweep_release(&sweep);
    hci_normal_equations_release(&normal);
    return has_memory;
}
