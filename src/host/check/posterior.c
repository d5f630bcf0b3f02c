/* Weighs every reading by what the relations say of it. */
#include <math.h>

#include "host/base/memory.h"
#include "host/check/posterior.h"

/* Tables and recordings of one bench are likely to have one zero of the angle. */
#define SAME_ZERO 0.3

check_view hci_check_view_of(const check_reading *r)
{
    check_view view = hci_check_view_declared();
    for (int k = 0; k < CHECK_MOST_SLIPS; ++k)
        if (r->choice[k] >= 0) hci_check_view_take(&view, &HCI_CHECK_CHOICES[r->choice[k]]);
    return view;
}

check_value hci_check_relation_value(const check_figures *f, const check_relation *relation,
                                     const check_view *view)
{
    const check_model model = hci_check_model_of(f, view);
    return relation->of(f, view, &model);
}

static double log_likelihood(const check_posterior *p, const check_view *view)
{
    const check_model model = hci_check_model_of(p->figures, view);
    double sum = 0.0;
    for (size_t k = 0; k < hci_check_relation_count(); ++k)
        if (p->used[k])
            sum -= hci_check_loss(hci_check_relation(k), hci_check_relation(k)->of(p->figures, view, &model));
    return sum;
}

static double log_prior(const check_posterior *p, const check_reading *r, const check_view *view)
{
    double sum = 0.0;
    bool same_zero = fabs(view->zero_rad) > 0.0;
    same_zero = same_zero && fabs(view->zero_rad - view->run_zero_rad) < 1e-9;
    for (int k = 0; k < CHECK_MOST_SLIPS; ++k) {
        if (r->choice[k] < 0) continue;
        const check_choice *c = &HCI_CHECK_CHOICES[r->choice[k]];
        const bool follows = same_zero && c->field == offsetof(check_view, run_zero_rad);
        sum += log(follows ? SAME_ZERO : hci_check_choice_prior(c, p->figures));
    }
    return sum;
}

/* Room for one more; NULL: out of memory. */
static check_reading *next_of(check_posterior *p)
{
    if (p->count < p->room) return &p->list[p->count++];
    const size_t room = 2 * p->room + 64;
    check_reading *list = hci_memory_resize(p->list, room, sizeof *list);
    if (!list) return NULL;
    p->list = list;
    p->room = room;
    return &p->list[p->count++];
}

static bool weigh(check_posterior *p, int first, int second, int third)
{
    check_reading *r = next_of(p);
    if (!r) return false;
    *r = (check_reading){{first, second, third}, 0.0};
    const check_view view = hci_check_view_of(r);
    r->weight = log_prior(p, r, &view) + log_likelihood(p, &view);
    return true;
}

/* ---- all of them */

static bool may_join(const check_posterior *p, size_t a, size_t b)
{
    return HCI_CHECK_CHOICES[a].aspect != HCI_CHECK_CHOICES[b].aspect &&
           hci_check_choice_applies(&HCI_CHECK_CHOICES[b], p->figures);
}

/* All that have a and b, and one further. */
static bool weigh_triples(check_posterior *p, size_t a, size_t b)
{
    bool good = weigh(p, (int)a, (int)b, -1);
    for (size_t c = b + 1; c < HCI_CHECK_CHOICE_COUNT && good; ++c)
        if (may_join(p, a, c) && may_join(p, b, c)) good = weigh(p, (int)a, (int)b, (int)c);
    return good;
}

static bool weigh_all(check_posterior *p)
{
    bool good = weigh(p, -1, -1, -1);
    for (size_t a = 0; a < HCI_CHECK_CHOICE_COUNT && good; ++a) {
        if (!hci_check_choice_applies(&HCI_CHECK_CHOICES[a], p->figures)) continue;
        good = weigh(p, (int)a, -1, -1);
        for (size_t b = a + 1; b < HCI_CHECK_CHOICE_COUNT && good; ++b)
            if (may_join(p, a, b)) good = weigh_triples(p, a, b);
    }
    return good;
}

/* From logarithms to probabilities. */
static void normalise(check_posterior *p)
{
    double sum = 0.0;
    p->best = 0;
    for (size_t k = 1; k < p->count; ++k)
        if (p->list[k].weight > p->list[p->best].weight) p->best = k;
    const double top = p->list[p->best].weight;
    for (size_t k = 0; k < p->count; ++k) {
        p->list[k].weight = exp(p->list[k].weight - top);
        sum += p->list[k].weight;
    }
    for (size_t k = 0; k < p->count; ++k)
        p->list[k].weight /= sum;
}

/* Which relations the figures have, as declared: a reading cannot escape from one. */
static void find_used(check_posterior *p)
{
    const check_view declared = hci_check_view_declared();
    for (size_t k = 0; k < hci_check_relation_count(); ++k)
        p->used[k] = !isnan(hci_check_relation_value(p->figures, hci_check_relation(k), &declared).found);
}

hci_status hci_check_posterior(const check_figures *f, check_posterior *p, hci_note *note)
{
    p->figures = f;
    find_used(p);
    if (!weigh_all(p))
        return hci_note_set(note, HCI_ERROR_MEMORY, "out of memory for %zu readings", p->count);
    normalise(p);
    return HCI_OK;
}

void hci_check_posterior_release(check_posterior *p)
{
    hci_memory_free(p->list);
}
