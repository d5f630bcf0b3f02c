/* Names the slips of the probable readings. */
#include <math.h>
#include <string.h>

#include "host/check/conclusions.h"

/* A relation is met up to so many standard deviations. */
#define MET 2.5

/* What a reading is to have mended is met as well as this. */
#define MENDED 1.5

/* A relation that is not met is nearer when less than this of its deviation is left. */
#define NEARER 0.5

/* A slip leaves a trace where it changes what a relation costs by as much, in nats. */
#define TRACE 1.0

static bool has_slip(const check_reading *r, const char *slip)
{
    for (int k = 0; k < CHECK_MOST_SLIPS; ++k)
        if (r->choice[k] >= 0 && strcmp(HCI_CHECK_CHOICES[r->choice[k]].slip, slip) == 0) return true;
    return false;
}

/* Of the readings that have `slip`, and have `other` (NULL: whatever) or not. */
static double probability(const check_posterior *p, const char *slip, const char *other, bool with_other)
{
    double sum = 0.0;
    for (size_t k = 0; k < p->count; ++k)
        if (has_slip(&p->list[k], slip) && (!other || has_slip(&p->list[k], other) == with_other))
            sum += p->list[k].weight;
    return sum;
}

/* The most probable reading with a slip, and the choice in it that has it. */
static const check_reading *best_with(const check_posterior *p, const char *slip, const check_choice **choice)
{
    const check_reading *best = NULL;
    for (size_t k = 0; k < p->count; ++k)
        if (has_slip(&p->list[k], slip) && (!best || p->list[k].weight > best->weight)) best = &p->list[k];
    for (int k = 0; best && k < CHECK_MOST_SLIPS; ++k)
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
static void add_alternatives(const check_posterior *p, hci_check_finding *finding)
{
    for (size_t k = 0; k < HCI_CHECK_CHOICE_COUNT && finding->alternatives < HCI_CHECK_MOST_ALTERNATIVES;
         ++k) {
        const char *other = HCI_CHECK_CHOICES[k].slip;
        if (!is_first_row(k) || strcmp(other, finding->slip) == 0) continue;
        const double alone = probability(p, other, finding->slip, false);
        const double beside = probability(p, other, finding->slip, true);
        if (alone > 0.1 * finding->probability && beside < 0.5 * alone)
            finding->alternative[finding->alternatives++] = other;
    }
}

static void add_finding(const check_posterior *p, const char *slip, hci_check *check)
{
    hci_check_finding finding = {.probability = probability(p, slip, NULL, false)};
    const check_choice *choice = NULL;
    size_t at = check->findings;
    if (finding.probability < HCI_CHECK_POSSIBLE || at == HCI_CHECK_MOST_FINDINGS) return;
    const check_reading *best = best_with(p, slip, &choice);
    const check_view view = hci_check_view_of(best);
    hci_check_choice_locate(choice, p->figures, &view, &finding);
    add_alternatives(p, &finding);
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

static bool is_used(const check_posterior *p, const char *relation)
{
    for (size_t k = 0; k < hci_check_relation_count(); ++k)
        if (p->used[k] && strcmp(hci_check_relation(k)->name, relation) == 0) return true;
    return false;
}

static bool possible_mends(const check_posterior *p, const hci_check *check, const check_relation *r)
{
    const check_choice *choice;
    for (size_t k = 0; k < check->findings; ++k) {
        const check_view view = hci_check_view_of(best_with(p, check->finding[k].slip, &choice));
        if (hci_check_deviation(r, hci_check_relation_value(p->figures, r, &view)) <= MET) return true;
    }
    return false;
}

static void add_evidence(const check_posterior *p, const check_reading *best, hci_check *check)
{
    const check_view declared = hci_check_view_declared(), view = hci_check_view_of(best);
    for (size_t k = 0; k < hci_check_relation_count(); ++k) {
        const check_relation *r = hci_check_relation(k);
        const check_value before = hci_check_relation_value(p->figures, r, &declared);
        if (!p->used[k] && is_used(p, r->instead)) continue;
        if (!p->used[k]) {
            check->gap[check->gaps++] = (hci_check_gap){r->name, r->words, r->needs};
            continue;
        }
        const check_value after = hci_check_relation_value(p->figures, r, &view);
        hci_check_evidence *e = &check->evidence[check->evidences++];
        *e = (hci_check_evidence){r->name,
                                  r->words,
                                  before.found,
                                  r->expected,
                                  r->kind == CHECK_MOST,
                                  after.found,
                                  r->tolerance * after.spread,
                                  state_of(hci_check_deviation(r, before), hci_check_deviation(r, after))};
        if (e->state == HCI_CHECK_UNMENDED && possible_mends(p, check, r)) e->state = HCI_CHECK_MENDABLE;
    }
}

/* ---- what leaves no trace */

/* The reading with one slip more, or with it in the place of the one about the same thing. */
static check_view view_with(const check_reading *r, size_t choice)
{
    check_view view = hci_check_view_declared();
    for (int k = 0; k < CHECK_MOST_SLIPS; ++k)
        if (r->choice[k] >= 0 && HCI_CHECK_CHOICES[r->choice[k]].aspect != HCI_CHECK_CHOICES[choice].aspect)
            hci_check_view_take(&view, &HCI_CHECK_CHOICES[r->choice[k]]);
    hci_check_view_take(&view, &HCI_CHECK_CHOICES[choice]);
    return view;
}

static bool leaves_a_trace(const check_posterior *p, const check_reading *in, size_t choice)
{
    const check_view before = hci_check_view_of(in), after = view_with(in, choice);
    for (size_t k = 0; k < hci_check_relation_count(); ++k) {
        const check_relation *r = hci_check_relation(k);
        if (p->used[k] && fabs(hci_check_loss(r, hci_check_relation_value(p->figures, r, &after)) -
                               hci_check_loss(r, hci_check_relation_value(p->figures, r, &before))) > TRACE)
            return true;
    }
    return false;
}

/* A slip that can stand in these files, and in none of its forms changes anything, neither in the files as
 * declared nor in the best reading. */
static bool is_untold(const check_posterior *p, const check_reading *best, const char *slip)
{
    bool applies = false;
    if (has_slip(best, slip)) return false;
    for (size_t k = 0; k < HCI_CHECK_CHOICE_COUNT; ++k) {
        if (strcmp(HCI_CHECK_CHOICES[k].slip, slip) != 0 ||
            !hci_check_choice_applies(&HCI_CHECK_CHOICES[k], p->figures))
            continue;
        if (leaves_a_trace(p, best, k) || leaves_a_trace(p, &p->list[0], k)) return false;
        applies = true;
    }
    return applies;
}

static void add_untold(const check_posterior *p, const check_reading *best, hci_check *check)
{
    for (size_t k = 0; k < HCI_CHECK_CHOICE_COUNT && check->untolds < HCI_CHECK_MOST_UNTOLD; ++k)
        if (is_first_row(k) && is_untold(p, best, HCI_CHECK_CHOICES[k].slip))
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

void hci_check_conclude(const check_posterior *p, hci_check *check)
{
    const check_reading *best = &p->list[p->best];
    check->probability_as_declared = p->list[0].weight;
    for (size_t k = 0; k < HCI_CHECK_CHOICE_COUNT; ++k)
        if (is_first_row(k)) add_finding(p, HCI_CHECK_CHOICES[k].slip, check);
    add_evidence(p, best, check);
    add_untold(p, best, check);
    check->verdict = verdict_of(check);
}
