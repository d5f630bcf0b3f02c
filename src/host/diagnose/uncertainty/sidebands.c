#include "host/diagnose/uncertainty/sidebands.h"

#include <math.h>

#define OF_CURRENT 1.5 /* torque of a back-EMF with the currents of three phases */
#define OF_COGGING 2.0 /* times the share by which the flux varies: it goes with its square */
#define MOST_SHARE 0.2 /* more is not a modulation */

enum { MOST_FRACTIONS = 4, SIDES = 2 };

/* Fractions of the electrical order that were found, and by which share all varies there. */
typedef struct {
    double order[MOST_FRACTIONS], share[MOST_FRACTIONS];
    size_t count;
} fractions;

typedef struct {
    hci_candidates *model;
    const hci_effect_type *type;
    hci_note *note;
    hci_status status;
} builder;

/* Whether a type is of what repeats with the mechanical turn alone, with orders of any phase. */
static bool is_of_turn(const hci_effect_type *type)
{
    return type->in_machine && type->any_phase && (type->needs & HCI_EFFECT_NEEDS_TURN) != 0;
}

static bool is_with_current(const hci_effect_type *type, size_t parameter)
{
    return (type->parameter[parameter].traits & HCI_PARAMETER_WITH_CURRENT) != 0;
}

/* ---- what was found ---- */

static double largest_emf(const hci_machine *machine)
{
    double most = 0.0;
    for (size_t k = 0; k < machine->back_emf_count; ++k)
        most = fmax(most, hypot(machine->back_emf[k].sine, machine->back_emf[k].cosine));
    return most;
}

static double largest_cogging(const hci_machine *machine)
{
    double most = 0.0;
    for (size_t k = 0; k < machine->cogging_count; ++k)
        most = fmax(most, hypot(machine->cogging[k].sine, machine->cogging[k].cosine));
    return most;
}

static void fraction_add(double order, double share, fractions *f)
{
    size_t at = 0;
    while (at < f->count && fabs(f->order[at] - order) > HCI_ORDER_TOLERANCE)
        ++at;
    if (at == MOST_FRACTIONS) return;
    if (at == f->count) {
        f->order[f->count] = order;
        f->share[f->count++] = 0.0;
    }
    f->share[at] = fmin(MOST_SHARE, fmax(f->share[at], share));
}

static void fractions_of(const hci_machine *machine, const hci_candidates *model, fractions *f)
{
    const double emf = OF_CURRENT * largest_emf(machine), cogging = OF_COGGING * largest_cogging(machine);
    f->count = 0;
    for (size_t k = 0; k < model->count; ++k) {
        const hci_candidate *x = &model->candidate[k];
        if (!x->in || !is_of_turn(x->type)) continue;
        for (size_t j = 0; j < x->count; ++j) {
            const hci_effect_term *t = &x->term[j];
            const double of = is_with_current(x->type, t->parameter) ? emf : cogging;
            const double order = fabs(t->order - nearbyint(t->order));
            if (order > HCI_ORDER_TOLERANCE && of > 0.0) fraction_add(order, fabs(t->value) / of, f);
        }
    }
}

/* ---- what comes with it ---- */

/* Sine and cosine of one order, of one component of the currents or of none. */
static void pair_add(builder *b, size_t parameter, double order, double expected)
{
    hci_candidate x = {.type = b->type, .count = 2, .deviation = expected, .in = true};
    if (b->status || !(order > HCI_ORDER_TOLERANCE) || !(expected > 0.0)) return;
    for (size_t j = 0; j < 2; ++j)
        x.term[j] = (hci_effect_term){parameter + j, order, 0.0, NAN};
    if (!hci_candidates_find_in(b->model, &x)) b->status = hci_candidates_add(b->model, &x, b->note);
}

/* On both sides of an order, all parameters that act with a current or all that do not. */
static void sides_add(builder *b, double order, double fraction, bool with_current, double expected)
{
    for (size_t p = 0; p + 1 < b->type->parameter_count; p += 2)
        for (int side = -1; side < SIDES; side += 2)
            if (is_with_current(b->type, p) == with_current)
                pair_add(b, p, fabs(order + side * fraction), expected);
}

static void fraction_expect(builder *b, const hci_machine *machine, double fraction, double share)
{
    for (size_t k = 0; k < machine->cogging_count; ++k) {
        const hci_harmonic *c = &machine->cogging[k];
        sides_add(b, c->order, fraction, false, OF_COGGING * share * hypot(c->sine, c->cosine));
    }
    for (size_t k = 0; k < machine->back_emf_count; ++k) {
        const hci_wave *e = &machine->back_emf[k];
        const double expected = OF_CURRENT * share * hypot(e->sine, e->cosine);
        sides_add(b, e->order - 1.0, fraction, true, expected);
        sides_add(b, e->order + 1.0, fraction, true, expected);
    }
}

hci_status hci_sidebands_add(const hci_machine *machine, hci_candidates *model, hci_note *note)
{
    builder b = {model, NULL, note, HCI_OK};
    fractions found;
    fractions_of(machine, model, &found);
    for (size_t r = 0; (b.type = hci_effect_type_at(r)) != NULL && !b.status; ++r)
        for (size_t k = 0; k < found.count && is_of_turn(b.type); ++k)
            fraction_expect(&b, machine, found.order[k], found.share[k]);
    return b.status;
}
