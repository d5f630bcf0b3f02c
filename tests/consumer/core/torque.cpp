// The same headers from C++.
#include <hci/machine/frames.h>
#include <hci/machine/torque.h>

extern "C" double consumer_torque_Nm(const hci_machine *machine, double iq_A);

double consumer_torque_Nm(const hci_machine *machine, double iq_A)
{
    const double theta_rad = 0.7;
    double i_abc[3];
    hci_clarke_inverse(hci_park_inverse(hci_dq{0.0, iq_A, 0.0}, theta_rad), i_abc);
    return hci_torque_at(machine, theta_rad, i_abc);
}
