#include "lines.h"

#include <math.h>
#include <string.h>

#include "memory.h"

enum { MOST_PERIODS = 800, MOST_ELECTRICAL = 96 };

/* Σ r cos kθ, Σ r sin kθ of the residual before and after: four sums for each order. */
static void cell_add(double theta_rad, double weight, double before, double after, double *sums, size_t count)
{
    const double c = cos(theta_rad), s = sin(theta_rad);
    double x = weight, y = 0.0;
    for (size_t k = 0; k < count; ++k) {
        double *sum = sums + 4 * k;
        sum[0] += before * x;
        sum[1] += before * y;
        sum[2] += after * x;
        sum[3] += after * y;
        const double next = c * x - s * y;
        y = s * x + c * y;
        x = next;
    }
}

/* As many orders as the samples of a turn resolve. */
static size_t orders_of(const hci_evidence *e, size_t run, double cells, size_t stride)
{
    const double turns = fmax(e->cells->figures[run].turns, 1.0 / e->machine->pole_pairs);
    double per_turn = cells / turns;
    for (size_t k = 0; k < e->cells->stretch_count; ++k)
        if (e->cells->stretch[k].run == run && e->cells->stretch[k].turns > 0)
            per_turn = (double)e->cells->stretch[k].count;
    const double most = fmin(fmin(0.45 * per_turn, MOST_PERIODS), MOST_ELECTRICAL * e->machine->pole_pairs);
    return (size_t)(most / (double)stride) + 1;
}

typedef struct {
    hci_residual_line *line;
    size_t count, room;
} list;

static bool line_put(list *l, const hci_residual_line *line)
{
    if (l->count == l->room) {
        hci_residual_line *grown = hci_memory_resize(l->line, l->room = 2 * l->room + 64, sizeof *grown);
        if (!grown) return false;
        l->line = grown;
    }
    l->line[l->count++] = *line;
    return true;
}

/* An amplitude 2/n |Σ| of white noise exceeds 2σ √(ln 20 / n) once in twenty times. */
static bool run_lines(const hci_evidence *e, size_t run, const double *before, const double *after,
                      double noise_Nm, double *sums, list *l)
{
    const double p = e->machine->pole_pairs;
    const size_t stride = e->runs[run].turn_known ? 1 : (size_t)p;
    double count = 0.0, cells = 0.0;
    for (size_t k = 0; k < e->cells->stretch_count; ++k)
        if (e->cells->stretch[k].run == run) cells += (double)e->cells->stretch[k].count;
    const size_t orders = orders_of(e, run, cells, stride);
    memset(sums, 0, 4 * orders * sizeof *sums);
    for (size_t k = 0; k < e->cells->stretch_count; ++k) {
        const hci_stretch *s = &e->cells->stretch[k];
        for (size_t j = s->first; s->run == run && j < s->first + s->count; ++j) {
            const hci_cell *c = &e->cells->cell[j];
            cell_add(c->raw.theta_m_rad * (double)stride, c->count, before[j], after[j], sums, orders);
            count += c->count;
        }
    }
    for (size_t k = 0; k < orders && count > 0.0; ++k) {
        const double scale = (k == 0 ? 1.0 : 2.0) / count, *sum = sums + 4 * k;
        const hci_residual_line line = {run, (double)(k * stride) / p, scale * hypot(sum[0], sum[1]),
                                        scale * hypot(sum[2], sum[3]),
                                        2.0 * noise_Nm * sqrt(log(20.0) / count)};
        if (fmax(line.before_Nm, line.after_Nm) > line.noise_Nm && !line_put(l, &line)) return false;
    }
    return true;
}

hci_status hci_lines_make(const hci_evidence *evidence, const double *before_Nm, const double *after_Nm,
                          const double *noise_Nm, hci_residual_line **lines, size_t *count, hci_note *note)
{
    list l = {NULL, 0, 0};
    double *sums = hci_memory_new(4 * (MOST_PERIODS + 1), sizeof *sums);
    bool done = sums != NULL;
    for (size_t r = 0; r < evidence->cells->run_count && done; ++r)
        done = run_lines(evidence, r, before_Nm, after_Nm, noise_Nm[r], sums, &l);
    hci_memory_free(sums);
    *lines = l.line;
    *count = l.count;
    return done ? HCI_OK : hci_note_set(note, HCI_ERROR_MEMORY, "out of memory for the residual by order");
}
