/* Current and voltage over the angle, as samples over whole electrical turns and as their orders. */
#ifndef HCI_SRC_HOST_DRIVE_TURN_SAMPLES_H
#define HCI_SRC_HOST_DRIVE_TURN_SAMPLES_H

#include "hci/host/drive/drive.h"
#include "host/drive/machine_model.h"

/* What is sampled, d and q of each, in the rotor frame, amplitude-invariant. */
enum { HCI_TURN_CURRENT, HCI_TURN_VOLTAGE = 2, HCI_TURN_OWN = 4, HCI_TURN_VALUES = 6 };

/* Start with {0}. */
typedef struct {
    size_t turns, samples;          /* samples: a power of two, over all turns */
    double *value[HCI_TURN_VALUES]; /* A; V·s: terminal voltage but for R i, by electrical speed; of the
                                       drive's own decoupling, likewise */
    hci_harmonic *order[HCI_TURN_VALUES]; /* the same; samples/2 of them, order k/turns */
} hci_turn_samples;

/* own: the machine as the drive's decoupling knows it, or NULL. HCI_ERROR_INPUT for orders that do not repeat
 * in a mechanical turn, HCI_ERROR_MEMORY. To be released, on failure too. */
hci_status hci_turn_samples_make(const hci_machine_model *machine, const hci_machine_model *own,
                                 const hci_loop_level *level, hci_turn_samples *samples, hci_note *note);
void hci_turn_samples_release(hci_turn_samples *samples);

/* Largest line voltage (space_vector), twice the largest phase voltage (sinusoidal) or √3 times the largest
 * amplitude (circle), of R i + ω v over the turn: what the dc link has to be. speed: electrical. */
double hci_turn_samples_dc_link_V(const hci_turn_samples *samples, double resistance_ohm,
                                  hci_modulation modulation, double speed_rad_per_s);

#endif
