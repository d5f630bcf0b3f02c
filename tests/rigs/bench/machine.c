/* The declared machine: e·i + ½ iᵀL'i + T_cog. */
#include "rig.h"

#include <math.h>

#define THIRD (2.0 * RIG_PI / 3.0)

double rig_waves_at(const rig_wave *w, int count, double theta_rad)
{
    double sum = 0.0;
    for (int k = 0; k < count; ++k)
        if (w[k].order > 0.0)
            sum += w[k].sine * sin(w[k].order * theta_rad) + w[k].cosine * cos(w[k].order * theta_rad);
    return sum;
}

/* i_a = i_q sin θ − i_d cos θ */
void rig_abc_of(double theta_e_rad, double id_A, double iq_A, double i_A[3])
{
    for (int s = 0; s < 3; ++s)
        i_A[s] = iq_A * sin(theta_e_rad - THIRD * s) - id_A * cos(theta_e_rad - THIRD * s);
}

void rig_dq_of(double theta_e_rad, const double i_A[3], double *id_A, double *iq_A)
{
    *id_A = *iq_A = 0.0;
    for (int s = 0; s < 3; ++s) {
        *id_A -= 2.0 / 3.0 * i_A[s] * cos(theta_e_rad - THIRD * s);
        *iq_A += 2.0 / 3.0 * i_A[s] * sin(theta_e_rad - THIRD * s);
    }
}

/* W' = 3/2 (½ L_d i_d² + ½ L_q i_q²), and at constant phase currents ∂i_d/∂θ = i_q, ∂i_q/∂θ = −i_d. */
static double reluctance_torque(const rig_machine *m, double theta_e_rad, const double i_A[3])
{
    double d, q;
    const double c = cos(6.0 * theta_e_rad), s = -6.0 * sin(6.0 * theta_e_rad);
    if (!m->salient) return 0.0;
    rig_dq_of(theta_e_rad, i_A, &d, &q);
    return 1.5 * m->pole_pairs *
           ((m->ld_H + m->ld6_H * c - m->lq_H - m->lq6_H * c) * d * q +
            0.5 * s * (m->ld6_H * d * d + m->lq6_H * q * q));
}

double rig_torque_declared(const rig_machine *m, double theta_m_rad, const double i_A[3])
{
    const double theta_e_rad = m->pole_pairs * theta_m_rad;
    double sum = rig_waves_at(m->cogging, m->cogging_count, theta_e_rad);
    for (int s = 0; s < 3; ++s)
        sum += i_A[s] * rig_waves_at(m->emf, m->emf_count, theta_e_rad - THIRD * s);
    return sum + reluctance_torque(m, theta_e_rad, i_A);
}

/* With i_d = −⅔ Σ i_s cos θ_s and i_q = ⅔ Σ i_s sin θ_s in W' = ½ iᵀL i: L_jk = ⅔ (L_d c_j c_k + L_q s_j s_k)
 * + L_0/3. */
void rig_inductances(const rig_machine *m, double theta_e_rad, double out_H[6])
{
    const int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
    const double ld = m->ld_H + m->ld6_H * cos(6.0 * theta_e_rad);
    const double lq = m->lq_H + m->lq6_H * cos(6.0 * theta_e_rad);
    for (int k = 0; k < 6; ++k) {
        const double j = theta_e_rad - THIRD * row[k], l = theta_e_rad - THIRD * column[k];
        out_H[k] = 2.0 / 3.0 * (ld * cos(j) * cos(l) + lq * sin(j) * sin(l)) + m->l0_H / 3.0;
    }
}

static rig_wave wave(double order, double amplitude, double phase_rad)
{
    return (rig_wave){order, amplitude * cos(phase_rad), amplitude * sin(phase_rad)};
}

/* Harmonics in phase or against, as of magnets that are symmetric, for most machines. */
static void draw_emf(rig_machine *m, double e1, rig_random *r)
{
    static const double ORDER[] = {3.0, 5.0, 7.0, 11.0, 13.0};
    const bool symmetric = rig_chance(r, 0.7);
    m->emf[m->emf_count++] = wave(1.0, e1, 0.0);
    for (int k = 0; k < 5; ++k) {
        const double share = rig_uniform(r, 0.01, 0.06) * (k > 2 ? 0.6 : 1.0);
        const double phase =
            symmetric ? (rig_chance(r, 0.5) ? RIG_PI : 0.0) : rig_uniform(r, -RIG_PI, RIG_PI);
        if (rig_chance(r, 0.85)) m->emf[m->emf_count++] = wave(ORDER[k], e1 * fmax(share, 0.01), phase);
    }
}

static void draw_inductance(rig_machine *m, double e1, rig_random *r)
{
    const double flux_Vs = e1 / m->pole_pairs; /* λ = e/p */
    const double base_H = flux_Vs / m->rated_current_A * rig_uniform(r, 0.2, 0.6);
    m->salient = rig_chance(r, 0.4);
    m->ld_H = base_H;
    m->lq_H = base_H * (m->salient ? rig_uniform(r, 1.3, 2.5) : 1.0);
    m->l0_H = base_H * rig_uniform(r, 0.1, 0.4);
    if (!m->salient || rig_chance(r, 0.5)) return;
    m->ld6_H = base_H * rig_uniform(r, -0.03, 0.03);
    m->lq6_H = base_H * rig_uniform(r, -0.05, 0.05);
}

rig_machine rig_machine_draw(int most_pole_pairs, rig_random *r)
{
    rig_machine m = {0};
    m.pole_pairs = rig_pick(r, 2, most_pole_pairs);
    m.rated_current_A = rig_log_uniform(r, 2.0, 20.0);
    const double e1 = rig_log_uniform(r, 0.05, 1.0);
    m.rated_torque_Nm = 1.5 * e1 * m.rated_current_A;
    m.rated_speed_rad_per_s = 2.0 * RIG_PI * rig_log_uniform(r, 60.0, 300.0) / m.pole_pairs;
    draw_emf(&m, e1, r);
    for (int order = 6; order <= 12; order += 6) {
        const double phase_rad = rig_uniform(r, -RIG_PI, RIG_PI); /* one draw a statement: hide.c */
        const double share = rig_log_uniform(r, 0.005, 0.03);
        m.cogging[m.cogging_count++] = wave(order, m.rated_torque_Nm * share, phase_rad);
    }
    draw_inductance(&m, e1, r);
    if (rig_chance(r, 0.3)) m.emf_frequency_Hz = 50.0;
    return m;
}
