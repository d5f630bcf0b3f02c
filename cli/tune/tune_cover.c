#include "cli/tune/tune_cover.h"

#include <math.h>

#include "hci/math/harmonic.h"

#define TOLD          0.48           /* orders for each sample of a turn, as diagnose looks for them */
#define MOST_ORDER    96.0           /* electrical, likewise */
#define LEAST_ARC     0.02           /* electrical turns: a shaft that is held moves as much */
#define WHOLE         0.95           /* of a turn: the last sample stands before the first one */
#define LEAST_ORDER   12.0           /* electrical, that three phases make first but for 6 */
#define SLOT_MULTIPLE 2.0            /* of the order of slots and poles: its first harmonic */
#define GAP_OF_ORDER  (0.8 * HCI_PI) /* by the order: a gap that is wider may hide it, as in waveforms */

double cli_tune_order_of_slots(const cli_tuning *t)
{
    const long slots = lround(t->declared.slots), poles = 2L * t->declared.model.pole_pairs;
    long a = slots, b = poles;
    if (!(t->declared.slots > 0.0) || slots < 1) return 0.0;
    while (b > 0) {
        const long rest = a % b;
        a = b, b = rest;
    }
    return 2.0 * (double)(slots / a);
}

bool cli_tune_has_high_slots(const cli_tuning *t)
{
    return cli_tune_order_of_slots(t) > HCI_USUAL_ORDER + HCI_ORDER_TOLERANCE;
}

/* The share of the mechanical turn that has samples, in parts of it; 1 of more than one turn without a gap.
 * A part is at least twice as wide as samples lie apart. */
static double share_of_turn(const hci_run *r, double samples_a_turn)
{
    enum { PARTS = 24 };
    bool is_seen[PARTS] = {false};
    const size_t parts = (size_t)fmax(1.0, fmin(PARTS, 0.5 * samples_a_turn));
    size_t seen = 0;
    for (size_t k = 0; k < r->count; ++k) {
        const double turn = r->theta_m_rad[k] / (2.0 * HCI_PI);
        bool *at = &is_seen[(size_t)((turn - floor(turn)) * (double)parts) % parts];
        seen += !*at;
        *at = true;
    }
    return (double)seen / (double)parts;
}

/* The largest part of the mechanical turn that no sample of a run is in, whichever way the shaft turned
 * there; a whole turn where the turn is not known. In cells, so that it is at most one of them too large. */
static double gap_rad(const hci_run *r)
{
    enum { CELLS = 16384 };
    bool is_seen[CELLS] = {false};
    size_t empty = 0, most = 0;
    for (size_t k = 0; r->turn_known && r->theta_m_rad && k < r->count; ++k) {
        const double turn = r->theta_m_rad[k] / (2.0 * HCI_PI);
        is_seen[(size_t)((turn - floor(turn)) * CELLS) % CELLS] = true;
    }
    for (size_t k = 0; k < 2 * CELLS; ++k) { /* twice round: a gap may lie across the end */
        empty = is_seen[k % CELLS] ? 0 : empty + 1;
        most = empty > most ? empty : most;
    }
    return most >= CELLS ? 2.0 * HCI_PI : 2.0 * HCI_PI * (double)(most + 1) / CELLS;
}

double cli_tune_widest_gap_rad(const cli_tuning *t)
{
    return GAP_OF_ORDER / (cli_tune_order_of_slots(t) * t->declared.model.pole_pairs);
}

double cli_tune_least_gap_rad(const cli_tuning *t)
{
    double least = 2.0 * HCI_PI;
    for (size_t k = 0; k < t->runs.count; ++k)
        if (t->runs.run[k].torque_source == HCI_TORQUE_HOLDING) least = fmin(least, gap_rad(&t->runs.run[k]));
    return least;
}

cli_tune_cover cli_tune_cover_of(const hci_run *r)
{
    cli_tune_cover x = {0.0, 0.0, 0.0};
    if (!r->theta_m_rad || r->count < 2) return x;
    double least = r->theta_m_rad[0], most = least, path = 0.0;
    for (size_t k = 1; k < r->count; ++k) {
        least = fmin(least, r->theta_m_rad[k]);
        most = fmax(most, r->theta_m_rad[k]);
        path += fabs(r->theta_m_rad[k] - r->theta_m_rad[k - 1]) / (2.0 * HCI_PI);
    }
    x.turns = (most - least) / (2.0 * HCI_PI);
    const double share = share_of_turn(r, (double)r->count / path);
    if (x.turns > share && share < WHOLE) x.turns = share; /* the same part of it again and again */
    if (x.turns * r->pole_pairs < LEAST_ARC || r->torque_source == HCI_TORQUE_NONE) return x;
    x.samples_a_turn = (double)r->count / path;
    x.highest_order = fmin(TOLD * x.samples_a_turn / r->pole_pairs, MOST_ORDER);
    return x;
}

/* Whether the samples of a run are all that tells orders: in time, or at places all round. */
static bool tells_orders(const hci_run *r, const cli_tune_cover *x)
{
    if (r->time_s) return r->torque_source != HCI_TORQUE_NONE || r->v_V;
    return r->torque_source == HCI_TORQUE_MEASURED && r->turn_known && x->turns >= WHOLE;
}

/* Where no samples show it: an order of slots and poles above what measured torques tell looks like a lower
 * one. */
static void set_alias(cli_tuning *t)
{
    const double slots = cli_tune_order_of_slots(t);
    bool is_measured = t->runs.count > 0;
    for (size_t k = 0; k < t->runs.count; ++k)
        is_measured = is_measured && t->runs.run[k].torque_source == HCI_TORQUE_MEASURED;
    if (!is_measured || !(t->highest_order > 0.0) || !(slots > t->highest_order) ||
        cli_tune_has_high_slots(t))
        return;
    t->cogging_reach = t->highest_order;
    t->has_alias = true;
}

void cli_tune_cover_set(cli_tuning *t)
{
    double turns = 0.0, order = 0.0;
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        const cli_tune_cover x = cli_tune_cover_of(r);
        if (!tells_orders(r, &x)) continue;
        turns = fmax(turns, x.turns);
        order = fmax(order, x.highest_order);
    }
    t->turns = turns;
    t->highest_order = order;
    t->tells_no_order =
        turns * t->declared.model.pole_pairs >= LEAST_ARC && turns * t->declared.model.pole_pairs < WHOLE;
    set_alias(t);
}

bool cli_tune_is_short(const cli_tuning *t)
{
    return t->turns * t->declared.model.pole_pairs >= LEAST_ARC && t->turns < WHOLE;
}

bool cli_tune_has_gap(const cli_tuning *t)
{
    return t->has_alias && t->highest_order >= cli_tune_order_of_slots(t);
}

bool cli_tune_is_coarse(const cli_tuning *t)
{
    const double twice = SLOT_MULTIPLE * cli_tune_order_of_slots(t);
    const double wanted = fmax(LEAST_ORDER, cli_tune_has_high_slots(t) ? 0.0 : fmin(twice, MOST_ORDER));
    return t->highest_order > 0.0 && t->highest_order < wanted;
}
