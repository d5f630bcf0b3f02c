#include "host/diagnose/candidates/slip.h"

#include <math.h>

#define SAME  0.1 /* of the declared torque, that noise and smoothing leave of a difference */
#define OTHER 0.5 /* of it, that is no small error of the angle: that is an effect of its own */

enum { MOST_ORDERS = 16, STEPS = 64 }; /* steps of the angle in a period of the highest order */

/* The declared orders that a model changes: as declared, and with what the model adds. */
typedef struct {
    hci_harmonic declared[MOST_ORDERS], shown[MOST_ORDERS];
    size_t count;
    double highest, square; /* order, and sum of squares of what is declared */
} change;

/* ---- declared and shown ---- */

/* The terms of an order are its sine and its cosine. */
static void order_add(change *c, const hci_harmonic *a, const hci_candidate *x)
{
    const hci_harmonic declared = {a->order, a->sine + x->declared[0], a->cosine + x->declared[1]};
    c->declared[c->count] = declared;
    c->shown[c->count++] = (hci_harmonic){a->order, a->sine + x->term[0].value, a->cosine + x->term[1].value};
    c->highest = fmax(c->highest, a->order);
}

/* A torque of any order and phase, with terms of the co-energy that need no current. */
static bool is_cogging(const hci_effect_type *type)
{
    return type->any_phase && type->propose_coenergy;
}

static const hci_candidate *candidate_at(const hci_candidates *model, double order)
{
    for (size_t k = 0; k < model->count; ++k) {
        const hci_candidate *x = &model->candidate[k];
        if (x->in && is_cogging(x->type) && fabs(x->term[0].order - order) < HCI_ORDER_TOLERANCE) return x;
    }
    return NULL;
}

static double square_of(const hci_harmonic *a)
{
    return a->sine * a->sine + a->cosine * a->cosine;
}

/* Whether the largest declared order is among those that are changed. */
static bool change_find(const hci_machine *machine, const hci_candidates *model, change *c)
{
    double largest = 0.0, changed = 0.0;
    *c = (change){.count = 0};
    for (size_t k = 0; k < machine->cogging_count; ++k) {
        const hci_harmonic *a = &machine->cogging[k];
        const hci_candidate *x = candidate_at(model, a->order);
        largest = fmax(largest, square_of(a));
        if (!x || x->count != 2 || c->count == MOST_ORDERS) continue;
        order_add(c, a, x);
        c->square += square_of(&c->declared[c->count - 1]);
        changed = fmax(changed, square_of(a));
    }
    return c->count > 0 && changed >= largest && largest > 0.0;
}

/* ---- slips ---- */

/* Which way round an angle is counted, by how much it is ahead, and the sign of the torque. */
typedef struct {
    double sign, way, ahead_rad;
} slip;

/* The order as it is read with a slip. */
static hci_harmonic slipped(const hci_harmonic *a, const slip *x)
{
    const double c = cos(a->order * x->ahead_rad), s = sin(a->order * x->ahead_rad);
    const hci_harmonic y = {a->order, x->sign * x->way * (a->sine * c - a->cosine * s),
                            x->sign * (a->sine * s + a->cosine * c)};
    return y;
}

/* Sum of squares of what is shown less what the slip makes of what is declared. */
static double missed(const change *c, const slip *x)
{
    double sum = 0.0;
    for (size_t k = 0; k < c->count; ++k) {
        const hci_harmonic y = slipped(&c->declared[k], x);
        const hci_harmonic left = {0.0, c->shown[k].sine - y.sine, c->shown[k].cosine - y.cosine};
        sum += square_of(&left);
    }
    return sum;
}

static bool is_turned(const change *c)
{
    static const slip NONE = {1.0, 1.0, 0.0};
    const double least = SAME * SAME * c->square, steps = ceil(STEPS * c->highest);
    if (missed(c, &NONE) < OTHER * OTHER * c->square) return false;
    for (int kind = 0; kind < 4; ++kind)
        for (double k = 0.0; k < steps; k += 1.0) {
            const slip x = {kind & 1 ? -1.0 : 1.0, kind & 2 ? -1.0 : 1.0, 2.0 * HCI_PI * k / steps};
            if (missed(c, &x) < least) return true;
        }
    return false;
}

static bool is_gone(const change *c)
{
    double sum = 0.0;
    for (size_t k = 0; k < c->count; ++k)
        sum += square_of(&c->shown[k]);
    return sum < SAME * SAME * c->square;
}

/* ---- other pole pairs ---- */

/* An order with what the machine declares of it, or with what the model makes of it. */
static double amplitude_at(const hci_machine *machine, const hci_candidates *model, double order, bool shown)
{
    const hci_candidate *x = candidate_at(model, order);
    double sine = 0.0, cosine = 0.0;
    for (size_t k = 0; k < machine->cogging_count; ++k) {
        if (!(fabs(machine->cogging[k].order - order) < HCI_ORDER_TOLERANCE)) continue;
        sine += machine->cogging[k].sine, cosine += machine->cogging[k].cosine;
    }
    if (x && x->count == 2) {
        sine += shown ? x->term[0].value : x->declared[0];
        cosine += shown ? x->term[1].value : x->declared[1];
    }
    return hypot(sine, cosine);
}

/* The amplitude that an order has where all declared ones stand at `ratio` times their orders. */
static double scaled_amplitude(const hci_machine *machine, const hci_candidates *model, double order,
                               double ratio)
{
    for (size_t k = 0; k < machine->cogging_count; ++k)
        if (fabs(ratio * machine->cogging[k].order - order) < HCI_ORDER_TOLERANCE)
            return amplitude_at(machine, model, machine->cogging[k].order, false);
    return 0.0;
}

static bool is_scaled_by(const hci_machine *machine, const hci_candidates *model, double ratio)
{
    double left = 0.0, whole = 0.0;
    for (size_t k = 0; k < machine->cogging_count; ++k) {
        const double order = machine->cogging[k].order, there = ratio * order;
        const double declared = amplitude_at(machine, model, order, false);
        whole += declared * declared;
        left += pow(amplitude_at(machine, model, there, true) - declared, 2.0);
        left += pow(
            amplitude_at(machine, model, order, true) - scaled_amplitude(machine, model, order, ratio), 2.0);
    }
    return whole > 0.0 && left < SAME * SAME * whole;
}

static double largest_order(const hci_machine *machine)
{
    double order = 0.0, largest = 0.0;
    for (size_t k = 0; k < machine->cogging_count; ++k) {
        const double square = square_of(&machine->cogging[k]);
        if (!(square > largest)) continue;
        largest = square;
        order = machine->cogging[k].order;
    }
    return order;
}

/* Whether every declared amplitude stands at another order, all in one ratio, and no longer at its own. */
static bool is_scaled(const hci_machine *machine, const hci_candidates *model)
{
    const double order = largest_order(machine);
    for (size_t k = 0; k < model->count && order > 0.0; ++k) {
        const hci_candidate *x = &model->candidate[k];
        if (!x->in || !is_cogging(x->type) || x->count != 2) continue;
        if (fabs(x->term[0].order - order) < HCI_ORDER_TOLERANCE) continue;
        if (is_scaled_by(machine, model, x->term[0].order / order)) return true;
    }
    return false;
}

const char *hci_slip_of_cogging(const hci_machine *machine, const hci_candidates *model, bool held)
{
    change c;
    if (is_scaled(machine, model))
        return held ? "The holding tests show the declared cogging torque with its amplitudes at other "
                      "orders, "
                      "all in one ratio, and nothing at its own, as of other pole pairs"
                    : "The runs without a current show the declared cogging torque with its amplitudes at "
                      "other orders, all in one ratio, and nothing at its own, as of other pole pairs";
    if (!change_find(machine, model, &c)) return NULL;
    if (is_gone(&c))
        return held ? "The holding tests show nothing at the orders of the declared cogging torque, as of "
                      "other "
                      "pole pairs or another motor"
                    : "The runs without a current show nothing at the orders of the declared cogging torque, "
                      "as of other pole pairs or another motor";
    if (is_turned(&c))
        return held ? "The holding tests show the declared cogging torque with another sign, direction or "
                      "zero, and no other one"
                    : "The runs without a current show the declared cogging torque with another sign, "
                      "direction or zero, and no other one";
    return NULL;
}

const char *hci_slip_of_load(void)
{
    return "The runs with a current show the torque of the declared machine with the opposite sign";
}

/* ---- a torque without its sign ---- */

#define BELOW 0.3 /* of all samples, that the machine has below zero at least by more than noise */

const char *hci_slip_of_size(const hci_binned_samples *samples, const hci_run *runs, const bool *use,
                             const double *residual_Nm)
{
    double signed_Nm2 = 0.0, size_Nm2 = 0.0, below = 0.0, count = 0.0;
    for (size_t k = 0; k < samples->segment_count; ++k) {
        const hci_segment *s = &samples->segment[k];
        if (!use[s->run] || runs[s->run].torque_source != HCI_TORQUE_MEASURED) continue;
        for (size_t j = s->first; j < s->first + s->count; ++j, count += 1.0) {
            const double read = samples->sample[j].torque_Nm, made = read - residual_Nm[j];
            if (read < 0.0) return NULL;
            below += made < 0.0;
            signed_Nm2 += residual_Nm[j] * residual_Nm[j];
            size_Nm2 += (read - fabs(made)) * (read - fabs(made));
        }
    }
    return below > BELOW * count && size_Nm2 < SAME * SAME * signed_Nm2
               ? "the torque has no sign: it is never below zero, and the size of what the machine makes (a "
                 "display that shows the amount)"
               : NULL;
}
