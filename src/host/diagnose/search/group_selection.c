#include "host/diagnose/search/group_selection.h"

#include <math.h>
#include <string.h>

#include "host/diagnose/fit/fit.h"
#include "host/diagnose/search/search.h"

#define SEED_MARGIN                                                                                          \
    10.0 /* by how much several powers at once must lower the score more than one by one, and as a share */
#define SEED_SHARE 0.1
#define LEAST_GAIN 2.0  /* least fall of the score for one more order of an effect */
#define LITTLE     1e-3 /* and its least share of what noise is in all samples */
#define ALIKE                                                                                                \
    0.5 /* share of a column that those which are in leave of it, below which they may stand for it */
#define TIE 1e-9 /* of a fall, by which two that explain the same differ by rounding: the first is taken */

enum { MOST_ORDERS = 12, MOST_POWERS = 80 }; /* that come in together; of saturation */

typedef struct {
    const hci_selection *choice;
    const hci_effect_type *a, *b;
    hci_sweep *sweep;
    bool *in; /* of each candidate */
    double cost;
} selecting;

bool hci_selection_enter(const hci_selection *c, hci_sweep *sweep, size_t k)
{
    bool any = false;
    for (size_t j = 0; j < c->list->candidate[k].count; ++j)
        any = hci_sweep_in(sweep, c->column[k] + j) || any;
    return any;
}

static void leave(const selecting *g, size_t k)
{
    for (size_t j = 0; j < g->choice->list->candidate[k].count; ++j)
        hci_sweep_out(g->sweep, g->choice->column[k] + j);
}

static bool is_open(const selecting *g, size_t k)
{
    const hci_candidate *x = &g->choice->list->candidate[k];
    return !g->in[k] && !x->in && (x->type == g->a || x->type == g->b);
}

static double cost_of(const selecting *g, size_t k)
{
    return hci_candidate_cost(&g->choice->list->candidate[k], g->choice->rows);
}

/* Fall of the score by a candidate: by coming in when it is out, by staying when it is in. */
static double gain_of(const selecting *g, size_t k)
{
    return hci_sweep_reduction(g->sweep, g->choice->column[k], g->choice->list->candidate[k].count) -
           cost_of(g, k);
}

/* What one more candidate of an effect must bring: of many orders there is always one that brings a little.
 */
static double least_gain(const selecting *g, size_t k)
{
    const hci_candidate *x = &g->choice->list->candidate[k];
    const bool ordered = x->type->parameter[x->term[0].parameter].ordered;
    return ordered ? fmax(LEAST_GAIN, LITTLE * g->choice->rows) : LEAST_GAIN;
}

static bool take(selecting *g, size_t k)
{
    if (!hci_selection_enter(g->choice, g->sweep, k)) return false;
    g->in[k] = true;
    g->cost += cost_of(g, k);
    return true;
}

/* Takes in the one that lowers the score most. */
static bool take_best(selecting *g, bool first)
{
    const size_t n = g->choice->list->count;
    size_t best = n;
    double most = 0.0;
    for (size_t k = 0; k < n; ++k) {
        if (!is_open(g, k)) continue;
        const double gain = gain_of(g, k);
        if (gain > most + TIE * most && (first || gain > least_gain(g, k))) {
            most = gain;
            best = k;
        }
    }
    return best < n && take(g, best);
}

/* The one whose leaving would lower the score most; the number of candidates where none would. */
static size_t superfluous(const selecting *g)
{
    const size_t n = g->choice->list->count;
    size_t worst = n;
    double least = 0.0;
    for (size_t k = 0; k < n; ++k) {
        if (!g->in[k]) continue;
        const double gain = gain_of(g, k);
        if (gain < least) {
            least = gain;
            worst = k;
        }
    }
    return worst;
}

/* Takes out those without which the score is lower, the most superfluous first. */
static void leave_superfluous(selecting *g)
{
    const size_t n = g->choice->list->count;
    for (size_t k = superfluous(g); k < n; k = superfluous(g)) {
        leave(g, k);
        g->in[k] = false;
        g->cost -= cost_of(g, k);
    }
}

/* By how much the score has fallen. */
static double fall_of(const selecting *g)
{
    return g->choice->base->square - g->sweep->square - g->cost;
}

/* Takes candidates in while the score falls, and those out that have become superfluous. Returns the fall of
 * the score.
 */
static double select_terms(selecting *g)
{
    const int orders = g->a == g->b ? MOST_ORDERS : 2 * MOST_ORDERS;
    const int steps = g->a->is_series ? MOST_POWERS : orders;
    for (int step = 0; step < steps; ++step) {
        if (!take_best(g, step == 0 && g->cost == 0.0)) break;
        leave_superfluous(g);
    }
    return fall_of(g);
}

static void start(selecting *g, bool *in)
{
    g->in = in;
    g->cost = 0.0;
    memset(in, 0, g->choice->list->count * sizeof *in);
    hci_sweep_copy(g->sweep, g->choice->base);
}

/* Whether those that are in make nearly all of a candidate. */
static bool is_made(const selecting *g, size_t k)
{
    const size_t from = g->choice->column[k];
    double rest = 0.0, whole = 0.0;
    for (size_t c = from; c < from + g->choice->list->candidate[k].count; ++c) {
        rest += g->sweep->a[c * g->sweep->n + c];
        whole += g->sweep->diagonal[c];
    }
    return rest < ALIKE * whole;
}

/* ---- few in place of many that imitate them ---- */

enum { LEAST_MANY = 3, MOST_ALIKE = 24, MOST_COLUMNS = 2 * MOST_ALIKE };

/* A problem of few candidates, cut out of a larger one. */
typedef struct {
    size_t from[MOST_ALIKE], column[MOST_ALIKE];
    hci_candidate item[MOST_ALIKE];
    hci_candidates list;
    hci_selection choice;
    hci_sweep base, sweep;
    double base_number[MOST_COLUMNS * (MOST_COLUMNS + 2)], sweep_number[MOST_COLUMNS * (MOST_COLUMNS + 2)];
    bool base_in[MOST_COLUMNS], sweep_in[MOST_COLUMNS], in[MOST_ALIKE], best[MOST_ALIKE];
    size_t columns;
} part;

static hci_sweep sweep_at(double *number, bool *in, size_t n)
{
    return (hci_sweep){n, number, number + n * n, number + n * n + n, in, 0.0};
}

static void part_add(part *p, const selecting *g, size_t k)
{
    const hci_candidate *x = &g->choice->list->candidate[k];
    const size_t at = p->list.count;
    if (at == MOST_ALIKE || p->columns + x->count > MOST_COLUMNS) return;
    p->from[at] = k;
    p->column[at] = p->columns;
    p->item[at] = *x;
    p->columns += x->count;
    ++p->list.count;
}

/* Column c of a part in the whole. */
static size_t column_of(const part *p, const selecting *g, size_t c)
{
    size_t k = p->list.count - 1;
    while (p->column[k] > c)
        --k;
    return g->choice->column[p->from[k]] + c - p->column[k];
}

/* What is left of these columns where the model is in: no pivot among them touches others. */
static void part_fill(part *p, const selecting *g)
{
    const hci_sweep *whole = g->choice->base;
    p->base = sweep_at(p->base_number, p->base_in, p->columns);
    p->sweep = sweep_at(p->sweep_number, p->sweep_in, p->columns);
    p->base.square = whole->square;
    for (size_t i = 0; i < p->columns; ++i) {
        const size_t row = column_of(p, g, i);
        for (size_t j = 0; j < p->columns; ++j)
            p->base.a[i * p->columns + j] = whole->a[row * whole->n + column_of(p, g, j)];
        p->base.b[i] = whole->b[row];
        p->base.diagonal[i] = whole->diagonal[row];
        p->base_in[i] = false;
    }
    p->choice = (hci_selection){&p->list, p->column, &p->base, g->choice->rows};
}

/* Those that are in, and, the lowest orders first, those that they make nearly all of. */
static void part_make(part *p, const selecting *g)
{
    p->list = (hci_candidates){p->item, 0, g->choice->list->reference_current_A};
    p->columns = 0;
    for (int alike = 0; alike < 2; ++alike)
        for (size_t k = 0; k < g->choice->list->count; ++k)
            if (alike ? is_open(g, k) && is_made(g, k) : g->in[k]) part_add(p, g, k);
    part_fill(p, g);
}

/* Terms of those that are chosen. */
static size_t terms_of(const hci_candidates *list, const bool *in)
{
    size_t terms = 0;
    for (size_t k = 0; k < list->count; ++k)
        terms += in[k] ? list->candidate[k].count : 0;
    return terms;
}

/* What begins with each two of them; the best in p->best. Returns the fall of the score of that. */
static double pairs_try(part *p, const selecting *g)
{
    selecting h = {&p->choice, g->a, g->b, &p->sweep, p->in, 0.0};
    double most = -INFINITY;
    for (size_t i = 0; i < p->list.count; ++i)
        for (size_t j = 0; j < i; ++j) {
            start(&h, p->in);
            if (!take(&h, i) || !take(&h, j)) continue;
            leave_superfluous(&h);
            const double fall = select_terms(&h);
            if (!(fall > most)) continue;
            most = fall;
            memcpy(p->best, p->in, sizeof p->best);
        }
    return most;
}

/* Orders that came in one by one may be many that together imitate a few, where currents of one shape make
 * much the same of all. As many others in their place are no fewer. Returns the fall of the score. */
static double imitators_replace(selecting *g, double fall)
{
    part p;
    size_t count = 0;
    for (size_t k = 0; k < g->choice->list->count; ++k)
        count += g->in[k];
    if (count < LEAST_MANY) return fall;
    part_make(&p, g);
    if (p.list.count < count + 1) return fall;
    const double few = pairs_try(&p, g);
    if (!(few > fall + HCI_AS_GOOD) || terms_of(&p.list, p.best) >= terms_of(g->choice->list, g->in))
        return fall;
    memset(g->in, 0, g->choice->list->count * sizeof *g->in);
    for (size_t k = 0; k < p.list.count; ++k)
        g->in[p.from[k]] = p.best[k];
    return few;
}

/* The mean torque of an iron that saturates takes several powers of the currents at once, none of which is
 * lowers the score much alone: all of them first. */
static bool seed_powers(selecting *g)
{
    bool any = false;
    for (size_t k = 0; k < g->choice->list->count; ++k) {
        const hci_candidate *x = &g->choice->list->candidate[k];
        if (x->type->is_series && x->term[0].order == 0.0 && is_open(g, k)) any = take(g, k) || any;
    }
    if (any) leave_superfluous(g);
    return any;
}

double hci_group_select(const hci_selection *choice, const hci_effect_type *a, const hci_effect_type *b,
                        bool *in, hci_sweep *sweep, bool *spare)
{
    selecting g = {choice, a, b, sweep, NULL, 0.0};
    start(&g, in);
    double plain = select_terms(&g);
    if (a == b && !a->is_series) plain = imitators_replace(&g, plain);
    start(&g, spare);
    if (!seed_powers(&g)) return plain;
    const double seeded = select_terms(&g);
    if (seeded <= plain + fmax(SEED_MARGIN, SEED_SHARE * plain)) return plain;
    memcpy(in, spare, choice->list->count * sizeof *in);
    return seeded;
}
