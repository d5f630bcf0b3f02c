/* The largest torque at one speed: with any ripple, of the nearest mean to one that is too large; with no
 * more ripple than is allowed, by narrowing down between a torque that has it and one that has not; and of
 * the plain sine, as the largest mean of the one component. */
#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/limit/bounds.h"
#include "host/machine/quadratic_model.h"
#include "host/sweep/figures.h"

enum { MOST_TRIALS = 20, MOST_FAILURES = 4, MOST_STEPS = 30, SPARE_ORDERS = 8 };

#define FIRST     1.3    /* of the torque of a plain sine at the limit: what is asked for first */
#define ANOTHER   1.17   /* of it: what is asked for where the solver does not succeed */
#define NEAR      2e-3   /* share of the torque to which the largest is found */
#define JUST      0.995  /* share of the ripple allowed from which a torque is the largest */
#define AIM       0.9975 /* share of the ripple allowed that is looked for */
#define FIRST_CUT 0.9    /* of the largest with any ripple: what is tried first */
#define EDGE      0.04   /* share of the bracket that each step takes off at least */
#define NOTHING   1e-3   /* share of the largest torque, or torque constant, that is none */

/* ---- the largest torque ---- */

/* The amplitude of a sine that would keep all limits of the current, roughly; infinite without one. */
static double amplitude_within(const hci_bounds *b)
{
    double most_A = 0.0;
    for (int s = 0; s < 3; ++s)
        most_A = fmax(most_A, fmin(b->current_A[s], sqrt(2.0) * b->rms_A[s]));
    return fmin(most_A, sqrt(2.0 / 3.0 * b->mean_square_A2));
}

/* Without what compares with a torque that only the search asked for. */
static hci_grid_figures by_itself(hci_grid_figures f)
{
    f.worst_Nm = f.worst_order = f.loss_to_plain = NAN;
    return f;
}

static void solve_for(const hci_machine_data *machine, const hci_solve_options *options, double torque_Nm,
                      hci_grid_answer *a)
{
    hci_solve_options o = *options;
    hci_target_order mean = {{0.0, 0.0, torque_Nm}, 1.0};
    hci_target target = {&mean, 1};
    o.target = &target;
    hci_grid_solve_once(machine, &o, a);
}

/* The nearest to a mean that is beyond all; the ripple that comes with it is that of the worst order. */
static void solve_largest(const hci_machine_data *machine, const hci_solve_options *options, double first_Nm,
                          hci_grid_answer *a)
{
    hci_solve_options o = *options;
    double torque_Nm = first_Nm;
    o.minimise = HCI_MINIMISE_AUTO;
    for (int k = 0, failures = 0; k < MOST_TRIALS && failures < MOST_FAILURES; ++k) {
        solve_for(machine, &o, torque_Nm, a);
        if (a->verdict == HCI_GRID_TORQUE || a->verdict == HCI_GRID_LIMITS) return;
        failures += a->verdict == HCI_GRID_FAILED;
        torque_Nm *= a->verdict == HCI_GRID_FAILED ? ANOTHER : 2.0;
    }
    if (a->verdict == HCI_GRID_FAILED) return;
    a->verdict = HCI_GRID_FAILED;
    hci_note_set(&a->reason, HCI_ERROR_NUMERIC, "no torque was found that is beyond the limits");
}

/* ---- with no more ripple than is allowed ---- */

/* Between a torque with little enough ripple and the last ones with more. */
typedef struct {
    const hci_grid_request *request;
    const hci_solve_options *options;
    double allowed_percent;
    double good_Nm, good_percent; /* 0 before the first */
    double bad_Nm, bad_percent;
    double worse_Nm, worse_percent; /* the bad one before; NAN before the first */
    hci_grid_figures best;
} search;

/* Where a straight line through two torques has the ripple that is looked for. */
static double line(const search *s, double a_Nm, double a_percent, double b_Nm, double b_percent)
{
    return a_Nm + (AIM * s->allowed_percent - a_percent) * (b_Nm - a_Nm) / (b_percent - a_percent);
}

/* The next torque to try: by a line where there is one, and always inside the bracket. is_slow: by halving.
 */
static double next_Nm(const search *s, bool is_slow)
{
    const double width_Nm = s->bad_Nm - s->good_Nm, edge_Nm = EDGE * width_Nm;
    double next = s->good_Nm + 0.5 * width_Nm;
    if (!is_slow && s->good_percent > 0.05 * s->allowed_percent)
        next = line(s, s->good_Nm, s->good_percent, s->bad_Nm, s->bad_percent);
    else if (!is_slow && isfinite(s->worse_percent) && s->worse_percent > s->bad_percent)
        next = line(s, s->bad_Nm, s->bad_percent, s->worse_Nm, s->worse_percent);
    else if (!is_slow && !(s->good_Nm > 0.0))
        next = FIRST_CUT * s->bad_Nm;
    if (!isfinite(next)) next = s->good_Nm + 0.5 * width_Nm;
    return fmin(fmax(next, s->good_Nm + edge_Nm), s->bad_Nm - edge_Nm);
}

static void try_torque(search *s, double torque_Nm)
{
    hci_grid_answer a;
    solve_for(s->request->machine, s->options, torque_Nm, &a);
    const bool is_good = a.verdict <= HCI_GRID_TORQUE && a.figures.T_ripple_percent <= s->allowed_percent &&
                         a.figures.mean_Nm >= (1.0 - 0.5 * NEAR) * torque_Nm;
    if (is_good) {
        s->good_Nm = torque_Nm;
        s->good_percent = a.figures.T_ripple_percent;
        s->best = a.figures;
        return;
    }
    s->worse_Nm = s->bad_Nm;
    s->worse_percent = s->bad_percent;
    s->bad_Nm = torque_Nm;
    s->bad_percent = a.figures.T_ripple_percent;
}

static bool goes_on(const search *s)
{
    if (s->bad_Nm - s->good_Nm <= NEAR * s->bad_Nm) return false;
    return !(s->good_percent >= JUST * s->allowed_percent);
}

/* Fills best and its verdict from `most`. */
static void narrow(search *s, hci_grid_row *row)
{
    const double most_Nm = row->most.mean_Nm;
    double before_Nm = HUGE_VAL;
    s->bad_Nm = most_Nm;
    s->bad_percent = row->most.T_ripple_percent;
    s->worse_percent = NAN;
    for (int k = 0; k < MOST_STEPS && goes_on(s) && s->bad_Nm > NOTHING * most_Nm; ++k) {
        const double width_Nm = s->bad_Nm - s->good_Nm;
        try_torque(s, next_Nm(s, k > 3 && k % 2 == 1 && width_Nm > 0.5 * before_Nm));
        before_Nm = width_Nm;
    }
    row->verdict = s->good_Nm > 0.0 ? HCI_GRID_REACHED : HCI_GRID_RIPPLE;
    if (s->good_Nm > 0.0) row->best = s->best;
}

/* ---- the plain sine ---- */

static size_t top_order(const hci_grid_request *r)
{
    const hci_machine *m = &r->machine->model;
    double top = 1.0;
    for (size_t k = 0; k < m->back_emf_count; ++k)
        top = fmax(top, m->back_emf[k].order);
    for (size_t k = 0; k < m->cogging_count; ++k)
        top = fmax(top, m->cogging[k].order);
    for (size_t k = 0; k < m->slope_count; ++k)
        top = fmax(top, m->slope[k].order);
    if (r->options->effects) top = fmax(top, hci_effects_top_order(r->options->effects));
    return (size_t)ceil(top) + SPARE_ORDERS;
}

/* Any ripple will do: each whole order and each of the cogging torque has the weight 0. */
static hci_target_order *orders_without_weight(const hci_grid_request *r, size_t *count)
{
    const hci_machine *m = &r->machine->model;
    const size_t top = top_order(r);
    hci_target_order *order = hci_memory_new(1 + top + m->cogging_count, sizeof *order);
    size_t n = 0;
    if (!order) return NULL;
    order[n++] = (hci_target_order){{0.0, 0.0, 0.0}, 1.0};
    for (size_t k = 1; k <= top; ++k)
        order[n++] = (hci_target_order){{(double)k, 0.0, 0.0}, 0.0};
    for (size_t k = 0; k < m->cogging_count; ++k)
        if (fabs(m->cogging[k].order - floor(m->cogging[k].order + 0.5)) > HCI_ORDER_TOLERANCE)
            order[n++] = (hci_target_order){{m->cogging[k].order, 0.0, 0.0}, 0.0};
    *count = n;
    return order;
}

static void solve_sine(const hci_grid_request *r, const hci_solve_options *options, double first_Nm,
                       hci_grid_row *row)
{
    hci_component component = {1.0, 1};
    hci_set name = HCI_SET_POS;
    const hci_component_set set = {&component, &name, 1, {{0}}};
    hci_target target = {NULL, 0};
    hci_solve_options o = *options;
    hci_grid_answer a = {.verdict = HCI_GRID_RIPPLE};
    target.order = orders_without_weight(r, &target.count);
    if (!target.order) return;
    o.target = &target;
    o.set = &set;
    o.choose_at_most = 0;
    o.method = HCI_METHOD_AUTO;
    o.minimise = HCI_MINIMISE_AUTO;
    for (int k = 0; k < MOST_TRIALS && a.verdict <= HCI_GRID_RIPPLE; ++k, first_Nm *= 2.0) {
        target.order[0].torque_Nm.cosine = first_Nm;
        hci_grid_solve_once(r->machine, &o, &a);
    }
    if (a.verdict == HCI_GRID_TORQUE) row->sine = by_itself(a.figures);
    hci_memory_free(target.order);
}

/* ---- all of it ---- */

/* Whether the plain sine is one of the currents that may be used. */
static bool has_sine(const hci_solve_options *o)
{
    if (!o->set) return true;
    for (size_t k = 0; k < o->set->count; ++k)
        if (o->set->component[k].order == 1.0 && o->set->component[k].sequence == 1) return true;
    return false;
}

/* Where the torque is not linear a search may end below the sine, which is a bound from below. */
static void take_sine(const hci_solve_options *o, search *s, hci_grid_row *row)
{
    const hci_grid_figures *sine = &row->sine;
    if (!has_sine(o) || !(sine->mean_Nm > 0.0)) return;
    if (!(row->most.mean_Nm >= sine->mean_Nm)) row->most = *sine;
    if (!(sine->T_ripple_percent <= s->allowed_percent)) return;
    s->good_Nm = sine->mean_Nm;
    s->good_percent = sine->T_ripple_percent;
    s->best = *sine;
}

/* The sine first, since it tells how much torque there is about. */
static void fill(const hci_grid_request *r, const hci_solve_options *o, double first_Nm, hci_grid_row *row)
{
    search s = {
        .request = r, .options = o, .allowed_percent = r->ripple_percent > 0.0 ? r->ripple_percent : 1.0};
    hci_grid_answer a;
    solve_sine(r, o, first_Nm, row);
    solve_largest(r->machine, o, row->sine.mean_Nm > 0.0 ? FIRST * row->sine.mean_Nm : first_Nm, &a);
    if (a.verdict == HCI_GRID_FAILED) {
        const hci_grid_figures sine = row->sine;
        hci_grid_fail(&row->point, a.reason.text, row);
        row->sine = sine;
        return;
    }
    row->verdict = HCI_GRID_LIMITS;
    if (a.verdict == HCI_GRID_LIMITS || !(a.figures.mean_Nm > NOTHING * NEAR * first_Nm)) return;
    row->most = by_itself(a.figures);
    row->verdict = HCI_GRID_REACHED;
    take_sine(o, &s, row);
    if (row->most.T_ripple_percent <= s.allowed_percent)
        row->best = row->most;
    else
        narrow(&s, row);
}

/* The torque of a sine of an amplitude; where the back-EMF has next to no fundamental, of that in its largest
 * harmonic. */
static double torque_about_Nm(const hci_machine_data *m, double amplitude_A)
{
    const hci_machine *x = &m->model;
    const double of_sine = hci_machine_torque_constant(m);
    double most = 0.0;
    for (size_t k = 0; k < x->back_emf_count; ++k)
        most = fmax(most, 1.5 * hci_amplitude(x->back_emf[k].sine, x->back_emf[k].cosine));
    return amplitude_A * (of_sine > NOTHING * most ? of_sine : most);
}

void hci_grid_envelope(const hci_grid_request *r, const hci_grid_point *p, hci_grid_row *row)
{
    hci_target_order none = {{0.0, 0.0, 1.0}, 1.0};
    const hci_target target = {&none, 1};
    hci_solve_options o = hci_grid_options_of(r, p, &target);
    hci_bounds b;
    hci_note note = {{0}};
    if (o.minimise == HCI_MINIMISE_AUTO) o.minimise = HCI_MINIMISE_PEAK_TO_PEAK;
    if (hci_bounds_make(r->machine, &o, 0.0, &b, &note))
        hci_grid_fail(p, note.text, row);
    else if (!(amplitude_within(&b) < HUGE_VAL))
        hci_grid_fail(p,
                      "the largest torque is that of a limit of the current, and there is none; give "
                      "--limit-current, --limit-rms or --limit-copper, or max_current in machine.csv",
                      row);
    else
        fill(r, &o, FIRST * torque_about_Nm(r->machine, amplitude_within(&b)), row);
}
