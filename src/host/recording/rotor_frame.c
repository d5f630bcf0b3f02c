#include "host/recording/rotor_frame.h"

hci_dq hci_run_dq(const hci_run *run, int pole_pairs, size_t k)
{
    const double theta_m_rad = run->theta_m_rad ? run->theta_m_rad[k] : 0.0;
    return hci_park(hci_clarke(run->i_A + 3 * k), pole_pairs * theta_m_rad);
}

hci_dq hci_sample_dq(const hci_sample *sample, int pole_pairs)
{
    return hci_park(hci_clarke(sample->i_abc), pole_pairs * sample->theta_m_rad);
}

void hci_phases_of_dq(hci_dq x, double theta_e_rad, double abc[3])
{
    hci_clarke_inverse(hci_park_inverse(x, theta_e_rad), abc);
}
