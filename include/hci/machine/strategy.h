/* Currents that make a wanted torque at one angle, for any machine with T = e·i + ½ iᵀL'i + T_cog in a star
 * connection.
 *
 * i_d and i_q are those of the extended frame dq_x (frames.h): q lies along the back-EMF. */
#ifndef HCI_MACHINE_STRATEGY_H
#define HCI_MACHINE_STRATEGY_H

#include "hci/machine/frames.h"
#include "hci/machine/torque.h"
#include "hci/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How a current is chosen among those that make the torque. */
typedef enum {
    HCI_STRATEGY_MTPA, /* the shortest of all that make it */
    HCI_STRATEGY_ID0, /* i_d = 0, i_q from the mutual torque alone: reluctance and cogging remain as ripple */
    HCI_STRATEGY_CANCEL /* the same i_q, and the i_d that makes reluctance plus cogging torque zero */
} hci_strategy;

/* Their words in files and options: X(strategy, word). */
#define HCI_STRATEGY_NAMES(X)                                                                                \
    X(HCI_STRATEGY_MTPA, "mtpa")                                                                             \
    X(HCI_STRATEGY_ID0, "id0")                                                                               \
    X(HCI_STRATEGY_CANCEL, "cancel")

/* The machine at one angle, in the orthonormal (power-invariant) αβ plane. */
typedef struct {
    double e[2];       /* back-EMF, N·m/A; x·x is i_a² + i_b² + i_c² */
    double slope[3];   /* L'_αα, L'_αβ, L'_ββ, N·m/A² */
    double cogging_Nm; /* T_cog */
} hci_machine_point;

/* The machine at an electrical angle. O(harmonics). */
hci_machine_point hci_machine_at(const hci_machine *machine, double theta_rad);

/* Torque of a current x in the same plane. */
double hci_point_torque_Nm(const hci_machine_point *point, const double x[2]);

/* The current of a strategy for a wanted torque. previous: the answer at a neighbouring angle, or NULL; where
 * both roots of `cancel` are equally long the one nearer to it is taken, so that the current is continuous
 * along θ.
 * x: out, also where the answer is no: then the current that comes nearest to the torque. least_iq_A: out,
 * may be NULL; for `cancel`, the smallest |i_q| (in A of the orthonormal plane) from which on an i_d exists
 * at this angle, 0 when for any, infinite when from none on. HCI_OK, or HCI_NOT_REACHED when no current of
 * this strategy exists. A few Newton steps, each of one square root; some tens where L' is nearly singular or
 * the torque is within 1e-9 of the most there is. */
hci_status hci_strategy_current(const hci_machine_point *point, hci_strategy strategy, double torque_Nm,
                                const double *previous, double x[2], double *least_iq_A);

/* ---- any smooth torque ---- */

/* A torque in N·m of the current x in the same plane, with its gradient in N·m/A. */
typedef struct {
    double (*at)(const void *context, const double x[2], double gradient[2]); /* gradient: out */
    const void *context;                                                      /* first argument of `at` */
} hci_smooth_torque;

/* The same strategies for any smooth torque. mutual: the torque up to the second degree at this angle; its
 * T_cog is T without current, its e gives the axes and the mutual torque e·x, and its shortest current the
 * size of the currents to be looked at.
 *
 *     mtpa    the shortest x with T(x) = τ, as the shortest of the lengths r(φ) at which T along a ray is τ
 *     id0     i_d = 0, i_q = τ/e_q; whatever is not mutual torque stays
 *     cancel  i_q = τ/e_q and the shortest i_d with T = τ: i_d cancels all that is not mutual torque
 *
 * previous: NULL, and mtpa begins with the shortest of 48 rays, which finds the best of several ranges; or
 * the answer at a neighbouring angle, whose ray follows one range along θ.
 *
 * x: out, also where the answer is no, as above. HCI_OK or HCI_NOT_REACHED. Some tens of torques from a
 * neighbouring current, about a thousand without one. */
hci_status hci_strategy_smooth_current(const hci_smooth_torque *torque, const hci_machine_point *mutual,
                                       hci_strategy strategy, double torque_Nm, const double *previous,
                                       double x[2]);

#ifdef __cplusplus
}
#endif

#endif
