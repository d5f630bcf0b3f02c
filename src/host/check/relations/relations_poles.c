/* Slots and poles from what repeats in a mechanical turn. A stator with S slots and a rotor with p pole pairs
 * make a cogging torque of orders lcm(S, 2p); magnets that are not alike add orders of S, teeth that are not
 * alike orders of 2p, and errors of the current sensors, where the current balances the torque, orders of p.
 * Low multiples of each are likely, high ones are not. */
#include <math.h>

#include "hci/host/machine/init.h"
#include "host/check/relations/pole_pairs.h"
#include "host/check/relations/relations.h"

enum { MOST_SLOTS = 108, MOST_GRADE = 12 };

/* Share of the lines of each family, and what may be at any order. */
#define OF_COGGING 0.4
#define OF_SLOTS   0.2
#define OF_POLES   0.2
#define OF_PAIRS   0.1
#define OF_NONE    0.1

/* No three equal phases can be wound. */
#define UNBALANCED 8.0

/* What a stator costs that is not declared: one of so many. */
#define STATORS 20.0

/* The h-th multiple has 6/(π h)² of its family. */
static double member(int line, int base, double share)
{
    const int h = line / base;
    return line % base == 0 && h <= MOST_GRADE ? share * 6.0 / (HCI_PI * HCI_PI * h * h) : 0.0;
}

/* ln of the likelihood of the lines. */
static double of_layout(const check_run *r, int slots, int pairs)
{
    const int cogging = hci_cogging_order(slots, pairs) * pairs;
    double sum = hci_has_equal_phases(slots, pairs) ? 0.0 : -UNBALANCED;
    for (int k = 0; k < r->lines; ++k)
        sum += log(member(r->line[k], cogging, OF_COGGING) + member(r->line[k], slots, OF_SLOTS) +
                   member(r->line[k], 2 * pairs, OF_POLES) + member(r->line[k], pairs, OF_PAIRS) +
                   OF_NONE / CHECK_MOST_ORDER);
    return sum;
}

static double of_pairs(const check_run *r, double slots, int pairs)
{
    double best = -HUGE_VAL;
    if (slots >= 3.0) return of_layout(r, (int)slots, pairs);
    for (int s = 3; s <= MOST_SLOTS; s += 3)
        if (hci_has_equal_phases(s, pairs)) best = fmax(best, of_layout(r, s, pairs));
    return best - log(STATORS);
}

/* The longest without load. */
static check_run *run_of(const check_data *data)
{
    check_run *best = NULL;
    for (size_t k = 0; k < data->runs; ++k) {
        check_run *r = &data->run[k];
        const bool is_free =
            r->is_held || r->turns_steadily || (r->has_torque && !hci_check_has_current(data, r));
        if (is_free && r->theta && !r->is_electrical && (!best || r->count > best->count)) best = r;
    }
    return best;
}

bool hci_check_pole_pairs_of_ripple(check_data *data)
{
    check_run *r = run_of(data);
    double most = -HUGE_VAL;
    data->pole_pairs_of_ripple = 0;
    if (!r) return true;
    if (!hci_check_run_orders(r)) return false;
    for (int pairs = 1; r->lines > 1 && pairs <= CHECK_MOST_PAIRS; ++pairs) {
        const double x = of_pairs(r, data->value[CHECK_slots], pairs);
        if (x > most) data->pole_pairs_of_ripple = pairs;
        most = fmax(most, x);
    }
    return true;
}

/* In standard deviations: z²/2 is what the likelihood of the lines has less than with the best pole pairs. */
static check_value ripple_orders(const check_data *data, const check_interpretation *as, const check_model *m)
{
    const check_run *r = run_of(data);
    const double pairs = m->pole_pairs, slots = data->value[CHECK_slots];
    (void)as;
    if (!r || data->pole_pairs_of_ripple == 0) return HCI_CHECK_NONE;
    if (!(pairs >= 1.0) || pairs > CHECK_MOST_PAIRS) return hci_check_found(0.0);
    const double less = of_pairs(r, slots, data->pole_pairs_of_ripple) - of_pairs(r, slots, (int)pairs);
    return hci_check_found(sqrt(2.0 * fmax(0.0, less)));
}

/* ---- the list */

static const check_relation LIST[] = {
    {"ripple_orders", "orders per turn of the ripple without load against slots and poles, deviation",
     CHECK_SHARE, 0.0, 1.0, 12.0, ripple_orders,
     "a turn of torque, or of holding current, over the mechanical angle", ""},
};
const check_relation_list HCI_CHECK_POLE_RELATIONS = {LIST, sizeof LIST / sizeof *LIST};
