#include "host/emit/foreign_need.h"

#include <math.h>

/* i_d and i_q of waves. */
static void rotor_frame(const hci_wave *waves, size_t count, double theta_rad, double dq[2])
{
    double abc[3];
    hci_waves_at(waves, count, theta_rad, abc);
    dq[0] = dq[1] = 0.0;
    for (int s = 0; s < 3; ++s) {
        const double x = theta_rad - 2.0 * HCI_PI * s / 3.0;
        dq[0] -= 2.0 / 3.0 * abc[s] * cos(x);
        dq[1] += 2.0 / 3.0 * abc[s] * sin(x);
    }
}

static double torque_at(const hci_foreign_need *need, double theta_rad)
{
    double abc[3], more[3];
    const hci_emit_foreign_request *r = need->request;
    hci_waves_at(r->currents, r->current_count, theta_rad, abc);
    hci_waves_at(r->per_Nm, r->per_Nm ? r->per_Nm_count : 0, theta_rad, more);
    for (int s = 0; s < 3; ++s)
        abc[s] += r->reference_torque_Nm * more[s];
    return hci_machine_plant_torque_at(need->plant, theta_rad, abc, NULL);
}

void hci_foreign_need_begin(hci_foreign_need *need)
{
    enum { ANGLES = 4096 };
    const double turn = 2.0 * HCI_PI * hci_machine_plant_pole_pairs(need->plant);
    double sum = 0.0;
    for (int k = 0; k < ANGLES; ++k)
        sum += torque_at(need, turn * k / ANGLES);
    need->torque_Nm = sum / ANGLES;
    if (fabs(need->torque_Nm) < 1e-9 * need->torque_constant_Nm_per_A) need->torque_Nm = 0.0;
}

/* The i_q that makes a torque with i_d = 0, by Newton's method: with surface magnets one step is exact. */
static hci_status find_q(const hci_foreign_need *need, double theta_rad, double torque_Nm, double *q_A,
                         hci_note *note)
{
    const double K = need->torque_constant_Nm_per_A;
    *q_A = torque_Nm / K;
    for (int step = 0; step < 20; ++step) {
        double abc[3], one[3], slope[3];
        hci_machine_plant_phases(theta_rad, (double[2]){0.0, *q_A}, abc);
        hci_machine_plant_phases(theta_rad, (double[2]){0.0, 1.0}, one);
        const double error_Nm = hci_machine_plant_torque_at(need->plant, theta_rad, abc, slope) - torque_Nm;
        const double by_q = slope[0] * one[0] + slope[1] * one[1] + slope[2] * one[2];
        if (!(by_q > 0.05 * K))
            return hci_note_set(note, HCI_ERROR_INPUT,
                                "at the electrical angle %.4g rad 1 A of i_q makes %.3g N·m, less than a "
                                "twentieth of the mean: i_q alone cannot cancel the ripple of this machine; "
                                "choose a target that carries i_d too",
                                theta_rad, by_q);
        *q_A -= error_Nm / by_q;
        if (fabs(error_Nm) < 1e-13 * K * (1.0 + fabs(*q_A))) break;
    }
    return HCI_OK;
}

/* i = T·A + B with T = K·(own i_q), less the own i_q. */
static void dq_values(const hci_foreign_need *need, double theta_rad, double value[4])
{
    const hci_emit_foreign_request *r = need->request;
    const double K = need->torque_constant_Nm_per_A;
    rotor_frame(r->currents, r->current_count, theta_rad, value);
    rotor_frame(r->per_Nm, r->per_Nm ? r->per_Nm_count : 0, theta_rad, value + 2);
    value[2] *= K;
    value[3] = r->per_Nm ? K * value[3] - 1.0 : 0.0;
    if (!r->per_Nm) value[1] -= need->torque_Nm / K;
}

hci_status hci_foreign_need_at(const hci_foreign_need *need, hci_foreign_kind kind, double theta_rad,
                               double *value, hci_note *note)
{
    if (kind == HCI_FOREIGN_DQ) {
        dq_values(need, theta_rad, value);
        return HCI_OK;
    }
    const hci_status status = find_q(need, theta_rad, torque_at(need, theta_rad), value, note);
    *value -= need->torque_Nm / need->torque_constant_Nm_per_A;
    if (kind == HCI_FOREIGN_TORQUE) *value *= need->torque_constant_Nm_per_A;
    return status;
}
