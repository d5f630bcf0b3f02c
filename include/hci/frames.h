/* Clarke and Park transforms, amplitude-invariant, in the project's frame: q in phase with the fundamental
 * of the back-EMF, d on the magnet axis, i_a = i_q sin θ − i_d cos θ. i_q > 0 makes positive torque, i_d > 0
 * strengthens the magnets' flux. */
#ifndef HCI_FRAMES_H
#define HCI_FRAMES_H

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    double alpha, beta, zero;
} hci_alpha_beta;

typedef struct {
    double d, q, zero;
} hci_dq;

/* α = (2a − b − c)/3, β = (b − c)/√3, zero = (a + b + c)/3. May run in an interrupt. */
hci_alpha_beta hci_clarke(const double abc[3]);
void hci_clarke_inverse(hci_alpha_beta x, double abc[3]);

/* d = −α cos θ − β sin θ, q = α sin θ − β cos θ. */
hci_dq hci_park(hci_alpha_beta x, double theta_rad);
hci_alpha_beta hci_park_inverse(hci_dq x, double theta_rad);

#ifdef __cplusplus
}
#endif

#endif
