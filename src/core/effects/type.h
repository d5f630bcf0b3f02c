/* The registry of effect types, and what several of them share. */
#ifndef HCI_SRC_CORE_EFFECTS_TYPE_H
#define HCI_SRC_CORE_EFFECTS_TYPE_H

#include <float.h>
#include <math.h>

#include "core/math/phases.h"
#include "core/math/turning.h"
#include "hci/effects/effect.h"

/* One line for each. The order is that in which the bench's effects act on the way from the truth to the
 * reading. */
#define HCI_EFFECT_TYPES(X)                                                                                  \
    X(cogging)                                                                                               \
    X(back_emf)                                                                                              \
    X(phase_imbalance)                                                                                       \
    X(reluctance)                                                                                            \
    X(saturation)                                                                                            \
    X(magnet_temperature)                                                                                    \
    X(mechanical_order)                                                                                      \
    X(unequal_magnets)                                                                                       \
    X(friction)                                                                                              \
    X(stribeck_friction)                                                                                     \
    X(iron_drag)                                                                                             \
    X(rotor_inertia)                                                                                         \
    X(channel_delay)                                                                                         \
    X(current_filter)                                                                                        \
    X(position_load)                                                                                         \
    X(position_eccentricity)                                                                                 \
    X(position_harmonics)                                                                                    \
    X(position_offset)                                                                                       \
    X(current_gain)                                                                                          \
    X(current_offset)                                                                                        \
    X(torque_gain)                                                                                           \
    X(torque_sensor)                                                                                         \
    X(torque_drift)

#define HCI_EFFECT_DECLARE(name) extern const hci_effect_type hci_effect_##name;
HCI_EFFECT_TYPES(HCI_EFFECT_DECLARE)
#undef HCI_EFFECT_DECLARE

/* Parameters: one value; one for each order from the least on; one for each whole order. */
#define HCI_PLAIN(name, unit, meaning, standard, least, traits)                                              \
    {                                                                                                        \
        name, unit, meaning, standard, least, false, false, 0.0, traits                                      \
    }
#define HCI_ORDERED(name, unit, meaning, least_order, traits)                                                \
    {                                                                                                        \
        name, unit, meaning, 0.0, -DBL_MAX, true, false, least_order, traits                                 \
    }
#define HCI_WHOLE(name, unit, meaning, least_order, traits)                                                  \
    {                                                                                                        \
        name, unit, meaning, 0.0, -DBL_MAX, true, true, least_order, traits                                  \
    }

/* Members of hci_effect_type. */
#define HCI_EFFECT_PARAMETERS(table) .parameter = (table), .parameter_count = sizeof(table) / sizeof *(table)

/* Periods in a mechanical turn of an electrical order, a whole number where it is near one: a file says
 * 0.142857 and means 1/7. */
static inline double hci_effect_periods(double order, int pole_pairs)
{
    const double k = order * pole_pairs, whole = floor(k + 0.5);
    return fabs(k - whole) < HCI_ORDER_TOLERANCE * pole_pairs ? whole : k;
}

/* sin and cos of k θ_m, kept while k stays: terms of one order follow each other. */
static inline void hci_effect_turn_to(hci_turning *turn, double order, int pole_pairs, double theta_m_rad)
{
    hci_turning_to(turn, hci_effect_periods(order, pole_pairs), theta_m_rad);
}

/* sin or cos of k θ_m, and its derivative by θ_m. */
typedef struct {
    double value, slope;
} hci_effect_oscillation;

static inline hci_effect_oscillation hci_effect_oscillate(const hci_turning *turn, bool cosine)
{
    const hci_effect_oscillation x = {cosine ? turn->c : turn->s,
                                      cosine ? -turn->k * turn->s : turn->k * turn->c};
    return x;
}

/* Adds weight × e·i, with e of the phases in N·m/A and its slope by θ_m; returns e·i. */
static inline double hci_effect_add_emf(hci_effect_torque *sum, double weight, const double e[3],
                                        const double slope[3], const double i[3])
{
    double torque = 0.0;
    for (int s = 0; s < 3; ++s) {
        torque += e[s] * i[s];
        sum->by_current[s] += weight * e[s];
        sum->by_angle += weight * slope[s] * i[s];
    }
    sum->torque_Nm += weight * torque;
    return torque;
}

/* Proposes a candidate of `count` parameters from one on. */
static inline void hci_effect_propose(const hci_effect_proposals *to, size_t parameter, size_t count,
                                      double order, double alternatives, double expected)
{
    const hci_effect_candidate x = {parameter, count, order, alternatives, expected, 0, NULL};
    to->add(to->context, &x);
}

/* How much smaller a coefficient of the co-energy is expected to be, from one power of the currents to the
 * next above 2 and from one multiple of six to the next; without current, where teeth and slots are all that
 * counts, orders fall more slowly. Half or twice of any of these changes what is left of finite-element
 * machines by a few hundredths of a per cent. */
#define HCI_COENERGY_FADING_POWER 0.35
#define HCI_COENERGY_FADING_ORDER 0.67
#define HCI_COENERGY_FADING_TEETH 0.9

/* One term of the co-energy; unit: its value where the coefficient of W' is 1 N·m. */
static inline void hci_effect_propose_coenergy(const hci_effect_proposals *to, size_t parameter, int power,
                                               double order, double unit)
{
    const double steps = floor((order + 1.0) / 6.0); /* of a back-EMF, the multiple of six beside its order */
    const double of_order = pow(power == 0 ? HCI_COENERGY_FADING_TEETH : HCI_COENERGY_FADING_ORDER, steps);
    const double of_power = pow(HCI_COENERGY_FADING_POWER, power > 2 ? power - 2 : 0);
    const hci_effect_candidate x = {parameter, 1, order, 1.0, fabs(unit) * of_order * of_power, power, NULL};
    to->add(to->context, &x);
}

/* Each of the three phases by itself. */
static inline void hci_effect_propose_phases(const hci_effect_proposals *to, double expected)
{
    for (size_t s = 0; s < 3; ++s)
        hci_effect_propose(to, s, 1, 0.0, 3.0, expected);
}

/* Makes the current of a phase without a sensor minus the sum of the other two. */
static inline void hci_effect_compute_phase(int computed_phase, double i[3])
{
    const int s = computed_phase - 1;
    if (computed_phase > 0) i[s] = -i[(s + 1) % 3] - i[(s + 2) % 3];
}

/* The adjoint: derivatives by three currents to those by the two that are read. */
static inline void hci_effect_compute_phase_adjoint(int computed_phase, double by[3])
{
    const int s = computed_phase - 1;
    if (computed_phase <= 0) return;
    by[(s + 1) % 3] -= by[s];
    by[(s + 2) % 3] -= by[s];
    by[s] = 0.0;
}

static inline void hci_effect_link_add(hci_effect_channel *channel, const hci_effect_link *link)
{
    if (channel->count < HCI_EFFECT_LINKS) channel->link[channel->count] = *link;
    ++channel->count;
}

#endif
