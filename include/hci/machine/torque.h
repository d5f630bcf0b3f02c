/* The torque model
 *
 *     T(θ, i) = e(θ)·i + ½ iᵀ L'(θ) i + T_cog(θ)            L' = ∂L/∂θ_m
 *
 * mutual, reluctance and cogging torque in N·m; θ electrical, e the back-EMF per mechanical speed in
 * V·s/rad. */
#ifndef HCI_MACHINE_TORQUE_H
#define HCI_MACHINE_TORQUE_H

#include "hci/math/harmonic.h"
#include "hci/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Entries of a symmetric 3×3 phase matrix in storage order, and their number. */
enum {
    HCI_AA,          /* self, phase a */
    HCI_BB,          /* self, phase b */
    HCI_CC,          /* self, phase c */
    HCI_AB,          /* mutual, a and b */
    HCI_BC,          /* mutual, b and c */
    HCI_CA,          /* mutual, c and a */
    HCI_PHASE_MATRIX /* how many */
};

/* One order of L'(θ), each entry S sin(mθ) + C cos(mθ) in H per mechanical radian (N·m/A²). */
typedef struct {
    double order;                    /* m >= 0, electrical */
    double sine[HCI_PHASE_MATRIX];   /* S of each entry, indexed by HCI_AA … HCI_CA */
    double cosine[HCI_PHASE_MATRIX]; /* C of each entry; the mean at order 0 */
} hci_inductance_slope;

/* One order of L(θ) itself, in H: the same layout. L' follows from it: S' = −p m C, C' = p m S. */
typedef hci_inductance_slope hci_inductance;

/* A machine as the torque model takes it. The arrays belong to the caller; any may be NULL with count 0. */
typedef struct {
    int pole_pairs;                    /* p >= 1; θ = p·θ_m */
    const hci_wave *back_emf;          /* e_s(θ), N·m/A */
    size_t back_emf_count;             /* entries of back_emf */
    const hci_harmonic *cogging;       /* T_cog(θ), N·m */
    size_t cogging_count;              /* entries of cogging */
    const hci_inductance_slope *slope; /* L'(θ), H/rad; none for a surface-magnet machine */
    size_t slope_count;                /* entries of slope */
} hci_machine;

/* Torque in N·m at one electrical angle for phase currents in A. O(harmonics); may run in an interrupt. */
double hci_torque_at(const hci_machine *machine, double theta_rad, const double i_abc[3]);

/* ∂T/∂i = e(θ) + L'(θ) i, in N·m/A. Same cost. */
void hci_torque_gradient_at(const hci_machine *machine, double theta_rad, const double i_abc[3],
                            double gradient[3]);

/* Back-EMF e in N·m/A at one electrical angle, and its derivative by the mechanical angle in N·m/(A·rad). e,
 * by_angle: out. O(back-EMF harmonics); may run in an interrupt. */
void hci_torque_back_emf_at(const hci_machine *machine, double theta_rad, double e[3], double by_angle[3]);

/* The torque and its derivatives. */
typedef struct {
    double torque_Nm;     /* T */
    double by_current[3]; /* ∂T/∂i = e + L'i, N·m/A */
    double by_angle;      /* ∂T/∂θ_m at constant phase currents, N·m per mechanical radian */
} hci_torque_slopes;

/* Both at one electrical angle for phase currents in A. Same cost as hci_torque_at. */
hci_torque_slopes hci_torque_slopes_at(const hci_machine *machine, double theta_rad, const double i_abc[3]);

/* What the torque is made of at one angle, whatever the currents: sums over all harmonics. */
typedef struct {
    double theta_rad;               /* electrical */
    double e[3], e_by_angle[3];     /* back-EMF, N·m/A; all by_angle by θ_m, per mechanical radian */
    double slope[HCI_PHASE_MATRIX]; /* L', N·m/A² */
    double slope_by_angle[HCI_PHASE_MATRIX]; /* its derivative */
    double cogging_Nm, cogging_by_angle;     /* T_cog */
} hci_torque_parts;

/* parts: out. O(harmonics). */
void hci_torque_parts_at(const hci_machine *machine, double theta_rad, hci_torque_parts *parts);

/* As hci_torque_slopes_at at the angle of the parts, to the last bit. */
hci_torque_slopes hci_torque_slopes_of(const hci_torque_parts *parts, const double i_abc[3]);

/* Entries that hci_slope_waves needs for so many current waves. */
size_t hci_slope_waves_capacity(const hci_machine *machine, size_t current_count);

/* L'(θ) i(θ) as waves, for slopes and current waves: what the reluctance adds to the back-EMF in ∂T/∂i. Equal
 * orders and sequences are joined and what is below 1e-15 of the largest is dropped. waves: out, capacity
 * hci_slope_waves_capacity entries; returns how many. O(slopes·currents·log). */
size_t hci_slope_waves(const hci_machine *machine, const hci_wave *currents, size_t current_count,
                       hci_wave *waves);

/* Upper bound of the number of orders that hci_torque_orders can find for `current_count` current waves. */
size_t hci_torque_orders_capacity(const hci_machine *machine, size_t current_count);

/* Every order at which the machine can have torque with these currents, ascending, each once, order 0
 * included.
 * orders: out, capacity entries; count: out. HCI_ERROR_CAPACITY if capacity is below the bound above. */
hci_status hci_torque_orders(const hci_machine *machine, const hci_wave *currents, size_t current_count,
                             double *orders, size_t capacity, size_t *count);

/* The torque spectrum in closed form: spectrum[k] is the torque's harmonic at orders[k] in N·m.
 * orders: ascending, each once, as hci_torque_orders gives them; torque at an order not listed is left out.
 * spectrum: out, order_count entries. O((emf + currents·slopes)·currents·log orders). */
void hci_torque_spectrum(const hci_machine *machine, const hci_wave *currents, size_t current_count,
                         const double *orders, size_t order_count, hci_harmonic *spectrum);

#ifdef __cplusplus
}
#endif

#endif
