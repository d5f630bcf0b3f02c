/* Weighs every reading by what the relations say of it, and names the slips of the probable ones. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/check/interpretation.h"

/* A relation is met up to so many standard deviations. */
#define MET 2.5

/* What a reading is to have mended is met as well as this. */
#define MENDED 1.5

/* A relation that is not met is nearer when less than this of its deviation is left. */
#define NEARER 0.5

/* A slip leaves a trace where it changes what a relation costs by as much, in nats. */
#define TRACE 1.0

/* Tables and recordings of one bench are likely to have one zero of the angle. */
#define SAME_ZERO 0.3

enum { MOST_SLIPS = 3 };

typedef struct {
    int choice[MOST_SLIPS]; /* indices, ascending; −1: none */
    double weight;          /* ln of prior × likelihood, then the probability */
} reading;

typedef struct {
    const check_figures *figures;
    bool used[HCI_CHECK_MOST_EVIDENCE]; /* of each relation */
    reading *list;
    size_t count, room;
    hci_status status;
} weighing;

/* ---- one reading */

static check_view view_of(const reading *r)
{
    check_view view = hci_check_view_declared();
    for (int k = 0; k < MOST_SLIPS; ++k)
        if (r->choice[k] >= 0) hci_check_view_take(&view, &HCI_CHECK_CHOICES[r->choice[k]]);
    return view;
}

static check_value relation_value(const check_figures *f, const check_relation *relation,
                                  const check_view *view)
{
    const check_model model = hci_check_model_of(f, view);
    return relation->of(f, view, &model);
}

static double log_likelihood(const weighing *w, const check_view *view)
{
    const check_model model = hci_check_model_of(w->figures, view);
    double sum = 0.0;
    for (size_t k = 0; k < HCI_CHECK_RELATION_COUNT; ++k)
        if (w->used[k])
            sum -=
                hci_check_loss(&HCI_CHECK_RELATIONS[k], HCI_CHECK_RELATIONS[k].of(w->figures, view, &model));
    return sum;
}

static double log_prior(const weighing *w, const reading *r, const check_view *view)
{
    double sum = 0.0;
    bool same_zero = fabs(view->zero_rad) > 0.0;
    same_zero = same_zero && fabs(view->zero_rad - view->run_zero_rad) < 1e-9;
    for (int k = 0; k < MOST_SLIPS; ++k) {
        if (r->choice[k] < 0) continue;
        const check_choice *c = &HCI_CHECK_CHOICES[r->choice[k]];
        const bool follows = same_zero && c->field == offsetof(check_view, run_zero_rad);
        sum += log(follows ? SAME_ZERO : hci_check_choice_prior(c, w->figures));
    }
    return sum;
}

static void weigh(weighing *w, int first, int second, int third)
{
    reading r = {{first, second, third}, 0.0};
    if (w->status) return;
    if (w->count == w->room) {
        const size_t room = 2 * w->room + 64;
        reading *list = hci_memory_resize(w->list, room, sizeof *list);
        if (!list) {
            w->status = HCI_ERROR_MEMORY;
            return;
        }
        w->list = list;
        w->room = room;
    }
    const check_view view = view_of(&r);
    r.weight = log_prior(w, &r, &view) + log_likelihood(w, &view);
    w->list[w->count++] = r;
}

/* ---- all of them */

static bool may_join(const weighing *w, size_t a, size_t b)
{
    return HCI_CHECK_CHOICES[a].aspect != HCI_CHECK_CHOICES[b].aspect &&
           hci_check_choice_applies(&HCI_CHECK_CHOICES[b], w->figures);
}

static void weigh_all(weighing *w)
{
    weigh(w, -1, -1, -1);
    for (size_t a = 0; a < HCI_CHECK_CHOICE_COUNT; ++a) {
        if (!hci_check_choice_applies(&HCI_CHECK_CHOICES[a], w->figures)) continue;
        weigh(w, (int)a, -1, -1);
        for (size_t b = a + 1; b < HCI_CHECK_CHOICE_COUNT; ++b) {
            if (!may_join(w, a, b)) continue;
            weigh(w, (int)a, (int)b, -1);
            for (size_t c = b + 1; c < HCI_CHECK_CHOICE_COUNT; ++c)
                if (may_join(w, a, c) && may_join(w, b, c)) weigh(w, (int)a, (int)b, (int)c);
        }
    }
}

/* Probabilities; returns the best reading. */
static const reading *normalise(weighing *w)
{
    size_t best = 0;
    double sum = 0.0;
    for (size_t k = 1; k < w->count; ++k)
        if (w->list[k].weight > w->list[best].weight) best = k;
    const double top = w->list[best].weight;
    for (size_t k = 0; k < w->count; ++k) {
        w->list[k].weight = exp(w->list[k].weight - top);
        sum += w->list[k].weight;
    }
    for (size_t k = 0; k < w->count; ++k)
        w->list[k].weight /= sum;
    return &w->list[best];
}

/* ---- slips */

static bool has_slip(const reading *r, const char *slip)
{
    for (int k = 0; k < MOST_SLIPS; ++k)
        if (r->choice[k] >= 0 && strcmp(HCI_CHECK_CHOICES[r->choice[k]].slip, slip) == 0) return true;
    return false;
}

/* Of the readings that have `slip`, and have `other` (NULL: whatever) or not. */
static double probability(const weighing *w, const char *slip, const char *other, bool with_other)
{
    double sum = 0.0;
    for (size_t k = 0; k < w->count; ++k)
        if (has_slip(&w->list[k], slip) && (!other || has_slip(&w->list[k], other) == with_other))
            sum += w->list[k].weight;
    return sum;
}

/* The most probable reading with a slip, and the choice in it that has it. */
static const reading *best_with(const weighing *w, const char *slip, const check_choice **choice)
{
    const reading *best = NULL;
    for (size_t k = 0; k < w->count; ++k)
        if (has_slip(&w->list[k], slip) && (!best || w->list[k].weight > best->weight)) best = &w->list[k];
    for (int k = 0; best && k < MOST_SLIPS; ++k)
        if (best->choice[k] >= 0 && strcmp(HCI_CHECK_CHOICES[best->choice[k]].slip, slip) == 0)
            *choice = &HCI_CHECK_CHOICES[best->choice[k]];
    return best;
}

static bool is_first_row(size_t k)
{
    for (size_t j = 0; j < k; ++j)
        if (strcmp(HCI_CHECK_CHOICES[j].slip, HCI_CHECK_CHOICES[k].slip) == 0) return false;
    return true;
}

/* What takes this slip's place in the readings without it: at least a tenth as probable, and seldom beside
 * it. */
static void add_alternatives(const weighing *w, hci_check_finding *finding)
{
    for (size_t k = 0; k < HCI_CHECK_CHOICE_COUNT && finding->alternatives < HCI_CHECK_MOST_ALTERNATIVES;
         ++k) {
        const char *other = HCI_CHECK_CHOICES[k].slip;
        if (!is_first_row(k) || strcmp(other, finding->slip) == 0) continue;
        const double alone = probability(w, other, finding->slip, false);
        const double beside = probability(w, other, finding->slip, true);
        if (alone > 0.1 * finding->probability && beside < 0.5 * alone)
            finding->alternative[finding->alternatives++] = other;
    }
}

static void add_finding(const weighing *w, const char *slip, hci_check *check)
{
    hci_check_finding finding = {.probability = probability(w, slip, NULL, false)};
    const check_choice *choice = NULL;
    size_t at = check->findings;
    if (finding.probability < HCI_CHECK_POSSIBLE || at == HCI_CHECK_MOST_FINDINGS) return;
    const reading *best = best_with(w, slip, &choice);
    const check_view view = view_of(best);
    hci_check_choice_locate(choice, w->figures, &view, &finding);
    add_alternatives(w, &finding);
    for (; at > 0 && check->finding[at - 1].probability < finding.probability; --at)
        check->finding[at] = check->finding[at - 1];
    check->finding[at] = finding;
    ++check->findings;
}

/* ---- evidence */

static hci_check_state state_of(double declared, double as_read)
{
    if (declared <= MET) return as_read <= MET ? HCI_CHECK_AGREES : HCI_CHECK_WORSE;
    if (as_read <= MENDED) return HCI_CHECK_MENDED;
    return as_read < fmax(MET, NEARER * declared) ? HCI_CHECK_BETTER : HCI_CHECK_UNMENDED;
}

static bool is_used(const weighing *w, const char *relation)
{
    for (size_t k = 0; k < HCI_CHECK_RELATION_COUNT; ++k)
        if (w->used[k] && strcmp(HCI_CHECK_RELATIONS[k].name, relation) == 0) return true;
    return false;
}

static bool possible_mends(const weighing *w, const hci_check *check, const check_relation *r)
{
    const check_choice *choice;
    for (size_t k = 0; k < check->findings; ++k) {
        const check_view view = view_of(best_with(w, check->finding[k].slip, &choice));
        if (hci_check_deviation(r, relation_value(w->figures, r, &view)) <= MET) return true;
    }
    return false;
}

static void add_evidence(const weighing *w, const reading *best, hci_check *check)
{
    const check_view declared = hci_check_view_declared(), view = view_of(best);
    for (size_t k = 0; k < HCI_CHECK_RELATION_COUNT; ++k) {
        const check_relation *r = &HCI_CHECK_RELATIONS[k];
        const check_value before = relation_value(w->figures, r, &declared);
        if (!w->used[k] && is_used(w, r->instead)) continue;
        if (!w->used[k]) {
            check->gap[check->gaps++] = (hci_check_gap){r->name, r->words, r->needs};
            continue;
        }
        const check_value after = relation_value(w->figures, r, &view);
        hci_check_evidence *e = &check->evidence[check->evidences++];
        *e = (hci_check_evidence){r->name,
                                  r->words,
                                  before.found,
                                  r->expected,
                                  r->kind == CHECK_MOST,
                                  after.found,
                                  r->tolerance * after.spread,
                                  state_of(hci_check_deviation(r, before), hci_check_deviation(r, after))};
        if (e->state == HCI_CHECK_UNMENDED && possible_mends(w, check, r)) e->state = HCI_CHECK_MENDABLE;
    }
}

/* ---- what leaves no trace */

/* The reading with one slip more, or with it in the place of the one about the same thing. */
static check_view view_with(const reading *r, size_t choice)
{
    check_view view = hci_check_view_declared();
    for (int k = 0; k < MOST_SLIPS; ++k)
        if (r->choice[k] >= 0 && HCI_CHECK_CHOICES[r->choice[k]].aspect != HCI_CHECK_CHOICES[choice].aspect)
            hci_check_view_take(&view, &HCI_CHECK_CHOICES[r->choice[k]]);
    hci_check_view_take(&view, &HCI_CHECK_CHOICES[choice]);
    return view;
}

static bool leaves_a_trace(const weighing *w, const reading *in, size_t choice)
{
    const check_view before = view_of(in), after = view_with(in, choice);
    for (size_t k = 0; k < HCI_CHECK_RELATION_COUNT; ++k) {
        const check_relation *r = &HCI_CHECK_RELATIONS[k];
        if (w->used[k] && fabs(hci_check_loss(r, relation_value(w->figures, r, &after)) -
                               hci_check_loss(r, relation_value(w->figures, r, &before))) > TRACE)
            return true;
    }
    return false;
}

/* A slip that can stand in these files, and in none of its forms changes anything, neither in the files as
 * declared nor in the best reading. */
static bool is_untold(const weighing *w, const reading *best, const char *slip)
{
    bool applies = false;
    if (has_slip(best, slip)) return false;
    for (size_t k = 0; k < HCI_CHECK_CHOICE_COUNT; ++k) {
        if (strcmp(HCI_CHECK_CHOICES[k].slip, slip) != 0 ||
            !hci_check_choice_applies(&HCI_CHECK_CHOICES[k], w->figures))
            continue;
        if (leaves_a_trace(w, best, k) || leaves_a_trace(w, &w->list[0], k)) return false;
        applies = true;
    }
    return applies;
}

static void add_untold(const weighing *w, const reading *best, hci_check *check)
{
    for (size_t k = 0; k < HCI_CHECK_CHOICE_COUNT && check->untolds < HCI_CHECK_MOST_UNTOLD; ++k)
        if (is_first_row(k) && is_untold(w, best, HCI_CHECK_CHOICES[k].slip))
            check->untold[check->untolds++] = HCI_CHECK_CHOICES[k].slip;
}

static hci_check_verdict verdict_of(const hci_check *check)
{
    if (check->findings > 0 && check->finding[0].probability >= HCI_CHECK_FOUND) return HCI_CHECK_SLIPS;
    if (check->probability_as_declared < 0.5) return HCI_CHECK_AMBIGUOUS;
    for (size_t k = 0; k < check->evidences; ++k)
        if (check->evidence[k].state == HCI_CHECK_UNMENDED || check->evidence[k].state == HCI_CHECK_MENDABLE)
            return HCI_CHECK_NOT_UNDERSTOOD;
    return HCI_CHECK_CONSISTENT;
}

static void conclude(weighing *w, hci_check *check)
{
    const reading *best = normalise(w);
    check->probability_as_declared = w->list[0].weight;
    for (size_t k = 0; k < HCI_CHECK_CHOICE_COUNT; ++k)
        if (is_first_row(k)) add_finding(w, HCI_CHECK_CHOICES[k].slip, check);
    add_evidence(w, best, check);
    add_untold(w, best, check);
    check->verdict = verdict_of(check);
}

/* Which relations the figures have, as declared: a reading cannot escape from one. */
static void find_used(weighing *w)
{
    const check_view declared = hci_check_view_declared();
    for (size_t k = 0; k < HCI_CHECK_RELATION_COUNT; ++k)
        w->used[k] = !isnan(relation_value(w->figures, &HCI_CHECK_RELATIONS[k], &declared).found);
}

hci_status hci_check_weigh(const check_figures *f, hci_check *check, hci_note *note)
{
    weighing w = {.figures = f};
    find_used(&w);
    weigh_all(&w);
    if (!w.status) conclude(&w, check);
    hci_memory_free(w.list);
    return w.status ? hci_note_set(note, w.status, "out of memory for %zu readings", w.count) : HCI_OK;
}
