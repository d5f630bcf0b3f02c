#include "slip.h"

#include <math.h>
#include <string.h>

#include "memory.h"

enum { ORDERS = 48, ANGLES = 720 };

#define LITTLE_CURRENT 0.05 /* share of the largest that counts as none */
#define ALIKE          0.9  /* correlation of turned residuals that are the same map */
#define SPREAD         1.6  /* orders that share the power of a map: one alone fits itself at many angles */
#define BETTER         0.25 /* by so much more than unturned ones */

/* Fourier sums of a run's residual over the mechanical angle, orders 1 … ORDERS. */
typedef struct {
    double cosine[ORDERS], sine[ORDERS], power;
    bool usable;
} map;

static bool is_usable(const hci_cells *cells, const hci_run *runs, size_t run, double most_A)
{
    const hci_run_figures *f = &cells->figures[run];
    return runs[run].turn_known && runs[run].torque_source != HCI_TORQUE_NONE && f->turns > 0.95 &&
           (runs[run].torque_source == HCI_TORQUE_HOLDING || f->current_A <= LITTLE_CURRENT * most_A);
}

/* Friction makes a mean that depends on the direction; order 0 is left out. */
static void map_make(const hci_cells *cells, size_t run, const double *residual, map *m)
{
    double count = 0.0;
    memset(m, 0, sizeof *m);
    for (size_t k = 0; k < cells->stretch_count; ++k) {
        const hci_stretch *s = &cells->stretch[k];
        for (size_t j = s->first; s->run == run && j < s->first + s->count; ++j) {
            for (int n = 0; n < ORDERS; ++n) {
                const double a = (n + 1) * cells->cell[j].reading.theta_m_rad;
                m->cosine[n] += residual[j] * cos(a);
                m->sine[n] += residual[j] * sin(a);
            }
            count += 1.0;
        }
    }
    for (int n = 0; n < ORDERS && count > 0.0; ++n) {
        m->cosine[n] /= count;
        m->sine[n] /= count;
        m->power += m->cosine[n] * m->cosine[n] + m->sine[n] * m->sine[n];
    }
}

/* How many orders share the power, weighted: 1 for a single one. */
static double spread_of(const map *m)
{
    double fourth = 0.0;
    for (int n = 0; n < ORDERS; ++n) {
        const double power = m->cosine[n] * m->cosine[n] + m->sine[n] * m->sine[n];
        fourth += power * power;
    }
    return fourth > 0.0 ? m->power * m->power / fourth : 0.0;
}

/* Correlation of a with b turned back by an angle. */
static double likeness(const map *a, const map *b, double angle_rad)
{
    double sum = 0.0;
    for (int n = 0; n < ORDERS; ++n) {
        const double c = cos((n + 1) * angle_rad), s = sin((n + 1) * angle_rad);
        const double cosine = c * b->cosine[n] + s * b->sine[n], sine = c * b->sine[n] - s * b->cosine[n];
        sum += a->cosine[n] * cosine + a->sine[n] * sine;
    }
    return a->power > 0.0 && b->power > 0.0 ? sum / sqrt(a->power * b->power) : 0.0;
}

/* The angle at which b resembles a best; 0 unless that is much better than as it is. */
static double turn_between(const map *a, const map *b)
{
    double best = 0.0, most = -1.0;
    for (int k = 0; k < ANGLES; ++k) {
        const double angle = 2.0 * HCI_PI * k / ANGLES, x = likeness(a, b, angle);
        if (x > most) {
            most = x;
            best = angle;
        }
    }
    for (double step = HCI_PI / ANGLES; step > 1e-6; step *= 0.5) {
        if (likeness(a, b, best + step) > most) best += step;
        if (likeness(a, b, best - step) > likeness(a, b, best)) best -= step;
        most = likeness(a, b, best);
    }
    if (most < ALIKE || most < likeness(a, b, 0.0) + BETTER) return 0.0;
    return best > HCI_PI ? best - 2.0 * HCI_PI : best;
}

/* The run that resembles most others as they are. */
static size_t reference_of(const map *maps, size_t count)
{
    size_t best = count;
    double most = -1e300;
    for (size_t k = 0; k < count; ++k) {
        double sum = 0.0;
        for (size_t j = 0; j < count && maps[k].usable; ++j)
            if (j != k && maps[j].usable) sum += likeness(&maps[k], &maps[j], 0.0);
        if (maps[k].usable && sum > most) {
            most = sum;
            best = k;
        }
    }
    return best;
}

hci_status hci_slip_find(const hci_cells *cells, const hci_run *runs, const double *residual_Nm,
                         double *slip_rad, hci_note *note)
{
    const size_t count = cells->run_count;
    map *maps = hci_memory_new(count + 1, sizeof *maps);
    double most_A = 0.0;
    if (!maps) return hci_note_set(note, HCI_ERROR_MEMORY, "out of memory for comparing recordings");
    for (size_t k = 0; k < count; ++k)
        most_A = fmax(most_A, cells->figures[k].current_A);
    for (size_t k = 0; k < count; ++k) {
        const bool usable = is_usable(cells, runs, k, most_A);
        if (usable) map_make(cells, k, residual_Nm, &maps[k]);
        maps[k].usable = usable && spread_of(&maps[k]) > SPREAD;
        slip_rad[k] = 0.0;
    }
    const size_t reference = reference_of(maps, count);
    for (size_t k = 0; k < count && reference < count; ++k)
        if (k != reference && maps[k].usable) slip_rad[k] = turn_between(&maps[reference], &maps[k]);
    hci_memory_free(maps);
    return HCI_OK;
}

void hci_slip_undo(hci_cells *cells, size_t run, double slip_rad)
{
    for (size_t k = 0; k < cells->stretch_count; ++k) {
        const hci_stretch *s = &cells->stretch[k];
        for (size_t j = s->first; s->run == run && j < s->first + s->count; ++j) {
            cells->cell[j].reading.theta_m_rad -= slip_rad;
            cells->cell[j].raw.theta_m_rad -= slip_rad;
        }
    }
}
