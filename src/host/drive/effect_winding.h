/* What effects are to a winding: the voltage that they add, and inductance. */
#ifndef HCI_SRC_HOST_DRIVE_EFFECT_WINDING_H
#define HCI_SRC_HOST_DRIVE_EFFECT_WINDING_H

#include "hci/effects/effect.h"

/* A current and its derivative by the electrical angle, in the orthonormal plane. */
typedef struct {
    double x[2], slope[2];
} hci_plane_current;

/* Adds ∂T_x/∂i + p L_x di/dθ, the slope of the effects' flux by the mechanical angle: what the voltage in
 * the plane has more of than without them, by mechanical speed. effects: NULL or none adds nothing.
 * temperature_C: of the magnets; NAN: the reference. inductance_H: out, L_x; αα, αβ, ββ. */
void hci_effects_add_flux_slope(const hci_machine *machine, const hci_effects *effects, double temperature_C,
                                double theta_rad, const hci_plane_current *i, double slope_Vs[2],
                                double inductance_H[3]);

/* Means over a turn of what effects (may be NULL) add to L_d and L_q at small currents. */
void hci_effects_mean_inductance(const hci_machine *machine, const hci_effects *effects, double *d_H,
                                 double *q_H);

/* What effects leave of declared L_d and L_q that differ: a difference makes a reluctance torque, and where
 * the effects have one too, recordings have told it whole, and it would count twice. Then the mean of both
 * less that of the effects is taken. Returns the difference that is left to the effects; 0: as it is
 * declared. */
double hci_effects_take_saliency(const hci_machine *machine, const hci_effects *effects, double *d_H,
                                 double *q_H);

#endif
