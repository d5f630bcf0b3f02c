/* Clarke and Park transforms, amplitude-invariant, in the project's frame: q in phase with the fundamental of
 * the back-EMF, d on the magnet axis, i_a = i_q sin θ − i_d cos θ. i_q > 0 makes positive torque, i_d > 0
 * strengthens the magnets' flux. Double: 5450 instructions on a Cortex-M4F; there hci/foc.h. */
#ifndef HCI_MACHINE_FRAMES_H
#define HCI_MACHINE_FRAMES_H

#ifdef __cplusplus
extern "C" {
#endif

/* Three phase quantities in the stationary frame, amplitude-invariant, in their unit. */
typedef struct {
    double alpha, beta; /* alpha on the axis of phase a, beta a quarter turn ahead */
    double zero;        /* mean of the three */
} hci_alpha_beta;

/* Three phase quantities in the rotor frame, amplitude-invariant, in their unit. */
typedef struct {
    double d, q; /* d on the magnet axis, q a quarter of an electrical turn ahead */
    double zero; /* mean of the three */
} hci_dq;

/* α = (2a − b − c)/3, β = (b − c)/√3, zero = (a + b + c)/3. May run in an interrupt. */
hci_alpha_beta hci_clarke(const double abc[3]);

/* The inverse: a = α + zero, b = −α/2 + √3 β/2 + zero, c = −α/2 − √3 β/2 + zero. abc: out. May run in an
 * interrupt. */
void hci_clarke_inverse(hci_alpha_beta x, double abc[3]);

/* d = −α cos θ − β sin θ, q = α sin θ − β cos θ; zero stays. theta_rad: electrical. May run in an
 * interrupt. */
hci_dq hci_park(hci_alpha_beta x, double theta_rad);

/* The inverse: α = −d cos θ + q sin θ, β = −d sin θ − q cos θ; zero stays. May run in an interrupt. */
hci_alpha_beta hci_park_inverse(hci_dq x, double theta_rad);

/* The orthonormal (power-invariant) αβ plane: x·x is a² + b² + c² for phase quantities of zero sum. */

/* From the plane to phase quantities of zero sum, a = sqrt(2/3) α, b and c = −α/sqrt(6) ± β/sqrt(2). abc:
 * out. May run in an interrupt. */
void hci_plane_to_abc(const double x[2], double abc[3]);

/* Phase quantities to the plane, their zero sequence dropped: the transposed matrix. x: out. May run in an
 * interrupt. */
void hci_plane_from_abc(const double abc[3], double x[2]);

/* The extended frame dq_x for a back-EMF that is not sinusoidal: at every angle q lies along the back-EMF
 * vector, and the scale a_x makes the mutual torque sqrt(3/2)·i_qx whatever the angle (Oliveira et al. 2005,
 * in the conventions here):
 *
 *     a_x = sqrt(3/2)/|e_αβ|,    x_dqx = (1/a_x) R x_αβ,    e_dx = 0,    T_mutual = a_x² e_qx i_qx
 *
 * with αβ here in the power-invariant Clarke frame and R the orthonormal rotation onto (d, q). For a
 * sinusoidal back-EMF of amplitude E, a_x = 1/E and x_dqx is sqrt(3/2)·E times the ordinary dq. */
typedef struct {
    double a_x;             /* A/(N·m) */
    double q_alpha, q_beta; /* unit vector of the q axis; the d axis is (q_beta, −q_alpha) */
} hci_dqx_frame;

/* A quantity in the extended frame. A current is in A·(N·m/A) = N·m there, which the literature and the files
 * call A: the mutual torque is sqrt(3/2) N·m for each, whatever the machine. */
typedef struct {
    double d, q; /* q along the back-EMF vector */
} hci_dqx;

/* The frame for a back-EMF e_abc. Where e has no part without zero sequence, or 1/|e| is no finite number,
 * there is none: a_x is then 0 and the axis (0, 0). */
hci_dqx_frame hci_dqx_frame_of(const double e_abc[3]);

/* Phase quantities of zero sum to the frame; a frame with a_x = 0 gives zeros. */
hci_dqx hci_dqx_from_abc(hci_dqx_frame frame, const double abc[3]);

/* Back to phase quantities of zero sum. abc: out; zeros for a frame with a_x = 0. */
void hci_dqx_to_abc(hci_dqx_frame frame, hci_dqx x, double abc[3]);

/* Slopes of the inductances in the extended frame. */
typedef struct {
    double d, dq, q; /* L'_d, M'_dq, L'_q */
} hci_dqx_slope;

/* (L'_d, M'_dq, L'_q) = a_x² R L'_αβ Rᵀ, so that the reluctance torque is ½L'_d i_d² + M'_dq i_d i_q +
 * ½L'_q i_q² in currents of this frame. slope_abc: entries HCI_AA … HCI_CA of torque.h, H/rad. */
hci_dqx_slope hci_dqx_slope_of(hci_dqx_frame frame, const double slope_abc[6]);

#ifdef __cplusplus
}
#endif

#endif
