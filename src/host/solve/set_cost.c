#include "host/solve/set_cost.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"

bool hci_set_cost_less(const hci_set_preference *p, hci_set_cost a, hci_set_cost b)
{
    const bool a_allowed = a.mean_square_A2 <= p->allowed_A2, b_allowed = b.mean_square_A2 <= p->allowed_A2;
    if (a_allowed != b_allowed) return a_allowed;
    if (!a_allowed) return a.mean_square_A2 < b.mean_square_A2;
    if (a.worst_Nm <= p->tolerance_Nm && b.worst_Nm <= p->tolerance_Nm)
        return a.mean_square_A2 < b.mean_square_A2;
    return a.worst_Nm < b.worst_Nm;
}

/* (3/2) Σ I², theory.md section 3, over components that are all different. */
static double mean_square_A2(const hci_component_set *set, const double *x, double mean_Nm)
{
    const size_t n = 2 * set->count;
    double sum = 0.0;
    for (size_t j = 0; j < n; ++j) {
        const double value = hci_coordinate(x, n, mean_Nm, j);
        sum += 1.5 * hci_component_copper(set->component[j / 2], (int)(j % 2)) * value * value;
    }
    return sum;
}

/* r = U x − h at a mean torque; rows are weighted. */
static void residual(const hci_harmonic_system *system, const double *x, double mean_Nm, double *r)
{
    const hci_sparse *u = &system->u;
    for (size_t i = 0; i < system->rows; ++i)
        r[i] = -(mean_Nm * system->h[i] + system->h[system->rows + i]);
    for (size_t j = 0; j < system->unknowns; ++j) {
        const double value = hci_coordinate(x, system->unknowns, mean_Nm, j);
        for (int64_t k = u->column_start[j]; k < u->column_start[j + 1]; ++k)
            r[u->row[k]] += u->value[k] * value;
    }
}

double hci_residual_amplitude_Nm(const hci_harmonic_system *system, const double *r, size_t k)
{
    const size_t row = hci_orders_row(system->order, system->order_count, k);
    return system->order[k] < HCI_ORDER_TOLERANCE ? fabs(r[row]) : hci_amplitude(r[row], r[row + 1]);
}

double hci_worst_residual_Nm(const hci_harmonic_system *system, const double *x, double mean_Nm, double *r)
{
    double worst = 0.0;
    residual(system, x, mean_Nm, r);
    for (size_t k = 0; k < system->order_count; ++k)
        worst = fmax(worst, hci_residual_amplitude_Nm(system, r, k));
    return worst;
}

hci_set_cost hci_set_cost_of(const hci_harmonic_system *system, const hci_component_set *set, const double *x,
                             double mean_Nm, double *r)
{
    const double worst_Nm = hci_worst_residual_Nm(system, x, mean_Nm, r);
    return (hci_set_cost){worst_Nm, mean_square_A2(set, x, mean_Nm)};
}

hci_status hci_choice_solve(const hci_harmonic_system *system, double mean_Nm, hci_choice *c, hci_note *note)
{
    double *r = hci_memory_new(system->rows, sizeof *r);
    hci_sparse_rank found;
    const hci_status status = r ? hci_harmonic_system_solve(system, c->answer.x, &found, note)
                                : hci_note_memory(note, NULL, "choosing harmonics");
    if (!status) c->cost = hci_set_cost_of(system, &c->answer.set, c->answer.x, mean_Nm, r);
    hci_memory_free(r);
    return status;
}

void hci_choice_release(hci_choice *choice)
{
    hci_answer_release(&choice->answer);
    memset(choice, 0, sizeof *choice);
}
