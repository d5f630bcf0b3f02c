/* Rows at angles: what the hold misses of the torque is between `low` and `high`, line voltages are within
 * the dc link; equations: the torque stays at every order; a cone: the copper. The objective is high − low,
 * or the copper. */
#include "host/solution/hold_least.h"

#include <math.h>
#include <string.h>

#include "core/math/vector.h"
#include "host/base/memory.h"
#include "host/conic/solve.h"

#define UP      (2.0 / 3.0)  /* of the swing of a polygon about a sine: at its corners */
#define DOWN    (-1.0 / 3.0) /* and between them */
#define FADING  0.9          /* share of the highest order that the loop follows from which on orders fade */
#define MARGIN  0.01         /* of the voltage, for what the control adds */
#define WORKING 1e-6         /* error of a program that is taken as solved */

enum {
    ANGLES_PER_PERIOD = 8,
    DIRECTIONS =
        4 /* of a circle, from one line voltage on: a polygon of 24 sides leaves it by less than MARGIN */
};

/* A program under way. Unknowns: currents over scale_A, then high and low over scale_Nm. */
typedef struct {
    const hci_hold_question *q;
    size_t coordinates, n, angles, places, rows, row;
    double scale_A, scale_Nm, delta_rad, inductance_H;
    double *g, *h, *low; /* rows × n by columns, rows, two-sided rows */
} least;

bool hci_hold_is_known(const hci_limited *of)
{
    const hci_machine_data *m = of->machine;
    return hci_task_is_linear(of->task) && !of->task->has_neutral && !of->task->held &&
           m->resistance_ohm > 0.0 && m->inductance_d_H > 0.0 && m->inductance_q_H > 0.0 &&
           m->inductance_count == 0 && of->options->speed_rad_per_s != 0.0;
}

/* ---- what is missed ---- */

static double without_common(const double abc[3], int phase)
{
    return abc[phase] - (abc[0] + abc[1] + abc[2]) / 3.0;
}

/* Slope of the back-EMF by the electrical angle, without its zero sequence. */
static void emf_slope(const hci_machine *m, double theta_rad, double out[3])
{
    double abc[3] = {0.0, 0.0, 0.0};
    for (size_t k = 0; k < m->back_emf_count; ++k) {
        const hci_wave *w = &m->back_emf[k];
        const hci_wave slope = {w->order, w->sequence, -w->order * w->cosine, w->order * w->sine};
        double one[3];
        hci_waves_at(&slope, 1, theta_rad, one);
        for (int s = 0; s < 3; ++s)
            abc[s] += one[s];
    }
    for (int s = 0; s < 3; ++s)
        out[s] = without_common(abc, s);
}

/* What the hold takes of a coordinate's current: δ²/8 (n² i − R/(ωL) i'), with i' of a sine the cosine. */
static double missed_of(const least *l, size_t j, const double by[3], double theta_rad)
{
    const hci_component c = l->q->set->component[j / 2];
    const hci_machine_data *m = l->q->of->machine;
    const double n = c.order, share = 0.125 * l->delta_rad * l->delta_rad,
                 omega = l->q->of->options->speed_rad_per_s * m->pole_pairs,
                 ohmic = m->resistance_ohm / (omega * l->inductance_H);
    const hci_wave i = {n, c.sequence, j % 2 == 0, j % 2 == 1},
                   slope = {n, c.sequence, -n * i.cosine, n * i.sine};
    double value[3], change[3], sum = 0.0;
    hci_waves_at(&i, 1, theta_rad, value);
    hci_waves_at(&slope, 1, theta_rad, change);
    for (int s = 0; s < 3; ++s)
        sum += by[s] * share * (n * n * value[s] - ohmic * change[s]);
    return sum;
}

/* The row of missed torque at an angle; returns its constant, which the back-EMF makes. */
static double missed_row(const least *l, double theta_rad, double *g)
{
    const hci_task *t = l->q->of->task;
    const hci_machine *m = t->machine;
    const double share = 0.125 * l->delta_rad * l->delta_rad / (m->pole_pairs * l->inductance_H);
    double by[3], slope[3], constant_Nm = 0.0;
    hci_waves_at(t->gradient, t->gradient_count, theta_rad, by);
    emf_slope(m, theta_rad, slope);
    for (int s = 0; s < 3; ++s)
        constant_Nm -= by[s] * share * slope[s];
    for (size_t j = 0; j < l->coordinates; ++j)
        g[j] = missed_of(l, j, by, theta_rad);
    return constant_Nm;
}

static void begin(const hci_hold_question *q, least *l)
{
    const hci_limited *of = q->of;
    double top = 1.0;
    memset(l, 0, sizeof *l);
    l->q = q;
    l->coordinates = 2 * q->set->count;
    l->n = l->coordinates + 2;
    l->delta_rad = of->options->sample_rad;
    l->inductance_H = 0.5 * (of->machine->inductance_d_H + of->machine->inductance_q_H);
    for (size_t k = 0; k < q->set->count; ++k)
        top = fmax(top, q->set->component[k].order);
    for (size_t k = 0; k < of->machine->model.back_emf_count; ++k)
        top = fmax(top, of->machine->model.back_emf[k].order);
    l->angles = ANGLES_PER_PERIOD * of->task->period_turns * (size_t)ceil(top);
    l->scale_A = fmax(fabs(q->x[hci_vector_largest(l->coordinates, q->x)]), 1e-9);
    l->scale_Nm = fmax(fabs(hci_target_mean_Nm(of->options->target)), 1e-9);
}

static double angle_of(const least *l, size_t k)
{
    return 2.0 * HCI_PI * (double)l->q->of->task->period_turns * ((double)k + 0.31) / (double)l->angles;
}

double hci_hold_missed_Nm(const hci_hold_question *q, const double *x)
{
    least l;
    double high = -HUGE_VAL, low = HUGE_VAL;
    begin(q, &l);
    double *g = hci_memory_new(l.coordinates, sizeof *g);
    if (!g) return HUGE_VAL;
    for (size_t k = 0; k < l.angles; ++k) {
        const double constant = missed_row(&l, angle_of(&l, k), g);
        const double missed = constant + hci_vector_dot(l.coordinates, g, x);
        high = fmax(high, fmax(UP * missed, DOWN * missed));
        low = fmin(low, fmin(UP * missed, DOWN * missed));
    }
    hci_memory_free(g);
    return high - low;
}

/* ---- rows ---- */

static bool is_followed(const least *l, size_t j)
{
    const hci_component c = l->q->set->component[j / 2];
    const double highest = l->q->of->task->highest_rotor_order;
    return !(highest > 0.0) || fabs(c.order - c.sequence) <= FADING * highest;
}

/* A row of currents and one unknown beside them; orders that the loop does not follow have none. */
static void put(least *l, const double *g, double factor, size_t beside, double by)
{
    for (size_t j = 0; j < l->coordinates; ++j)
        l->g[l->row + j * l->rows] = is_followed(l, j) ? factor * g[j] : 0.0;
    if (beside < l->n) l->g[l->row + beside * l->rows] = by;
}

/* high >= share·missed >= low, for both shares. */
static void add_missed(least *l, double *g)
{
    const double shares[2] = {UP, DOWN};
    for (size_t k = 0; k < l->angles; ++k) {
        const double constant = missed_row(l, angle_of(l, k), g);
        for (int side = 0; side < 4; ++side) {
            const double sign = side < 2 ? 1.0 : -1.0, share = sign * shares[side % 2];
            put(l, g, share * l->scale_A / l->scale_Nm, l->coordinates + (side < 2 ? 0 : 1), -sign);
            l->h[l->row++] = -share * constant / l->scale_Nm;
        }
    }
}

/* What the loop has to command so that on average a component's voltage is held. */
static double held(const least *l, size_t j)
{
    const double x = 0.5 * l->q->set->component[j / 2].order * l->delta_rad;
    return x / sin(fmin(x, 1.5));
}

static bool is_circle(const least *l)
{
    return l->q->of->bounds->modulation == HCI_MODULATION_CIRCLE;
}

/* What is limited: a line voltage, or what of the vector is in a direction from that of a line voltage on. */
static hci_limit_point place_of(const least *l, int place, size_t k)
{
    const double first_rad = HCI_PI * (-1.0 / 6.0 + 2.0 / 3.0 * (place / DIRECTIONS)),
                 further_rad = HCI_PI / 3.0 / DIRECTIONS * (place % DIRECTIONS);
    if (!is_circle(l)) return (hci_limit_point){HCI_POINT_VOLTAGE, place, angle_of(l, k), 0.0};
    return (hci_limit_point){HCI_POINT_VECTOR, 0, angle_of(l, k), first_rad + further_rad};
}

static void add_voltages(least *l, const hci_limit_field *field, double *g)
{
    const double limit_V = l->q->of->bounds->line_V * (1.0 - MARGIN);
    for (size_t k = 0; k < l->angles; ++k)
        for (int place = 0; place < (int)l->places; ++place) {
            const hci_limit_point at = place_of(l, place, k);
            const double constant = hci_limit_row(field, &at, g) / limit_V;
            for (size_t j = 0; j < l->coordinates; ++j)
                g[j] *= held(l, j);
            put(l, g, l->scale_A / limit_V, l->n, 0.0);
            l->h[l->row] = 1.0 - constant;
            l->low[l->row++] = -1.0 - constant;
        }
}

/* |x| within the copper, or high − low within what may be missed. */
static void add_last(least *l, bool is_copper)
{
    if (!is_copper) {
        l->g[l->row + l->coordinates * l->rows] = 1.0;
        l->g[l->row + (l->coordinates + 1) * l->rows] = -1.0;
        l->h[l->row++] = l->q->enough_Nm / l->scale_Nm;
        return;
    }
    l->h[l->row++] = sqrt(l->q->most_A2 / 1.5) / l->scale_A;
    for (size_t j = 0; j < l->coordinates; ++j)
        l->g[l->row++ + j * l->rows] = -1.0;
}

/* ---- equations ---- */

typedef struct {
    size_t count;
    double *a, *b; /* count × n by columns, count */
} equations;

/* U x = U x_0, and no current of orders that the loop does not follow. */
static hci_status make_equations(const least *l, equations *e, hci_note *note)
{
    hci_harmonic_system s;
    hci_status status = hci_harmonic_system_make(l->q->of->task, l->q->set->component, l->q->set->count,
                                                 HCI_COMPARE_ALL, &s, note);
    if (status) return status;
    e->count = s.rows + l->coordinates;
    e->a = hci_memory_new(e->count * l->n, sizeof *e->a);
    e->b = hci_memory_new(e->count, sizeof *e->b);
    if (!e->a || !e->b) status = hci_note_memory(note, NULL, "solving");
    for (size_t j = 0; j < l->coordinates && !status; ++j) {
        for (int64_t k = s.u.column_start[j]; k < s.u.column_start[j + 1]; ++k) {
            const double value = s.u.value[k] * l->scale_A / l->scale_Nm;
            e->b[s.u.row[k]] += value * l->q->x[j] / l->scale_A;
            e->a[(size_t)s.u.row[k] + j * e->count] = value;
        }
        if (!is_followed(l, j)) e->a[s.rows + j + j * e->count] = 1.0;
    }
    hci_harmonic_system_release(&s);
    return status;
}

/* ---- all of it ---- */

/* Line voltages of components n = 3k + σ repeat from pair to pair. */
static size_t pairs_of(const least *l)
{
    if (!(l->q->of->bounds->line_V < HUGE_VAL)) return 0;
    for (size_t k = 0; k < l->q->set->count; ++k) {
        const hci_component c = l->q->set->component[k];
        if (fabs(remainder(c.order - c.sequence, 3.0)) > HCI_ORDER_TOLERANCE) return 3;
    }
    return 1;
}

static hci_status fill(least *l, bool is_copper, hci_note *note)
{
    hci_voltage_model model;
    const hci_limited *of = l->q->of;
    const hci_limit_field field = {l->q->set, NULL, &model, NULL, NULL, 0.0, of->task->period_turns};
    double *g = hci_memory_new(l->n, sizeof *g);
    hci_status status = g ? HCI_OK : hci_note_memory(note, NULL, "solving");
    if (!status && l->places > 0) status = hci_voltage_model_make(of->machine, of->options, &model, note);
    if (!status && l->places > 0) add_voltages(l, &field, g);
    if (!status) add_missed(l, g);
    if (!status) add_last(l, is_copper);
    hci_memory_free(g);
    return status;
}

/* What is made least: the swing high − low, or the copper. */
typedef struct {
    double *p, *c; /* n × n, n */
} objective;

static hci_status make_objective(const least *l, bool is_copper, objective *o, hci_note *note)
{
    o->p = hci_memory_new(l->n * l->n, sizeof *o->p);
    o->c = hci_memory_new(l->n, sizeof *o->c);
    if (!o->p || !o->c) return hci_note_memory(note, NULL, "solving");
    for (size_t j = 0; j < l->n; ++j)
        o->p[j * (l->n + 1)] = j < l->coordinates && !is_copper ? 1.0 : 1e-9;
    if (is_copper) {
        o->c[l->coordinates] = 1.0;
        o->c[l->coordinates + 1] = -1.0;
    }
    return HCI_OK;
}

static bool is_solved(const hci_cone_answer *a)
{
    return a->end != HCI_CONE_INFEASIBLE && a->end != HCI_CONE_UNBOUNDED && a->error < 10.0 * WORKING;
}

static hci_status minimise(const least *l, const equations *e, const objective *o, bool is_copper,
                           hci_cone_answer *a, hci_note *note)
{
    const size_t cone = l->coordinates + 1;
    const hci_cone_problem problem = {.unknowns = l->n,
                                      .p = o->p,
                                      .c = o->c,
                                      .equalities = e->count,
                                      .a = e->a,
                                      .b = e->b,
                                      .rows = l->rows,
                                      .two_sided = l->places * l->angles,
                                      .linear = l->rows - (is_copper ? cone : 0),
                                      .g = l->g,
                                      .h = l->h,
                                      .low = l->low,
                                      .cones = is_copper ? 1 : 0,
                                      .cone = &cone,
                                      .precision = WORKING};
    const hci_status status = hci_cone_solve(&problem, a, note);
    return !status && !is_solved(a) ? HCI_ERROR_NUMERIC : status;
}

static hci_status answer(const least *l, const equations *e, bool is_copper, double *x, hci_note *note)
{
    objective o = {NULL, NULL};
    hci_cone_answer a = {.x = NULL};
    hci_status status = make_objective(l, is_copper, &o, note);
    if (!status) status = minimise(l, e, &o, is_copper, &a, note);
    for (size_t j = 0; j < l->coordinates && !status; ++j)
        x[j] = is_followed(l, j) ? l->scale_A * a.x[j] : 0.0;
    hci_cone_answer_release(&a);
    hci_memory_free(o.p);
    hci_memory_free(o.c);
    return status;
}

/* is_copper: the copper is bounded and the swing least; else the other way round. */
static hci_status solve(const hci_hold_question *q, bool is_copper, double *x, hci_note *note)
{
    least l;
    equations e = {0, NULL, NULL};
    begin(q, &l);
    l.places = pairs_of(&l) * (is_circle(&l) ? DIRECTIONS : 1);
    l.rows = (l.places + 4) * l.angles + (is_copper ? l.coordinates + 1 : 1);
    l.g = hci_memory_new(l.rows * l.n, sizeof *l.g);
    l.h = hci_memory_new(l.rows, sizeof *l.h);
    l.low = hci_memory_new(l.rows, sizeof *l.low);
    hci_status status = l.g && l.h && l.low ? HCI_OK : hci_note_memory(note, NULL, "solving");
    if (!status) status = fill(&l, is_copper, note);
    if (!status) status = make_equations(&l, &e, note);
    if (!status) status = answer(&l, &e, is_copper, x, note);
    hci_memory_free(l.g);
    hci_memory_free(l.h);
    hci_memory_free(l.low);
    hci_memory_free(e.a);
    hci_memory_free(e.b);
    return status;
}

hci_status hci_hold_least(const hci_hold_question *q, double *x, hci_note *note)
{
    hci_status status = solve(q, true, x, note);
    if (status || hci_hold_missed_Nm(q, x) > q->enough_Nm) return status;
    double *less = hci_memory_new(2 * q->set->count, sizeof *less);
    if (!less) return hci_note_memory(note, NULL, "solving");
    status = solve(q, false, less, note);
    if (!status) memcpy(x, less, 2 * q->set->count * sizeof *x);
    hci_memory_free(less);
    return status == HCI_ERROR_MEMORY ? status : HCI_OK;
}
