/* The curves of a solution: sampled finely, and kept as two extremes for each step of the picture. */
#include "host/plot/solution_curves.h"

#include <math.h>
#include <string.h>

#include "hci/host/machine/expected_ripple.h"
#include "hci/machine/frames.h"

enum {
    MOST_FINE = 64, /* samples of a step */
    MOST_TURNS = 8, /* electrical, in one picture */
    FEW_TURNS = 3   /* that are drawn of more */
};

bool hci_order_is_missed(const hci_solved_order *o)
{
    return o->verdict > HCI_ORDER_FREE;
}

double hci_peak_Nm(hci_harmonic h)
{
    return h.order < HCI_ORDER_TOLERANCE ? fabs(h.cosine) : hci_amplitude(h.sine, h.cosine);
}

double hci_order_largest_Nm(const hci_solved_order *o)
{
    return fmax(hci_peak_Nm(o->target_Nm), fmax(hci_peak_Nm(o->torque_Nm), hci_peak_Nm(o->before_Nm)));
}

double hci_order_number(const hci_solved_order *o)
{
    return o->torque_Nm.order;
}

/* Below this share of the largest amplitude a harmonic is thinner than a line. */
#define VISIBLE 2e-3

static double visible_top_order(const hci_solution *s)
{
    double torque_Nm = 0.0, current_A = 0.0, top = 1.0;
    for (size_t k = 0; k < s->order_count; ++k)
        torque_Nm = fmax(torque_Nm, hci_order_largest_Nm(&s->order[k]));
    for (size_t k = 0; k < s->current.count; ++k)
        current_A = fmax(current_A, hci_amplitude(s->current.wave[k].sine, s->current.wave[k].cosine));
    for (size_t k = 0; k < s->order_count; ++k)
        if (hci_order_largest_Nm(&s->order[k]) >= VISIBLE * torque_Nm)
            top = fmax(top, hci_order_number(&s->order[k]));
    for (size_t k = 0; k < s->current.count; ++k)
        if (hci_amplitude(s->current.wave[k].sine, s->current.wave[k].cosine) >= VISIBLE * current_A)
            top = fmax(top, s->current.wave[k].order);
    return top;
}

#define RIPPLE                                                                                               \
    0.01 /* of the largest order of the ripple: what is smaller makes no turn another than the last */

static bool repeats(double order, size_t turns)
{
    const double times = order * (double)turns;
    return fabs(times - round(times)) < HCI_ORDER_TOLERANCE * (double)turns;
}

/* Whether what is seen repeats after so many turns. */
static bool all_repeat(const hci_solution *s, double ripple_Nm, double current_A, size_t turns)
{
    for (size_t k = 0; k < s->order_count; ++k)
        if (hci_order_largest_Nm(&s->order[k]) >= ripple_Nm &&
            !repeats(hci_order_number(&s->order[k]), turns))
            return false;
    for (size_t k = 0; k < s->current.count; ++k)
        if (hci_amplitude(s->current.wave[k].sine, s->current.wave[k].cosine) >= current_A &&
            !repeats(s->current.wave[k].order, turns))
            return false;
    return true;
}

static double seen_ripple_Nm(const hci_solution *s)
{
    double ripple_Nm = 0.0;
    for (size_t k = 0; k < s->order_count; ++k)
        if (hci_order_number(&s->order[k]) >= HCI_ORDER_TOLERANCE)
            ripple_Nm = fmax(ripple_Nm, RIPPLE * hci_order_largest_Nm(&s->order[k]));
    return ripple_Nm;
}

/* The turns after which what is seen repeats: those of the period, or fewer. */
static size_t visible_turns(const hci_solution *s)
{
    const double ripple_Nm = seen_ripple_Nm(s);
    double current_A = 0.0;
    size_t turns = 1;
    for (size_t k = 0; k < s->current.count; ++k)
        current_A =
            fmax(current_A, VISIBLE * hci_amplitude(s->current.wave[k].sine, s->current.wave[k].cosine));
    while (turns < s->period_turns && !all_repeat(s, ripple_Nm, current_A, turns))
        ++turns;
    return turns;
}

static void hci_solution_curves_sample(const hci_solution_curves *c, double theta_rad,
                                       double value[HCI_CURVES])
{
    const hci_solution *s = c->solution;
    double plain[3];
    for (size_t k = HCI_CURVE_BEFORE; k <= HCI_CURVE_AFTER; ++k)
        value[k] = 0.0;
    for (size_t k = 0; k < s->order_count; ++k) {
        const hci_solved_order *o = &s->order[k];
        const double sine = sin(hci_order_number(o) * theta_rad),
                     cosine = cos(hci_order_number(o) * theta_rad);
        value[HCI_CURVE_BEFORE] += o->before_Nm.sine * sine + o->before_Nm.cosine * cosine;
        value[HCI_CURVE_WANTED] += o->target_Nm.sine * sine + o->target_Nm.cosine * cosine;
        value[HCI_CURVE_AFTER] += o->torque_Nm.sine * sine + o->torque_Nm.cosine * cosine;
    }
    hci_waves_at(s->current.wave, s->current.count, theta_rad, &value[HCI_CURVE_PHASE_A]);
    hci_waves_at(&c->solution->plain, 1, theta_rad, plain);
    value[HCI_CURVE_PLAIN_A] = plain[0];
}

static double sample_angle_rad(const hci_solution_curves *c, size_t column, size_t k)
{
    return 2.0 * HCI_PI * c->turns * ((double)column + (double)k / (double)c->fine) / HCI_CURVE_COLUMNS;
}

static void fill_column(hci_solution_curves *c, size_t column)
{
    double low[HCI_CURVES], high[HCI_CURVES], value[HCI_CURVES];
    size_t low_at[HCI_CURVES] = {0}, high_at[HCI_CURVES] = {0};
    hci_solution_curves_sample(c, sample_angle_rad(c, column, 0), low);
    memcpy(high, low, sizeof high);
    for (size_t k = 1; k < c->fine; ++k) {
        hci_solution_curves_sample(c, sample_angle_rad(c, column, k), value);
        for (size_t j = 0; j < HCI_CURVES; ++j) {
            if (value[j] < low[j]) {
                low[j] = value[j];
                low_at[j] = k;
            } else if (value[j] > high[j]) {
                high[j] = value[j];
                high_at[j] = k;
            }
        }
    }
    for (size_t j = 0; j < HCI_CURVES; ++j) {
        const bool low_first = low_at[j] <= high_at[j];
        c->value[j][2 * column] = low_first ? low[j] : high[j];
        c->value[j][2 * column + 1] = low_first ? high[j] : low[j];
    }
}

static void fill(hci_solution_curves *c, const hci_solution *s, size_t turns)
{
    const double most = (double)HCI_CURVE_COLUMNS * MOST_FINE;
    double end[HCI_CURVES];
    c->solution = s;
    c->beside = HCI_RANGE_EMPTY;
    c->top_order = visible_top_order(s);
    c->turns = fmax(1.0, fmin((double)turns, floor(most / (8.0 * c->top_order))));
    c->fine = (size_t)fmax(2.0, fmin(MOST_FINE, ceil(8.0 * c->top_order * c->turns / HCI_CURVE_COLUMNS)));
    for (size_t k = 0; k < HCI_CURVE_COLUMNS; ++k)
        fill_column(c, k);
    hci_solution_curves_sample(c, sample_angle_rad(c, HCI_CURVE_COLUMNS, 0), end);
    for (size_t j = 0; j < HCI_CURVES; ++j)
        c->value[j][HCI_CURVE_VERTICES] = end[j];
}

/* Turns in which the slowest ripple that is seen comes once, and a few. */
static size_t few_turns(const hci_solution *s)
{
    double turns = FEW_TURNS;
    const double ripple_Nm = seen_ripple_Nm(s);
    for (size_t k = 0; k < s->order_count; ++k) {
        const double order = hci_order_number(&s->order[k]);
        if (order >= HCI_ORDER_TOLERANCE && hci_order_largest_Nm(&s->order[k]) >= ripple_Nm)
            turns = fmax(turns, ceil(1.0 / order - HCI_ORDER_TOLERANCE));
    }
    return (size_t)turns;
}

void hci_solution_curves_fill(hci_solution_curves *c, const hci_solution *s)
{
    const size_t turns = visible_turns(s), few = few_turns(s);
    fill(c, s, turns > MOST_TURNS && few < turns ? few : turns);
}

void hci_solution_curves_fill_period(hci_solution_curves *c, const hci_solution *s)
{
    fill(c, s, s->period_turns);
}

hci_range hci_curve_range(const double *value)
{
    hci_range r = HCI_RANGE_EMPTY;
    for (size_t k = 0; k <= HCI_CURVE_VERTICES; ++k)
        hci_range_include(&r, value[k]);
    return r;
}

hci_dq hci_curve_vector(const hci_wave *waves, size_t count, double theta_rad)
{
    double abc[3];
    hci_waves_at(waves, count, theta_rad, abc);
    return hci_park(hci_clarke(abc), theta_rad);
}

enum { MOST_VECTORS = 10 * HCI_CURVE_COLUMNS };

size_t hci_curve_vectors(const hci_solution_curves *c)
{
    return (size_t)fmax(HCI_CURVE_VERTICES, fmin(MOST_VECTORS, ceil(64.0 * c->top_order * c->turns)));
}

hci_dq hci_curve_vector_sample(const hci_solution_curves *c, size_t k, size_t count)
{
    const double theta_rad = 2.0 * HCI_PI * c->turns * (double)k / (double)count;
    return hci_curve_vector(c->solution->current.wave, c->solution->current.count, theta_rad);
}

void hci_curve_vector_ranges(const hci_solution_curves *c, hci_plot_facts *f)
{
    f->d_A = f->q_A = HCI_RANGE_EMPTY;
    for (size_t k = 0, count = hci_curve_vectors(c); k < count; ++k) {
        const hci_dq i = hci_curve_vector_sample(c, k, count);
        hci_range_include(&f->d_A, i.d);
        hci_range_include(&f->q_A, i.q);
    }
}

/* ---- ranges, and the room that their numbers take ---- */

double hci_plot_expected_Nm(const hci_solution *s)
{
    const double bound_Nm = s->expected.error_peak_to_peak_Nm;
    if (s->expected.state != HCI_RIPPLE_KNOWN || hci_solution_is_boundless(s) || !(bound_Nm > 0.0))
        return 0.0;
    return hci_ripple_bound_as_said(bound_Nm);
}

static hci_range range_of(const hci_solution_curves *c, size_t first, size_t last)
{
    hci_range r = HCI_RANGE_EMPTY;
    for (size_t j = first; j <= last; ++j) {
        const hci_range one = hci_curve_range(c->value[j]);
        hci_range_include(&r, one.low);
        hci_range_include(&r, one.high);
    }
    return r;
}

hci_range hci_curve_torque_range(const hci_solution_curves *c)
{
    const double half_Nm = 0.5 * hci_plot_expected_Nm(c->solution);
    const hci_range after = hci_curve_range(c->value[HCI_CURVE_AFTER]);
    hci_range r = range_of(c, HCI_CURVE_BEFORE, HCI_CURVE_AFTER);
    hci_range_include(&r, after.low - half_Nm);
    hci_range_include(&r, after.high + half_Nm);
    return r;
}

hci_range hci_curve_current_range(const hci_solution_curves *c)
{
    return range_of(c, HCI_CURVE_PHASE_A, HCI_CURVE_PLAIN_A);
}

hci_range hci_curve_dq_range(const hci_solution_curves *c)
{
    hci_plot_facts f;
    hci_curve_vector_ranges(c, &f);
    hci_range all = f.d_A;
    hci_range_include(&all, f.q_A.low);
    hci_range_include(&all, f.q_A.high);
    hci_range_include(&all, hci_curve_vector(&c->solution->plain, 1, 0.0).q);
    return all;
}

static void make_room(hci_range r, hci_svg_box *b, const hci_svg_box *box)
{
    if (r.low > r.high) return;
    const hci_svg_axis y = hci_svg_axis_over(r, box->bottom, box->top, HCI_CURVE_TICKS);
    b->left = fmax(b->left, hci_svg_box_beside(*box, &y).left);
}

hci_svg_box hci_curve_box(const hci_solution_curves *c, const hci_svg_box *box)
{
    hci_svg_box b = *box;
    make_room(hci_curve_torque_range(c), &b, box);
    make_room(hci_curve_current_range(c), &b, box);
    make_room(hci_curve_dq_range(c), &b, box);
    make_room(c->beside, &b, box);
    return b;
}

void hci_plot_solution_point(const hci_solution *solution, double theta_rad, hci_plot_point *point)
{
    const hci_solution_curves c = {.solution = solution};
    double value[HCI_CURVES];
    hci_solution_curves_sample(&c, theta_rad, value);
    point->before_Nm = value[HCI_CURVE_BEFORE];
    point->wanted_Nm = value[HCI_CURVE_WANTED];
    point->after_Nm = value[HCI_CURVE_AFTER];
    point->plain_A = value[HCI_CURVE_PLAIN_A];
    memcpy(point->phase_A, &value[HCI_CURVE_PHASE_A], sizeof point->phase_A);
    point->dq_A = hci_curve_vector(solution->current.wave, solution->current.count, theta_rad);
}
