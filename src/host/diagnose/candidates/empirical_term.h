/* A torque of one order that grows with current, speed and direction in a way that no known effect does:
 *
 *     T = (S sin nθ + C cos nθ) |i|^a |ω|^b (sign ω)^c
 *
 * It is offered like the terms of effects, so that an explanation by known effects has to be better than this
 * description. It never gets into a machine. */
#ifndef HCI_SRC_HOST_DIAGNOSE_CANDIDATES_EMPIRICAL_TERM_H
#define HCI_SRC_HOST_DIAGNOSE_CANDIDATES_EMPIRICAL_TERM_H

#include "hci/effects/effect.h"

/* How a torque grows: |i| and |ω| relative to 1 A and 1 rad/s. */
typedef struct {
    double current, speed; /* exponents */
    bool turns_sign;       /* with the direction */
} hci_growth_law;

enum { HCI_GROWTH_LAWS = 64 };

extern const hci_effect_type hci_empirical_type; /* parameter 2g is the sine, 2g + 1 the cosine of growth g */

hci_growth_law hci_growth_law_of(size_t g);

/* Whether known effects grow so: with a whole power of the current, or at order 0 like friction. */
bool hci_growth_law_is_known(size_t g, double order);

double hci_growth_law_at(size_t g, double current_A, double speed_rad_per_s);

#endif
