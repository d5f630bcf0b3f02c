/* What a drive has to do to the readings of its sensors before currents for the true machine do in it what
 * they are meant for. */
#ifndef HCI_HOST_MACHINE_CORRECTIONS_H
#define HCI_HOST_MACHINE_CORRECTIONS_H

#include <stdbool.h>
#include <stddef.h>

#include "hci/effects/effect.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Bytes that the lines of all sensors of a drive fit in, and waves of the angle. */
enum { HCI_CORRECTIONS_SIZE = 2048, HCI_CORRECTION_WAVES = 24 };

/* What an angle reads too much: amplitude × sin or cos of order × angle. */
typedef struct {
    double order;         /* in a turn of that angle */
    double amplitude_rad; /* of that angle, signed */
    bool is_mechanical;   /* the angle is the mechanical one */
    bool is_cosine;       /* cos and not sin */
} hci_angle_wave;

/* The current and position sensors of a drive, as numbers: i = (i_read − zero) × gain of each phase, and of
 * the electrical angle θ and the mechanical θ_m, from top to bottom, each line with what the one above has
 * made. */
typedef struct {
    bool has_currents;                         /* a zero that is not 0 or a gain that is not 1 */
    bool has_angle;                            /* one of angle_zero_rad to load_rad_per_A */
    double zero_A[3];                          /* of the phases, taken away before the gain */
    double gain[3];                            /* of the phases, by which what is left is multiplied */
    double angle_zero_rad;                     /* θ = θ_read − this */
    size_t waves;                              /* electrical ones first, θ − amplitude × sin(order θ) */
    hci_angle_wave wave[HCI_CORRECTION_WAVES]; /* then θ_m − amplitude × sin(order θ_m) */
    double load_rad_per_A;                     /* θ − this × i_q */
    double angle_delay_s;                      /* θ + this × dθ/dt */
    double current_delay_s;                    /* the currents are those of the angle of so much before */
    double current_filter_s;                   /* the same of their low pass */
} hci_corrections;

/* Whether a drive is asked to correct a term of an effect: of a torque sensor never, nor of an angle that
 * seems to be read before it is true. */
bool hci_correction_is_asked(const hci_effect_type *type, const hci_effect_term *term);

/* What `effects` describe, each the inverse of its effect, to first order where an angle bends. Torque
 * sensors are none of a drive, and an angle that seems to be read before it is true is left as it is. */
void hci_corrections_take(const hci_effects *effects, hci_corrections *corrections);

/* The same in ASCII, a line for each, "i_b = (i_b_read - 0.008 A) * 1.0211", in the order in which they are
 * to be done, divided by '\n'; "" where there is nothing to correct; lines that have no room are left out.
 * size: of text, HCI_CORRECTIONS_SIZE will do. */
void hci_corrections_words(const hci_effects *effects, char *text, size_t size);

#ifdef __cplusplus
}
#endif

#endif
