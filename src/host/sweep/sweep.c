/* One point of a grid, and the grid as far as it is solved. */
#include "hci/host/sweep/sweep.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/sweep/figures.h"

/* ---- one point ---- */

static void solve_torque(const hci_grid_request *r, const hci_grid_point *p, hci_grid_row *row)
{
    hci_target_order mean = {{0.0, 0.0, p->torque_Nm}, 1.0};
    const hci_target target = {&mean, 1};
    const hci_solve_options o = hci_grid_options_of(r, p, &target);
    hci_grid_answer a;
    hci_grid_solve_once(r->machine, &o, &a);
    if (a.verdict == HCI_GRID_FAILED) {
        hci_grid_fail(p, a.reason.text, row);
        return;
    }
    row->verdict = a.verdict;
    row->best = a.figures;
    row->sine = a.plain;
}

void hci_grid_solve(const hci_grid_request *request, const hci_grid_point *point, hci_grid_row *row)
{
    (void)hci_memory_was_short();
    hci_grid_row_begin(point, row);
    if (request->kind == HCI_GRID_ENVELOPE)
        hci_grid_envelope(request, point, row);
    else
        solve_torque(request, point, row);
    if (!hci_memory_was_short()) return;
    hci_grid_fail(point, "out of memory", row);
    row->out_of_memory = true;
}

/* ---- the grid ---- */

hci_status hci_grid_begin(const hci_grid_request *request, hci_grid_plan *plan, hci_grid *sweep,
                          hci_note *note)
{
    *sweep = (hci_grid){.request = *request, .plan = *plan};
    *plan = (hci_grid_plan){0};
    sweep->row = hci_memory_new(sweep->plan.count, sizeof *sweep->row);
    sweep->done = hci_memory_new(sweep->plan.count, sizeof *sweep->done);
    if (sweep->row && sweep->done) return HCI_OK;
    hci_grid_release(sweep);
    return hci_note_memory(note, NULL, "the points of a grid");
}

size_t hci_grid_done(const hci_grid *sweep)
{
    size_t count = 0;
    for (size_t k = 0; k < sweep->plan.count; ++k)
        count += sweep->done[k];
    return count;
}

void hci_grid_release(hci_grid *sweep)
{
    hci_grid_plan_release(&sweep->plan);
    hci_memory_free(sweep->row);
    hci_memory_free(sweep->done);
    memset(sweep, 0, sizeof *sweep);
}
