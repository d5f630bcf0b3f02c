#include "host/diagnose/search/group_selection.h"

#include <math.h>
#include <string.h>

#include "host/diagnose/fit/fit.h"

#define SEED_MARGIN                                                                                          \
    10.0 /* by how much several powers at once must lower the score more than one by one, and as a share */
#define SEED_SHARE 0.1
#define LEAST_GAIN 2.0  /* least fall of the score for one more order of an effect */
#define LITTLE     1e-3 /* and its least share of what noise is in all samples */
#define TIE        1e-9 /* of a fall, by which two that explain the same differ by rounding: the first is taken */

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
    return g->choice->base->square - g->sweep->square - g->cost;
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

static void start(selecting *g, bool *in)
{
    g->in = in;
    g->cost = 0.0;
    memset(in, 0, g->choice->list->count * sizeof *in);
    hci_sweep_copy(g->sweep, g->choice->base);
}

double hci_group_select(const hci_selection *choice, const hci_effect_type *a, const hci_effect_type *b,
                        bool *in, hci_sweep *sweep, bool *spare)
{
    selecting g = {choice, a, b, sweep, NULL, 0.0};
    start(&g, in);
    const double plain = select_terms(&g);
    start(&g, spare);
    if (!seed_powers(&g)) return plain;
    const double seeded = select_terms(&g);
    if (seeded <= plain + fmax(SEED_MARGIN, SEED_SHARE * plain)) return plain;
    memcpy(in, spare, choice->list->count * sizeof *in);
    return seeded;
}
