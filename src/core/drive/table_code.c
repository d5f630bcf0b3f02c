#include "core/drive/table_code.h"

#include <math.h>

/* The mechanical angle as a target has it: counts of the encoder, or the fraction of a turn. */
static uint32_t mechanical_angle(const hci_table_code *code, double theta_m_rad)
{
    const double turns = theta_m_rad / (2.0 * HCI_PI);
    if (code->counts > 0)
        return hci_angle_from_counts((int32_t)floor(turns * code->counts + 0.5),
                                     hci_angle_scale(code->counts));
    return (uint32_t)((turns - floor(turns)) * 4294967295.0);
}

void hci_table_code_at(void *context, const hci_measurement *measured, double torque_Nm,
                       hci_reference_dq *reference)
{
    const hci_table_code *code = context;
    if (!code->tables.loop) {
        reference->i_A[1] = (double)code->sine_A;
        return;
    }
    const uint32_t periods = code->pole_pairs / code->tables.loop->period_turns;
    const hci_loop_reference r = hci_loop_at(
        &code->tables, hci_angle_from_mechanical(mechanical_angle(code, measured->theta_m_rad), periods),
        (float)torque_Nm, (float)(measured->speed_rad_per_s * code->pole_pairs));
    reference->i_A[0] = (double)r.id_A;
    reference->i_A[1] = (double)r.iq_A;
    reference->v_V[0] = (double)r.vd_V;
    reference->v_V[1] = (double)r.vq_V;
}
