/* A user of the core alone: a current in the rotor frame back to phases, and the torque it makes. */
#include <hci/machine/frames.h>
#include <hci/machine/torque.h>
#include <stdio.h>

double consumer_torque_Nm(const hci_machine *machine, double iq_A);

int main(void)
{
    const hci_wave back_emf[] = {hci_wave_polar(1.0, +1, 0.5, 0.0)};
    const hci_machine machine = {.pole_pairs = 4, .back_emf = back_emf, .back_emf_count = 1};
    const double torque_Nm = consumer_torque_Nm(&machine, 2.0);
    printf("%s: %.6f N.m\n", hci_status_text(HCI_OK), torque_Nm);
    return torque_Nm > 1.499999 && torque_Nm < 1.500001 ? 0 : 1; /* 3/2 · 0.5 N·m/A · 2 A */
}
