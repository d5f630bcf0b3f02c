#include "host/recording/line_rows.h"

#include <math.h>

#include "host/base/memory.h"
#include "host/csv/table.h"
#include "host/numeric/statistics.h"
#include "host/numeric/straight_lines.h"

typedef struct {
    hci_run_columns *c;
    hci_line_nodes nodes;
    double *row;    /* [c->count], of the file */
    double *point;  /* [nodes.count], values of one column */
    size_t *beside; /* [nodes.count], the sample before a point */
    bool *is_left;  /* [nodes.count] */
} task;

static hci_status memory_error(const hci_run_columns *c)
{
    return hci_note_memory(c->note, hci_csv_path(c->csv), "%zu rows", c->count);
}

static void release(task *t)
{
    hci_memory_free(t->row);
    hci_memory_free(t->point);
    hci_memory_free(t->beside);
    hci_memory_free(t->is_left);
}

static double place_of(const task *t, size_t point)
{
    return t->nodes.first + t->nodes.step * (double)point;
}

/* The samples beside each point; a point without one on each side, nearer than the next point, is left out.
 */
static void beside_find(task *t)
{
    const size_t n = t->c->count;
    size_t k = 0;
    for (size_t j = 0; j < t->nodes.count; ++j) {
        const double at = place_of(t, j);
        while (k + 2 < n && t->row[k + 1] <= at)
            ++k;
        t->beside[j] = k;
        t->is_left[j] = t->row[k] <= at && at <= t->row[k + 1] && at - t->row[k] < t->nodes.step &&
                        t->row[k + 1] - at < t->nodes.step;
    }
}

/* A column of a clock of its own, along straight lines between its rows. An angle that begins its turn again
 * there has no value. */
static void along_rows(task *t, const double *value, bool is_angle)
{
    const double most = is_angle ? 0.5 * hci_peak_to_peak(value, t->c->count) : (double)INFINITY;
    for (size_t j = 0; j < t->nodes.count; ++j) {
        const size_t k = t->beside[j];
        const double share = (place_of(t, j) - t->row[k]) / (t->row[k + 1] - t->row[k]);
        t->point[j] = value[k] + share * (value[k + 1] - value[k]);
        if (fabs(value[k + 1] - value[k]) > most) t->is_left[j] = false;
    }
}

static hci_status column_take(task *t, unsigned which)
{
    double *value = t->c->ready[which];
    const bool is_angle = which == HCI_RUN_THETA_M || which == HCI_RUN_THETA_E;
    const double left = hci_line_nodes_fit(t->row, value, t->c->count, &t->nodes, t->point);
    if (hci_memory_was_short()) return memory_error(t->c);
    if (!(left <= hci_line_nodes_most_left)) along_rows(t, value, is_angle);
    for (size_t j = 0; j < t->nodes.count; ++j)
        value[j] = t->point[j];
    return HCI_OK;
}

/* Keeps the points that are left, in every column. */
static hci_status points_keep(task *t)
{
    hci_run_columns *c = t->c;
    size_t *row = hci_memory_new(t->nodes.count, sizeof *row), kept = 0;
    if (row == NULL) return memory_error(c);
    for (size_t j = 0; j < t->nodes.count; ++j) {
        if (!t->is_left[j]) continue;
        row[kept] = (size_t)round(place_of(t, j));
        for (unsigned which = 0; which < HCI_RUN_COLUMN_COUNT; ++which)
            if (c->ready[which]) c->ready[which][kept] = c->ready[which][j];
        ++kept;
    }
    hci_memory_free(c->row);
    c->row = row;
    hci_note_add(c->remark,
                 "the torque runs along straight lines between points %.4g rows apart: it was interpolated, "
                 "which takes from its quick ripple. Of %zu rows the %zu points are taken",
                 t->nodes.step, c->count, kept);
    c->count = kept;
    return HCI_OK;
}

static hci_status points_take(task *t)
{
    hci_status status = HCI_OK;
    t->point = hci_memory_new(t->nodes.count, sizeof *t->point);
    t->beside = hci_memory_new(t->nodes.count, sizeof *t->beside);
    t->is_left = hci_memory_new(t->nodes.count, sizeof *t->is_left);
    if (!t->point || !t->beside || !t->is_left) return memory_error(t->c);
    beside_find(t);
    for (unsigned which = 0; which < HCI_RUN_COLUMN_COUNT && !status; ++which)
        if (t->c->ready[which]) status = column_take(t, which);
    return status ? status : points_keep(t);
}

hci_status hci_line_rows_take(hci_run_columns *c)
{
    task t = {.c = c};
    hci_status status = HCI_OK;
    if (c->ready[HCI_RUN_TORQUE] == NULL || c->count < 3) return HCI_OK;
    t.row = hci_memory_new(c->count, sizeof *t.row);
    if (t.row == NULL) return memory_error(c);
    for (size_t k = 0; k < c->count; ++k)
        t.row[k] = (double)(c->row ? c->row[k] : k);
    const bool found = hci_line_nodes_find(t.row, c->ready[HCI_RUN_TORQUE], c->count, &t.nodes);
    if (found)
        status = points_take(&t);
    else if (hci_memory_was_short())
        status = memory_error(c);
    release(&t);
    return status;
}
