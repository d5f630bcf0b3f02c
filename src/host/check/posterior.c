#include "host/check/posterior.h"

#include <assert.h>
#include <math.h>

#include "host/base/memory.h"
#include "host/check/error_place.h"
#include "host/check/relations/relations.h"
#include "host/check/relations/run_zero.h"

/* Tables and recordings of one bench are likely to have one zero of the angle. */
#define SAME_ZERO 0.3

check_interpretation hci_check_interpretation_of(const check_data *data, const check_error_set *set)
{
    check_interpretation as = hci_check_as_declared();
    for (int k = 0; k < CHECK_MOST_ERRORS; ++k)
        if (set->error[k] >= 0) hci_check_error_apply(&as, &HCI_CHECK_ERRORS[set->error[k]]);
    hci_check_take_run_zero(data, &as);
    return as;
}

static bool is_of_flux(size_t k)
{
    return hci_check_relation(k)->kind == CHECK_FLUX;
}

/* What the relations cost if the magnets have this share of the flux in the tables. */
static double loss_of(const check_posterior *p, const check_value *value, double share)
{
    double sum = hci_check_magnets_loss(share);
    for (size_t k = 0; k < hci_check_relation_count() && isfinite(sum); ++k) {
        const check_relation *r = hci_check_relation(k);
        if (p->used[k])
            sum += is_of_flux(k) ? hci_check_loss_beside_magnets(r, value[k], share)
                                 : hci_check_loss(r, value[k]);
    }
    return sum;
}

/* Weak magnets are one cause of several deviations, and count once: of the shares that would mend one of
 * them, and of those between that and 1, the best is taken. */
static double log_likelihood(const check_posterior *p, const check_interpretation *as)
{
    const check_model model = hci_check_model_of(p->data, as);
    check_value value[HCI_CHECK_MOST_EVIDENCE];
    for (size_t k = 0; k < hci_check_relation_count(); ++k)
        if (p->used[k]) value[k] = hci_check_relation(k)->evaluate(p->data, as, &model);
    double least = loss_of(p, value, 1.0);
    for (size_t k = 0; k < hci_check_relation_count(); ++k)
        if (p->used[k] && is_of_flux(k) && value[k].found > 0.0)
            least =
                fmin(least, fmin(loss_of(p, value, value[k].found), loss_of(p, value, sqrt(value[k].found))));
    return -least - hci_check_beside_q_loss(p->data, as);
}

/* A zero that may be anywhere: of all that it could be, what the recordings leave. */
static double share_of_turn(const check_data *data, const check_interpretation *as)
{
    const double error_rad = hypot(hci_check_run_zero(data, as).std_error_rad, CHECK_EMF_ANGLE_TOLERANCE);
    return fmin(1.0, error_rad / sqrt(2.0 * HCI_PI));
}

static double log_prior(const check_posterior *p, const check_error_set *set, const check_interpretation *as)
{
    double sum = as->run_zero_free > 0.0 ? log(share_of_turn(p->data, as)) : 0.0;
    bool same_zero = fabs(as->zero_rad) > 0.0;
    same_zero = same_zero && fabs(as->zero_rad - as->run_zero_rad) < 1e-9;
    for (int k = 0; k < CHECK_MOST_ERRORS; ++k) {
        if (set->error[k] < 0) continue;
        const check_error *c = &HCI_CHECK_ERRORS[set->error[k]];
        const bool follows = same_zero && c->field == offsetof(check_interpretation, run_zero_rad);
        sum += log(follows ? SAME_ZERO : hci_check_error_prior(c, p->data));
    }
    return sum;
}

/* The next of the list; NULL: out of memory. */
static check_error_set *next_of(check_posterior *p)
{
    if (p->count < p->capacity) return &p->list[p->count++];
    const size_t capacity = 2 * p->capacity + 64;
    check_error_set *list = hci_memory_resize(p->list, capacity, sizeof *list);
    if (!list) return NULL;
    p->list = list;
    p->capacity = capacity;
    return &p->list[p->count++];
}

static bool weigh(check_posterior *p, int first, int second, int third)
{
    check_error_set *set = next_of(p);
    if (!set) return false;
    *set = (check_error_set){{first, second, third}, 0.0};
    const check_interpretation as = hci_check_interpretation_of(p->data, set);
    set->probability = log_prior(p, set, &as) + log_likelihood(p, &as);
    return true;
}

/* ---- all of them */

static bool may_join(const check_posterior *p, size_t a, size_t b)
{
    return HCI_CHECK_ERRORS[a].aspect != HCI_CHECK_ERRORS[b].aspect &&
           hci_check_error_applies(&HCI_CHECK_ERRORS[b], p->data);
}

/* Of a seldom unit, less than so probable. */
#define A_SELDOM_UNIT 0.01

/* A number that was converted without need, a seldom unit, two phases that are not b and c: with two further
 * errors it is not looked for. */
static bool is_seldom_third(size_t k)
{
    const check_error *e = &HCI_CHECK_ERRORS[k];
    const bool is_unit = e->aspect == CHECK_OF_TORQUE_UNIT || e->aspect == CHECK_OF_TIME;
    return (e->aspect == CHECK_OF_EMF && e->plus >= CHECK_EMF_TAKEN_PER_KRPM) ||
           (is_unit && e->prior < A_SELDOM_UNIT) ||
           (e->aspect == CHECK_OF_PHASES && e->plus > CHECK_SWAPPED_BC);
}

/* All that have a and b, and one further. */
static bool weigh_triples(check_posterior *p, size_t a, size_t b)
{
    bool good = weigh(p, (int)a, (int)b, -1);
    if (is_seldom_third(a) || is_seldom_third(b)) return good;
    for (size_t c = b + 1; c < HCI_CHECK_ERROR_COUNT && good; ++c)
        if (!is_seldom_third(c) && may_join(p, a, c) && may_join(p, b, c))
            good = weigh(p, (int)a, (int)b, (int)c);
    return good;
}

static bool weigh_all(check_posterior *p)
{
    bool good = weigh(p, -1, -1, -1);
    for (size_t a = 0; a < HCI_CHECK_ERROR_COUNT && good; ++a) {
        if (!hci_check_error_applies(&HCI_CHECK_ERRORS[a], p->data)) continue;
        good = weigh(p, (int)a, -1, -1);
        for (size_t b = a + 1; b < HCI_CHECK_ERROR_COUNT && good; ++b)
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
        if (p->list[k].probability > p->list[p->best].probability) p->best = k;
    const double top = p->list[p->best].probability;
    for (size_t k = 0; k < p->count; ++k) {
        p->list[k].probability = exp(p->list[k].probability - top);
        sum += p->list[k].probability;
    }
    for (size_t k = 0; k < p->count; ++k)
        p->list[k].probability /= sum;
}

/* Which relations the data have, as declared: no interpretation can escape from one. */
static void find_used(check_posterior *p)
{
    const check_interpretation declared = hci_check_as_declared();
    assert(hci_check_relation_count() <= HCI_CHECK_MOST_EVIDENCE);
    for (size_t k = 0; k < hci_check_relation_count(); ++k)
        p->used[k] = !isnan(hci_check_relation_value(p->data, hci_check_relation(k), &declared).found);
}

hci_status hci_check_posterior(const check_data *data, check_posterior *p, hci_note *note)
{
    p->data = data;
    find_used(p);
    if (!weigh_all(p)) return hci_note_memory(note, NULL, "%zu interpretations", p->count);
    normalise(p);
    return HCI_OK;
}

void hci_check_posterior_release(check_posterior *p)
{
    hci_memory_free(p->list);
}
