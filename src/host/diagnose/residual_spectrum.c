#include "host/diagnose/residual_spectrum.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"

#define RESOLVED 0.45 /* orders for each sample of a turn */
#define CHANCE   20.0 /* noise alone exceeds what is no line once in so many times */

enum { MOST_PERIODS = 800 /* in a mechanical turn */, MOST_ELECTRICAL = 96 };

/* Σ r cos kθ, Σ r sin kθ of the residual before and after: four sums for each order. */
static void sample_add(double theta_rad, double weight, double before, double after, double *sums,
                       size_t count)
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

/* Samples in a turn: of a mean over turns all of them. */
static double samples_per_turn(const hci_regression *e, size_t run)
{
    const double turns = fmax(e->samples->statistics[run].turns, 1.0 / e->machine->pole_pairs);
    double count = 0.0, of_mean = 0.0;
    for (const hci_segment *s = NULL; (s = hci_segment_next(e->samples, run, s)) != NULL;) {
        count += (double)s->count;
        if (s->turns > 0) of_mean = (double)s->count;
    }
    return of_mean > 0.0 ? of_mean : count / turns;
}

/* As many orders as those resolve. */
static size_t orders_of(const hci_regression *e, size_t run, size_t stride)
{
    const double resolved = fmin(RESOLVED * samples_per_turn(e, run), MOST_PERIODS);
    const double most = fmin(resolved, MOST_ELECTRICAL * e->machine->pole_pairs);
    return (size_t)(most / (double)stride) + 1;
}

typedef struct {
    hci_residual_line *line;
    size_t count, capacity;
} list;

static bool line_put(list *l, const hci_residual_line *line)
{
    if (l->count == l->capacity) {
        const size_t wanted = 2 * l->capacity + 64;
        hci_residual_line *grown = hci_memory_resize(l->line, wanted, sizeof *grown);
        if (!grown) return false;
        l->line = grown;
        l->capacity = wanted;
    }
    l->line[l->count++] = *line;
    return true;
}

/* What the lines are made of. */
typedef struct {
    const hci_regression *regression;
    const hci_residuals *residuals;
    double *sums; /* [orders][4] */
} material;

/* Fills the sums of a run. Returns its samples. */
static double sums_fill(const material *m, size_t run, size_t stride, size_t orders)
{
    const hci_binned_samples *samples = m->regression->samples;
    double count = 0.0;
    memset(m->sums, 0, 4 * orders * sizeof *m->sums);
    for (const hci_segment *s = NULL; (s = hci_segment_next(samples, run, s)) != NULL;)
        for (size_t j = s->first; j < s->first + s->count; ++j) {
            const hci_binned_sample *c = &samples->sample[j];
            sample_add(c->raw.theta_m_rad * (double)stride, c->count, m->residuals->before_Nm[j],
                       m->residuals->after_Nm[j], m->sums, orders);
            count += c->count;
        }
    return count;
}

/* An amplitude 2/n |Σ| of white noise exceeds 2σ √(ln 20 / n) once in twenty times. */
static bool run_lines(const material *m, size_t run, list *l)
{
    const double p = m->regression->machine->pole_pairs;
    const size_t stride = m->regression->runs[run].turn_known ? 1 : (size_t)p;
    const size_t orders = orders_of(m->regression, run, stride);
    const double count = sums_fill(m, run, stride, orders);
    for (size_t k = 0; k < orders && count > 0.0; ++k) {
        const double scale = (k == 0 ? 1.0 : 2.0) / count, *sum = m->sums + 4 * k;
        const hci_residual_line line = {run, (double)(k * stride) / p, scale * hypot(sum[0], sum[1]),
                                        scale * hypot(sum[2], sum[3]),
                                        2.0 * m->residuals->noise_Nm[run] * sqrt(log(CHANCE) / count)};
        if (fmax(line.before_Nm, line.after_Nm) > line.noise_Nm && !line_put(l, &line)) return false;
    }
    return true;
}

hci_status hci_residual_spectrum_make(const hci_regression *regression, const hci_residuals *residuals,
                                      hci_residual_line **lines, size_t *count, hci_note *note)
{
    list l = {NULL, 0, 0};
    const material m = {regression, residuals, hci_memory_new(4 * (MOST_PERIODS + 1), sizeof *m.sums)};
    bool done = m.sums != NULL;
    for (size_t r = 0; r < regression->samples->run_count && done; ++r)
        done = regression->runs[r].only_mean || run_lines(&m, r, &l);
    hci_memory_free(m.sums);
    if (!done) hci_memory_free(l.line);
    *lines = done ? l.line : NULL;
    *count = done ? l.count : 0;
    return done ? HCI_OK : hci_note_memory(note, NULL, "the residual by order");
}
