/* Field-oriented control in single precision: what stands in the interrupt of a current loop beside a table.
 *
 * The frames of hci/machine/frames.h and the controller of hci/drive/control.h, which are double and meant
 * for the host and for simulation: amplitude-invariant, d on the magnet axis, i_a = i_q sin θ − i_d cos θ. θ
 * = 0 is where the fundamental of phase a's back-EMF crosses zero rising, half an electrical turn from where
 * most firmware has it; d and q are the same.
 *
 * Sine and cosine come from hci_angle_sine_cosine, once a sample for all of it. Needs hci/guard.h and the
 * headers of the tables: no libm, no heap, nothing writable. C99 and C++. */
#ifndef HCI_FOC_H
#define HCI_FOC_H

#include "hci/guard.h"

/* Three phase voltages to the star point. */
typedef struct {
    float va_V, vb_V, vc_V; /* of phases a, b and c */
} hci_voltages_abc;

/* Phase currents to the rotor frame; what is common to all three is left out. */
static inline hci_currents_dq hci_foc_currents(hci_currents_abc i, float sine, float cosine)
{
    const float alpha_A = (2.0f * i.ia_A - i.ib_A - i.ic_A) * 0.333333333f;
    const float beta_A = (i.ib_A - i.ic_A) * 0.577350269f;
    hci_currents_dq out;
    out.id_A = -alpha_A * cosine - beta_A * sine;
    out.iq_A = alpha_A * sine - beta_A * cosine;
    return out;
}

/* Currents in the rotor frame to phases: what a table of frame dq is in phase currents. */
static inline hci_currents_abc hci_foc_phases(hci_currents_dq i, float sine, float cosine)
{
    const float alpha_A = i.iq_A * sine - i.id_A * cosine;
    const float beta_A = -i.id_A * sine - i.iq_A * cosine;
    hci_currents_abc out;
    out.ia_A = alpha_A;
    out.ib_A = -0.5f * alpha_A + 0.866025404f * beta_A;
    out.ic_A = -out.ia_A - out.ib_A;
    return out;
}

/* Rotor-frame voltages. */
typedef struct {
    float vd_V, vq_V; /* on the magnet axis, and a quarter of an electrical turn ahead */
} hci_voltages_dq;

/* Rotor-frame voltages to phases. */
static inline hci_voltages_abc hci_foc_phase_voltages(hci_voltages_dq v, float sine, float cosine)
{
    hci_currents_dq x;
    hci_currents_abc phases;
    hci_voltages_abc out;
    x.id_A = v.vd_V;
    x.iq_A = v.vq_V;
    phases = hci_foc_phases(x, sine, cosine);
    out.va_V = phases.ia_A;
    out.vb_V = phases.ib_A;
    out.vc_V = phases.ic_A;
    return out;
}

/* A current controller of both axes. Start with {0} and set the gains. */
typedef struct {
    float proportional_ohm; /* k_p */
    float integral_ohm;     /* k_i times the time of a sample */
    float drawn;            /* share of what was cut off by which the integrals go back: k_i T/k_p */
    float d_V, q_V;         /* the integrals */
} hci_foc_pi;

/* Sets the gains: V/A, V/(A·s), s. The integrals stay. */
static inline void hci_foc_gains(hci_foc_pi *pi, float proportional_ohm, float integral_ohm_per_s,
                                 float sample_s)
{
    pi->proportional_ohm = proportional_ohm;
    pi->integral_ohm = integral_ohm_per_s * sample_s;
    pi->drawn = proportional_ohm > 0.0f ? pi->integral_ohm / proportional_ohm : 1.0f;
}

/* One sample: v = k_p ε + ∫ k_i ε + feed, its length at most most_V. While it is limited the integrals are
 * drawn towards the limit with the time constant k_p/k_i. feed_V: voltages that are known, as of hci/loop.h,
 * else 0. A voltage that is no number becomes 0, and leaves the integrals as they are. */
static inline hci_voltages_dq hci_foc_step(hci_foc_pi *pi, hci_currents_dq error_A, hci_voltages_dq feed_V,
                                           float most_V)
{
    const float d_V = pi->proportional_ohm * error_A.id_A + pi->d_V + feed_V.vd_V;
    const float q_V = pi->proportional_ohm * error_A.iq_A + pi->q_V + feed_V.vq_V;
    const float share = hci_guard_share(d_V, q_V, most_V);
    hci_voltages_dq out = {0.0f, 0.0f};
    if (share > 0.0f) {
        out.vd_V = share * d_V;
        out.vq_V = share * q_V;
        pi->d_V += pi->integral_ohm * error_A.id_A + pi->drawn * (out.vd_V - d_V);
        pi->q_V += pi->integral_ohm * error_A.iq_A + pi->drawn * (out.vq_V - q_V);
    }
    return out;
}

#endif
