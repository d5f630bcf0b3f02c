/* Where in the rotor frame the loads of recordings lie: on a curve from no current on, as those of a drive
 * that asks for one current of each torque, or all over the plane. Along a curve the torque is known; what
 * makes it is not. */
#ifndef HCI_HOST_WAVEFORM_LOAD_CURVE_H
#define HCI_HOST_WAVEFORM_LOAD_CURVE_H

#include <stdbool.h>
#include <stddef.h>

/* Means over one recording with a current. */
typedef struct {
    double id_A, iq_A; /* peak values of the phases, positive or negative */
    double torque_Nm;  /* hci_load_curve_angle_rad alone asks for it */
} hci_load;

/* Whether the current has one direction at each length, by 3 degrees where two are as long to a tenth, and
 * goes over from each length to the next within 20 degrees, no further than 60 from i_q; opposite currents
 * have the same direction. Sorts the loads by length. False of fewer than two. O(count log count). */
bool hci_loads_are_on_curve(hci_load *load, size_t count);

/* The direction β, i_d = -I sin β and i_q = I cos β, at a torque on such a curve of two loads or more, in
 * rad: between two loads in proportion to the torque, outside of them as at the last. */
double hci_load_curve_angle_rad(const hci_load *load, size_t count, double torque_Nm);

#endif
