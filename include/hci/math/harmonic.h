/* Periodic quantities of the electrical angle: harmonics, and waves over the three phases.
 *
 * A harmonic is A sin(nθ + γ), kept by its linear coordinates S = A cos γ (of sin nθ) and C = A sin γ (of cos
 * nθ). Order 0 has one coordinate, C = the mean. Orders are electrical, n >= 0, and may be fractional
 * (k/pole_pairs).
 *
 * A wave is the same over three phases s = 0, 1, 2 (a, b, c) with a sequence σ:
 *
 *     x_s(θ) = A sin(nθ − σ·2πs/3 + γ)        σ = +1 positive, −1 negative, 0 zero sequence
 *
 * Back-EMF and currents are both lists of waves. */
#ifndef HCI_MATH_HARMONIC_H
#define HCI_MATH_HARMONIC_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* π, which C99 does not have. */
#define HCI_PI 3.14159265358979323846

/* Two orders closer than this are the same order. */
#define HCI_ORDER_TOLERANCE 1e-6

/* Highest order that files may name. */
#define HCI_MOST_ORDER 2000.0

/* One order of a periodic quantity, S sin(nθ) + C cos(nθ), in the quantity's unit. */
typedef struct {
    double order;  /* n >= 0 */
    double sine;   /* S = A cos γ */
    double cosine; /* C = A sin γ; the mean at order 0 */
} hci_harmonic;

/* One order and sequence of a three-phase quantity, A sin(nθ − σ·2πs/3 + γ), in the quantity's unit. */
typedef struct {
    double order;  /* n >= 0 */
    int sequence;  /* σ: +1, −1 or 0 */
    double sine;   /* S = A cos γ */
    double cosine; /* C = A sin γ */
} hci_wave;

/* Peak amplitude A >= 0 of linear coordinates. */
double hci_amplitude(double sine, double cosine);

/* Phase γ in (−π, π] of linear coordinates. */
double hci_phase_rad(double sine, double cosine);

/* The harmonic A sin(nθ + γ). At order 0 the amplitude is the mean itself and the phase is not used. */
hci_harmonic hci_harmonic_polar(double order, double amplitude, double phase_rad);

/* The wave A sin(nθ − σ2πs/3 + γ). */
hci_wave hci_wave_polar(double order, int sequence, double amplitude, double phase_rad);

/* The sequence of a waveform that is the same in each phase but shifted by a third of a period: n mod 3 with
 * 2 counted as −1. `order` must be a whole number. */
int hci_sequence_of_order(double order);

/* Σ A sin(nθ + γ) at one electrical angle. terms: count entries, may be NULL when count is 0. O(count). */
double hci_harmonics_at(const hci_harmonic *terms, size_t count, double theta_rad);

/* x_a, x_b, x_c at one electrical angle. O(count); as of hci_harmonics_at, least where the orders rise by the
 * same step, whose sine and cosine are taken once. */
void hci_waves_at(const hci_wave *waves, size_t count, double theta_rad, double abc[3]);

/* Joins waves of equal order and sequence in place, ascending by order, and drops those that are no larger
 * than `relative_floor` times the largest; with 0 those that are zero. Returns how many are left. O(n log n),
 * no workspace. */
size_t hci_waves_join(hci_wave *waves, size_t count, double relative_floor);

/* Mean over θ of x_a² + x_b² + x_c². Waves of equal order and sequence are added before squaring, so a list
 * that names a component twice is measured rightly; the two sequences of order 0 share one plane and are
 * joined too. For currents, resistance times this is the copper loss in W. O(count²), no workspace. */
double hci_waves_mean_square(const hci_wave *waves, size_t count);

#ifdef __cplusplus
}
#endif

#endif
