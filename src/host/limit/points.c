#include "host/limit/points.h"

#include <math.h>
#include <string.h>

#include "core/math/vector.h"
#include "host/base/memory.h"
#include "host/numeric/peak.h"

#define PLANE  1.2247448713915890 /* √(3/2): from an amplitude to the orthonormal plane */
#define NEARLY 0.02 /* share of the band within which a sample may have a peak beyond beside it */

/* ---- one component at one angle ---- */

void hci_limit_turn(hci_component component, int phase, double turn[2])
{
    const double angle_rad = component.sequence * 2.0 * HCI_PI * phase / 3.0;
    turn[0] = cos(angle_rad);
    turn[1] = sin(angle_rad);
}

/* sin nθ and cos nθ as phase s sees them, for the coordinates S and C. */
static void phase_pair(hci_component c, int phase, double theta_rad, double g[2])
{
    const double angle_rad = c.order * theta_rad - c.sequence * 2.0 * HCI_PI * phase / 3.0;
    g[0] = sin(angle_rad);
    g[1] = cos(angle_rad);
}

/* The current in the plane and its slope for S = 1 (column 0) or C = 1 (column 1). */
static void plane_pair(hci_component c, double theta_rad, hci_plane_current i[2])
{
    const double s = PLANE * sin(c.order * theta_rad), k = PLANE * cos(c.order * theta_rad), n = c.order,
                 sign = c.sequence;
    memset(i, 0, 2 * sizeof *i);
    if (c.sequence == 0) return;
    i[0] = (hci_plane_current){{s, -sign * k}, {n * k, sign * n * s}};
    i[1] = (hci_plane_current){{k, sign * s}, {-n * s, sign * n * k}};
}

static void add_plane(const hci_wave *w, double theta_rad, hci_plane_current *sum)
{
    hci_plane_current i[2];
    plane_pair((hci_component){w->order, w->sequence}, theta_rad, i);
    for (int k = 0; k < 2; ++k) {
        sum->x[k] += w->sine * i[0].x[k] + w->cosine * i[1].x[k];
        sum->slope[k] += w->sine * i[0].slope[k] + w->cosine * i[1].slope[k];
    }
}

/* ---- rows ---- */

double hci_limit_of_point(const hci_bounds *bounds, hci_point_kind kind, int phase)
{
    return kind == HCI_POINT_CURRENT ? bounds->current_A[phase] : bounds->line_V;
}

static double current_row(const hci_limit_field *f, const hci_limit_point *p, double *g)
{
    double pair[2] = {0.0, 0.0};
    for (size_t k = 0; k < f->set->count; ++k)
        phase_pair(f->set->component[k], p->phase, p->theta_rad, g + 2 * k);
    if (!f->held) return 0.0;
    phase_pair((hci_component){f->held->order, f->held->sequence}, p->phase, p->theta_rad, pair);
    return f->held->sine * pair[0] + f->held->cosine * pair[1];
}

/* What of a voltage a point limits. */
static double of_point(const hci_limit_field *f, const hci_limit_point *p, const double v[2])
{
    return p->kind == HCI_POINT_VECTOR ? hci_voltage_in_direction(v, p->direction_rad)
                                       : hci_voltage_of_link(f->voltage, v, p->phase);
}

/* by_current · x + by_slope · x' */
static double link_of(const hci_limit_field *f, const hci_linear_voltage *v, const hci_plane_current *i,
                      const hci_limit_point *p)
{
    double sum[2];
    for (int k = 0; k < 2; ++k)
        sum[k] = v->by_current[k] * i->x[0] + v->by_current[2 + k] * i->x[1] + v->by_slope[k] * i->slope[0] +
                 v->by_slope[2 + k] * i->slope[1];
    return of_point(f, p, sum);
}

/* The voltage at one angle, made linear, and the currents there. */
typedef struct {
    hci_linear_voltage v;
    hci_plane_current at, held;
} voltage;

static voltage voltage_at(const hci_limit_field *f, double theta_rad)
{
    voltage x = {.at = {{0.0, 0.0}, {0.0, 0.0}}, .held = {{0.0, 0.0}, {0.0, 0.0}}};
    for (size_t k = 0; f->at && k < f->at->count; ++k)
        add_plane(&f->at->wave[k], theta_rad, &x.at);
    hci_voltage_linearise(f->voltage, theta_rad, &x.at, &x.v);
    if (f->held) add_plane(f->held, theta_rad, &x.held);
    return x;
}

static double voltage_row(const hci_limit_field *f, const voltage *x, const hci_limit_point *p, double *g)
{
    hci_plane_current i[2];
    for (size_t k = 0; k < f->set->count; ++k) {
        plane_pair(f->set->component[k], p->theta_rad, i);
        g[2 * k] = link_of(f, &x->v, &i[0], p);
        g[2 * k + 1] = link_of(f, &x->v, &i[1], p);
    }
    return of_point(f, p, x->v.value) + link_of(f, &x->v, &x->held, p) - link_of(f, &x->v, &x->at, p);
}

bool hci_limit_is_bent(const hci_limit_field *f)
{
    return f->voltage && f->voltage->effects && f->voltage->effects->count > 0;
}

double hci_limit_link_V(const hci_limit_field *f, const hci_limit_point *point, const hci_wave_list *i)
{
    hci_plane_current sum = {{0.0, 0.0}, {0.0, 0.0}};
    double v[2];
    for (size_t k = 0; k < i->count; ++k)
        add_plane(&i->wave[k], point->theta_rad, &sum);
    hci_voltage_at(f->voltage, point->theta_rad, &sum, v);
    return point->kind == HCI_POINT_VECTOR ? hci_voltage_of_circle(v)
                                           : hci_voltage_of_link(f->voltage, v, point->phase);
}

/* Σ over orders above 0 of (U x − h) as a wave at the angle. The weight of the rows is taken out again. */
static double torque_row(const hci_limit_field *f, const hci_limit_point *p, double *g)
{
    const hci_harmonic_system *s = f->system;
    double constant_Nm = 0.0, *at = g + s->unknowns;
    size_t row = 0;
    for (size_t k = 0; k < s->order_count; ++k) {
        const bool is_mean = s->order[k] < HCI_ORDER_TOLERANCE;
        const double angle_rad = s->order[k] * p->theta_rad;
        if (!is_mean) at[row++] = sin(angle_rad);
        at[row++] = is_mean ? 0.0 : cos(angle_rad);
    }
    for (row = 0; row < s->rows; ++row) {
        at[row] /= s->row_weight[row];
        constant_Nm -= at[row] * (f->mean_Nm * s->h[row] + s->h[s->rows + row]);
    }
    for (size_t j = 0; j < s->unknowns; ++j) {
        g[j] = 0.0;
        for (int64_t k = s->u.column_start[j]; k < s->u.column_start[j + 1]; ++k)
            g[j] += at[s->u.row[k]] * s->u.value[k];
    }
    return constant_Nm;
}

double hci_limit_row(const hci_limit_field *field, const hci_limit_point *point, double *g)
{
    if (point->kind == HCI_POINT_CURRENT) return current_row(field, point, g);
    if (point->kind == HCI_POINT_TORQUE) return torque_row(field, point, g);
    const voltage x = voltage_at(field, point->theta_rad);
    return voltage_row(field, &x, point, g);
}

size_t hci_limit_parts(hci_point_kind kind)
{
    return kind == HCI_POINT_VECTOR ? 2 : 1;
}

void hci_limit_rows(const hci_limit_field *f, const hci_limit_point *point, double *g)
{
    const size_t n = 2 * f->set->count;
    if (point->kind != HCI_POINT_VECTOR) {
        const double constant = hci_limit_row(f, point, g); /* which may write behind its row */
        g[n] = constant;
        return;
    }
    const voltage x = voltage_at(f, point->theta_rad);
    hci_limit_point at = *point;
    for (int axis = 0; axis < 2; ++axis, g += n + 1) {
        at.direction_rad = 0.5 * HCI_PI * axis;
        g[n] = voltage_row(f, &x, &at, g);
    }
}

double hci_limit_value(hci_point_kind kind, size_t n, const double *g, const double *x)
{
    const double first = g[n] + hci_vector_dot(n, g, x);
    if (kind != HCI_POINT_VECTOR) return first;
    return hypot(first, g[2 * n + 1] + hci_vector_dot(n, g + n + 1, x));
}

/* That of the torque is made in what is behind its end. */
size_t hci_limit_row_room(const hci_limit_field *f)
{
    return 4 * f->set->count + 2 + (f->system ? f->system->rows + f->system->unknowns : 0);
}

/* ---- lists ---- */

hci_status hci_limit_points_add(hci_limit_points *points, hci_limit_point point)
{
    if (points->count == points->room) {
        const size_t room = 2 * points->room + 64;
        hci_limit_point *more = hci_memory_resize(points->point, room, sizeof *more);
        if (!more) return HCI_ERROR_MEMORY;
        points->point = more;
        points->room = room;
    }
    points->point[points->count++] = point;
    return HCI_OK;
}

hci_status hci_limit_points_fill(const hci_limit_field *field, hci_limit_points *points)
{
    const size_t width = 4 * field->set->count + 2,
                 needed =
                     points->count * width + hci_limit_row_room(field); /* a row may write behind its end */
    if (needed > points->row_room) {
        double *more = hci_memory_resize(points->row, 2 * needed, sizeof *more);
        if (!more) return HCI_ERROR_MEMORY;
        points->row = more;
        points->row_room = 2 * needed;
    }
    points->width = width;
    for (; points->rows < points->count; ++points->rows)
        hci_limit_rows(field, &points->point[points->rows], points->row + points->rows * width);
    return HCI_OK;
}

const double *hci_limit_points_row(const hci_limit_points *points, size_t k)
{
    return points->row + k * points->width;
}

void hci_limit_points_keep(hci_limit_points *points, size_t k, size_t kept)
{
    points->point[kept] = points->point[k];
    memmove(points->row + kept * points->width, points->row + k * points->width,
            points->width * sizeof *points->row);
}

void hci_limit_points_cut(hci_limit_points *points, size_t count)
{
    points->count = count;
    if (points->rows > count) points->rows = count;
}

void hci_limit_points_change(hci_limit_points *points)
{
    points->rows = 0;
}

void hci_limit_points_release(hci_limit_points *points)
{
    hci_memory_free(points->point);
    hci_memory_free(points->row);
    memset(points, 0, sizeof *points);
}

/* ---- peaks ---- */

hci_status hci_limit_grid_make(const hci_limit_field *field, hci_limit_grid *grid)
{
    const size_t n = 2 * field->set->count, width = hci_limit_parts(grid->kind) * (n + 1);
    grid->unknowns = n;
    grid->step_rad = grid->period_rad / (double)grid->samples;
    grid->g = hci_memory_new(grid->samples * width + hci_limit_row_room(field), sizeof *grid->g);
    grid->is_row = hci_memory_new(grid->samples, sizeof *grid->is_row);
    if (!grid->g || !grid->is_row) return HCI_ERROR_MEMORY;
    for (size_t k = 0; k < grid->samples;
         ++k) { /* a row may write behind its end, which the next one fills */
        const hci_limit_point p = {grid->kind, grid->phase, grid->step_rad * (double)k, 0.0};
        hci_limit_rows(field, &p, grid->g + k * width);
    }
    return HCI_OK;
}

void hci_limit_grid_release(hci_limit_grid *grid)
{
    hci_memory_free(grid->g);
    hci_memory_free(grid->is_row);
    memset(grid, 0, sizeof *grid);
}

const double *hci_limit_grid_rows(const hci_limit_grid *grid, size_t k)
{
    return grid->g + k * hci_limit_parts(grid->kind) * (grid->unknowns + 1);
}

static double sample_at(const hci_limit_grid *grid, const double *x, size_t k)
{
    return hci_limit_value(grid->kind, grid->unknowns, hci_limit_grid_rows(grid, k), x);
}

void hci_limit_grid_thin(hci_limit_grid *grid, const double *x, const double range[2], double share)
{
    const double middle = 0.5 * (range[0] + range[1]), half = 0.5 * (range[1] - range[0]);
    for (size_t k = 0; k < grid->samples; ++k)
        if (grid->is_row[k] && fabs(sample_at(grid, x, k) - middle) < share * half) grid->is_row[k] = false;
}

/* A search for peaks under way; row: workspace. */
typedef struct {
    const hci_limit_field *field;
    const hci_limit_grid *grid;
    const double *x, *range;
    double *row;
} search;

/* How far a value is beyond the range; negative within. */
static double beyond(const double range[2], double value)
{
    return fmax(value - range[1], range[0] - value);
}

static double beyond_at(const void *context, double theta_rad)
{
    const search *s = context;
    const hci_limit_point p = {s->grid->kind, s->grid->phase, theta_rad, 0.0};
    hci_limit_rows(s->field, &p, s->row);
    return beyond(s->range, hci_limit_value(p.kind, s->grid->unknowns, s->row, s->x));
}

static hci_status take_peak(const search *s, size_t k, hci_limit_points *points, double *worst)
{
    const hci_peak_function f = {beyond_at, s};
    double theta_rad = s->grid->step_rad * (double)k;
    const double most = hci_peak_refine(&f, s->grid->step_rad, &theta_rad);
    *worst = fmax(*worst, most);
    if (most <= 0.0) return HCI_OK;
    return hci_limit_points_add(points, (hci_limit_point){s->grid->kind, s->grid->phase, theta_rad, 0.0});
}

hci_status hci_limit_peaks(const hci_limit_field *field, const hci_limit_grid *grid, const double *x,
                           const double range[2], hci_limit_points *points, double *worst)
{
    const size_t n = grid->samples;
    double *row = hci_memory_new(hci_limit_row_room(field) + n, sizeof *row);
    *worst = -HUGE_VAL;
    if (!row) return HCI_ERROR_MEMORY;
    double *over = row + hci_limit_row_room(field);
    const search s = {field, grid, x, range, row};
    const double near = NEARLY * (range[1] - range[0]);
    hci_status status = HCI_OK;
    for (size_t k = 0; k < n; ++k)
        over[k] = beyond(range, sample_at(grid, x, k));
    for (size_t k = 0; !status && k < n; ++k) {
        *worst = fmax(*worst, over[k]);
        if (over[k] >= over[(k + n - 1) % n] && over[k] > over[(k + 1) % n] && over[k] > -near)
            status = take_peak(&s, k, points, worst);
    }
    hci_memory_free(row);
    return status;
}
