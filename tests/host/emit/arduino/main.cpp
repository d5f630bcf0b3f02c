// The sketch of the Arduino library, with SimpleFOC's angle and its transformation: the phase currents that
// come of what is fed forward are those of a table that was emitted finely in phase currents.
#include <cstdio>
#include <cstdlib>

#include "torque_ripple.ino"

#include "fine.h"

int main()
{
    double worst = 0.0;
    setup();
    motor.target = 11.7f; // 2.46 N·m at 0.21 N·m/A
    for (int k = 0; k < 1000; ++k)
        loop(); // the ramp
    for (int k = 0; k < 2000; ++k) {
        motor.electrical_angle = 6.28318531f * static_cast<float>(k) / 2000.0f;
        loop();
        const double q = static_cast<double>(motor.target + motor.feed_forward_current.q);
        const double d = static_cast<double>(motor.feed_forward_current.d);
        // i_a = d cos θ' − q sin θ', θ' from the flux on phase a
        const double ia = d * std::cos(static_cast<double>(motor.electrical_angle)) -
                          q * std::sin(static_cast<double>(motor.electrical_angle));
        const hci_currents_abc i = hci_table_f32_abc_torque(
            &fine, hci_angle_from_rad(motor.electrical_angle + 3.14159265f), 11.7f * 0.21f);
        worst = std::fmax(worst, std::fabs(ia - static_cast<double>(i.ia_A)));
    }
    std::printf("largest difference %.3g A\n", worst);
    motor.shaft_velocity = 50.0f; // faded out
    loop();
    if (motor.feed_forward_current.d != 0.0f || motor.feed_forward_current.q != 0.0f) return EXIT_FAILURE;
    return worst < 0.3 ? EXIT_SUCCESS : EXIT_FAILURE;
}
