#include "host/recording/list/torque_map.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/recording/rotor_frame.h"

enum { LEAST_ROWS = 8 /* of a point */ };

#define SAME   5e-4 /* of the largest current: phase currents were rounded */
#define EVENLY 0.02 /* of a step of the angle */

/* The rows of a table by their operating points. */
typedef struct {
    const hci_run *run;
    size_t *of_row;    /* [rows]: which point */
    hci_dq *i_A;       /* [HCI_MOST_MAP_POINTS] */
    size_t *row_count; /* of each */
    size_t count;      /* points; 0: it is no table */
    double most_A;
} torque_map;

/* ---- whether it is one ---- */

static bool may_be_map(const hci_run *run)
{
    return !run->time_s && run->theta_m_rad && run->i_A && run->torque_Nm && !run->only_mean &&
           run->torque_source == HCI_TORQUE_MEASURED && run->count >= LEAST_ROWS;
}

static double largest_current_A(const hci_run *run)
{
    double most_A = 0.0;
    for (size_t k = 0; k < run->count; ++k) {
        const hci_dq i = hci_run_dq(run, run->pole_pairs, k);
        most_A = fmax(most_A, hypot(i.d, i.q));
    }
    return most_A;
}

/* The point with these currents, a new one if there is none; HCI_MOST_MAP_POINTS: there are too many.
 */
static size_t point_at(torque_map *t, hci_dq i)
{
    size_t k = 0;
    while (k < t->count && !(hypot(i.d - t->i_A[k].d, i.q - t->i_A[k].q) <= SAME * t->most_A))
        ++k;
    if (k == t->count && k < HCI_MOST_MAP_POINTS) t->i_A[t->count++] = i;
    return k;
}

static void rows_sort(torque_map *t)
{
    for (size_t k = 0; k < t->run->count; ++k) {
        t->of_row[k] = point_at(t, hci_run_dq(t->run, t->run->pole_pairs, k));
        if (t->of_row[k] == HCI_MOST_MAP_POINTS) {
            t->count = 0;
            return;
        }
        ++t->row_count[t->of_row[k]];
    }
}

/* Where the electrical angles of a point begin, and their step. */
typedef struct {
    double first_rad, step_rad;
} angle_grid;

/* False where they are few, or not in steps that are alike. */
static bool grid_find(const torque_map *t, size_t point, angle_grid *grid)
{
    double last = 0.0;
    size_t seen = 0;
    for (size_t k = 0; k < t->run->count; ++k) {
        if (t->of_row[k] != point) continue;
        const double theta_e = t->run->pole_pairs * t->run->theta_m_rad[k];
        const double gone = remainder(theta_e - last, 2.0 * HCI_PI);
        if (seen == 0) grid->first_rad = theta_e;
        if (seen == 1) grid->step_rad = gone;
        if (seen > 1 && fabs(gone - grid->step_rad) > EVENLY * fabs(grid->step_rad)) return false;
        last = theta_e;
        ++seen;
    }
    return seen >= LEAST_ROWS && fabs(grid->step_rad) > 0.0;
}

/* Whether all points have the same angles, though not as many: where the currents follow the angle, each has
 * its own. */
static bool share_angles(const torque_map *t)
{
    angle_grid of_all = {0.0, 0.0};
    for (size_t p = 0; p < t->count; ++p) {
        angle_grid grid = {0.0, 0.0};
        if (t->row_count[p] < LEAST_ROWS || !grid_find(t, p, &grid)) return false;
        if (p == 0) of_all = grid;
        const double least_rad = EVENLY * fabs(of_all.step_rad);
        if (fabs(grid.step_rad - of_all.step_rad) > least_rad) return false;
        if (fabs(remainder(grid.first_rad - of_all.first_rad, 2.0 * HCI_PI)) > least_rad) return false;
    }
    return true;
}

/* False when memory is out. */
static bool map_find(const hci_run *run, torque_map *t)
{
    *t = (torque_map){.run = run, .most_A = largest_current_A(run)};
    t->of_row = hci_memory_new(run->count, sizeof *t->of_row);
    t->i_A = hci_memory_new(HCI_MOST_MAP_POINTS, sizeof *t->i_A);
    t->row_count = hci_memory_new(HCI_MOST_MAP_POINTS, sizeof *t->row_count);
    if (!t->of_row || !t->i_A || !t->row_count) return false;
    rows_sort(t);
    if (!share_angles(t)) t->count = 0;
    return true;
}

static void map_release(torque_map *t)
{
    hci_memory_free(t->of_row);
    hci_memory_free(t->i_A);
    hci_memory_free(t->row_count);
}

/* ---- a run of each point ---- */

/* The numbers of a point's rows, `width` for each. `from` NULL: there are none, and none are needed. */
static bool rows_take(const torque_map *t, size_t point, const void *from, size_t width, void **to)
{
    const char *source = from;
    char *rows = from ? hci_memory_new(t->row_count[point] + 1, width) : NULL;
    size_t taken = 0;
    *to = rows;
    for (size_t k = 0; rows && k < t->run->count; ++k)
        if (t->of_row[k] == point) memcpy(rows + width * taken++, source + width * k, width);
    return rows || !from;
}

static bool columns_take(const torque_map *t, size_t point, hci_run *to)
{
    const hci_run *run = t->run;
    void *column[7];
    const struct {
        const void *from;
        size_t width;
    } all[] = {{run->theta_m_rad, sizeof(double)},
               {run->speed_rad_per_s, sizeof(double)},
               {run->i_A, 3 * sizeof(double)},
               {run->torque_Nm, sizeof(double)},
               {run->temperature_C, sizeof(double)},
               {run->v_V, 3 * sizeof(double)},
               {run->row, sizeof(size_t)}};
    bool taken = true;
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k)
        taken = rows_take(t, point, all[k].from, all[k].width, &column[k]) && taken;
    to->theta_m_rad = column[0];
    to->speed_rad_per_s = column[1];
    to->i_A = column[2];
    to->torque_Nm = column[3];
    to->temperature_C = column[4];
    to->v_V = column[5];
    to->row = column[6];
    return taken;
}

/* The angle begins within the first turn and goes on from row to row of a point, as in a file of its own. */
static void angle_unwrap(hci_run *run)
{
    const double turn_rad = 2.0 * HCI_PI / run->pole_pairs, first_rad = run->theta_m_rad[0];
    run->theta_m_rad[0] -= turn_rad * floor(first_rad / turn_rad) * (run->turn_known ? 0.0 : 1.0);
    for (size_t k = 1; k < run->count; ++k)
        run->theta_m_rad[k] =
            run->theta_m_rad[k - 1] + remainder(run->theta_m_rad[k] - run->theta_m_rad[k - 1], turn_rad);
}

/* False when memory is out; `to` has to be released either way. */
static bool point_take(const torque_map *t, size_t point, hci_run *to)
{
    char name[512];
    snprintf(name, sizeof name, "%.400s (i_d %.4g A; i_q %.4g A)", t->run->name, t->i_A[point].d + 0.0,
             t->i_A[point].q + 0.0);
    *to = *t->run;
    to->switched_off = t->i_A[point].d == 0.0 && t->i_A[point].q == 0.0;
    to->count = t->row_count[point];
    to->is_point = true;
    to->remark = (hci_note){{0}};
    to->name = hci_memory_text(name);
    const bool taken = columns_take(t, point, to) && to->name;
    if (taken) angle_unwrap(to);
    return taken;
}

static void remark_add(const torque_map *t, hci_run *first)
{
    hci_dq least = t->i_A[0], most = t->i_A[0];
    for (size_t p = 1; p < t->count; ++p) {
        least = (hci_dq){fmin(least.d, t->i_A[p].d), fmin(least.q, t->i_A[p].q), 0.0};
        most = (hci_dq){fmax(most.d, t->i_A[p].d), fmax(most.q, t->i_A[p].q), 0.0};
    }
    first->remark = t->run->remark;
    hci_note_add(&first->remark,
                 "%zu operating points in one file, i_d %.4g to %.4g A and i_q %.4g to %.4g A: each is a "
                 "recording of its own",
                 t->count, least.d + 0.0, most.d + 0.0, least.q + 0.0, most.q + 0.0);
}

/* ---- the list ---- */

/* Room for `more` entries behind run k; false when memory is out. */
static bool list_widen(hci_runs *runs, size_t k, size_t more)
{
    const size_t behind = runs->count - k - 1, count = runs->count + more;
    hci_run *run = hci_memory_resize(runs->run, count, sizeof *run);
    if (run) runs->run = run;
    hci_role *role = hci_memory_resize(runs->role, count, sizeof *role);
    if (role) runs->role = role;
    hci_run_origin *origin = runs->origin ? hci_memory_resize(runs->origin, count, sizeof *origin) : NULL;
    if (origin) runs->origin = origin;
    if (!run || !role || (runs->origin && !origin)) return false;
    memmove(run + k + 1 + more, run + k + 1, behind * sizeof *run);
    memmove(role + k + 1 + more, role + k + 1, behind * sizeof *role);
    if (origin) memmove(origin + k + 1 + more, origin + k + 1, behind * sizeof *origin);
    for (size_t p = 1; p <= more; ++p) {
        run[k + p] = (hci_run){0};
        role[k + p] = role[k];
        if (origin) origin[k + p] = (hci_run_origin){NULL, NULL, origin[k].row};
    }
    runs->count = count;
    return true;
}

/* Puts the points of run k in its place; `points` is theirs no longer. */
static bool list_replace(hci_runs *runs, size_t k, hci_run *points, size_t count)
{
    if (!list_widen(runs, k, count - 1)) return false;
    hci_run_release(&runs->run[k]);
    memcpy(runs->run + k, points, count * sizeof *points);
    memset(points, 0, count * sizeof *points);
    for (size_t p = 1; p < count && runs->origin; ++p) {
        runs->origin[k + p].path = hci_memory_text(runs->origin[k].path);
        runs->origin[k + p].columns = hci_memory_text(runs->origin[k].columns);
        if (!runs->origin[k + p].path || !runs->origin[k + p].columns) return false;
    }
    return true;
}

static bool run_split(hci_runs *runs, size_t k, size_t *points)
{
    torque_map t;
    bool done = map_find(&runs->run[k], &t);
    if (done && t.count > 0) runs->run[k].is_tabulated = true;
    if (t.count < 2) t.count = 0;
    *points = done && t.count > 0 ? t.count : 1;
    hci_run *point = done && t.count > 0 ? hci_memory_new(t.count, sizeof *point) : NULL;
    done = done && (t.count == 0 || point);
    for (size_t p = 0; p < t.count && done; ++p)
        done = point_take(&t, p, &point[p]);
    if (done && point) {
        remark_add(&t, point);
        done = list_replace(runs, k, point, t.count);
    }
    for (size_t p = 0; p < t.count && point; ++p)
        hci_run_release(&point[p]);
    hci_memory_free(point);
    map_release(&t);
    return done;
}

bool hci_runs_is_further_point(const hci_runs *runs, size_t k)
{
    return k > 0 && runs->origin && runs->run[k].is_point && runs->run[k - 1].is_point &&
           strcmp(runs->origin[k].path, runs->origin[k - 1].path) == 0;
}

void hci_torque_maps_tell(hci_runs *runs)
{
    size_t tabulated = 0;
    for (size_t k = 0; k < runs->count; ++k)
        tabulated += runs->run[k].is_tabulated;
    for (size_t k = 0; k < runs->count && tabulated > 0; ++k) {
        hci_run *run = &runs->run[k];
        if (!run->time_s || run->torque_source != HCI_TORQUE_MEASURED) continue;
        hci_note_add(
            &run->remark,
            "beside torques without a time at constant currents, as they are calculated: both are taken "
            "for one machine, with one zero of the angle");
        return;
    }
}

hci_status hci_torque_maps_split(hci_runs *runs, size_t first, hci_note *note)
{
    size_t points = 1;
    for (size_t k = first; k < runs->count; k += points) {
        if (!may_be_map(&runs->run[k])) {
            points = 1;
            continue;
        }
        if (!run_split(runs, k, &points))
            return hci_note_memory(note, runs->run[k].name, "its operating points");
    }
    return HCI_OK;
}
