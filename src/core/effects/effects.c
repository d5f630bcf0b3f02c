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

static hci_effect_torque declared_torque(const hci_machine *machine, const hci_sample *truth)
{
    const double theta_rad = machine->pole_pairs * truth->theta_m_rad;
    const hci_torque_slopes t = hci_torque_slopes_at(machine, theta_rad, truth->i_abc);
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

hci_sample hci_effects_undo(const hci_effects *effects, int pole_pairs, const hci_sample *reading)
{
    hci_sample x = *reading;
    for (size_t r = TYPE_COUNT; r-- > 0;)
        for (size_t k = effects->count; k-- > 0 && TYPES[r]->undo;)
            if (effects->effect[k].type == TYPES[r]) TYPES[r]->undo(&effects->effect[k], pole_pairs, &x);
    return x;
}

/* Back through the chain from the truth; what each step of `undo` got is what `sense` makes of its result. */
static void add_bench(const hci_effects *effects, int pole_pairs, const hci_sample *truth,
                      hci_effect_torque *by, double *by_value)
{
    hci_sample x = *truth;
    for (size_t r = 0; r < TYPE_COUNT; ++r) {
        for (size_t k = 0; k < effects->count && TYPES[r]->undo_adjoint; ++k) {
            const hci_effect *effect = &effects->effect[k];
            if (effect->type != TYPES[r]) continue;
            TYPES[r]->sense(effect, pole_pairs, &x);
            TYPES[r]->undo_adjoint(effect, pole_pairs, &x, by, by_value + first_term(effects, k));
        }
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
    const hci_sample truth = hci_effects_undo(effects, machine->pole_pairs, reading);
    hci_effect_torque sum = declared_torque(machine, &truth);
    values_clear(effects, by_value);
    add_effects(machine, effects, &truth, IN_MACHINE, IN_FRONT, &sum, by_value);
    if (by_value) add_bench(effects, machine->pole_pairs, &truth, &sum, by_value);
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
