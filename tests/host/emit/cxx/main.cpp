// Emitted tables in a C++ program: included, linked, checked and read.
#include <cstdint>

#include "hci/blob.h"
#include "hci/counter.h"
#include "hci/foc.h"

#include "form_abc.h"
#include "form_dq.h"
#include "form_drive.h"
#include "form_torque.h"

namespace
{
bool near(float x, float y, float tolerance)
{
    return x - y <= tolerance && y - x <= tolerance;
}

// ia = iq sin θ − id cos θ at θ = 90°, where ia = iq, and at 180°, where ia = id.
bool frames_agree()
{
    const float tolerance = form_abc.max_error_A + form_dq.max_error_A;
    const hci_currents_abc quarter = hci_table_f32_abc(&form_abc, 0x40000000u);
    const hci_currents_abc half = hci_table_f32_abc(&form_abc, 0x80000000u);
    return near(quarter.ia_A, hci_table_f32_dq(&form_dq, 0x40000000u).iq_A, tolerance) &&
           near(half.ia_A, hci_table_f32_dq(&form_dq, 0x80000000u).id_A, tolerance);
}

// At the torque that the currents were solved for both forms are the same currents.
bool torque_form_agrees()
{
    const float tolerance = form_abc.max_error_A + form_torque.max_error_A;
    const std::uint32_t angle = hci_angle_from_rad(-1.0f);
    const hci_currents_abc x = hci_table_f32_abc(&form_abc, angle);
    const hci_currents_abc y = hci_table_f32_abc_torque(&form_torque, angle, form_torque.reference_torque_Nm);
    return near(x.ia_A, y.ia_A, tolerance) && near(x.ib_A, y.ib_A, tolerance) && near(x.ic_A, y.ic_A, tolerance);
}

// For a drive, at a standstill and at the torque that was solved for, too.
bool drive_form_agrees()
{
    static float memory[form_drive_FLOATS];
    hci_loop_tables tables;
    hci_loop_start(&tables, &form_drive, HCI_LOOP_FEEDFORWARD, memory);
    hci_loop_make(&tables, 0.0f);
    const float tolerance = form_dq.max_error_A + 0.01f;
    const std::uint32_t angle = hci_angle_from_rad(2.0f);
    const hci_currents_dq x = hci_table_f32_dq(&form_dq, angle);
    const hci_loop_reference y = hci_loop_at(&tables, angle, form_drive.torque_high_Nm, 0.0f);
    return near(x.id_A, y.id_A, tolerance) && near(x.iq_A, y.iq_A, tolerance);
}
} // namespace

int main()
{
    if (hci_table_f32_check(&form_abc) != HCI_TABLE_GOOD) return 1;
    if (hci_table_f32_check(&form_dq) != HCI_TABLE_GOOD) return 2;
    if (hci_table_f32_check(&form_torque) != HCI_TABLE_GOOD) return 3;
    if (!frames_agree()) return 4;
    if (!torque_form_agrees()) return 5;
    if (hci_loop_check(&form_drive) != HCI_TABLE_GOOD) return 6;
    return drive_form_agrees() ? 0 : 7;
}
