/* One point of a grid, and the grid as far as it is solved. */
#include "hci/host/sweep/sweep.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/sweep/figures.h"

#define NAME_OF(value, word) [value] = word,

const char *hci_grid_kind_name(hci_grid_kind kind)
{
    static const char *const NAME[] = {HCI_GRID_KIND_NAMES(NAME_OF)};
    return NAME[kind];
}

const char *hci_grid_verdict_name(hci_grid_verdict verdict)
{
    static const char *const NAME[] = {HCI_GRID_VERDICT_NAMES(NAME_OF)};
    return NAME[verdict];
}

/* ---- one point ---- */

static void begin_row(const hci_grid_point *point, hci_grid_row *row)
{
    memset(row, 0, sizeof *row);
    row->point = *point;
    row->best = row->most = row->sine = hci_grid_no_figures();
}

/* A line of a table: what would break it becomes a blank, and a long text ends between characters. */
void hci_grid_fail(const hci_grid_point *point, const char *reason, hci_grid_row *row)
{
    const hci_grid_point kept = *point;
    size_t length;
    begin_row(&kept, row);
    row->verdict = HCI_GRID_FAILED;
    length = (size_t)snprintf(row->reason, sizeof row->reason, "%s", reason);
    for (char *c = row->reason; *c; ++c)
        if (*c == '\n' || *c == '\r' || *c == '\t') *c = ' ';
    if (length < sizeof row->reason) return;
    length = sizeof row->reason - 1;
    while (length > 0 && ((unsigned char)row->reason[length] & 0xC0u) == 0x80u)
        --length;
    while (length > 0 && (unsigned char)row->reason[length - 1] >= 0x80u)
        --length;
    row->reason[length] = '\0';
}

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
    begin_row(point, row);
    if (request->kind == HCI_GRID_ENVELOPE)
        hci_grid_envelope(request, point, row);
    else
        solve_torque(request, point, row);
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
