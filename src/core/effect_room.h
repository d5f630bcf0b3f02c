/* The registry of effects, and what several rooms share. */
#ifndef HCI_CORE_EFFECT_ROOM_H
#define HCI_CORE_EFFECT_ROOM_H

#include <float.h>
#include <math.h>

#include "hci/effect.h"

/* One line a room. The order is that in which the bench's effects act on the way from the truth to the
 * reading. */
#define HCI_EFFECT_ROOMS(X)                                                                                  \
    X(cogging)                                                                                               \
    X(back_emf)                                                                                              \
    X(phase_imbalance)                                                                                       \
    X(reluctance)                                                                                            \
    X(saturation)                                                                                            \
    X(magnet_temperature)                                                                                    \
    X(mechanical_order)                                                                                      \
    X(friction)                                                                                              \
    X(channel_delay)                                                                                         \
    X(position_eccentricity)                                                                                 \
    X(position_offset)                                                                                       \
    X(current_gain)                                                                                          \
    X(current_offset)                                                                                        \
    X(torque_sensor)

#define HCI_EFFECT_DECLARE(name) extern const hci_effect_room hci_effect_##name;
HCI_EFFECT_ROOMS(HCI_EFFECT_DECLARE)
#undef HCI_EFFECT_DECLARE

/* Parameters: one value; one for each order from the least on; one for each whole order. */
#define HCI_PLAIN(name, unit, meaning, standard, least)                                                      \
    {                                                                                                        \
        name, unit, meaning, standard, least, false, false, 0.0                                              \
    }
#define HCI_ORDERED(name, unit, meaning, least_order)                                                        \
    {                                                                                                        \
        name, unit, meaning, 0.0, -DBL_MAX, true, false, least_order                                         \
    }
#define HCI_WHOLE(name, unit, meaning, least_order)                                                          \
    {                                                                                                        \
        name, unit, meaning, 0.0, -DBL_MAX, true, true, least_order                                          \
    }

/* Members of a room. */
#define HCI_EFFECT_PARAMETERS(table) .parameter = (table), .parameter_count = sizeof(table) / sizeof *(table)

/* Periods in a mechanical turn of an electrical order, a whole number where it is near one: a file says
 * 0.142857 and means 1/7. */
static inline double hci_effect_periods(double order, int pole_pairs)
{
    const double k = order * pole_pairs, whole = floor(k + 0.5);
    return fabs(k - whole) < HCI_ORDER_TOLERANCE * pole_pairs ? whole : k;
}

/* sin or cos of an angle, and its derivative by the mechanical angle. */
typedef struct {
    double value, slope;
} hci_effect_oscillation;

static inline hci_effect_oscillation hci_effect_oscillate(bool cosine, double periods, double angle_rad)
{
    const double s = sin(angle_rad), c = cos(angle_rad);
    const hci_effect_oscillation x = {cosine ? c : s, cosine ? -periods * s : periods * c};
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

/* The declared back-EMF and its slope by θ_m. */
void hci_effect_declared_emf(const hci_machine *machine, double theta_m_rad, double e[3], double slope[3]);

static inline void hci_effect_link_add(hci_effect_channel *channel, const hci_effect_link *link)
{
    if (channel->count < HCI_EFFECT_LINKS) channel->link[channel->count] = *link;
    ++channel->count;
}

#endif
