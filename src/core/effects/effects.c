#include "hci/effects/effect.h"

#include "core/effects/type.h"

/* ---- registry ---- */

#define TYPE(name) &hci_effect_##name,
static const hci_effect_type *const TYPES[] = {HCI_EFFECT_TYPES(TYPE)};
#undef TYPE

enum { TYPE_COUNT = sizeof TYPES / sizeof *TYPES };

const hci_effect_type *hci_effect_type_at(size_t k)
{
    return k < TYPE_COUNT ? TYPES[k] : NULL;
}

static bool same_text(const char *a, const char *b)
{
    while (*a != '\0' && *a == *b) {
        ++a;
        ++b;
    }
    return *a == *b;
}

const hci_effect_type *hci_effect_type_find(const char *name)
{
    for (size_t k = 0; k < TYPE_COUNT; ++k)
        if (same_text(TYPES[k]->name, name)) return TYPES[k];
    return NULL;
}

/* Terms of the effects before one. */
static size_t first_term(const hci_effects *effects, size_t at)
{
    size_t sum = 0;
    for (size_t k = 0; k < at; ++k)
        sum += effects->effect[k].count;
    return sum;
}

unsigned hci_effects_needs(const hci_effects *effects)
{
    unsigned needs = 0;
    for (size_t k = 0; k < effects->count; ++k)
        needs |= effects->effect[k].type->needs;
    return needs;
}

size_t hci_effects_terms(const hci_effects *effects)
{
    return first_term(effects, effects->count);
}

/* ---- torque ---- */

/* known: of any angle, or NAN. */
static hci_effect_torque declared_torque(const hci_machine *machine, const hci_sample *truth,
                                         hci_torque_parts *known)
{
    const double theta_rad = machine->pole_pairs * truth->theta_m_rad;
    if (known->theta_rad != theta_rad) hci_torque_parts_at(machine, theta_rad, known);
    const hci_torque_slopes t = hci_torque_slopes_of(known, truth->i_abc);
    return (hci_effect_torque){.torque_Nm = t.torque_Nm,
                               .by_current = {t.by_current[0], t.by_current[1], t.by_current[2]},
                               .by_angle = t.by_angle};
}

/* Adds the torque of one effect; by_value: out, its terms' derivatives, or NULL. */
static void add_effect(const hci_effect *effect, const hci_machine *machine, const hci_sample *truth,
                       hci_effect_torque *sum, double *by_value)
{
    if (effect->type->torque_of_all) {
        effect->type->torque_of_all(effect, machine, truth, sum, by_value);
        return;
    }
    for (size_t k = 0; k < effect->count; ++k) {
        const double by =
            effect->type->torque ? effect->type->torque(effect, &effect->term[k], machine, truth, sum) : 0.0;
        if (by_value) by_value[k] = by;
    }
}

/* Where a torque is added: in the machine, in front of the torque sensor, as a zero of its reading. */
typedef enum { IN_MACHINE, IN_FRONT, IN_READING } place;

static place place_of(const hci_effect_type *type)
{
    if (type->parameter[0].traits & HCI_PARAMETER_OF_TRANSDUCER) return IN_READING;
    return type->in_machine ? IN_MACHINE : IN_FRONT;
}

/* Adds the torque of all types from one place to another; by_value: of the others nothing is changed. */
static void add_effects(const hci_machine *machine, const hci_effects *effects, const hci_sample *truth,
                        place from, place to, hci_effect_torque *sum, double *by_value)
{
    for (size_t j = 0; j < effects->count; ++j) {
        const hci_effect *effect = &effects->effect[j];
        const place at = place_of(effect->type);
        if (at >= from && at <= to && !effect->type->read_torque)
            add_effect(effect, machine, truth, sum, by_value);
        if (by_value) by_value += effect->count;
    }
}

static void values_clear(const hci_effects *effects, double *by_value)
{
    const size_t terms = by_value ? hci_effects_terms(effects) : 0;
    for (size_t k = 0; k < terms; ++k)
        by_value[k] = 0.0;
}

hci_effect_torque hci_effects_torque(const hci_machine *machine, const hci_effects *effects,
                                     const hci_sample *truth, double *by_value)
{
    hci_effect_torque sum = {.torque_Nm = 0.0};
    values_clear(effects, by_value);
    add_effects(machine, effects, truth, IN_MACHINE, IN_MACHINE, &sum, by_value);
    return sum;
}

/* ---- plant ---- */

/* e += ∂T_x/∂i is the motional voltage; its torque e·i is not T_x, and the difference goes into T_cog. */
static void add_to_point(const hci_effect_torque *x, const double i[2], hci_plant_point *point)
{
    double e[2];
    hci_plane_from_abc(x->by_current, e);
    for (int k = 0; k < 2; ++k)
        point->magnetic.e[k] += e[k];
    for (int k = 0; k < 3; ++k)
        point->inductance_H[k] += x->inductance_H[k];
    point->magnetic.cogging_Nm += x->torque_Nm - e[0] * i[0] - e[1] * i[1];
}

void hci_effects_apply(const void *context, const hci_plant_state *state, hci_plant_point *point)
{
    const hci_effects_plant *plant = context;
    hci_sample truth = {0};
    truth.theta_m_rad = state->theta_m_rad;
    truth.speed_rad_per_s = state->speed_rad_per_s;
    truth.temperature_C = plant->temperature_C;
    hci_plane_to_abc(state->i, truth.i_abc);
    const hci_effect_torque x = hci_effects_torque(plant->machine, plant->effects, &truth, NULL);
    add_to_point(&x, state->i, point);
    for (size_t k = 0; k < plant->effects->count; ++k) {
        const hci_effect *effect = &plant->effects->effect[k];
        if (effect->type->drag_Nm) point->shaft_Nm += effect->type->drag_Nm(effect, state);
    }
}

double hci_effects_coulomb_Nm(const hci_effects *effects)
{
    double sum = 0.0;
    for (size_t k = 0; k < effects->count; ++k) {
        const hci_effect *effect = &effects->effect[k];
        if (effect->type->coulomb_Nm) sum += effect->type->coulomb_Nm(effect);
    }
    return sum;
}

/* ---- bench ---- */

hci_sample hci_effects_sense(const hci_effects *effects, int pole_pairs, const hci_sample *truth)
{
    hci_sample x = *truth;
    for (size_t r = 0; r < TYPE_COUNT; ++r)
        for (size_t k = 0; k < effects->count && TYPES[r]->sense; ++k)
            if (effects->effect[k].type == TYPES[r]) TYPES[r]->sense(&effects->effect[k], pole_pairs, &x);
    return x;
}

/* A step from the reading back to the truth. */
typedef struct {
    const hci_effect *effect;
    hci_sample before; /* what `undo` got */
} undo_step;

enum { STEPS_KEPT = 16 /* twice as many as there are types with `undo` */ };

/* The effect of step n; NULL behind the last. The last effect in front of the sensors comes first. */
static const hci_effect *effect_of_step(const hci_effects *effects, size_t n)
{
    for (size_t r = TYPE_COUNT; r-- > 0;)
        for (size_t k = effects->count; k-- > 0 && TYPES[r]->undo;)
            if (effects->effect[k].type == TYPES[r] && n-- == 0) return &effects->effect[k];
    return NULL;
}

/* step: out, [STEPS_KEPT], the first ones, or NULL; count: out, of all steps. */
static hci_sample undo_all(const hci_effects *effects, int pole_pairs, const hci_sample *reading,
                           undo_step *step, size_t *count)
{
    hci_sample x = *reading;
    *count = 0;
    for (size_t r = TYPE_COUNT; r-- > 0;)
        for (size_t k = effects->count; k-- > 0 && TYPES[r]->undo;) {
            const hci_effect *effect = &effects->effect[k];
            if (effect->type != TYPES[r]) continue;
            if (step && *count < STEPS_KEPT) step[*count] = (undo_step){effect, x};
            ++*count;
            TYPES[r]->undo(effect, pole_pairs, &x);
        }
    return x;
}

hci_sample hci_effects_undo(const hci_effects *effects, int pole_pairs, const hci_sample *reading)
{
    size_t count;
    return undo_all(effects, pole_pairs, reading, NULL, &count);
}

hci_sample hci_effects_undo_currents(const hci_effects *effects, int pole_pairs, const hci_sample *reading)
{
    hci_sample x = *reading;
    for (size_t r = TYPE_COUNT; r-- > 0;)
        for (size_t k = effects->count; k-- > 0 && TYPES[r]->undo && !TYPES[r]->keeps_currents;)
            if (effects->effect[k].type == TYPES[r]) TYPES[r]->undo(&effects->effect[k], pole_pairs, &x);
    return x;
}

/* What step n got: it was kept, or is what `sense` makes of its result. */
static undo_step step_back(const hci_effects *effects, int pole_pairs, const undo_step *kept, size_t n,
                           const hci_sample *after)
{
    if (n < STEPS_KEPT) return kept[n];
    undo_step step = {effect_of_step(effects, n), *after};
    step.effect->type->sense(step.effect, pole_pairs, &step.before);
    return step;
}

/* Back through the chain from the truth. */
static void add_bench(const hci_effects *effects, int pole_pairs, const hci_sample *truth,
                      const undo_step *kept, size_t count, hci_effect_torque *by, double *by_value)
{
    hci_sample after = *truth;
    for (size_t n = count; n-- > 0;) {
        const undo_step step = step_back(effects, pole_pairs, kept, n, &after);
        double *own = by_value + first_term(effects, (size_t)(step.effect - effects->effect));
        step.effect->type->undo_adjoint(step.effect, pole_pairs, &step.before, &after, by, own);
        after = step.before;
    }
}

/* What the sensor makes of the torque at once. */
static void read_torques(const hci_effects *effects, hci_effect_torque *sum, double *by_value)
{
    for (size_t k = 0; k < effects->count; ++k) {
        const hci_effect *effect = &effects->effect[k];
        if (effect->type->read_torque)
            effect->type->read_torque(effect, &sum->torque_Nm, by_value, hci_effects_terms(effects),
                                      first_term(effects, k));
    }
}

double hci_effects_predict(const hci_machine *machine, const hci_effects *effects, const hci_sample *reading,
                           double *by_value)
{
    hci_torque_parts unknown = {.theta_rad = NAN};
    return hci_effects_predict_again(machine, effects, reading, &unknown, by_value);
}

double hci_effects_predict_again(const hci_machine *machine, const hci_effects *effects,
                                 const hci_sample *reading, hci_torque_parts *known, double *by_value)
{
    undo_step step[STEPS_KEPT];
    size_t steps;
    const hci_sample truth = undo_all(effects, machine->pole_pairs, reading, by_value ? step : NULL, &steps);
    hci_effect_torque sum = declared_torque(machine, &truth, known);
    values_clear(effects, by_value);
    add_effects(machine, effects, &truth, IN_MACHINE, IN_FRONT, &sum, by_value);
    if (by_value) add_bench(effects, machine->pole_pairs, &truth, step, steps, &sum, by_value);
    read_torques(effects, &sum, by_value);
    add_effects(machine, effects, &truth, IN_READING, IN_READING, &sum, by_value);
    return sum.torque_Nm;
}

void hci_effects_filter(const hci_effects *effects, const double *time_s, size_t n, double *torque_Nm,
                        double *by_value)
{
    const size_t columns = hci_effects_terms(effects);
    for (size_t k = 0; k < effects->count; ++k) {
        const hci_effect *effect = &effects->effect[k];
        const hci_effect_run run = {time_s, n, torque_Nm, by_value, columns, first_term(effects, k)};
        if (effect->type->filter) effect->type->filter(effect, &run);
    }
}
