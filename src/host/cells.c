#include "cells.h"

#include <math.h>
#include <string.h>

#include "hci/frames.h"
#include "memory.h"
#include "smooth.h"

enum {
    CELLS_PER_TURN = 2048, /* of a mean over turns */
    LEAST_TURNS = 3,       /* for such a mean */
    MOST_OPEN = 8          /* stretches of samples as they are, for each run */
};

#define STEADY 0.02 /* change of current and speed within a mean, as a share of their largest */

static hci_status no_memory(hci_note *note)
{
    return hci_note_set(note, HCI_ERROR_MEMORY, "out of memory for the recordings");
}

/* ---- samples ---- */

static hci_dq dq_of(const hci_run *r, int pole_pairs, size_t k)
{
    return hci_park(hci_clarke(r->i_A + 3 * k), pole_pairs * r->theta_m_rad[k]);
}

static void sample_of(const hci_run *r, size_t k, hci_cell *c)
{
    memset(c, 0, sizeof *c);
    c->reading.theta_m_rad = r->theta_m_rad[k];
    c->reading.speed_rad_per_s = r->speed_rad_per_s ? r->speed_rad_per_s[k] : 0.0;
    memcpy(c->reading.i_abc, r->i_A + 3 * k, sizeof c->reading.i_abc);
    c->reading.temperature_C = r->temperature_C ? r->temperature_C[k] : (double)NAN;
    c->torque_Nm = r->torque_Nm[k];
    c->sum_A = r->has_sum ? r->i_A[3 * k] + r->i_A[3 * k + 1] + r->i_A[3 * k + 2] : (double)NAN;
    c->time_s = r->time_s ? r->time_s[k] : 0.0;
    c->count = 1.0;
}

static bool reserve(hci_cells *cells, size_t more, size_t *room)
{
    if (cells->count + more > *room) {
        const size_t wanted = 2 * (cells->count + more);
        hci_cell *grown = hci_memory_resize(cells->cell, wanted, sizeof *grown);
        if (!grown) return false;
        cells->cell = grown;
        *room = wanted;
    }
    return true;
}

static bool stretch_add(hci_cells *cells, const hci_stretch *s)
{
    hci_stretch *grown = hci_memory_resize(cells->stretch, cells->stretch_count + 1, sizeof *grown);
    if (!grown) return false;
    cells->stretch = grown;
    grown[cells->stretch_count++] = *s;
    return true;
}

/* ---- rate of change ---- */

/* Sums for the slope of i_d and i_q over time. */
typedef struct {
    double n, t, tt, d, q, td, tq;
} slope_sums;

static void slope_add(slope_sums *s, double t, const hci_sample *x, int pole_pairs)
{
    const hci_dq i = hci_park(hci_clarke(x->i_abc), pole_pairs * x->theta_m_rad);
    s->n += 1.0;
    s->t += t;
    s->tt += t * t;
    s->d += i.d;
    s->q += i.q;
    s->td += t * i.d;
    s->tq += t * i.q;
}

enum { REACH = 32 }; /* cells on each side */

/* Neighbours on one side as far as an eightieth of an electrical period, which smooths the noise and keeps
 * the harmonics up to the 12th; two of them in any case. */
static void slope_gather(slope_sums *s, const hci_cell *cell, size_t n, size_t at, bool upwards,
                         int pole_pairs)
{
    const double reach = 2.0 * HCI_PI / pole_pairs / 80.0, theta = cell[at].reading.theta_m_rad;
    const size_t room = upwards ? n - 1 - at : at;
    for (size_t step = 1; step <= room && step <= REACH; ++step) {
        const hci_cell *c = upwards ? &cell[at + step] : &cell[at - step];
        if (fabs(c->reading.theta_m_rad - theta) > reach && step > 2) return;
        slope_add(s, c->time_s - cell[at].time_s, &c->reading, pole_pairs);
    }
}

/* How fast the currents change in the rotor frame. */
static void changes_set(hci_cell *cell, size_t n, int pole_pairs)
{
    for (size_t k = 0; k < n; ++k) {
        slope_sums s = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
        slope_add(&s, 0.0, &cell[k].reading, pole_pairs);
        slope_gather(&s, cell, n, k, false, pole_pairs);
        slope_gather(&s, cell, n, k, true, pole_pairs);
        const double spread = s.n * s.tt - s.t * s.t;
        if (!(spread > 0.0)) continue;
        const hci_dq slope = {(s.n * s.td - s.t * s.d) / spread, (s.n * s.tq - s.t * s.q) / spread, 0.0};
        hci_clarke_inverse(hci_park_inverse(slope, pole_pairs * cell[k].reading.theta_m_rad),
                           cell[k].reading.change_A_per_s);
    }
}

/* ---- laps ---- */

/* Samples of one turn. */
typedef struct {
    size_t first, count;
    double d, q, speed, temperature;
    bool whole;
} lap;

/* After which everything repeats. */
static double turn_of(const hci_run *r, int pole_pairs)
{
    return 2.0 * HCI_PI * (r->turn_known ? 1.0 : 1.0 / pole_pairs);
}

static double direction_of(const hci_run *r, size_t from, size_t to)
{
    return r->theta_m_rad[to] >= r->theta_m_rad[from] ? 1.0 : -1.0;
}

/* The next lap from a sample on: until the angle has gone once round, or turns back by a tenth of a turn. */
static lap lap_from(const hci_run *r, int pole_pairs, size_t first)
{
    const double turn = turn_of(r, pole_pairs);
    lap x = {first, 0, 0.0, 0.0, 0.0, 0.0, false};
    double farthest = 0.0;
    size_t k = first;
    for (; k < r->count; ++k) {
        const double gone = fabs(r->theta_m_rad[k] - r->theta_m_rad[first]);
        if (gone >= turn || gone < farthest - 0.02 * turn) break;
        const hci_dq i = dq_of(r, pole_pairs, k);
        farthest = fmax(farthest, gone);
        x.d += i.d;
        x.q += i.q;
        x.speed += r->speed_rad_per_s ? r->speed_rad_per_s[k] : 0.0;
        x.temperature += r->temperature_C ? r->temperature_C[k] : 0.0;
    }
    x.count = k - first;
    x.whole = k < r->count && farthest >= 0.98 * turn;
    x.d /= (double)x.count;
    x.q /= (double)x.count;
    x.speed /= (double)x.count;
    x.temperature /= (double)x.count;
    return x;
}

static bool alike(const lap *a, const lap *b, double current_A, double speed)
{
    return hypot(a->d - b->d, a->q - b->q) <= STEADY * current_A + 1e-12 &&
           fabs(a->speed - b->speed) <= STEADY * speed + 1e-12 && fabs(a->temperature - b->temperature) < 1.0;
}

/* Keeps the readings, smooths them, and finds how fast the currents change. */
static bool stretch_finish(const hci_run *r, int pole_pairs, hci_cells *cells, const hci_stretch *s)
{
    hci_cell *cell = cells->cell + s->first;
    bool series = false;
    for (size_t k = 0; k < s->count; ++k)
        cell[k].raw = cell[k].reading;
    /* in a holding test the current is what is measured, noise and all */
    if (r->torque_source != HCI_TORQUE_HOLDING &&
        !hci_smooth_stretch(cell, s, pole_pairs, r->turn_known, &series))
        return false;
    if (s->timed && !series) changes_set(cell, s->count, pole_pairs);
    for (size_t k = 0; k < s->count; ++k) {
        const hci_sample *x = &cell[k].reading;
        memcpy(cell[k].raw.change_A_per_s, x->change_A_per_s, sizeof x->change_A_per_s);
        memcpy(cell[k].raw.curvature_A_per_s2, x->curvature_A_per_s2, sizeof x->curvature_A_per_s2);
    }
    return stretch_add(cells, s);
}

/* ---- means over turns ---- */

static void mean_add(hci_cell *c, const hci_cell *x)
{
    const double w = 1.0 / (c->count += 1.0);
    hci_sample *m = &c->reading;
    m->theta_m_rad += w * (x->reading.theta_m_rad - m->theta_m_rad);
    m->speed_rad_per_s += w * (x->reading.speed_rad_per_s - m->speed_rad_per_s);
    for (int s = 0; s < 3; ++s)
        m->i_abc[s] += w * (x->reading.i_abc[s] - m->i_abc[s]);
    m->temperature_C += w * (x->reading.temperature_C - m->temperature_C);
    c->torque_Nm += w * (x->torque_Nm - c->torque_Nm);
    c->sum_A += w * (x->sum_A - c->sum_A);
}

/* Sorts the cells along time: against the angle when it falls; then gives them the time of a steady turn. */
static size_t cells_close(hci_cell *cell, size_t n, double direction, double turn_rad, double period_s)
{
    size_t kept = 0;
    for (size_t k = 0; k < n; ++k)
        if (cell[k].count > 0.0) cell[kept++] = cell[k];
    for (size_t k = 0; direction < 0.0 && k < kept / 2; ++k) {
        const hci_cell x = cell[k];
        cell[k] = cell[kept - 1 - k];
        cell[kept - 1 - k] = x;
    }
    for (size_t k = 0; k < kept; ++k)
        cell[k].time_s =
            fabs(cell[k].reading.theta_m_rad - cell[0].reading.theta_m_rad) / turn_rad * period_s;
    return kept;
}

/* Adds the mean over laps [0, count) as one stretch. */
static bool mean_stretch(const hci_run *r, size_t run, int pole_pairs, const lap *laps, size_t count,
                         hci_cells *cells, size_t *room)
{
    const size_t first = laps[0].first, last = laps[count - 1].first + laps[count - 1].count - 1;
    const double direction = direction_of(r, first, last);
    const double period_s = r->time_s ? (r->time_s[last] - r->time_s[first]) / (double)count : 0.0;
    hci_stretch s = {run, cells->count, 0, count, period_s, r->time_s != NULL};
    const double turn = turn_of(r, pole_pairs);
    hci_cell *cell;
    if (!reserve(cells, CELLS_PER_TURN, room)) return false;
    cell = cells->cell + cells->count;
    memset(cell, 0, CELLS_PER_TURN * sizeof *cell);
    for (size_t k = first; k <= last; ++k) {
        hci_cell x;
        sample_of(r, k, &x);
        x.reading.theta_m_rad -= turn * floor(x.reading.theta_m_rad / turn);
        const size_t at = (size_t)(x.reading.theta_m_rad / turn * CELLS_PER_TURN);
        mean_add(&cell[at < CELLS_PER_TURN ? at : CELLS_PER_TURN - 1], &x);
    }
    s.count = cells_close(cell, CELLS_PER_TURN, direction, turn, period_s);
    cells->count += s.count;
    return stretch_finish(r, pole_pairs, cells, &s);
}

/* ---- samples as they are ---- */

static bool open_stretch(const hci_run *r, size_t run, int pole_pairs, size_t first, size_t count,
                         hci_cells *cells, size_t *room)
{
    const hci_stretch s = {run, cells->count, count, 0, 0.0, r->time_s != NULL};
    if (!reserve(cells, count, room)) return false;
    for (size_t k = 0; k < count; ++k)
        sample_of(r, first + k, &cells->cell[s.first + k]);
    cells->count += count;
    return stretch_finish(r, pole_pairs, cells, &s);
}

/* A recording that is not steady and too long for all of it: parts of it, evenly spread. */
static bool open_stretches(const hci_run *r, size_t run, int pole_pairs, size_t first, size_t count,
                           hci_cells *cells, size_t *room)
{
    const size_t pieces = (count + HCI_MOST_STRETCH - 1) / HCI_MOST_STRETCH;
    const size_t kept = pieces < MOST_OPEN ? pieces : MOST_OPEN;
    const size_t length = count / pieces;
    for (size_t k = 0; k < kept; ++k) {
        const size_t piece = pieces * k / kept;
        if (!open_stretch(r, run, pole_pairs, first + piece * length, length, cells, room)) return false;
    }
    return true;
}

/* ---- a run ---- */

/* Steady laps become one mean, the rest stays as it is. */
static bool laps_reduce(const hci_run *r, size_t run, int pole_pairs, const lap *laps, size_t count,
                        const hci_run_figures *f, hci_cells *cells, size_t *room)
{
    bool done = true;
    size_t open = laps[0].first;
    for (size_t k = 0; k < count && done;) {
        size_t next = k + 1;
        while (next < count && laps[next].whole && laps[k].whole &&
               direction_of(r, laps[k].first, laps[k].first + laps[k].count - 1) ==
                   direction_of(r, laps[next].first, laps[next].first + laps[next].count - 1) &&
               alike(&laps[k], &laps[next], f->current_A, fabs(f->mean_speed_rad_per_s)))
            ++next;
        if (next - k >= LEAST_TURNS) {
            if (laps[k].first > open)
                done = open_stretches(r, run, pole_pairs, open, laps[k].first - open, cells, room);
            done = done && mean_stretch(r, run, pole_pairs, laps + k, next - k, cells, room);
            open = laps[next - 1].first + laps[next - 1].count;
        }
        k = next;
    }
    if (done && open < r->count && (open == laps[0].first || r->count - open > HCI_MOST_STRETCH))
        done = open_stretches(r, run, pole_pairs, open, r->count - open, cells, room);
    return done;
}

static bool laps_find(const hci_run *r, int pole_pairs, lap **laps, size_t *count)
{
    size_t room = 64;
    *count = 0;
    *laps = hci_memory_new(room, sizeof **laps);
    for (size_t at = 0; *laps && at < r->count;) {
        if (*count == room) {
            lap *grown = hci_memory_resize(*laps, room *= 2, sizeof *grown);
            if (!grown) return false;
            *laps = grown;
        }
        (*laps)[*count] = lap_from(r, pole_pairs, at);
        at += (*laps)[(*count)++].count;
    }
    return *laps != NULL;
}

static bool run_reduce(const hci_run *r, size_t run, int pole_pairs, const hci_run_figures *f,
                       hci_cells *cells, size_t *room)
{
    lap *laps = NULL;
    size_t count = 0;
    bool done;
    if (r->count <= HCI_MOST_STRETCH) return open_stretch(r, run, pole_pairs, 0, r->count, cells, room);
    done = laps_find(r, pole_pairs, &laps, &count) &&
           laps_reduce(r, run, pole_pairs, laps, count, f, cells, room);
    hci_memory_free(laps);
    return done;
}

/* ---- figures ---- */

/* The smallest step between neighbours that is not rounding. */
static double angle_step(const hci_run *r)
{
    const size_t n = r->count < 20000 ? r->count : 20000;
    double least = INFINITY;
    for (size_t k = 1; k < n; ++k) {
        const double step = fabs(r->theta_m_rad[k] - r->theta_m_rad[k - 1]);
        if (step > 1e-7) least = fmin(least, step);
    }
    return isfinite(least) ? least : 0.0;
}

/* How far a sample is from the mean of those at the same angle in other turns, by cells of a turn. */
static double repeatability(const hci_run *r, double turns)
{
    enum { CELLS = 512 };
    double sum[CELLS] = {0.0}, square[CELLS] = {0.0}, count[CELLS] = {0.0}, slope[CELLS] = {0.0};
    double total = 0.0, freedom = 0.0;
    if (!(turns >= LEAST_TURNS) || r->count < 4 * CELLS) return NAN;
    for (size_t k = 0; k < r->count; ++k) {
        const double x = r->theta_m_rad[k] / (2.0 * HCI_PI), part = x - floor(x);
        const size_t at = (size_t)(part * CELLS) % CELLS;
        sum[at] += r->torque_Nm[k];
        count[at] += 1.0;
    }
    for (size_t c = 0; c < CELLS; ++c)
        slope[c] = 0.5 * (sum[(c + 1) % CELLS] / fmax(1.0, count[(c + 1) % CELLS]) -
                          sum[(c + CELLS - 1) % CELLS] / fmax(1.0, count[(c + CELLS - 1) % CELLS]));
    memset(sum, 0, sizeof sum);
    for (size_t k = 0; k < r->count; ++k) {
        const double x =
            CELLS * (r->theta_m_rad[k] / (2.0 * HCI_PI) - floor(r->theta_m_rad[k] / (2.0 * HCI_PI)));
        const size_t at = (size_t)x % CELLS;
        const double y = r->torque_Nm[k] - slope[at] * (x - floor(x) - 0.5);
        sum[at] += y;
        square[at] += y * y;
    }
    for (size_t c = 0; c < CELLS; ++c) {
        if (count[c] < 2.0) continue;
        total += square[c] - sum[c] * sum[c] / count[c];
        freedom += count[c] - 1.0;
    }
    return freedom > 100.0 ? sqrt(fmax(total, 0.0) / freedom) : (double)NAN;
}

static void figures_of(const hci_run *r, int pole_pairs, hci_run_figures *f)
{
    const double n = (double)(r->count ? r->count : 1);
    double square = 0.0, current = 0.0;
    memset(f, 0, sizeof *f);
    for (size_t k = 0; k < r->count; ++k) {
        const hci_dq i = dq_of(r, pole_pairs, k);
        const double torque = r->torque_Nm ? r->torque_Nm[k] : 0.0;
        f->mean_torque_Nm += torque / n;
        square += torque * torque / n;
        current += (i.d * i.d + i.q * i.q) / n;
        f->mean_id_A += i.d / n;
        f->mean_iq_A += i.q / n;
        f->mean_speed_rad_per_s += r->speed_rad_per_s ? r->speed_rad_per_s[k] / n : 0.0;
        f->temperature_C += r->temperature_C ? r->temperature_C[k] / n : (double)NAN;
    }
    f->rms_torque_Nm = sqrt(square);
    f->current_A = sqrt(current);
    f->angle_step_rad = angle_step(r);
    f->turns = r->count ? fabs(r->theta_m_rad[r->count - 1] - r->theta_m_rad[0]) / (2.0 * HCI_PI) : 0.0;
    f->repeat_Nm = r->torque_Nm ? repeatability(r, f->turns) : (double)NAN;
}

hci_status hci_cells_make(const hci_machine *machine, const hci_run *runs, size_t run_count, hci_cells *cells,
                          hci_note *note)
{
    size_t room = 0;
    bool done = true;
    memset(cells, 0, sizeof *cells);
    cells->run_count = run_count;
    cells->figures = hci_memory_new(run_count + 1, sizeof *cells->figures);
    done = cells->figures != NULL;
    for (size_t k = 0; k < run_count && done; ++k) {
        figures_of(&runs[k], machine->pole_pairs, &cells->figures[k]);
        if (runs[k].torque_Nm && runs[k].theta_m_rad && runs[k].count > 0)
            done = run_reduce(&runs[k], k, machine->pole_pairs, &cells->figures[k], cells, &room);
    }
    if (done) return HCI_OK;
    hci_cells_release(cells);
    return no_memory(note);
}

void hci_cells_release(hci_cells *cells)
{
    hci_memory_free(cells->cell);
    hci_memory_free(cells->stretch);
    hci_memory_free(cells->figures);
    memset(cells, 0, sizeof *cells);
}
